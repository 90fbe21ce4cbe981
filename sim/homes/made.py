"""A home and its tasks as the texts of two files."""

from __future__ import annotations

from robot.reality.contract import Home
from sim.homes.home import Size, home
from sim.homes.tasks import tasks
from sim.homes.writing import tasks_yaml, world_yaml


def made(
    kind: str,
    seed: int,
    *,
    file: str,
    size: Size = Size(),  # noqa: B008, it is frozen
    is_lived_in: bool = False,
    has_forms: bool = False,
) -> Home:
    """Make a home; `file` is how its tasks name its world. Raises ConfigError as `home`."""
    found = home(kind, seed, size, is_lived_in=is_lived_in, has_forms=has_forms)
    by = f"humanoid worlds new --kind {kind} --seed {seed}"
    by += "".join(
        f" --{name} {count}"
        for name, count in (("rooms", size.rooms), ("things", size.things))
        if count is not None
    )
    by += " --lived-in" * is_lived_in + " --real-things" * has_forms
    return Home(
        world=world_yaml(found, head=f"A home made by `{by}`; docs/worlds.md says what is what."),
        tasks=tasks_yaml(
            tasks(found, seed),
            world=file,
            head=f"What somebody would ask for there; made by `{by}`.",
        ),
    )
