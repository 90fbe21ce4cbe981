"""What is wrong with goals that a language model wrote, for the model and for people alike."""

from __future__ import annotations

import re
from collections.abc import Callable

import msgspec

_PLACE = re.compile(r" - at `(?:key in )?\$(?P<path>[^`]*)`$")
_TYPES = {
    "str": "a text", "int": "a number", "float": "a number", "bool": "true or false",
    "object": "an object", "array": "a list", "null": "nothing",
}  # fmt: skip
"""How msgspec calls the types of JSON."""
_PATTERNS: tuple[tuple[re.Pattern[str], Callable[[re.Match[str]], str]], ...] = (
    (re.compile(r"Object missing required field `(\w+)`"), lambda m: f"{m[1]!r} is missing"),
    (re.compile(r"Object contains unknown field `(.{1,60})`"), lambda m: f"{m[1]!r} is no slot"),
    (re.compile(r"Invalid (?:enum )?value '?(.{1,60}?)'?"), lambda m: f"{m[1]!r} is not known"),
    (
        re.compile(r"Expected `([^`]+)`, got `([^`]+)`"),
        lambda m: f"{_type(m[2])} where {_type(m[1])} should be",
    ),
    (re.compile(r"Expected `\w+` (.+)"), lambda m: f"it should be {m[1]}"),
)


def in_words(error: Exception) -> str:
    """A misfit with the goal and the slot that it is in: "goal 2, times: it should be >= 1"."""
    text = str(error)
    place = _PLACE.search(text)
    said = text[: place.start()] if place else text
    for pattern, told in _PATTERNS:
        if found := pattern.fullmatch(said):
            where = _where(place["path"]) if place else ""
            return f"{where}: {told(found)}" if where else told(found)
    return said if isinstance(error, msgspec.ValidationError) and not place else "no list of goals"


def _where(path: str) -> str:
    """`[1].object.name` as "goal 2, object.name"."""
    found = re.match(r"\[(\d+)\]\.?(.*)", path)
    if found is None:
        return ""
    goal = f"goal {int(found[1]) + 1}"
    return f"{goal}, {found[2]}" if found[2] else goal


def _type(name: str) -> str:
    return " or ".join(dict.fromkeys(_TYPES.get(one, one) for one in name.split(" | ")))
