"""`python -m benchmarks`: run benchmarks, keep their results, rewrite docs/benchmarks.md."""

from __future__ import annotations

import time
from typing import Annotated

import typer
from msgspec.structs import replace
from rich.console import Console
from rich.markdown import Markdown

from benchmarks import body, campaign, machine, mission, report, tables
from benchmarks.report import Results

RUNS = {"body": (body.jobs, tables.render), "mission": (mission.jobs, mission.render)}
app = typer.Typer(add_completion=False)


@app.command()
def main(
    *,
    only: Annotated[str, typer.Option(help="body or mission; both by default")] = "",
    quick: Annotated[bool, typer.Option("--quick", help="fewer and shorter runs")] = False,
    match: Annotated[
        str, typer.Option(help="only runs whose key contains this; keeps nothing")
    ] = "",
    again: Annotated[
        str, typer.Option(help="only runs whose key contains this; put in place of those kept")
    ] = "",
    processes: Annotated[int, typer.Option(help="at once")] = 2,
    fresh: Annotated[bool, typer.Option("--fresh", help="forget an interrupted campaign")] = False,
) -> None:
    """Measure; results go to benchmarks/results and docs/benchmarks.md."""
    console = Console()
    names = [only] if only else list(RUNS)
    for name in names:
        if name not in RUNS:
            raise typer.BadParameter(f"no benchmark {name!r}; there are {', '.join(RUNS)}")
        list_jobs, render = RUNS[name]
        jobs = [job for job in list_jobs(quick=quick) if (match or again) in job.key]
        begin_s = time.monotonic()
        label = "-".join([name, *(["quick"] if quick else []), *(["again"] if again else [])])
        outcomes = campaign.run(label, jobs, processes=processes, fresh=fresh)
        took_s = round(time.monotonic() - begin_s, 1)
        console.print(Markdown(render(outcomes)))
        kept = report.newest(name) if again else None
        if kept is not None:
            results = replace(kept, outcomes={**kept.outcomes, **outcomes})
        else:
            results = Results(
                machine=machine.describe(), quick=quick, took_s=took_s, outcomes=outcomes
            )
        if not match:
            path = report.save(name, results)
            newest = report.newest(name) or results
            report.write(name, render(newest.outcomes), newest)
            console.print(f"kept in {path}, tables in {report.PAGE}")


if __name__ == "__main__":
    app()
