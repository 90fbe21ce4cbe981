"""Who tells a robot where things and people are, where nobody has said: its own eyes, if they hold.

A name that is wrong is worse than an oracle that says so: eyes count where they were tried, with
the things that stand there, and found what they were to find (docs/perception.md has figures).
"""

from __future__ import annotations

from robot.messages import EyesBy
from robot.reality.contract import World

TRIED = frozenset({("kitchen", "juno"), ("bench", "juno")})
"""Worlds that ship, by name, and the robots whose eyes were tried in them."""


def trusted(world: World, robot: str) -> EyesBy:
    """Who is to tell.

    Args:
        world: by the name that it was asked for; a shuffled one counts as itself.
        robot: by name or path.
    """
    return "camera" if (world.name, robot) in TRIED else "oracle"


def untried(world: str) -> str:
    """That an oracle tells a robot where things and people are, and how to get rid of it."""
    return (
        f"an oracle tells the robot where things and people are: its own eyes were not tried in "
        f"{world} yet (--eyes camera tries them)"
    )
