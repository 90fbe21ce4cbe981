"""Another driver of the motors than the robot's description names: whether it can, and how."""

from __future__ import annotations

from robot.bringup.motor_tools import loads
from robot.control.loop import BUS_PERIOD_S
from robot.drivers.motors.can import emulated, joint_map
from robot.drivers.registry import CAN, MOTORS
from robot.errors import ConfigError, Problem
from robot.misfits import nearest
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
    if driver != CAN:
        return ""
    file = robot.path().with_name(joint_map.FILE)
    if not file.is_file():
        cure = f"write {joint_map.FILE} beside the robot's description (docs/hardware.md)"
        text = f"the robot {robot.name!r} has no joint map: which motor moves which joint"
        raise ConfigError([Problem(text, str(file), suggestion=cure)])
    joints = joint_map.beside(robot)
    emulated.check(joints)
    wanted_hz = round(1.0 / BUS_PERIOD_S)
    if joints.rate_hz != wanted_hz:
        text = (
            f"it commands motors at {joints.rate_hz} Hz, the controller {wanted_hz} times a second"
        )
        cure = f"set rate_hz: {wanted_hz}"
        raise ConfigError([Problem(text, joints.file, suggestion=cure)])
    fullest = max(loads(joints), key=lambda load: load.share)
    return (
        f"Motors by CAN (emulated): {len(joints.joints)} joints on {len(joints.buses)} buses at "
        f"{joints.rate_hz} Hz; the fullest, {fullest.bus}, is {fullest.share:.0%} busy."
    )
