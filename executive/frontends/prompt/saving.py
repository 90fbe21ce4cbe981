"""What was done at the prompt, as a mission file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from executive.meaning.request import Setting
from robot.errors import ConfigError
from robot.files import yaml_nodes
from robot.files.ordinary_files import write_ordinary

HEAD = "# What was done at the prompt. `humanoid mission check` says whether it still fits.\n"


def save(path: Path, sentences: list[str], where: Setting) -> Path:
    """Write a mission of sentences; returns where it went.

    Raises:
        ConfigError: if there is nothing to save, the file is there, or it cannot be written.
    """
    if not sentences:
        raise ConfigError("nothing was done yet that could be saved")
    path = path if path.suffix else path.with_suffix(".yaml")
    mission = HEAD + text(path.stem, sentences, where)
    try:
        write_ordinary(path, mission.encode(), anew=True)
    except FileExistsError:
        raise ConfigError(f"{path} is there already; choose another name") from None
    except OSError as error:
        raise ConfigError(f"{path} cannot be written: {error.strerror}") from None
    return path


def text(name: str, sentences: list[str], where: Setting) -> str:
    """A mission of sentences as YAML (docs/missions.md)."""
    mission: dict[str, Any] = {
        "name": name,
        "world": where.world.name,
        "robot": where.robot_name,
        "steps": sentences,
    }
    return yaml_nodes.dump(mission)
