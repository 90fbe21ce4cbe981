"""Homes, their tasks and who plays what in them, made once for all tests."""

from functools import cache

from robot.reality.contract import Cast
from sim.homes.casting import cast
from sim.homes.home import Home, home
from sim.homes.task import Task
from sim.homes.tasks import tasks

SEEDS = range(6)


@cache
def made(kind: str, seed: int) -> Home:
    """A home."""
    return home(kind, seed)


@cache
def asked(kind: str, seed: int) -> list[Task]:
    """What is asked for there."""
    return tasks(made(kind, seed), seed)


@cache
def played(kind: str, seed: int) -> Cast:
    """Who plays the roles of a campaign there."""
    return cast(made(kind, seed), seed)
