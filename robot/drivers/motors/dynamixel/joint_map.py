"""Which servo moves which joint: `dynamixel.yaml` beside a robot's description, or another file.

rate_hz: 200
ports:
  left_arm: {device: /dev/ttyUSB0, baud_hz: 4000000}
joints:
  left_elbow: {port: left_arm, model: XM430-W350, id: 4, sign: -1, offset_rad: 0.12,
               lower_rad: -2.3, upper_rad: 0, velocity_limit_rad_s: 4.8, torque_limit_nm: 3.2}
others: can            # who moves the joints that are not here
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Literal, TypeAlias

import msgspec

from robot.drivers.motors import motor_map
from robot.drivers.motors.dynamixel import load as port_load
from robot.drivers.motors.dynamixel.control_table import (
    BAUD_RATES_HZ,
    WATCHDOG_MOST,
    WATCHDOG_STEP_S,
)
from robot.drivers.motors.dynamixel.models import MODELS, Model
from robot.drivers.motors.dynamixel.packets import MOST_ID
from robot.drivers.motors.motor_map import Motor, MotorMap, Wrong
from robot.files import quantities as q

FILE = "dynamixel.yaml"

Identifier: TypeAlias = Annotated[int, msgspec.Meta(ge=0, le=MOST_ID)]
Baud: TypeAlias = Annotated[int, msgspec.Meta(ge=9600, le=4_500_000, extra={"unit": "bit/s"})]
Rate: TypeAlias = Annotated[int, msgspec.Meta(ge=1, le=1000, extra={"unit": "Hz"})]
Watchdog: TypeAlias = Annotated[float, msgspec.Meta(ge=0.02, le=2.54, extra={"unit": "s"})]
Latency: TypeAlias = Annotated[float, msgspec.Meta(ge=0.0, le=0.1, extra={"unit": "s"})]


class Port(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A serial port with servos behind it.

    Attributes:
        device: `/dev/ttyUSB0`, or better its link under `/dev/serial/by-id`.
        baud_hz: the bit rate that its servos were set to.
        latency_s: for so long its adapter may hold an answer back: FTDI's latency timer, 1 ms at
            least, 16 ms if nobody changed it.
    """

    device: q.Line
    baud_hz: Baud = 1_000_000
    latency_s: Latency = 0.001


class JointServo(Motor, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The servo of one joint, and how it sits there (`Mounted`); it says 0 at 2048.

    Attributes:
        port: one of `ports`.
        model: a row of `robot.drivers.motors.dynamixel.models`.
        id: its identifier.
    """

    port: str
    model: str
    id: Identifier

    @property
    def line(self) -> str:
        """Its port."""
        return self.port

    @property
    def sold(self) -> Model:
        """What it is."""
        return MODELS[self.model]

    @property
    def nm_a_step(self) -> float:
        """Torque at the joint of one step of current; signed."""
        return self.sold.nm_a_step * self.gear * self.sign

    @property
    def most_steps(self) -> int:
        """Steps of current within the joint's limit of torque."""
        return min(self.sold.current_steps, int(self.torque_limit_nm / abs(self.nm_a_step) + 1e-9))


class ServoMap(MotorMap, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """All servos of a robot, or of a part of one (`MotorMap`).

    Attributes:
        watchdog_s: a servo stops after so long without a word; in steps of 20 ms.
        ports: by name.
        others: the driver of the robot's joints that are not here; "" where all are.
    """

    rate_hz: Rate
    watchdog_s: Watchdog = 0.04
    ports: dict[str, Port]
    joints: dict[str, JointServo]
    others: Literal["", "can"] = ""

    @property
    def channels(self) -> Mapping[str, str]:
        """Devices of its ports."""
        return {name: port.device for name, port in self.ports.items()}

    @property
    def watchdog_steps(self) -> int:
        """What is written into a servo."""
        return round(self.watchdog_s / WATCHDOG_STEP_S)

    def on(self, port: str) -> dict[str, JointServo]:
        """The joints of a port."""
        return {name: joint for name, joint in self.joints.items() if joint.port == port}

    def load(self, line: str) -> float:
        """The share of its time that a port is busy."""
        return port_load.load(len(self.on(line)), self.rate_hz, self.ports[line].baud_hz)


def load(path: Path | str) -> ServoMap:
    """Read a map.

    Raises:
        ConfigError: with everything that is wrong in it, each with its line and a cure.
    """
    checks = (_names, _identifiers, _limits, _loads)
    return motor_map.read(path, ServoMap, begin_with="rate_hz: 200", checks=checks)


def _names(found: ServoMap) -> Iterator[Wrong]:
    yield from motor_map.nameless(found)
    for port, settings in found.ports.items():
        if settings.baud_hz not in BAUD_RATES_HZ:
            rates = ", ".join(map(str, BAUD_RATES_HZ))
            text = f"a servo has no bit rate of {settings.baud_hz}"
            yield f"$.ports.{port}.baud_hz", text, f"one of {rates}"
    for name, joint in found.joints.items():
        yield from motor_map.misnamed(
            name, joint, line="port", plural="ports", lines=found.ports, models=MODELS
        )


def _identifiers(found: ServoMap) -> Iterator[Wrong]:
    """Two that share an identifier answer at once, and neither is understood."""
    for port in found.ports:
        taken: dict[int, str] = {}
        for name, joint in found.on(port).items():
            if joint.id in taken:
                text = f"{joint.id} on the port {port!r} is {taken[joint.id]}'s already"
                yield f"$.joints.{name}.id", text, f"give {name} an id of its own, there and here"
            taken.setdefault(joint.id, name)


def _limits(found: ServoMap) -> Iterator[Wrong]:
    """A limit that the servo cannot meet, or that it could not tell after it was without power."""
    yield from motor_map.hasty(found)
    steps = found.watchdog_s / WATCHDOG_STEP_S
    if abs(steps - round(steps)) > 1e-6 or steps > WATCHDOG_MOST:
        yield "$.watchdog_s", "servos count it in steps of 20 ms", "0.04, 0.06, 0.08 ..."
    for name, joint in found.joints.items():
        if joint.model in MODELS:
            yield from motor_map.unmet(
                f"$.joints.{name}",
                joint,
                most_rad=math.pi,
                why=_lost,
                speed_rad_s=joint.sold.velocity_rad_s,
                torque_nm=joint.sold.torque_nm,
            )


def _lost(turned_rad: float) -> str:
    return (
        f"there the servo is at {turned_rad:.2f} rad, and after it was without power it knows "
        "where it is within one turn only"
    )


def _loads(found: ServoMap) -> Iterator[Wrong]:
    """A port that cannot carry what it is asked to."""
    for port, settings in found.ports.items():
        count, baud_hz, latency_s = len(found.on(port)), settings.baud_hz, settings.latency_s
        if port_load.is_enough(count, found.rate_hz, baud_hz, latency_s):
            continue
        wire_ms = 1000.0 * port_load.busy_s(count, baud_hz)
        text = (
            f"{count} servos take {wire_ms:.2f} ms on the wire and {1000 * latency_s:g} ms in the "
            f"adapter, of {1000.0 * found.period_s:.2f} ms"
        )
        needed = port_load.ports_needed(count, found.rate_hz, baud_hz, latency_s)
        most = port_load.most_servos(found.rate_hz, baud_hz, latency_s)
        slower = port_load.fastest_hz(count, baud_hz, latency_s)
        cure = (
            f"{needed} ports are needed, {most} servos each, or {slower} Hz, or a higher baud_hz"
            if needed
            else f"no number of ports is enough; {slower} Hz is, or a higher baud_hz"
        )
        yield f"$.ports.{port}", text, cure
