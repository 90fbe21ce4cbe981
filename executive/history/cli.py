"""The command lines of `humanoid why`, `history`, `replay` and `resume`."""

from __future__ import annotations

from typing import Annotated

import typer

Run = Annotated[
    str | None, typer.Argument(help="A run's folder or a part of its name (default: the newest).")
]
AsJson = Annotated[bool, typer.Option("--json", help="JSON, and nothing else.")]


def register(app: typer.Typer) -> None:
    """Add the commands to the command line."""
    app.command()(why)
    app.command()(history)


def why(run: Run = None, *, as_json: AsJson = False) -> None:
    """Say why a run ended as it did: the chain from the symptom to its cause.

    [bold]Examples[/bold]

      humanoid why                    (the newest run, also one that is under way)

      humanoid why red-cup            (the run with that in its folder's name)
    """
    from executive.history import showing

    raise typer.Exit(showing.why(run, as_json=as_json))


def history(
    *,
    count: Annotated[int, typer.Option("--last", "-n", min=1, help="How many runs.")] = 20,
    everything: Annotated[bool, typer.Option("--all", help="All of them.")] = False,
    as_json: AsJson = False,
) -> None:
    """List past runs: when, how they ended, how long they took, and what they were about."""
    from executive.history import showing

    raise typer.Exit(showing.history(count=10**9 if everything else count, as_json=as_json))
