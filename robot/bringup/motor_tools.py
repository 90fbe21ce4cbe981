"""Looking at motors from a workbench: who is there, what they say, whether it is what the map says.

Nothing here enables a motor or moves a joint. What families differ in is in `motor_families`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TypeAlias

import numpy as np

from robot.bringup import motor_families
from robot.bringup.motor_family import AnyMotors
from robot.bringup.motor_reports import Check, Line, Load, Reading, Seen, Watched
from robot.clock import Clock
from robot.drivers.motors.findings import Finding
from robot.drivers.motors.motor_map import MotorMap
from robot.errors import ConfigError, Problem
from robot.model import description

Joints: TypeAlias = MotorMap

BY_HAND = "turn the joint by hand while this runs (--for 10)"
LEAST_ANSWERED = 0.999
SCALE_SLACK = 0.25


def map_path(robot: str, file: Path | None) -> Path:
    """The joint map that is meant: a file, or the one beside a robot's description.

    Raises:
        ConfigError: there is no such robot, or it has no joint map.
    """
    if file is not None:
        return file
    found = description.load(robot).path().with_name(motor_families.FAMILIES[0].of.file)
    if not found.exists():
        text = f"{robot!r} has no joint map: {found} is not there"
        cure = "write it (docs/hardware.md), or name another with --map"
        raise ConfigError([Problem(text, suggestion=cure)])
    return found


def load_map(path: Path, channels: Mapping[str, str] | None = None) -> MotorMap:
    """A joint map, its lines where a simulation has them if these are given.

    Raises:
        ConfigError: with everything that is wrong in it.
        DriverError: the user does not let robots open one of its lines.
    """
    family = motor_families.of_file(path)
    found = family.of.load(path)
    if channels is None:
        family.of.check_user(found)
        return found
    return family.of.elsewhere(found, channels)


def loads(joints: MotorMap) -> tuple[Load, ...]:
    """How full its lines are."""
    most = motor_families.of(joints).most_load
    served = [one.line for one in joints.joints.values()]
    return tuple(
        Load(bus=name, channel=at, joints=served.count(name), share=joints.load(name), most=most)
        for name, at in joints.channels.items()
    )


def scan(joints: MotorMap, clock: Clock, *, up_to: int) -> list[Seen]:
    """Ask every identifier of every line who it is.

    Raises:
        DriverError: if a line cannot be opened.
    """
    family = motor_families.of(joints)
    with family.of.ports(joints, clock) as ports:
        return family.tools.scan(ports, clock, joints, up_to)


def read(joints: MotorMap, clock: Clock) -> list[Reading]:
    """What every motor says now, each asked once. Raises DriverError if a line is not there."""
    family = motor_families.of(joints)
    with family.of.ports(joints, clock) as ports:
        return family.tools.readings(ports, clock, joints)


# --- check -------------------------------------------------------------------------------------


def check(joints: MotorMap, clock: Clock, *, for_s: float) -> Check:
    """Compare motors with their map; then watch them for a while at the map's rate.

    Raises:
        DriverError: if a line cannot be opened, or went away.
    """
    family = motor_families.of(joints)
    with family.of.ports(joints, clock) as ports:
        found = family.tools.findings(ports, clock, joints)
    if any(finding.is_grave for finding in found):
        return _checked(joints, found)
    with driver_of(joints, clock) as driver:
        lost, periods = driver.reception.lost, 0
        ends_s = clock.now_s() + for_s
        while clock.now_s() < ends_s:
            driver.read()
            periods += 1
        if not family.measures:
            return _checked(joints, found, late=driver.late)
        found += _moving(driver, family.speed_cure)
        asked = max(1, periods * len(joints.joints))
        answered = 1.0 - (driver.reception.lost - lost) / asked
        if answered < LEAST_ANSWERED:
            text = f"{1.0 - answered:.1%} of all replies came too late or not at all"
            found.append(Finding("all", "late", text, family.late_cure, is_grave=False))
        return _checked(joints, found, answered=answered, late=driver.late)


def driver_of(joints: MotorMap, clock: Clock) -> AnyMotors:
    """A driver of a map's motors, over its own lines."""
    family = motor_families.of(joints)
    return family.of.motors(joints, clock, ports=lambda: family.of.ports(joints, clock))


def _moving(driver: AnyMotors, speed_cure: str) -> Iterator[Finding]:
    """Whether speeds fit positions, of the joints that moved; what was said while they did."""
    speeds = driver.speeds
    for index, name in enumerate(driver.joints.joints):
        ratio = float(speeds.ratio[index])
        if math.isnan(ratio):
            text = "it did not move: its speed, sign and scale could not be compared"
            yield Finding(name, "not_moved", text, BY_HAND, is_grave=False)
        elif abs(ratio - 1.0) > SCALE_SLACK:
            text = f"its speed is {ratio:.2f} times that of its positions"
            yield Finding(name, "speed_mismatch", text, speed_cure)
    for alarm in driver.alarms.on:
        if alarm.code != "speed_mismatch":
            yield Finding(alarm.who, alarm.code, alarm.cause, alarm.cure)


def _checked(
    joints: MotorMap, found: list[Finding], *, answered: float | None = None, late: int = 0
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


def watch(joints: MotorMap, clock: Clock, *, every_s: float, for_s: float) -> Watched:
    """What all joints say, again and again, and what is wrong; read at the map's rate.

    Raises:
        DriverError: if a motor is not what the map says, or a line went away.
    """
    with driver_of(joints, clock) as driver:
        ends_s = clock.now_s() + for_s
        while (now_s := clock.now_s()) < ends_s:
            state = driver.read()
            while clock.now_s() < now_s + every_s:
                state = driver.read()
            rows = [
                Reading(
                    joint=name,
                    bus=one.line,
                    id=one.id,
                    model=one.model,
                    status=driver.status_of(index),
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
