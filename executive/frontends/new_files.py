"""Files that a command writes: where nothing is yet, or at least not over what it reads."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable
from pathlib import Path

from executive.frontends.output import say
from executive.journal import journal, motion, sensed
from robot import shots
from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import make_below, write_ordinary
from robot.reality import trail


def refuse_taken(path: Path) -> None:
    """Refuse a name that something has already, before anything is made.

    Raises:
        ConfigError: so it is.
    """
    if os.path.lexists(path):
        cure = "choose another name, or remove it first"
        raise ConfigError([Problem("the file is there already", str(path), suggestion=cure)])


def refuse_inputs(outputs: Iterable[Path | None], inputs: Iterable[Path | None]) -> None:
    """Refuse to write over what is read, or twice to one place, before anything is done.

    Args:
        outputs: files that are to be written; None for those that are not wanted.
        inputs: files that are read.

    Raises:
        ConfigError: one of the outputs is an input by some name, or another output.
    """
    taken = {_place(path): "is read by this very command" for path in inputs if path is not None}
    for path in outputs:
        if path is None:
            continue
        place = _place(path)
        if place in taken:
            cure = "choose another name for what is written"
            raise ConfigError([Problem(f"the file {taken[place]}", str(path), suggestion=cure)])
        taken[place] = "is written twice"


def _place(path: Path) -> tuple[int, int] | str:
    """The same for every name of a file: links of both kinds, `..`, other letters."""
    try:
        found = path.stat()
    except OSError:
        return os.path.realpath(path)
    return found.st_dev, found.st_ino


def records_of(folder: Path) -> list[Path]:
    """What a run's folder holds that cannot be made again."""
    names = (
        journal.FILE, journal.WALL_FILE, motion.FILE, sensed.FILE, shots.COLOUR_FILE,
        shots.DEPTH_FILE, trail.FILE, "run.json", "summary.json",
    )  # fmt: skip
    return [folder / name for name in names]


def write(path: Path, data: bytes, *, run: Path) -> None:
    """Write a file, whatever is there, and the folders above it.

    Args:
        path: where to.
        data: what it is to hold.
        run: the folder of a run, which may be a stranger's: no link in it is followed.

    Raises:
        ConfigError: it cannot be written.
    """
    place = Path(os.path.abspath(path.parent))  # noqa: PTH100 - links stay
    whole = Path(os.path.abspath(run))  # noqa: PTH100
    base = whole if place.is_relative_to(whole) else place
    try:
        make_below(base, place)
        write_ordinary(path, data)
    except OSError as error:
        raise _unwritten(path, error) from None


def put(path: Path, text: str, *, word: str = "Done") -> None:
    """Write a new file, and say so in a word.

    Raises:
        ConfigError: it cannot be written.
    """
    refuse_taken(path)
    try:
        write_ordinary(path, text.encode(), anew=True)
    except OSError as error:
        raise _unwritten(path, error) from None
    say(f"{word}: {path}")


def _unwritten(path: Path, error: OSError) -> ConfigError:
    cure = "name another place, or begin where you may write"
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        cure = "make room there, or name another place"
    return ConfigError([Problem(f"{path} cannot be written: {error.strerror}", suggestion=cure)])
