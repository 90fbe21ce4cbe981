"""Dynamixel servos as a `MotorBus`: in the mode of currents, the gains' loop closed from here.

    tau = kp (q_des - q) + kd (qd_des - qd) + tau_ff

is a servo's law in no mode of its own, so every period sends each servo the current that gives that
torque at what it measured last: stiffness and damping act as fast as the bus is, and one period
late. What `write` returns is therefore torque alone.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Self

import numpy as np
import numpy.typing as npt

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motor_bus import MIT_MODE, MotorCommand, MotorState
from robot.drivers.motors.alarms import Alarms, News, untold
from robot.drivers.motors.claim import Claim
from robot.drivers.motors.dynamixel import arming, watching
from robot.drivers.motors.dynamixel.asking import Asking
from robot.drivers.motors.dynamixel.control_table import WATCHDOG_STEP_S
from robot.drivers.motors.dynamixel.emulated import EmulatedPorts, ports_in
from robot.drivers.motors.dynamixel.interview import interview, verdicts
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.dynamixel.ports import Ports, SerialPorts, check_ports
from robot.drivers.motors.dynamixel.reception import Reception
from robot.drivers.motors.dynamixel.talking import Talk
from robot.drivers.motors.findings import refuse_grave
from robot.drivers.motors.gearing import Gearing
from robot.drivers.motors.holding import Holding
from robot.drivers.motors.life import Life, not_let_go, unheard
from robot.drivers.motors.limiter import Limiter, Measured
from robot.drivers.motors.periods import Periods
from robot.drivers.motors.plant_behind import PlantClock
from robot.drivers.motors.speed_check import SpeedCheck
from robot.drivers.motors.watching import SILENT_PERIODS
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.se3 import Array

STALE_PERIODS = 3
"""From so many on nothing is fed back of a servo that does not answer."""


def wired(servos: ServoMap, wiring: Wiring, *, waits: bool) -> DynamixelMotors:
    """The servos of a map, emulated where a process emulates them.

    Args:
        servos: the map.
        wiring: of the process.
        waits: as `DynamixelMotors` has it.

    Raises:
        DriverError: the user does not let robots open one of its ports.
    """
    if wiring.emulated is None:
        check_ports(servos.ports)
        return DynamixelMotors(
            servos, wiring.clock, ports=lambda: SerialPorts(servos.ports), tell=print, waits=waits
        )
    plant = wiring.simulated_plant()
    there, time = ports_in(servos, wiring.emulated), PlantClock(plant)
    return DynamixelMotors(
        there, time, ports=lambda: EmulatedPorts(there, plant), tell=print, waits=waits
    )


class DynamixelMotors(Closing):
    """All servos of a map.

    Attributes:
        joints: the map, in the order of every array.
        alarms: what is wrong now.
    """

    capabilities = MIT_MODE

    def __init__(
        self,
        joints: ServoMap,
        clock: Clock,
        *,
        ports: Callable[[], Ports],
        tell: Callable[[str], None] = untold,
        waits: bool = True,
        lets_go: bool = False,
    ) -> None:
        """Know the servos; nothing is opened.

        Args:
            joints: the map.
            clock: of its periods.
            ports: opens its ports.
            tell: hears a line of every alarm, and at the end how well answers came.
            waits: whether `read` waits for the end of a period; False where another driver of the
                same robot sets the pace.
            lets_go: whether servos are switched off at the end, and so give no torque, in place of
                braking by themselves: for one joint on a bench, not for a robot on its feet.
        """
        self.joints = joints
        self.alarms = Alarms()
        self._tell, self._news = tell, News(self.alarms, tell)
        self._waits, self._lets_go = waits, lets_go
        self._clock, self._periods = clock, Periods(clock, joints.period_s)
        self._gearing, self.limiter = Gearing(joints), Limiter(joints)
        servos = list(joints.joints.values())
        self._nm_a_step: Array = np.array([one.nm_a_step for one in servos])
        self._most: Array = np.array([float(one.most_steps) for one in servos])
        self._claim = Claim(f"serial:{port.device}" for port in joints.ports.values())
        self._life = Life(ports, self._claim)
        self._asking = Asking(joints)
        self.reception = Reception(joints)
        self._talk: Talk | None = None
        self._is_armed = self._is_known = self._is_expired = self._is_watched = False
        self._asked: npt.NDArray[np.bool_] = np.zeros(len(servos), np.bool_)
        self._has_asked = False
        self._sent: MotorCommand | None = None
        self._obeyed: MotorCommand | None = None
        self._holding = Holding()
        self._commanded = self._lost_before = 0
        self._spoke_s = 0.0

    def __enter__(self) -> Self:
        """Open the ports, and ask every servo who it is; nothing is enabled.

        While another program commands them nobody is asked, nor listened to: what one program reads
        of a serial port the other does not get.

        Raises:
            DriverError: if a port cannot be opened, or a servo is not what the map says: with
                everything that disagrees.
        """
        self._is_known, self._talk = False, None
        if not self._life.open(self._first_asked):
            self._talk = Talk(self._life.lines, self._clock, self.joints)
        self._watch = watching.Watch(self.joints, self.alarms)
        self._periods.begin()
        for _ in range(SILENT_PERIODS):
            self._read(waits=True)
        return self

    def _first_asked(self, ports: Ports) -> None:
        self._talk = Talk(ports, self._clock, self.joints)
        self._interview(self._talk)

    def _interview(self, talk: Talk) -> None:
        refuse_grave(verdicts(self.joints, interview(talk)), "servos")
        self._is_known = True

    def close(self) -> None:
        """Leave the servos braking for themselves, if they are commanded from here, and close.

        Raises:
            DriverError: if they were to be switched off, and one was not seen to be.
        """
        self._life.close(self._leave, self._left)

    def _leave(self, _ports: Ports) -> None:
        """Braking, or switched off. Raises DriverError if one was not seen to be off."""
        if not self._is_armed or self._talk is None:
            return
        # Who talks while servos answer spoils both.
        self._clock.sleep_until(self._clock.now_s() + self.joints.period_s)
        if not self._lets_go:
            arming.leave_braking(self._talk)
        elif on := arming.switch_off(self._talk):
            raise not_let_go(on)

    def _left(self) -> None:
        self._is_armed = self._is_watched = False
        if self._commanded:
            self._tell(self._summary())

    def _summary(self) -> str:
        """How well answers came since the servos were enabled."""
        joints, lost = len(self.joints.joints), self.reception.lost - self._lost_before
        receivers = self._opened_talk().receivers.values()
        return (
            f"Dynamixel: {joints} joints, {self._commanded} periods at {self.joints.rate_hz} Hz, "
            f"{lost} answers missed ({lost / (self._commanded * joints):.3%}), "
            f"{sum(one.crc_errors + one.broken for one in receivers)} packets spoilt, "
            f"{self.late} periods late"
        )

    def claim(self) -> bool:
        """Become the one that commands these ports; False while another one does."""
        return self._life.claim(self._begin)

    def _begin(self, ports: Ports) -> None:
        for port in self.joints.ports:
            ports.read(port)  # what nobody read meanwhile is of the past
        self._forget_asking()
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
        """Whether a joint's servo has an error to tell, in one word."""
        return "alert" if self.reception.alerts[index] else "answers"

    def reset(self) -> None:
        """Forget every alarm, also latched ones; the next command arms the servos anew.

        What is still wrong sounds again.
        """
        self.alarms.reset()
        self._watch.forget()
        self._is_armed = self._is_expired = self._is_watched = False
        self._sent = self._obeyed = None
        self._holding.forget()
        self.limiter.forget()

    # --- read ----------------------------------------------------------------------------------

    def read(self) -> MotorState:
        """The state at the end of this period. Raises DriverError if all ports went away."""
        return self._read(waits=self._waits)

    def _read(self, *, waits: bool) -> MotorState:
        self._life.check()
        ours = self._claim.is_held or self._claim.is_free()
        if ours and not self._has_asked:
            self._ask(None)
        if waits:
            self._periods.wait(self._hear_some if ours else _hear_nothing)
        if ours:
            self._hear(is_over=True)
        asked, self._asked = self._asked, np.zeros_like(self._asked)
        self._has_asked = False
        return self._state(asked)

    def _hear_some(self) -> None:
        self._hear(is_over=False)

    def _hear(self, *, is_over: bool) -> None:
        """Take what came in; at the end of a period what has begun is given up."""
        ports, receivers = self._life.lines, self._opened_talk().receivers
        now_s = self._clock.now_s()
        for port, receiver in receivers.items():
            heard = receiver.take(ports.read(port))
            if is_over:
                heard += receiver.give_up()
            if heard:
                self.reception.take(port, heard, now_s)
        for port, why in ports.gone.items():
            self._watch.unplugged(port, why)

    def _state(self, asked: npt.NDArray[np.bool_]) -> MotorState:
        now_s, heard = self._clock.now_s(), self.reception
        heard.end_period(asked)
        q, qd, tau = heard.at_joints(self._gearing)
        self._watch.look(now_s, heard, q, qd, receivers=self._opened_talk().receivers)
        self._commanded += self._is_armed
        if self._is_armed:
            self._news.say(now_s)
        return MotorState(
            stamp_s=now_s,
            q=q,
            qd=qd,
            tau=tau,
            temperature_c=heard.temperature_c.copy(),
            age_s=now_s - heard.heard_s,
            watchdog=not self._is_armed or self._is_expired,
            command_stamp_s=-np.inf if self._sent is None else self._sent.stamp_s,
            alarms=self.alarms.messages() if self._is_armed else (),
        )

    # --- write ---------------------------------------------------------------------------------

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command, limited; returns the torques that the packets say, and no gains.

        While an alarm says HOLD, the last targets are held in its place.

        Raises:
            DriverError: if a value is not finite or a shape is wrong (nothing is sent), another
                driver commands, or a servo cannot be enabled.
        """
        self._life.check()
        self.limiter.check(command)
        if not self.claim():
            raise DriverError("another controller commands the motors")
        self.arm()
        q, qd, _ = self.reception.at_joints(self._gearing)
        measured = Measured(q, qd, self.reception.temperature_c)
        wanted = self._holding.decided(command, self.alarms.level, obeyed=self._obeyed, q=q)
        limited = self.limiter.apply(wanted, measured)
        self._obeyed = limited
        tau = limited.kp * (limited.q_des - q) + limited.kd * (limited.qd_des - qd)
        tau = np.where(self.reception.misses >= STALE_PERIODS, 0.0, tau) + limited.tau_ff
        steps = np.clip(np.rint(tau / self._nm_a_step), -self._most, self._most)
        self._ask(steps)
        zero = np.zeros_like(q)
        self._sent = MotorCommand(
            command.stamp_s, zero, zero.copy(), steps * self._nm_a_step, zero.copy(), zero.copy()
        )
        return self._sent

    def arm(self) -> None:
        """Enable all servos, with no torque, unless they are; their watchdogs wait for a command.

        Raises:
            DriverError: if one is not what the map says, or does not.
        """
        if self._is_armed:
            return
        talk = self._opened_talk()
        if not self._is_known:
            self._interview(talk)
        arming.arm(talk)
        self._is_armed, self._is_expired, self._is_watched = True, False, False
        self._forget_asking()
        self._spoke_s = self._clock.now_s()
        self._periods.begin()
        if silent := unheard(
            self.joints.joints, lambda: self._read(waits=True), lambda: self.reception.heard_s
        ):
            self._is_armed = False
            arming.switch_off(talk)
            raise DriverError(f"all servos are switched off again: no word of {', '.join(silent)}")
        self._lost_before, self._commanded = self.reception.lost, 0

    def _forget_asking(self) -> None:
        """Nobody answers what was asked before."""
        self._asked[:] = False
        self._has_asked = False
        for receiver in self._opened_talk().receivers.values():
            receiver.give_up()

    def _ask(self, steps: Array | None) -> None:
        """Send currents, if there are any, and ask for the state, in one write a port."""
        ports, now_s = self._life.lines, self._clock.now_s()
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


def _hear_nothing() -> None:
    """Of ports that another program reads."""
