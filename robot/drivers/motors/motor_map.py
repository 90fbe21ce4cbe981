"""What every joint map says, of whatever family: its common fields, how it is read and refused."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias, TypeVar

import msgspec

from robot.drivers.motors.linkage import Linkage
from robot.drivers.motors.mounting import Mounted, beyond, unlike
from robot.errors import ConfigError
from robot.files import config, yaml_nodes

WATCHDOG_PERIODS = 3
KP_MOST, KD_MOST = 500.0, 5.0
"""Of a motor whose family says nothing else: what frames of MIT mode can say at most."""

Wrong: TypeAlias = tuple[str, str, str]
"""A place in the file, what is wrong there, the cure."""


class Motor(Mounted, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The motor of one joint, as far as every family has it.

    Attributes:
        model: a row of the family's models.
        id: it listens for this (decimal).
    """

    model: str
    id: int

    @property
    def line(self) -> str:
        """The bus or port that it is on."""
        raise NotImplementedError

    @property
    def kp_most(self) -> float:
        """The stiffest that it is made, at the joint: N m/rad."""
        return KP_MOST * self.gear * self.gear

    @property
    def kd_most(self) -> float:
        """The most that it is damped, at the joint: N m s/rad."""
        return KD_MOST * self.gear * self.gear


class MotorMap(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """All motors of a robot, or of a part of one.

    Attributes:
        rate_hz: how often each is commanded.
        watchdog_s: a motor lets go after so long without a command.
        joints: by name, in the order of every array.
        file: where it was read, for people.
    """

    rate_hz: int
    watchdog_s: float
    joints: Mapping[str, Motor]
    file: str = ""

    @property
    def period_s(self) -> float:
        """Between two commands."""
        return 1.0 / self.rate_hz

    @property
    def channels(self) -> Mapping[str, str]:
        """Where its buses or ports are, by name."""
        raise NotImplementedError

    @property
    def linked(self) -> Mapping[str, str]:
        """The linkage of each joint that is in one."""
        return {one: name for name, found in linkages_of(self).items() for one in found.joints}

    def load(self, line: str) -> float:
        """The share of its time that a bus or port is busy."""
        raise NotImplementedError


class LinkedMap(MotorMap, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A map some of whose joints may be moved by several motors together (`MotorMap`).

    Attributes:
        linkages: by name: joints that their motors move together.
    """

    linkages: dict[str, Linkage] = msgspec.field(default_factory=dict[str, Linkage])


def linkages_of(found: MotorMap) -> Mapping[str, Linkage]:
    """Joints that their motors move together, by name."""
    return found.linkages if isinstance(found, LinkedMap) else {}


M = TypeVar("M", bound=MotorMap)


def read(
    path: Path | str,
    kind: type[M],
    *,
    begin_with: str,
    checks: Sequence[Callable[[M], Iterable[Wrong]]],
) -> M:
    """Read a map.

    Args:
        path: of the file.
        kind: of map.
        begin_with: a first line of such a file, for who left it empty.
        checks: say what cannot be meant.

    Raises:
        ConfigError: with everything that is wrong in it, each with its line and a cure.
    """
    node = yaml_nodes.read(path, begin_with=begin_with)
    found = msgspec.structs.replace(config.convert(node, kind), file=str(path))
    places = [wrong for check in checks for wrong in check(found)]
    if places:
        raise ConfigError([config.place(node, where).problem(*what) for where, *what in places])
    return found


def in_order(found: M, motors: Sequence[str]) -> M:
    """A map with its joints in the order of a robot's motors.

    Raises:
        ConfigError: if it lacks one of these, or has one that is not among them.
    """
    if problems := unlike(list(found.joints), motors, found.file):
        raise ConfigError(problems)
    return msgspec.structs.replace(found, joints={name: found.joints[name] for name in motors})


def of_robot(found: M, motors: Sequence[str]) -> M:
    """A map with its joints in a robot's motor order.

    Raises:
        ConfigError: if it has a joint that the robot has not, or lacks one that no other driver
            moves (`others`).
    """
    others = getattr(found, "others", "")
    return in_order(found, [one for one in motors if one in found.joints] if others else motors)


def nameless(found: MotorMap) -> Iterator[Wrong]:
    """A map without a joint."""
    if not found.joints:
        yield "$.joints", "no joint stands here", "name one, see docs/hardware.md"


def misnamed(
    name: str,
    joint: Motor,
    *,
    line: str,
    plural: str,
    lines: Collection[str],
    models: Collection[str],
) -> Iterator[Wrong]:
    """A bus, port or model that there is not.

    Args:
        name: of the joint.
        joint: of the map.
        line: what its family calls one, as in bus.
        plural: what it calls several of them.
        lines: that the map names.
        models: of the family.
    """
    where = f"$.joints.{name}"
    if joint.line not in lines:
        cure = config.nearest(joint.line, list(lines)) or f"add it to {plural}"
        yield f"{where}.{line}", f"there is no {line} {joint.line!r}", cure
    if joint.model not in models:
        cure = config.nearest(joint.model, list(models)) or f"one of {', '.join(models)}"
        yield f"{where}.model", f"unknown model {joint.model!r}", cure


def hasty(found: MotorMap) -> Iterator[Wrong]:
    """A watchdog that ends after one late period."""
    if found.watchdog_s < WATCHDOG_PERIODS * found.period_s:
        text = f"the watchdog ends after {found.watchdog_s * 1000:g} ms, a late period is enough"
        cure = f"at least {WATCHDOG_PERIODS} periods: {WATCHDOG_PERIODS * found.period_s:g}"
        yield "$.watchdog_s", text, cure


def upside_down(where: str, joint: Mounted) -> Iterator[Wrong]:
    """Limits of a joint that are no range."""
    if joint.lower_rad >= joint.upper_rad:
        yield f"{where}.lower_rad", "lower_rad is not below upper_rad", "exchange them"


def unmet(
    where: str,
    joint: Motor,
    *,
    most_rad: float,
    why: Callable[[float], str],
    speed_rad_s: float,
    torque_nm: float,
) -> Iterator[Wrong]:
    """Limits of a joint that are no range, or that its motor cannot meet.

    Args:
        where: the joint's place in the file.
        joint: of the map.
        most_rad: the farthest from its zero that the motor can be told to go.
        why: says of a motor's angle that it is farther.
        speed_rad_s: the fastest that the motor turns.
        torque_nm: the most that it gives.
    """
    if joint.lower_rad >= joint.upper_rad:
        yield from upside_down(where, joint)
        return
    for key, angle in (("lower_rad", joint.lower_rad), ("upper_rad", joint.upper_rad)):
        turned = joint.motor_rad(angle)
        if abs(turned) > most_rad:
            cure = "narrow the limit, or correct gear and offset_rad"
            yield f"{where}.{key}", why(turned), cure
    yield from beyond(where, joint, joint.model, speed_rad_s=speed_rad_s, torque_nm=torque_nm)
