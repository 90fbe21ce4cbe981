"""Motors behind Ethernet as a `MotorBus`: one datagram a board and period, and its answer.

Boards close the law of MIT mode themselves. Who only reads asks for the state, and disturbs nobody.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Self

import numpy as np

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motor_bus import MIT_MODE, MotorBus, MotorCommand, MotorState
from robot.drivers.motors.alarms import Alarms, News, untold
from robot.drivers.motors.claim import Claim
from robot.drivers.motors.ethernet import arming, joint_map, watching
from robot.drivers.motors.ethernet.datagrams import FLAGS_EXPIRED, ORDER, Kind, Reason, State
from robot.drivers.motors.ethernet.emulated import EmulatedBoards, boards_in
from robot.drivers.motors.ethernet.interview import (
    Answers,
    faults_of,
    interview,
    status,
    verdicts,
)
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.ethernet.ports import Ports, UdpPorts, check_boards
from robot.drivers.motors.ethernet.reception import FASTEST_RAD_S, Reception
from robot.drivers.motors.ethernet.talking import Question, Talk
from robot.drivers.motors.findings import refuse_grave
from robot.drivers.motors.holding import Holding
from robot.drivers.motors.life import Life, not_let_go, unheard
from robot.drivers.motors.limiter import Limiter, Measured
from robot.drivers.motors.periods import Periods
from robot.drivers.motors.plant_behind import PlantClock
from robot.drivers.motors.speed_check import SpeedCheck
from robot.drivers.motors.transmission import AtMotors, Transmission
from robot.drivers.motors.watching import SILENT_PERIODS
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.se3 import Array


def make(wiring: Wiring) -> MotorBus:
    """The motors that `ethernet.yaml` beside the description names.

    Raises:
        ConfigError: the file says what cannot be meant, or lacks a motor of the robot.
        DriverError: the user does not let robots talk to one of its boards.
    """
    return wired(joint_map.beside(wiring.robot), wiring)


def wired(joints: DriveMap, wiring: Wiring) -> EthernetMotors:
    """The motors of a map, emulated where a process emulates them.

    Raises:
        DriverError: the user does not let robots talk to one of its boards.
    """
    if wiring.emulated is None:
        check_boards(joints.boards)
        return EthernetMotors(
            joints, wiring.clock, ports=lambda: UdpPorts(joints.boards), tell=print
        )
    plant = wiring.simulated_plant()
    there, time = boards_in(joints, wiring.emulated), PlantClock(plant)
    return EthernetMotors(there, time, ports=lambda: EmulatedBoards(there, plant), tell=print)


class EthernetMotors(Closing):
    """All motors of a map of boards.

    Attributes:
        joints: the map, in the order of every array.
        alarms: what is wrong now.
        unsent: datagrams that the system did not take; none of them was kept.
    """

    capabilities = MIT_MODE

    def __init__(
        self,
        joints: DriveMap,
        clock: Clock,
        *,
        ports: Callable[[], Ports],
        tell: Callable[[str], None] = untold,
        lets_go: bool = False,
    ) -> None:
        """Know the motors; nothing is opened.

        Args:
            joints: the map.
            clock: of its periods.
            ports: opens the ways to its boards.
            tell: hears a line of every alarm, and at the end how well answers came.
            lets_go: whether joints are disabled at the end, and so give no torque, in place of
                braking on: for one joint on a bench, not for a robot on its feet.
        """
        self.joints = joints
        self.alarms = Alarms()
        self.unsent = 0
        self._tell, self._news = tell, News(self.alarms, tell)
        self._lets_go = lets_go
        self._clock, self._periods = clock, Periods(clock, joints.period_s)
        self._transmission, self.limiter = Transmission(joints), Limiter(joints)
        self._claim = Claim(f"udp:{at}" for at in joints.channels.values())
        self._life = Life(ports, self._claim)
        self._talk: Talk | None = None
        order = {name: index for index, name in enumerate(joints.joints)}
        self._places = {
            board: np.array([order[name] for name in joints.on(board)], np.intp)
            for board in joints.boards
        }
        self._masks = arming.masks(joints)
        self._is_armed = self._has_asked = False
        self._full_since_s: dict[str, float] = {}
        self._sent: MotorCommand | None = None
        self._holding = Holding()
        self._commanded = self._lost_before = 0
        self._refused_before = Counter[Reason]()

    def __enter__(self) -> Self:
        """Open the ways to all boards, and ask every one who it is; nothing is enabled.

        That disturbs no program that commands them.

        Raises:
            DriverError: if there is no way to a board, or one is not what the map says: with
                everything that disagrees.
        """
        self._has_asked = False
        if not self._life.open(self._first_asked):
            try:
                self._first_asked(self._life.lines)
            except DriverError:
                self._life.close(lambda _: None, lambda: None)
                raise
        self._watch = watching.Watch(self.joints, self.alarms)
        self._periods.begin()
        for _ in range(SILENT_PERIODS):
            self.read()
        return self

    def _first_asked(self, ports: Ports) -> None:
        self._talk = talk = Talk(ports, self._clock, self.joints)
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

    def close(self) -> None:
        """Leave the joints braking, if they are commanded from here, and close.

        Raises:
            DriverError: if they were to be disabled, and one was not seen to be.
        """
        self._life.close(self._leave, self._left)

    def _leave(self, _ports: Ports) -> None:
        """Braking, or disabled. Raises DriverError if one was not seen to be disabled."""
        if not self._is_armed:
            return
        if not self._lets_go:
            arming.leave_braking(self._opened_talk())
        elif on := arming.disable(self._opened_talk()):
            raise not_let_go(on)

    def _left(self) -> None:
        self._is_armed = False
        if self._commanded:
            self._tell(self._summary())

    def _summary(self) -> str:
        """How well answers came since the joints were enabled."""
        joints, lost = len(self.joints.joints), self.reception.lost - self._lost_before
        refused = self.reception.refused - self._refused_before
        why = ", ".join(f"{count} {reason}" for reason, count in refused.most_common())
        return (
            f"Ethernet: {joints} joints on {len(self.joints.boards)} boards, {self._commanded} "
            f"periods at {self.joints.rate_hz} Hz, {lost} replies late "
            f"({lost / (self._commanded * joints):.3%}), {refused.total()} datagrams refused"
            f"{f' ({why})' if why else ''}, {self.unsent} not sent, {self.late} periods late"
        )

    def claim(self) -> bool:
        """Become the one that commands these boards; False while another one does."""
        return self._life.claim(self._begin)

    def _begin(self, ports: Ports) -> None:
        ports.receive()  # what nobody read meanwhile is of the past
        self._has_asked = False
        self._periods.begin()
        self.reception.forget_where()

    @property
    def late(self) -> int:
        """Periods that began late by more than one."""
        return self._periods.late

    @property
    def speeds(self) -> SpeedCheck:
        """How reported speeds compare with reported positions."""
        return self._watch.joints.speeds

    def status_of(self, index: int) -> str:
        """What a joint's drive says of itself, in one word."""
        faults = faults_of(int(self.reception.faults[index]))
        return status(int(self.reception.state[index]), faults)

    def reset(self) -> None:
        """Forget every alarm, also latched ones; the next command arms the joints anew.

        What is still wrong sounds again.
        """
        self.alarms.reset()
        self._watch.forget()
        self._is_armed, self._sent = False, None
        self._holding.forget()
        self.limiter.forget()

    # --- read ----------------------------------------------------------------------------------

    def read(self) -> MotorState:
        """The state at the end of this period. Raises DriverError if no board can be reached."""
        ports = self._life.lines
        if not self._has_asked:
            self._send(Kind.STATE, dict.fromkeys(self.joints.boards, b""))
        self._periods.wait(self._hear)
        for board, why in ports.gone.items():
            self._watch.unplugged(board, why)
        self._has_asked = False
        return self._state()

    def _hear(self) -> None:
        if came := self._life.lines.receive():
            self.reception.take(came, self._clock.now_s())

    def _state(self) -> MotorState:
        now_s, heard = self._clock.now_s(), self.reception
        heard.end_period()
        self._at = q, qd, tau = heard.at_joints(self._transmission)
        self._watch.joints.linkages(self._transmission.unsolved)
        strangers = self._life.lines.strangers
        self._watch.look(now_s, heard, q, qd, strangers=strangers, is_armed=self._is_armed)
        self._commanded += self._is_armed
        if self._is_armed:
            self._news.say(now_s)
        expired = any(board.flags & FLAGS_EXPIRED for board in heard.boards.values())
        left_on = self._is_left_enabled and self._claim.is_held
        return MotorState(
            stamp_s=now_s,
            q=q.copy(),
            qd=qd.copy(),
            tau=tau.copy(),
            temperature_c=heard.temperature_c.copy(),
            age_s=now_s - heard.heard_s,
            watchdog=not (self._is_armed or left_on) or expired,
            command_stamp_s=self._commanded_s(now_s, left_on=left_on),
            alarms=self.alarms.messages() if self._is_armed else (),
        )

    def _commanded_s(self, now_s: float, *, left_on: bool) -> float:
        """Of the last command; that of another program is no older than the boards' watchdog."""
        if self._sent is not None:
            return self._sent.stamp_s
        return now_s if left_on else -np.inf

    @property
    def _is_left_enabled(self) -> bool:
        """Whether a program that commanded until a moment ago left all joints enabled."""
        heard = self.reception
        if self._is_armed or any(board.flags & FLAGS_EXPIRED for board in heard.boards.values()):
            return False
        return bool((heard.state == State.ENABLED).all() and (heard.misses == 0).all())

    # --- write ---------------------------------------------------------------------------------

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command, limited; returns what the datagrams say.

        While an alarm says HOLD, the last targets are sent in its place.

        Raises:
            DriverError: if a value is not finite or a shape is wrong (nothing is sent), another
                driver commands, or a joint cannot be enabled.
        """
        self._life.check()
        self.limiter.check(command)
        if not self.claim():
            raise DriverError("another controller commands the motors")
        if not self._is_armed:
            self._arm()
        q, qd, _ = self._at
        measured = Measured(q, qd, self.reception.temperature_c)
        wanted = self._holding.decided(command, self.alarms.level, obeyed=self._sent, q=q)
        self._sent = self._command(self.limiter.apply(wanted, measured))
        return self._sent

    def _arm(self) -> None:
        """Enable all joints. Raises DriverError if one is not what the map says, or does not."""
        talk = self._opened_talk()
        was_left = self._is_left_enabled and not arming.take_over(talk)
        if was_left:
            self._tell("the motors were left enabled: they are commanded as they are")
        else:
            refuse_grave(verdicts(self.joints, interview(talk)), "motors")
            arming.arm(talk)
        self._is_armed = True
        self.reception.state[:] = State.ENABLED
        for board in self.reception.boards.values():
            board.flags = 0
        self._periods.begin()
        if silent := unheard(self.joints.joints, self.read, lambda: self.reception.heard_s):
            self._is_armed = False
            if not was_left:  # else boards brake, as they do without a word
                arming.disable(talk)
            raise DriverError(f"nothing is commanded: no word of {', '.join(silent)}")
        self._lost_before, self._commanded = self.reception.lost, 0
        self._refused_before = self.reception.refused

    def _command(self, command: MotorCommand) -> MotorCommand:
        transmission, (q, qd, _) = self._transmission, self._at
        orders = np.empty(len(command.q_des), ORDER)
        for field, values in zip(
            AtMotors._fields, transmission.at_motors(command, q, qd), strict=True
        ):
            orders[field] = values
        bodies = {board: orders[which].tobytes() for board, which in self._places.items()}
        self._send(Kind.COMMAND, bodies)
        told = AtMotors(*(orders[field].astype(float) for field in AtMotors._fields))
        return transmission.said(command, told, q, qd)

    def _send(self, kind: Kind, bodies: dict[str, bytes]) -> None:
        """Ask all boards, one datagram each; what the system does not take is not kept."""
        ports, talk = self._life.lines, self._opened_talk()
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
