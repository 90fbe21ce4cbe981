"""What keeps plain data from being of a type: every misfit by name, with range, unit and cure.

msgspec stops at the first and speaks of Python's types; people who write a file want all of them,
in the words of the file. The types are msgspec's, the ranges those of `robot.files.quantities`.
"""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import Any, cast

import msgspec
from msgspec import inspect

Path = tuple[str | int, ...]
"""Keys and places in lists, from the outside in."""

SHOWN = 60
"""Characters of a value that a message repeats."""
MOST_UNITS = 3
"""Names that differ by their unit: `yaw_deg` and `yaw_rad`."""
MOST_NAMES = 12
"""Names that a message lists before it says how many more there are."""


class Misfit(msgspec.Struct, frozen=True):
    """Something that does not fit, where it is, and the cure; `at_key`: its key is what is wrong.

    What is missing is missing from what stands at `path`.
    """

    path: Path
    message: str
    cure: str = ""


def misfits(data: object, kind: Any) -> Iterator[Misfit]:
    """Everything in plain data (dicts, lists, scalars) that is not as `kind` has it, in order.

    Types that hold more than structs, dicts, lists, tuples, unions of these, scalars and ranges
    are left to msgspec.
    """
    return _of(data, _type(kind), (), "")


@cache
def _type(kind: Any) -> inspect.Type:
    return inspect.type_info(kind)


def nearest(name: str, valid: Sequence[str]) -> str:
    """`did you mean 'x'?`, or the list of what is valid; of one quantity every unit is named."""
    units = sorted(one for one in valid if one.startswith(f"{name}_"))
    if 1 < len(units) <= MOST_UNITS:
        return f"did you mean {' or '.join(map(repr, units))}?"
    if close := closest(name, valid):
        return f"did you mean {close!r}?"
    return "valid: " + listed(sorted(valid))


def closest(name: str, valid: Sequence[str]) -> str:
    """The valid name that was most likely meant; empty if none is near."""
    close = difflib.get_close_matches(name[:SHOWN], valid, n=1, cutoff=0.5)
    return close[0] if close else ""


def listed(names: Sequence[str]) -> str:
    """Names as a message lists them: the first ones, and how many more there are."""
    more = len(names) - MOST_NAMES
    return ", ".join(names[:MOST_NAMES]) + (f" and {more} more" if more > 0 else "")


def dotted(path: Path) -> str:
    """A path as people write it: `rows[1].height_m`."""
    parts = (f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return "".join(parts).lstrip(".")


def _of(data: object, kind: inspect.Type, path: Path, unit: str) -> Iterator[Misfit]:
    match kind:
        case inspect.Metadata():
            extra = cast("dict[str, str]", kind.extra or {})  # pyright: ignore[reportUnknownMemberType]
            yield from _of(data, kind.type, path, extra.get("unit", ""))
        case inspect.UnionType():
            yield from _of_union(data, kind, path, unit)
        case inspect.StructType():
            yield from _of_struct(data, kind, path)
        case inspect.DictType():
            yield from _of_dict(data, kind, path)
        case inspect.TupleType() | inspect.VarTupleType() | inspect.ListType():
            yield from _of_list(data, kind, path)
        case inspect.FloatType() | inspect.IntType():
            yield from _of_number(data, kind, path, unit)
        case inspect.StrType() | inspect.BoolType() | inspect.LiteralType() | inspect.NoneType():
            yield from _of_word(data, kind, path)
        case _:
            pass


def _of_union(data: object, kind: inspect.UnionType, path: Path, unit: str) -> Iterator[Misfit]:
    """Of no member: what keeps it from the one that it resembles most, which is the first alike."""
    found = [list(_of(data, member, path, unit)) for member in kind.types]
    if all(found):
        deeper = [misfits for misfits in found if misfits[0].path != path]
        alike = [
            misfits
            for member, misfits in zip(kind.types, found, strict=True)
            if not isinstance(member, inspect.NoneType) and _alike(data, member)
        ]
        yield from (deeper or alike or found)[0]


def _alike(data: object, kind: inspect.Type) -> bool:
    """Whether data and type are both numbers, both mappings, both lists, or both none of these."""
    match kind:
        case inspect.Metadata():
            return _alike(data, kind.type)
        case inspect.FloatType() | inspect.IntType():
            return isinstance(data, float | int) and not isinstance(data, bool)
        case inspect.StructType() | inspect.DictType():
            return isinstance(data, Mapping)
        case inspect.TupleType() | inspect.VarTupleType() | inspect.ListType():
            return isinstance(data, list | tuple)
        case _:
            return isinstance(data, bool) or not isinstance(data, float | int | Mapping | list)


def _of_struct(data: object, kind: inspect.StructType, path: Path) -> Iterator[Misfit]:
    if not isinstance(data, Mapping):
        yield _wrong(data, path, "a mapping of keys to values")
        return
    entries = cast("Mapping[str, object]", data)
    fields = {field.encode_name: field for field in kind.fields}
    if kind.tag_field is not None:
        fields.pop(kind.tag_field, None)
    for name in entries:
        if name in fields:
            yield from _of(entries[name], fields[name].type, (*path, name), "")
        elif name != kind.tag_field and kind.forbid_unknown_fields:
            text = f"unknown key {shown(name)}"
            yield Misfit((*path, name), text, nearest(name, list(fields)))
    if any(name not in fields and name != kind.tag_field for name in entries):
        return  # what is missing is most likely there, misspelt
    for name, field in fields.items():
        if field.required and name not in entries:
            yield Misfit(path, f"{dotted((*path, name))} is missing", "add it")


def _of_dict(data: object, kind: inspect.DictType, path: Path) -> Iterator[Misfit]:
    if not isinstance(data, Mapping):
        yield _wrong(data, path, "a mapping of names to values")
        return
    entries = cast("Mapping[str, object]", data)
    yield from _too_many(len(entries), kind.max_length, path)
    for name, value in entries.items():
        yield from _of(name, kind.key_type, (*path, name), "")
        yield from _of(value, kind.value_type, (*path, name), "")


def _of_list(
    data: object,
    kind: inspect.TupleType | inspect.VarTupleType | inspect.ListType,
    path: Path,
) -> Iterator[Misfit]:
    if not isinstance(data, list | tuple):
        yield _wrong(data, path, "a list")
        return
    items = cast("Sequence[object]", data)
    if isinstance(kind, inspect.TupleType):
        kinds = kind.item_types
        if len(items) != len(kinds):
            text = f"{dotted(path)} has {len(items)} values, and must have {len(kinds)}"
            yield Misfit(path, text)
            return
    else:
        yield from _too_many(len(items), kind.max_length, path)
        kinds = (kind.item_type,) * len(items)
    for index, (item, item_kind) in enumerate(zip(items, kinds, strict=True)):
        yield from _of(item, item_kind, (*path, index), "")


def _too_many(count: int, most: int | None, path: Path) -> Iterator[Misfit]:
    if most is not None and count > most:
        yield Misfit(path, f"{dotted(path)} has {count} entries, at most {most} are taken")


def _of_number(
    data: object, kind: inspect.FloatType | inspect.IntType, path: Path, unit: str
) -> Iterator[Misfit]:
    if isinstance(data, bool) or not isinstance(data, float | int):
        yield _wrong(data, path, "a number")
    elif not _is_finite(data):
        yield Misfit(path, f"{dotted(path)} is not a finite number")
    elif isinstance(kind, inspect.IntType) and data != int(data):
        yield Misfit(path, f"{dotted(path)} is {data:g}, and must be a whole number")
    elif (kind.ge is not None and data < kind.ge) or (kind.le is not None and data > kind.le):
        yield Misfit(path, f"{dotted(path)} is {data:g}, and must be {_range(kind, unit)}")


def _is_finite(data: float) -> bool:
    try:
        return math.isfinite(data)
    except OverflowError:  # a whole number that no float comes near to
        return False


def _range(kind: inspect.FloatType | inspect.IntType, unit: str) -> str:
    low, high = (
        f"{limit:g} {unit}".rstrip() if limit is not None else "" for limit in (kind.ge, kind.le)
    )
    if low and high:
        return f"from {kind.ge:g} to {high}"
    return f"{low} or more" if low else f"{high} or less"


def _of_word(
    data: object,
    kind: inspect.StrType | inspect.BoolType | inspect.LiteralType | inspect.NoneType,
    path: Path,
) -> Iterator[Misfit]:
    match kind:
        case inspect.LiteralType():
            # true equals 1 and is none
            if not any(data == value and type(data) is type(value) for value in kind.values):
                valid = [str(value) for value in kind.values]
                text = f"{dotted(path)} cannot be {shown(data)}"
                yield Misfit(path, text, nearest(str(data), valid))
        case inspect.StrType():
            if not isinstance(data, str):
                yield _wrong(data, path, "a text", cure="put it into quotes")
            elif len(data) < (kind.min_length or 0):
                yield Misfit(path, f"{dotted(path)} is empty", "say something, or leave it out")
            elif kind.max_length is not None and len(data) > kind.max_length:
                text = f"{len(data)} letters, at most {kind.max_length} are taken"
                yield Misfit(path, f"{dotted(path)} has {text}")
            elif kind.pattern is not None and not re.search(kind.pattern, data):
                yield _wrong(data, path, "one line of text")  # the pattern of `quantities.Line`
        case inspect.BoolType():
            if not isinstance(data, bool):
                yield _wrong(data, path, "true or false")
        case inspect.NoneType():
            if data is not None:
                yield _wrong(data, path, "nothing")


def _wrong(data: object, path: Path, wanted: str, *, cure: str = "") -> Misfit:
    if not path:  # whatever file was named by mistake: what it says is not for the screen
        return Misfit(path, f"the whole is {_kind_of(data)}, and must be {wanted}", cure)
    where = dotted(path)
    return Misfit(path, f"{where} is {shown(data)}, and must be {wanted}", cure)


def _kind_of(data: object) -> str:
    return "a text" if isinstance(data, str) else shown(data)


def shown(data: object) -> str:
    """A value as a message repeats it, short."""
    if isinstance(data, Mapping):
        return "a mapping"
    if isinstance(data, list | tuple):
        return "a list"
    if data is None:
        return "nothing"
    said = repr(data)
    return said if len(said) <= SHOWN else f"{said[:SHOWN]}..."
