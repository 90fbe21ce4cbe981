"""What other programs need besides a run's own files: shapes, names, the wall clock."""

from __future__ import annotations

from pathlib import Path

from executive.frontends.output import say
from executive.frontends.recorded_place import place_of
from executive.journal import journal, motion, past_runs
from executive.journal.run import Run
from executive.runs.again.recording import discreet
from robot.errors import ConfigError
from robot.reality.visual_scene import VisualScene

LAST_S = 3e9
"""Of the wall clock, in 2065: stamps of MCAP's messages end in 2106."""


def looks(run: Run, folder: Path) -> tuple[tuple[str, ...], VisualScene | None]:
    """Names of the robot's motors, and what it and its world look like; else numbers, and None."""
    try:
        with discreet(folder):
            place = place_of(run.about)
            if place is not None:
                return place.robot.motor_names, place.world.scene(place.robot)
    except ConfigError as error:
        say(str(error), err=True)
    try:
        first = next((one for one in motion.read(folder) if abs(one.t_s) < journal.MOST_S), None)
    except OSError:
        first = None
    return tuple(map(str, range(len(first.q)))) if first is not None else (), None


def began_s(folder: Path, run: Run) -> float:
    """The wall clock at time 0 of the robot [s since 1970]."""
    return min(max(past_runs.began_s(folder) - run.begin_s, 0.0), LAST_S)
