"""The command lines of `humanoid why`, `history`, `replay` and `resume`."""

from __future__ import annotations

from typing import Annotated

import typer

from executive.frontends import completing
from executive.frontends.options import Model, Record, View, Viewed
from executive.frontends.service import place
from executive.frontends.service.options import Name

Run = Annotated[
    str | None,
    typer.Argument(
        help="A run's folder or a part of its name (default: the newest).",
        autocompletion=completing.runs,
    ),
]
AsJson = Annotated[bool, typer.Option("--json", help="JSON, and nothing else.")]


def register(app: typer.Typer) -> None:
    """Add the commands to the command line."""
    app.command()(why)
    app.command()(history)
    app.command()(replay)
    app.command()(resume)
    app.add_typer(runs_app, name="runs")


def why(run: Run = None, *, as_json: AsJson = False) -> None:
    """Say why a run ended as it did: the chain from the symptom to its cause.

    [bold]Examples[/bold]

      humanoid why                    (the newest run, also one that is under way)

      humanoid why red-cup            (the run with that in its folder's name)
    """
    from executive.frontends.past_runs import printing

    raise typer.Exit(printing.why(run, as_json=as_json))


def history(
    *,
    count: Annotated[
        int, typer.Option("--last", "-n", min=1, max=100_000, help="How many runs.")
    ] = 20,
    everything: Annotated[bool, typer.Option("--all", help="All of them.")] = False,
    everywhere: Annotated[
        bool, typer.Option("--everywhere", help="Of every folder in which something was run.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """List past runs: when, how they ended, how long they took, and what they were about.

    [bold]Examples[/bold]

      humanoid history                (of this folder)

      humanoid history --everywhere --last 50
    """
    from executive.frontends.past_runs import printing

    shown = 10**9 if everything else count
    raise typer.Exit(printing.history(count=shown, as_json=as_json, everywhere=everywhere))


runs_app = typer.Typer(no_args_is_help=True, help="The folders of past runs.")


@runs_app.command()
def prune(
    *,
    keep: Annotated[
        int | None, typer.Option("--keep", min=0, max=1_000_000, help="So many, the newest.")
    ] = None,
    older_than: Annotated[
        float | None,
        typer.Option(
            "--older-than", min=0.0, max=100_000.0, help="Only those that are older, in days."
        ),
    ] = None,
    everywhere: Annotated[
        bool, typer.Option("--everywhere", help="Of every folder in which something was run.")
    ] = False,
    yes: Annotated[bool, typer.Option("--yes", "-y", help="Without asking.")] = False,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Only say what would be removed.")
    ] = False,
) -> None:
    """Remove old run folders; never one that is under way, another user's, or a link.

    [bold]Examples[/bold]

      humanoid runs prune --keep 20

      humanoid runs prune --older-than 30 --everywhere --dry-run
    """
    from executive.frontends.past_runs import pruning

    raise typer.Exit(
        pruning.prune(
            keep=keep, older_than_days=older_than, everywhere=everywhere, yes=yes, dry_run=dry_run
        )
    )


def replay(run: Run = None, *, as_json: AsJson = False) -> None:
    """Do a --fast run again and prove it identical, or show the first difference.

    Requests of a person (pause, stop, more jobs) are made again at the same ticks.

    [bold]Example[/bold]

      humanoid replay 20261121-134158

    Exit status: 0 identical, 1 different, 2 it cannot be replayed.
    """
    from executive.frontends.past_runs import printing

    raise typer.Exit(printing.replay(run, as_json=as_json))


def resume(
    run: Run = None,
    *,
    name: Name = None,
    model: Model = None,
    view: View = False,
    record: Record = False,
    as_json: AsJson = False,
) -> None:
    """Go on: a robot that is up and paused; or a run that was cut off by kill -9, a power cut.

    Without RUN, while a robot is up (`humanoid up`), that robot goes on with the step that was
    paused. Otherwise it is a run:

    A --fast run is done again up to where it was, proved to be the same, and goes on. Of a live run
    only the journal is left: a new robot holds what was done against its world, and does again what
    is not so. (While its robot lives, a live run goes on by itself when its executive dies.)

    [bold]Example[/bold]

      humanoid resume 20261121-134158

      humanoid pause; humanoid resume      (a robot that is up)

    Exit status: as of humanoid do; 1 also if it does not repeat, 2 if nothing is left of it.
    """
    if run is None and (name is not None or place.places_up()):
        from executive.frontends.service import commands

        raise typer.Exit(commands.button(name, "resume"))
    from executive.frontends.past_runs import resume as command

    page = Viewed(view=view, record=record)
    raise typer.Exit(command.resume(run, model=model, as_json=as_json, page=page))
