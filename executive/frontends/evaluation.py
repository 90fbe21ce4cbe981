"""`humanoid eval` at the command line; what it does is in `executive.evaluation.work`."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer


def evaluate(
    missions: Annotated[
        list[str] | None,
        typer.Argument(help="Sentences or mission files; none: those of the cases themselves."),
    ] = None,
    *,
    seeds: Annotated[int, typer.Option("--seeds", "-n", min=1, help="Runs of each case.")] = 3,
    faults: Annotated[
        str,
        typer.Option("--faults", "-f", help="Cases by name, or campaign files; commas between."),
    ] = "",
    processes: Annotated[
        int, typer.Option("--processes", "-j", min=1, help="Runs at the same time.")
    ] = max(1, os.cpu_count() or 1),
    no_recovery: Annotated[
        bool,
        typer.Option("--no-recovery", help="Run everything a second time without recovery."),
    ] = False,
    require: Annotated[
        float,
        typer.Option("--require", min=0.0, max=1.0, help="Share of each case that must be right."),
    ] = 0.95,
    resume: Annotated[
        Path | None,
        typer.Option("--resume", help="Folder of the results; what is in it is not run again."),
    ] = None,
    ray: Annotated[
        bool, typer.Option("--ray", help="On a Ray cluster, or a local Ray (extra: ray).")
    ] = False,
    world: Annotated[
        str, typer.Option("--world", "-w", help="Of the missions given here.")
    ] = "kitchen",
    robot: Annotated[str, typer.Option("--robot", "-r", help="By name or file (YAML).")] = "juno",
    as_json: Annotated[
        bool, typer.Option("--json", help="One JSON object, and nothing else.")
    ] = False,
) -> None:
    """Run missions with seeds and faults, over and over, and say how often it went right.

    Judged by the simulator's truth. Without missions and faults: the whole campaign of faults.

    [bold]Examples[/bold]

      humanoid eval --seeds 20 --no-recovery

      humanoid eval "put the red cup on the shelf" --seeds 10

      humanoid eval --faults "missed grasp,camera silent" --json

    Exit status 1 where a case is right in fewer runs than --require.
    """
    from executive.evaluation import work
    from executive.frontends.reality import REALITY

    options = work.Options(
        missions=tuple(missions or ()),
        faults=tuple(word.strip() for word in faults.split(",") if word.strip()),
        seeds=seeds,
        processes=processes,
        world=world,
        robot=robot,
        no_recovery=no_recovery,
        ray=ray,
        as_json=as_json,
        folder=resume,
        require=require,
    )
    raise typer.Exit(work.evaluate(options, REALITY))
