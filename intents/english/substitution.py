"""One thing in place of another, wherever a goal speaks of it."""

from typing import Any, cast

import msgspec

from intents.goals import Bring, ForEach, Give, Goal, ObjectQuery, Person, Place


def substitute(
    goal: Goal, old: ObjectQuery | Person | str, new: ObjectQuery | Person | str
) -> Goal:
    """A goal with one thing in place of another, wherever it stands."""
    return cast("Goal", _replaced(goal, old, new))


def redirected(goal: Goal, to: Person | str) -> Goal:
    """A goal that takes something to somebody or somewhere else; others as they are."""
    match goal:
        case ForEach(goals=inner):
            return msgspec.structs.replace(goal, goals=tuple(redirected(g, to) for g in inner))
        case Bring():
            return msgspec.structs.replace(goal, to=to)
        case Give() if isinstance(to, Person):
            return msgspec.structs.replace(goal, to=to)
        case Give() | Place(part=None, relation=None):
            if isinstance(to, Person):
                return Bring(object=goal.object, to=to)
            return Place(object=goal.object, on=to)
        case _:
            return goal


def goes_to_somebody(goal: Goal) -> bool:
    """Whether a goal takes something to a person."""
    if isinstance(goal, ForEach):
        return any(map(goes_to_somebody, goal.goals))
    return isinstance(goal, Give) or (isinstance(goal, Bring) and isinstance(goal.to, Person))


def _same(value: object, old: ObjectQuery | Person | str) -> bool:
    """Whether a value speaks of the same thing; where it is may have been said only once."""
    if isinstance(value, ObjectQuery) and isinstance(old, ObjectQuery):
        return msgspec.structs.replace(value, at=None) == msgspec.structs.replace(old, at=None)
    if isinstance(value, Person) and isinstance(old, Person):
        return msgspec.structs.replace(value, at=None) == msgspec.structs.replace(old, at=None)
    return value == old


def _is_all_of(goal: ForEach, old: ObjectQuery | Person | str) -> bool:
    """Whether a goal is for all of some things that are spoken of: "the cups"; *they* are there."""
    return isinstance(old, ObjectQuery) and _same(
        goal.object, msgspec.structs.replace(old, count=None)
    )


def _replaced(value: object, old: ObjectQuery | Person | str, new: object) -> object:
    if isinstance(value, ForEach) and isinstance(new, ObjectQuery) and _is_all_of(value, old):
        where = new.at or value.object.at
        return msgspec.structs.replace(
            value, object=msgspec.structs.replace(new, count=None, at=where)
        )
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
