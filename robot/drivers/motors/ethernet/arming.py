"""Enabling all joints or none, and leaving them so that their boards brake them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from robot.drivers.motors.ethernet import datagrams
from robot.drivers.motors.ethernet.datagrams import ORDER, Datagram, Kind, mask_of
from robot.drivers.motors.ethernet.joint_map import DriveMap, JointDrive
from robot.drivers.motors.ethernet.talking import WAITS_S, Question, Talk
from robot.drivers.motors.motor_map import KD_MOST
from robot.errors import DriverError

DAMPING_NM_S = 2.0
"""Of a joint that nobody commands any more; less where its motor cannot."""


def masks(joints: DriveMap) -> dict[str, int]:
    """Which slots of which board are ours."""
    return {board: mask_of(one.id for one in joints.on(board).values()) for board in joints.boards}


def damping_nm_s(joint: JointDrive) -> float:
    """Of its motor."""
    return min(KD_MOST, DAMPING_NM_S / (joint.gear * joint.gear))


def arm(talk: Talk) -> None:
    """Write every watchdog and read it back, then enable every joint, with no torque.

    Raises:
        DriverError: naming each joint that did not do so, and why; then all are disabled again.
    """
    if wrong := _set_watchdogs(talk):
        text = "these boards did not take their watchdog, nothing is enabled: "
        raise DriverError(f"{text}{', '.join(wrong)} (look at their firmware and their cables)")
    ours = masks(talk.joints)
    talk.ask_all({board: Question(Kind.CLEAR, mask) for board, mask in ours.items()})
    if refused := _enable(talk, ours):
        disable(talk)
        raise DriverError(f"all joints are disabled again: {', '.join(refused)}")


def take_over(talk: Talk) -> list[str]:
    """Command joints that were left enabled, as they are; the joints that did not go along."""
    return _enable(talk, masks(talk.joints))


def _enable(talk: Talk, ours: Mapping[str, int]) -> list[str]:
    """Tell all to give torque; whose drive does not."""
    asked = {board: Question(Kind.ENABLE, mask) for board, mask in ours.items()}
    said = talk.ask_all(asked)
    refused: list[str] = []
    for name, joint in talk.joints.joints.items():
        on = _number(said.get(joint.board))
        if on is None:
            refused.append(f"{name} does not answer (power, cable, address)")
        elif not on >> joint.id & 1:
            refused.append(f"{name} does not give torque (a fault? humanoid motors check)")
    return refused


def _set_watchdogs(talk: Talk) -> list[str]:
    """Write them; the boards that do not say that they have them."""
    joints = talk.joints
    bodies = {
        board: datagrams.watchdog(joints.watchdog_s, map(damping_nm_s, joints.on(board).values()))
        for board in joints.boards
    }
    ours = masks(joints)
    said = talk.ask_all(
        {board: Question(Kind.WATCHDOG, ours[board], body) for board, body in bodies.items()}
    )
    return [board for board, body in bodies.items() if _body(said.get(board)) != body]


def _body(answer: Datagram | None) -> bytes | None:
    return None if answer is None else answer.body


def _number(answer: Datagram | None) -> int | None:
    return None if answer is None else datagrams.number(answer.body)


def leave_braking(talk: Talk) -> None:
    """Let every joint brake; when their watchdogs end, boards go on with that by themselves."""
    asked: dict[str, Question] = {}
    for board, mask in masks(talk.joints).items():
        orders = np.zeros(len(talk.joints.on(board)), ORDER)
        orders["kd"] = [damping_nm_s(one) for one in talk.joints.on(board).values()]
        asked[board] = Question(Kind.COMMAND, mask, orders.tobytes())
    talk.ask_all(asked)


def disable(talk: Talk) -> list[str]:
    """Let every joint go, so that it gives no torque; those that were not seen to do so."""
    still = dict(talk.joints.joints)
    for _ in WAITS_S:
        ours: dict[str, int] = {}
        for joint in still.values():
            ours[joint.board] = ours.get(joint.board, 0) | 1 << joint.id
        said = talk.ask_all({board: Question(Kind.DISABLE, mask) for board, mask in ours.items()})
        on = {board: _number(answer) for board, answer in said.items()}
        still = {
            name: one
            for name, one in still.items()
            if (told := on.get(one.board)) is None or told >> one.id & 1
        }
        if not still:
            break
    return list(still)


def set_zero(talk: Talk) -> None:
    """Let every joint's drive call its position zero, for ever; it has to be disabled."""
    ours = masks(talk.joints)
    talk.ask_all({board: Question(Kind.ZERO, mask) for board, mask in ours.items()})
