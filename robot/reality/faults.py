"""What can be done to a running world: pushes, things that move or vanish, senses that fail.

Faults are values; a benchmark, a test or a person sends one, the world suffers it
(`sim.faults`). They reach the robot through physics and sensors only. As plain data, in files and
at the prompt, a fault is a dict with its name under `fault`:
``{"fault": "push", "impulse_n_s": [0, 4, 0]}``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal, TypeAlias, get_args

import msgspec
from msgspec import Meta

from robot.bus.topics import Topic
from robot.config import nearest
from robot.errors import ConfigError, Problem
from robot.se3 import SE3
from robot.type_words import in_words, shown

MAX_IMPULSE_N_S = 1000.0
"""A car that hits the robot at 70 km/h."""
MAX_AWAY_M = 1000.0
Impulse: TypeAlias = Annotated[float, Meta(ge=-MAX_IMPULSE_N_S, le=MAX_IMPULSE_N_S)]
Distance: TypeAlias = Annotated[float, Meta(ge=-MAX_AWAY_M, le=MAX_AWAY_M)]
Near: TypeAlias = Annotated[float, Meta(ge=-10.0, le=10.0)]
Angle: TypeAlias = Annotated[float, Meta(ge=-720.0, le=720.0)]
Span: TypeAlias = Annotated[float, Meta(gt=0.0)]
Moment: TypeAlias = Annotated[float, Meta(ge=0.001, le=60.0)]
"""At least a step of the physics."""


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

    impulse_n_s: tuple[Impulse, Impulse, Impulse]
    target: str = "robot"
    duration_s: Moment = 0.1


class Shove(FaultRecord, frozen=True, kw_only=True):
    """A level push on the robot's torso of `strength_n_s`, towards an angle from where it faces.

    0 degrees pushes it forwards, 90 to its left.
    """

    strength_n_s: Annotated[float, Meta(ge=0.0, le=MAX_IMPULSE_N_S)]
    towards_deg: Angle = 0.0
    duration_s: Moment = 0.1


class KnockOver(FaultRecord, frozen=True, kw_only=True):
    """An object is hit at its rim and goes over, towards an angle of the world."""

    target: str
    towards_deg: Angle = 0.0


class Move(FaultRecord, frozen=True, kw_only=True):
    """An object, a person or a movable piece of furniture is suddenly elsewhere, at rest.

    `X_WO` says where, or `by_m` how far from where it is.
    """

    target: str
    X_WO: SE3 | None = None
    by_m: tuple[Distance, Distance, Distance] | None = None

    def __post_init__(self) -> None:
        """Check that there is one destination."""
        if (self.X_WO is None) == (self.by_m is None):
            raise ValueError("give exactly one of X_WO, by_m")


class Occupy(FaultRecord, frozen=True, kw_only=True):
    """Another object suddenly stands on a place, at `at_m` from the middle of it."""

    place: str
    target: str
    at_m: tuple[Near, Near] = (0.0, 0.0)


class StandInWay(FaultRecord, frozen=True, kw_only=True):
    """Somebody, or a chair, stands in the way for `duration_s`, then where it was again.

    That is before the robot, or at a point of the floor.
    """

    target: str
    ahead_m: Near = 0.9
    left_m: Near = 0.0
    at_m: tuple[Distance, Distance] | None = None
    duration_s: Span = math.inf


class Remove(FaultRecord, frozen=True, kw_only=True):
    """An object or a person is suddenly gone."""

    target: str


class Silence(FaultRecord, frozen=True, kw_only=True):
    """A sensor (`camera`), or one topic (`sensors/depth`), says nothing for `duration_s`."""

    topic: str
    duration_s: Span = math.inf


class Mislead(FaultRecord, frozen=True, kw_only=True):
    """The oracle's fixes of the robot's pose are off for `duration_s`."""

    by_m: tuple[Distance, Distance]
    by_deg: Angle = 0.0
    duration_s: Span = math.inf


class Heat(FaultRecord, frozen=True, kw_only=True):
    """A motor's winding is suddenly that hot; it cools down as it does."""

    motor: str
    temperature_c: Annotated[float, Meta(ge=-50.0, le=300.0)]


class Discharge(FaultRecord, frozen=True, kw_only=True):
    """The emulated battery is suddenly left with that part of its charge."""

    charge: Annotated[float, Meta(ge=0.0, le=1.0)]

    def __post_init__(self) -> None:
        """Check the range."""
        if not 0.0 <= self.charge <= 1.0:
            raise ValueError(f"charge is a part, 0 to 1, not {self.charge}")


class MotorOff(FaultRecord, frozen=True, kw_only=True):
    """One motor no longer obeys: it damps, whatever it is told (`off=False`: it obeys again)."""

    motor: str
    off: bool = True


class Kill(FaultRecord, frozen=True, kw_only=True):
    """A process dies. The runtime does this, not the plant."""

    process: Literal["controller", "perception"]


Fault = (
    Push | Shove | KnockOver | Move | Occupy | StandInWay | Remove | Silence | Mislead | Heat
    | Discharge | MotorOff | Kill
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
    """Every key that a struct does not have, or lacks, and every value that does not fit.

    Args:
        data: plain data.
        kind: the struct.
        what: it is, for people.
    """
    infos = {one.encode_name: one.type for one in _info(kind).fields}
    fields = {one.encode_name: one for one in msgspec.structs.fields(kind)}
    found: list[tuple[str, Problem]] = []
    for key, value in data.items():
        if key not in fields:
            text = f"unknown key of {what}: {key!r}"
            found.append((key, Problem(text, suggestion=nearest(key, list(fields)))))
        elif not _fits(value, fields[key].type):
            text = f"{key} of {what} should be {in_words(infos[key])}, not {shown(value)}"
            found.append((key, Problem(text)))
    for key, field in fields.items():
        if field.required and key not in data:
            cure = f"{key} is {in_words(infos[key])}"
            found.append(("fault", Problem(f"{what} needs the key {key!r}", suggestion=cure)))
    return found


def _info(kind: type[msgspec.Struct]) -> msgspec.inspect.StructType:
    info = msgspec.inspect.type_info(kind)
    assert isinstance(info, msgspec.inspect.StructType)
    return info


def _fits(value: object, kind: Any) -> bool:
    try:
        msgspec.convert(value, kind)
    except msgspec.ValidationError:
        return False
    return True


def check_name(name: str, valid: list[str], what: str) -> None:
    """Refuse a name that is not there. Raises ConfigError with the nearest one that is."""
    if name not in valid:
        raise ConfigError([Problem(f"unknown {what} {name!r}", suggestion=nearest(name, valid))])
