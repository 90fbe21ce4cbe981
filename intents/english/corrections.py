"""Taking back what was just said: "the red cup, no wait, the blue one"."""

from typing import Any, cast

import msgspec

from intents.english.lexer import COMMA
from intents.english.lexicon import phrases
from intents.english.text import Text
from intents.goals import Goal, ObjectQuery, Person

_MARKERS = phrases(
    "no wait,wait no,no,i mean,i meant,or rather,rather,scratch that,correction,make that,sorry,"
    "oh sorry,not that,no sorry,wait,oh no,oops,my mistake,i mean to say,sorry i meant,"
    "sorry i mean,no i mean,no i meant,no not that,not that one,not this one,"
    "no not that one,no not this one,wrong one,no make that,or better,better"
)


def correction_end(text: Text, at: int) -> int | None:
    """Where the marker of a correction ends, if one begins at a word."""
    end = text.phrase_end(_MARKERS, at)
    if end is None or (text.word(at) == "wait" and text.word(end) != COMMA):
        return None
    while text.word(end) == COMMA or text.phrase_end(_MARKERS, end):
        end = text.phrase_end(_MARKERS, end) or end + 1
    return end if end < len(text) else None


def substitute(
    goal: Goal, old: ObjectQuery | Person | str, new: ObjectQuery | Person | str
) -> Goal:
    """A goal with one thing in place of another, wherever it stands."""
    return cast("Goal", _replaced(goal, old, new))


def _same(value: object, old: ObjectQuery | Person | str) -> bool:
    """Whether a value speaks of the same thing; where it is may have been said only once."""
    if isinstance(value, ObjectQuery) and isinstance(old, ObjectQuery):
        return msgspec.structs.replace(value, at=None) == msgspec.structs.replace(old, at=None)
    if isinstance(value, Person) and isinstance(old, Person):
        return msgspec.structs.replace(value, at=None) == msgspec.structs.replace(old, at=None)
    return value == old


def _replaced(value: object, old: ObjectQuery | Person | str, new: object) -> object:
    if _same(value, old):
        kept = getattr(value, "at", None)
        if kept and isinstance(new, ObjectQuery | Person) and new.at is None:
            return msgspec.structs.replace(new, at=kept)
        return new
    if isinstance(value, tuple):
        return tuple(_replaced(v, old, new) for v in cast("tuple[object, ...]", value))
    if not isinstance(value, msgspec.Struct):
        return value
    changed: dict[str, Any] = {}
    for name in value.__struct_fields__:
        before = getattr(value, name)
        after = _replaced(before, old, new) if name not in ("name", "color", "what") else before
        if after is not before:
            changed[name] = after
    return msgspec.structs.replace(value, **changed) if changed else value
