"""What `humanoid eval` does: choose the cases, run what is left of them, say how it went."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

import msgspec
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

import executive
from executive.evaluation import campaign, pool, report
from executive.evaluation.campaign import Case, Run
from executive.evaluation.record import Record, Results, fingerprint
from executive.frontends.options import Eval
from executive.frontends.output import Screen, say, table_screen, write_json
from executive.frontends.reality import REALITY
from executive.runs import run_folder
from robot.config import nearest
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.ordinary_files import write_ordinary

MAX_WIDTH = 1000
"""Of any table: how wide it would be is asked without a bound of the terminal."""


def evaluate(options: Eval) -> int:
    """Run a campaign, or what is left of one; returns the exit status.

    Raises:
        ConfigError: if a mission, a file or a name is wrong; nothing has been run then.
    """
    cases = chosen(options)
    wanted = campaign.runs(
        cases, seeds=options.seeds, without_too=options.no_recovery, robot=options.robot
    )
    folder = options.resume or Path("runs") / f"{datetime.now().astimezone():%Y%m%d-%H%M%S}-eval"
    root = Path(executive.__file__).parent.parent
    run_folder.claim(folder)
    results = Results(folder, fingerprint=fingerprint(root))
    console = Screen(err=True, quiet=options.as_json)
    if results.stale:
        console.print("some results there were made by other code", style="yellow")
    _go_through(results, results.left(wanted), options, console)
    found = report.report(cases, results.records.values())
    save(folder, found)
    if options.as_json:
        write_json(found)
    else:
        show(found)
        say(f"results: {results.path}; go on with: --resume {folder}")
    well = found.worst >= options.require and not found.without_code
    return ExitStatus.DONE if well else ExitStatus.FAILED


def show(found: report.Report) -> None:
    """The report as a table, where the terminal is wide enough for one."""
    screen, table = table_screen(), report.table(found)
    unbound = screen.options.update(width=MAX_WIDTH)
    if screen.measure(table, options=unbound).maximum <= screen.width:
        screen.print(table)
    else:
        say(report.narrow(found))


def save(folder: Path, found: report.Report) -> None:
    """Keep the table beside the results, for machines and for people."""
    data = msgspec.json.format(msgspec.json.encode(found, order="deterministic"))
    try:
        write_ordinary(folder / "report.json", data + b"\n")
        write_ordinary(folder / "report.md", report.markdown(found).encode())
    except OSError as error:
        text = f"the report in {folder} cannot be written: {error.strerror}"
        raise ConfigError(
            [Problem(text, suggestion="the records are there: --resume it")]
        ) from None


def chosen(options: Eval) -> tuple[Case, ...]:
    """The cases that the options mean.

    Faults name cases of the shipped campaign or are campaign files; missions of one's own are run
    with the faults of those cases, and without any when no fault is named.

    Raises:
        ConfigError: if a name or a file is wrong.
    """
    cases: list[Case] = []
    shipped: dict[str, Case] | None = None
    for word in options.cases:
        if word.endswith((".yaml", ".yml")):
            cases += campaign.load(word, REALITY, robot=options.robot)
            continue
        if shipped is None:
            shipped = {one.name: one for one in campaign.load(campaign.SHIPPED, REALITY)}
        if word not in shipped:
            hint = nearest(word, list(shipped))
            raise ConfigError([Problem(f"unknown fault {word!r}", suggestion=hint)])
        cases.append(shipped[word])
    if not options.missions:
        return tuple(cases) or campaign.load(campaign.SHIPPED, REALITY, robot=options.robot)
    every: list[Case | None] = [*cases] or [None]
    own = [_own(mission, case, options) for mission in options.missions for case in every]
    settings = campaign.Settings(REALITY, options.robot)
    problems = [
        Problem(f"{case.name}: {text}")
        for case in own
        for text in campaign.problems_of(case, settings)
    ]
    if problems:
        raise ConfigError(problems)
    return tuple(own)


def _own(mission: str, fault: Case | None, options: Eval) -> Case:
    """A mission of one's own, with the fault of a case."""
    name = Path(mission).stem if mission.endswith((".yaml", ".yml")) else mission
    if fault is None:
        return Case(name=name, mission=mission, world=options.world)
    return Case(
        name=f"{name}, {fault.name}",
        mission=mission,
        world=options.world,
        faults=fault.faults,
        expect=fault.expect,
        damped=fault.damped,
        limit_s=600.0,
    )


def _go_through(results: Results, runs: list[Run], options: Eval, console: Screen) -> None:
    """Do the runs that are left, keeping each record as it comes."""
    work = (
        pool.on_ray(runs, REALITY)
        if options.ray
        else pool.in_processes(runs, REALITY, processes=options.processes)
    )
    done = len(results.records)
    columns = (
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn(),
        TextColumn("{task.fields[last]}", markup=False),
    )  # fmt: skip
    with Progress(*columns, console=console, disable=not console.is_terminal) as bar:
        task = bar.add_task("eval", total=done + len(runs), completed=done, last="")
        for record in work:
            results.add(record)
            bar.update(task, advance=1, last=_short(record))
            if not console.is_terminal:
                console.print(f"{len(results.records)}/{done + len(runs)} {_short(record)}")


def _short(record: Record) -> str:
    return f"{record.key}: {'ok' if record.ok else 'WRONG'} ({record.code})"
