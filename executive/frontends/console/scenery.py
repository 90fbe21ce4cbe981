"""What the world of a run looks like, from what its journal says it was started with."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from robot.errors import RobotError
from robot.reality.scene import Scene


def scene_of(about: Mapping[str, Any]) -> Scene | str:
    """What the world looks like of a run that was started with this, or why nobody knows."""
    world, robot, seed = about.get("world"), about.get("robot"), about.get("seed")
    if not (isinstance(world, str) and isinstance(robot, str)):
        return "the journal does not say where this was"
    from executive.frontends.composition_root import REALITY  # loaded once the page is served
    from robot.model import description

    vary_seed = seed if about.get("varied") and isinstance(seed, int) else None
    try:
        return REALITY.world(world, vary_seed=vary_seed).scene(description.load(robot))
    except (RobotError, OSError):  # what is in files that a journal names is not told
        return "the world or the robot of this run cannot be read here"
