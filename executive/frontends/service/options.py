"""The options of a robot that is up, and of those who reach it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import typer

from executive.frontends.completing import completes
from executive.frontends.options import Prompt
from executive.frontends.service.place import DEFAULT_NAME, places_up


@completes
def _names() -> list[str]:
    """Robots that are up."""
    return [one.name for one in places_up()]


Name = Annotated[
    str | None,
    typer.Option("--name", help="Which robot, where more than one is up.", autocompletion=_names),
]


@dataclass(frozen=True, kw_only=True)
class Up(Prompt):
    """The options of `humanoid up`."""

    name: Annotated[
        str, typer.Option("--name", help="What it is reached by, where more than one is up.")
    ] = DEFAULT_NAME
    detach: Annotated[
        bool, typer.Option("--detach", "-d", help="Leave the terminal once it is up.")
    ] = False
