"""What a step would take, and the dry run that it is told from.

A skill's `forecast` follows the robot through one step: it asks the `Outlook` for ways, picks and
places, and leaves the robot and the things there as they would be after the step.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import msgspec

from robot.messages import Place, Side, WorldMap
from robot.planning.requests import Stance
from robot.se3 import SE3


class Forecast(msgspec.Struct, frozen=True):
    """About how long a step takes [s], and why it would fail; "" if nothing is known against it."""

    takes_s: float
    problem: str = ""

    def then(self, takes_s: float) -> Forecast:
        """The same, and something after it [s]."""
        return Forecast(self.takes_s + takes_s, self.problem)


class Outlook(Protocol):
    """Robot and world as a dry run has them by then, asked step by step."""

    @property
    def X_WS(self) -> SE3:
        """Where the robot stands."""
        ...

    @property
    def map(self) -> WorldMap:
        """The prior map."""
        ...

    def place_of(self, object_id: str) -> Place | None:
        """Where a thing stands by then; None if nobody knows, or in a hand."""
        ...

    def move(self, X_SG: SE3) -> None:
        """Have the robot stand elsewhere, relative to where it stands."""
        ...

    def walk(self, stances: Sequence[Stance]) -> Forecast:
        """Walk to the first of some stances that a way leads to."""
        ...

    def walk_to_place(self, place: Place | None) -> Forecast:
        """Walk to a place; None: it is not known where to, which takes no time."""
        ...

    def pick(self, object_id: str, *, side: Side | None) -> Forecast:
        """Walk to where the planner would stand to take a thing, and have it in the hand."""
        ...

    def put(self, object_id: str, place: Place | None) -> Forecast:
        """Walk to where the planner would stand to put a thing down, and have it there."""
        ...

    def hand_over(self, object_id: str) -> None:
        """Have a thing out of the hand, with a person."""
        ...
