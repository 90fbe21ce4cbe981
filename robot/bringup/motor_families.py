"""The families of motors that `humanoid motors` knows: a row each, and nothing else anywhere."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robot.bringup import can_tools, ethernet_tools, pwm_tools, servo_tools
from robot.bringup.motor_family import M, MotorFamily
from robot.drivers.motors.can import driver as can_driver
from robot.drivers.motors.can import load as can_load
from robot.drivers.motors.dynamixel import driver as servo_driver
from robot.drivers.motors.dynamixel import load as servo_load
from robot.drivers.motors.ethernet import driver as ethernet_driver
from robot.drivers.motors.ethernet import load as link_load
from robot.drivers.motors.pwm import driver as pwm_driver
from robot.drivers.motors.pwm import load as i2c_load
from robot.drivers.registry import CAN, DYNAMIXEL, ETHERNET, PWM
from robot.files import yaml_nodes

FAMILIES: tuple[MotorFamily[Any, Any], ...] = (
    MotorFamily(
        driver=CAN,
        title="CAN",
        most_load=can_load.MOST_LOAD,
        of=can_driver.FAMILY,
        tools=can_tools,
        late_cure="look for bus errors (ip -s link show), another program, a busy computer",
        speed_cure="correct its velocity range (register 22); is its gear right?",
        jog_hz=100,
    ),
    MotorFamily(
        driver=DYNAMIXEL,
        title="Dynamixel",
        most_load=servo_load.MOST_LOAD,
        of=servo_driver.FAMILY,
        tools=servo_tools,
        late_cure="look at cable and latency timer, for another program, a busy computer",
        speed_cure="is its gear right? is its belt slack?",
        jog_hz=250,  # its law is closed from here: at 100 Hz a light joint shakes
    ),
    MotorFamily(
        driver=ETHERNET,
        title="Ethernet",
        most_load=link_load.MOST_LOAD,
        of=ethernet_driver.FAMILY,
        tools=ethernet_tools,
        late_cure="look at switch and cables, for other traffic, a busy computer",
        speed_cure="is its gear right? is its encoder?",
        jog_hz=100,
    ),
    MotorFamily(
        driver=PWM,
        title="PWM",
        most_load=i2c_load.MOST_LOAD,
        of=pwm_driver.FAMILY,
        tools=pwm_tools,
        late_cure="nothing is awaited of them",
        speed_cure="look at the joints themselves",
        jog_hz=50,
        measures=False,
    ),
)

BY_DRIVER = {family.driver: family for family in FAMILIES}


def of(joints: M) -> MotorFamily[M, Any]:
    """The family of a joint map."""
    return next(family for family in FAMILIES if isinstance(joints, family.of.map))


def of_file(path: Path) -> MotorFamily[Any, Any]:
    """The family whose map a file is: which lines does it name? CAN's, if none at all.

    Raises:
        ConfigError: it cannot be read as YAML.
    """
    node = yaml_nodes.read(path, begin_with="rate_hz: 500")
    return next((one for one in FAMILIES if node.get(one.of.lines) is not None), FAMILIES[0])
