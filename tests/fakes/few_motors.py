"""A few joints of each family of motors, alike in all else, in simulated time."""

from collections.abc import Mapping
from typing import Any, TypeAlias

from robot.drivers.motors.dynamixel.joint_map import JointServo, Port, ServoMap
from robot.drivers.motors.pwm.joint_map import Chip, JointPulse, PulseMap
from tests.fakes import can_rig, dynamixel_rig, ethernet_rig, pwm_rig

AnyRig: TypeAlias = can_rig.Rig | dynamixel_rig.Rig | ethernet_rig.Rig | pwm_rig.Rig


def can() -> can_rig.Rig:
    """Two buses with two joints each, 500 Hz."""
    return can_rig.Rig(can_rig.limbs(2, 2))


def robstrides() -> can_rig.Rig:
    """The same with RobStrides."""
    return can_rig.Rig(can_rig.limbs(2, 2, model="RS03"))


def moteuses() -> can_rig.Rig:
    """The same with moteus, over CAN FD."""
    return can_rig.Rig(can_rig.limbs(2, 2, model="moteus-x1"))


def servos() -> dynamixel_rig.Rig:
    """Two ports with two joints each, 250 Hz."""
    return dynamixel_rig.Rig(
        ServoMap(
            rate_hz=250,
            ports={f"port{p}": Port(device=f"tty{p}", baud_hz=4_000_000) for p in range(2)},
            joints={
                f"joint{p}_{j}": JointServo(
                    port=f"port{p}", model="XM540-W270", id=j + 1, lower_rad=-2.0, upper_rad=2.0,
                    velocity_limit_rad_s=3.0, torque_limit_nm=8.0,
                )
                for p in range(2)
                for j in range(2)
            },
        ),
        is_still=True,
    )  # fmt: skip


def boards() -> ethernet_rig.Rig:
    """Two boards with two joints each, 500 Hz."""
    return ethernet_rig.Rig(ethernet_rig.limbs(2, 2), is_still=True)


def pulses() -> pwm_rig.Rig:
    """A chip with two hobby servos, 50 frames a second."""
    return pwm_rig.Rig(
        PulseMap(
            chips={"hat": Chip()},
            joints={
                f"joint0_{j}": JointPulse(
                    chip="hat", model="DS3225", id=j, pulse_us=(500.0, 2500.0), travel_rad=3.0,
                    lower_rad=-1.4, upper_rad=1.4, velocity_limit_rad_s=4.0, torque_limit_nm=2.0,
                )
                for j in range(2)
            },
        )
    )  # fmt: skip


def motors_of(rig: AnyRig) -> Mapping[str, Any]:
    """By joint, of whatever family."""
    if isinstance(rig, can_rig.Rig):
        return rig.bench.motors
    return rig.bench.drives if isinstance(rig, ethernet_rig.Rig) else rig.bench.servos
