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
PANEL_OF = {name: panel for panel, names in PANELS.items() for name in names}
"""By the name of a command; those that have none are hidden."""
_ORDER = list(PANEL_OF)


class Ordered(TyperGroup):
    """Commands in the order of `PANELS`."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Their names, as help and completion show them."""
        return sorted(super().list_commands(ctx), key=_ORDER.index)


def put_into_panels(app: typer.Typer) -> None:
    """Give every command of an application its heading."""
    for one in app.registered_commands:
        name = one.name or getattr(one.callback, "__name__", "")
        one.rich_help_panel = PANEL_OF[name]
    for group in app.registered_groups:
        group.rich_help_panel = PANEL_OF[str(group.name)]
