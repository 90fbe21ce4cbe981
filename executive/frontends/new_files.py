"""Files that a command writes where nothing is yet; what is there already is left alone."""

from __future__ import annotations

import os
from pathlib import Path

from executive.frontends.output import say
from robot.errors import ConfigError, Problem
from robot.ordinary_files import write_ordinary


def refuse_taken(path: Path) -> None:
    """Refuse a name that something has already, before anything is made.

    Raises:
        ConfigError: so it is.
    """
    if os.path.lexists(path):
        cure = "choose another name, or remove it first"
        raise ConfigError([Problem("the file is there already", str(path), suggestion=cure)])


def put(path: Path, text: str, *, word: str = "Done") -> None:
    """Write a new file, and say so in a word.

    Raises:
        ConfigError: it cannot be written.
    """
    refuse_taken(path)
    try:
        write_ordinary(path, text.encode(), anew=True)
    except OSError as error:
        raise ConfigError(f"{path} cannot be written: {error.strerror}") from None
    say(f"{word}: {path}")
