"""What can be done to a running world: pushes, things that move or vanish, senses that fail.

Faults are values; a benchmark, a test or a person sends one, the world suffers it
(`sim.faults`). They reach the robot through physics and sensors only. As plain data, in files and
at the prompt, a fault is a dict with its name under `fault`:
``{"fault": "push", "impulse_n_s": [0, 4, 0]}``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Literal, TypeAlias, get_args

import msgspec

from robot.bus.topics import Topic
from robot.errors import ConfigError, Problem
from robot.files import misfits
from robot.files import quantities as q
from robot.files.config import nearest
from robot.se3 import SE3


def _name(kind: str) -> str:
    """`StandInWay` to `stand_in_way`."""
    return "".join(f"_{c.lower()}" if c.isupper() else c for c in kind).lstrip("_")


class FaultRecord(
    msgspec.Struct, frozen=True, kw_only=True, tag=_name, tag_field="fault",
    forbid_unknown_fields=True,
):  # fmt: skip
    """What all faults have in common: their name in plain data. A fault begins when applied."""


class Push(FaultRecord, frozen=True, kw_only=True):
    """A force on the robot's torso, or on an object, a piece of furniture, or a body by name.

    `impulse_n_s` in the world's axes, spread evenly over `duration_s`. A push down on a held
    object pulls it out of the hand.
    """

    impulse_n_s: tuple[q.Impulse, q.Impulse, q.Impulse]
    target: str = "robot"
    duration_s: q.Span = 0.1


class Shove(FaultRecord, frozen=True, kw_only=True):
    """A level push on the robot's torso of `strength_n_s`, towards an angle from where it faces.

    0 degrees pushes it forwards, 90 to its left.
    """

    strength_n_s: q.Strength
    towards_deg: q.Heading = 0.0
    duration_s: q.Span = 0.1


class KnockOver(FaultRecord, frozen=True, kw_only=True):
    """An object is hit at its rim and goes over, towards an angle of the world."""

    target: str
    towards_deg: q.Heading = 0.0


class Move(FaultRecord, frozen=True, kw_only=True):
    """An object, a person or a movable piece of furniture is suddenly elsewhere, at rest.

    `X_WO` says where, or `by_m` how far from where it is.
    """

    target: str
    X_WO: SE3 | None = None
    by_m: tuple[q.Place, q.Place, q.Place] | None = None

    def __post_init__(self) -> None:
        """Check that there is one destination."""
        if (self.X_WO is None) == (self.by_m is None):
            raise ValueError("give exactly one of X_WO, by_m")


class Occupy(FaultRecord, frozen=True, kw_only=True):
    """Another object suddenly stands on a place, at `at_m` from the middle of it."""

    place: str
    target: str
    at_m: tuple[q.Place, q.Place] = (0.0, 0.0)


class StandInWay(FaultRecord, frozen=True, kw_only=True):
    """Somebody, or a chair, stands in the way for `duration_s`, then where it was again.

    That is before the robot, or at a point of the floor.
    """

    target: str
    ahead_m: q.Place = 0.9
    left_m: q.Place = 0.0
    at_m: tuple[q.Place, q.Place] | None = None
    duration_s: q.Span = math.inf


class Remove(FaultRecord, frozen=True, kw_only=True):
    """An object or a person is suddenly gone."""

    target: str


class Silence(FaultRecord, frozen=True, kw_only=True):
    """A sensor (`camera`), or one topic (`sensors/depth`), says nothing for `duration_s`."""

    topic: str
    duration_s: q.Span = math.inf


class Mislead(FaultRecord, frozen=True, kw_only=True):
    """The oracle's fixes of the robot's pose are off for `duration_s`."""

    by_m: tuple[q.Place, q.Place]
    by_deg: q.Heading = 0.0
    duration_s: q.Span = math.inf


class Kidnap(FaultRecord, frozen=True, kw_only=True):
    """The robot is suddenly elsewhere on the floor, in the same motion, and nothing tells it.

    It is at `at_m`, or `by_m` from where it was, in the world's axes, turned by `turn_deg`. What it
    has in its hands stays behind.
    """

    at_m: tuple[q.Place, q.Place] | None = None
    by_m: tuple[q.Place, q.Place] | None = None
    turn_deg: q.Heading = 0.0

    def __post_init__(self) -> None:
        """Check that there is one destination."""
        if (self.at_m is None) == (self.by_m is None):
            raise ValueError("give exactly one of at_m, by_m")


class CoverLidar(FaultRecord, frozen=True, kw_only=True):
    """Something covers the lidar: the beams of a sector come back empty for `duration_s`.

    The sector is `width_deg` wide about an angle from where the lidar faces; 0: it is taken off.
    """

    width_deg: q.Sector = 360.0
    towards_deg: q.Heading = 0.0
    duration_s: q.Span = math.inf


class OffsetImu(FaultRecord, frozen=True, kw_only=True):
    """From now on the IMU is off, in its own axes, besides its noise; all zero: as it was.

    `askew_deg` (roll, pitch, yaw) is how it is mounted against where it is said to be.
    """

    gyro_deg_s: tuple[q.GyroOffset, q.GyroOffset, q.GyroOffset] = (0.0, 0.0, 0.0)
    accel_m_s2: tuple[q.AccelerationOffset, q.AccelerationOffset, q.AccelerationOffset] = (
        0.0, 0.0, 0.0,
    )  # fmt: skip
    askew_deg: tuple[q.Askew, q.Askew, q.Askew] = (0.0, 0.0, 0.0)


ImuFault: TypeAlias = Literal["silent", "frozen", "no_numbers"]
"""How an IMU breaks: no reading comes, each is the same as the last, or none is a number."""


class BreakImu(FaultRecord, frozen=True, kw_only=True):
    """For `duration_s` the IMU is `silent`, `frozen` (new stamps, old numbers) or `no_numbers`."""

    how: ImuFault = "silent"
    duration_s: q.Span = math.inf


class Sill(FaultRecord, frozen=True, kw_only=True):
    """A sill, 6 cm deep and 1.2 m wide, lies across the way of the robot; of no height: it is gone.

    `round_bump`: only 12 cm wide, so that one foot steps on it and the other does not.
    """

    height_m: q.Step = 0.02
    ahead_m: q.Place = 0.6
    left_m: q.Place = 0.0
    round_bump: bool = False


class Slope(FaultRecord, frozen=True, kw_only=True):
    """From now on the whole floor rises towards an angle from where the robot faces."""

    rise_deg: q.Incline
    towards_deg: q.Heading = 0.0


class Load(FaultRecord, frozen=True, kw_only=True):
    """From now on the robot's torso weighs more (or less), which nobody tells it."""

    mass_kg: q.Burden


class Delay(FaultRecord, frozen=True, kw_only=True):
    """From now on motors do what they are told so much later; 0: at once."""

    delay_s: q.Lag


class Heat(FaultRecord, frozen=True, kw_only=True):
    """A motor's winding is suddenly that hot; it cools down as it does."""

    motor: str
    temperature_c: q.Heat


class Discharge(FaultRecord, frozen=True, kw_only=True):
    """The emulated battery is suddenly left with that part of its charge."""

    charge: q.Charge


class MotorOff(FaultRecord, frozen=True, kw_only=True):
    """One motor no longer obeys: it damps, whatever it is told (`off=False`: it obeys again)."""

    motor: str
    off: bool = True


class Kill(FaultRecord, frozen=True, kw_only=True):
    """A process dies. The runtime does this, not the plant."""

    process: Literal["controller", "perception"]


Fault = (
    Push | Shove | KnockOver | Move | Occupy | StandInWay | Remove | Silence | Mislead
    | Kidnap | CoverLidar | OffsetImu | BreakImu | Sill | Slope | Load | Delay | Heat | Discharge
    | MotorOff | Kill
)  # fmt: skip
KINDS: dict[str, type[FaultRecord]] = {_name(kind.__name__): kind for kind in get_args(Fault)}
"""Name to fault."""

FAULT: Topic[Fault] = Topic("sim/fault", Fault, None, "executive")
"""Carries faults to a world in another process."""


def parse(data: Mapping[str, Any]) -> Fault:
    """A fault out of plain data.

    Raises:
        ConfigError: if it is none, with everything that is wrong in it.
    """
    problems = wrong_in(data)
    if problems:
        raise ConfigError([problem for _, problem in problems])
    return msgspec.convert(dict(data), Fault)  # pyright: ignore[reportArgumentType, reportReturnType]


def wrong_in(
    data: Mapping[str, Any], kinds: Mapping[str, type[FaultRecord]] = KINDS
) -> list[tuple[str, Problem]]:
    """Everything wrong in the plain data of a fault, each with the key at which it stands."""
    name = str(data.get("fault", ""))
    if name not in kinds:
        text = f"unknown fault {name!r}" if name else "the key 'fault' is missing"
        return [("fault", Problem(text, suggestion=nearest(name, list(kinds))))]
    kind, what = kinds[name], f"the fault {name!r}"
    given = {key: value for key, value in data.items() if key != "fault"}
    found = wrong_fields(given, kind, what)
    if not found:
        try:
            msgspec.convert(dict(data), kind)
        except msgspec.ValidationError as error:  # what its `__post_init__` says
            found.append(("fault", Problem(f"{what}: {error}")))
    return found


def wrong_fields(
    data: Mapping[str, Any], kind: type[msgspec.Struct], what: str
) -> list[tuple[str, Problem]]:
    """Everything that keeps plain data from being of a kind, each with the key at which it stands.

    What is missing is said to stand at `fault`.

    Args:
        data: plain data.
        kind: the struct.
        what: it is, for people.
    """
    return [
        (
            str(one.path[0]) if one.path else "fault",
            Problem(f"{what}: {one.message}", suggestion=one.cure or None),
        )
        for one in misfits.misfits(dict(data), kind)
    ]


def check_name(name: str, valid: list[str], what: str) -> None:
    """Refuse a name that is not there. Raises ConfigError with the nearest one that is."""
    if name not in valid:
        raise ConfigError([Problem(f"unknown {what} {name!r}", suggestion=nearest(name, valid))])
