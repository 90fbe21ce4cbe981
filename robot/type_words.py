"""What may stand somewhere, in words: msgspec's types and messages for people who write files."""

from __future__ import annotations

import re
from typing import Any

from msgspec import inspect as types

_PLAIN = {
    "int": "a whole number",
    "float": "a number",
    "str": "a text",
    "bool": "true or false",
    "array": "a list",
    "object": "a mapping",
    "null": "nothing",
}


def in_words(info: types.Type) -> str:
    """What a type takes, with its range: `a number from 0 to 600`, `one of left, right`."""
    match info:
        case types.Metadata():
            return in_words(info.type)
        case types.StrType():
            return "a text"
        case types.BoolType():
            return "true or false"
        case types.IntType():
            return "a whole number" + _range(info)
        case types.FloatType():
            return "a number" + _range(info)
        case types.LiteralType():
            return "one of " + ", ".join(str(value) for value in info.values)
        case types.TupleType():
            inside = dict.fromkeys(in_words(item) for item in info.item_types)
            each = " and ".join(words.removeprefix("a ") for words in inside)
            return f"a list of {len(info.item_types)}, each {each}"
        case types.VarTupleType() | types.ListType():
            return "a list"
        case types.UnionType():
            members = [item for item in info.types if not isinstance(item, types.NoneType)]
            return " or ".join(dict.fromkeys(in_words(item) for item in members))
        case types.StructType():
            return "a mapping of " + ", ".join(field.encode_name for field in info.fields)
        case _:
            return "a mapping"


def _range(info: types.IntType | types.FloatType) -> str:
    low = info.ge if info.ge is not None else info.gt
    high = info.le if info.le is not None else info.lt
    open_low = "above" if info.gt is not None else "from"
    if low is None and high is None:
        return ""
    if low is None:
        return f" up to {high:g}"
    if high is None:
        return f" above {low:g}" if info.gt is not None else f" from {low:g} up"
    link = "and up to" if info.gt is not None else "to"
    return f" {open_low} {low:g} {link} {high:g}"


def said(message: str) -> str:
    """A message of msgspec's in the words of this project; others as they are."""
    for pattern, words in _MESSAGES:
        found = re.fullmatch(pattern, message)
        if found is not None:
            return words.format(*(_kinds(part) for part in found.groups()))
    return message


_MESSAGES = (
    (r"Expected `array` of length (\d+), got (\d+)", "{0} values should stand here, not {1}"),
    (r"Expected `array` of length >= (\d+)", "a list of at least {0} should stand here"),
    (r"Expected `array` of length <= (\d+)", "a list of at most {0} should stand here"),
    (r"Expected `str` of length >= (\d+)", "a text of at least {0} characters should stand here"),
    (r"Expected `str` of length <= (\d+)", "a text of at most {0} characters should stand here"),
    (r"Expected `([^`]+)`, got `([^`]+)`", "{0} should stand here, not {1}"),
    (r"Expected `([^`]+)` >= (\S+)", "{0} of at least {1} should stand here"),
    (r"Expected `([^`]+)` > (\S+)", "{0} above {1} should stand here"),
    (r"Expected `([^`]+)` <= (\S+)", "{0} of at most {1} should stand here"),
    (r"Expected `([^`]+)` < (\S+)", "{0} below {1} should stand here"),
    (r"Object missing required field `([^`]+)`", "the key '{0}' is missing"),
    (r"Object contains unknown field `([^`]+)`", "unknown key '{0}'"),
    (r"Invalid enum value (.+)", "{0} is none of the words that may stand here"),
    (r"Invalid value (.+)", "{0} is none of the words that may stand here"),
)


def _kinds(text: str) -> str:
    """`int | null` as `a whole number`: that it may be left out is no news."""
    kinds = [kind.strip() for kind in text.split("|")]
    if any(kind not in _PLAIN for kind in kinds):
        return text
    shown = [kind for kind in kinds if kind != "null"] or kinds
    if "float" in shown:
        shown = [kind for kind in shown if kind != "int"]
    return " or ".join(_PLAIN[kind] for kind in shown)


def shown(value: Any) -> str:
    """A value as a message shows it, short."""
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
