"""The families of motors that `humanoid motors` knows: a row each, and nothing else anywhere."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robot.bringup import can_tools, ethernet_tools, pwm_tools, servo_tools
from robot.bringup.motor_family import M, MotorFamily
from robot.drivers.motors.can import joint_map as can_map
from robot.drivers.motors.can import load as can_load
from robot.drivers.motors.can.driver import CanMotors
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.dynamixel import joint_map as servo_map
from robot.drivers.motors.dynamixel import load as servo_load
from robot.drivers.motors.dynamixel.driver import DynamixelMotors
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.ethernet import joint_map as drive_map
from robot.drivers.motors.ethernet import load as link_load
from robot.drivers.motors.ethernet.driver import EthernetMotors
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.pwm import joint_map as pulse_map
from robot.drivers.motors.pwm import load as i2c_load
from robot.drivers.motors.pwm.driver import PwmMotors
from robot.drivers.motors.pwm.joint_map import PulseMap
from robot.drivers.registry import CAN, DYNAMIXEL, ETHERNET, PWM
from robot.files import yaml_nodes

FAMILIES: tuple[MotorFamily[Any, Any], ...] = (
    MotorFamily(
        driver=CAN,
        title="CAN",
        file=can_map.FILE,
        lines="buses",
        map=JointMap,
        load=can_map.load,
        elsewhere=can_tools.elsewhere,
        check_user=can_tools.check_user,
        most_load=can_load.MOST_LOAD,
        ports=can_tools.ports,
        motors=CanMotors,
        scan=can_tools.scan,
        readings=can_tools.readings,
        findings=can_tools.findings,
        late_cure="look for bus errors (ip -s link show), another program, a busy computer",
        speed_cure="correct its velocity range (register 22); is its gear right?",
        jog_hz=100,
        bare=can_tools.bare,
        resting=can_tools.resting,
        set_zero=can_tools.set_zero,
    ),
    MotorFamily(
        driver=DYNAMIXEL,
        title="Dynamixel",
        file=servo_map.FILE,
        lines="ports",
        map=ServoMap,
        load=servo_map.load,
        elsewhere=servo_tools.elsewhere,
        check_user=servo_tools.check_user,
        most_load=servo_load.MOST_LOAD,
        ports=servo_tools.ports,
        motors=DynamixelMotors,
        scan=servo_tools.scan,
        readings=servo_tools.readings,
        findings=servo_tools.findings,
        late_cure="look at cable and latency timer, for another program, a busy computer",
        speed_cure="is its gear right? is its belt slack?",
        jog_hz=250,  # its law is closed from here: at 100 Hz a light joint shakes
        bare=servo_tools.bare,
        resting=servo_tools.resting,
        set_zero=servo_tools.set_zero,
    ),
    MotorFamily(
        driver=ETHERNET,
        title="Ethernet",
        file=drive_map.FILE,
        lines="boards",
        map=DriveMap,
        load=drive_map.load,
        elsewhere=ethernet_tools.elsewhere,
        check_user=ethernet_tools.check_user,
        most_load=link_load.MOST_LOAD,
        ports=ethernet_tools.ports,
        motors=EthernetMotors,
        scan=ethernet_tools.scan,
        readings=ethernet_tools.readings,
        findings=ethernet_tools.findings,
        late_cure="look at switch and cables, for other traffic, a busy computer",
        speed_cure="is its gear right? is its encoder?",
        jog_hz=100,
        bare=ethernet_tools.bare,
        resting=ethernet_tools.resting,
        set_zero=ethernet_tools.set_zero,
    ),
    MotorFamily(
        driver=PWM,
        title="PWM",
        file=pulse_map.FILE,
        lines="chips",
        map=PulseMap,
        load=pulse_map.load,
        elsewhere=pwm_tools.elsewhere,
        check_user=pwm_tools.check_user,
        most_load=i2c_load.MOST_LOAD,
        ports=pwm_tools.ports,
        motors=PwmMotors,
        scan=pwm_tools.scan,
        readings=pwm_tools.readings,
        findings=pwm_tools.findings,
        late_cure="nothing is awaited of them",
        speed_cure="look at the joints themselves",
        jog_hz=50,
        bare=pwm_tools.bare,
        resting=pwm_tools.resting,
        set_zero=pwm_tools.set_zero,
        measures=False,
    ),
)

BY_DRIVER = {family.driver: family for family in FAMILIES}


def of(joints: M) -> MotorFamily[M, Any]:
    """The family of a joint map."""
    return next(family for family in FAMILIES if isinstance(joints, family.map))


def of_file(path: Path) -> MotorFamily[Any, Any]:
    """The family whose map a file is: which lines does it name? CAN's, if none at all.

    Raises:
        ConfigError: it cannot be read as YAML.
    """
    node = yaml_nodes.read(path, begin_with="rate_hz: 500")
    return next((one for one in FAMILIES if node.get(one.lines) is not None), FAMILIES[0])
