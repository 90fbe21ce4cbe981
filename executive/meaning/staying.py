"""Waiting without an end: whoever has nothing left to do waits where they are.

"Go to the door and wait" ends with the robot standing at the door. Before something else it is not
known for how long, and asked.
"""

from __future__ import annotations

from msgspec.structs import replace

from intents import goals


def with_an_end(asked: tuple[goals.Goal, ...]) -> tuple[goals.Goal, ...]:
    """The goals, coming to a stand in place of a wait without how long that is the last of them."""
    if not asked:
        return asked
    *before, last = asked
    if isinstance(last, goals.Wait) and last.duration_s is None:
        last = goals.Stop()
    elif isinstance(last, goals.If):
        last = replace(last, then=with_an_end(last.then), else_=with_an_end(last.else_))
    return (*before, last)
