"""Ports of servos that a simulation emulates: where its terminals are, and its time."""

from __future__ import annotations

from pathlib import Path
from typing import Self

import msgspec

from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.dynamixel.ports import SerialPorts
from robot.drivers.motors.plant_behind import PlantBehind
from robot.drivers.wiring import SimulatedPlant


def terminal_path(folder: Path, number: int) -> Path:
    """Where a simulation puts its port of that number, counted from 0."""
    return folder / f"dxl{number}"


def ports_in(joints: ServoMap, folder: Path) -> ServoMap:
    """A map whose ports are the terminals of a simulation."""
    ports = {
        name: msgspec.structs.replace(port, device=str(terminal_path(folder, index)))
        for index, (name, port) in enumerate(joints.ports.items())
    }
    return msgspec.structs.replace(joints, ports=ports)


class EmulatedPorts(SerialPorts):
    """Ports of a simulated plant, which is opened and closed with them."""

    def __init__(self, joints: ServoMap, plant: SimulatedPlant) -> None:
        """Know them; nothing is opened."""
        super().__init__(joints.ports)
        self._behind = PlantBehind(plant)

    def __enter__(self) -> Self:
        """Open all. Raises DriverError if the plant or a port is not there."""
        self._behind.open()
        super().__enter__()
        return self

    def close(self) -> None:
        """Close all."""
        super().close()
        self._behind.close()
