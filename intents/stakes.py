"""What it would cost to do something that was not meant: the less, the less sure one need be.

A look, an answer or a count moves nothing, a word undoes what was switched, opened or closed; who
walks has to walk back, and what was carried has to be found again.
"""

from collections.abc import Sequence
from enum import IntEnum

from intents.goals import (
    Answer,
    Close,
    Count,
    Find,
    Goal,
    LookAt,
    Open,
    Report,
    Say,
    Switch,
    Tell,
    each,
)

_LOOKING = (Answer, Count, Find, LookAt, Report, Tell)
_UNDONE_BY_A_WORD = (Switch, Open, Close)


class Stake(IntEnum):
    """What a wrong act costs, the least first."""

    LOOK = 0
    """Nothing: a question is answered."""
    DEVICE = 1
    """A word: what was switched on is switched off again."""
    SPEECH = 2
    """Somebody has heard it."""
    MOTION = 3
    """The robot is elsewhere, or things are."""


def stake_of(goals: Sequence[Goal]) -> Stake:
    """What is at stake with the dearest of some goals; `MOTION` where there are none."""
    return max(map(_stake, each(tuple(goals))), default=Stake.MOTION)


def _stake(goal: Goal) -> Stake:
    if isinstance(goal, _LOOKING):
        return Stake.LOOK
    if isinstance(goal, _UNDONE_BY_A_WORD):
        return Stake.DEVICE
    return Stake.SPEECH if isinstance(goal, Say) else Stake.MOTION
