"""What `humanoid motors` does with motors on CAN, and with no others (`motor_families`)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from typing import NamedTuple

import msgspec

from robot.bringup.motor_family import AnyMotors
from robot.bringup.motor_reports import Reading, Seen, unless_nan
from robot.clock import Clock
from robot.drivers.motors.can.families import FAMILIES, Asking, Family
from robot.drivers.motors.can.interview import (
    Answers,
    by_settings,
    exchange,
    interview,
    read_registers,
)
from robot.drivers.motors.can.joint_map import SOCKETCAN, Bus, JointMap, JointMotor
from robot.drivers.motors.can.ports import Heard, Ports
from robot.drivers.motors.can.verdicts import told_by, verdicts
from robot.drivers.motors.findings import Finding
from robot.drivers.motors.motor_map import Motor
from robot.drivers.motors.transmission import Motion, joints_of

AT_ONCE = 32
"""Identifiers asked together: their replies take a bus 4 ms."""
DISABLED = "disabled"


def nameless(
    channels: Sequence[str], interface: str = SOCKETCAN, data_bitrate_hz: int = 0
) -> JointMap:
    """A map of CAN interfaces by their own names, in which no joint stands."""
    buses = {
        channel: Bus(channel=channel, interface=interface, data_bitrate_hz=data_bitrate_hz)
        for channel in channels
    }
    return JointMap(rate_hz=500, buses=buses, joints={})


def findings(ports: Ports, clock: Clock, joints: JointMap) -> list[Finding]:
    """What they say of themselves where the map says otherwise."""
    return verdicts(joints, interview(ports, clock, joints))


# --- scan --------------------------------------------------------------------------------------


def scan(ports: Ports, clock: Clock, joints: JointMap, up_to: int) -> list[Seen]:
    """Ask every identifier of every bus who it is, as each family that can be asked is."""
    seen: list[Seen] = []
    for family in dict.fromkeys(FAMILIES.values()):
        if family.asking is not None:
            last = min(up_to, family.most_id)
            seen += _scan(ports, clock, joints, _Asked(family, family.asking), last)
    return sorted(seen, key=lambda one: (one.bus, one.id))


class _Asked(NamedTuple):
    """A family that can be asked, and how."""

    family: Family
    asking: Asking


def _scan(ports: Ports, clock: Clock, joints: JointMap, asked: _Asked, up_to: int) -> list[Seen]:
    """Of one family."""
    settings, is_fd = asked.asking.settings, asked.family.fd is not None
    buses = [name for name, bus in joints.buses.items() if bus.is_fd == is_fd]
    mine = {name: one for name, one in joints.joints.items() if one.family is asked.family}
    named = {(one.bus, one.id): name for name, one in mine.items()}
    heard: dict[tuple[str, int], list[int]] = {}
    for first in range(1, up_to + 1, AT_ONCE):
        numbers = range(first, min(first + AT_ONCE, up_to + 1))
        _who(ports, clock, asked, [(bus, number) for bus in buses for number in numbers], heard)
    found = sorted(heard)
    for one_a_bus in _turns(found):  # two that say the same thing at once are heard as one
        again: dict[tuple[str, int], list[int]] = {}
        _who(ports, clock, asked, one_a_bus, again)
        heard.update(again)
    values: dict[tuple[str, int, int], float] = {}
    ranges = settings.ranges or ()
    for register in (*ranges, settings.mode, settings.version):
        if register is not None:
            values |= _values(ports, clock, asked.asking, found, register)
    return [
        Seen(
            bus=bus,
            id=number,
            reply_id=heard[bus, number][0],
            replies=len(heard[bus, number]),
            joint=named.get((bus, number), ""),
            mode=_whole(values.get((bus, number, settings.mode))),
            version=_whole(values.get((bus, number, settings.version or 0))),
            ranges=_ranges([values.get((bus, number, register)) for register in ranges]),
        )
        for bus, number in found
    ]


def _who(
    ports: Ports,
    clock: Clock,
    asked: _Asked,
    numbers: list[tuple[str, int]],
    heard: dict[tuple[str, int], list[int]],
) -> None:
    asking, register = asked.asking, asked.asking.settings.own_id

    def take(one: Heard) -> None:
        reply = None if one.frame is None else asking.reply(one.frame)
        if reply is not None and one.frame is not None and reply.register == register:
            under = reply.motor_id if asked.family.is_extended else one.frame.id
            heard.setdefault((one.bus, reply.motor_id), []).append(under)

    exchange(ports, clock, [(bus, asking.read(number, register)) for bus, number in numbers], take)


def _turns(found: list[tuple[str, int]]) -> list[list[tuple[str, int]]]:
    """One identifier of each bus at a time."""
    by_bus: dict[str, list[tuple[str, int]]] = {}
    for bus, number in found:
        by_bus.setdefault(bus, []).append((bus, number))
    return [[one for one in turn if one] for turn in zip_longest(*by_bus.values())]


def _values(
    ports: Ports, clock: Clock, asking: Asking, found: list[tuple[str, int]], register: int
) -> dict[tuple[str, int, int], float]:
    """What a register of each holds, by bus, identifier and register."""
    values: dict[tuple[str, int, int], float] = {}

    def take(one: Heard) -> None:
        reply = None if one.frame is None else asking.reply(one.frame)
        if reply is not None:
            values[one.bus, reply.motor_id, reply.register] = reply.value

    exchange(ports, clock, [(bus, asking.read(number, register)) for bus, number in found], take)
    return values


def _whole(value: float | None) -> int | None:
    return None if value is None else int(value)


def _ranges(values: list[float | None]) -> tuple[float, float, float] | None:
    told = [value for value in values if value is not None]
    return (told[0], told[1], told[2]) if len(told) == 3 else None


# --- read --------------------------------------------------------------------------------------


def readings(ports: Ports, clock: Clock, joints: JointMap) -> list[Reading]:
    """What every motor says now, each asked once."""
    answers = interview(ports, clock, joints)
    asked = {name: one for name, one in joints.joints.items() if answers[name].registers}
    for settings, some in by_settings(asked):
        read_registers(ports, clock, some, answers, settings.supply)
    found = joints_of(joints, told_by(joints, answers))
    return [_reading(name, joints, answers[name], found[name]) for name in joints.joints]


def _reading(name: str, joints: JointMap, answer: Answers, found: Motion) -> Reading:
    one, told = joints.joints[name], answer.feedback
    asking = one.family.asking
    if told is None:
        status = "silent" if asking else "cannot be asked"
        return Reading(joint=name, bus=one.bus, id=one.id, model=one.model, status=status)
    return Reading(
        joint=name,
        bus=one.bus,
        id=one.id,
        model=one.model,
        status=one.family.status(told.status).code,
        q_rad=unless_nan(found.q_rad),
        qd_rad_s=unless_nan(found.qd_rad_s),
        tau_nm=unless_nan(found.tau_nm),
        winding_c=told.winding_c,
        driver_c=told.driver_c,
        supply_v=None if asking is None else answer.registers.get(asking.settings.supply),
    )


# --- one joint ---------------------------------------------------------------------------------


def bare(joint: Motor) -> Motor:
    """The motor by its own angles, as far as its frames go."""
    assert isinstance(joint, JointMotor)
    most_rad = joint.expected.position_rad
    return msgspec.structs.replace(
        joint, sign=1, offset_rad=0.0, gear=1.0, lower_rad=-most_rad, upper_rad=most_rad
    )


def resting(driver: AnyMotors, _ports: Ports, _clock: Clock) -> str:
    """The status of the only joint's motor; "" where it is disabled."""
    status = driver.status_of(0)
    return "" if status == DISABLED else status


def set_zero(ports: Ports, clock: Clock, joints: JointMap, _at_rad: float) -> None:
    """Let the only joint's motor call this position zero."""
    (joint,) = joints.joints.values()
    exchange(ports, clock, [(joint.bus, joint.family.set_zero(joint.id))], lambda _: None)
