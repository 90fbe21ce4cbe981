"""How the tables of cases make their files: a sound one, with one value that is not."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from itertools import cycle
from typing import Any


@dataclass(frozen=True)
class Raw:
    """Text that stands in a file as it is."""

    text: str


DIGITS = "9" * 5001
NUMBERS = {
    "nan": Raw(".nan"),
    "inf": Raw(".inf"),
    "minus-inf": Raw("-.inf"),
    "1e300": Raw("1e+300"),
    "digits": Raw(DIGITS),
    "word": Raw("abc"),
    "list": Raw("[]"),
    "map": Raw("{}"),
    "flag": Raw("true"),
    "list-of-lists": Raw("[[[1]]]"),
}
"""What no length, mass or time is, as YAML has it."""
JSON_NUMBERS = {
    "nan": Raw("NaN"),
    "1e999": Raw("1e999"),
    "digits": Raw(DIGITS),
    "word": "abc",
    "null": None,
    "list": [],
    "map": {},
    "minus": -1,
}
"""The same in JSON."""

ESCAPE = "\x1b[2J\x1b]0;owned\x07"
"""Clears the screen and names the window."""
BIDI = "\u202egnp.exe\u2066"
NAMES = {
    "escape": ESCAPE,
    "osc-link": "\x1b]8;;http://x\x1b\\here\x1b]8;;\x1b\\",
    "c1": "\x9b31mred",
    "bidi": BIDI,
    "newline": "one\nDone.",
    "return": "one\rDone.",
    "backspace": "one\x08\x08\x08two",
    "nul": "a\x00b",
    "markup": "[link=http://x]here[/link][blink]",
    "format": "{0.__class__.__mro__} %s %n",
    "separator": "one\u2028two",
    "long": "n" * 100_000,
    "empty": "",
    "blank": "   ",
    "dots": "../../etc",
}
"""Names that nobody gives a thing."""


def flow(value: Any) -> str:
    """A value as JSON, which is YAML too, but for what is raw."""
    if isinstance(value, Raw):
        return value.text
    with suppress(TypeError):  # something raw in it; without, a library is 50 times as fast
        return json.dumps(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)}: {flow(v)}" for k, v in value.items()) + "}"
    return "[" + ", ".join(map(flow, value)) + "]"


def document(value: dict[str, Any]) -> str:
    """A file of YAML, a key a line."""
    return "".join(f"{key}: {flow(content)}\n" for key, content in value.items())


def changed(value: Any, path: str, new: Any) -> Any:
    """A copy in which what stands at a path, as `objects.0.mass_kg`, is another."""
    key, dot, rest = path.partition(".")
    inner = copy.copy(value)  # only along the path: the rest is shared, and nobody changes it
    place = int(key) if key.isdigit() else key
    inner[place] = changed(value[place], rest, new) if dot else new
    return inner


def field_of(path: str) -> str:
    """The name of the field that a path leads to."""
    return next(key for key in reversed(path.split(".")) if not key.isdigit())


def in_turn(paths: list[str], values: dict[str, Any], each: int) -> Iterator[tuple[str, str, Any]]:
    """Some of the values for each path, so that every value has its turn: (path, name, value)."""
    turns = cycle(values.items())
    for path in paths:
        for _ in range(each):
            yield (path, *next(turns))
