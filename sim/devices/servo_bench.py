"""Servos on a bench: what a servo map says there is, emulated, each with a shaft of its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import cast

from robot.clock import SimulatedClock
from robot.drivers.motors.dynamixel.joint_map import JointServo, ServoMap
from robot.errors import ConfigError
from sim.devices.direct_lines import DirectLines
from sim.devices.dynamixel import FLAWS, Flaw, Kind, Servo
from sim.devices.flaws import unknown
from sim.devices.serial_line import Line
from sim.devices.shaft import FreeShaft, Shaft

SWING_RAD_S = 0.4
STEP_S = 0.001
"""Eighteen of them are to keep time with a wall clock."""


@dataclass(frozen=True)
class ServoBench:
    """Emulated ports with their servos.

    Attributes:
        lines: by the map's names of ports.
        servos: by the map's names of joints.
    """

    lines: Mapping[str, Line]
    servos: Mapping[str, Servo]

    def live(self, until_s: float) -> None:
        """Let the servos' time go by up to a moment."""
        for line in self.lines.values():
            line.live(until_s)


def build(
    wanted: ServoMap,
    *,
    now_s: float = 0.0,
    flaws: Mapping[str, str] | None = None,
    is_still: bool = False,
) -> ServoBench:
    """The servos of a map, in the middle of their joints' ranges and swinging a little.

    Args:
        wanted: the map.
        now_s: when their time begins.
        flaws: what is wrong with whom, by joint.
        is_still: whether they do not swing.

    Raises:
        ConfigError: if a joint or a flaw is unknown.
    """
    flaws = flaws or {}
    if problems := unknown(flaws, joints=wanted.joints, known=FLAWS):
        raise ConfigError(problems)
    lines = {name: Line(baud_hz=port.baud_hz, now_s=now_s) for name, port in wanted.ports.items()}
    servos: dict[str, Servo] = {}
    for name, joint in wanted.joints.items():
        servos[name] = _servo(joint, now_s, swing_rad_s=0.0 if is_still else SWING_RAD_S)
        lines[joint.port].servos.append(servos[name])
        if (flaw := flaws.get(name)) is not None:
            servos[name].suffer(cast("Flaw", flaw))
            if flaw == "twin":
                twin = _servo(joint, now_s, swing_rad_s=0.0, ahead_rad=0.1)
                lines[joint.port].servos.append(twin)
    return ServoBench(lines, servos)


def kind(joint: JointServo) -> Kind:
    """What a servo of the map's model is."""
    sold = joint.sold
    return Kind(
        sold.number, sold.stall_nm, sold.stall_a, sold.velocity_rad_s, sold.current_step_a,
        sold.current_steps, sold.volts,
    )  # fmt: skip


def servo_on(joint: JointServo, shaft: Shaft, now_s: float, *, heat_k_s: float = 4.0) -> Servo:
    """A servo of the map's model and identifier, on a shaft."""
    made = Servo(kind(joint), shaft, joint.id, now_s=now_s, heat_k_s=heat_k_s)
    if joint.sold.volts < 10.0:
        made.memory.put(34, 2, 35)
        made.memory.put(32, 2, 70)
    return made


def _servo(joint: JointServo, now_s: float, *, swing_rad_s: float, ahead_rad: float = 0.0) -> Servo:
    middle_rad = joint.motor_rad(0.5 * (joint.lower_rad + joint.upper_rad))
    shaft = FreeShaft(q_rad=middle_rad + ahead_rad, inertia_kg_m2=0.02, spring_nm_rad=0.3)
    shaft.step_s = STEP_S
    shaft.qd_rad_s = swing_rad_s
    return servo_on(joint, shaft, now_s)


class DirectPorts(DirectLines[ServoBench]):
    """A driver's ports straight onto emulated lines."""

    all_gone = "all ports of the servos are gone"

    def __init__(self, bench: ServoBench, clock: SimulatedClock) -> None:
        """Know the bench; nothing is opened."""
        super().__init__(bench, clock)
        self._kept: dict[str, bytes] = {}

    @property
    def _count(self) -> int:
        return len(self._bench.lines)

    def write(self, port: str, data: bytes) -> None:
        """Hand bytes over."""
        self._check()
        if port not in self.gone:
            self._bench.lines[port].write(data, self._clock.now_s())

    def read(self, port: str) -> bytes:
        """What came in up to now; the servos' time goes by."""
        self._check()
        if port in self.gone:
            return b""
        self._play(port)
        return self._kept.pop(port, b"")

    def play(self) -> None:
        """Let time go by up to now; what comes in is kept."""
        for port in self._bench.lines:
            self._play(port)

    def _play(self, port: str) -> None:
        now_s, line = self._clock.now_s(), self._bench.lines[port]
        self._kept[port] = self._kept.get(port, b"") + line.advance(now_s)
        line.live(now_s)
