"""Tasks for a home: what somebody would ask for there, and what is true once it is done.

The form is that of task files (docs/evaluation.md): a sentence, checks of the simulator's truth,
and a calm person's time. Each begins with the home as it is.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable

import numpy as np

from sim.homes import errands, tidying_tasks
from sim.homes.home import Home
from sim.homes.task import Task
from sim.homes.visitor import Visitor

COUNT = 10


def tasks(home: Home, seed: int) -> list[Task]:
    """Ten tasks of ten kinds; a kind that this home has no occasion for gives way to another."""
    name = home.world.name
    rng = np.random.default_rng([seed, zlib.crc32(name.encode()), 0x7A5C])
    visitor = Visitor(home, rng)
    last = visitor.shuffled(("nextto", "patrol"))
    order = [kind for kind in KINDS if kind not in last] + last
    made = {kind: KINDS[kind](visitor) for kind in order}
    found = [task for task in made.values() if task is not None][:COUNT]
    while len(found) < COUNT:
        more = tidying_tasks.fetch(visitor)
        if more is None:
            break
        found.append(more)
    return found


KINDS: dict[str, Callable[[Visitor], Task | None]] = {
    "fetch": tidying_tasks.fetch, "two": tidying_tasks.two, "relative": tidying_tasks.relative,
    "conditional": tidying_tasks.conditional, "route": errands.route, "search": errands.search,
    "person": errands.person, "count": errands.count, "all": tidying_tasks.all_of_a_kind,
    "nextto": tidying_tasks.nextto, "patrol": errands.patrol,
}  # fmt: skip
"""In the order in which they are tried: what is drawn depends on it."""
