"""What boards say of themselves before anything is enabled, and whether the map says the same."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from robot.drivers.motors.ethernet import datagrams
from robot.drivers.motors.ethernet.datagrams import (
    BOARD,
    FAULTS,
    FEEDBACK,
    FLAGS_OTHERS,
    Datagram,
    Hello,
    Kind,
    Sold,
    State,
    Told,
    feedback_size,
    mask_of,
    slots_of,
)
from robot.drivers.motors.ethernet.joint_map import DriveMap, JointDrive
from robot.drivers.motors.ethernet.talking import Question, Talk
from robot.drivers.motors.findings import Finding, Said, findings
from robot.drivers.motors.linkage import Needed, needed
from robot.drivers.motors.motor_map import KD_MOST, KP_MOST
from robot.drivers.motors.transmission import Motion, joints_of, placed, where_wrong

SAME_SHARE = 0.001


@dataclass
class Drive:
    """What one drive told of its joint's motor."""

    q_rad: float
    qd_rad_s: float
    tau_nm: float
    celsius: float
    faults: tuple[str, ...]
    state: int


@dataclass
class Answers:
    """Of one joint's board and drive; None of what was not told.

    Attributes:
        number: under which the board answers.
        refused: what its board sent instead of answers, in words; "" if nothing.
        hello: who it is.
        told: what the board says of itself.
        drive: what its drive says of the joint.
    """

    number: int | None = None
    refused: str = ""
    hello: Hello | None = None
    told: Told | None = None
    drive: Drive | None = None

    def sold(self, slot: int) -> Sold | None:
        """What the drive of a slot is."""
        return None if self.hello is None else self.hello.drives.get(slot)


def interview(talk: Talk) -> dict[str, Answers]:
    """Ask every board of a map who it is and how its joints are; nothing is enabled.

    Raises:
        DriverError: if there is no way to any board.
    """
    joints = talk.joints
    answers = {name: Answers() for name in joints.joints}
    who = talk.ask_all({board: Question(Kind.HELLO) for board in joints.boards})
    for board, reasons in talk.refused.items():
        for name in joints.on(board):
            words = ", ".join(f"{count} by their {reason}" for reason, count in reasons.items())
            answers[name].refused = words
    for board, answer in who.items():
        for name in joints.on(board):
            answers[name].number, answers[name].hello = answer.board, datagrams.hello(answer)
    asked: dict[str, Question] = {}
    for board, answer in who.items():
        mask = mask_of(one.id for one in joints.on(board).values()) & answer.joints
        if answer.board == joints.boards[board].number and mask:
            asked[board] = Question(Kind.STATE, mask)
    for board, answer in talk.ask_all(asked).items():
        _keep(answers, joints.on(board), answer)
    return answers


def _keep(answers: Mapping[str, Answers], joints: Mapping[str, JointDrive], said: Datagram) -> None:
    drives = drives_of(said)
    for name, one in joints.items():
        if drives:
            answers[name].told = datagrams.told(said.body)
        answers[name].drive = drives.get(one.id)


def drives_of(said: Datagram) -> dict[int, Drive]:
    """What an answer tells of joints, by slot; what is no number is left out."""
    slots = [*slots_of(said.joints)]
    if len(said.body) != feedback_size(len(slots)):
        return {}
    told = np.frombuffer(said.body, FEEDBACK, offset=BOARD.size)
    return {
        slot: Drive(
            float(one["q"]), float(one["qd"]), float(one["tau"]), 0.1 * float(one["decicelsius"]),
            faults_of(int(one["faults"])), int(one["state"]),
        )
        for slot, one in zip(slots, told, strict=True)
        if np.isfinite([one["q"], one["qd"], one["tau"]]).all()
    }  # fmt: skip


def faults_of(bits: int) -> tuple[str, ...]:
    """Names of faults; of a bit that has none its number."""
    return tuple(
        FAULTS[bit] if bit < len(FAULTS) else f"fault_{bit}" for bit in range(16) if bits >> bit & 1
    )


def status(state: int, faults: tuple[str, ...]) -> str:
    """What a drive does, in one word."""
    if faults:
        return faults[0]
    return State(state).name.lower() if state in [*State] else f"state_{state}"


def at_joints(joints: DriveMap, answers: Mapping[str, Answers]) -> dict[str, Motion]:
    """Angle, speed and torque of each joint; NaN where a motor that it takes did not tell."""
    return joints_of(joints, _told(joints, answers))


def _told(joints: DriveMap, answers: Mapping[str, Answers]) -> dict[str, Motion | None]:
    drives = {name: answers[name].drive for name in joints.joints}
    return {
        name: None if one is None else Motion(one.q_rad, one.qd_rad_s, one.tau_nm)
        for name, one in drives.items()
    }


def verdicts(joints: DriveMap, answers: Mapping[str, Answers]) -> list[Finding]:
    """All that disagrees, in the map's order."""
    wanted = needed(joints.linkages, joints.joints)
    angles = placed(joints, _told(joints, answers))
    return findings(
        {
            name: _of_one(joints, one, answers[name], wanted[name], angles[name])
            for name, one in joints.joints.items()
        }
    )


def _of_one(
    joints: DriveMap, joint: JointDrive, answer: Answers, wanted: Needed, q_rad: float | None
) -> Iterator[Said]:
    board = joints.boards[joint.board]
    where = f"the board {joint.board!r} ({board.channel})"
    if answer.number is None:
        if answer.refused:
            text = f"what {where} answers is refused: {answer.refused}"
            cure = "is its firmware of version 1 of the datagrams, and its cable whole?"
            yield "refused", text, cure, True
            return
        yield "silent", f"{where} does not answer", "check its power, cable, address and port", True
        return
    if answer.number != board.number:
        text = f"at {board.channel} is board {answer.number}, the map says {board.number}"
        yield "wrong_board", text, "exchange cables or addresses, or correct the map", True
        return
    if answer.hello is None:
        yield "wrong_board", f"{where} does not say who it is", "is its firmware another?", True
        return
    sold = answer.sold(joint.id)
    if sold is None:
        has = ", ".join(map(str, answer.hello.drives)) or "none"
        text = f"{where} has no drive in slot {joint.id}"
        yield "no_drive", text, f"it has {has}: plug it in there, or correct its id", True
        return
    if sold.model != joint.model:
        text = f"it is a {sold.model}, the map says {joint.model}"
        yield "wrong_model", text, "correct the map, or exchange the plugs", True
        return
    yield from _limits(joint, sold, wanted)
    yield from _state(joint, answer, q_rad)


def _limits(joint: JointDrive, sold: Sold, wants: Needed) -> Iterator[Said]:
    """Whether its drive does what the map says of the joint."""
    gear, slack = joint.gear, 1.0 - SAME_SHARE
    wanted = (
        ("torque_limit_nm", "N m", sold.torque_nm * gear, wants.torque_nm),
        ("velocity_limit_rad_s", "rad/s", sold.velocity_rad_s / gear, wants.velocity_rad_s),
    )
    for key, unit, does, says in wanted:
        if does < says * slack:
            text = f"its drive does {does:.4g} {unit} at the joint, the map says {says:g}"
            yield "wrong_range", text, f"{key}: {does:.4g}, or another drive", True
    for key, takes, most in (("kp", sold.kp, KP_MOST), ("kd", sold.kd, KD_MOST)):
        if takes < most * slack:
            text = f"its drive takes {key} up to {takes:g}, and is told up to {most:g}"
            yield "wrong_range", text, "set it in the board's firmware", True
    if sold.trips_c < joint.over_temperature_c:
        text = f"it lets go at {sold.trips_c:g} °C, before the map's {joint.over_temperature_c:g}"
        yield "trips_early", text, f"set over_temperature_c under {sold.trips_c:g}", False


def _state(joint: JointDrive, answer: Answers, q_rad: float | None) -> Iterator[Said]:
    told, drive = answer.told, answer.drive
    if told is None or drive is None:
        text = "it does not tell where its joint is, or what it tells is no number"
        yield "no_state", text, "look at the plug of its encoder, and at the network", True
        return
    for fault in drive.faults:
        text = f"it reports {fault.replace('_', ' ')}"
        yield fault, text, "find out why; then switch the board off and on", True
    is_on = drive.state in (State.ENABLED, State.BRAKING)
    if is_on and told.flags & FLAGS_OTHERS and drive.state == State.ENABLED:
        text = "another program has enabled it"
        yield "commanded", text, "it is taken over by the first command", False
    if (wrong := where_wrong(joint, q_rad)) is not None:
        yield wrong.code, wrong.text, wrong.cure, True
