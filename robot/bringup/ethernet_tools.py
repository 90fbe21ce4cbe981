"""What `humanoid motors` does with motors behind Ethernet, and no others (`motor_families`)."""

from __future__ import annotations

import msgspec

from robot.bringup.motor_family import AnyMotors
from robot.bringup.motor_reports import Reading, Seen, unless_nan
from robot.clock import Clock
from robot.drivers.motors.ethernet import arming, datagrams
from robot.drivers.motors.ethernet.datagrams import Kind
from robot.drivers.motors.ethernet.interview import Answers, at_joints, interview, status, verdicts
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.ethernet.ports import Ports
from robot.drivers.motors.ethernet.talking import Question, Talk
from robot.drivers.motors.findings import Finding
from robot.drivers.motors.motor_map import Motor
from robot.drivers.motors.transmission import Motion

MOST_RAD = 1000.0
"""Of a motor by its own angles: its numbers have no end, a person's turning has."""
DISABLED = "disabled"


def findings(ports: Ports, clock: Clock, joints: DriveMap) -> list[Finding]:
    """What they say of themselves where the map says otherwise."""
    return verdicts(joints, interview(Talk(ports, clock, joints)))


def scan(ports: Ports, clock: Clock, joints: DriveMap, up_to: int) -> list[Seen]:
    """Ask the board at every address of the map which drives it has, up to a slot."""
    talk = Talk(ports, clock, joints)
    named = {(one.board, one.id): name for name, one in joints.joints.items()}
    seen: list[Seen] = []
    for board, answer in talk.ask_all(dict.fromkeys(joints.boards, Question(Kind.HELLO))).items():
        if (who := datagrams.hello(answer)) is None:
            continue
        seen += [
            Seen(
                bus=board, id=slot, reply_id=answer.board, replies=1,
                joint=named.get((board, slot), ""), mode=None, version=who.firmware, ranges=None,
            )
            for slot in who.drives
            if slot <= up_to
        ]  # fmt: skip
    return sorted(seen, key=lambda one: (one.bus, one.id))


def readings(ports: Ports, clock: Clock, joints: DriveMap) -> list[Reading]:
    """What every drive says now, each asked once."""
    answers = interview(Talk(ports, clock, joints))
    found = at_joints(joints, answers)
    return [_reading(name, joints, answers[name], found[name]) for name in joints.joints]


def _reading(name: str, joints: DriveMap, answer: Answers, found: Motion) -> Reading:
    one, drive, told = joints.joints[name], answer.drive, answer.told
    if drive is None or told is None:
        return Reading(joint=name, bus=one.board, id=one.id, model=one.model, status="silent")
    return Reading(
        joint=name,
        bus=one.board,
        id=one.id,
        model=one.model,
        status=status(drive.state, drive.faults),
        q_rad=unless_nan(found.q_rad),
        qd_rad_s=unless_nan(found.qd_rad_s),
        tau_nm=unless_nan(found.tau_nm),
        winding_c=drive.celsius,
        driver_c=told.celsius,
        supply_v=told.volts,
    )


# --- one joint ---------------------------------------------------------------------------------


def bare(joint: Motor) -> Motor:
    """The motor by its own angles."""
    return msgspec.structs.replace(
        joint, sign=1, offset_rad=0.0, gear=1.0, lower_rad=-MOST_RAD, upper_rad=MOST_RAD,
        velocity_limit_rad_s=joint.velocity_limit_rad_s * joint.gear,
        torque_limit_nm=joint.torque_limit_nm / joint.gear,
    )  # fmt: skip


def resting(driver: AnyMotors, _ports: Ports, _clock: Clock) -> str:
    """What the only joint's drive says of itself; "" where it is disabled."""
    status = driver.status_of(0)
    return "" if status == DISABLED else status


def set_zero(ports: Ports, clock: Clock, joints: DriveMap, _at_rad: float) -> None:
    """Let the only joint's drive call this position zero."""
    arming.set_zero(Talk(ports, clock, joints))
