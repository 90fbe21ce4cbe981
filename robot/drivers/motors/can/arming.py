"""Enabling all motors or none, and leaving them so that they damp by themselves."""

from __future__ import annotations

import msgspec

from robot.clock import Clock
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.interview import (
    ANSWERS_WITHIN_S,
    WAITS_S,
    Answers,
    exchange,
    read_registers,
    talk,
)
from robot.drivers.motors.can.joint_map import JointMap, JointMotor
from robot.drivers.motors.can.ports import Heard, Ports
from robot.drivers.motors.can.replies import feedback_of, senders
from robot.drivers.motors.can.values import ENABLED, Feedback, Ranges, Target
from robot.errors import DriverError

DAMPING_NM_S = 2.0
"""Of a motor that nobody commands any more; most take up to 5."""
ENABLE_TRIES = 13
"""Together 0.1 s."""
LIMP = Target(0.0, 0.0, 0.0, 0.0, 0.0)


def arm(ports: Ports, clock: Clock, joints: JointMap, ranges: list[Ranges]) -> dict[str, Feedback]:
    """Set every watchdog, then enable every motor, with zero torque.

    Returns:
        What each told as it was enabled: where it stands, before any torque.

    Raises:
        DriverError: naming each motor that did not do so, and why; then all are disabled again.
    """
    silent = _set_watchdogs(ports, clock, joints, joints.watchdog_s)
    if silent:
        text = "these motors did not take their watchdog, nothing is enabled: "
        raise DriverError(f"{text}{', '.join(silent)} (look at their bus for lost frames)")
    if unset := _set_settings(ports, clock, joints, ranges):
        text = "these motors did not take their settings, nothing is enabled: "
        raise DriverError(f"{text}{', '.join(unset)} (look at their bus for lost frames)")
    clears = [
        (one.bus, one.family.clear_fault(one.id))
        for one in joints.joints.values()
        if one.family.clear_fault is not None
    ]
    exchange(ports, clock, clears, lambda _: None)
    told = _enable(ports, clock, joints, ranges)
    refused = [
        f"{name} {_told(joints.joints[name], told.get(name))}"
        for name in joints.joints
        if not _is_on(told.get(name))
    ]
    if refused:
        disable(ports, clock, joints, ranges)
        raise DriverError(f"all motors are disabled again: {', '.join(refused)}")
    return told


def leave_damping(ports: Ports, clock: Clock, joints: JointMap, ranges: list[Ranges]) -> None:
    """Let every motor damp, and switch its watchdog off: it would let the joint go."""
    frames: list[tuple[str, Frame]] = []
    for one, most in zip(joints.joints.values(), ranges, strict=True):
        kd = min(most.kd, DAMPING_NM_S / (one.gear * one.gear))
        frames.append((one.bus, one.family.command(one.id, most, Target(0.0, 0.0, 0.0, kd, 0.0))))
    exchange(ports, clock, frames, lambda _: None)
    _set_watchdogs(ports, clock, joints, 0.0)


def disable(ports: Ports, clock: Clock, joints: JointMap, ranges: list[Ranges]) -> list[str]:
    """Let every motor go, so that it gives no torque; the joints that were not seen to do so."""
    still = dict(joints.joints)
    for wait_s in WAITS_S:
        frames = [(one.bus, one.family.disable(one.id)) for one in still.values()]
        told = _told_by(ports, clock, joints, ranges, frames, wait_s=wait_s)
        still = {name: one for name, one in still.items() if name not in told or _is_on(told[name])}
        if not still:
            break
    return list(still)


def watchdogs(joints: JointMap, timeout_s: float) -> list[tuple[str, Frame]]:
    """What sets the watchdogs of all motors that have one in a register."""
    return [
        (one.bus, asking.write(one.id, asking.settings.watchdog, _units(one, timeout_s)))
        for one in joints.joints.values()
        if (asking := one.family.asking) is not None
    ]


def _set_watchdogs(ports: Ports, clock: Clock, joints: JointMap, timeout_s: float) -> list[str]:
    """Write them and read them back; who did not take it."""
    asked = {name: one for name, one in joints.joints.items() if one.family.asking is not None}
    if not asked:
        return []
    missing = dict(asked)
    for wait_s in WAITS_S:
        few = msgspec.structs.replace(joints, joints=missing)
        exchange(ports, clock, watchdogs(few, timeout_s), lambda _: None, wait_s=wait_s)
        answers = {name: Answers() for name in missing}
        for number in {_watchdog(one) for one in missing.values()}:
            having = {name: one for name, one in missing.items() if _watchdog(one) == number}
            read_registers(ports, clock, having, answers, number)
        missing = {
            name: one
            for name, one in missing.items()
            if answers[name].registers.get(_watchdog(one)) != _units(one, timeout_s)
        }
        if not missing:
            return []
    return list(missing)


def _set_settings(ports: Ports, clock: Clock, joints: JointMap, ranges: list[Ranges]) -> list[str]:
    """What motors with a console are told before they are enabled; who did not take it."""
    wanted = {
        name: asking.console.wanted(most)
        for (name, one), most in zip(joints.joints.items(), ranges, strict=True)
        if (asking := one.family.asking) is not None and asking.console is not None
    }
    return talk(ports, clock, joints.joints).set(wanted)


def _watchdog(joint: JointMotor) -> int:
    return joint.family.asking.settings.watchdog if joint.family.asking is not None else 0


def _units(joint: JointMotor, timeout_s: float) -> int:
    asking = joint.family.asking
    return 0 if asking is None else round(timeout_s / asking.settings.watchdog_unit_s)


def _enable(
    ports: Ports, clock: Clock, joints: JointMap, ranges: list[Ranges]
) -> dict[str, Feedback]:
    """What each tells after it was told to: of those that answered.

    Some take a while to start. Who is on meanwhile is told to give no torque, so that its watchdog
    does not end that.
    """
    told: dict[str, Feedback] = {}
    for _ in range(ENABLE_TRIES):
        if all(_is_on(told.get(name)) for name in joints.joints):
            break
        frames = [
            (
                one.bus,
                one.family.command(one.id, most, LIMP)
                if _is_on(told.get(name))
                else one.family.enable(one.id),
            )
            for (name, one), most in zip(joints.joints.items(), ranges, strict=True)
        ]
        told |= _told_by(ports, clock, joints, ranges, frames, wait_s=ANSWERS_WITHIN_S)
    return told


def _told_by(
    ports: Ports,
    clock: Clock,
    joints: JointMap,
    ranges: list[Ranges],
    frames: list[tuple[str, Frame]],
    *,
    wait_s: float,
) -> dict[str, Feedback]:
    """Send frames, and hear for a while what each joint's motor tells."""
    most = dict(zip(joints.joints, ranges, strict=True))
    sender, said = senders(joints.joints), dict[str, Feedback]()

    def take(heard: Heard) -> None:
        if heard.frame is None or not (name := sender(heard)):
            return
        told = feedback_of(joints.joints[name], heard.frame, most[name])
        if told is not None:
            said[name] = told

    exchange(ports, clock, frames, take, wait_s=wait_s)
    return said


def _is_on(told: Feedback | None) -> bool:
    return told is not None and told.status == ENABLED


def _told(joint: JointMotor, told: Feedback | None) -> str:
    if told is None:
        return "does not answer (power, cable, id)"
    status = joint.family.status(told.status)
    return f"is {status.code.replace('_', ' ')}" + (f" ({status.cure})" if status.cure else "")
