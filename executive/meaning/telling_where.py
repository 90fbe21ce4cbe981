"""A search with nothing after it: whoever asks where a thing is, or to find it, is told where.

"Where are my glasses?" ends with "The glasses are on the piano in the living room."; on the way to
something else ("find the glasses and put them on the desk") nobody waits for that.
"""

from __future__ import annotations

from msgspec.structs import replace

from executive.meaning.handlers.seeing import LOCATION
from executive.meaning.handlers.steps import many
from intents import goals


def told_where(asked: tuple[goals.Goal, ...]) -> tuple[goals.Goal, ...]:
    """The goals, telling where a thing is in place of finding it where that is the last of them."""
    if not asked:
        return asked
    *before, last = asked
    if isinstance(last, goals.Find) and last.object is not None and not many(last.object):
        last = goals.Tell(object=last.object, property=LOCATION)
    elif isinstance(last, goals.If):
        last = replace(last, then=told_where(last.then), else_=told_where(last.else_))
    return (*before, last)
