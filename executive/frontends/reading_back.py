"""Which goals that were heard are read back before they are done."""

from __future__ import annotations

from collections.abc import Callable

from intents import goals as g
from intents.goals import Goal, each
from intents.risks import risk

HARMLESS = (g.Stop, g.Pause, g.Resume, g.Cancel, g.Report, g.Say, g.Answer, g.Wait)
"""Goals that move nothing, and those that only end or hold what is under way."""

Risk = Callable[[tuple[Goal, ...]], str]
"""Why goals are read back, in words; empty where they need not be."""


def heard_risk(goals: tuple[Goal, ...]) -> str:
    """Why goals that were heard are read back: whatever moves the robot is."""
    known = risk(goals)
    moves = any(not isinstance(goal, HARMLESS) for goal in each(goals))
    return known or ("that is what I heard" if moves else "")


def doubtful_risk(doubtful: tuple[str, ...]) -> Risk:
    """Why goals that were not heard clearly are read back: whatever may move the robot is."""
    which = f"“{' '.join(doubtful)}”" if doubtful else "that"

    def why(goals: tuple[Goal, ...]) -> str:
        moves = any(isinstance(goal, g.Resume) for goal in each(goals))
        return f"I am not sure that I heard {which} right" if moves or heard_risk(goals) else ""

    return why
