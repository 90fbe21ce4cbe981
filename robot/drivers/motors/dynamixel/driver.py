"""Dynamixel servos as a `MotorBus`: in the mode of currents, the gains' loop closed from here.

    tau = kp (q_des - q) + kd (qd_des - qd) + tau_ff

is a servo's law in no mode of its own, so every period sends each servo the current that gives that
torque at what it measured last: stiffness and damping act as fast as the bus is, and one period
late. What `write` returns is therefore torque alone.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.dynamixel import arming, joint_map, watching
from robot.drivers.motors.dynamixel.asking import Asking
from robot.drivers.motors.dynamixel.control_table import WATCHDOG_STEP_S
from robot.drivers.motors.dynamixel.interview import interview, verdicts
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.dynamixel.ports import Ports, SerialPorts
from robot.drivers.motors.dynamixel.reception import Reception
from robot.drivers.motors.dynamixel.talking import Talk
from robot.drivers.motors.findings import refuse_grave
from robot.drivers.motors.line_family import LineFamily
from robot.drivers.motors.line_motors import LineMotors
from robot.errors import DriverError
from robot.se3 import Array

STALE_PERIODS = 3
"""From so many on nothing is fed back of a servo that does not answer."""


class DynamixelMotors(LineMotors[ServoMap, Ports, Reception, watching.Watch]):
    """All servos of a map (`LineMotors`); what `write` returns is torque, and no gains."""

    title, losses, scheme = "Dynamixel", "answers missed", "serial"
    says_law = False

    def _prepare(self) -> None:
        joints = self.joints
        servos = list(joints.joints.values())
        self._nm_a_step: Array = np.array([one.nm_a_step for one in servos])
        self._most: Array = np.array([float(one.most_steps) for one in servos])
        self._asking = Asking(joints)
        self.reception = Reception(joints)
        self._talk: Talk | None = None
        self._is_known = self._is_expired = self._is_watched = False
        self._asked: npt.NDArray[np.bool_] = np.zeros(len(servos), np.bool_)
        self._has_asked = False
        self._spoke_s = 0.0

    # --- its life --------------------------------------------------------------------------------

    def _meet(self, lines: Ports, *, is_free: bool) -> None:
        """While another program commands nobody is asked, nor listened to.

        What one program reads of a serial port the other does not get.
        """
        self._is_known = False
        self._talk = talk = Talk(lines, self._clock, self.joints)
        if is_free:
            self._interview(talk)

    def _interview(self, talk: Talk) -> None:
        refuse_grave(verdicts(self.joints, interview(talk)), "servos")
        self._is_known = True

    def _watches(self, lines: Ports) -> watching.Watch:  # noqa: ARG002
        return watching.Watch(self.joints, self.alarms, self._opened_talk().receivers)

    def _leave(self, lines: Ports) -> None:
        if self._is_armed:  # who talks while servos answer spoils both
            self._clock.sleep_until(self._clock.now_s() + self.joints.period_s)
        super()._leave(lines)

    def _damp(self, lines: Ports) -> None:  # noqa: ARG002
        arming.leave_braking(self._opened_talk())

    def _let_go(self, lines: Ports) -> list[str]:  # noqa: ARG002
        return arming.switch_off(self._opened_talk())

    def _left(self) -> None:
        self._is_watched = False
        super()._left()

    @property
    def _more(self) -> str:
        receivers = self._opened_talk().receivers.values()
        return f"{sum(one.crc_errors + one.broken for one in receivers)} packets spoilt, "

    def _drop(self, lines: Ports) -> None:
        for port in self.joints.ports:
            lines.read(port)
        self._forget_asking()

    def _forget_asking(self) -> None:
        """Nobody answers what was asked before."""
        self._asked[:] = False
        self._has_asked = False
        for receiver in self._opened_talk().receivers.values():
            receiver.give_up()

    def status_of(self, index: int) -> str:
        """Whether a joint's servo has an error to tell, in one word."""
        return "alert" if self.reception.alerts[index] else "answers"

    def reset(self) -> None:
        """Forget every alarm, also latched ones; the next command arms the servos anew."""
        super().reset()
        self._is_expired = self._is_watched = False

    # --- read ------------------------------------------------------------------------------------

    @property
    def _is_ours(self) -> bool:
        """Whether ports may be read: no other program commands them."""
        return self._claim.is_held or self._claim.is_free()

    def _before(self, lines: Ports) -> None:
        self._listens = self._is_ours
        if self._listens and not self._has_asked:
            self._ask(lines, None)

    def _hear(self) -> None:
        if self._listens:
            self._take(self._life.lines, is_over=False)

    def _end(self, lines: Ports) -> None:
        if self._listens:
            self._take(lines, is_over=True)
        asked, self._asked = self._asked, np.zeros_like(self._asked)
        self._has_asked = False
        self.reception.end_period(asked)

    def _take(self, ports: Ports, *, is_over: bool) -> None:
        """Take what came in; at the end of a period what has begun is given up."""
        now_s = self._clock.now_s()
        for port, receiver in self._opened_talk().receivers.items():
            heard = receiver.take(ports.read(port))
            if is_over:
                heard += receiver.give_up()
            if heard:
                self.reception.take(port, heard, now_s)

    @property
    def _has_let_go(self) -> bool:
        return self._is_expired

    # --- write -----------------------------------------------------------------------------------

    def _enable(self, lines: Ports) -> bool:  # noqa: ARG002
        """Their watchdogs wait for a command; servos that were left on go on as they are."""
        talk = self._opened_talk()
        if not self._is_known:
            self._interview(talk)
        arming.arm(talk)
        self._is_expired = self._is_watched = False
        self._forget_asking()
        self._spoke_s = self._clock.now_s()
        return False

    def _send(self, lines: Ports, command: MotorCommand) -> MotorCommand:
        q, qd, _ = self._at
        tau = command.kp * (command.q_des - q) + command.kd * (command.qd_des - qd)
        tau = np.where(self.reception.misses >= STALE_PERIODS, 0.0, tau) + command.tau_ff
        steps = np.clip(np.rint(tau / self._nm_a_step), -self._most, self._most)
        self._ask(lines, steps)
        zero = np.zeros_like(q)
        return MotorCommand(
            command.stamp_s, zero, zero.copy(), steps * self._nm_a_step, zero.copy(), zero.copy()
        )

    def _ask(self, ports: Ports, steps: Array | None) -> None:
        """Send currents, if there are any, and ask for the state, in one write a port."""
        now_s = self._clock.now_s()
        since_s = now_s - self._spoke_s
        if self._is_watched and since_s > self.joints.watchdog_s - 0.5 * WATCHDOG_STEP_S:
            self._is_expired = True
            self._watch.expired(since_s)
        self._spoke_s = now_s
        receivers = self._opened_talk().receivers
        begin: dict[str, bytes] = {}
        if steps is not None and not self._is_watched:
            self._is_watched, begin = True, arming.watchdogs(self.joints)
        for port, packets in self._asking.packets(steps, self.reception, receivers).items():
            ports.write(port, begin.get(port, b"") + packets)
        self._asked, self._has_asked = self._asking.asked.copy(), True

    def _opened_talk(self) -> Talk:
        if self._talk is None:
            raise DriverError("the motors are not open")
        return self._talk


FAMILY = LineFamily(
    file=joint_map.FILE,
    map=ServoMap,
    load=joint_map.load,
    lines="ports",
    at="device",
    stem="dxl",
    ports=lambda joints, _: SerialPorts(joints.ports),
    motors=DynamixelMotors,
)
