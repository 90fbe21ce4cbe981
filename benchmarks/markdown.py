"""Small pieces of markdown."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table; `not measured` where there are no rows."""
    if not rows:
        return "Not measured yet."
    lines = [list(head), ["---"] * len(head), *map(list, rows)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def share(outcomes: dict[str, dict[str, Any]]) -> str:
    """`15 of 16`: how many went well."""
    if not outcomes:
        return ""
    return f"{sum(bool(one['ok']) for one in outcomes.values())} of {len(outcomes)}"
