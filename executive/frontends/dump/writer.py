"""Dumps of a run that is under way: the tree as files, every tick, at changes, failures or the end.

    dumper = attach(executive, Path("dump"), on="failure", formats=("svg", "html"))
    session.on_tick(dumper.update)   # after every tick, after the recorder
    ...
    dumper.close()

Files are named by number and time, `0003-12.40s.svg`, so that they sort in order; what is written
at the end is `end.svg`. A directory that cannot be written to never stops the robot: it is told of
once, by `problem`.
"""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime
from pathlib import Path
from typing import Literal, Self, get_args

from executive.engine.executive import Executive
from executive.frontends.output import say
from executive.journal.dumps.formats import FORMATS, Format, Wish, render
from executive.journal.journal import Event
from executive.journal.snapshot import come_to_rest
from executive.journal.why import why
from executive.runs.task_run import Progress, Show
from robot.closing import Closing
from robot.errors import ConfigError, Problem
from robot.files.config import nearest
from robot.files.ordinary_files import write_ordinary

On = Literal["tick", "change", "failure", "end"]
MOST_FILES = 20_000
"""Moments that are written at most; a tick an hour long is 72 000 of them."""

_CHANGES = frozenset({"tree", "node", "phase"})


def attach(
    executive: Executive, directory: Path, *, on: On = "end", formats: Iterable[Format] = ("html",)
) -> Dumper:
    """Begin to dump an executive; before it has begun to tick.

    Raises:
        ConfigError: if the directory cannot be made.
    """
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ConfigError(f"{directory} cannot be made: {error.strerror}") from None
    return Dumper(executive, directory, on=on, formats=tuple(formats))


class Dumper(Closing):
    """Listens to the journal and writes files; a context manager that writes the last ones.

    Attributes:
        problem: why a file could not be written, or empty.
        written: how many moments have been written.
    """

    def __init__(
        self, executive: Executive, directory: Path, *, on: On, formats: tuple[Format, ...]
    ) -> None:
        """Listen; see `attach`."""
        self.problem = ""
        self.written = 0
        self._directory = directory
        self._on: On = on
        self._formats = formats
        self._run = executive.so_far
        self._began = f"{datetime.now().astimezone():%Y-%m-%d %H:%M}"
        self._due = False
        self._closed = False
        executive.journal.listen(self._heard)

    def update(self) -> None:
        """Write a moment if it is time; after every tick."""
        due, self._due = self._due or self._on == "tick", False
        if due and self.written < MOST_FILES:
            self._write(f"{self.written:05d}-{self._run.end_s:.2f}s")
            self.written += 1

    def close(self) -> None:
        """Write the end; safe to call twice."""
        if not self._closed:
            self._closed = True
            come_to_rest(self._run)
            self._write("end")

    def _heard(self, event: Event) -> None:
        if self._closed:
            return
        if self._on == "change":
            self._due = self._due or event.event in _CHANGES
        elif self._on == "failure":
            self._due = self._due or event.event in ("failure", "abort")

    def _write(self, name: str) -> None:
        """Write a moment; whatever goes wrong, the robot goes on."""
        for kind in self._formats:
            path = self._directory / f"{name}.{FORMATS[kind][0]}"
            try:
                lines = why(self._run, live=True).lines if kind == "html" else ()
                write_ordinary(path, render(self._run, kind, Wish(why=lines, began=self._began)))
            except OSError as error:
                self.problem = f"{path} cannot be written: {error.strerror}"
            except Exception as error:  # a picture must never stop a robot
                self.problem = f"{path} cannot be drawn: {type(error).__name__}: {error}"


def parse_formats(text: str, *, also: tuple[str, ...] = ()) -> tuple[Format, ...]:
    """Formats as typed: `svg,html`; `also` are named to whoever mistypes.

    Raises:
        ConfigError: if one of them is none.
    """
    known: dict[str, Format] = {name: name for name in FORMATS}
    names = [name.strip() for name in text.split(",") if name.strip()]
    wrong = [name for name in names if name not in known]
    if wrong or not names:
        every = [*known, *also]
        name = next((one for one in wrong if one not in every), "")
        if wrong and not name:
            text, cure = f"{wrong[0]} is written by itself", f"ask for it alone: {wrong[0]}"
            raise ConfigError([Problem(text, suggestion=cure)])
        hint = nearest(name, every) or f"one of {', '.join(every)}"
        raise ConfigError([Problem(f"there is no format {name!r}", suggestion=hint)])
    return tuple(dict.fromkeys(known[name] for name in names))


def parse_on(text: str) -> On:
    """When to dump, as typed. Raises ConfigError with the nearest valid word."""
    for word in get_args(On):
        if word == text:
            return word
    hint = nearest(text, list(get_args(On))) or f"one of {', '.join(get_args(On))}"
    raise ConfigError([Problem(f"--dump-on is no {text!r}", suggestion=hint)])


class Together(Closing):
    """Shows a run to people and dumps it."""

    def __init__(self, shown: Progress, dumper: Dumper) -> None:
        """Tell both of every tick."""
        self._shown = shown
        self._dumper = dumper

    def update(self) -> None:
        """Show, then dump."""
        self._shown.update()
        self._dumper.update()

    def __enter__(self) -> Self:
        """Begin both."""
        self._shown.__enter__()
        return self

    def close(self) -> None:
        """End both; the screen comes first."""
        self._shown.close()
        self._dumper.close()
        if self._dumper.problem:
            say(f"warning: {self._dumper.problem}", err=True)


def along(show: Show, directory: Path | None, *, on: str, formats: str) -> Show:
    """`show`, with dumps into a directory beside it (None: without); options as typed.

    Raises:
        ConfigError: if an option cannot be meant.
    """
    if directory is None:
        if on != "end":
            raise ConfigError([Problem("--dump-on needs a folder", suggestion="add --dump DIR")])
        return show
    when, kinds = parse_on(on), parse_formats(formats)
    return lambda executive: Together(
        show(executive), attach(executive, directory, on=when, formats=kinds)
    )
