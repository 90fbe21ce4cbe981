"""Words that cry, spotted in a stream as they are said: a small network of our own.

It was trained on synthesised voices (`training.cries`; what it was trained on and how well it does
is told in `cries.md` beside the weights). It hears 16 words, and tells them from the same words in
talk and errands by what it heard in the two seconds before and the few tenths after.
"""

from __future__ import annotations

import importlib.resources
import io
from collections import deque
from functools import cache
from typing import NamedTuple

import numpy as np

from intents.speech.audio import RATE_HZ, Samples
from intents.speech.filterbank import HOP, Filterbank
from intents.speech.network import STRIDE, Array, Network

KEYWORDS = (
    "stop", "halt", "freeze", "emergency", "wait", "no", "don't", "careful", "stay", "enough",
    "hold", "hang", "look", "watch", "whoa", "easy",
)  # fmt: skip
"""In the order of the network's answers."""
STOPS = frozenset({"stop", "halt", "freeze", "emergency"})
"""These stop; the others halt, and it is asked what was meant."""
_SPOKEN = {"hold": "hold on", "hang": "hang on", "look": "look out", "watch": "watch out"}
_SMOOTH = 2
"""A probability is the mean over so many answers: 60 ms."""
_MEMORY_S = 2.0
_STEP_S = STRIDE * HOP / RATE_HZ


class Keyword(NamedTuple):
    """A word that may be cried.

    Attributes:
        text: what is cried: "look out" for "look".
        stops: whether it stops.
        sure: how likely that is, from 0 to 1.
        at_s: where in the stream that was known.
    """

    text: str
    stops: bool
    sure: float
    at_s: float


class Keywords:
    """Follows one stream."""

    def __init__(self, weights: dict[str, Array] | None = None) -> None:
        """Begin; `weights` are the network's (None: those that are shipped)."""
        self._bands = Filterbank()
        self._network = Network(weights or _shipped())
        self._last: deque[Array] = deque(maxlen=_SMOOTH)
        self._recent: deque[Keyword] = deque(maxlen=round(_MEMORY_S / _STEP_S))
        self._count = 0

    def push(self, sound: Samples) -> list[Keyword]:
        """The likeliest word at each 30 ms of the next block."""
        return [self._answered(one) for one in self._network.push(self._bands.push(sound))]

    def likeliest(self) -> float:
        """How likely any word was in the last two seconds."""
        return max((one.sure for one in self._recent), default=0.0)

    def _answered(self, logits: Array) -> Keyword:
        self._count += 1
        chances = np.exp(logits - logits.max())
        self._last.append(chances / chances.sum())
        told = np.mean(np.stack(self._last), axis=0)[1:]
        word = KEYWORDS[int(np.argmax(told))]
        found = Keyword(
            _SPOKEN.get(word, word), word in STOPS, float(told.sum()), self._count * _STEP_S
        )
        self._recent.append(found)
        return found


@cache
def _shipped() -> dict[str, Array]:
    data = importlib.resources.files("intents.speech").joinpath("cries.npz").read_bytes()
    with np.load(io.BytesIO(data)) as weights:
        return {name: weights[name].astype(np.float32) for name in weights.files}
