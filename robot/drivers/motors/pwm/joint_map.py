"""Which hobby servo moves which joint: `pwm.yaml` beside a robot's description, or another file.

chips:
  hat: {bus: 1, address: 64}
joints:
  head_yaw: {chip: hat, model: MG996R, id: 0, pulse_us: [500, 2500], travel_rad: 3.1416,
             lower_rad: -1.4, upper_rad: 1.4, velocity_limit_rad_s: 4, torque_limit_nm: 0.9}
others: can            # who moves the joints that are not here
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Literal, TypeAlias

import msgspec

from robot.drivers.motors import motor_map
from robot.drivers.motors.motor_map import Motor, MotorMap, Wrong
from robot.drivers.motors.pwm import load as bus_load
from robot.drivers.motors.pwm import pca9685
from robot.drivers.motors.pwm.pca9685 import CHANNELS, OSCILLATOR_HZ
from robot.files import quantities as q

FILE = "pwm.yaml"
ANY_GAIN = 1e6

Bus: TypeAlias = Annotated[int, msgspec.Meta(ge=0, le=255)]
Address: TypeAlias = Annotated[int, msgspec.Meta(ge=0x40, le=0x7F)]
Channel: TypeAlias = Annotated[int, msgspec.Meta(ge=0, le=CHANNELS - 1)]
Rate: TypeAlias = Annotated[int, msgspec.Meta(ge=1, le=2000, extra={"unit": "Hz"})]
FrameRate: TypeAlias = Annotated[float, msgspec.Meta(ge=50.0, le=330.0, extra={"unit": "Hz"})]
BusRate: TypeAlias = Annotated[int, msgspec.Meta(ge=10_000, le=1_000_000, extra={"unit": "bit/s"})]
Oscillator: TypeAlias = Annotated[float, msgspec.Meta(ge=20e6, le=50e6, extra={"unit": "Hz"})]
Pulse: TypeAlias = Annotated[float, msgspec.Meta(ge=300.0, le=3000.0, extra={"unit": "µs"})]
"""Shorter than any frame."""
Travel: TypeAlias = Annotated[float, msgspec.Meta(ge=0.1, le=10.0, extra={"unit": "rad"})]
NoWatchdog: TypeAlias = Annotated[float, msgspec.Meta(ge=0.0, le=0.0, extra={"unit": "s"})]
Model: TypeAlias = Annotated[str, msgspec.Meta(min_length=1, max_length=40)]


class Chip(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A PCA9685.

    Attributes:
        bus: of I2C, as in /dev/i2c-1.
        address: 64 (0x40) to 127, by its solder bridges.
        frame_hz: pulses a second, of all its servos: analogue ones take 50.
        oscillator_hz: its own clock: 25 MHz, off by some per cent from chip to chip.
        bus_hz: bit rate of the bus.
        emulated: a simulation's socket in place of the bus; no map of a person may say that.
    """

    bus: Bus = 1
    address: Address = 0x40
    frame_hz: FrameRate = 50.0
    oscillator_hz: Oscillator = OSCILLATOR_HZ
    bus_hz: BusRate = 100_000
    emulated: str = ""

    @property
    def device(self) -> str:
        """Of its bus."""
        return f"/dev/i2c-{self.bus}"

    @property
    def channel(self) -> str:
        """Where it is, for people."""
        return f"{self.emulated or self.device}:{self.address:#04x}"

    @property
    def scale(self) -> int:
        """What its PRE_SCALE holds."""
        return pca9685.pre_scale(self.frame_hz, self.oscillator_hz)

    @property
    def frame_s(self) -> float:
        """How long its frames really are: no shorter than was asked for."""
        return pca9685.frame_s(self.scale, self.oscillator_hz)


class JointPulse(Motor, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The servo of one joint, and how it sits there (`Mounted`).

    It stands at 0 in the middle of its pulses, and at half its travel either way at their ends.

    Attributes:
        chip: one of `chips`.
        model: for people; nothing is known of it.
        id: its output on the chip.
        pulse_us: of its ends; a longer pulse turns it the way that its sign calls positive.
        travel_rad: from one of these to the other.
        start_rad: the joint is told to go there first, and is taken to stand there before.
    """

    chip: str
    model: Model
    id: Channel
    pulse_us: tuple[Pulse, Pulse] = (1000.0, 2000.0)
    travel_rad: Travel
    start_rad: q.Joint = 0.0

    @property
    def line(self) -> str:
        """Its chip."""
        return self.chip

    @property
    def kp_most(self) -> float:
        """It has a stiffness of its own; of a command's it is asked only whether it is 0."""
        return ANY_GAIN

    @property
    def kd_most(self) -> float:
        """As its stiffness."""
        return ANY_GAIN

    def pulse_s(self, joint_rad: float) -> float:
        """The pulse that sends the joint there."""
        low, high = self.pulse_us
        share = 0.5 + self.motor_rad(joint_rad) / self.travel_rad
        return 1e-6 * (low + (high - low) * share)

    def at_rad(self, pulse_s: float) -> float:
        """Where a pulse sends the joint."""
        low, high = self.pulse_us
        share = (1e6 * pulse_s - low) / (high - low)
        return self.joint_rad((share - 0.5) * self.travel_rad)


class PulseMap(MotorMap, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """All hobby servos of a robot, or of a part of one (`MotorMap`).

    Attributes:
        rate_hz: how often the controller commands them; chips are told once a frame at most.
        watchdog_s: 0: there is none, they pulse on when nobody tells them anything any more.
        chips: by name.
        others: the driver of the robot's joints that are not here; "" where all are.
    """

    rate_hz: Rate = 500
    watchdog_s: NoWatchdog = 0.0
    chips: dict[str, Chip]
    joints: dict[str, JointPulse]
    others: Literal["", "can", "ethernet"] = ""

    @property
    def channels(self) -> Mapping[str, str]:
        """Where its chips are."""
        return {name: chip.channel for name, chip in self.chips.items()}

    def on(self, chip: str) -> dict[str, JointPulse]:
        """The joints of a chip."""
        return {name: one for name, one in self.joints.items() if one.chip == chip}

    def load(self, line: str) -> float:
        """The share of its time that the bus of a chip is busy, with all chips that are on it."""
        chip = self.chips[line]
        beside = [name for name, one in self.chips.items() if one.bus == chip.bus]
        return sum(
            bus_load.load(
                [[joint.id for joint in self.on(name).values()]],
                1.0 / self.chips[name].frame_s,
                chip.bus_hz,
            )
            for name in beside
        )


def load(path: Path | str) -> PulseMap:
    """Read a map.

    Raises:
        ConfigError: with everything that is wrong in it, each with its line and a cure.
    """
    checks = (_names, _places, _pulses, _limits, _loads)
    return motor_map.read(path, PulseMap, begin_with="chips:", checks=checks)


def _names(found: PulseMap) -> Iterator[Wrong]:
    yield from motor_map.nameless(found)
    for name, joint in found.joints.items():
        yield from motor_map.misnamed(
            name, joint, line="chip", plural="chips", lines=found.chips, models=(joint.model,)
        )


def _places(found: PulseMap) -> Iterator[Wrong]:
    """Two chips of one address, or two servos at one output; a socket that a person named."""
    taken: dict[tuple[int, int], str] = {}
    for name, chip in found.chips.items():
        key = chip.bus, chip.address
        if key in taken:
            text = f"{chip.channel} is {taken[key]!r} already"
            yield f"$.chips.{name}.address", text, "solder another address bridge, and say it here"
        taken.setdefault(key, name)
        if chip.emulated:
            yield f"$.chips.{name}.emulated", "that is a simulation's to say", "leave it out"
        outputs: dict[int, str] = {}
        for joint, one in found.on(name).items():
            if one.id in outputs:
                text = f"output {one.id} of the chip {name!r} is {outputs[one.id]}'s already"
                yield f"$.joints.{joint}.id", text, f"give {joint} the output it is plugged into"
            outputs.setdefault(one.id, joint)


def _pulses(found: PulseMap) -> Iterator[Wrong]:
    for name, joint in found.joints.items():
        where, (low, high) = f"$.joints.{name}", joint.pulse_us
        if low >= high:
            text = "its shortest pulse is not below its longest"
            yield f"{where}.pulse_us", text, "exchange them; sign turns it the other way"
        if not joint.lower_rad <= joint.start_rad <= joint.upper_rad:
            text = f"start_rad {joint.start_rad:g} is outside {joint.lower_rad:g} to"
            yield f"{where}.start_rad", f"{text} {joint.upper_rad:g}", "say one within its limits"


def _limits(found: PulseMap) -> Iterator[Wrong]:
    """A limit that the servo's pulses do not reach. What it can bear nobody can ask it."""
    for name, joint in found.joints.items():
        where = f"$.joints.{name}"
        if joint.lower_rad >= joint.upper_rad:
            yield f"{where}.lower_rad", "lower_rad is not below upper_rad", "exchange them"
            continue
        for key, angle in (("lower_rad", joint.lower_rad), ("upper_rad", joint.upper_rad)):
            turned = joint.motor_rad(angle)
            if abs(turned) > 0.5 * joint.travel_rad + 1e-6:
                text = f"there the servo is at {turned:.2f} rad, its pulses go to"
                cure = "narrow the limit, or correct gear, offset_rad and pulse_us"
                yield f"{where}.{key}", f"{text} {0.5 * joint.travel_rad:.2f} either way", cure


def _loads(found: PulseMap) -> Iterator[Wrong]:
    if any(joint.chip not in found.chips for joint in found.joints.values()):
        return
    for name, chip in found.chips.items():
        share = found.load(name)
        if share > bus_load.MOST_LOAD:
            text = f"its bus is {share:.0%} busy, at most {bus_load.MOST_LOAD:.0%} is safe"
            cure = f"bus_hz: 400000, if it bears that, a lower frame_hz than {chip.frame_hz:g}, "
            yield f"$.chips.{name}", text, f"{cure}or another bus"
