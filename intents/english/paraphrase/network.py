"""The network in NumPy: an encoder that reads pieces, a decoder that writes plain words or points.

The encoder is that of MiniLM [Wang et al. 2020; a BERT, Devlin et al. 2019], taught on; the decoder
answers with one distribution over its own words and the units of the sentence, as pointer networks
have it for semantic parsing [Rongali et al. 2020]. Weights are bytes with a scale for each row.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import as_file, files
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]
_PACKAGE = "intents.english.paraphrase"
_HEADS, _WRITER_HEADS = 12, 6
_EVEN, _WRITER_EVEN = 1e-12, 1e-5
BEGIN, END = 0, 1
"""The numbers of the words that begin and end what is written."""


class Matrix(NamedTuple):
    """A matrix as bytes, shape (rows, columns), and the scale of each row."""

    bytes: NDArray[np.int8]
    scale: Array

    def rows(self, at: Sequence[int]) -> Array:
        """Some of its rows."""
        return self.bytes[at].astype(np.float32) * self.scale[at, None]

    def of(self, x: Array) -> Array:
        """``x`` times the transposed matrix; shape (n, rows)."""
        return (x @ self.bytes.astype(np.float32, copy=False).T) * self.scale


class Network(NamedTuple):
    """What was learnt.

    Attributes:
        known: The number of each piece of a word.
        words: The plain words that it can write.
        numbers_of: The number of each of them.
        matrices: Its matrices by name.
        numbers: Its biases, scales and places by name.
    """

    known: dict[str, int]
    words: list[str]
    numbers_of: dict[str, int]
    matrices: Mapping[str, Matrix]
    numbers: Mapping[str, Array]

    def linear(self, name: str, x: Array) -> Array:
        """A linear layer."""
        return self.matrices[f"{name}.weight"].of(x) + self.numbers[f"{name}.bias"]

    def even(self, name: str, x: Array, least: float) -> Array:
        """A normalised layer [Ba et al. 2016]; ``least`` is added to the variance."""
        centred = x - x.mean(axis=-1, keepdims=True)
        spread = np.sqrt((centred * centred).mean(axis=-1, keepdims=True) + least)
        return centred / spread * self.numbers[f"{name}.weight"] + self.numbers[f"{name}.bias"]

    def layers(self, part: str) -> int:
        """How many layers the readers or the writers have."""
        names = (name.split(".") for name in self.numbers)
        return 1 + max(int(name[1]) for name in names if name[0] == part)

    @property
    def longest(self) -> int:
        """So many pieces are read at most."""
        return len(self.numbers["places.weight"])

    @property
    def longest_plain(self) -> int:
        """So many plain words are written at most."""
        return len(self.numbers["plain_places.weight"])

    def read(self, pieces: Sequence[int], sorts: Sequence[int]) -> Array:
        """The states of the pieces, shape (pieces, width)."""
        x = self.matrices["pieces.weight"].rows(list(pieces))
        x = x + self.numbers["places.weight"][: len(pieces)]
        x = x + self.numbers["sorts.weight"][list(sorts)]
        x = self.even("read_in", x, _EVEN)
        for n in range(self.layers("readers")):
            of = f"readers.{n}"
            query, key, value = (
                self.linear(f"{of}.attention.{part}", x) for part in ("query", "key", "value")
            )
            heads = _attended(query, key, value, _HEADS)
            x = self.even(f"{of}.attended", x + self.linear(f"{of}.attention.out", heads), _EVEN)
            inner = self.linear(f"{of}.outer", _gelu(self.linear(f"{of}.inner", x)))
            x = self.even(f"{of}.done", x + inner, _EVEN)
        return x

    def begin(self, read: Array, heads: Sequence[int]) -> Writing:
        """Ready to write about what was read; ``heads`` is the first piece of each unit."""
        return Writing(self, read, heads)


class Writing:
    """What is written about a sentence, word after word."""

    def __init__(self, network: Network, read: Array, heads: Sequence[int]) -> None:
        """Look at what was read once for all words."""
        self._net = network
        self._states = read[list(heads)]
        self._pointed = network.linear("pointed", self._states)
        self._has = np.asarray(heads) > 0
        self._layers = range(network.layers("writers"))
        self._cross = [
            tuple(network.linear(f"writers.{n}.cross.{part}", read) for part in ("key", "value"))
            for n in self._layers
        ]
        self._own: list[list[tuple[Array, Array]]] = [[] for _ in self._layers]
        self._at = 0

    def after(self, word: int) -> Array:
        """How likely each word and unit comes next, after a word (or a unit, numbered behind them).

        Returns:
            Logarithms of probabilities, shape (words + units,).
        """
        net, known = self._net, len(self._net.words)
        own = net.matrices["words.weight"]
        x = own.rows([word]) if word < known else self._pointed[[word - known]]
        x = x + net.numbers["plain_places.weight"][[self._at]]
        self._at += 1
        for n in self._layers:
            x = self._layer(n, x)
        x = net.even("write_out", x, _WRITER_EVEN)
        wide = np.float32(np.sqrt(x.shape[1]))
        written = own.of(x)[0] / wide * 4.0 + net.numbers["bias"]
        points = (self._states @ net.linear("points", x)[0]) / wide
        scores = np.concatenate([written, np.where(self._has, points, -1e4)])
        scores -= scores.max()
        return scores - np.log(np.exp(scores).sum())

    def finds(self, written: Sequence[int]) -> Array:
        """How likely the network finds each of some words, numbered as in :meth:`after`.

        All of them are weighed at once; nothing may have been written before.

        Returns:
            Logarithms of probabilities, and those of the likeliest word in each place; shape
            (2, words).
        """
        net, known = self._net, len(self._net.words)
        before = [BEGIN, *written[:-1]]
        own = net.matrices["words.weight"]
        x = np.where(
            np.array([word < known for word in before])[:, None],
            own.rows([min(word, known - 1) for word in before]),
            self._pointed[[max(word - known, 0) for word in before]],
        )
        x = x + net.numbers["plain_places.weight"][: len(before)]
        for n in self._layers:
            x = self._layer(n, x)
        x = net.even("write_out", x, _WRITER_EVEN)
        wide = np.float32(np.sqrt(x.shape[1]))
        writes = own.of(x) / wide * 4.0 + net.numbers["bias"]
        points = (net.linear("points", x) @ self._states.T) / wide
        scores = np.concatenate([writes, np.where(self._has, points, -1e4)], axis=1)
        scores -= scores.max(axis=1, keepdims=True)
        scores -= np.log(np.exp(scores).sum(axis=1, keepdims=True))
        return np.stack([scores[np.arange(len(written)), list(written)], scores.max(axis=1)])

    def _layer(self, n: int, x: Array) -> Array:
        net, of = self._net, f"writers.{n}"
        y = net.even(f"{of}.norms.0", x, _WRITER_EVEN)
        query, key, value = (
            net.linear(f"{of}.own.{part}", y) for part in ("query", "key", "value")
        )
        self._own[n].append((key, value))
        keys, values = (np.concatenate(part) for part in zip(*self._own[n], strict=True))
        heads = _attended(query, keys, values, _WRITER_HEADS, ordered=len(x) > 1)
        x = x + net.linear(f"{of}.own.out", heads)
        y = net.even(f"{of}.norms.1", x, _WRITER_EVEN)
        key, value = self._cross[n]
        heads = _attended(net.linear(f"{of}.cross.query", y), key, value, _WRITER_HEADS)
        x = x + net.linear(f"{of}.cross.out", heads)
        y = net.even(f"{of}.norms.2", x, _WRITER_EVEN)
        return x + net.linear(f"{of}.outer", _gelu(net.linear(f"{of}.inner", y)))


def _attended(
    query: Array, key: Array, value: Array, heads: int, *, ordered: bool = False
) -> Array:
    """Scaled dot-product attention of several heads [Vaswani et al. 2017].

    Where they are ordered, each state looks only at those up to its own place.
    """

    def split(x: Array) -> Array:
        return x.reshape(len(x), heads, -1).transpose(1, 0, 2)

    q, k, v = split(query), split(key), split(value)
    scores = q @ k.transpose(0, 2, 1) / np.float32(np.sqrt(q.shape[-1]))
    if ordered:
        scores = np.where(np.tri(len(query), len(key), dtype=bool), scores, np.float32(-1e4))
    odds = np.exp(scores - scores.max(axis=-1, keepdims=True))
    odds /= odds.sum(axis=-1, keepdims=True)
    return (odds @ v).transpose(1, 0, 2).reshape(len(query), -1)


def _gelu(x: Array) -> Array:
    """Gaussian error linear unit; erf by Abramowitz and Stegun 7.1.26, to 1.5e-7."""
    z = np.abs(x) / np.float32(np.sqrt(2.0))
    t = 1.0 / (1.0 + 0.3275911 * z)
    rest = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027
                + t * 1.061405429))))  # fmt: skip
    erf = np.copysign(1.0 - rest * np.exp(-z * z), x)
    return (0.5 * x * (1.0 + erf)).astype(np.float32)


@cache
def shipped() -> Network:
    """The network that comes with the package, read when it is first asked for."""
    folder = files(_PACKAGE)
    with as_file(folder.joinpath("network.npz")) as file, np.load(file) as stored:
        return unpacked(dict(stored))


def unpacked(stored: Mapping[str, NDArray[np.generic]]) -> Network:
    """A network out of the arrays of a file."""
    pieces, words = (stored[name].tobytes().decode().split("\n") for name in ("pieces", "words"))
    matrices, numbers = {}, {}
    for name, value in stored.items():
        if name.endswith(".bytes"):
            plain = name.removesuffix(".bytes")
            matrices[plain] = Matrix(
                value.astype(np.int8, copy=False), stored[f"{plain}.scale"].astype(np.float32)
            )
        elif not name.endswith(".scale") and name not in ("pieces", "words"):
            numbers[name] = value.astype(np.float32, copy=False)
    known, numbered = ({word: n for n, word in enumerate(part)} for part in (pieces, words))
    return Network(known, words, numbered, matrices, numbers)
