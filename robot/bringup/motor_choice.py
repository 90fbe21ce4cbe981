"""Another driver of the motors than the robot's description names: whether it can, and how."""

from __future__ import annotations

from pathlib import Path

from robot.bringup.motor_families import BY_DRIVER, of
from robot.bringup.motor_tools import loads
from robot.control.loop import BUS_PERIOD_S
from robot.drivers.motors import pwm_and_others, servos_and_others
from robot.drivers.motors.motor_map import MotorMap
from robot.drivers.registry import CAN, ETHERNET, MOTORS, PWM
from robot.errors import ConfigError, Problem
from robot.files.misfits import nearest
from robot.model.description import RobotDescription


def checked(robot: RobotDescription, driver: str) -> str:
    """How a driver will move the motors of a robot in simulation, in words; "" if as ever.

    Raises:
        ConfigError: if there is no such driver, or it cannot: with everything that is against it.
    """
    known = list(MOTORS.drivers)
    if driver not in known:
        text = f"motors have no driver {driver!r}"
        raise ConfigError([Problem(text, suggestion=nearest(driver, known))])
    if driver not in BY_DRIVER:
        return ""
    file = robot.path().with_name(BY_DRIVER[driver].of.file)
    if not file.is_file():
        cure = f"write {file.name} beside the robot's description (docs/hardware.md)"
        text = f"the robot {robot.name!r} has no joint map: which motor moves which joint"
        raise ConfigError([Problem(text, str(file), suggestion=cure)])
    if driver in (CAN, ETHERNET):
        return _on(BY_DRIVER[driver].of.beside(robot))
    found = pwm_and_others.maps(robot) if driver == PWM else servos_and_others.maps(robot)
    return " ".join(_on(joints) for joints in found if joints is not None)


def _on(joints: MotorMap) -> str:
    _check_rate(joints.rate_hz, Path(joints.file))
    family, lines = of(joints), loads(joints)
    fullest = max(lines, key=lambda load: load.share)
    return (
        f"Motors by {family.title} (emulated): {len(joints.joints)} joints on {len(lines)} "
        f"{family.of.lines} at {joints.rate_hz} Hz; the fullest, {fullest.bus}, is "
        f"{fullest.share:.0%} busy."
    )


def _check_rate(rate_hz: int, file: Path) -> None:
    """Its periods are the controller's: it cannot be told less often than it is told."""
    wanted_hz = round(1.0 / BUS_PERIOD_S)
    if rate_hz != wanted_hz:
        text = f"it commands motors at {rate_hz} Hz, the controller {wanted_hz} times a second"
        raise ConfigError([Problem(text, str(file), suggestion=f"set rate_hz: {wanted_hz}")])
