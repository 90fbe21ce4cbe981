"""Which motor moves which joint: `can.yaml` beside a robot's description, or a file of its own.

rate_hz: 500
buses:
  left_leg: {channel: can0}
joints:
  left_knee: {bus: left_leg, model: DM8009, id: 4, sign: -1, offset_rad: 0.12, gear: 1.5,
              lower_rad: 0, upper_rad: 2.4, velocity_limit_rad_s: 16, torque_limit_nm: 60}
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Annotated, TypeAlias

import msgspec

from robot.drivers.motors import linkage, motor_map
from robot.drivers.motors.can import load as bus_load
from robot.drivers.motors.can.families import FAMILIES, Family
from robot.drivers.motors.can.frames import BITRATE_HZ
from robot.drivers.motors.can.mit11 import MOST_ID
from robot.drivers.motors.can.models import MODELS
from robot.drivers.motors.can.values import Ranges
from robot.drivers.motors.motor_map import LinkedMap, Motor, Wrong
from robot.files import quantities as q

FILE = "can.yaml"
REPLIES_ABOVE = 16
"""So much above its own a motor has the identifier it answers under, where nobody changed it."""

Identifier: TypeAlias = Annotated[int, msgspec.Meta(ge=1, le=MOST_ID)]
Bitrate: TypeAlias = Annotated[int, msgspec.Meta(ge=10_000, le=1_000_000, extra={"unit": "bit/s"})]
DataBitrate: TypeAlias = Annotated[int, msgspec.Meta(ge=0, le=8_000_000, extra={"unit": "bit/s"})]
Rate: TypeAlias = Annotated[int, msgspec.Meta(ge=1, le=2000, extra={"unit": "Hz"})]
Watchdog: TypeAlias = Annotated[float, msgspec.Meta(ge=0.005, le=1.0, extra={"unit": "s"})]


SOCKETCAN = "socketcan"


class Bus(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A CAN bus as python-can opens it.

    Attributes:
        channel: `can0`, or what the interface calls it.
        interface: of python-can; socketcan on a robot.
        bitrate_hz: what it was set up with.
        data_bitrate_hz: of a bus of CAN FD, at which data go; 0: a classic bus.
    """

    channel: q.Line
    interface: q.Line = SOCKETCAN
    bitrate_hz: Bitrate = BITRATE_HZ
    data_bitrate_hz: DataBitrate = 0

    @property
    def is_fd(self) -> bool:
        """Whether it is one of CAN FD, whose data go at a rate of their own."""
        return self.data_bitrate_hz > 0

    @property
    def device(self) -> str:
        """What a user calls it who lets robots open it: can0; slcan:/dev/ttyACM0."""
        return self.channel if self.interface == SOCKETCAN else f"{self.interface}:{self.channel}"


class MotorRanges(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a motor's registers are expected to hold, where that is not as the model is sold."""

    position_rad: q.TurnRate
    velocity_rad_s: q.TurnRate
    torque_nm: q.Torque


class JointMotor(Motor, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The motor of one joint, and how it sits there (`Mounted`).

    Attributes:
        bus: one of `buses`.
        model: a row of `robot.drivers.motors.can.models`.
        id: it listens for this (decimal).
        reply_id: it answers under this; 0: its `id` plus 16, or with 29 bits its `id`.
        ranges: what its registers hold.
    """

    bus: str
    model: str
    id: Identifier
    reply_id: Annotated[int, msgspec.Meta(ge=0, le=MOST_ID)] = 0
    ranges: MotorRanges | None = None

    @property
    def line(self) -> str:
        """Its bus."""
        return self.bus

    @property
    def answers_as(self) -> int:
        """The identifier of its replies; with 29 bits, its own stands in them."""
        return self.reply_id or self.id + (0 if self.is_wide else REPLIES_ABOVE)

    @property
    def is_wide(self) -> bool:
        """Whether its frames have identifiers of 29 bits."""
        return self.model in MODELS and self.family.is_extended

    @property
    def family(self) -> Family:
        """How it is spoken to."""
        return FAMILIES[MODELS[self.model].family]

    @property
    def expected(self) -> Ranges:
        """What its registers are expected to hold."""
        model = MODELS[self.model]
        known = self.ranges or model
        return Ranges(known.position_rad, known.velocity_rad_s, known.torque_nm, model.kp, model.kd)

    @property
    def kp_most(self) -> float:
        """The stiffest that its frames can say, at the joint."""
        return MODELS[self.model].kp * self.gear * self.gear

    @property
    def kd_most(self) -> float:
        """The most damping that its frames can say, at the joint."""
        return MODELS[self.model].kd * self.gear * self.gear


class JointMap(LinkedMap, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """All motors on CAN of a robot, or of a part of one (`LinkedMap`).

    Attributes:
        watchdog_s: written into every motor at the start.
        buses: by name.
    """

    rate_hz: Rate
    watchdog_s: Watchdog = 0.02
    buses: dict[str, Bus]
    joints: dict[str, JointMotor]

    @property
    def channels(self) -> Mapping[str, str]:
        """Of its buses."""
        return {name: bus.channel for name, bus in self.buses.items()}

    def on(self, bus: str) -> dict[str, JointMotor]:
        """The joints of a bus."""
        return {name: joint for name, joint in self.joints.items() if joint.bus == bus}

    def load(self, line: str) -> float:
        """The share of its time that a bus is busy."""
        return self.rate_hz * sum(self.pair_s(joint) for joint in self.on(line).values())

    def pair_s(self, joint: JointMotor) -> float:
        """How long a joint's command and its reply hold its bus at most."""
        family, bus = joint.family, self.buses[joint.bus]
        fd = family.fd and bus_load.FdPair(
            *family.fd,
            data_bitrate_hz=bus.data_bitrate_hz or bus.bitrate_hz,
            is_reply_extended=not family.short_replies(joint.id),
        )
        return bus_load.pair_s(is_extended=family.is_extended, bitrate_hz=bus.bitrate_hz, fd=fd)


def load(path: Path | str) -> JointMap:
    """Read a map.

    Raises:
        ConfigError: with everything that is wrong in it, each with its line and a cure.
    """
    checks = (_names, _mixed, _identifiers, _limits, _linkages, _loads)
    return motor_map.read(path, JointMap, begin_with="rate_hz: 500", checks=checks)


def _names(found: JointMap) -> Iterator[Wrong]:
    yield from motor_map.nameless(found)
    for name, joint in found.joints.items():
        yield from motor_map.misnamed(
            name, joint, line="bus", plural="buses", lines=found.buses, models=MODELS
        )
        if joint.model in MODELS and joint.family.asking is None and joint.ranges is None:
            text = f"a {joint.model} cannot be asked what its frames stand for"
            cure = "say its ranges, as the maker's tool shows them"
            yield f"$.joints.{name}.model", text, cure
        elif joint.model in MODELS and math.isnan(joint.expected.torque_nm):
            text = f"a {joint.model} is sold without a motor: nobody knows what it gives"
            cure = "say its ranges: {position_rad, velocity_rad_s, torque_nm} of its output"
            yield f"$.joints.{name}.model", text, cure
        if joint.ranges is not None and joint.model in MODELS and joint.family.widest is not None:
            yield from _too_wide(name, joint, joint.family.widest)
        if joint.is_wide and joint.reply_id:
            text = f"the replies of a {joint.model} say whose they are, under many identifiers"
            yield f"$.joints.{name}.reply_id", text, "leave reply_id out"
        if joint.model in MODELS and joint.id > (most := joint.family.most_id):
            text = f"a {joint.model} has an identifier from 1 to {most}, not {joint.id}"
            yield f"$.joints.{name}.id", text, "look it up with `humanoid motors scan`"


def _too_wide(name: str, joint: JointMotor, widest: Ranges) -> Iterator[Wrong]:
    """Ranges that frames cannot say, of a family whose steps are the same for all."""
    for field, wanted, most in zip(
        ("position_rad", "velocity_rad_s", "torque_nm"), joint.expected[:3], widest[:3], strict=True
    ):
        if wanted > most:
            text = f"the frames of a {joint.model} say {most:.4g} at most"
            yield f"$.joints.{name}.ranges.{field}", text, f"write {most:.4g} or less"


def _mixed(found: JointMap) -> Iterator[Wrong]:
    """A bus of CAN FD with motors that know classic frames only, or the other way round.

    A controller of CAN 2.0 takes an FD frame for an error, and destroys it with an error frame, for
    all: a bus with one of each carries nothing for the former's neighbours.
    """
    for name, joint in found.joints.items():
        if joint.model not in MODELS or joint.bus not in found.buses:
            continue
        is_fd, bus = found.buses[joint.bus].is_fd, f"the bus {joint.bus!r}"
        if joint.family.fd is None and is_fd:
            text = f"a {joint.model} takes the FD frames of {bus} for errors, and destroys them"
            yield f"$.joints.{name}.bus", text, "give it a bus without data_bitrate_hz"
        elif joint.family.fd is not None and not is_fd:
            text = f"a {joint.model} speaks CAN FD, and {bus} is a classic one"
            cure = "write data_bitrate_hz: 5000000 there; motors of classic CAN need another bus"
            yield f"$.joints.{name}.bus", text, cure


def _identifiers(found: JointMap) -> Iterator[Wrong]:
    """Two that share an identifier answer at once, and neither can be told from the other."""
    for bus in found.buses:
        taken: dict[tuple[bool, int], str] = {}
        for name, joint in found.on(bus).items():
            wide = joint.is_wide
            used = {"id": joint.id} | ({} if wide else {"reply_id": joint.answers_as})
            for key, number in used.items():
                if (wide, number) in taken:
                    text = f"{number} on the bus {bus!r} is {taken[wide, number]}'s already"
                    place = key if key == "id" or joint.reply_id else "id"
                    cure = f"give {name} an {key} of its own, in the motor and here"
                    yield f"$.joints.{name}.{place}", text, cure
                taken.setdefault((wide, number), name)


def _limits(found: JointMap) -> Iterator[Wrong]:
    """A limit that the motor cannot meet, or that its frames cannot say."""
    yield from motor_map.hasty(found)
    linked = found.linked
    for name, joint in found.joints.items():
        if name in linked:
            yield from motor_map.upside_down(f"$.joints.{name}", joint)
        elif joint.model in MODELS:
            yield from _unmet(name, joint)


def _unmet(name: str, joint: JointMotor) -> Iterator[Wrong]:
    most = joint.expected
    if not math.isnan(most.torque_nm):
        yield from motor_map.unmet(
            f"$.joints.{name}",
            joint,
            most_rad=most.position_rad,
            why=partial(_unsaid, most.position_rad),
            speed_rad_s=most.velocity_rad_s,
            torque_nm=most.torque_nm,
        )


def _linkages(found: JointMap) -> Iterator[Wrong]:
    """Linkages that cannot be, or whose cranks want more than their motors can."""
    wrong = [*linkage.wrong(found.linkages, found.joints)]
    yield from wrong
    if wrong or any(joint.model not in MODELS for joint in found.joints.values()):
        return
    cranks = linkage.at_cranks(found.linkages, found.joints)
    for name, whose in found.linked.items():
        for where, text, _ in _unmet(name, cranks[name]):
            cure = "another motor or gear, or lower limits of the joints that it moves"
            yield where, f"at its crank in the linkage {whose!r} {text}", cure


def _unsaid(most_rad: float, turned_rad: float) -> str:
    return f"there the motor is at {turned_rad:.2f} rad, and its frames say {most_rad:g}"


def _loads(found: JointMap) -> Iterator[Wrong]:
    """A bus that cannot carry what it is asked to."""
    if any(joint.model not in MODELS for joint in found.joints.values()):
        return
    for bus in found.buses:
        joints, share = found.on(bus), found.load(bus)
        if share <= bus_load.MOST_LOAD:
            continue
        longest_s = max(found.pair_s(joint) for joint in joints.values())
        most = bus_load.fitting(found.rate_hz, longest_s)
        needed = -(-len(joints) // most) if most else 0
        text = f"{len(joints)} joints at {found.rate_hz} Hz fill it to {share:.0%}"
        cure = (
            f"{needed} buses are needed, {most} joints each, or {_slower(found, bus)} Hz"
            if needed
            else f"no number of buses is enough; {_slower(found, bus)} Hz is"
        )
        yield f"$.buses.{bus}", f"{text}, at most {bus_load.MOST_LOAD:.0%} is safe", cure


def _slower(found: JointMap, bus: str) -> int:
    return int(found.rate_hz * bus_load.MOST_LOAD / found.load(bus))
