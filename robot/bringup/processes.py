"""The processes of a robot as data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Process:
    """One operating-system process.

    Attributes:
        name: its name on the bus and of its log.
        module: run as `python -m module RUN_FILE`.
        when: "always", or only where the plant is a simulation.
        death: failure code that its death means, once it is not restarted any more.
        restarts: how often it may be started again within `RESTART_WINDOW_S`. What moves motors is
            never restarted by itself: a robot that lost its controller is not where it was.
    """

    name: str
    module: str
    when: Literal["always", "simulation"]
    death: str
    restarts: int = 0


RESTART_WINDOW_S = 60.0

PROCESSES: tuple[Process, ...] = (
    Process("plant", "sim.main", "simulation", death="plant_lost"),
    Process("controller", "robot.control.main", "always", death="controller_lost"),
    Process("perception", "robot.perception.main", "always", death="localisation_lost", restarts=3),
)
"""In the order of starting; they are stopped in the order of `STOP_ORDER`."""

STOP_ORDER = ("controller", "perception", "plant")
"""The controller first, while there is still a plant that takes its last command: damping."""
