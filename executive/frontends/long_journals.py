"""What is said while a journal is read that takes its time."""

from __future__ import annotations

from pathlib import Path

from executive.frontends.output import say
from executive.journal import journal

LONG_BYTES = 20_000_000
"""Of which reading takes some 5 s."""


def tell_of_length(folder: Path) -> None:
    """Say that a run's journal is long, before it is read."""
    if (size := journal.size_bytes(folder)) > LONG_BYTES:
        say(f"Reading a journal of {size / 1e6:.0f} MB ...", err=True)
