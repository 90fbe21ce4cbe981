"""What every skill is given: the body, the planner, the description, what is held."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from executive.skills.encounters import Encounters
from executive.skills.hearing import Hearing
from executive.skills.holding import Holdings
from robot.link import BodyLink
from robot.model.description import RobotDescription
from robot.planning.worker import Planner


def _silent(_text: str) -> None:
    """Say nothing."""


def _unlimited() -> float:
    """Allow any speed."""
    return math.inf


@dataclass(frozen=True, kw_only=True)
class SkillContext:
    """One per mission, shared by its skills.

    Attributes:
        link: commands down, newest messages up.
        planner: where paths, stances and grasps are asked for.
        description: the robot, for its limits.
        seed: of every planning request; a retry adds to it.
        say: where spoken words go.
        speed_limit: the fastest walk allowed now [m/s]; it changes while a skill walks.
        holdings: what the hands hold; outlives a skill, so that place knows what pick took.
        encounters: who was asked to step aside, so that nobody is asked again and again.
        hearing: what people have said to the robot.
        searched_s: when a search for an object, by id, came to its end without it.
    """

    link: BodyLink
    planner: Planner
    description: RobotDescription
    seed: int = 0
    say: Callable[[str], None] = _silent
    speed_limit: Callable[[], float] = _unlimited
    holdings: Holdings = field(default_factory=Holdings)
    encounters: Encounters = field(default_factory=Encounters)
    hearing: Hearing = field(default_factory=Hearing)
    searched_s: dict[str, float] = field(default_factory=dict[str, float])
