"""What may stand somewhere, in words: msgspec's types for people who write files."""

from __future__ import annotations

from msgspec import inspect as types


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
