"""Whether the words found are what was said, or only what the grammar could make of something else.

The decoder scores each frame relative to the best of all senones there, so the score of a word
says how much worse it fits the sound than anything whatever would: a likelihood ratio against an
unconstrained model, for nothing. Of a command that was said all words fit well and account for
nearly all of the sound; of other speech that was forced onto the grammar some fit badly, and some
of it is passed over as noise between them.
"""

from __future__ import annotations

import math
from difflib import SequenceMatcher

import msgspec


class Fit(msgspec.Struct, frozen=True, kw_only=True):
    """How one word fits the sound.

    Attributes:
        word: the word.
        phones: of which it is made, as it was spoken.
        begin: the frame in which it begins.
        frames: how long it takes, in frames of 10 ms.
        score: log-likelihood over all frames, relative to the best senone of each [nat].
        chance: logarithm of how likely the grammar holds the word, as the decoder weighs it [nat].
        power: share of the power of the whole utterance that falls on the word.
    """

    word: str
    phones: tuple[str, ...] = ()
    begin: int = 0
    frames: int
    score: float
    chance: float
    power: float


class Features(msgspec.Struct, frozen=True, kw_only=True):
    """What is looked at.

    Attributes:
        worst: mean score a frame of the two words that fit worst.
        mean: mean score a frame.
        length: logarithm of the number of words.
        chance: mean over the words of what the grammar thinks of them.
        rarest: the least of that.
        unsaid: share of the power of the utterance that falls on no word.
    """

    worst: float
    mean: float
    length: float
    chance: float
    rarest: float
    unsaid: float


def mean_score(fits: list[Fit]) -> float:
    """How well the words fit, a frame [nat]."""
    return sum(fit.score for fit in fits) / sum(fit.frames for fit in fits)


def features(fits: list[Fit]) -> Features:
    """What is looked at, of the words of one utterance."""
    ratios = sorted(fit.score / fit.frames for fit in fits)
    return Features(
        worst=sum(ratios[:2]) / len(ratios[:2]),
        mean=mean_score(fits),
        length=math.log(len(fits)),
        chance=sum(fit.chance for fit in fits) / len(fits),
        rarest=min(fit.chance for fit in fits),
        unsaid=1.0 - sum(fit.power for fit in fits),
    )


class Weights(msgspec.Struct, frozen=True, kw_only=True):
    """A logistic regression: how sure one may be of words.

    Attributes:
        seen: weights of what is looked at.
        gap: of how much better the other words fit, a frame.
        same: of the share of words that are the same in both.
        agree: of whether both mean the same.
        bias: the rest.
    """

    seen: Features
    gap: float
    same: float
    agree: float
    bias: float


OF_COMMAND = Weights(
    seen=Features(worst=0.371, mean=0.296, length=-1.047, chance=0.0, rarest=0.0, unsaid=-7.134),
    gap=-0.899, same=1.285, agree=1.774, bias=6.796,
)  # fmt: skip
OF_FREE = Weights(
    seen=Features(worst=0.135, mean=1.472, length=0.51, chance=0.07, rarest=0.002, unsaid=0.0),
    gap=0.0, same=1.014, agree=2.938, bias=6.423,
)  # fmt: skip
"""Fitted to sentences of `benchmarks.speech` that are for tuning, said by strangers in nine voices,
clean and in white noise at 15 dB."""
BELIEVED = 0.3
"""As sure as that one has to be, to believe words at all."""
DOUBTFUL = 0.8
"""How doubtful words are that nothing was compared with."""


def doubt_of_command(command: list[Fit], free: list[Fit], *, agree: bool) -> float:
    """How doubtful the words of a command are, next to free ones; 1 and more is not believed."""
    return _doubt(command, free, OF_COMMAND, agree=agree)


def doubt_of_free(free: list[Fit], command: list[Fit], *, agree: bool) -> float:
    """How doubtful free words are, next to those of a command; 1 and more is not believed."""
    return _doubt(free, command, OF_FREE, agree=agree)


def _doubt(fits: list[Fit], others: list[Fit], weights: Weights, *, agree: bool) -> float:
    seen, words, other = features(fits), [fit.word for fit in fits], [fit.word for fit in others]
    logit = (
        weights.bias
        + sum(getattr(weights.seen, n) * getattr(seen, n) for n in Features.__struct_fields__)
        + weights.gap * (mean_score(others) - seen.mean)
        + weights.same * _share_alike(words, other)
        + weights.agree * agree
    )
    unsure = 1.0 / (1.0 + math.exp(max(min(logit, 50.0), -50.0)))
    return unsure / (1.0 - BELIEVED)


def _share_alike(one: list[str], other: list[str]) -> float:
    return SequenceMatcher(None, one, other).ratio()
