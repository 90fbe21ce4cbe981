"""A family of motors over lines as a row: its map, its driver, its real and its emulated lines."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, Generic, Protocol, TypeVar

import msgspec

from robot.clock import Clock
from robot.drivers.motors import motor_map
from robot.drivers.motors.alarms import untold
from robot.drivers.motors.line_motors import LineMotors, Lines
from robot.drivers.motors.motor_map import MotorMap
from robot.drivers.motors.plant_behind import PlantBehind, PlantClock
from robot.drivers.wiring import Wiring
from robot.files import users_own
from robot.model.description import RobotDescription

M = TypeVar("M", bound=MotorMap)
L = TypeVar("L", bound=Lines)
M_contra = TypeVar("M_contra", bound=MotorMap, contravariant=True)
L_contra = TypeVar("L_contra", bound=Lines, contravariant=True)


class MakesMotors(Protocol[M_contra, L_contra]):
    """A family's driver, as its class."""

    def __call__(
        self,
        joints: M_contra,
        clock: Clock,
        *,
        ports: Callable[[], L_contra],
        tell: Callable[[str], None] = untold,
        waits: bool = True,
        lets_go: bool = False,
        behind: PlantBehind | None = None,
    ) -> LineMotors[Any, Any, Any, Any]:
        """Know the motors of a map, as `LineMotors` has it."""
        ...


@dataclass(frozen=True, kw_only=True)
class LineFamily(Generic[M, L]):
    """One family.

    Attributes:
        file: its map beside a robot's description.
        map: of its motors.
        load: reads one; raises ConfigError.
        lines: what a map of it calls its buses, ports, boards or chips, and no other family's.
        at: which field of such a line says where it is.
        stem: of the files at which a simulation emulates them, with a number behind it.
        emulated: what else such a line says then.
        ports: of a map, opened by entering.
        motors: makes a driver.
    """

    file: str
    map: type[M]
    load: Callable[[Path], M]
    lines: str
    at: str
    stem: str
    emulated: Mapping[str, str] = field(default_factory=dict[str, str])
    ports: Callable[[M, Clock], L]
    motors: MakesMotors[M, L]

    def lines_of(self, joints: M) -> Mapping[str, Any]:
        """The lines of a map, by name."""
        return getattr(joints, self.lines)

    def path(self, folder: Path, number: int) -> Path:
        """Where a simulation has its line of that number, counted from 0."""
        return folder / f"{self.stem}{number}"

    def elsewhere(self, joints: M, channels: Mapping[str, str]) -> M:
        """A map with its lines where a simulation has them, by name."""
        there = {
            name: msgspec.structs.replace(line, **{self.at: channels[name]}, **self.emulated)
            for name, line in self.lines_of(joints).items()
        }
        return msgspec.structs.replace(joints, **{self.lines: there})

    def emulated_in(self, joints: M, folder: Path) -> M:
        """A map with its lines in a simulation's folder, in their order."""
        names = self.lines_of(joints)
        return self.elsewhere(
            joints, {name: str(self.path(folder, index)) for index, name in enumerate(names)}
        )

    def check_user(self, joints: M) -> None:
        """Whether the user lets robots open its lines: a map may be a stranger's, as a robot may.

        Raises:
            DriverError: the first that the user's own configuration does not name, with the cure.
        """
        for line in self.lines_of(joints).values():
            users_own.check_device(line.device)

    def beside(self, robot: RobotDescription) -> M:
        """The map beside a robot's description, in its motor order.

        Raises:
            ConfigError: as `load` and `motor_map.of_robot`.
        """
        found = self.load(robot.path().with_name(self.file))
        return motor_map.of_robot(found, robot.motor_names)

    def rest(self, robot: RobotDescription, moved: Container[str]) -> M | None:
        """What its map beside a description says of the motors that another driver does not move.

        Args:
            robot: the robot.
            moved: joints that the other one moves.

        Returns:
            Those, and the lines that they are on; None if there are none.

        Raises:
            ConfigError: as `beside`.
        """
        wanted = [name for name in robot.motor_names if name not in moved]
        if not wanted:
            return None
        whole = self.load(robot.path().with_name(self.file))
        joints = {name: one for name, one in whole.joints.items() if name not in moved}
        used = {one.line for one in joints.values()}
        lines = {name: line for name, line in self.lines_of(whole).items() if name in used}
        found = msgspec.structs.replace(whole, joints=joints, **{self.lines: lines})
        return motor_map.of_robot(found, wanted)

    def wired(
        self, joints: M, wiring: Wiring, *, waits: bool = True
    ) -> LineMotors[Any, Any, Any, Any]:
        """The motors of a map, emulated where a process emulates them.

        Args:
            joints: the map.
            wiring: of the process.
            waits: as `LineMotors` has it.

        Raises:
            DriverError: the user does not let robots open one of its lines.
        """
        if wiring.emulated is None:
            self.check_user(joints)
            opens = partial(self.ports, joints, wiring.clock)
            return self.motors(joints, wiring.clock, ports=opens, tell=print, waits=waits)
        plant = wiring.simulated_plant()
        there, time = self.emulated_in(joints, wiring.emulated), PlantClock(plant)
        opens, behind = partial(self.ports, there, time), PlantBehind(plant)
        return self.motors(there, time, ports=opens, tell=print, waits=waits, behind=behind)

    def make(self, wiring: Wiring) -> LineMotors[Any, Any, Any, Any]:
        """The motors that its map beside the description names: all of the robot's.

        Raises:
            ConfigError: the file says what cannot be meant, or lacks a motor of the robot.
            DriverError: as `wired`.
        """
        return self.wired(self.beside(wiring.robot), wiring)
