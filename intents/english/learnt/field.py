"""A linear-chain conditional random field: how likely each label is at each place of a chain."""

import io
from collections.abc import Iterator, Mapping
from functools import cache
from importlib.resources import files
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_LEVELS = (0.02, 0.08, 0.2, 0.4, 0.6, 0.8, 0.92, 0.98)


class Field(NamedTuple):
    """What was learnt.

    Attributes:
        labels: The labels, in the order of all arrays.
        rows: Where the weights of a feature stand.
        weights: What a feature adds to the score of each label, shape (features, labels); as they
            are stored, of half precision, in a quarter of the memory, and added up in double.
        steps: The score of going from one label to the next, shape (labels, labels).
    """

    labels: tuple[str, ...]
    rows: dict[str, int]
    weights: NDArray[np.floating]
    steps: Array

    def marginals(self, chain: list[list[str]]) -> Array:
        """How likely each label is at each place [0..1], by the forward-backward algorithm.

        Args:
            chain: The features of each place; those that were not seen in learning count nothing.

        Returns:
            Shape (places, labels); the sum of each row is 1.
        """
        row_of = self.rows.get
        scores = np.array(
            [
                self.weights[[row for name in place if (row := row_of(name)) is not None]]
                .astype(np.float64)
                .sum(axis=0)
                for place in chain
            ]
        )
        forward, backward = scores.copy(), np.zeros_like(scores)
        for at in range(1, len(chain)):
            forward[at] += _log_sum(forward[at - 1][:, None] + self.steps)
        for at in range(len(chain) - 2, -1, -1):
            backward[at] = _log_sum((self.steps + scores[at + 1] + backward[at + 1]).T)
        joint = forward + backward
        odds = np.exp(joint - joint.max(axis=1, keepdims=True))
        return odds / odds.sum(axis=1, keepdims=True)


def _log_sum(scores: Array) -> Array:
    """The logarithm of the sums of exponentials along the first axis."""
    most = scores.max(axis=0)
    return most + np.log(np.exp(scores - most).sum(axis=0))


def level(likely: float) -> str:
    """A probability [0..1] as a feature: the finer, the nearer it is to certainty."""
    return str(sum(likely >= one for one in _LEVELS))


def packed(field: Field) -> bytes:
    """A field as a file (npz), the same bytes for the same field."""
    names = sorted(field.rows)
    file = io.BytesIO()
    np.savez_compressed(
        file,
        labels=_bytes(field.labels),
        names=_bytes(names),
        weights=field.weights[[field.rows[name] for name in names]].astype(np.float16),
        steps=field.steps,
    )
    return file.getvalue()


def _bytes(words: tuple[str, ...] | list[str]) -> NDArray[np.uint8]:
    return np.frombuffer("\n".join(words).encode(), dtype=np.uint8)


def unpacked(data: bytes) -> Field:
    """A field out of a file."""
    with np.load(io.BytesIO(data)) as stored:
        labels, names = (stored[key].tobytes().decode().split("\n") for key in ("labels", "names"))
        rows = {name: row for row, name in enumerate(names)}
        weights = stored["weights"]
        return Field(tuple(labels), rows, weights, stored["steps"].astype(np.float64))


Fields = Mapping[str, Field]
"""What was learnt, each field by its name."""
NAMES = ("background", "acts", "roles", "trust", "choice", "check")


@cache
def learnt(name: str) -> Field:
    """A field that comes with the package, read when it is first asked for."""
    return unpacked(files("intents.english.learnt").joinpath(f"{name}.npz").read_bytes())


class _Shipped(Fields):
    """The fields that come with the package, each read when it is first asked for."""

    def __getitem__(self, name: str) -> Field:
        return learnt(name)

    def __iter__(self) -> Iterator[str]:
        return iter(NAMES)

    def __len__(self) -> int:
        return len(NAMES)


LEARNT: Fields = _Shipped()
