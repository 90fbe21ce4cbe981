"""Where runs lie: in `runs/` of the current folder, or at home where others could exchange that."""

from __future__ import annotations

import contextlib
import hashlib
import os
import re
from pathlib import Path

import msgspec

from robot.files.ordinary_files import read_ordinary, write_ordinary
from robot.files.user_state import user_state_folder

HERE = Path("runs")
NAMED = 40
"""Characters of the current folder's path that its place at home is called by."""


INDEX = "places.txt"
"""At home: the absolute paths of the folders in which runs were kept, a line each."""
OUTSIDE = "outside.txt"
"""At home: runs whose folder somebody named (`--run-dir`), each as a JSON list of the folder that
it was started in and its own, a line each, the newest last."""
MAX_BYTES = 1_000_000
MOST_OUTSIDE = 500


def remember(place: Path) -> None:
    """Note that runs are kept in a folder, for `everywhere`; where that cannot be, do without."""
    state = user_state_folder()
    with contextlib.suppress(OSError):  # the current folder may be gone as well
        path = os.fsencode(place.absolute())
        if state is None or b"\n" in path:
            return
        known = _index(state)
        if path in known:
            return
        state.mkdir(mode=0o700, parents=True, exist_ok=True)
        there = [one for one in known if Path(os.fsdecode(one)).is_dir()]
        lines = b"".join(one + b"\n" for one in [*there, path])
        write_ordinary(state / INDEX, lines[-MAX_BYTES:])


def remember_outside(folder: Path) -> None:
    """Note a run that lies where somebody wanted it, for `outside`; else do without."""
    state = user_state_folder()
    if state is None:
        return
    with contextlib.suppress(OSError):
        noted = (str(Path.cwd()), os.path.realpath(folder))
        known = [one for one in _outside(state) if one[1] != noted[1]]
        state.mkdir(mode=0o700, parents=True, exist_ok=True)
        lines = [msgspec.json.encode(one) for one in (*known, noted)[-MOST_OUTSIDE:]]
        write_ordinary(state / OUTSIDE, b"".join(one + b"\n" for one in lines))


def outside(*, anywhere: bool = False) -> tuple[Path, ...]:
    """Runs started in the current folder (`anywhere`: in any) that were kept where wanted."""
    state = user_state_folder()
    try:
        here = str(Path.cwd())
    except FileNotFoundError:
        return ()
    known = _outside(state) if state is not None else []
    return tuple(Path(folder) for began_in, folder in known if anywhere or began_in == here)


def _outside(state: Path) -> list[tuple[str, str]]:
    try:
        data = read_ordinary(state / OUTSIDE, limit=MAX_BYTES, follow_links=False)
    except OSError:
        return []
    found: list[tuple[str, str]] = []
    for line in data.splitlines()[-MOST_OUTSIDE:]:
        with contextlib.suppress(ValueError, RecursionError):
            found.append(msgspec.json.decode(line, type=tuple[str, str]))
    return [one for one in found if one[1].startswith("/") and "\0" not in one[1]]


def everywhere() -> tuple[Path, ...]:
    """Every folder in which this user's runs are known to be kept, the current one's first."""
    state = user_state_folder()
    if state is None:
        return all_places()
    noted = [Path(os.fsdecode(one)) for one in _index(state)]
    with contextlib.suppress(OSError):
        noted += sorted(path for path in (state / "runs").iterdir() if path.is_dir())
    real = {os.path.realpath(place): place for place in reversed((*all_places(), *noted))}
    return tuple(reversed([place for place in real.values() if place.is_dir()]))


def _index(state: Path) -> list[bytes]:
    try:
        data = read_ordinary(state / INDEX, limit=MAX_BYTES, follow_links=False)
    except OSError:
        return []
    return [line for line in data.split(b"\n") if line.startswith(b"/")]


def at_home() -> Path | None:
    """The place at home for the runs of the current folder; None without a home.

    Each folder has its own, so that `humanoid why` in one says nothing of a run in another.
    """
    state = user_state_folder()
    try:
        here = str(Path.cwd())
    except FileNotFoundError:
        return None
    words = re.sub(r"[^A-Za-z0-9]+", "-", here).strip("-")[-NAMED:].strip("-")
    digest = hashlib.sha256(os.fsencode(here)).hexdigest()[:8]
    return state / "runs" / f"{words}-{digest}" if state is not None else None


def all_places() -> tuple[Path, ...]:
    """Where runs of the current folder may lie."""
    home = at_home()
    return (HERE,) if home is None or not os.access(home, os.R_OK | os.X_OK) else (HERE, home)
