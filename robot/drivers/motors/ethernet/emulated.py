"""Boards that a simulation emulates: where it says on which port each is, and its time."""

from __future__ import annotations

from pathlib import Path
from typing import Self

import msgspec

from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.ethernet.ports import UdpPorts
from robot.drivers.motors.plant_behind import PlantBehind
from robot.drivers.wiring import SimulatedPlant


def address_path(folder: Path, number: int) -> Path:
    """Where a simulation says at which address its board of that number is, counted from 0."""
    return folder / f"udp{number}"


def boards_in(joints: DriveMap, folder: Path) -> DriveMap:
    """A map whose boards are those that a simulation emulates."""
    boards = {
        name: msgspec.structs.replace(board, address=str(address_path(folder, index)))
        for index, (name, board) in enumerate(joints.boards.items())
    }
    return msgspec.structs.replace(joints, boards=boards)


class EmulatedBoards(UdpPorts):
    """Boards of a simulated plant, which is opened and closed with them."""

    def __init__(self, joints: DriveMap, plant: SimulatedPlant) -> None:
        """Know them; nothing is opened."""
        super().__init__(joints.boards)
        self._behind = PlantBehind(plant)

    def __enter__(self) -> Self:
        """Open all. Raises DriverError if the plant or a board is not there."""
        self._behind.open()
        super().__enter__()
        return self

    def close(self) -> None:
        """Close all."""
        super().close()
        self._behind.close()
