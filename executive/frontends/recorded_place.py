"""Where a run was, and with which robot, from what its journal says it was started with."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from robot.errors import RobotError
from robot.model.description import RobotDescription
from robot.reality.contract import World
from robot.reality.visual_scene import VisualScene

UNSAID = "the journal does not say where this was"


class RecordedPlace(NamedTuple):
    """A world and a robot, as they are read here and now."""

    world: World
    robot: RobotDescription


def place_of(about: Mapping[str, Any]) -> RecordedPlace | None:
    """Where a run was that was started with this (`Run.about`); None where that is not said.

    A stranger's journal may name any file: what is wrong in one is for
    `executive.runs.again.recording.discreet` to keep back.

    Raises:
        ConfigError: a file of the world or of the robot is wrong.
    """
    world, robot, seed = about.get("world"), about.get("robot"), about.get("seed")
    if not (isinstance(world, str) and isinstance(robot, str)):
        return None
    from executive.frontends.composition_root import REALITY  # slow to load: once it is needed
    from robot.model import description

    vary_seed = seed if about.get("varied") and isinstance(seed, int) else None
    return RecordedPlace(REALITY.world(world, vary_seed=vary_seed), description.load(robot))


def scene_of(about: Mapping[str, Any]) -> VisualScene | str:
    """What the world looks like of a run that was started with this, or why nobody knows."""
    try:
        place = place_of(about)
        return UNSAID if place is None else place.world.scene(place.robot)
    except (RobotError, OSError):  # what is in files that a journal names is not told
        return "the world or the robot of this run cannot be read here"
