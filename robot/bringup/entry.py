"""Parts that are named by a string, so that the robot never imports its stand-in for reality."""

from __future__ import annotations

import importlib
from typing import Any, cast

from robot.errors import ConfigError
from robot.messages import WorldMap

WORLD_LOADER = "sim.world:load"
WORLD_MAP = "sim.world:world_map"
WORLD_VARIATION = "sim.world:variation"


def attribute(spec: str) -> Any:
    """What `package.module:name` names.

    Raises:
        ConfigError: if there is no such module or name.
    """
    module, _, name = spec.partition(":")
    try:
        return getattr(importlib.import_module(module), name)
    except (ImportError, AttributeError) as error:
        raise ConfigError(f"cannot load {spec!r}: {error}") from error


def world(name_or_path: str, *, variation_seed: int | None = None) -> Any:
    """A world by name or path, with its start and objects shuffled if a seed is given.

    Raises:
        ConfigError: with everything that is wrong in the file.
    """
    loaded = attribute(WORLD_LOADER)(name_or_path)
    if variation_seed is None:
        return loaded
    return attribute(WORLD_VARIATION)(loaded, variation_seed)


def world_map(name_or_path: str) -> WorldMap:
    """The prior map of a world by name or path. Raises ConfigError as `world` does."""
    return cast(WorldMap, attribute(WORLD_MAP)(world(name_or_path)))
