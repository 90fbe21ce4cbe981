"""Hobby servos as a `MotorBus`: they are told where to go, and say nothing.

Where a joint is taken to be is where it was sent: no speed, torque or temperature is known, and
`age_s` is infinite. A servo has a stiffness of its own, so that a command's gains say one thing:
with kp = 0 it gets no pulse, and most then give no torque. It has no watchdog either: it goes on
with its last pulse when the computer dies.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Self

import numpy as np
import numpy.typing as npt

from robot.clock import Clock, WallClock
from robot.closing import Closing
from robot.drivers.motor_bus import Capability, MotorCommand, MotorState
from robot.drivers.motors.alarms import Alarms, Level, News, untold
from robot.drivers.motors.claim import Claim
from robot.drivers.motors.life import Life, not_let_go
from robot.drivers.motors.limiter import Limiter, Measured
from robot.drivers.motors.periods import Periods
from robot.drivers.motors.plant_behind import PlantClock
from robot.drivers.motors.pwm.chips import Chips, ThreadedChips, check_chips, real_bus
from robot.drivers.motors.pwm.emulated import EmulatedChips, chips_in, emulated_bus
from robot.drivers.motors.pwm.joint_map import PulseMap
from robot.drivers.motors.pwm.pca9685 import OFF, TICKS, ticks
from robot.drivers.motors.pwm.watching import Watch
from robot.drivers.motors.speed_check import SpeedCheck
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.se3 import Array

ASSUMED, NO_PULSE = "assumed", "no_pulse"
"""What is known of a servo: it stands where it was sent, or that it is not sent anywhere."""


def wired(joints: PulseMap, wiring: Wiring, *, waits: bool) -> PwmMotors:
    """The servos of a map, emulated where a process emulates them.

    Args:
        joints: the map.
        wiring: of the process.
        waits: as `PwmMotors` has it.

    Raises:
        DriverError: the user does not let robots open one of its buses.
    """
    if wiring.emulated is None:
        check_chips(joints.chips)
        opens = partial(chips_of, joints)
        return PwmMotors(joints, wiring.clock, ports=opens, tell=print, waits=waits)
    plant = wiring.simulated_plant()
    there, time = chips_in(joints, wiring.emulated), PlantClock(plant)
    return PwmMotors(
        there, time, ports=lambda: EmulatedChips(there, plant), tell=print, waits=waits
    )


def chips_of(joints: PulseMap) -> Chips:
    """The chips of a map, on buses of this machine or at the sockets of emulated ones."""
    return ThreadedChips(
        joints.chips,
        outputs(joints),
        WallClock(),
        opens=lambda chip: emulated_bus(chip) if chip.emulated else real_bus(chip),
    )


def outputs(joints: PulseMap) -> dict[str, list[int]]:
    """Which are ours, by chip."""
    return {chip: [one.id for one in joints.on(chip).values()] for chip in joints.chips}


class Unheard:
    """Nothing is ever heard of these servos.

    Attributes:
        lost: 0: no reply is awaited.
    """

    lost = 0

    def forget_where(self) -> None:
        """It is not known anyway."""


class PwmMotors(Closing):
    """All hobby servos of a map.

    Attributes:
        joints: the map, in the order of every array.
        alarms: what is wrong with the chips now.
        reception: nothing.
        speeds: nothing that could be compared.
    """

    capabilities: frozenset[Capability] = frozenset()

    def __init__(
        self,
        joints: PulseMap,
        clock: Clock,
        *,
        ports: Callable[[], Chips],
        tell: Callable[[str], None] = untold,
        waits: bool = True,
        lets_go: bool = True,
    ) -> None:
        """Know the servos; nothing is opened.

        Args:
            joints: the map.
            clock: of its periods.
            ports: reaches its chips.
            tell: hears a line of every alarm, and at the end how chips were.
            waits: whether `read` waits for the end of a period; False where another driver of the
                same robot sets the pace.
            lets_go: they can do nothing else: pulses are taken away at the end.
        """
        del lets_go
        self.joints = joints
        self.alarms = Alarms()
        self.reception, self.speeds = Unheard(), SpeedCheck(len(joints.joints))
        self._tell, self._news, self._waits = tell, News(self.alarms, tell), waits
        self._clock, self._periods = clock, Periods(clock, joints.period_s)
        self.limiter, self._watch = Limiter(joints), Watch(joints, self.alarms)
        self._servos = list(joints.joints.values())
        self._frame_s = [joints.chips[one.chip].frame_s for one in self._servos]
        self._start: Array = np.array([one.start_rad for one in self._servos])
        self._claim = Claim(f"i2c:{at}" for at in joints.channels.values())
        self._life = Life(ports, self._claim)
        self._index = {name: index for index, name in enumerate(joints.joints)}
        self._is_armed = False
        self._commanded = 0
        self._forget()

    def _forget(self) -> None:
        self._sent: MotorCommand | None = None
        self._q: Array = self._start.copy()
        self._exact: Array = self._start.copy()  # before it was rounded to ticks
        self._on: npt.NDArray[np.bool_] = np.zeros(len(self._servos), np.bool_)
        self.limiter.forget()

    def __enter__(self) -> Self:
        """See whether all chips are there; nothing is written, and no pulse is given.

        Raises:
            DriverError: if a bus or a chip is not there.
        """
        self._forget()
        self._life.open(lambda _: None)
        self._periods.begin()
        return self

    def close(self) -> None:
        """Take all pulses away, if they are given from here, and close.

        Raises:
            DriverError: if a chip was not seen to do so.
        """
        self._life.close(self._leave, self._left)

    def _leave(self, chips: Chips) -> None:
        if not self._is_armed:
            return
        if on := chips.off():
            raise not_let_go(name for chip in on for name in self.joints.on(chip))

    def _left(self) -> None:
        self._is_armed = False
        if self._commanded:
            self._tell(f"PWM: {len(self._servos)} joints, {self._commanded} periods; not measured")

    def claim(self) -> bool:
        """Become the one that commands these chips; False while another one does."""
        return self._life.claim(lambda _: self._periods.begin())

    @property
    def late(self) -> int:
        """Periods that began late by more than one."""
        return self._periods.late

    def status_of(self, index: int) -> str:
        """Whether a joint's servo is sent anywhere, in one word."""
        return ASSUMED if self._on[index] else NO_PULSE

    def reset(self) -> None:
        """Forget every alarm, also latched ones; the next command starts chips that do not run.

        What is still wrong sounds again.
        """
        self.alarms.reset()
        self._is_armed = False
        self._forget()

    @property
    def _ours(self) -> list[str]:
        return [chip for chip in self.joints.chips if self.joints.on(chip)]

    def read(self) -> MotorState:
        """Where the joints are taken to be, at the end of this period."""
        chips = self._life.lines
        if self._waits:
            self._periods.wait(lambda: None)
        for chip in self._ours:
            self._watch.look(chip, chips.health(chip))
        now_s = self._clock.now_s()
        self._commanded += self._is_armed
        if self._is_armed:
            self._news.say(now_s)
        nothing = np.full(len(self._servos), np.nan)
        return MotorState(
            stamp_s=now_s,
            q=self._q.copy(),
            qd=np.zeros(len(self._servos)),
            tau=nothing,
            temperature_c=nothing.copy(),
            age_s=np.full(len(self._servos), np.inf),
            watchdog=not self._is_armed,
            command_stamp_s=-np.inf if self._sent is None else self._sent.stamp_s,
            alarms=self.alarms.messages() if self._is_armed else (),
        )

    def arm(self) -> None:
        """Start the chips; where they pulse already, servos are taken to stand.

        Nothing else is to be enabled: a servo goes by its first pulse. Raises DriverError if a chip
        does not start.
        """
        if self._is_armed:
            self._life.check()
            return
        for chip, counts in self._life.lines.start().items():
            ours = self.joints.on(chip)
            first = min(one.id for one in ours.values())
            for name, one in ours.items():
                if (count := counts[one.id - first]) != OFF:
                    pulse_s = count * self.joints.chips[chip].frame_s / TICKS
                    self._q[self._index[name]] = one.at_rad(pulse_s)
        self._exact = self._q.copy()
        self._is_armed = True

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send joints where they are to go; returns where the pulses say, and no gains.

        While an alarm says HOLD, pulses stay as they are.

        Raises:
            DriverError: if a value is not finite or a shape is wrong (nothing is sent), or another
                driver commands.
        """
        chips = self._life.lines
        self.limiter.check(command)
        if not self.claim():
            raise DriverError("another controller commands the motors")
        self.arm()
        zero = np.zeros(len(self._servos))
        if self.alarms.level != Level.HOLD:
            measured = Measured(self._exact, zero, np.full(len(self._servos), np.nan))
            limited = self.limiter.apply(command, measured)
            self._on = command.kp > 0.0
            self._exact = np.where(self._on, limited.q_des, self._exact)
            counts = self._counts(limited.q_des)
            for chip in self._ours:
                chips.put(chip, self._outputs(chip, counts))
        self._sent = MotorCommand(
            command.stamp_s, self._q.copy(), zero, zero.copy(), zero.copy(), zero.copy()
        )
        return self._sent

    def _counts(self, q_des: Array) -> list[int]:
        """Ticks of every joint; remembers where they send those that get a pulse."""
        counts: list[int] = []
        for index, one in enumerate(self._servos):
            if not self._on[index]:
                counts.append(OFF)
                continue
            frame_s = self._frame_s[index]
            count = ticks(one.pulse_s(float(q_des[index])), frame_s)
            self._q[index] = one.at_rad(count * frame_s / TICKS)
            counts.append(count)
        return counts

    def _outputs(self, chip: str, counts: list[int]) -> list[int]:
        """Of a chip, from its first output that is ours to its last."""
        ours = {one.id: counts[self._index[name]] for name, one in self.joints.on(chip).items()}
        return [ours.get(channel, OFF) for channel in range(min(ours), max(ours) + 1)]
