"""The runs of the past: where they are, what they were about, and how they ended."""

from __future__ import annotations

import re
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path
from typing import Any, Literal

import msgspec

from executive.journal import journal, reader
from executive.journal.journal import FILE, WALL_FILE
from robot.config import nearest
from robot.errors import ConfigError, Problem
from robot.ordinary_files import read_ordinary

BASE = Path("runs")

MOST_NUMBER = 2**53
MAX_TABLE = 1_000_000
"""Bytes of a summary or a header; a mission's is 3 kB."""

Ending = Literal["done", "failed", "stopped", "under way", "cut off", "idle"]


class Past(msgspec.Struct, frozen=True, kw_only=True):
    """One run: `began` is the time of day it began at (ISO 8601), `took_s` the robot's time."""

    folder: str
    began: str
    text: str
    runtime: str
    world: str
    seed: int
    ending: Ending
    code: str
    took_s: float


def runs(base: Path = BASE) -> list[Path]:
    """Every run's folder under `base`, the oldest first."""
    found = [path.parent for path in base.glob(f"*/{FILE}")]
    return sorted(found, key=lambda folder: (_began_s(folder), folder.name))


def find(name: str | None, *, base: Path = BASE) -> Path:
    """A run by its folder, the newest by a part of the folder's name, or the newest of all.

    Raises:
        ConfigError: if there is none.
    """
    if name is not None and (Path(name) / FILE).is_file():
        return Path(name)
    known = runs(base)
    if not known:
        cure = 'begin with: humanoid do "squat for three seconds" --fast'
        raise ConfigError([Problem(f"there is no run in {base}/", suggestion=cure)])
    if name is None:
        return known[-1]
    fitting = [folder for folder in known if name in folder.name]
    if fitting:
        return fitting[-1]
    hint = nearest(name, [folder.name for folder in known])
    if hint.startswith("valid"):
        hint = f"the newest is {known[-1].name!r}; `humanoid history` shows all"
    raise ConfigError([Problem(f"there is no run {name!r}", suggestion=hint)])


def history(base: Path = BASE) -> Iterator[Past]:
    """Every run under `base`, the oldest first."""
    for folder in runs(base):
        yield look(folder)


def look(folder: Path) -> Past:
    """What is known of a run: by its summary where it has one, else by its journal."""
    header, summary = _table(folder / "run.json"), _table(folder / "summary.json")
    if summary and not journal.is_written(folder):
        code, took_s = str(summary.get("code", "")), _number(summary, "simulated_s")
        ending = _ending(code, "done" if code == "done" else "failed")
    else:
        run = reader.read(folder)
        task = run.task
        header = header or {**run.about, "text": run.text}
        code = task.reason.code if task.reason else "done" if task.state == "done" else ""
        took_s = run.end_s
        if journal.is_written(folder):
            code, ending = "", "under way"
        else:
            ending = "idle" if run.idle else _ending(code, task.state)
    began = datetime.fromtimestamp(_began_s(folder)).astimezone()
    return Past(
        folder=str(folder),
        began=began.isoformat(timespec="seconds"),
        text=str(header.get("text", "")),
        runtime=str(header.get("runtime", "")),
        world=str(header.get("world", "")),
        seed=int(_number(header, "seed")),
        ending=ending,
        code=code,
        took_s=round(took_s, 2),
    )


def _ending(code: str, state: str) -> Ending:
    if code == "cancelled":
        return "stopped"
    return "done" if state == "done" else "failed" if state == "failed" else "cut off"


def _began_s(folder: Path) -> float:
    """Time of day of the first event; of the folder itself where nothing says so."""
    try:
        with (folder / WALL_FILE).open("rb") as file:
            found = re.search(rb'"wall_s":([0-9.]{1,20})', file.readline(200))
        return float(found[1]) if found else folder.stat().st_mtime
    except (OSError, ValueError):
        return folder.stat().st_mtime


def _table(path: Path) -> dict[str, Any]:
    try:
        data = read_ordinary(path, limit=MAX_TABLE)
        return msgspec.json.decode(data, type=dict[str, Any])
    except (OSError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return {}


def _number(table: dict[str, Any], key: str) -> float:
    """A number of a table, 0 where there is none: one odd file must not hide all other runs."""
    value: object = table.get(key)
    if not isinstance(value, int | float) or not abs(value) < MOST_NUMBER:
        return 0.0
    return float(value)
