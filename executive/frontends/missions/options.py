"""The options of `humanoid mission`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import typer

from executive.frontends.options import AsJson, Kept, Shown, Shuffled, Viewed

File = Annotated[str, typer.Argument(help="A mission file, or the name of a shipped mission.")]


@dataclass(frozen=True, kw_only=True)
class Beside:
    """What can be said beside a mission's file."""

    params: Annotated[
        list[str] | None, typer.Option("--param", "-p", help="A parameter's value: NAME=VALUE.")
    ] = None
    first: Annotated[str, typer.Option("--from", help="Begin at this step (see mission plan).")] = (
        ""
    )
    world: Annotated[
        str | None, typer.Option("--world", "-w", help="In place of the mission's world.")
    ] = None
    robot: Annotated[
        str | None, typer.Option("--robot", "-r", help="In place of the mission's robot.")
    ] = None


@dataclass(frozen=True, kw_only=True)
class Check(Beside):
    """The options of `humanoid mission check`."""

    files: Annotated[list[str], typer.Argument(help="Mission files, or names of shipped ones.")]
    as_json: AsJson = False


@dataclass(frozen=True, kw_only=True)
class Plan(Beside):
    """The options of `humanoid mission plan`."""

    file: File
    as_json: AsJson = False


@dataclass(frozen=True, kw_only=True)
class Run(Beside, Shuffled, Viewed, Kept, Shown):
    """The options of `humanoid mission run`."""

    file: File
