"""Under which heading `humanoid --help` shows a command, and in which order."""

from __future__ import annotations

from typing import Any

import typer
from typer.core import TyperGroup

PANELS = {
    "Tell a robot what to do": ("do", "repl", "listen", "mission", "walk"),
    "A robot that stays up": (
        "up", "say", "status", "queue", "stop", "estop", "pause", "resume", "attach", "logs",
        "down", "remote",
    ),
    "See what it does, and what it did": (
        "view", "console", "why", "history", "dump", "record", "film", "replay", "runs", "eval",
    ),
    "Sentences, worlds, robots": ("parse", "worlds", "model"),
    "Recordings of real sensors": ("map", "sensors", "people", "detect", "calibrate"),
    "Motors, real and emulated": ("motors",),
    "This installation": ("doctor", "config"),
}  # fmt: skip
_ORDER = [name for names in PANELS.values() for name in names]


class Ordered(TyperGroup):
    """Commands in the order of `PANELS`."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Their names, as help and completion show them."""
        return sorted(super().list_commands(ctx), key=_ORDER.index)


def put_into_panels(app: typer.Typer) -> None:
    """Give every command of an application its heading."""
    panel_of = {name: panel for panel, names in PANELS.items() for name in names}
    for one in app.registered_commands:
        name = one.name or getattr(one.callback, "__name__", "")
        one.rich_help_panel = panel_of[name]
    for group in app.registered_groups:
        group.rich_help_panel = panel_of[str(group.name)]
