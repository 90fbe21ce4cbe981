"""What motors say of themselves when they are asked: before anything is enabled."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial

from robot.clock import Clock
from robot.drivers.motors.can.families import Asking, Settings
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.joint_map import JointMap, JointMotor
from robot.drivers.motors.can.ports import Heard, Ports
from robot.drivers.motors.can.replies import feedback_of, senders
from robot.drivers.motors.can.spoken import Speaker, Talk
from robot.drivers.motors.can.values import Feedback, Ranges

ANSWERS_WITHIN_S = 0.008
"""To a frame that had to wait for all others of its bus: they take 0.14 ms each."""
WAITS_S = (ANSWERS_WITHIN_S, 2 * ANSWERS_WITHIN_S, 10 * ANSWERS_WITHIN_S)
"""For one try after the other: an adapter on USB, or a busy machine, may take its time."""


@dataclass
class Answers:
    """Of one joint's motor.

    Attributes:
        registers: values by number.
        answered_as: identifiers that it answered under.
        replies: the most replies that came to one question: two of one identifier are two motors.
        feedback: its state, at its shaft; None if it did not tell.
        settings: what its console said, by name.
    """

    registers: dict[int, float] = field(default_factory=dict[int, float])
    answered_as: set[int] = field(default_factory=set[int])
    replies: int = 0
    feedback: Feedback | None = None
    settings: dict[str, float] = field(default_factory=dict[str, float])

    def ranges(self, joint: JointMotor) -> Ranges | None:
        """What its frames stand for, by the map where no register says it; None: not told."""
        asking = joint.family.asking
        numbers = None if asking is None else asking.settings.ranges
        if numbers is None:
            return joint.expected
        if any(number not in self.registers for number in numbers):
            return None
        position, velocity, torque = (self.registers[number] for number in numbers)
        return Ranges(position, velocity, torque, joint.expected.kp, joint.expected.kd)


def interview(ports: Ports, clock: Clock, joints: JointMap) -> dict[str, Answers]:
    """Ask every motor of a map; those that cannot be asked say nothing.

    Raises:
        DriverError: if a bus is down.
    """
    asked = {name: one for name, one in joints.joints.items() if one.family.asking is not None}
    answers = {name: Answers() for name in joints.joints}
    if not asked:
        return answers
    for one_a_bus in _turns(asked):
        for settings, some in by_settings(one_a_bus):
            read_registers(ports, clock, some, answers, settings.own_id)
    for settings, some in by_settings(asked):
        for number in _looked_at(settings):
            read_registers(ports, clock, some, answers, number)
    names = {
        name: console.looked_at
        for name, one in asked.items()
        if (console := _asking(one).console) is not None and answers[name].registers
    }
    for name, found in talk(ports, clock, asked).settings(names).items():
        answers[name].settings = found
    _feedback(ports, clock, asked, answers)
    return answers


def talk(ports: Ports, clock: Clock, joints: Mapping[str, JointMotor]) -> Talk:
    """With those of these motors that have a console."""
    speakers = {
        name: Speaker(one.bus, one.id, console)
        for name, one in joints.items()
        if one.family.asking is not None and (console := one.family.asking.console) is not None
    }
    return Talk(partial(exchange, ports, clock), speakers)


def by_settings(
    joints: Mapping[str, JointMotor],
) -> list[tuple[Settings, dict[str, JointMotor]]]:
    """Those of one family together: each has registers of its own."""
    found: dict[Settings, dict[str, JointMotor]] = {}
    for name, one in joints.items():
        found.setdefault(_asking(one).settings, {})[name] = one
    return list(found.items())


def _looked_at(settings: Settings) -> list[int]:
    """The registers that a start looks at."""
    numbers = (
        *(settings.ranges or ()), settings.mode, settings.watchdog, settings.version,
        settings.over_temperature, settings.torque_limit, settings.position, *settings.also,
    )  # fmt: skip
    return [number for number in numbers if number is not None]


def _turns(joints: Mapping[str, JointMotor]) -> list[dict[str, JointMotor]]:
    """One joint of each bus at a time: on a full bus, two that say the same at once are one."""
    turns: list[dict[str, JointMotor]] = []
    counts: dict[str, int] = {}
    for name, one in joints.items():
        turn = counts[one.bus] = counts.get(one.bus, -1) + 1
        if turn == len(turns):
            turns.append({})
        turns[turn][name] = one
    return turns


def read_registers(
    ports: Ports,
    clock: Clock,
    joints: Mapping[str, JointMotor],
    answers: dict[str, Answers],
    number: int,
) -> None:
    """Ask all of these, of one family, for one register; those that did not answer, again."""
    by_motor = {(one.bus, one.id): name for name, one in joints.items()}

    def take(heard: Heard) -> None:
        reply = None if heard.frame is None else _asking_any(joints).reply(heard.frame)
        if reply is None or heard.frame is None or reply.register != number:
            return
        name = by_motor.get((heard.bus, reply.motor_id))
        if name is not None:
            counted[name] = counted.get(name, 0) + 1
            answers[name].registers[number] = reply.value
            one = joints[name]
            answers[name].answered_as.add(one.answers_as if one.is_wide else heard.frame.id)

    missing = dict(joints)
    counted: dict[str, int] = {}
    for before, wait_s in enumerate(WAITS_S):
        frames = [(one.bus, _asking(one).read(one.id, number)) for one in missing.values()]
        exchange(ports, clock, frames, take, wait_s=wait_s)
        for name in missing.keys() & counted.keys():  # one asked twice may answer twice, late
            answers[name].replies = max(answers[name].replies, counted[name] - before)
        missing = {name: one for name, one in missing.items() if name not in counted}
        if not missing:
            return


def _feedback(
    ports: Ports, clock: Clock, joints: Mapping[str, JointMotor], answers: dict[str, Answers]
) -> None:
    sender = senders(joints)

    def take(heard: Heard) -> None:
        if heard.frame is None or not (name := sender(heard)):
            return
        one = joints[name]
        ranges = answers[name].ranges(one) or one.expected
        answers[name].feedback = feedback_of(one, heard.frame, ranges) or answers[name].feedback

    frames = [(one.bus, _asking(one).refresh(one.id)) for one in joints.values()]
    for wait_s in WAITS_S:
        exchange(ports, clock, frames, take, wait_s=wait_s)
        if all(answers[name].feedback for name in joints if answers[name].registers):
            return


def exchange(
    ports: Ports,
    clock: Clock,
    frames: list[tuple[str, Frame]],
    take: Callable[[Heard], None],
    *,
    wait_s: float = ANSWERS_WITHIN_S,
) -> None:
    """Send frames as the queues take them, and hear everything for a while after the last."""
    waiting = list(frames)
    until_s = clock.now_s() + wait_s * max(1, len(frames) // 16)
    while waiting and clock.now_s() < until_s:
        waiting = [(bus, frame) for bus, frame in waiting if not ports.send(bus, frame)]
        if waiting:
            for heard in ports.receive(clock.now_s() + 0.001):
                take(heard)
    until_s = clock.now_s() + wait_s
    while clock.now_s() < until_s:
        for heard in ports.receive(until_s):
            take(heard)


def _asking(joint: JointMotor) -> Asking:
    asking = joint.family.asking
    assert asking is not None
    return asking


def _asking_any(joints: Mapping[str, JointMotor]) -> Asking:
    return _asking(next(iter(joints.values())))
