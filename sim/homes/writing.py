"""Worlds and tasks as YAML that people read: an entry a line, nothing that goes without saying."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any, cast

import msgspec

from sim.homes.home import Home
from sim.homes.task import Task
from sim.world_kinds import OWN
from sim.world_schema import Object

GROUPS = ("rooms", "spots", "furniture", "objects", "people")
_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_ ./-]*")
_WORDS = {"true", "false", "null", "yes", "no", "on", "off", "y", "n"}
"""What one YAML or another takes for something else than a text."""


def world_yaml(home: Home, *, head: str) -> str:
    """The world of a home, below a line of comment."""
    world = home.world
    lines = [f"# {head}", f"name: {world.name}"]
    for group in GROUPS:
        lines.append(f"{group}:")
        lines += [f"  - {_flow(_entry(item))}" for item in getattr(world, group)]
    lines.append(f"categories: {_flow(world.categories)}")
    lines.append(f"start: {_flow(_entry(world.start))}")
    return "\n".join(lines) + "\n"


def tasks_yaml(tasks: Sequence[Task], *, world: str, head: str) -> str:
    """Tasks in a world, which is a file beside this one."""
    lines = [f"# {head}", f"world: {_flow(world)}", "tasks:"]
    for task in tasks:
        lines.append(f"  - {{kind: {task.kind}, say: {json.dumps(task.say)}, "
                     f"person_s: {task.person_s},")  # fmt: skip
        extra = f"or_code: {task.or_code}, " if task.or_code else ""
        lines.append(f"     {extra}expect: [], truth: {_flow(task.truth)}}}")
    return "\n".join(lines) + "\n"


def _entry(item: msgspec.Struct) -> dict[str, Any]:
    """What an entry says that is not the default."""
    found: dict[str, Any] = {}
    for field in msgspec.structs.fields(item):
        value = getattr(item, field.name)
        if field.required or value != field.default:
            found[field.name] = msgspec.to_builtins(value)
    if isinstance(item, Object) and item.kind:  # which says the rest
        found = {key: value for key, value in found.items() if key not in OWN}
    return found


def _flow(value: object) -> str:
    """A value in one line."""
    if isinstance(value, str):
        plain = _PLAIN.fullmatch(value) and value.casefold() not in _WORDS
        return value if plain else json.dumps(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return f"{round(value, 3) + 0.0:g}"
    if isinstance(value, Mapping):
        entries = cast("Mapping[str, object]", value)
        return "{" + ", ".join(f"{key}: {_flow(item)}" for key, item in entries.items()) + "}"
    if isinstance(value, Sequence):
        items = cast("Sequence[object]", value)
        return "[" + ", ".join(_flow(item) for item in items) + "]"
    raise TypeError(f"{type(value).__name__} is nothing of a world")
