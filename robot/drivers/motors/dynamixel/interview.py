"""What servos say of themselves before anything is enabled, and whether the map says the same."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from robot.drivers.motors.dynamixel import control_table as table
from robot.drivers.motors.dynamixel import instructions
from robot.drivers.motors.dynamixel.control_table import Item
from robot.drivers.motors.dynamixel.joint_map import JointServo, ServoMap
from robot.drivers.motors.dynamixel.models import NAMES, RAD_A_PULSE, RAD_S_A_STEP
from robot.drivers.motors.dynamixel.packets import Status
from robot.drivers.motors.dynamixel.talking import WAITS_S, Talk
from robot.drivers.motors.findings import Finding, Said, findings
from robot.drivers.motors.mounting import misplaced

MIDDLE = 2048
"""Where a servo says 0 rad."""


@dataclass
class Answers:
    """Of one joint's servo.

    Attributes:
        settings: its table up to HARDWARE_ERROR; None if it did not tell.
        state: from PRESENT_CURRENT to PRESENT_TEMPERATURE; None if it did not tell.
        spoilt: answers of which the CRC was wrong.
    """

    settings: bytes | None = None
    state: bytes | None = None
    spoilt: int = 0

    def value(self, item: Item) -> int:
        """Of its settings; 0 if it did not tell."""
        return 0 if self.settings is None else item.value(self.settings, 0)

    def measured(self, item: Item) -> int | None:
        """Of its state; None if it did not tell."""
        begin = table.PRESENT_CURRENT.address
        return None if self.state is None else item.value(self.state, begin)

    @property
    def position_rad(self) -> float | None:
        """Of the servo."""
        pulses = self.measured(table.PRESENT_POSITION)
        return None if pulses is None else (pulses - MIDDLE) * RAD_A_PULSE

    @property
    def velocity_rad_s(self) -> float | None:
        """Of the servo."""
        steps = self.measured(table.PRESENT_VELOCITY)
        return None if steps is None else steps * RAD_S_A_STEP


def interview(talk: Talk) -> dict[str, Answers]:
    """Ask every servo of a map, one on each port at a time.

    Raises:
        DriverError: if all ports went away.
    """
    joints = talk.joints
    answers = {name: Answers() for name in joints.joints}
    waiting = {port: list(joints.on(port)) for port in joints.ports}
    while turn := {port: names.pop(0) for port, names in waiting.items() if names}:
        _both(talk, turn, answers)
    return answers


def _both(talk: Talk, turn: Mapping[str, str], answers: dict[str, Answers]) -> None:
    parts: tuple[tuple[int, int, Callable[[Answers, bytes], None]], ...] = (
        (0, table.HARDWARE_ERROR.end, _keep_settings),
        (table.PRESENT_CURRENT.address, table.END - table.PRESENT_CURRENT.address, _keep_state),
    )
    for address, size, keep in parts:
        missing = dict(turn)
        for wait_s in WAITS_S:
            before = {port: talk.receivers[port].crc_errors for port in missing}
            for port, status in one_each(talk, missing, address, size, wait_s=wait_s).items():
                if len(status.data) == size:
                    keep(answers[missing.pop(port)], status.data)
            for port, name in missing.items():
                answers[name].spoilt += talk.receivers[port].crc_errors - before[port]
            if not missing:
                break


def _keep_settings(answer: Answers, data: bytes) -> None:
    answer.settings = data


def _keep_state(answer: Answers, data: bytes) -> None:
    answer.state = data


def one_each(
    talk: Talk, turn: Mapping[str, str], address: int, size: int, *, wait_s: float
) -> dict[str, Status]:
    """Read the same bytes of one joint's servo on each port; the answers, by port."""
    asked = {
        port: instructions.read(talk.joints.joints[name].id, address, size)
        for port, name in turn.items()
    }
    said = talk.ask(asked, dict.fromkeys(asked, 1), wait_s=wait_s)
    return {
        port: status
        for port, heard in said.items()
        for status in heard
        if status.id == talk.joints.joints[turn[port]].id
    }


def verdicts(joints: ServoMap, answers: Mapping[str, Answers]) -> list[Finding]:
    """All that disagrees, in the map's order."""
    return findings({name: _of_one(joint, answers[name]) for name, joint in joints.joints.items()})


def _of_one(joint: JointServo, answer: Answers) -> Iterator[Said]:
    where = f"servo {joint.id} on the port {joint.port!r}"
    if answer.settings is None and answer.spoilt:
        text = f"what {where} answers is spoilt, {answer.spoilt} times"
        cure = "do two servos have one id? else look at the cable"
        yield "duplicate_id", text, cure, True
        return
    if answer.settings is None:
        cure = "check its power, its cable, its id and the port's baud_hz"
        yield "silent", f"{where} does not answer", cure, True
        return
    number = answer.value(table.MODEL_NUMBER)
    if number != joint.sold.number:
        told = NAMES.get(number, f"model {number}")
        yield "wrong_model", f"it is a {told}, the map says {joint.model}", "correct the map", True
        return
    yield from _settings(joint, answer)
    q_rad = answer.position_rad
    if q_rad is None:
        text = f"its answers are spoilt, {answer.spoilt} times" if answer.spoilt else "no answer"
        yield "no_state", f"it does not tell its state: {text}", "two servos of one id?", True
    elif (wrong := misplaced(joint, joint.joint_rad(q_rad))) is not None:
        yield wrong.code, wrong.text, wrong.cure, True


def _settings(joint: JointServo, answer: Answers) -> Iterator[Said]:
    errors = table.hardware_errors(answer.value(table.HARDWARE_ERROR))
    for error in errors:
        text = f"it reports {error.replace('_', ' ')}"
        yield error, text, "find out why; then reboot it, or switch it off and on", True
    limit = answer.value(table.CURRENT_LIMIT)
    if limit < joint.most_steps:
        gives = limit * abs(joint.nm_a_step)
        wanted = f"not {joint.torque_limit_nm:g}"
        text = f"its limit of current ({limit}) lets it give {gives:.2f} N m, {wanted}"
        cure = f"write {joint.most_steps} into 38, or torque_limit_nm: {gives:.2f} into the map"
        yield "wrong_range", text, cure, True
    if answer.value(table.STATUS_RETURN) == 0:
        yield "mute", "it answers to nothing but ping", "write 2 into 68", True
    if answer.value(table.DRIVE_MODE) & 1:
        yield "reversed", "it turns the other way (drive mode)", "write 0 into 10; use sign", True
    hot_c = answer.value(table.TEMPERATURE_LIMIT)
    if hot_c < joint.over_temperature_c:
        text = f"it lets go at {hot_c} °C, before the map's {joint.over_temperature_c:g}"
        yield "trips_early", text, f"set over_temperature_c under {hot_c} in the map", False
