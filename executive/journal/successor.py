"""Which run went on with one that was cut off: its folder's name, kept in the folder of the old."""

from __future__ import annotations

import contextlib
from pathlib import Path

from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import read_ordinary, write_ordinary
from robot.printable import printable_line

FILE = "gone_on_in.txt"
MAX_BYTES = 1_000


def note(folder: Path, successor: Path) -> None:
    """Say in a run's folder which one went on with it; nothing where that cannot be written."""
    with contextlib.suppress(OSError):
        write_ordinary(folder / FILE, f"{successor.name}\n".encode())


def name_of(folder: Path) -> str:
    """The folder's name of the run that went on with this one; "" where none did."""
    try:
        words = read_ordinary(folder / FILE, limit=MAX_BYTES, follow_links=False)
    except OSError:
        return ""
    return printable_line(words.decode(errors="replace").strip())


def refuse(folder: Path) -> None:
    """Refuse to go on twice: what was open would be done by two robots, one after the other.

    Raises:
        ConfigError: another run went on with this one.
    """
    if name := name_of(folder):
        text = f"{folder} was gone on with: the run {name}"
        cure = f"`humanoid resume {name}`, if that was cut off; or remove {folder / FILE}"
        raise ConfigError([Problem(text, suggestion=cure)])
