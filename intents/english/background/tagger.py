"""How likely each word of a sentence is background: a linear-chain conditional random field.

With two labels only differences count: a feature has one weight, what it adds to the log odds that
a word is background, and a transition one of four. The weights were learnt by
``python -m training.background``; probabilities are marginals by the forward-backward algorithm.
"""

import gzip
import json
from functools import cache
from importlib.resources import files
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from intents.english.background.looks import looks, said
from intents.english.words.names import NameIndex

_FILE = "weights.json.gz"
Vector = NDArray[np.float64]


class Weights(NamedTuple):
    """What a field has learnt.

    Attributes:
        features: What each feature adds to the log odds of background.
        steps: The scores of going on, shape (2, 2), from [asked, background] to the same.
    """

    features: dict[str, float]
    steps: Vector


class Passed(NamedTuple):
    """Words in a row that are taken for background.

    Attributes:
        start: The first character.
        end: The character after the last.
        sure: How likely it is that all of them are [0..1]: the least of their probabilities.
    """

    start: int
    end: int
    sure: float


@cache
def learnt() -> Weights:
    """The weights that come with the package, read when first asked for."""
    packed = files("intents.english.background").joinpath(_FILE).read_bytes()
    return unpacked(packed)


def packed(weights: Weights) -> bytes:
    """Weights as a file, the same bytes for the same weights."""
    plain = {"steps": weights.steps.tolist(), "features": dict(sorted(weights.features.items()))}
    text = json.dumps(plain, separators=(",", ":"), ensure_ascii=False)
    return gzip.compress(text.encode(), mtime=0)


def unpacked(data: bytes) -> Weights:
    """Weights out of a file."""
    plain = json.loads(gzip.decompress(data))
    return Weights(plain["features"], np.array(plain["steps"], dtype=np.float64))


def probabilities(features: list[list[str]], weights: Weights) -> Vector:
    """How likely each word is background [0..1], shape (n,)."""
    n = len(features)
    known = weights.features
    odds = np.array([sum(known.get(name, 0.0) for name in word) for word in features])
    scores = np.column_stack([np.zeros(n), odds])
    forward, backward = scores.copy(), np.zeros((n, 2))
    for at in range(1, n):
        forward[at] += np.logaddexp.reduce(forward[at - 1][:, None] + weights.steps, axis=0)
    for at in range(n - 2, -1, -1):
        after = scores[at + 1] + backward[at + 1]
        backward[at] = np.logaddexp.reduce(weights.steps + after[None, :], axis=1)
    joint = forward + backward
    return 1.0 / (1.0 + np.exp(joint[:, 0] - joint[:, 1]))


def background(text: str, index: NameIndex, weights: Weights | None = None) -> list[Passed]:
    """What of a text is rather background than not, in order.

    Args:
        text: A sentence as it was said or typed.
        index: The names of its world.
        weights: What was learnt; by default what comes with the package.
    """
    words = said(text)
    if not words:
        return []
    likely = probabilities(looks(words, index), weights or learnt())
    found: list[Passed] = []
    at = 0
    while at < len(words):
        end = at
        while end < len(words) and (likely[end] > 0.5 or (end > at and words[end].is_sign)):
            end += 1
        heard = [n for n in range(at, end) if not words[n].is_sign]
        if heard:
            sure = min(float(likely[n]) for n in heard)
            found.append(Passed(words[at].start, words[end - 1].end, sure))
        at = max(end, at + 1)
    return found
