"""Hobby servos as a `MotorBus`: they are told where to go, and say nothing.

Where a joint is taken to be is where it was sent: no speed, torque or temperature is known, and
`age_s` is infinite. A servo has a stiffness of its own, so that a command's gains say one thing:
with kp = 0 it gets no pulse, and most then give no torque. It has no watchdog either: it goes on
with its last pulse when the computer dies.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from robot.clock import WallClock
from robot.drivers.motor_bus import Capability, MotorCommand
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.heard import Heard
from robot.drivers.motors.limiter import Measured
from robot.drivers.motors.line_family import LineFamily
from robot.drivers.motors.line_motors import LineMotors
from robot.drivers.motors.pwm import joint_map
from robot.drivers.motors.pwm.chips import Chips, ThreadedChips, real_bus
from robot.drivers.motors.pwm.emulated import emulated_bus
from robot.drivers.motors.pwm.joint_map import PulseMap
from robot.drivers.motors.pwm.pca9685 import OFF, TICKS, ticks
from robot.drivers.motors.pwm.watching import Watch
from robot.drivers.motors.transmission import Transmission
from robot.se3 import Array

ASSUMED, NO_PULSE = "assumed", "no_pulse"
"""What is known of a servo: it stands where it was sent, or that it is not sent anywhere."""


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


class Assumed(Heard):
    """Where joints are taken to be: where they were sent. Nothing else is known of them."""

    def __init__(self, joints: PulseMap) -> None:
        """They stand at their start."""
        super().__init__(joints, np.full(len(joints.joints), np.inf))
        self.q[:] = [one.start_rad for one in joints.joints.values()]
        self.tau[:] = np.nan

    def at_joints(self, transmission: Transmission) -> tuple[Array, Array, Array]:  # noqa: ARG002
        """Angles of the joints, no speeds, and torques that nobody knows."""
        return self.q, self.qd, self.tau


class PwmMotors(LineMotors[PulseMap, Chips, Assumed, Watch]):
    """All hobby servos of a map (`LineMotors`); of them nothing is heard.

    `alarms` are of their chips. At the end their pulses are taken away: they can do nothing else.
    """

    capabilities: frozenset[Capability] = frozenset()
    title, scheme = "PWM", "i2c"
    brakes = False

    def _prepare(self) -> None:
        joints = self.joints
        self._motors = list(joints.joints.values())
        self._frame_s = [joints.chips[one.chip].frame_s for one in self._motors]
        self._index = {name: index for index, name in enumerate(joints.joints)}
        self._ours = [chip for chip in joints.chips if joints.on(chip)]
        self._forget()

    def _forget(self) -> None:
        self.reception = Assumed(self.joints)
        self._exact: Array = self.reception.q.copy()  # before it was rounded to ticks
        self._on: npt.NDArray[np.bool_] = np.zeros(len(self._motors), np.bool_)

    def _meet(self, lines: Chips, *, is_free: bool) -> None:  # noqa: ARG002
        """They were seen to be there as they were opened; nothing is written, no pulse given."""
        self._forget()
        self._sent = None
        self.limiter.forget()

    def _watches(self, lines: Chips) -> Watch:
        return Watch(self.joints, self.alarms, lines)

    def _damp(self, lines: Chips) -> None:
        """Nothing: they cannot brake."""

    def _let_go(self, lines: Chips) -> list[str]:
        return [name for chip in lines.off() for name in self.joints.on(chip)]

    def _summary(self) -> str:
        return f"PWM: {self._where}, {self._commanded} periods; not measured"

    def _drop(self, lines: Chips) -> None:
        """Nothing came in."""

    def status_of(self, index: int) -> str:
        """Whether a joint's servo is sent anywhere, in one word."""
        return ASSUMED if self._on[index] else NO_PULSE

    def reset(self) -> None:
        """Forget every alarm, also latched ones; the next command starts chips that do not run."""
        super().reset()
        self._forget()

    def _enable(self, lines: Chips) -> bool:
        """Start the chips; where they pulse already, servos are taken to stand.

        Nothing else is to be enabled: a servo goes by its first pulse.
        """
        for chip, counts in lines.start().items():
            ours = self.joints.on(chip)
            first = min(one.id for one in ours.values())
            for name, one in ours.items():
                if (count := counts[one.id - first]) != OFF:
                    pulse_s = count * self.joints.chips[chip].frame_s / TICKS
                    self.reception.q[self._index[name]] = one.at_rad(pulse_s)
        self._exact = self.reception.q.copy()
        return False

    def _obey(self, lines: Chips, command: MotorCommand) -> MotorCommand:
        """While an alarm says HOLD, pulses stay as they are."""
        if self.alarms.level != Level.HOLD:
            nothing = np.full(len(self._motors), np.nan)
            measured = Measured(self._exact, np.zeros_like(self._exact), nothing)
            return self._send(lines, self.limiter.apply(command, measured))
        return self._told(command.stamp_s)

    def _send(self, lines: Chips, command: MotorCommand) -> MotorCommand:
        self._on = command.kp > 0.0
        self._exact = np.where(self._on, command.q_des, self._exact)
        counts = self._counts(command.q_des)
        for chip in self._ours:
            lines.put(chip, self._outputs(chip, counts))
        return self._told(command.stamp_s)

    def _told(self, stamp_s: float) -> MotorCommand:
        """Where the pulses send the joints."""
        zero = np.zeros(len(self._motors))
        return MotorCommand(
            stamp_s, self.reception.q.copy(), zero, zero.copy(), zero.copy(), zero.copy()
        )

    def _counts(self, q_des: Array) -> list[int]:
        """Ticks of every joint; remembers where they send those that get a pulse."""
        counts: list[int] = []
        for index, one in enumerate(self._motors):
            if not self._on[index]:
                counts.append(OFF)
                continue
            frame_s = self._frame_s[index]
            count = ticks(one.pulse_s(float(q_des[index])), frame_s)
            self.reception.q[index] = one.at_rad(count * frame_s / TICKS)
            counts.append(count)
        return counts

    def _outputs(self, chip: str, counts: list[int]) -> list[int]:
        """Of a chip, from its first output that is ours to its last."""
        ours = {one.id: counts[self._index[name]] for name, one in self.joints.on(chip).items()}
        return [ours.get(channel, OFF) for channel in range(min(ours), max(ours) + 1)]


FAMILY = LineFamily(
    file=joint_map.FILE,
    map=PulseMap,
    load=joint_map.load,
    lines="chips",
    at="emulated",
    stem="i2c",
    ports=lambda joints, _: chips_of(joints),
    motors=PwmMotors,
)
