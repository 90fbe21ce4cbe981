"""Looking at motors from a workbench: who is there, what they say, whether it is what the map says.

Nothing here enables a motor or moves a joint.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import TypeAlias

import msgspec
import numpy as np

from robot.clock import Clock
from robot.drivers.motors.can import joint_map
from robot.drivers.motors.can.driver import CanMotors
from robot.drivers.motors.can.interview import Answers, exchange, interview, read_registers
from robot.drivers.motors.can.joint_map import Bus, JointMap
from robot.drivers.motors.can.load import MOST_LOAD
from robot.drivers.motors.can.mit11 import (
    MODE,
    OWN_ID,
    SUPPLY,
    VERSION,
    read_register,
    register_reply,
)
from robot.drivers.motors.can.ports import Heard, Ports, PythonCan, check_buses
from robot.drivers.motors.can.verdicts import Finding, verdicts
from robot.errors import ConfigError, Problem
from robot.model import description

Buses: TypeAlias = Mapping[str, Bus]
Joints: TypeAlias = JointMap

BY_HAND = "turn the joint by hand while this runs (--for 10)"
LEAST_ANSWERED = 0.999
SCALE_SLACK = 0.25
AT_ONCE = 32
"""Identifiers asked together: their replies take a bus 4 ms."""


class Seen(msgspec.Struct, frozen=True, kw_only=True):
    """A motor that answered a scan.

    Attributes:
        bus: where.
        id: it listens for this.
        reply_id: it answers under this.
        replies: how many answered to that identifier.
        joint: whose motor the map says it is; "" if nobody's.
        mode, version: registers; None if it did not tell.
        ranges: what its largest numbers stand for: rad, rad/s, N m.
    """

    bus: str
    id: int
    reply_id: int
    replies: int
    joint: str
    mode: int | None
    version: int | None
    ranges: tuple[float, float, float] | None


class Reading(msgspec.Struct, frozen=True, kw_only=True):
    """What one joint's motor says, at the joint; None where it did not tell."""

    joint: str
    bus: str
    id: int
    model: str
    status: str
    q_rad: float | None = None
    qd_rad_s: float | None = None
    tau_nm: float | None = None
    winding_c: float | None = None
    driver_c: float | None = None
    supply_v: float | None = None
    age_ms: float | None = None


class Load(msgspec.Struct, frozen=True, kw_only=True):
    """How full a bus is at the map's rate, with the most stuffing; at most `most` is safe."""

    bus: str
    channel: str
    joints: int
    share: float
    most: float = MOST_LOAD


class Line(msgspec.Struct, frozen=True, kw_only=True):
    """One finding of a check; `is_grave`: nothing may be enabled."""

    joint: str
    code: str
    text: str
    cure: str
    is_grave: bool


class Check(msgspec.Struct, frozen=True, kw_only=True):
    """What came of a check.

    Attributes:
        loads: of the buses.
        joints: how many were asked.
        findings: all that disagrees or could not be told.
        answered: share of the periods' questions that were answered in their period; None: nobody
            was asked that often, as something grave was found before.
        late: periods that began late by more than one.
    """

    loads: tuple[Load, ...]
    joints: int
    findings: tuple[Line, ...]
    answered: float | None = None
    late: int = 0

    @property
    def is_grave(self) -> bool:
        """Whether nothing may be enabled."""
        return any(finding.is_grave for finding in self.findings)


Watched: TypeAlias = Iterator[tuple[list[Reading], tuple[str, ...]]]
"""What joints say, and what is wrong."""


def buses_at(channels: Sequence[str], interface: str) -> Buses:
    """CAN interfaces by their own names."""
    return {channel: Bus(channel=channel, interface=interface) for channel in channels}


def map_path(robot: str, file: Path | None) -> Path:
    """The joint map that is meant: a file, or the one beside a robot's description.

    Raises:
        ConfigError: there is no such robot, or it has no joint map.
    """
    if file is not None:
        return file
    found = description.load(robot).path().with_name(joint_map.FILE)
    if not found.exists():
        text = f"{robot!r} has no joint map: {found} is not there"
        cure = "write it (docs/hardware.md), or name another with --map"
        raise ConfigError([Problem(text, suggestion=cure)])
    return found


def load_map(path: Path, channels: Mapping[str, str] | None = None, *, by: str = "") -> JointMap:
    """A joint map, its buses at other channels where these are given (of the interface `by`).

    Raises:
        ConfigError: with everything that is wrong in it.
        DriverError: the user does not let robots open one of its buses.
    """
    found = joint_map.load(path)
    if channels is None:
        check_buses(found.buses)
        return found
    buses = {name: Bus(channel=channels[name], interface=by) for name in found.buses}
    return msgspec.structs.replace(found, buses=buses)


def loads(joints: JointMap) -> tuple[Load, ...]:
    """How full its buses are."""
    return tuple(
        Load(bus=name, channel=bus.channel, joints=len(joints.on(name)), share=joints.load(name))
        for name, bus in joints.buses.items()
    )


# --- scan --------------------------------------------------------------------------------------


def scan(
    buses: Mapping[str, Bus], clock: Clock, *, up_to: int, joints: JointMap | None = None
) -> list[Seen]:
    """Ask every identifier of every bus who it is; of Damiao's motors.

    Raises:
        DriverError: if a bus cannot be opened.
    """
    named = {} if joints is None else {(o.bus, o.id): name for name, o in joints.joints.items()}
    with PythonCan(buses, clock) as ports:
        heard: dict[tuple[str, int], list[int]] = {}
        for first in range(1, up_to + 1, AT_ONCE):
            numbers = range(first, min(first + AT_ONCE, up_to + 1))
            _who(ports, clock, [(bus, number) for bus in buses for number in numbers], heard)
        found = sorted(heard)
        for one_a_bus in _turns(found):  # two that say the same thing at once are heard as one
            again: dict[tuple[str, int], list[int]] = {}
            _who(ports, clock, one_a_bus, again)
            heard.update(again)
        values: dict[tuple[str, int, int], float] = {}
        for register in (21, 22, 23, MODE, VERSION):
            _values(ports, clock, found, register, values)
    return [
        Seen(
            bus=bus,
            id=number,
            reply_id=heard[bus, number][0],
            replies=len(heard[bus, number]),
            joint=named.get((bus, number), ""),
            mode=_whole(values.get((bus, number, MODE))),
            version=_whole(values.get((bus, number, VERSION))),
            ranges=_ranges([values.get((bus, number, register)) for register in (21, 22, 23)]),
        )
        for bus, number in found
    ]


def _who(
    ports: Ports,
    clock: Clock,
    asked: list[tuple[str, int]],
    heard: dict[tuple[str, int], list[int]],
) -> None:
    def take(one: Heard) -> None:
        reply = None if one.frame is None else register_reply(one.frame.data)
        if reply is not None and one.frame is not None and reply.register == OWN_ID:
            heard.setdefault((one.bus, reply.motor_id), []).append(one.frame.id)

    exchange(ports, clock, [(bus, read_register(number, OWN_ID)) for bus, number in asked], take)


def _turns(found: list[tuple[str, int]]) -> list[list[tuple[str, int]]]:
    """One identifier of each bus at a time."""
    by_bus: dict[str, list[tuple[str, int]]] = {}
    for bus, number in found:
        by_bus.setdefault(bus, []).append((bus, number))
    return [[one for one in turn if one] for turn in zip_longest(*by_bus.values())]


def _values(
    ports: Ports,
    clock: Clock,
    asked: list[tuple[str, int]],
    register: int,
    values: dict[tuple[str, int, int], float],
) -> None:
    def take(one: Heard) -> None:
        reply = None if one.frame is None else register_reply(one.frame.data)
        if reply is not None:
            values[one.bus, reply.motor_id, reply.register] = reply.value

    exchange(ports, clock, [(bus, read_register(number, register)) for bus, number in asked], take)


def _whole(value: float | None) -> int | None:
    return None if value is None else int(value)


def _ranges(values: list[float | None]) -> tuple[float, float, float] | None:
    told = [value for value in values if value is not None]
    return (told[0], told[1], told[2]) if len(told) == 3 else None


# --- read --------------------------------------------------------------------------------------


def read(joints: JointMap, clock: Clock) -> list[Reading]:
    """What every motor says now, each asked once. Raises DriverError if a bus is not there."""
    with PythonCan(joints.buses, clock) as ports:
        answers = interview(ports, clock, joints)
        asked = {name: one for name, one in joints.joints.items() if answers[name].registers}
        if asked:
            read_registers(ports, clock, asked, answers, SUPPLY)
    return [_reading(name, joints, answers[name]) for name in joints.joints]


def _reading(name: str, joints: JointMap, answer: Answers) -> Reading:
    one, told = joints.joints[name], answer.feedback
    if told is None:
        status = "silent" if one.family.asking else "cannot be asked"
        return Reading(joint=name, bus=one.bus, id=one.id, model=one.model, status=status)
    return Reading(
        joint=name,
        bus=one.bus,
        id=one.id,
        model=one.model,
        status=one.family.status(told.status).code,
        q_rad=one.joint_rad(told.q_rad),
        qd_rad_s=one.sign * told.qd_rad_s / one.gear,
        tau_nm=one.sign * told.tau_nm * one.gear,
        winding_c=told.winding_c,
        driver_c=told.driver_c,
        supply_v=answer.registers.get(SUPPLY),
    )


# --- check -------------------------------------------------------------------------------------


def check(joints: JointMap, clock: Clock, *, for_s: float) -> Check:
    """Compare motors with their map; then watch them for a while at the map's rate.

    Raises:
        DriverError: if a bus cannot be opened, or went away.
    """
    with PythonCan(joints.buses, clock) as ports:
        found = verdicts(joints, interview(ports, clock, joints))
    if any(finding.is_grave for finding in found):
        return _checked(joints, found)
    with CanMotors(joints, clock, ports=lambda: PythonCan(joints.buses, clock)) as driver:
        lost, periods = driver.reception.lost, 0
        ends_s = clock.now_s() + for_s
        while clock.now_s() < ends_s:
            driver.read()
            periods += 1
        found += _moving(driver)
        asked = max(1, periods * len(joints.joints))
        answered = 1.0 - (driver.reception.lost - lost) / asked
        if answered < LEAST_ANSWERED:
            text = f"{1.0 - answered:.1%} of all replies came too late or not at all"
            cure = "look for bus errors (ip -s link show), another program, a busy computer"
            found.append(Finding("all", "late", text, cure, is_grave=False))
        return _checked(joints, found, answered=answered, late=driver.late)


def _moving(driver: CanMotors) -> Iterator[Finding]:
    """Whether speeds fit positions, of the joints that moved; what was said while they did."""
    speeds = driver.speeds
    for index, name in enumerate(driver.joints.joints):
        ratio = float(speeds.ratio[index])
        if math.isnan(ratio):
            text = "it did not move: its speed, sign and scale could not be compared"
            yield Finding(name, "not_moved", text, BY_HAND, is_grave=False)
        elif abs(ratio - 1.0) > SCALE_SLACK:
            text = f"its speed is {ratio:.2f} times that of its positions"
            cure = "correct its velocity range (register 22); is its gear right?"
            yield Finding(name, "speed_mismatch", text, cure)
    for alarm in driver.alarms.on:
        if alarm.code != "speed_mismatch":
            yield Finding(alarm.who, alarm.code, alarm.cause, alarm.cure)


def _checked(
    joints: JointMap, found: list[Finding], *, answered: float | None = None, late: int = 0
) -> Check:
    lines = (Line(**one._asdict()) for one in found)
    return Check(
        loads=loads(joints),
        joints=len(joints.joints),
        findings=tuple(lines),
        answered=answered,
        late=late,
    )


# --- watch -------------------------------------------------------------------------------------


def watch(joints: JointMap, clock: Clock, *, every_s: float, for_s: float) -> Watched:
    """What all joints say, again and again, and what is wrong; read at the map's rate.

    Raises:
        DriverError: if a motor is not what the map says, or a bus went away.
    """
    with CanMotors(joints, clock, ports=lambda: PythonCan(joints.buses, clock)) as driver:
        ends_s = clock.now_s() + for_s
        while (now_s := clock.now_s()) < ends_s:
            state = driver.read()
            while clock.now_s() < now_s + every_s:
                state = driver.read()
            rows = [
                Reading(
                    joint=name,
                    bus=one.bus,
                    id=one.id,
                    model=one.model,
                    status=one.family.status(driver.reception.status[index]).code,
                    q_rad=float(state.q[index]),
                    qd_rad_s=float(state.qd[index]),
                    tau_nm=float(state.tau[index]),
                    winding_c=_or_none(float(state.temperature_c[index])),
                    age_ms=_or_none(1000.0 * float(state.age_s[index])),
                )
                for index, (name, one) in enumerate(joints.joints.items())
            ]
            yield rows, tuple(map(str, driver.alarms.on))


def _or_none(value: float) -> float | None:
    return value if np.isfinite(value) else None
