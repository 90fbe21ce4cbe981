"""The faults that a page can let happen in simulation, as a form of them is made."""

from __future__ import annotations

from typing import Any

import msgspec

from executive.missions import fault_plans

UNSEEN = frozenset({"kill", "kill_executive", "fill_disk"})
"""Not on the page: they end processes or fill files; the line takes them."""


def forms() -> list[dict[str, Any]]:
    """Of each fault its name, a sentence, and its keys as ``[name, needed, default as text]``."""
    found: list[dict[str, Any]] = []
    for name in fault_plans.names():
        if name in UNSEEN:
            continue
        kind = fault_plans.kind(name)
        keys = [
            [one.name, one.required, "" if one.required else _text(one.default)]
            for one in msgspec.structs.fields(kind)
        ]
        help_ = (kind.__doc__ or "").split("\n", maxsplit=1)[0]
        found.append({"name": name, "help": help_, "keys": keys})
    return found


def _text(default: object) -> str:
    """A default as it is typed; nothing where it is "none" or "for ever"."""
    if default is None or default == float("inf"):
        return ""
    return default if isinstance(default, str) else msgspec.json.encode(default).decode()
