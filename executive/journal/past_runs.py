"""The runs of the past: where they are, what they were about, and how they ended."""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path
from typing import Any, Literal, TypeVar

import msgspec

from executive.journal import journal, reader, successor
from executive.journal.journal import FILE, WALL_FILE
from executive.journal.places import HERE, all_places, outside
from executive.journal.run import Run
from robot.errors import ConfigError, Problem
from robot.files import misfits
from robot.files import quantities as q
from robot.files.config import nearest
from robot.files.ordinary_files import open_ordinary, read_ordinary
from robot.printable import printable_line

T = TypeVar("T")

Ending = Literal["done", "failed", "stopped", "under way", "cut off", "idle"]

MAX_BYTES = 1_000_000
"""Of a summary or a header; a mission's has 3 kB."""
MOST_OF_A_LINE = 1_000
MOST_NAMED = 5
"""Runs that a name may mean, in an error."""
LAST_S = 2.5e11
"""The year 9892: what is later is no time of day that can be shown."""


class About(msgspec.Struct, frozen=True):
    """What is shown of `run.json`."""

    text: str = ""
    runtime: str = ""
    world: str = ""
    seed: int = 0


class End(msgspec.Struct, frozen=True):
    """What is shown of `summary.json`."""

    code: str
    simulated_s: q.Moment = 0.0


class Past(msgspec.Struct, frozen=True, kw_only=True):
    """One run.

    Attributes:
        began: the time of day it began at (ISO 8601).
        took_s: the robot's time.
        gone_on_in: the run that went on with it after it was cut off, by the name of its folder.
        jobs, jobs_done: how many it had, and how many of them are done; 0 where it had no more than
            one.
    """

    folder: str
    began: str
    text: str
    runtime: str
    world: str
    seed: int
    ending: Ending
    code: str
    took_s: float
    gone_on_in: str = ""
    jobs: int = 0
    jobs_done: int = 0


def runs(
    base: Path | None = None, *, places: tuple[Path, ...] = (), beside: tuple[Path, ...] = ()
) -> list[Path]:
    """Every run's folder under `base` or `places`, and `beside`, the oldest first.

    With none of them, those of this folder, kept elsewhere by name (`--run-dir`) or not.
    """
    if base is None and not places:
        places, beside = all_places(), outside()
    found = [path.parent for place in places or (base or HERE,) for path in place.glob(f"*/{FILE}")]
    known = {os.path.realpath(folder) for folder in found}
    for folder in beside:
        with contextlib.suppress(OSError):
            if os.path.realpath(folder) not in known and (folder / FILE).is_file():
                found.append(folder)
    return sorted(found, key=lambda folder: (began_s(folder), folder.name))


def find(name: str | None, *, base: Path | None = None) -> Path:
    """A run by its folder, the newest by a part of the folder's name, or the newest of all.

    Raises:
        ConfigError: if there is none.
    """
    return named(name, base=base)[-1]


def find_cut_off(name: str | None, *, base: Path | None = None) -> Path:
    """A run to go on with: of several with that part in their names the only one that was cut off.

    Where none of them was, the newest; without a name, the newest of all.

    Raises:
        ConfigError: there is none, or several of them were cut off: with their names.
    """
    fitting = named(name, base=base)
    if name is None or len(fitting) == 1:
        return fitting[-1]
    several = [past for past in map(look, fitting) if past.ending == "cut off"]
    open_ = [past for past in several if not past.gone_on_in]
    if len(open_) < 2:
        return Path(open_[0].folder) if open_ else fitting[-1]
    words = [f"{Path(past.folder).name} ({past.text})" for past in reversed(open_)]
    left_out = f", and {len(words) - MOST_NAMED} more" if len(words) > MOST_NAMED else ""
    cure = f"name one: {', '.join(words[:MOST_NAMED])}{left_out}"
    raise ConfigError(
        [Problem(f"{len(words)} runs that were cut off have {name!r} in their names",
                 suggestion=printable_line(cure))]
    )  # fmt: skip


def named(name: str | None, *, base: Path | None = None) -> list[Path]:
    """The runs that a name may mean, the newest last; a folder or a whole name means one.

    Raises:
        ConfigError: if there is none.
    """
    if name is not None and (Path(name) / FILE).is_file():
        return [Path(name)]
    known = runs(base)
    _check_journal(name, known)
    if not known:
        cure = 'begin with: humanoid do "squat for three seconds" --fast'
        raise ConfigError([Problem(f"there is no run in {base or HERE}/", suggestion=cure)])
    if name is None:
        return known
    fitting = [folder for folder in known if name and name in folder.name]
    if exact := [folder for folder in fitting if folder.name == name]:
        return exact[-1:]
    if fitting:
        return fitting
    hint = nearest(name, [folder.name for folder in known])
    if hint.startswith("valid"):
        hint = f"the newest is {known[-1].name!r}; `humanoid history` shows all"
    raise ConfigError([Problem(f"there is no run {name!r}", suggestion=hint)])


def _check_journal(name: str | None, known: list[Path]) -> None:
    """Raise ConfigError if only a folder is of that name, from which the journal is gone."""
    there = name is not None and name.strip("./") and Path(name).is_dir()
    if name and there and not any(name in folder.name for folder in known):
        cure = "put it back, or take another run: `humanoid history` shows all"
        raise ConfigError([Problem(f"the folder {name!r} holds no {FILE}", suggestion=cure)])


def history(base: Path | None = None) -> Iterator[Past]:
    """Every run under `base`, the oldest first."""
    for folder in runs(base):
        yield look(folder)


def look(folder: Path) -> Past:
    """What is known of a run: by its summary where it has one, else by its journal."""
    header, summary = _table(folder / "run.json", About), _table(folder / "summary.json", End)
    jobs = jobs_done = 0
    if summary is not None and not journal.is_written(folder):
        code, took_s = summary.code, summary.simulated_s
        ending = _ending(code, "done" if code == "done" else "failed")
    else:
        run = _read(folder)
        task = run.task
        header = header or _sane({**run.about, "text": run.text}, About)
        code = task.reason.code if task.reason else "done" if task.state == "done" else ""
        took_s = run.end_s
        if run.of_jobs[1] > 1:
            jobs_done, jobs = run.of_jobs
        if journal.is_written(folder):
            code, ending = "", "under way"
        else:
            ending = "idle" if run.idle else _ending(code, task.state)
    header = header or About()
    return Past(
        folder=str(folder),
        began=_began(folder).isoformat(timespec="seconds"),
        text=printable_line(header.text),
        runtime=printable_line(header.runtime),
        world=printable_line(header.world),
        seed=header.seed,
        ending=ending,
        code=code,
        took_s=round(took_s, 2),
        gone_on_in=successor.name_of(folder) if ending == "cut off" else "",
        jobs=jobs,
        jobs_done=jobs_done,
    )


def began(folder: Path) -> str:
    """The date and the time of day at which a run began, as people read it."""
    return f"{_began(folder):%Y-%m-%d %H:%M}"


def _began(folder: Path) -> datetime:
    return datetime.fromtimestamp(began_s(folder)).astimezone()


def _ending(code: str, state: str) -> Ending:
    if code == "cancelled":
        return "stopped"
    return "done" if state == "done" else "failed" if state == "failed" else "cut off"


def _read(folder: Path) -> Run:
    """What the journal says; nothing where it cannot be read, which must not hide the others.

    Nor where that would keep people waiting: `why` reads it.
    """
    if journal.size_bytes(folder) > journal.MAX_BYTES:
        return Run()
    try:
        return reader.read(folder)
    except ConfigError:
        return Run()


def began_s(folder: Path) -> float:
    """Time of day of the first event; of the folder itself where nothing says so."""
    found = None
    with contextlib.suppress(OSError), open_ordinary(folder / WALL_FILE) as file:
        found = re.search(rb'"wall_s":([0-9]{1,12}(\.[0-9]{1,6})?)', file.readline(MOST_OF_A_LINE))
    try:
        wall_s = float(found[1]) if found else folder.stat().st_mtime
    except OSError:  # it was removed just now
        return 0.0
    return min(max(wall_s, 0.0), LAST_S)


def _table(path: Path, kind: type[T]) -> T | None:
    """What a file of a run says; None where there is none, or it says nothing of the kind."""
    try:
        data = msgspec.json.decode(read_ordinary(path, limit=MAX_BYTES), type=dict[str, Any])
    except (OSError, ValueError, RecursionError):  # msgspec's errors are ValueErrors
        return None
    return _sane(data, kind)


def _sane(data: dict[str, Any], kind: type[T]) -> T | None:
    """A table without what is odd in it, which must not hide the rest."""
    odd = {one.path[0] for one in misfits.misfits(data, kind) if one.path}
    with contextlib.suppress(msgspec.ValidationError):
        return msgspec.convert({key: data[key] for key in data if key not in odd}, kind)
    return None
