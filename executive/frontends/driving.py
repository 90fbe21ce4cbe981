"""`--driver`: which driver moves the motors, looked at and told before a robot is started."""

from __future__ import annotations

from executive.frontends.composition_root import REALITY
from executive.frontends.output import say
from robot.errors import ConfigError, Problem
from robot.model.description import RobotDescription


def chosen(driver: str, robot: RobotDescription, *, fast: bool, err: bool) -> str:
    """The driver that was asked for, if it can drive this robot; how is said.

    Args:
        driver: as it was asked for; "" if it was not.
        robot: whose motors they are.
        fast: whether the run is of one process and simulated time.
        err: whether to say it on standard error.

    Raises:
        ConfigError: if it cannot, with everything that is against it.
    """
    if not driver:
        return ""
    from robot.bringup import motor_choice  # the controller and python-can: of nobody else's start

    how = motor_choice.checked(robot, driver)
    if how:
        REALITY.check_motors(robot, driver)
    if how and fast:
        cure = "leave out --driver or --fast; in simulated time motors are commanded directly"
        raise ConfigError(
            [Problem("motors on buses are driven in live runs only", suggestion=cure)]
        )
    if how:
        say(how, err=err)
    return driver
