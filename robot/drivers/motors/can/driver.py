"""Motors on CAN buses as a `MotorBus`: asked at the start, limited, watched, told what is wrong."""

from __future__ import annotations

from collections.abc import Callable
from typing import Self

import numpy as np

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motor_bus import MIT_MODE, MotorBus, MotorCommand, MotorState
from robot.drivers.motors.alarms import Alarms, News, untold
from robot.drivers.motors.can import arming, joint_map, watching
from robot.drivers.motors.can.coding import Coding
from robot.drivers.motors.can.emulated import EmulatedBuses, buses_in
from robot.drivers.motors.can.fields import limits
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.interview import interview
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.can.packed import packed, size_on
from robot.drivers.motors.can.ports import Ports, PythonCan, check_buses
from robot.drivers.motors.can.reception import Reception
from robot.drivers.motors.can.sending import TransmitQueue
from robot.drivers.motors.can.values import ENABLED
from robot.drivers.motors.can.verdicts import verdicts
from robot.drivers.motors.claim import Claim
from robot.drivers.motors.findings import refuse_grave
from robot.drivers.motors.holding import Holding
from robot.drivers.motors.life import Life, not_let_go
from robot.drivers.motors.limiter import Limiter, Measured
from robot.drivers.motors.periods import Periods
from robot.drivers.motors.plant_behind import PlantClock
from robot.drivers.motors.speed_check import SpeedCheck
from robot.drivers.motors.transmission import AtMotors, Transmission
from robot.drivers.motors.watching import SILENT_PERIODS
from robot.drivers.wiring import Wiring
from robot.errors import DriverError

INHERITS_PERIODS = 3
"""For so many at most replies are waited for of motors that another program left enabled."""

STALE_CALLS = 16
"""More than an interface's receive buffer holds."""


def make(wiring: Wiring) -> MotorBus:
    """The motors that `can.yaml` beside the description names.

    Raises:
        ConfigError: the file says what cannot be meant, or lacks a motor of the robot.
        DriverError: the user does not let robots open one of its buses.
    """
    return wired(joint_map.beside(wiring.robot), wiring)


def wired(joints: JointMap, wiring: Wiring) -> CanMotors:
    """The motors of a map, emulated where a process emulates them.

    Raises:
        DriverError: the user does not let robots open one of its buses.
    """
    if wiring.emulated is None:
        check_buses(joints.buses)
        clock = wiring.clock
        return CanMotors(joints, clock, ports=lambda: PythonCan(joints.buses, clock), tell=print)
    plant = wiring.simulated_plant()
    there, time = buses_in(joints, wiring.emulated), PlantClock(plant)
    return CanMotors(there, time, ports=lambda: EmulatedBuses(there, plant, time), tell=print)


class CanMotors(Closing):
    """All motors of a joint map.

    A command is sent once, replies are awaited until the next period begins. What they tell, and
    that they do not, sounds `alarms`; at HOLD it is those that decide what is sent.

    Attributes:
        joints: the map, in the order of every array.
        alarms: what is wrong now.
    """

    capabilities = MIT_MODE

    def __init__(
        self,
        joints: JointMap,
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
            ports: opens its buses.
            tell: hears a line of every alarm, and at the end how well replies came.
            lets_go: whether motors are disabled at the end, and so give no torque, in place of
                damping on by themselves: for one joint on a bench, not for a robot on its feet.
        """
        self.joints = joints
        self.alarms = Alarms()
        self._tell, self._news = tell, News(self.alarms, tell)
        self._lets_go = lets_go
        self._commanded = self._lost_before = 0
        self._clock, self._periods = clock, Periods(clock, joints.period_s)
        self._motors = list(joints.joints.values())
        self._transmission, self.limiter = Transmission(joints), Limiter(joints)
        self._refreshes = _refreshes(joints)
        self._claim = Claim(f"{bus.interface}:{bus.channel}" for bus in joints.buses.values())
        self._life = Life(ports, self._claim)
        self.queues = {
            bus: TransmitQueue(bus, size_on(is_fd=one.is_fd)) for bus, one in joints.buses.items()
        }
        self._is_armed = False
        self._asked = False
        self._asks = True
        self._claimed_s = np.inf
        self._unset: list[tuple[str, Frame]] = []
        self._sent: MotorCommand | None = None
        self._holding = Holding()

    def __enter__(self) -> Self:
        """Open the buses, and ask every motor who it is; nothing is enabled.

        While another program commands them nobody is asked: these questions would take the place of
        its commands. They are then asked before the motors are enabled from here.

        Raises:
            DriverError: if a bus cannot be opened, or a motor is not what the map says: with
                everything that disagrees.
        """
        self.ranges = [one.expected for one in self._motors]
        self._is_known = False
        self._asks = self._life.open(self._interview)
        self._understand()
        self._watch = watching.Watch(self.joints, self.alarms)
        self._periods.begin()
        for _ in range(SILENT_PERIODS):
            self.read()
        return self

    def _interview(self, ports: Ports) -> None:
        """Ask every motor who it is. Raises DriverError with everything that disagrees."""
        answers = interview(ports, self._clock, self.joints)
        refuse_grave(verdicts(self.joints, answers), "motors")
        self.ranges = [
            answers[name].ranges(one) or one.expected for name, one in self.joints.joints.items()
        ]
        self._is_known = True

    def _understand(self) -> None:
        """Read and write frames by the ranges that the motors have."""
        self._low, self._high = limits(self.ranges)
        gears = [one.gear for one in self._motors]
        self._transmission.most_nm = np.array([most.torque_nm for most in self.ranges]) * gears
        self._coding = Coding(self.joints, self.ranges)
        self.reception = Reception(self.joints, self.ranges, self._coding)

    def close(self) -> None:
        """Leave the motors damping for themselves, if they are commanded from here, and close.

        Raises:
            DriverError: if they were to be disabled, and one was not seen to do so.
        """
        self._life.close(self._leave, self._left)

    def _leave(self, ports: Ports) -> None:
        """Damping, or disabled. Raises DriverError if one was not seen to be disabled."""
        if not self._is_armed:
            return
        if not self._lets_go:
            arming.leave_damping(ports, self._clock, self.joints, self.ranges)
        elif on := arming.disable(ports, self._clock, self.joints, self.ranges):
            raise not_let_go(on)

    def _left(self) -> None:
        self._is_armed = False
        if self._commanded:
            self._tell(self._summary())

    def _summary(self) -> str:
        """How well replies came since the motors were enabled."""
        joints, lost = len(self.joints.joints), self.reception.lost - self._lost_before
        share = lost / (self._commanded * joints)
        return (
            f"CAN: {joints} joints, {self._commanded} periods at {self.joints.rate_hz} Hz, {lost} "
            f"replies late ({share:.3%}), {self.late} periods late"
        )

    def claim(self) -> bool:
        """Become the one that commands these buses; False while another one does.

        Where that one died a moment ago its motors are still enabled: they are asked at once, and
        the next command goes to them as they are.
        """
        return self._life.claim(self._begin)

    def _begin(self, ports: Ports) -> None:
        for _ in range(STALE_CALLS):  # what nobody read meanwhile is of the past
            if not ports.receive_packed():
                break
        self._claimed_s = self._clock.now_s()
        self._periods.begin()
        self._asks = True
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
        """What a joint's motor says of itself, in one word."""
        return self._motors[index].family.status(int(self.reception.status[index])).code

    def reset(self) -> None:
        """Forget every alarm, also latched ones; motors that let go are armed by the next command.

        What is still wrong sounds again.
        """
        self.alarms.reset()
        self._watch.forget()
        self._is_armed, self._sent = False, None
        self._holding.forget()
        self.limiter.forget()

    # --- read ------------------------------------------------------------------------------------

    def read(self) -> MotorState:
        """The state at the end of this period. Raises DriverError if all buses went away."""
        ports = self._life.lines
        commands = self._asked
        if not commands and self._asks:
            self._ask()
        self._periods.wait(self._hear)
        for bus, why in ports.gone.items():
            self._watch.unplugged(bus, why)
        self._asked = False
        state = self._state()
        if not commands:
            self._asks = self._claim.is_held or self._is_alone()
        return state

    def _hear(self) -> None:
        """Take what came in, and send what the interfaces had no room for."""
        ports = self._life.lines
        if came := ports.receive_packed():
            for bus in self.reception.take(came, self._clock.now_s()):
                self._watch.bus_off(bus)
        if any(queue.waiting for queue in self.queues.values()):
            self._flush(ports)

    def _is_alone(self) -> bool:
        """Whether motors tell nothing unless they are asked from here.

        Where another program commands all hear what it is told; asked as well, there are two
        replies, and the bus gets too full.
        """
        heard = self.reception
        if self._asks:
            return heard.most_replies < 2
        if int(heard.misses.min()) >= SILENT_PERIODS:
            return True
        return bool(heard.misses.any()) and self._claim.is_free()

    def _state(self) -> MotorState:
        now_s, heard = self._clock.now_s(), self.reception
        heard.end_period()
        self._at = q, qd, tau = heard.at_joints(self._transmission)
        self._watch.joints.linkages(self._transmission.unsolved)
        self._watch.look(now_s, heard, q, qd, self.queues, is_armed=self._is_armed)
        self._commanded += self._is_armed
        if self._is_armed:
            self._news.say(now_s)
        odd = np.flatnonzero(heard.status != ENABLED).tolist()
        let_go = any(self.status_of(index) == watching.LOST for index in odd)
        return MotorState(
            stamp_s=now_s,
            q=q.copy(),
            qd=qd.copy(),
            tau=tau.copy(),
            temperature_c=heard.temperature_c.copy(),
            age_s=now_s - heard.heard_s,
            watchdog=not (self._is_armed or self._is_left_enabled) or let_go,
            command_stamp_s=self._commanded_s(now_s),
            alarms=self.alarms.messages() if self._is_armed else (),
        )

    def _commanded_s(self, now_s: float) -> float:
        """Of the last command; that of another program is no older than the motors' watchdog."""
        if self._sent is not None:
            return self._sent.stamp_s
        return now_s if self._is_left_enabled else -np.inf

    @property
    def _is_left_enabled(self) -> bool:
        """Whether a program that commanded until a moment ago left all motors enabled.

        They were what the map says when it enabled them; it was not asked again here.
        """
        heard = self.reception
        if self._is_known or self._is_armed or not self._claim.is_held:
            return False
        return bool((heard.heard_s >= self._claimed_s).all() and (heard.status == ENABLED).all())

    def _inherit(self) -> bool:
        """Take over motors that are still enabled; False if any is not."""
        for _ in range(INHERITS_PERIODS):
            if self._is_known or (self.reception.heard_s >= self._claimed_s).all():
                break
            self.read()
        if not self._is_left_enabled:
            return False
        self._unset = arming.watchdogs(self.joints, self.joints.watchdog_s)
        return True

    def _ask(self) -> None:
        """Ask every motor for feedback: nobody commanded since the last reading."""
        for bus, frames in self._refreshes.items():
            self.queues[bus].put(frames)
        self._flush(self._life.lines)

    # --- write -----------------------------------------------------------------------------------

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command, limited; returns what the frames say.

        While an alarm says HOLD, the last targets are sent in its place.

        Raises:
            DriverError: if a value is not finite or a shape is wrong (nothing is sent), another
                driver commands, or a motor cannot be enabled.
        """
        ports = self._life.lines
        self.limiter.check(command)
        if not self.claim():
            raise DriverError("another controller commands the motors")
        if not self._is_armed:
            if self._inherit():
                self._tell("the motors were left enabled: they are commanded as they are")
            else:
                self._arm(ports)
            self._is_armed = True
            self._lost_before, self._commanded = self.reception.lost, 0
            self.reception.status[:] = ENABLED
            self._periods.begin()
        q, qd, _ = self._at
        measured = Measured(q, qd, self.reception.temperature_c)
        wanted = self._holding.decided(command, self.alarms.level, obeyed=self._sent, q=q)
        limited = self.limiter.apply(wanted, measured)
        self._sent = self._send(ports, limited)
        # Behind the first commands: who left the motors may have switched their watchdogs off.
        self._unset = [(bus, frame) for bus, frame in self._unset if not ports.send(bus, frame)]
        return self._sent

    def _arm(self, ports: Ports) -> None:
        """Enable all motors. Raises DriverError if one is not what the map says, or does not."""
        if not self._is_known:
            self._interview(ports)
            self._understand()
        told = arming.arm(ports, self._clock, self.joints, self.ranges)
        self.reception.found([told[name] for name in self.joints.joints], self._clock.now_s())
        self._at = self.reception.at_joints(self._transmission)

    def _send(self, ports: Ports, command: MotorCommand) -> MotorCommand:
        transmission, (q, qd, _) = self._transmission, self._at
        targets = np.stack(transmission.at_motors(command, q, qd))
        np.clip(targets, self._low, self._high, out=targets)
        frames, said = self._coding.commands(targets)
        for bus, packed_frames in frames.items():
            self.queues[bus].put(packed_frames)
        self._flush(ports)
        self._asked = True
        return transmission.said(command, AtMotors(*said), q, qd)

    def _flush(self, ports: Ports) -> None:
        now_s = self._clock.now_s()
        for queue in self.queues.values():
            queue.flush(ports, now_s)


def _refreshes(joints: JointMap) -> dict[str, bytes]:
    """Packed questions for feedback, by bus, to all motors that can be asked."""
    return {
        bus: b"".join(
            packed(asking.refresh(one.id))
            for one in joints.on(bus).values()
            if (asking := one.family.asking) is not None
        )
        for bus in joints.buses
    }
