"""Homes and their tasks, made once for all tests."""

from functools import cache

from sim.homes.home import Home, home
from sim.homes.tasks import Task, tasks

SEEDS = range(6)


@cache
def made(kind: str, seed: int) -> Home:
    """A home."""
    return home(kind, seed)


@cache
def asked(kind: str, seed: int) -> list[Task]:
    """What is asked for there."""
    return tasks(made(kind, seed), seed)
