"""What `humanoid motors` does with Dynamixel servos, and with no others (`motor_families`)."""

from __future__ import annotations

import math

import msgspec

from robot.bringup.motor_family import AnyMotors
from robot.bringup.motor_reports import Reading, Seen
from robot.clock import Clock
from robot.drivers.motors.dynamixel import arming, instructions
from robot.drivers.motors.dynamixel import control_table as table
from robot.drivers.motors.dynamixel.driver import DynamixelMotors
from robot.drivers.motors.dynamixel.interview import MIDDLE, Answers, interview, verdicts
from robot.drivers.motors.dynamixel.joint_map import JointServo, ServoMap
from robot.drivers.motors.dynamixel.models import RAD_A_PULSE
from robot.drivers.motors.dynamixel.ports import Ports
from robot.drivers.motors.dynamixel.talking import WAITS_S, Talk
from robot.drivers.motors.findings import Finding
from robot.drivers.motors.motor_map import Motor
from robot.errors import DriverError

TURN = 4096
"""Pulses: without power a servo forgets how many turns it made."""
MOST_TURNS = 256
"""Either way, that a servo tells."""


def findings(ports: Ports, clock: Clock, joints: ServoMap) -> list[Finding]:
    """What they say of themselves where the map says otherwise."""
    return verdicts(joints, interview(Talk(ports, clock, joints)))


def scan(ports: Ports, clock: Clock, joints: ServoMap, up_to: int) -> list[Seen]:
    """Ask every identifier of every port who it is, at the bit rate of the map."""
    named = {(one.port, one.id): name for name, one in joints.joints.items()}
    seen: list[Seen] = []
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


def readings(ports: Ports, clock: Clock, joints: ServoMap) -> list[Reading]:
    """What every servo says now, each asked once."""
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


# --- one joint ---------------------------------------------------------------------------------


def bare(joint: Motor) -> Motor:
    """The servo by its own angles, as many turns as it tells; its limit of current stays."""
    assert isinstance(joint, JointServo)
    most_rad = 2.0 * math.pi * MOST_TURNS
    return msgspec.structs.replace(
        joint,
        sign=1,
        offset_rad=0.0,
        gear=1.0,
        lower_rad=-most_rad,
        upper_rad=most_rad,
        torque_limit_nm=joint.torque_limit_nm / joint.gear,
    )


def resting(driver: AnyMotors, ports: Ports, clock: Clock) -> str:
    """What the only joint's servo says of its torque; "" where it gives none."""
    assert isinstance(driver, DynamixelMotors)
    ((name, _),) = driver.joints.joints.items()
    answer = interview(Talk(ports, clock, driver.joints))[name]
    if answer.settings is None:
        return "silent"
    return "enabled" if answer.value(table.TORQUE_ENABLE) else ""


def set_zero(ports: Ports, clock: Clock, joints: ServoMap, at_rad: float) -> None:
    """Let the only joint's servo say 0 where it stands, by its homing offset (20).

    Raises:
        DriverError: it does not say where it is, or it could not tell all of the joint's range
            once it was without power; nothing is written then.
    """
    ((name, joint),) = joints.joints.items()
    talk = Talk(ports, clock, joints)
    answer = interview(talk)[name]
    told = answer.measured(table.PRESENT_POSITION)
    if answer.settings is None or told is None:
        raise DriverError(f"{name} does not say where it is (nothing was changed)")
    offset = answer.value(table.HOMING_OFFSET) + MIDDLE - told
    meant = msgspec.structs.replace(joint, offset_rad=at_rad)
    ends = [MIDDLE + meant.motor_rad(q) / RAD_A_PULSE for q in (joint.lower_rad, joint.upper_rad)]
    # The e-manual: present position = actual position (0 to 4095 after power) + homing offset.
    if min(ends) < max(0, offset) or max(ends) > TURN - 1 + min(0, offset):
        text = f"{name} would not know after a loss of power in which turn it is: its range is"
        cure = "leave --in-motor out and write offset_rad into the map, or turn its horn"
        raise DriverError(f"{text} {min(ends):.0f} to {max(ends):.0f} pulses ({cure})")
    arming.write(talk, table.HOMING_OFFSET, lambda _: offset)
