"""The processes of a robot as data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

RESTART_WINDOW_S = 60.0


@dataclass(frozen=True)
class Process:
    """One operating-system process.

    Attributes:
        name: its name on the bus and of its log.
        module: run as `python -m module FILE PARENT`.
        when: "always", only where reality is simulated, only where that is looked at through its
            robot's camera as well, or only where a process of its own commands the motors.
        death: failure code that its death means, once it is not restarted any more.
        restarts: how often it may be started again within `RESTART_WINDOW_S`.
        is_vital: whether a run ends when it is not restarted any more.
        spare_after_s: how long after the first start a second one is loaded, which waits for its
            turn, and as long after it the next; not at once, as they would compete for the
            processor. None: never.
        spares: how many are kept, as long as it may be started again so often.
        stop_s: how long it may take to stop before it is killed.
    """

    name: str
    module: str
    when: Literal["always", "simulation", "pictures", "owned"]
    death: str
    restarts: int = 0
    is_vital: bool = True
    spare_after_s: float | None = None
    spares: int = 1
    stop_s: float = 3.0

    def may_start_again(self, starts_s: Sequence[float], now_s: float) -> bool:
        """Whether it may, after the starts at these times (the first of them was no restart)."""
        return self.restarts_left(starts_s, now_s) > 0

    def restarts_left(self, starts_s: Sequence[float], now_s: float) -> int:
        """How often it may."""
        recent = [start_s for start_s in starts_s[1:] if start_s > now_s - RESTART_WINDOW_S]
        return self.restarts - len(recent)

    def needed(self, *, simulated: bool, pictures: bool = False, owned: bool = False) -> bool:
        """Whether it is run, where reality is simulated or not, looked at, buses owned or not."""
        if self.when == "owned":
            return owned
        wanted = self.when != "pictures" or pictures
        return self.when == "always" or (simulated and wanted)


CONTROLLER = Process(
    "controller", "robot.control.main", "always",
    death="controller_lost", restarts=2, spare_after_s=4.0, spares=2,
)  # fmt: skip
"""When it dies a spare holds the robot up; the third death in a minute is the last. There is a
spare for each death: what is loaded after one takes a second, on a busy machine several, and a
robot that nobody holds up meanwhile falls."""

PROCESSES: tuple[Process, ...] = (
    Process("plant", "sim.main", "simulation", death="plant_lost"),
    Process("owner", "robot.owner.main", "owned", death="motor_fault", stop_s=15.0),
    CONTROLLER,
    Process("perception", "robot.perception.main", "always", death="localisation_lost", restarts=3),
    Process(
        "camera", "sim.camera_main", "pictures",
        death="camera_unplugged", restarts=3, is_vital=False,
    ),
)  # fmt: skip
"""In the order of starting; they are stopped in the order of `STOP_ORDER`. The owner of the motors
ends at once, but where it sits the robot down: for that it is given time (`stop_s`)."""

STOP_ORDER = ("controller", "owner", "perception", "camera", "plant")
"""The controller first, while there is still a plant that takes its last command: damping."""

EXECUTIVE = Process(
    "executive", "executive.main", "always",
    death="internal", restarts=2, spare_after_s=6.0, stop_s=8.0,
)  # fmt: skip
"""Has the terminal, asks for the others, and ends before them: see `robot.bringup.launcher`.

When it dies the robot finishes its step and stands; the third death in a minute is the last.
"""
