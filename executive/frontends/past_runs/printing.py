"""`humanoid why`, `history` and `replay`: what they print."""

from __future__ import annotations

import os
import re
from collections.abc import Generator, Iterable
from contextlib import contextmanager
from pathlib import Path

import msgspec
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn
from rich.table import Table
from rich.text import Text

from executive.frontends.composition_root import REALITY
from executive.frontends.long_journals import tell_of_length
from executive.frontends.output import Screen, say, table_screen, write_json
from executive.journal import failures, journal, past_runs, places
from executive.journal.journal import Event
from executive.journal.past_runs import Past
from executive.journal.places import HERE
from executive.journal.why import told as explain
from executive.runs.again import replay as again
from executive.runs.again.comparison import Difference
from robot.exit_status import ExitStatus

NARROW_COLUMNS = 72
"""A terminal in which the table would leave out how a run ended, or what it was about."""
_STYLES = {"done": "green", "failed": "red", "under way": "yellow"}


def why(run: str | None, *, as_json: bool) -> int:
    """Say why a run (by default the newest) ended as it did; returns the exit status."""
    folder = past_runs.find(run)
    tell_of_length(folder)
    told = explain(folder, live=journal.is_written(folder))
    if as_json:
        record = {"folder": str(folder), **msgspec.to_builtins(told)}
        write_json(record)
    else:
        say(told.text)
        say(f"({folder})")
    return ExitStatus.INVALID if told.status == "unreadable" else ExitStatus.DONE


def history(*, count: int, as_json: bool, everywhere: bool = False) -> int:
    """List the newest runs, the newest last; returns the exit status.

    Args:
        count: how many.
        as_json: for programs.
        everywhere: those of every folder in which something was run.
    """
    beside = places.outside(anywhere=everywhere)
    known = past_runs.runs(
        places=places.everywhere() if everywhere else places.all_places(), beside=beside
    )
    shown = [past_runs.look(folder) for folder in known[-count:]]
    if as_json:
        write_json(shown)
        return ExitStatus.DONE
    if not shown:
        say(f'There is no run in {HERE}/ yet. Begin with: humanoid do "squat" --fast')
        return ExitStatus.DONE
    screen = table_screen()
    if screen.width < NARROW_COLUMNS:
        _list(shown, located=everywhere)
    else:
        screen.print(_table(shown, located=everywhere, fills=screen.is_terminal))
    if len(known) > len(shown):
        say(f"{len(known) - len(shown)} older ones: humanoid history --all")
    return ExitStatus.DONE


def replay(run: str | None, *, as_json: bool) -> int:
    """Do a run again and compare; returns the exit status, 1 where it differs."""
    folder = past_runs.find(run)
    with following(f"replaying {folder.name}", quiet=as_json) as follow:
        result = again.replay(folder, REALITY, follow=follow)
    status = ExitStatus.FAILED if result.difference else ExitStatus.DONE
    if as_json:
        write_json({"exit_status": int(status), **msgspec.to_builtins(result)})
        return status
    if result.difference is None:
        what = "what there is of it (it was cut off)" if result.cut else "it"
        say(
            f"Identical: {what} repeats byte for byte, {result.events} events "
            f"in {result.simulated_s:.1f} s of robot time."
        )
    else:
        say("\n".join(differs(result.difference)))
    for change in result.changed:
        say(f"  note: {change}, since it was recorded")
    if result.difference is not None:
        cure = (
            "that is why it differs, most likely; replay with what it had then."
            if result.changed
            else "nothing changed that is known of: if nobody edited its journal, "
            "report it with the run folder."
        )
        say("\n".join(failures.advice(cure)))
    return status


def differs(difference: Difference) -> list[str]:
    """The first difference, with what led up to it."""
    lines = [f"Not the same: event {difference.number} is the first that differs."]
    lines += [f"    {event.t_s:9.3f} s  {_short(event)}" for event in difference.before]
    lines.append(f"  - {difference.recorded or 'nothing more was recorded'}")
    lines.append(f"  + {difference.now or 'nothing more comes now'}")
    if difference.recorded and difference.now:
        for name, (then, now) in difference.fields.items():
            lines.append(f"  {name}: recorded {then!r}, now {now!r}")
    return lines


def _short(event: Event) -> str:
    text = " ".join(f"{key}={value!r}" for key, value in event.data.items())
    return f"{event.event} {text}"[:100]


def _home_short(folder: Path) -> str:
    """A path with ~ for the home."""
    home, path = os.path.expanduser("~"), str(folder.absolute())  # noqa: PTH111 - it never raises
    return path.replace(home, "~", 1) if path.startswith(f"{home}/") else path


@contextmanager
def following(words: str, *, quiet: bool) -> Generator[again.Follow]:
    """A bar over the run's time, on standard error."""
    console = Screen(err=True, quiet=quiet)
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), TaskProgressColumn(),
               TimeRemainingColumn())  # fmt: skip
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(words, total=None)

        def follow(now_s: float, last_s: float) -> None:
            bar.update(task, completed=min(now_s, last_s), total=max(last_s, 0.001))

        yield follow


def _list(shown: Iterable[Past], *, located: bool) -> None:
    """The same as `_table`, each run in lines of its own."""
    for one in shown:
        name = _name(one)
        say(f"{name}  {_how(one)}", styled=(name, "bold"))
        say(f"  {one.took_s:.0f} s  {one.runtime}  {one.text}")
        if located:
            say(f"  {_home_short(Path(one.folder).parent)}")


def _how(one: Past) -> str:
    """How it ended, and where that is not how it went on, in which run."""
    if one.gone_on_in:
        return f"gone on in {_called(one.gone_on_in)}"
    if one.jobs and one.ending in ("done", "failed", "stopped"):
        return f"{one.jobs_done} of {one.jobs} done"
    return one.code or one.ending


def _kind(one: Past) -> str:
    """How it ended, as a whole."""
    return "" if one.ending == "done" and one.jobs_done < one.jobs else one.ending


def _name(one: Past) -> str:
    """What a run is called by: when it began, or as somebody wanted it."""
    return _called(one.folder.rpartition("/")[2].replace("\n", "\\n"))


def _called(name: str) -> str:
    stamp = re.match(r"\d{8}-\d{6}", name)
    return stamp[0] if stamp else name


def _table(shown: Iterable[Past], *, located: bool, fills: bool) -> Table:
    """The runs; `fills`: as wide as the terminal, and else no wider than what stands in it."""
    table = Table(box=None, pad_edge=False, header_style="bold", expand=fills)
    table.add_column("run", no_wrap=True, min_width=15)
    table.add_column("took", no_wrap=True, min_width=5, justify="right")
    table.add_column("", no_wrap=True, min_width=4, style="dim")
    table.add_column("how it ended", no_wrap=True, min_width=15)
    table.add_column("what", overflow="ellipsis", no_wrap=True, ratio=1)
    if located:
        table.add_column("where", overflow="fold")
    for one in shown:
        table.add_row(
            _name(one),
            f"{one.took_s:.0f} s",
            one.runtime,
            Text(_how(one), style=_STYLES.get(_kind(one), "dim")),
            one.text,
            *([_home_short(Path(one.folder).parent)] if located else []),
        )
    return table
