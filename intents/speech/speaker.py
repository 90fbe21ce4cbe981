"""Getting used to voices: an affine map from each one's cepstra to those of the model.

The map is the one under which what the speaker is known to have said is most likely (constrained
maximum likelihood linear regression, "fMLLR"), found row by row. A prior stands in for a few
seconds of a speaker who needs no map, so that little speech changes little; and what was heard long
ago counts less, so that another speaker is got used to as well. Source: Gales 1998, Maximum
likelihood linear transformations for HMM-based speech recognition.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from intents.speech.acoustics import SILENCE, STATES, STREAMS, Acoustics
from intents.speech.alignment import States
from intents.speech.cepstra import COUNT, Cepstra, with_changes

PRIOR_FRAMES = 300.0
"""How many frames the prior is worth."""
HALF_LIFE_FRAMES = 20_000.0
"""After so much speech of the same or another voice, what was heard counts half."""
MOST_KNOWN = 4
"""Voices are known at a time; whoever was silent longest is forgotten."""
UNLIKE = 2.0
"""So much worse than usual fits a voice that is not the speaker's [nat/frame]."""
ROUNDS = 8
"""Over the rows; each depends on the others."""
_FEW = 1e-4
Array = NDArray[np.float64]


@dataclass(frozen=True)
class _Sums:
    """What the map is computed from, summed over frames, streams and Gaussians.

    Attributes:
        squares: shape (13, 14, 14), of the inputs [cepstra, 1], weighed by each row's precisions.
        products: shape (13, 14), of inputs and means, weighed alike.
        terms: how many frames of how many streams.
    """

    squares: Array = field(default_factory=lambda: np.zeros((COUNT, COUNT + 1, COUNT + 1)))
    products: Array = field(default_factory=lambda: np.zeros((COUNT, COUNT + 1)))
    terms: float = 0.0

    def plus(self, other: _Sums, *, share: float = 1.0) -> _Sums:
        """The sum of a share of this and another."""
        return _Sums(
            squares=share * self.squares + other.squares,
            products=share * self.products + other.products,
            terms=share * self.terms + other.terms,
        )


@dataclass(frozen=True, eq=False)
class Speaker:
    """What is known of a voice; of a stranger's, nothing.

    Attributes:
        map: shape (13, 14): applied to centred cepstra and 1.
        usual: how well speech of the voice fits the model [nat/frame].
    """

    map: Array = field(default_factory=lambda: np.eye(COUNT, COUNT + 1))
    usual: float = 0.0
    _sums: _Sums = field(default_factory=_Sums)

    @property
    def frames(self) -> float:
        """How much was heard of the voice, less what is forgotten."""
        return self._sums.terms / STREAMS

    def adapted(self, values: Cepstra) -> Cepstra:
        """Centred cepstra as the model expects them."""
        return values @ self.map[:, :COUNT].T + self.map[:, COUNT]

    def after(self, values: Cepstra, states: States, model: Acoustics) -> Speaker:
        """What is known after another utterance.

        Args:
            values: its centred cepstra, before any map.
            states: of each frame.
            model: whose states they are.
        """
        share = 0.5 ** (len(values) / HALF_LIFE_FRAMES)
        sums = self._sums.plus(self._seen(values, states, model), share=share)
        used_to = replace(self, map=_best(self.map, sums.plus(_prior(model))), _sums=sums)
        fits = used_to.fits(values, model)
        return replace(used_to, usual=fits if not self.frames else 0.8 * self.usual + 0.2 * fits)

    def fits(self, values: Cepstra, model: Acoustics) -> float:
        """How well an utterance fits the model through the map [nat/frame]."""
        loud = values[values[:, 0] >= 0.0]
        if not len(loud):
            return -np.inf
        stretch = np.linalg.slogdet(self.map[:, :COUNT]).logabsdet
        return float(model.speech(self.adapted(loud)).mean() + stretch)

    def _seen(self, values: Cepstra, states: States, model: Acoustics) -> _Sums:
        """The sums of one utterance; silence is no part of a voice."""
        sums = _Sums()
        raw, mapped = with_changes(values), with_changes(self.adapted(values))
        for phone, state in {(int(p), int(s)) for p, s in states}:
            if phone == model.phones[SILENCE]:
                continue
            here = (states == (phone, state)).all(axis=1)
            for stream in range(STREAMS):
                scores = model.scores(phone, stream, mapped[stream][here])
                scores += model.weights[phone, state, stream]
                chance = np.exp(scores - scores.max(axis=1, keepdims=True))
                chance /= chance.sum(axis=1, keepdims=True)
                inputs = _with_one(raw[stream][here], stream)
                precision = model.precisions[phone, stream]
                outer = inputs[:, :, None] * inputs[:, None, :]
                weighed = (chance @ precision).T @ outer.reshape(len(inputs), -1)
                sums = sums.plus(
                    _Sums(
                        squares=weighed.reshape(sums.squares.shape),
                        products=(chance @ (model.means[phone, stream] * precision)).T @ inputs,
                        terms=len(inputs),
                    )
                )
        return sums


def whose(values: Cepstra, known: Iterable[Speaker], model: Acoustics) -> Speaker:
    """Who says an utterance: of those that are known the one that it fits best, or a stranger."""
    fitting = [(speaker.fits(values, model), speaker) for speaker in known]
    best, speaker = max(fitting, key=lambda one: one[0], default=(-np.inf, Speaker()))
    return speaker if best > speaker.usual - UNLIKE else Speaker()


def _with_one(values: Array, stream: int) -> Array:
    """Inputs of the map: what is added to all cepstra alike does not change their changes."""
    one = np.full((len(values), 1), 1.0 if stream == 0 else 0.0)
    return np.hstack([values, one])


@cache
def _prior(model: Acoustics) -> _Sums:
    """The sums of a speaker whose every sound is as the model has it, each as often."""
    squares = np.zeros((COUNT, COUNT + 1, COUNT + 1))
    share = PRIOR_FRAMES / (len(model.sounds) * STATES)
    for phone in model.sounds:
        for state in range(STATES):
            for stream in range(STREAMS):
                weights = np.exp(model.weights[phone, state, stream])
                often = weights > _FEW
                weights = share * weights[often] / weights[often].sum()
                inputs = _with_one(model.means[phone, stream][often], stream)
                precision = model.precisions[phone, stream][often]
                outer = inputs[:, :, None] * inputs[:, None, :]
                outer[:, range(COUNT), range(COUNT)] += 1.0 / precision
                weighed = (weights[:, None] * precision).T @ outer.reshape(len(inputs), -1)
                squares += weighed.reshape(squares.shape)
    terms = STREAMS * PRIOR_FRAMES
    rows = range(COUNT)
    products = squares[rows, rows].copy()  # the identity is the best map of such a speaker
    products[rows, rows] -= terms
    return _Sums(squares, products, terms)


def _best(first: Array, sums: _Sums) -> Array:
    """The most likely map [Gales 1998, section 3.2]: each row in closed form, the others held."""
    inverses = np.linalg.inv(sums.squares)
    found = first.copy()
    for _ in range(ROUNDS):
        for row in range(COUNT):
            square = found[:, :COUNT]
            cofactors = np.append(np.linalg.inv(square)[:, row] * np.linalg.det(square), 0.0)
            inverse, product = inverses[row], sums.products[row]
            a, b = cofactors @ inverse @ cofactors, cofactors @ inverse @ product
            root = np.sqrt(b * b + 4.0 * a * sums.terms)
            ways = [(-b + sign * root) / (2.0 * a) for sign in (1.0, -1.0)]
            gains = [sums.terms * np.log(abs(way * a + b)) - 0.5 * way**2 * a for way in ways]
            found[row] = (ways[int(np.argmax(gains))] * cofactors + product) @ inverse
    return found
