"""Motors on a bench: what a joint map says there is, emulated, each with a shaft of its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import cast

from robot.drivers.motors.can.joint_map import JointMap, JointMotor
from robot.drivers.motors.linkage import middle
from robot.errors import ConfigError
from sim.devices import can_motors
from sim.devices.can_motor import FLAWS, CanMotor, Flaw
from sim.devices.can_motors import motor_on
from sim.devices.flaws import unknown
from sim.devices.shaft import FreeShaft
from sim.devices.wire import Wire
from sim.devices.worn_shaft import WornShaft

LATER_S = 30e-6
WORN = "worn"
"""A flaw of the shaft and not of the motor: friction, play, and a motor that obeys late."""
SWING_RAD_S = 0.4


@dataclass(frozen=True)
class Bench:
    """Emulated buses with their motors.

    Attributes:
        wires: by the map's names of buses.
        motors: by the map's names of joints.
        others: what is there and in no map: a second motor with the same identifier.
    """

    wires: Mapping[str, Wire]
    motors: Mapping[str, CanMotor]
    others: tuple[CanMotor, ...] = ()

    @property
    def devices(self) -> tuple[CanMotor, ...]:
        """Whose time goes by."""
        return (*self.motors.values(), *self.others)

    def advance(self, until_s: float) -> None:
        """Let time go by up to a moment."""
        for wire in self.wires.values():
            wire.advance(until_s)
        for device in self.devices:
            device.live(until_s)


def build(
    wanted: JointMap,
    *,
    now_s: float = 0.0,
    flaws: Mapping[str, str] | None = None,
    is_still: bool = False,
) -> Bench:
    """The motors of a map, in the middle of their joints' ranges and swinging a little.

    Args:
        wanted: the map.
        now_s: when their time begins.
        flaws: what is wrong with whom, by joint.
        is_still: whether they do not swing.

    Raises:
        ConfigError: if a joint or a flaw is unknown, or a motor's family is not emulated.
    """
    flaws = flaws or {}
    _check(wanted, flaws)
    buses = wanted.buses.items()
    wires = {
        name: Wire(bitrate_hz=bus.bitrate_hz, data_bitrate_hz=bus.data_bitrate_hz, now_s=now_s)
        for name, bus in buses
    }
    motors: dict[str, CanMotor] = {}
    others: list[CanMotor] = []
    swing_rad_s = 0.0 if is_still else SWING_RAD_S
    at = middle(wanted.linkages, wanted.joints)
    for name, joint in wanted.joints.items():
        flaw = flaws.get(name)
        motors[name] = _motor(joint, at[name], wires[joint.bus], swing_rad_s, is_worn=flaw == WORN)
        if flaw is not None and flaw != WORN:
            motors[name].suffer(cast("Flaw", flaw))
            if flaw == "twin":
                twin = _motor(
                    joint, at[name], wires[joint.bus], swing_rad_s, ahead_rad=0.1, later_s=LATER_S
                )
                others.append(twin)
    return Bench(wires, motors, tuple(others))


def _motor(
    joint: JointMotor,
    at_rad: float,
    wire: Wire,
    swing_rad_s: float,
    *,
    ahead_rad: float = 0.0,
    later_s: float = 0.0,
    is_worn: bool = False,
) -> CanMotor:
    middle_rad = joint.motor_rad(at_rad)
    if is_worn:
        shaft = WornShaft(
            q_rad=middle_rad, inertia_kg_m2=0.02, worn_nm=0.2, viscous_nm_s=0.1, play_rad=0.004,
            late_s=0.005, spring_nm_rad=0.3,
        )  # fmt: skip
    else:
        shaft = FreeShaft(q_rad=middle_rad + ahead_rad, spring_nm_rad=0.3)
        shaft.qd_rad_s = swing_rad_s
    return motor_on(joint, wire, shaft, later_s=later_s)


def _check(wanted: JointMap, flaws: Mapping[str, str]) -> None:
    wrong = unknown(flaws, joints=wanted.joints, known=(*FLAWS, WORN)) + can_motors.problems(wanted)
    if wrong:
        raise ConfigError(wrong)
