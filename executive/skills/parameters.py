"""What a skill is asked to do: grounded, typed, checked. Ids and numbers, never sentences."""

from __future__ import annotations

import math
from typing import Literal

import msgspec

from robot.messages import Side
from robot.se3 import SE3, Vector3

BalanceMode = Literal["stand", "get_up", "squat", "one_leg", "lean", "hold"]
GestureKind = Literal[
    "wave", "point", "nod", "shake_head", "bow",
    "raise_arm", "raise_left_arm", "raise_right_arm", "raise_both_arms",
]  # fmt: skip

MAX_DURATION_S = 600.0
MAX_DISPLACEMENT_M = 20.0
MAX_TURN_RAD = 4.0 * math.pi
MAX_TEXT = 1000


class Parameters(msgspec.Struct, frozen=True, kw_only=True, tag=True, forbid_unknown_fields=True):
    """Parameters of one skill. Building one checks it.

    Raises:
        ValueError: a number is out of range, or not exactly one of the alternatives is given.
    """


class FloorPose(msgspec.Struct, frozen=True, kw_only=True):
    """A stance X_WS on the floor; without a heading any will do."""

    x_m: float
    y_m: float
    yaw_rad: float | None = None


class Step(msgspec.Struct, frozen=True, kw_only=True):
    """A motion relative to where the robot stands: first turn, then walk."""

    forward_m: float = 0.0
    left_m: float = 0.0
    turn_rad: float = 0.0


class NavigateParams(Parameters, frozen=True, kw_only=True):
    """Walk somewhere: exactly one of a pose, a place of the map, an object or person, a step."""

    pose: FloorPose | None = None
    place_id: str | None = None
    person_id: str | None = None
    by: Step | None = None

    def __post_init__(self) -> None:
        """Check the numbers."""
        _exactly_one(self, "pose", "place_id", "person_id", "by")
        if self.pose is not None:
            _finite(self.pose.x_m, self.pose.y_m, self.pose.yaw_rad or 0.0)
        if self.by is not None:
            _within("forward_m", self.by.forward_m, MAX_DISPLACEMENT_M)
            _within("left_m", self.by.left_m, MAX_DISPLACEMENT_M)
            _within("turn_rad", self.by.turn_rad, MAX_TURN_RAD)


class PickParams(Parameters, frozen=True, kw_only=True):
    """Take an object; without a side the planner chooses the hand."""

    object_id: str
    side: Side | None = None


class PlaceParams(Parameters, frozen=True, kw_only=True):
    """Put what is held on a place of the map, or at an exact pose X_WO of its own."""

    object_id: str
    place_id: str | None = None
    X_WO: SE3 | None = None

    def __post_init__(self) -> None:
        """Check that there is one target."""
        _exactly_one(self, "place_id", "X_WO")
        if self.X_WO is not None:
            _finite(*self.X_WO.p)


class LookParams(Parameters, frozen=True, kw_only=True):
    """Turn the head towards an object, a place, a person or a point p_W, or to all sides."""

    object_id: str | None = None
    place_id: str | None = None
    person_id: str | None = None
    p_W: Vector3 | None = None
    around: Literal[True] | None = None

    def __post_init__(self) -> None:
        """Check that there is one target."""
        _exactly_one(self, "object_id", "place_id", "person_id", "p_W", "around")
        if self.p_W is not None:
            _finite(*self.p_W)


class SearchParams(Parameters, frozen=True, kw_only=True):
    """Look for an object: here, where it was last, then at each of the places (none: all)."""

    object_id: str
    place_ids: tuple[str, ...] = ()


class BalanceParams(Parameters, frozen=True, kw_only=True):
    """Take a posture and hold it. To stand, only "get_up" leaves the floor if the robot lies there.

    `side` is the leg stood on, or with "lean" the side leant to; a lean without one is forward.
    """

    mode: BalanceMode
    side: Literal["left", "right", "forward", "backward"] | None = None
    duration_s: float = 3.0

    def __post_init__(self) -> None:
        """Check the span and the side."""
        if not 0.0 <= self.duration_s <= MAX_DURATION_S:
            raise ValueError(f"duration_s must be 0 to {MAX_DURATION_S:g}, not {self.duration_s}")
        if self.mode == "one_leg" and self.side not in (None, "left", "right"):
            raise ValueError(f"a leg is left or right, not {self.side}")


class GiveParams(Parameters, frozen=True, kw_only=True):
    """Hand what is held to a person."""

    object_id: str
    person_id: str


class FollowParams(Parameters, frozen=True, kw_only=True):
    """Walk behind a person, until they stop or, if one is given, until they are at a place."""

    person_id: str
    place_id: str | None = None


class GestureParams(Parameters, frozen=True, kw_only=True):
    """Make a sign, towards an object, a place or a person if one is given."""

    kind: GestureKind
    object_id: str | None = None
    place_id: str | None = None
    person_id: str | None = None

    def __post_init__(self) -> None:
        """Check that there is at most one target, and one to point at."""
        targets = [self.object_id, self.place_id, self.person_id]
        given = sum(target is not None for target in targets)
        if given > 1 or (self.kind == "point" and not given):
            raise ValueError(f"a gesture ({self.kind}) is towards one thing, not {given}")


class SayParams(Parameters, frozen=True, kw_only=True):
    """Say a text."""

    text: str

    def __post_init__(self) -> None:
        """Check the length."""
        if len(self.text) > MAX_TEXT:
            raise ValueError(f"text of {len(self.text)} characters: at most {MAX_TEXT}")


class WaitParams(Parameters, frozen=True, kw_only=True):
    """Do nothing for a while; without a duration until stopped."""

    duration_s: float | None = None

    def __post_init__(self) -> None:
        """Check the span."""
        if self.duration_s is not None and not 0.0 <= self.duration_s <= MAX_DURATION_S:
            raise ValueError(f"duration_s must be 0 to {MAX_DURATION_S:g}, not {self.duration_s}")


class StopParams(Parameters, frozen=True, kw_only=True):
    """Come to rest: finish the step, stand, hold the arms where they are."""


SkillParams = (
    NavigateParams
    | PickParams
    | PlaceParams
    | LookParams
    | SearchParams
    | BalanceParams
    | GiveParams
    | FollowParams
    | GestureParams
    | SayParams
    | WaitParams
    | StopParams
)


def _exactly_one(parameters: Parameters, *names: str) -> None:
    given = [name for name in names if getattr(parameters, name) is not None]
    if len(given) != 1:
        raise ValueError(f"give exactly one of {', '.join(names)} (given: {given or 'none'})")


def _finite(*values: float) -> None:
    if not all(math.isfinite(value) for value in values):
        raise ValueError(f"not a finite number among {values}")


def _within(name: str, value: float, limit: float) -> None:
    if not -limit <= value <= limit:
        raise ValueError(f"{name} must be {-limit:g} to {limit:g}, not {value}")
