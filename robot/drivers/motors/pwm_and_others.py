"""Hobby servos in head and hands, and the motors that another driver moves: one `MotorBus`."""

from __future__ import annotations

from typing import NamedTuple

from robot.drivers.motor_bus import Capability, MotorBus
from robot.drivers.motors.can import driver as can_driver
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.ethernet import driver as ethernet_driver
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.pwm import driver as pwm_driver
from robot.drivers.motors.pwm.joint_map import PulseMap
from robot.drivers.motors.servos_and_others import ServosAndOthers
from robot.drivers.wiring import Wiring
from robot.errors import ConfigError, Problem
from robot.model.description import RobotDescription


class Maps(NamedTuple):
    """Whose motor is whose: hobby servos, and what another driver moves, if anything."""

    servos: PulseMap
    can: JointMap | None = None
    boards: DriveMap | None = None


def maps(robot: RobotDescription) -> Maps:
    """What `pwm.yaml` beside a description says; what it leaves to another file, of that.

    Raises:
        ConfigError: either says what cannot be meant, a motor is in neither, or a joint is to be
            moved by a hobby servo that has to be measured.
    """
    servos = pwm_driver.FAMILY.beside(robot)
    _refuse_measured(robot, servos)
    if servos.others == "ethernet":
        return Maps(servos, boards=ethernet_driver.FAMILY.rest(robot, servos.joints))
    return Maps(servos, can=can_driver.FAMILY.rest(robot, servos.joints))


def _refuse_measured(robot: RobotDescription, servos: PulseMap) -> None:
    """Head and hands may go by what they were told; all else balances, or must not hit anything."""
    free = {*robot.groups["head"], *(hand.motor for hand in robot.hands.values())}
    if wrong := [name for name in servos.joints if name not in free]:
        cure = "give it a motor that measures; hobby servos may move head and hands"
        raise ConfigError(
            [
                Problem(
                    f"{name} has to be where the controller takes it to be, and a hobby servo does "
                    "not say where it is",
                    servos.file,
                    suggestion=cure,
                )
                for name in wrong
            ]
        )


def make(wiring: Wiring) -> MotorBus:
    """The motors that `pwm.yaml` beside the description names, and the others.

    Raises:
        ConfigError: as `maps`.
        DriverError: the user does not let robots open one of the buses or talk to a board.
    """
    servos, can, boards = maps(wiring.robot)
    moved = pwm_driver.FAMILY.wired(servos, wiring, waits=can is None and boards is None)
    if can is not None:
        return PwmAndOthers(wiring.robot.motor_names, moved, can_driver.FAMILY.wired(can, wiring))
    if boards is not None:
        return PwmAndOthers(
            wiring.robot.motor_names, moved, ethernet_driver.FAMILY.wired(boards, wiring)
        )
    return moved


class PwmAndOthers(ServosAndOthers):
    """Both as one; the others set the pace.

    Of the hobby servos' joints position is assumed, torque and temperature are NaN, and `age_s` is
    infinite: `maps` lets none of them be one that the robot balances by.
    """

    @property
    def capabilities(self) -> frozenset[Capability]:
        """What the motors can do that bear the robot."""
        return self.others.capabilities
