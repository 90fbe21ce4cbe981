"""Steps as plain data, as an import writes them: named, given options, put into one another."""

from __future__ import annotations

import re
from itertools import accumulate
from typing import Any, TypeAlias, cast

import msgspec

from executive.missions.btcpp.xml import Element
from robot.files import plain_data
from robot.files.yaml_nodes import resolve

Step: TypeAlias = Any
Ports: TypeAlias = dict[str, str]
JSON = "json:"
"""Before a condition that is no sentence; a brace alone would be a blackboard entry."""
NOTHING: dict[str, Any] = {"do": []}
OPTIONS = ("retry", "timeout_s", "on_fail", "always")
MAX_NESTING = 50
"""Of a condition in JSON; the reader of missions takes 60 levels."""
_NESTING = {"[": 1, "{": 1, "]": -1, "}": -1}


def whole(element: Element, attributes: Ports, key: str, *, most: int = 10**9) -> int:
    """The whole number in a port, from 1. Raises ConfigError."""
    text = attributes.get(key, "").strip()
    if not re.fullmatch(r"-?[0-9]{1,9}", text):
        shown = f"is {text[:40]!r}" if key in attributes else "is missing"
        cure = f'{key}="{_in_milliseconds(text)}"' if key.endswith("msec") else "1 or more"
        raise element.wrong(f"{element.tag}: {key} {shown}, and must be a whole number", cure)
    if int(text) <= 0:
        message = f"{element.tag} with {key}={text!r} has no equivalent"
        raise element.wrong(message, "a whole number from 1: nothing here is without an end")
    if int(text) > most:
        raise element.wrong(f"{element.tag} with {key}={text!r}: at most {most} are possible")
    return int(text)


def _in_milliseconds(text: str) -> int:
    """What was most likely meant by a time with its unit: 5000 by "5s"."""
    found = re.fullmatch(r"(\d{1,6}(?:\.\d{1,6})?) ?(ms|s|min)?", text)
    factor = {"ms": 1, "s": 1000, "min": 60_000, None: 1}
    return max(1, round(float(found[1]) * factor[found[2]])) if found else 5000


def number_in(element: Element, port: str, text: str) -> float:
    """The number in a port. Raises ConfigError."""
    found = resolve(text.strip()) if text.strip() else None
    if isinstance(found, bool) or not isinstance(found, int | float):
        raise element.wrong(f"{port}: {text[:40]!r} where a number should be")
    return float(found)


def named(step: dict[str, Any], attributes: Ports) -> Step:
    """A step with the name of its element; what does nothing has none."""
    if step == NOTHING:
        return step
    return {**step, "name": attributes["name"]} if "name" in attributes else step


def flat(step: Step) -> list[Step]:
    """A step as a list of steps."""
    inside = fields(step)
    return inside["do"] if set(inside) == {"do"} else [step]


def fields(step: Step) -> dict[str, Any]:
    """The keys of a step that is a mapping."""
    return cast("dict[str, Any]", step) if isinstance(step, dict) else {}


def with_option(step: Step, option: str, value: Any) -> Step:
    """A step with one more option; options have their order, so it may have to be wrapped.

    What does nothing neither fails nor takes time.
    """
    if step == NOTHING and option != "always":
        return step
    order = OPTIONS.index(option)
    inside = fields(step)
    plain = inside and not any(key in inside for key in OPTIONS[order:])
    inner = inside if plain else {"do": [step]}
    return {**inner, option: value}


def one_of(steps: list[Step]) -> Step:
    """The first of some steps that succeeds.

    Halves are put into one another, as it does not matter where one splits them: a chain would be
    nested as deep as it is long.
    """
    if len(steps) == 1:
        return steps[0]
    middle = len(steps) // 2
    first, second = one_of(steps[:middle]), one_of(steps[middle:])
    return with_option({"do": flat(first)}, "on_fail", {"any": flat(second)})


def checked(condition: Any) -> Step:
    """A step that fails where a condition does not hold."""
    return {"if": condition, "then": [], "else": [{"fail": f"not so: {_words(condition)}"}]}


def _words(condition: Any) -> str:
    return condition if isinstance(condition, str) else msgspec.json.encode(condition).decode()


def condition_in(element: Element, attributes: Ports) -> Any:
    """The condition that stands in a port: a sentence, or data. Raises ConfigError."""
    text = attributes.get("condition", "")
    if not text.startswith(JSON):
        return text
    data = text[len(JSON) :]
    cure = 'for example: json:{"holding": true}'
    if max(accumulate(_NESTING.get(letter, 0) for letter in data), default=0) > MAX_NESTING:
        raise element.wrong(f"the condition is nested deeper than {MAX_NESTING} levels", cure)
    try:
        return plain_data.from_json(data)
    except ValueError:
        raise element.wrong(f"the condition is no JSON: {data[:40]}", cure) from None
