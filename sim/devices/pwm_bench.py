"""Hobby servos on a bench: what a map says there is, emulated, each with a shaft of its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, Self, cast, get_args

from robot.clock import SimulatedClock
from robot.drivers.motors.pwm.chips import Chips, Health, writers_of
from robot.drivers.motors.pwm.driver import outputs
from robot.drivers.motors.pwm.joint_map import JointPulse, PulseMap
from robot.errors import ConfigError, DriverError
from sim.devices.flaws import unknown
from sim.devices.hobby_servo import HobbyServo
from sim.devices.i2c_bus import EmulatedSmbus, I2cBus
from sim.devices.pca9685 import Pca9685Chip
from sim.devices.shaft import FreeShaft, Shaft

Flaw = Literal["silent", "stuck", "slow_clock"]
"""What can be wrong with the chip of a servo, or its bus; of the servo itself nobody would know."""
FLAWS: tuple[Flaw, ...] = get_args(Flaw)
SPARE = 1.25
HELD = 0.05
"""Friction of gears: N m s/rad."""


@dataclass(frozen=True)
class PwmBench:
    """Emulated buses, chips and servos.

    Attributes:
        clock: their time.
        buses: by the map's names of chips; chips of one bus share it.
        chips: by the map's names.
        servos: by the map's names of joints.
    """

    clock: SimulatedClock
    buses: Mapping[str, I2cBus]
    chips: Mapping[str, Pca9685Chip]
    servos: Mapping[str, HobbyServo]

    def live(self, until_s: float) -> None:
        """Let the servos' time go by up to a moment."""
        self.clock.set(max(self.clock.now_s(), until_s))
        for servo in self.servos.values():
            servo.live(until_s)


def bench_of(wanted: PulseMap | None, shafts: Mapping[str, Shaft], now_s: float) -> PwmBench:
    """The chips of a map, if there is one, whose servos turn these shafts, by joint."""
    clock = SimulatedClock(now_s)
    if wanted is None:
        return PwmBench(clock, {}, {}, {})
    by_number: dict[int, I2cBus] = {}
    buses: dict[str, I2cBus] = {}
    chips: dict[str, Pca9685Chip] = {}
    for name, chip in wanted.chips.items():
        buses[name] = by_number.setdefault(chip.bus, I2cBus(clock.now_s))
        chips[name] = Pca9685Chip(oscillator_hz=chip.oscillator_hz)
        buses[name].chips[chip.address] = chips[name]
    servos = {
        name: servo_on(joint, chips[joint.chip], shafts[name], now_s)
        for name, joint in wanted.joints.items()
    }
    return PwmBench(clock, buses, chips, servos)


def servo_on(joint: JointPulse, chip: Pca9685Chip, shaft: Shaft, now_s: float) -> HobbyServo:
    """A servo that does what the map says of its joint, and something more."""
    return HobbyServo(
        chip, joint.id, shaft, pulse_us=joint.pulse_us, travel_rad=joint.travel_rad,
        speed_rad_s=SPARE * joint.velocity_limit_rad_s * joint.gear,
        torque_nm=joint.torque_limit_nm / joint.gear, now_s=now_s,
    )  # fmt: skip


def build(
    wanted: PulseMap,
    *,
    now_s: float = 0.0,
    flaws: Mapping[str, str] | None = None,
    is_still: bool = False,  # noqa: ARG001 - they do not swing: nobody would see it
) -> PwmBench:
    """The servos of a map, where the map takes them to stand.

    Args:
        wanted: the map.
        now_s: when their time begins.
        flaws: what is wrong with whose chip, by joint.
        is_still: they are.

    Raises:
        ConfigError: if a joint or a flaw is unknown.
    """
    flaws = flaws or {}
    if problems := unknown(flaws, joints=wanted.joints, known=FLAWS):
        raise ConfigError(problems)
    shafts = {
        name: FreeShaft(q_rad=one.motor_rad(one.start_rad), inertia_kg_m2=0.001, friction_nm_s=HELD)
        for name, one in wanted.joints.items()
    }
    for shaft in shafts.values():
        shaft.step_s = 0.001
    made = bench_of(wanted, shafts, now_s)
    for name, flaw in flaws.items():
        chip = wanted.joints[name].chip
        match cast("Flaw", flaw):
            case "silent":
                made.chips[chip].is_powered = False
            case "stuck":
                made.buses[chip].trouble.is_stuck = True
            case "slow_clock":
                made.chips[chip].oscillator_hz *= 0.95
    return made


class DirectChips(Chips):
    """A driver's chips straight on emulated buses, in simulated time: no thread, no process."""

    def __init__(self, wanted: PulseMap, bench: PwmBench, clock: SimulatedClock) -> None:
        """Know the bench; nothing is opened."""
        self._bench, self._clock = bench, clock
        self._writers = writers_of(wanted.chips, outputs(wanted))
        self._is_open = self._is_started = False

    def __enter__(self) -> Self:
        """Reach them."""
        self._play()
        for name, writer in self._writers.items():
            writer.reach(EmulatedSmbus(self._bench.buses[name]))
        self._is_open = True
        return self

    def start(self) -> Mapping[str, Sequence[int]]:
        """Start those that do not run."""
        found = {name: writer.start(self._sleep) for name, writer in self._writers.items()}
        self._is_started = True
        return found

    def outputs(self) -> Mapping[str, Sequence[int] | None]:
        """What each chip outputs."""
        return {name: writer.outputs() for name, writer in self._writers.items()}

    def _sleep(self, span_s: float) -> None:
        self._clock.sleep_until(self._clock.now_s() + span_s)
        self._play()

    def _play(self) -> None:
        self._bench.live(self._clock.now_s())

    def put(self, chip: str, counts: Sequence[int]) -> None:
        """Hand over pulses."""
        self._check()
        self._writers[chip].put(counts)
        self.tell()

    def tell(self) -> None:
        """Let frames that are due be written, and servos move."""
        if self._is_started:
            for writer in self._writers.values():
                writer.frame(self._clock.now_s())
        self._play()

    def health(self, chip: str) -> Health:
        """How a chip is."""
        self._check()
        self.tell()
        return self._writers[chip].health_at(self._clock.now_s())

    def off(self) -> list[str]:
        """Take all pulses away."""
        self._is_started = False
        return [name for name, writer in self._writers.items() if not writer.off()]

    def _check(self) -> None:
        if not self._is_open:
            raise DriverError("the chips are not open")

    def close(self) -> None:
        """Tell nothing any more."""
        self._is_open = self._is_started = False
