"""Worlds by name or file: shipped ones (sim/worlds), or anybody's YAML (docs/worlds.md)."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from robot.errors import ConfigError, Problem
from robot.files import config
from sim import world_reading
from sim.world_schema import Room, World


def available() -> list[str]:
    """Names of the shipped worlds."""
    return sorted(path.name.removesuffix(".yaml") for path in _folder().glob("*.yaml"))


def load(name_or_path: str) -> World:
    """Read a world: a shipped one by name, or any by the path of its YAML file.

    Raises:
        ConfigError: with everything that is wrong, by file and line, and the nearest valid name.
    """
    if config.names_file(name_or_path):
        return world_reading.read(Path(name_or_path))
    if name_or_path not in available():
        hint = f"{config.nearest(name_or_path, available())}; a home from a seed: flat:7"
        raise ConfigError([Problem(f"unknown world {name_or_path!r}", suggestion=hint)])
    return world_reading.read(_folder() / f"{name_or_path}.yaml")


def empty() -> World:
    """A bare floor of 20 by 20 m, the robot in its middle."""
    return World(name="empty", rooms=(Room(id="hall", at_m=(0.0, 0.0), size_m=(20.0, 20.0)),))


def _folder() -> Path:
    return Path(str(resources.files("sim"))) / "worlds"
