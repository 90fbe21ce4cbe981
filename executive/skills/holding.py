"""What the hands hold, as far as the skills know: written by pick and place, read by all."""

from __future__ import annotations

import msgspec

from robot.messages import Side
from robot.planning.requests import Joints
from robot.se3 import SE3


class Held(msgspec.Struct, frozen=True, kw_only=True):
    """An object in a hand.

    Attributes:
        object_id: which one.
        side: in which hand.
        X_GO: the object in the grasp frame, as it sits between the fingers.
        gap_m: opening of the fingers around it.
        mass_kg: what the body was told it weighs.
        carry_rad: joints of the arm that carry it near the body, as upright as it stood.
        upright: whether it stood; what lay is turned upright when it is put down.
    """

    object_id: str
    side: Side
    X_GO: SE3
    gap_m: float
    mass_kg: float
    carry_rad: Joints
    upright: bool = True


class Holdings:
    """What each hand holds. One per mission, handed to every skill in its context."""

    def __init__(self) -> None:
        """Start with empty hands."""
        self._held: dict[Side, Held] = {}
        self._given: dict[str, str] = {}

    def take(self, held: Held) -> None:
        """A hand has closed on an object."""
        self._held[held.side] = held
        self._given.pop(held.object_id, None)

    def hand_over(self, side: Side, person_id: str) -> None:
        """A hand lets go of what somebody takes from it. May be repeated."""
        held = self._held.pop(side, None)
        if held is not None:
            self._given[held.object_id] = person_id

    def put_away(self, object_id: str) -> None:
        """Whoever was given an object has put it down somewhere."""
        self._given.pop(object_id, None)

    @property
    def given(self) -> dict[str, str]:
        """What somebody was given and has still, as far as is known: ids of thing and person."""
        return dict(self._given)

    def release(self, side: Side) -> None:
        """A hand has opened, or lost what it held. May be repeated."""
        self._held.pop(side, None)

    def at(self, side: Side) -> Held | None:
        """What a hand holds."""
        return self._held.get(side)

    def must_stay_upright(self, side: Side) -> bool:
        """Whether a hand holds something that must not be tilted."""
        held = self._held.get(side)
        return held is not None and held.upright

    def find(self, object_id: str) -> Held | None:
        """The hold on an object, None if no hand has it."""
        return next((held for held in self._held.values() if held.object_id == object_id), None)

    def all(self) -> tuple[Held, ...]:
        """Every hold, left hand first."""
        return tuple(sorted(self._held.values(), key=lambda held: held.side))

    def free_sides(self) -> tuple[Side, ...]:
        """The empty hands, right first: it is the one that things are usually taken with."""
        sides: tuple[Side, ...] = ("right", "left")
        return tuple(side for side in sides if side not in self._held)
