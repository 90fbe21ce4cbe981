"""Looking at Dynamixel servos from a workbench, as `robot.bringup.motor_tools` looks at CAN motors.

Nothing here enables a servo or moves a joint.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path

import msgspec
import numpy as np

from robot.bringup.motor_tools import (
    BY_HAND,
    LEAST_ANSWERED,
    SCALE_SLACK,
    Check,
    Line,
    Load,
    Reading,
    Seen,
    Watched,
)
from robot.clock import Clock
from robot.drivers.motors.dynamixel import control_table as table
from robot.drivers.motors.dynamixel import instructions, joint_map, load
from robot.drivers.motors.dynamixel.driver import DynamixelMotors
from robot.drivers.motors.dynamixel.interview import Answers, Finding, interview, verdicts
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.dynamixel.ports import SerialPorts, check_ports
from robot.drivers.motors.dynamixel.talking import WAITS_S, Talk

Servos = ServoMap
is_one = joint_map.is_one


def load_map(path: Path, channels: Mapping[str, str] | None = None) -> ServoMap:
    """A servo map, its ports at other devices where these are given.

    Raises:
        ConfigError: with everything that is wrong in it.
        DriverError: the user does not let robots open one of its ports.
    """
    found = joint_map.load(path)
    if channels is None:
        check_ports(found.ports)
        return found
    ports = {
        name: msgspec.structs.replace(port, device=channels[name])
        for name, port in found.ports.items()
    }
    return msgspec.structs.replace(found, ports=ports)


def loads(joints: ServoMap) -> tuple[Load, ...]:
    """How full its ports are."""
    return tuple(
        Load(
            bus=name, channel=port.device, joints=len(joints.on(name)), share=joints.load(name),
            most=load.MOST_LOAD,
        )
        for name, port in joints.ports.items()
    )  # fmt: skip


def scan(joints: ServoMap, clock: Clock, *, up_to: int) -> list[Seen]:
    """Ask every identifier of every port who it is, at the bit rate of the map.

    Raises:
        DriverError: if a port cannot be opened.
    """
    named = {(one.port, one.id): name for name, one in joints.joints.items()}
    seen: list[Seen] = []
    with SerialPorts(joints.ports) as ports:
        talk = Talk(ports, clock, joints)
        for number in range(min(up_to, 252) + 1):
            ping = dict.fromkeys(joints.ports, instructions.ping(number))
            wait_s = WAITS_S[1] if any((port, number) in named for port in ping) else WAITS_S[0]
            spoilt = {port: talk.receivers[port].crc_errors for port in ping}
            for port, heard in talk.ask(ping, dict.fromkeys(ping, 1), wait_s=wait_s).items():
                twice = talk.receivers[port].crc_errors > spoilt[port]
                if heard or twice:
                    firmware = heard[0].data[2] if heard and len(heard[0].data) == 3 else None
                    seen.append(
                        Seen(
                            bus=port, id=number, reply_id=number, replies=2 if twice else 1,
                            joint=named.get((port, number), ""), mode=None, version=firmware,
                            ranges=None,
                        )
                    )  # fmt: skip
    return sorted(seen, key=lambda one: (one.bus, one.id))


def read(joints: ServoMap, clock: Clock) -> list[Reading]:
    """What every servo says now, each asked once. Raises DriverError if a port is not there."""
    with SerialPorts(joints.ports) as ports:
        answers = interview(Talk(ports, clock, joints))
    return [_reading(name, joints, answers[name]) for name in joints.joints]


def _reading(name: str, joints: ServoMap, answer: Answers) -> Reading:
    one, q_rad, qd_rad_s = joints.joints[name], answer.position_rad, answer.velocity_rad_s
    if answer.settings is None or q_rad is None or qd_rad_s is None:
        return Reading(joint=name, bus=one.port, id=one.id, model=one.model, status="silent")
    errors = table.hardware_errors(answer.value(table.HARDWARE_ERROR))
    on = "enabled" if answer.value(table.TORQUE_ENABLE) else "disabled"
    decivolts = answer.measured(table.PRESENT_VOLTAGE)
    steps = answer.measured(table.PRESENT_CURRENT)
    return Reading(
        joint=name,
        bus=one.port,
        id=one.id,
        model=one.model,
        status=errors[0] if errors else on,
        q_rad=one.joint_rad(q_rad),
        qd_rad_s=one.sign * qd_rad_s / one.gear,
        tau_nm=None if steps is None else steps * one.nm_a_step,
        winding_c=answer.measured(table.PRESENT_TEMPERATURE),
        supply_v=None if decivolts is None else 0.1 * decivolts,
    )


def check(joints: ServoMap, clock: Clock, *, for_s: float) -> Check:
    """Compare servos with their map; then watch them for a while at the map's rate.

    Raises:
        DriverError: if a port cannot be opened, or went away.
    """
    with SerialPorts(joints.ports) as ports:
        found = verdicts(joints, interview(Talk(ports, clock, joints)))
    if any(finding.is_grave for finding in found):
        return _checked(joints, found)
    with DynamixelMotors(joints, clock, ports=lambda: SerialPorts(joints.ports)) as driver:
        lost, periods = driver.reception.lost, 0
        ends_s = clock.now_s() + for_s
        while clock.now_s() < ends_s:
            driver.read()
            periods += 1
        found += _moving(driver)
        asked = max(1, periods * len(joints.joints))
        answered = 1.0 - (driver.reception.lost - lost) / asked
        if answered < LEAST_ANSWERED:
            text = f"{1.0 - answered:.1%} of all answers came too late or not at all"
            cure = "look at cable and latency timer, for another program, a busy computer"
            found.append(Finding("all", "late", text, cure, is_grave=False))
        return _checked(joints, found, answered=answered, late=driver.late)


def _moving(driver: DynamixelMotors) -> Iterator[Finding]:
    """Whether speeds fit positions, of the joints that moved; what was said while they did."""
    speeds = driver.speeds
    for index, name in enumerate(driver.joints.joints):
        ratio = float(speeds.ratio[index])
        if math.isnan(ratio):
            text = "it did not move: its speed, sign and scale could not be compared"
            yield Finding(name, "not_moved", text, BY_HAND, is_grave=False)
        elif abs(ratio - 1.0) > SCALE_SLACK:
            text = f"its speed is {ratio:.2f} times that of its positions"
            yield Finding(name, "speed_mismatch", text, "is its gear right? is its belt slack?")
    for alarm in driver.alarms.on:
        if alarm.code != "speed_mismatch":
            yield Finding(alarm.who, alarm.code, alarm.cause, alarm.cure)


def _checked(
    joints: ServoMap, found: list[Finding], *, answered: float | None = None, late: int = 0
) -> Check:
    return Check(
        loads=loads(joints),
        joints=len(joints.joints),
        findings=tuple(Line(**one._asdict()) for one in found),
        answered=answered,
        late=late,
    )


def watch(joints: ServoMap, clock: Clock, *, every_s: float, for_s: float) -> Watched:
    """What all joints say, again and again, and what is wrong; read at the map's rate.

    Raises:
        DriverError: if a servo is not what the map says, or a port went away.
    """
    with DynamixelMotors(joints, clock, ports=lambda: SerialPorts(joints.ports)) as driver:
        ends_s = clock.now_s() + for_s
        while (now_s := clock.now_s()) < ends_s:
            state = driver.read()
            while clock.now_s() < now_s + every_s:
                state = driver.read()
            heard = driver.reception
            rows = [
                Reading(
                    joint=name,
                    bus=one.port,
                    id=one.id,
                    model=one.model,
                    status="alert" if heard.alerts[index] else "answers",
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
