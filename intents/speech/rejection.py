"""Whether the words found are what was said, or only what the grammar could make of something else.

The decoder scores each frame relative to the best of all senones there, so the score of a word
says how much worse it fits the sound than anything whatever would: a likelihood ratio against an
unconstrained model, for nothing. Of a command that was said all words fit well and account for
nearly all of the sound; of other speech that was forced onto the grammar some fit badly, and some
of it is passed over as noise between them.
"""

from __future__ import annotations

import math

import msgspec


class Fit(msgspec.Struct, frozen=True, kw_only=True):
    """How one word fits the sound.

    Attributes:
        word: the word.
        phones: of which it is made, as it was spoken.
        frames: how long it takes, in frames of 10 ms.
        score: log-likelihood over all frames, relative to the best senone of each [nat].
        chance: logarithm of how likely the grammar holds the word, as the decoder weighs it [nat].
        power: share of the power of the whole utterance that falls on the word.
    """

    word: str
    phones: tuple[str, ...] = ()
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
        unsaid: share of the power of the utterance that falls on no word.
    """

    worst: float
    mean: float
    length: float
    chance: float
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
        unsaid=1.0 - sum(fit.power for fit in fits),
    )


WEIGHTS = Features(worst=0.619, mean=3.802, length=-2.759, chance=0.173, unsaid=-32.865)
BIAS = 37.142
"""Of a logistic regression over the sentences for tuning of `benchmarks.speech`, of known voices.
The bias is one more than fitted: strangers are believed sooner, and other speech little more."""


def doubt(fits: list[Fit]) -> float:
    """How doubtful the words are; 1 and more is more likely no command."""
    seen = features(fits)
    logit = BIAS + sum(
        getattr(WEIGHTS, name) * getattr(seen, name) for name in Features.__struct_fields__
    )
    return 2.0 / (1.0 + math.exp(min(logit, 50.0)))
