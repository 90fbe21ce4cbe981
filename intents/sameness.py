"""Whether goals are those that were meant, however they are put.

Handing somebody a thing is bringing it, bringing it somewhere is putting it there, and what is
picked up and then put somewhere is only put there.
"""

import re
from typing import Any, cast

Plain = dict[str, Any]
_NEAR = 0.03
"""Numbers that differ by less are the same [m], [rad], [s]."""
_SAME_SIZE = {"large": "big", "little": "small"}
_ME = {"who": "operator"}


def same(one: list[Plain], other: list[Plain]) -> bool:
    """Whether two lists of goals, as JSON, ask for the same."""
    return _alike(_normal(one), _normal(other))


def _alike(one: Any, other: Any) -> bool:
    if isinstance(one, dict) and isinstance(other, dict):
        pairs = cast("dict[str, Any]", one), cast("dict[str, Any]", other)
        return pairs[0].keys() == pairs[1].keys() and all(
            _alike(value, pairs[1][key]) for key, value in pairs[0].items()
        )
    if isinstance(one, list) and isinstance(other, list):
        these, those = cast("list[Any]", one), cast("list[Any]", other)
        return len(these) == len(those) and all(map(_alike, these, those))
    if isinstance(one, int | float) and isinstance(other, int | float):
        return abs(one - other) <= _NEAR
    return one == other


def _normal(goals: list[Plain]) -> list[Plain]:
    found: list[Plain] = []
    for goal in _flat(goals):
        plain = _goal(goal, found)
        if found and _goes_on(found[-1], plain):
            before = found.pop()
            plain["object"] = _value({**_whole(before["object"]), **_whole(plain["object"])})
        elif found and _leads_to(found[-1], plain):
            found.pop()
        found.append(plain)
    return found


def _flat(goals: list[Plain]) -> list[Plain]:
    """With what is done for each of several things as done with all of them."""
    found: list[Plain] = []
    for goal in goals:
        inner: list[Plain] = goal.get("goals", [])
        handled = [one for one in inner if one.get("object") == {"held": True}]
        if goal["goal"] == "for_each" and inner and handled == inner:
            found += [{**one, "object": goal["object"] if n == 0 else {"held": True}}
                      for n, one in enumerate(inner)]  # fmt: skip
        else:
            found.append(goal)
    return found


def _goal(goal: Plain, before: list[Plain]) -> Plain:
    kind: str = goal["goal"]
    plain = {key: _value(value) for key, value in goal.items() if value not in (None, [])}
    for key in ("on", "in", "place", "person", "at"):
        if key in plain and key in _SLOTS.get(kind, ()):
            plain["to"] = plain.pop(key)
    if kind == "tell" and "person" in plain:
        plain["of"] = plain.pop("person")
    if kind in ("bring", "give"):
        to = plain.setdefault("to", "operator")
        somewhere = isinstance(goal.get("to"), str) and to != "operator"
        plain["goal"] = "place" if somewhere else "bring"
    if kind in ("say", "tell", "count", "answer") and plain.get("to") == "operator":
        del plain["to"]
    if kind == "say":
        plain["what"] = sorted(set(re.findall(r"\w+", str(goal["what"]).lower().replace("'", ""))))
    thing = plain.get("object")
    if isinstance(thing, dict) and set(cast("Plain", thing)) <= {"held", "at"}:
        last = next((one["object"] for one in reversed(before) if "object" in one), None)
        plain["object"] = last if last is not None else thing
    for key in ("goals", "then", "else"):
        if key in goal:
            plain[key] = _normal(goal[key])
    if kind == "if":
        plain["then"] = _where_seen(plain["then"], plain["condition"])
    return plain


def _where_seen(value: Any, condition: Plain) -> Any:
    """What is done in a case, without where the thing or person was seen that makes it the case."""
    if isinstance(value, list):
        return [_where_seen(one, condition) for one in cast("list[Any]", value)]
    if not isinstance(value, dict):
        return value
    known = cast("Plain", value)
    seen = [condition.get(kind) for kind in ("object", "person")]
    if "at" in known and "goal" not in known and known in seen:
        return _value({key: one for key, one in known.items() if key != "at"})
    return {key: _where_seen(one, condition) for key, one in known.items()}


_SLOTS = {
    "place": ("on", "in"), "go_to": ("place",), "gesture": ("at",), "greet": ("person",),
}  # fmt: skip


def _value(value: Any) -> Any:
    if isinstance(value, str):
        return _SAME_SIZE.get(value.lower(), value.lower())
    if isinstance(value, list):
        return [_value(one) for one in cast("list[Any]", value)]
    if not isinstance(value, dict):
        return value
    known = cast("Plain", value)
    if known == _ME:
        return "operator"
    told = {key: _value(one) for key, one in known.items() if one is not None}
    if told.get("count") in (1, "all"):
        del told["count"]
    if "category" in told:
        told.setdefault("name", told.pop("category"))
    return told["name"] if set(told) == {"name"} else told


def _goes_on(before: Plain, goal: Plain) -> bool:
    """Whether a thing is only picked up, or looked for, to be put or brought somewhere."""
    first, then = before.get("object"), goal.get("object")
    takes = before["goal"] in ("pick", "find") and goal["goal"] in ("bring", "place", "pick")
    return takes and first is not None and _head(first) == _head(then)


def _whole(thing: Any) -> Plain:
    return cast("Plain", thing) if isinstance(thing, dict) else {"name": thing}


def _head(thing: Any) -> Any:
    return _whole(thing).get("name")


def _leads_to(before: Plain, goal: Plain) -> bool:
    """Whether one goes somewhere only for what is there to be done; that is then told of it."""
    if before["goal"] != "go_to" or before.keys() != {"goal", "to"}:
        return False
    place, thing = before["to"], goal.get("object")
    if goal.get("to") == place:
        return True
    known = _whole(thing) if goal["goal"] in ("pick", "bring", "find", "count") else {"at": None}
    if thing is None or known.get("at", place) != place:
        return False
    goal["object"] = {**known, "at": place}
    return True
