"""Servos, and the motors that another driver moves: one `MotorBus` for all of a robot."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Self, TypeAlias

import numpy as np
import numpy.typing as npt

from robot.closing import Closing
from robot.drivers.motor_bus import Capability, MotorBus, MotorCommand, MotorState
from robot.drivers.motors.can import driver as can_driver
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.dynamixel import driver as dynamixel_driver
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.limiter import FIELDS
from robot.drivers.motors.line_motors import LineMotors
from robot.drivers.wiring import Wiring
from robot.errors import ConfigError, DriverError, Problem
from robot.messages import MotorAlarm
from robot.model.description import RobotDescription
from robot.se3 import Array

LEVELS = ("OFF", "DAMP", "SIT", "HOLD", "DERATE", "WARN")


class Maps(NamedTuple):
    """Whose motor is whose: servos, and what CAN moves, if anything."""

    servos: ServoMap
    can: JointMap | None


def maps(robot: RobotDescription) -> Maps:
    """What `dynamixel.yaml` beside a description says; what it leaves to `can.yaml`, of that.

    Raises:
        ConfigError: either says what cannot be meant, a motor is in neither, or their rates differ.
    """
    servos = dynamixel_driver.FAMILY.beside(robot)
    can = can_driver.FAMILY.rest(robot, servos.joints)
    if can is not None and can.rate_hz != servos.rate_hz:
        text = f"servos are commanded at {servos.rate_hz} Hz, the motors on CAN at {can.rate_hz}"
        raise ConfigError([Problem(text, servos.file, suggestion="give both the same rate_hz")])
    return Maps(servos, can)


def make(wiring: Wiring) -> MotorBus:
    """The motors that `dynamixel.yaml` beside the description names, and the others.

    Raises:
        ConfigError: as `maps`.
        DriverError: the user does not let robots open one of the ports or buses.
    """
    servos, can = maps(wiring.robot)
    moved = dynamixel_driver.FAMILY.wired(servos, wiring, waits=can is None)
    if can is None:
        return moved
    others = can_driver.FAMILY.wired(can, wiring)
    return ServosAndOthers(wiring.robot.motor_names, moved, others)


AnyMotors: TypeAlias = LineMotors[Any, Any, Any, Any]


class ServosAndOthers(Closing):
    """Both as one; the others set the pace.

    They have the shorter watchdogs, and bear the robot: they are written to and left first.
    """

    def __init__(self, order: Sequence[str], servos: AnyMotors, others: AnyMotors) -> None:
        """Know them; nothing is opened.

        Args:
            order: the robot's motors.
            servos: of some of them; it must not wait (`waits`).
            others: of all the rest.
        """
        self.servos, self.others = servos, others
        places = {name: index for index, name in enumerate(order)}
        self._count = len(places)
        self._mine = np.array([places[name] for name in servos.joints.joints], np.intp)
        self._theirs = np.array([places[name] for name in others.joints.joints], np.intp)

    @property
    def capabilities(self) -> frozenset[Capability]:
        """What both can do."""
        return self.servos.capabilities & self.others.capabilities

    def __enter__(self) -> Self:
        """Open both. Raises DriverError if one cannot be."""
        self.others.__enter__()
        try:
            self.servos.__enter__()
        except BaseException:
            self.others.close()
            raise
        return self

    def close(self) -> None:
        """Leave all motors damped, unless another driver commands them, and close."""
        try:
            self.others.close()
        finally:
            self.servos.close()

    def reset(self) -> None:
        """Forget every alarm of both; their motors are armed anew by the next command."""
        self.others.reset()
        self.servos.reset()

    def claim(self) -> bool:
        """Become the one that commands all motors; False while another one commands any."""
        return self.others.claim() and self.servos.claim()

    def read(self) -> MotorState:
        """The state of all. Raises DriverError if one of both went away."""
        theirs = self.others.read()
        mine = self.servos.read()
        return MotorState(
            stamp_s=theirs.stamp_s,
            q=self._joined(mine.q, theirs.q),
            qd=self._joined(mine.qd, theirs.qd),
            tau=self._joined(mine.tau, theirs.tau),
            temperature_c=self._joined(mine.temperature_c, theirs.temperature_c),
            age_s=self._joined(mine.age_s, theirs.age_s),
            watchdog=mine.watchdog or theirs.watchdog,
            command_stamp_s=min(mine.command_stamp_s, theirs.command_stamp_s),
            alarms=_most_severe_first((*theirs.alarms, *mine.alarms)),
        )

    def write(self, command: MotorCommand) -> MotorCommand:
        """Command all motors; returns what was really sent.

        Raises:
            DriverError: as each of both; nothing is sent if a value is not finite.
        """
        for field in FIELDS:
            if (shape := getattr(command, field).shape) != (self._count,):
                raise DriverError(f"{field} has shape {shape}, motors want ({self._count},)")
        mine, theirs = self._part(command, self._mine), self._part(command, self._theirs)
        self.servos.limiter.check(mine)
        self.others.limiter.check(theirs)
        if not self.claim():
            raise DriverError("another controller commands the motors")
        self.servos.arm()
        told = self.others.write(theirs)
        moved = self.servos.write(mine)
        return MotorCommand(
            command.stamp_s,
            *(self._joined(getattr(moved, field), getattr(told, field)) for field in FIELDS),
        )

    def _part(self, command: MotorCommand, which: npt.NDArray[np.intp]) -> MotorCommand:
        return MotorCommand(command.stamp_s, *(getattr(command, field)[which] for field in FIELDS))

    def _joined(self, mine: Array, theirs: Array) -> Array:
        both = np.empty(self._count)
        both[self._mine], both[self._theirs] = mine, theirs
        return both


def _most_severe_first(alarms: Sequence[MotorAlarm]) -> tuple[MotorAlarm, ...]:
    return tuple(sorted(alarms, key=lambda alarm: LEVELS.index(alarm.level)))
