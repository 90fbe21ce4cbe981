"""What `humanoid eval` does: choose the cases, run what is left of them, say how it went."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Iterable
from itertools import islice
from pathlib import Path

import msgspec
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

import executive
from executive.evaluation import (
    campaign,
    elsewhere,
    exam,
    homes_report,
    keeping,
    marks,
    pool,
    report,
)
from executive.evaluation.campaign import Case, Run
from executive.evaluation.record import FILE, Record, Results, fingerprint, folder_to_resume
from executive.frontends import evaluation_asked
from executive.frontends.composition_root import REALITY
from executive.frontends.end_signals import Ending
from executive.frontends.evaluation_localised import Localised
from executive.frontends.evaluation_report import Found, save, show, well
from executive.frontends.exit import last_words
from executive.frontends.launching import new_folder
from executive.frontends.options import Eval
from executive.frontends.output import Screen, say, write_json
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.config import nearest

MOST_REMARKS = 20
"""So many cases are named whose words were taken for others; who made more reads the file."""
WORLD = "kitchen"
"""Where a sentence of one's own is done if nothing else is said, as by `humanoid do`."""


def evaluate(options: Eval) -> int:
    """Run a campaign, or what is left of one; returns the exit status.

    A signal that asks for the end gives up the runs that are under way; what is done is kept.

    Raises:
        ConfigError: if a mission, a file or a name is wrong; nothing has been run then.
        ProcessError: a worker died.
    """
    if options.resume is not None:
        folder_to_resume(options.resume)  # before a word is said of what is to be run
    options = evaluation_asked.as_before(options)
    REALITY.under(options.reality)  # so that one that is not there is said before anything is run
    moved = _moved(options) if options.homes else None
    cases = moved.cases if moved else chosen(options)
    localised = Localised(options)
    wanted = campaign.runs(
        cases,
        seeds=options.seeds,
        without_too=options.no_recovery,
        robot=options.robot,
        reality=options.reality,
        eyes=options.eyes,
        localised=localised,
    )
    localised.say()
    root = Path(executive.__file__).parent.parent
    with Results(_folder(options), fingerprint=fingerprint(root)) as results:
        evaluation_asked.keep(results.path.parent, options)
        screen = Screen(err=True, quiet=options.as_json)
        left = results.left(wanted)
        mixed = results.stale and len(left) < len(wanted)
        if mixed:
            screen.print("some results there were made by other code", style="yellow")
        with Ending() as ending:
            _go_through(results, left, options, screen, ending=ending)
        left = results.left(wanted)
        records = results.records.values()
        found = _summed_up(cases, moved, options, records, left=len(left), mixed=mixed)
        _say(found, results.path.parent, options)
        say_remarks(records)
        if ending.asked:
            return _stopped(found, results.path.parent)
        return ExitStatus.DONE if well(found, options.require) else ExitStatus.FAILED


def _summed_up(
    cases: tuple[Case, ...],
    moved: elsewhere.Moved | None,
    options: Eval,
    records: Iterable[Record],
    *,
    left: int,
    mixed: bool,
) -> Found:
    if moved is not None:
        skipped = moved.skipped
        return homes_report.homes_report(cases, records, skipped=skipped, left=left, mixed=mixed)
    sum_up = marks.marks if options.tasks else report.report
    return sum_up(cases, records, left=left, mixed=mixed)


def _folder(options: Eval) -> Path:
    """Where the results are, or are to be. Raises ConfigError if there are none to go on with."""
    if options.resume is not None:
        return folder_to_resume(options.resume)
    return new_folder("eval")


def _say(found: Found, folder: Path, options: Eval) -> None:
    """Keep the table, and print it."""
    save(folder, found)
    if options.as_json:
        write_json(found)
        return
    if found.runs:
        show(found)
    if (folder / keeping.FOLDER).is_dir():
        say(f"run by run: humanoid why {folder / keeping.FOLDER}/NAME (dump and film, too)")
    if not found.left:
        say(f"results: {folder / FILE}; more seeds with: --resume {folder}")


def say_remarks(records: Iterable[Record]) -> None:
    """Say how missions were understood where that is not plain, once for all runs of a case."""
    remarks = dict.fromkeys((one.case, one.remark) for one in records if one.remark)
    for case, remark in islice(remarks, MOST_REMARKS):
        say(f"{case}: {remark}", err=True)
    if len(remarks) > MOST_REMARKS:
        say(f"and {len(remarks) - MOST_REMARKS} more in {FILE}", err=True)


def _stopped(found: Found, folder: Path) -> int:
    """Say what is kept, and how to go on; returns the exit status."""
    words = iter(sys.argv[1:])
    said = [
        word
        for word in words
        if not word.startswith("--resume=") and not (word == "--resume" and next(words, True))
    ]
    again = shlex.join(["humanoid", *said, "--resume", str(folder)])
    lines = [f"{found.runs} runs are kept, {found.left} are left (those under way were given up)"]
    cure = f"go on with: {again}"
    return last_words("Stopped on request.", lines, cure, status=ExitStatus.FAILED, as_json=False)


def chosen(options: Eval) -> tuple[Case, ...]:
    """The cases that the options mean.

    Faults name cases of the shipped campaign or are campaign files; missions of one's own are run
    with the faults of those cases, and without any when no fault is named.

    Raises:
        ConfigError: with everything that is wrong in names and files.
    """
    settings = campaign.Settings(REALITY, options.robot)
    if options.tasks:
        return _tasks(options, options.tasks, settings)
    if options.world and not options.missions:
        cure = "leave --world out, or give a mission"
        raise ConfigError([Problem("each case names its own world", "--world", suggestion=cure)])
    if options.robot:
        settings.of(campaign.BENCH)  # so that a robot that is not there is said once
    cases = _named(options)
    if options.missions:
        every: list[Case | None] = [*cases] or [None]
        campaign.check_count(len(options.missions) * len(every))
        cases = [_own(mission, case, options) for mission in options.missions for case in every]
        problems = [
            Problem(f"{case.name}: {text}")
            for case in cases
            for text in campaign.problems_of(case, settings)
        ]
        if problems:
            raise ConfigError(problems)
    cases = cases or [*campaign.load(campaign.SHIPPED, REALITY, robot=options.robot)]
    campaign.check_names(cases)
    return tuple(cases)


def _tasks(options: Eval, paths: list[Path], settings: campaign.Settings) -> tuple[Case, ...]:
    """The tasks of every exam. Raises ConfigError where they name a world or a mission as well."""
    given = {"--world": options.world, "--faults": options.faults, "missions": options.missions}
    problems = [
        Problem("tasks say themselves what is done, and where", name, suggestion="leave it out")
        for name, value in given.items()
        if value
    ]
    if problems:
        raise ConfigError(problems)
    cases: list[Case] = []
    for path in paths:
        cases += exam.load(path, settings)
        campaign.check_count(len(cases))
    campaign.check_names(cases)
    return tuple(cases)


def _moved(options: Eval) -> elsewhere.Moved:
    """The cases that are meant, in other homes. Raises ConfigError as `chosen`."""
    given = {
        "--world": options.world, "--tasks": options.tasks, "missions": options.missions,
    }  # fmt: skip
    problems = [
        Problem("in other homes the cases of campaigns are done", name, suggestion="leave it out")
        for name, value in given.items()
        if value
    ]
    if problems:
        raise ConfigError(problems)
    names = elsewhere.homes(options.homes, REALITY)
    files = [Path(word) for word in options.cases if _is_file(word)]
    only = [case.name for case in _named(options)]
    if len(files) < len(options.cases) or not files:
        files.append(campaign.SHIPPED)
    settings = campaign.Settings(REALITY, options.robot)
    return elsewhere.moved(files, names, settings, only=only)


def _named(options: Eval) -> list[Case]:
    """The cases that --faults names. Raises ConfigError with all that are not there."""
    words = options.cases
    if options.faults and not words:
        raise ConfigError([Problem("no case is named", "--faults", suggestion="a name, or a file")])
    found: list[Case] = []
    problems: list[Problem] = []
    shipped: dict[str, Case] = {}
    if any(not _is_file(word) for word in words):
        every = campaign.load(campaign.SHIPPED, REALITY, robot=options.robot)
        shipped = {case.name: case for case in every}
    for word in words:
        if _is_file(word):
            found += campaign.load(word, REALITY, robot=options.robot)
            campaign.check_count(len(found))
        elif word in shipped:
            found.append(shipped[word])
        else:
            text = f"there is no case {word!r}"
            problems.append(Problem(text, "--faults", suggestion=nearest(word, list(shipped))))
    if problems:
        raise ConfigError(problems)
    return found


def _is_file(word: str) -> bool:
    return word.endswith((".yaml", ".yml"))


def _own(mission: str, fault: Case | None, options: Eval) -> Case:
    """A mission of one's own, with the fault of a case."""
    in_file = _is_file(mission)
    name = Path(mission).stem if in_file else mission
    own = Case(name=name, mission=mission, world=options.world or ("" if in_file else WORLD))
    if fault is None:
        return own
    return msgspec.structs.replace(
        own,
        name=f"{name}, {fault.name}",
        faults=fault.faults,
        expect=fault.expect,
        helped=fault.helped,
        damped=fault.damped,
    )


def _go_through(
    results: Results, runs: list[Run], options: Eval, screen: Screen, *, ending: Ending
) -> None:
    """Do the runs that are left, keeping each record as it comes."""
    there = REALITY.under(options.reality, eyes=options.eyes)
    work = (
        pool.on_ray(runs, there, stop=lambda: ending.asked)
        if options.ray
        else pool.in_processes(
            runs,
            there,
            processes=options.processes,
            stop=lambda: ending.asked,
            keep=results.path.parent.absolute() / keeping.FOLDER,
        )
    )
    done = len(results.records)
    columns = (
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn(),
        TextColumn("{task.fields[last]}", markup=False),
    )  # fmt: skip
    with Progress(*columns, console=screen, disable=not screen.is_terminal) as bar:
        task = bar.add_task("eval", total=done + len(runs), completed=done, last="")
        for record in work:
            results.add(record)
            bar.update(task, advance=1, last=_short(record))
            if not screen.is_terminal:
                screen.print(f"{len(results.records)}/{done + len(runs)} {_short(record)}")


def _short(record: Record) -> str:
    return f"{record.key}: {'ok' if record.ok else 'WRONG'} ({record.code})"
