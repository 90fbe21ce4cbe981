"""What the bundled model of PocketSphinx holds of each sound of English.

The model is "phonetically tied": each phone has 128 Gaussians for each of three streams (cepstra,
their changes, the changes of these), and each state of a phone mixes them with weights of its own.
Read are the states of phones without regard to their neighbours. Sources: CMU Sphinx, ms_gauden.c,
ptm_mgau.c, bin_mdef.c.
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from intents.speech.cepstra import COUNT

STATES = 3
"""Of a phone, one after the other."""
SILENCE = "SIL"
STREAMS = 3
_FLOOR = 1e-4
_WEIGHT_UNIT = -1024.0 * math.log(1.0001)
"""A step of the weights' logarithm: the base of the decoder's logarithms, shifted by ten bits."""
_MAGIC = 0x11223344


@dataclass(frozen=True, eq=False)
class Acoustics:
    """The Gaussians of a model.

    Attributes:
        phones: what they are called, in the order of the arrays.
        means: shape (phone, stream, Gaussian, 13).
        precisions: one over the variances, same shape.
        weights: logarithms, shape (phone, state, stream, Gaussian) [nat].
    """

    phones: dict[str, int]
    means: NDArray[np.float64]
    precisions: NDArray[np.float64]
    weights: NDArray[np.float64]

    def scores(self, phone: int, stream: int, seen: NDArray[np.float64]) -> NDArray[np.float64]:
        """The log-density of frames under each Gaussian, but for a constant.

        Args:
            phone: whose.
            stream: which of the three.
            seen: shape (frames, 13).

        Returns:
            Shape (frames, Gaussians) [nat].
        """
        return _densities(seen, self.means[phone, stream], self.precisions[phone, stream])

    def speech(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """The log-density of cepstra under all sounds of speech, whichever, but for a constant.

        Args:
            values: centred cepstra, shape (frames, 13).

        Returns:
            Shape (frames,) [nat].
        """
        means, precisions, weights = self._pooled
        return log_sum(_densities(values, means, precisions) + weights)

    @cached_property
    def sounds(self) -> list[int]:
        """The numbers of the phones that are sounds of speech: no silence, no noise."""
        return [n for name, n in self.phones.items() if name != SILENCE and name[0] != "+"]

    @cached_property
    def _pooled(self) -> tuple[NDArray[np.float64], ...]:
        """The Gaussians of the cepstra of all sounds of speech, and their weights."""
        sounds = self.sounds
        shares = np.exp(self.weights[sounds, :, 0]).mean(axis=1)
        return (
            self.means[sounds, 0].reshape(-1, COUNT),
            self.precisions[sounds, 0].reshape(-1, COUNT),
            np.log(shares / len(sounds)).ravel(),
        )


def log_sum(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """The logarithm of the sum of what has these logarithms, row by row."""
    highest = values.max(axis=1)
    return highest + np.log(np.exp(values - highest[:, None]).sum(axis=1))


def _densities(
    seen: NDArray[np.float64], means: NDArray[np.float64], precisions: NDArray[np.float64]
) -> NDArray[np.float64]:
    around = (means**2 * precisions - np.log(precisions)).sum(axis=1)
    return seen @ (means * precisions).T - 0.5 * (seen**2 @ precisions.T + around)


@cache
def load(folder: Path) -> Acoustics:
    """Read the model in a folder.

    Raises:
        ValueError: it is not of the kind that PocketSphinx bundles.
    """
    phones = _phones((folder / "mdef").read_bytes())
    means, variances = (_gaussians((folder / name).read_bytes()) for name in ("means", "variances"))
    weights = _weights((folder / "sendump").read_bytes())[:, :, : len(phones) * STATES]
    if means.shape[0] != len(phones) or means.shape[1] != STREAMS or means.shape[3] != COUNT:
        raise ValueError(f"{folder} is not phonetically tied with three streams of {COUNT} numbers")
    by_state = weights.reshape(STREAMS, -1, len(phones), STATES).transpose(2, 3, 0, 1)
    return Acoustics(
        phones={name: number for number, name in enumerate(phones)},
        means=means,
        precisions=1.0 / np.maximum(variances, _FLOOR),
        weights=_WEIGHT_UNIT * by_state,
    )


def _phones(data: bytes) -> list[str]:
    """The names of the phones: after a header and ten numbers, of which the first counts them."""
    (header,) = struct.unpack_from("<i", data, 8)
    at = 12 + header
    (count,) = struct.unpack_from("<i", data, at)
    return [name.decode() for name in data[at + 40 :].split(b"\0", count)[:count]]


def _gaussians(data: bytes) -> NDArray[np.float64]:
    """Means or variances, shape (phone, stream, Gaussian, 13)."""
    begin = data.index(b"endhdr\n") + len(b"endhdr\n")
    magic, codebooks, streams, densities = np.frombuffer(data, "<i4", 4, begin)
    if magic != _MAGIC:
        raise ValueError("the Gaussians are written for machines of another kind")
    begin += 4 * (4 + int(streams))
    (total,) = np.frombuffer(data, "<i4", 1, begin)
    values = np.frombuffer(data, "<f4", total, begin + 4).astype(np.float64)
    return values.reshape(codebooks, streams, densities, -1)


def _weights(data: bytes) -> NDArray[np.float64]:
    """The quantised weights of all states, shape (stream, Gaussian, state)."""
    at = length = 0
    while True:
        (length,) = struct.unpack_from("<i", data, at)
        at += 4 + length
        if not length:
            break
    densities, states = struct.unpack_from("<ii", data, at)
    values = np.frombuffer(data, np.uint8, STREAMS * densities * states, at + 8)
    return values.reshape(STREAMS, densities, states).astype(np.float64)
