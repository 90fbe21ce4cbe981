"""What `humanoid dump` does, from its options to an exit status."""

from __future__ import annotations

import sys
import webbrowser
from collections.abc import Callable
from pathlib import Path

import msgspec

from executive.frontends.dump.writer import parse_formats
from executive.frontends.long_journals import tell_of_length
from executive.frontends.new_files import records_of, refuse_inputs, write
from executive.frontends.output import say, write_data
from executive.journal import journal, past_runs, reader
from executive.journal.dumps.formats import FORMATS, Wish, render
from executive.journal.dumps.text import Style
from executive.journal.journal import FILE
from executive.journal.run import Run
from executive.journal.snapshot import come_to_rest
from executive.journal.why import why
from robot.errors import ConfigError, Problem

EXPORTS = ("mcap", "csv", "parquet")
"""Formats for other programs: `executive.frontends.dump.export`."""
TO_TERMINAL = frozenset({"text", "dot", "json"})
"""Formats that go to standard output where no file is named."""


class Asked(msgspec.Struct, frozen=True, kw_only=True):
    """The options of `humanoid dump`."""

    run: str | None = None
    kind: str = "html"
    t_s: float | None = None
    output: Path | None = None
    ascii_only: bool | None = None
    everything: bool = False
    opened: bool = False


def dump(asked: Asked, *, browse: Callable[[str], object] = webbrowser.open) -> int:
    """Write a dump; returns the exit status.

    Raises:
        ConfigError: if the run, the format or the time makes no sense, or nothing can be written.
    """
    if asked.kind in EXPORTS:
        return _export(asked)
    (kind, *more) = parse_formats(asked.kind, also=EXPORTS)
    if more:
        raise ConfigError("one format at a time")
    folder = past_runs.find(asked.run)
    run = load(folder)
    _check_time(run, asked.t_s)
    wish = Wish(
        t_s=asked.t_s,
        style=_style(asked),
        everything=asked.everything,
        began=past_runs.began(folder) if kind == "html" else "",
        why=why(run, live=journal.is_written(folder)).lines if kind == "html" else (),
    )
    data = render(run, kind, wish)
    if not run.nodes:
        say("no tree is in this journal (yet): only events can be shown", err=True)
    if run.left_out:
        text = f"a very long run: {run.left_out} details are left out, mostly of its middle"
        say(text, err=True)
    if run.unreadable:
        first, count = f"line {run.unreadable_line}", run.unreadable
        lines = f"{count} lines of the journal, the first of them {first}, make no sense and were"
        line = f"{first} of the journal makes no sense and was"
        say(f"{lines if count > 1 else line} left out", err=True)
    if str(asked.output) == "-" or (asked.output is None and kind in TO_TERMINAL):
        if kind == "png" and sys.stdout.isatty():
            raise ConfigError([Problem("a terminal shows no picture", suggestion="name a file")])
        write_data(data)
        return 0
    path = asked.output or folder / f"dump.{FORMATS[kind][0]}"
    refuse_inputs([path], records_of(folder))
    write(path, data, run=folder)
    say(f"Done: {path}")
    if asked.opened:
        browse(path.resolve().as_uri())
    return 0


def _export(asked: Asked) -> int:
    from executive.frontends.dump.export import export  # what simulates is loaded only for it

    if asked.t_s is not None or str(asked.output) == "-" or asked.opened:
        text = f"--format {asked.kind} writes a whole run into files"
        cure = "leave --at and --open out, and name a file or a folder"
        raise ConfigError([Problem(text, suggestion=cure)])
    folder = past_runs.find(asked.run)
    return export(load(folder), folder, asked.kind, asked.output)


def load(folder: Path) -> Run:
    """The run in a folder.

    Raises:
        ConfigError: if its journal cannot be read, or there is nothing in it.
    """
    tell_of_length(folder)
    run = reader.read(folder)
    if not run.events:
        text = f"{folder / FILE} has no event"
        raise ConfigError([Problem(text, suggestion="choose another run")])
    come_to_rest(run)
    return run


def _check_time(run: Run, t_s: float | None) -> None:
    if t_s is not None and not run.begin_s <= t_s <= run.end_s:
        text = f"--at {t_s:g}: the run goes from {run.begin_s:.2f} to {run.end_s:.2f} s"
        raise ConfigError([Problem(text, suggestion="choose a time in between")])


def _style(asked: Asked) -> Style:
    """Colour where it is looked at, ascii where nothing else can be shown."""
    if asked.ascii_only:
        return "ascii"
    if asked.ascii_only is None and asked.output is None and sys.stdout.isatty():
        return "colour" if "utf" in (sys.stdout.encoding or "").lower() else "ascii"
    return "unicode"
