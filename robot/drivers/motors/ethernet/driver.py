"""Motors behind Ethernet as a `MotorBus`: one datagram a board and period, and its answer.

Boards close the law of MIT mode themselves. Who only reads asks for the state, and disturbs nobody.
"""

from __future__ import annotations

from collections import Counter

import numpy as np

from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.ethernet import arming, joint_map, watching
from robot.drivers.motors.ethernet.datagrams import FLAGS_EXPIRED, ORDER, Kind, Reason, State
from robot.drivers.motors.ethernet.interview import (
    Answers,
    faults_of,
    interview,
    status,
    verdicts,
)
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.ethernet.ports import Ports, UdpPorts
from robot.drivers.motors.ethernet.reception import FASTEST_RAD_S, Reception
from robot.drivers.motors.ethernet.talking import Question, Talk
from robot.drivers.motors.findings import refuse_grave
from robot.drivers.motors.line_family import LineFamily
from robot.drivers.motors.line_motors import LineMotors
from robot.drivers.motors.transmission import AtMotors
from robot.errors import DriverError
from robot.se3 import Array


class EthernetMotors(LineMotors[DriveMap, Ports, Reception, watching.Watch]):
    """All motors of a map of boards (`LineMotors`).

    Attributes:
        unsent: datagrams that the system did not take; none of them was kept.
    """

    title, scheme = "Ethernet", "udp"

    def _prepare(self) -> None:
        joints = self.joints
        self.unsent = 0
        self._talk: Talk | None = None
        order = {name: index for index, name in enumerate(joints.joints)}
        self._places = {
            board: np.array([order[name] for name in joints.on(board)], np.intp)
            for board in joints.boards
        }
        self._masks = arming.masks(joints)
        self._has_asked = False
        self._full_since_s: dict[str, float] = {}
        self._refused_before = Counter[Reason]()

    # --- its life --------------------------------------------------------------------------------

    def _meet(self, lines: Ports, *, is_free: bool) -> None:  # noqa: ARG002
        """That disturbs no program that commands them."""
        self._has_asked = False
        self._talk = talk = Talk(lines, self._clock, self.joints)
        answers = interview(talk)
        refuse_grave(verdicts(self.joints, answers), "motors")
        fastest_rad_s = self._learn(answers)
        self.reception = Reception(self.joints, talk.session, fastest_rad_s)

    def _learn(self, answers: dict[str, Answers]) -> Array:
        """What drives do, as their boards say: the speed of each, shape (n,)."""
        joints = self.joints.joints
        sold = [answers[name].sold(one.id) for name, one in joints.items()]
        self._transmission.most_nm = np.array(
            [
                np.inf if drive is None else drive.torque_nm * one.gear
                for drive, one in zip(sold, joints.values(), strict=True)
            ]
        )
        return np.array([FASTEST_RAD_S if one is None else one.velocity_rad_s for one in sold])

    def _watches(self, lines: Ports) -> watching.Watch:
        return watching.Watch(self.joints, self.alarms, lines)

    def _damp(self, lines: Ports) -> None:  # noqa: ARG002
        arming.leave_braking(self._opened_talk())

    def _let_go(self, lines: Ports) -> list[str]:  # noqa: ARG002
        return arming.disable(self._opened_talk())

    @property
    def _where(self) -> str:
        return f"{super()._where} on {len(self.joints.boards)} boards"

    @property
    def _more(self) -> str:
        refused = self.reception.refused - self._refused_before
        why = ", ".join(f"{count} {reason}" for reason, count in refused.most_common())
        return (
            f"{refused.total()} datagrams refused{f' ({why})' if why else ''}, "
            f"{self.unsent} not sent, "
        )

    def _drop(self, lines: Ports) -> None:
        lines.receive()
        self._has_asked = False

    def status_of(self, index: int) -> str:
        """What a joint's drive says of itself, in one word."""
        faults = faults_of(int(self.reception.faults[index]))
        return status(int(self.reception.state[index]), faults)

    # --- read ------------------------------------------------------------------------------------

    def _before(self, lines: Ports) -> None:
        if not self._has_asked:
            self._ask(lines, Kind.STATE, dict.fromkeys(self.joints.boards, b""))

    def _hear(self) -> None:
        if came := self._life.lines.receive():
            self.reception.take(came, self._clock.now_s())

    def _end(self, lines: Ports) -> None:  # noqa: ARG002
        self._has_asked = False
        self.reception.end_period()

    @property
    def _has_let_go(self) -> bool:
        return any(board.flags & FLAGS_EXPIRED for board in self.reception.boards.values())

    @property
    def _is_left_enabled(self) -> bool:
        heard = self.reception
        if self._is_armed or not self._claim.is_held or self._has_let_go:
            return False
        return bool((heard.state == State.ENABLED).all() and (heard.misses == 0).all())

    # --- write -----------------------------------------------------------------------------------

    def _enable(self, lines: Ports) -> bool:  # noqa: ARG002
        talk = self._opened_talk()
        was_left = self._is_left_enabled and not arming.take_over(talk)
        if not was_left:
            refuse_grave(verdicts(self.joints, interview(talk)), "motors")
            arming.arm(talk)
        self.reception.state[:] = State.ENABLED
        for board in self.reception.boards.values():
            board.flags = 0
        return was_left

    def _count_anew(self) -> None:
        super()._count_anew()
        self._refused_before = self.reception.refused

    def _send(self, lines: Ports, command: MotorCommand) -> MotorCommand:
        transmission, (q, qd, _) = self._transmission, self._at
        orders = np.empty(len(command.q_des), ORDER)
        for field, values in zip(
            AtMotors._fields, transmission.at_motors(command, q, qd), strict=True
        ):
            orders[field] = values
        bodies = {board: orders[which].tobytes() for board, which in self._places.items()}
        self._ask(lines, Kind.COMMAND, bodies)
        told = AtMotors(*(orders[field].astype(float) for field in AtMotors._fields))
        return transmission.said(command, told, q, qd)

    def _ask(self, ports: Ports, kind: Kind, bodies: dict[str, bytes]) -> None:
        """Ask all boards, one datagram each; what the system does not take is not kept."""
        talk = self._opened_talk()
        sequence, time_us = talk.begin()
        self.reception.expect(kind, sequence)
        now_s = self._clock.now_s()
        for board, body in bodies.items():
            question = Question(kind, self._masks[board], body)
            if ports.send(board, talk.datagram(board, question, sequence, time_us)):
                if self._full_since_s.pop(board, None) is not None:
                    self._watch.full(board, 0.0)
                continue
            self.unsent += 1
            self._watch.full(board, now_s - self._full_since_s.setdefault(board, now_s))
        self._has_asked = True

    def _opened_talk(self) -> Talk:
        if self._talk is None:
            raise DriverError("the motors are not open")
        return self._talk


FAMILY = LineFamily(
    file=joint_map.FILE,
    map=DriveMap,
    load=joint_map.load,
    lines="boards",
    at="address",
    stem="udp",
    ports=lambda joints, _: UdpPorts(joints.boards),
    motors=EthernetMotors,
)
