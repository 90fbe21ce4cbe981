"""Whether what motors say of themselves is what the joint map says of them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from robot.drivers.motors.can.console import Needs
from robot.drivers.motors.can.families import Asking
from robot.drivers.motors.can.interview import Answers
from robot.drivers.motors.can.joint_map import JointMap, JointMotor
from robot.drivers.motors.can.models import MODELS
from robot.drivers.motors.can.watching import LOST
from robot.drivers.motors.findings import Finding, Said, findings
from robot.drivers.motors.linkage import at_cranks
from robot.drivers.motors.transmission import Motion, placed, where_wrong

SAME_SHARE = 1e-4
"""Registers are single floats; a range that somebody changed differs by more."""
SAME_RAD = 0.02
ASKED_WITHIN_S = 0.3
"""A position is asked for so long before the state at most: a joint in motion is elsewhere then."""


def verdicts(joints: JointMap, answers: Mapping[str, Answers]) -> list[Finding]:
    """All that disagrees, in the map's order."""
    cranks, told = at_cranks(joints.linkages, joints.joints), told_by(joints, answers)
    for name, joint in joints.joints.items():
        if joint.family.asking is None or answers[name].ranges(joint) is None:
            told[name] = None
    angles = placed(joints, told)
    return findings(
        {
            name: _of_one(cranks[name], asking, answers[name], joint, angles[name])
            for name, joint in joints.joints.items()
            if (asking := joint.family.asking) is not None
        }
    )


def told_by(joints: JointMap, answers: Mapping[str, Answers]) -> dict[str, Motion | None]:
    """What each motor says of itself, at its shaft."""
    states = {name: answers[name].feedback for name in joints.joints}
    return {
        name: None if one is None else Motion(one.q_rad, one.qd_rad_s, one.tau_nm)
        for name, one in states.items()
    }


def _of_one(
    joint: JointMotor, asking: Asking, answer: Answers, at: JointMotor, q_rad: float | None
) -> Iterator[Said]:
    """Of one motor.

    Args:
        joint: of it, or its crank as a joint.
        asking: how it is asked.
        answer: what it said.
        at: the joint that the map names it at.
        q_rad: where that stands; None: not told.
    """
    where = f"motor {joint.id} on the bus {joint.bus!r}"
    if not answer.registers:
        cure = "check its power, its cable and its id; `humanoid motors scan` lists who is there"
        yield "silent", f"{where} does not answer", cure, True
        return
    if answer.replies > 1:
        text = f"{answer.replies} motors answer as {where}"
        yield "duplicate_id", text, "leave one plugged in, and give it another id", True
    if answer.answered_as - {joint.answers_as}:
        others = ", ".join(map(str, sorted(answer.answered_as - {joint.answers_as})))
        text = f"{where} answers under {others}, and not under {joint.answers_as}"
        yield "reply_id", text, f"write reply_id: {others} into the map, or change it there", True
    yield from _registers(joint, asking, answer)
    if asking.console is not None:
        yield from asking.console.objections(answer.registers, answer.settings, _needs(joint))
    yield from _scale(joint, asking, answer)
    yield from _state(at, answer, q_rad)


def _registers(joint: JointMotor, asking: Asking, answer: Answers) -> Iterator[Said]:
    settings, values = asking.settings, answer.registers
    words = zip(("position", "velocity", "torque"), settings.ranges or (), joint.expected)  # noqa: B905
    for what, number, wanted in words:
        read = values.get(number)
        if read is None:
            text = f"its {what} range could not be read (register {number})"
            yield "range_unread", text, "try again; look at the bus for lost frames", True
        elif not math.isclose(read, wanted, rel_tol=SAME_SHARE):
            text = f"its {what} range is {read:g} (register {number}), the map expects {wanted:g}"
            cure = f"write {wanted:g} into the register, or its ranges into the map"
            yield "wrong_range", text, cure, True
    mode = values.get(settings.mode)
    if mode is not None and int(mode) not in (settings.right_mode, *settings.fine_modes):
        text = f"it is in mode {int(mode)}, and must be in {settings.right_mode}"
        cure = f"write {settings.right_mode} into register {settings.mode}"
        yield "wrong_mode", text, cure, True
    if settings.torque_limit is not None:
        yield from _weak(joint, values.get(settings.torque_limit), settings.torque_limit)
    hot_c = None if settings.over_temperature is None else values.get(settings.over_temperature)
    if hot_c is not None and hot_c < joint.over_temperature_c:
        text = f"it lets go at {hot_c:g} °C, before the map's {joint.over_temperature_c:g}"
        yield "trips_early", text, f"set over_temperature_c under {hot_c:g} in the map", False


def _needs(joint: JointMotor) -> Needs:
    """What a joint needs of its motor."""
    ends = sorted((joint.motor_rad(joint.lower_rad), joint.motor_rad(joint.upper_rad)))
    return Needs(
        lower_rad=ends[0],
        upper_rad=ends[1],
        velocity_rad_s=joint.velocity_limit_rad_s * joint.gear,
        over_temperature_c=joint.over_temperature_c,
        ratio=MODELS[joint.model].ratio,
    )


def _weak(joint: JointMotor, limit_nm: float | None, register: int) -> Iterator[Said]:
    """Whether it gives as much torque as it is told to."""
    wanted_nm = joint.torque_limit_nm / joint.gear
    if limit_nm is None or limit_nm >= wanted_nm * (1.0 - SAME_SHARE):
        return
    text = f"it gives {limit_nm:g} N m at most (register {register:#x}), its joint {wanted_nm:g}"
    cure = f"write {wanted_nm:g} into the register, or lower torque_limit_nm in the map"
    yield "wrong_range", text, cure, True


def _scale(joint: JointMotor, asking: Asking, answer: Answers) -> Iterator[Said]:
    """Whether the position in its frames is that in a register, where one says it as a number."""
    register, told = asking.settings.position, answer.feedback
    if register is None or told is None or register not in answer.registers:
        return
    read = answer.registers[register]
    if abs(read - told.q_rad) <= SAME_RAD + abs(told.qd_rad_s) * ASKED_WITHIN_S:
        return
    range_rad = joint.expected.position_rad
    text = f"its frames say it is at {told.q_rad:.3f} rad, its register {register:#x} {read:.3f}"
    cure = f"its position range is not {range_rad:g}; write the right one into the map"
    yield "wrong_range", text, cure, True


def _state(joint: JointMotor, answer: Answers, q_rad: float | None) -> Iterator[Said]:
    state, ranges = answer.feedback, answer.ranges(joint)
    if state is None or ranges is None:
        yield "no_state", "it does not tell its state", "check the bus for lost frames", True
        return
    status = joint.family.status(state.status)
    if status.is_fault:
        grave = status.code != LOST
        yield status.code, f"it reports {status.code.replace('_', ' ')}", status.cure, grave
    if (wrong := where_wrong(joint, q_rad)) is not None:
        yield wrong.code, wrong.text, wrong.cure, True
