"""What is kept of a journal of any length: lists that let go of what people miss least.

A run may last for days, and a journal may be a stranger's: the value that is made of it has a size
that does not depend on theirs. Both functions take constant time an item, on average.
"""

from __future__ import annotations

from typing import TypeVar

T = TypeVar("T")

MOST_TEXT = 1000
"""Characters of a text in the log."""


def keep_ends(items: list[T], item: T, most: int) -> int:
    """Append to what is told as a story: beginning and end stay, the middle goes.

    Returns:
        How many went.
    """
    items.append(item)
    if len(items) <= most:
        return 0
    first, gone = most // 4, most // 2
    del items[first : first + gone]
    return gone


def keep_evenly(items: list[T], item: T, most: int) -> int:
    """Append to what is drawn as a line: every other point goes, the first and the last stay.

    Returns:
        How many went.
    """
    items.append(item)
    if len(items) <= most:
        return 0
    before = len(items)
    del items[1:-1:2]
    return before - len(items)


def clipped(text: str) -> str:
    """A text that is as long as people read."""
    return text if len(text) <= MOST_TEXT else f"{text[:MOST_TEXT]}…"
