"""CAN buses that a simulation emulates: where its sockets are, and its time."""

from __future__ import annotations

from pathlib import Path
from typing import Self

import msgspec

from robot.clock import Clock
from robot.drivers.motors.can.joint_map import Bus, JointMap
from robot.drivers.motors.can.ports import PythonCan, socket_path
from robot.drivers.motors.plant_behind import PlantBehind
from robot.drivers.wiring import SimulatedPlant

INTERFACE = "humanoid"
"""Of python-can (`sim.devices.python_can`)."""


def buses_in(joints: JointMap, folder: Path) -> JointMap:
    """A map whose buses are the sockets that a simulation listens at."""
    buses = {
        name: Bus(
            channel=str(socket_path(folder, index)),
            interface=INTERFACE,
            bitrate_hz=bus.bitrate_hz,
            data_bitrate_hz=bus.data_bitrate_hz,
        )
        for index, (name, bus) in enumerate(joints.buses.items())
    }
    return msgspec.structs.replace(joints, buses=buses)


class EmulatedBuses(PythonCan):
    """Buses of a simulated plant, which is opened and closed with them."""

    def __init__(self, joints: JointMap, plant: SimulatedPlant, clock: Clock) -> None:
        """Know them; nothing is opened."""
        super().__init__(joints.buses, clock)
        self._behind = PlantBehind(plant)

    def __enter__(self) -> Self:
        """Open all. Raises DriverError if the plant or a bus is not there."""
        self._behind.open()
        super().__enter__()
        return self

    def close(self) -> None:
        """Close all."""
        super().close()
        self._behind.close()
