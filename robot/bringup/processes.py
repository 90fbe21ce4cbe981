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
        restarts: how often it may be started again within `RESTART_WINDOW_S`.
        spare: whether a second one is loaded and waits for its turn.
    """

    name: str
    module: str
    when: Literal["always", "simulation"]
    death: str
    restarts: int = 0
    spare: bool = False

    def may_start_again(self, starts_s: list[float], now_s: float) -> bool:
        """Whether it may, after the starts at these times (the first of them was no restart)."""
        recent = [start_s for start_s in starts_s[1:] if start_s > now_s - RESTART_WINDOW_S]
        return len(recent) < self.restarts


RESTART_WINDOW_S = 60.0

CONTROLLER = Process(
    "controller", "robot.control.main", "always", death="controller_lost", restarts=2, spare=True
)
"""When it dies the spare holds the robot up; the third death in a minute is the last."""

PROCESSES: tuple[Process, ...] = (
    Process("plant", "sim.main", "simulation", death="plant_lost"),
    CONTROLLER,
    Process("perception", "robot.perception.main", "always", death="localisation_lost", restarts=3),
)
"""In the order of starting; they are stopped in the order of `STOP_ORDER`."""

EXECUTIVE = Process("executive", "executive.main", "always", death="internal", restarts=2)
"""Has the terminal, asks for the others, and ends before them: see `robot.bringup.overseer`.

When it dies the robot finishes its step and stands; the third death in a minute is the last.
"""

STOP_ORDER = ("controller", "perception", "plant")
"""The controller first, while there is still a plant that takes its last command: damping."""
