"""What was done at the prompt, as a mission file."""

from __future__ import annotations

from pathlib import Path

from executive.request import Setting
from robot.errors import ConfigError


def save(path: Path, sentences: list[str], where: Setting) -> Path:
    """Write a mission of sentences.

    Raises:
        ConfigError: if there is nothing to save, the file is there, or it cannot be written.
    """
    from executive.missions.write import text

    if not sentences:
        raise ConfigError("nothing was done yet that could be saved")
    path = path if path.suffix else path.with_suffix(".yaml")
    if path.exists():
        raise ConfigError(f"{path} is there already; choose another name")
    try:
        path.write_text(text(path.stem, sentences, where), encoding="utf-8")
    except OSError as error:
        raise ConfigError(f"{path} cannot be written: {error.strerror}") from None
    return path
