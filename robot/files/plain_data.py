"""JSON and TOML that may be a stranger's: dicts, lists and scalars, then a typed value.

What is wrong is told in words of our own, as `config` does for YAML, whose nodes know their lines;
here a path has to do.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from itertools import islice
from pathlib import Path as FilePath
from typing import TypeVar, cast

import msgspec

from robot.errors import ConfigError, Problem
from robot.files.misfits import Misfit, Path, dotted, misfits
from robot.printable import is_printable, printable

T = TypeVar("T")

MOST_PROBLEMS = 30
"""More would scroll the first of them away."""
_SHOWN = 60
_TOO_DEEP = "this is nested too deep"
_TOO_LONG = "a number here has too many digits"


def from_json(text: str) -> object:
    """The plain data of a JSON text.

    Raises:
        ValueError: it is no JSON, is nested too deep, or holds a number of too many digits.
    """
    try:
        return msgspec.json.decode(text)
    except RecursionError:
        raise ValueError(_TOO_DEEP) from None
    except msgspec.ValidationError:  # all that plain data can be too much for
        raise ValueError(_TOO_LONG) from None
    except (msgspec.DecodeError, UnicodeError) as error:
        _, _, place = str(error).partition("(")
        raise ValueError("this is no JSON" + (f" ({place}" if place else "")) from None


def from_toml(text: str) -> object:
    """The plain data of a TOML text.

    Raises:
        ValueError: it is no TOML, is nested too deep, or holds a number of too many digits.
    """
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError(_TOO_DEEP) from None
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"this is no TOML: {error}") from None
    except ValueError:  # Python reads numbers up to a length, and dates that there are
        raise ValueError(f"{_TOO_LONG}, or a date there never was") from None


def fitted(data: object, kind: type[T], file: FilePath | str) -> T:
    """Plain data as a value of a msgspec type.

    Args:
        data: dicts, lists and scalars.
        kind: the type.
        file: where they come from, for people.

    Raises:
        ConfigError: with what is wrong: types, ranges, keys, what cannot be printed.
    """
    try:
        found = [*islice(misfits(data, kind), MOST_PROBLEMS), *islice(_unprintable(data, ()), 1)]
    except RecursionError:  # TOML's dotted keys nest without being nested
        raise ConfigError([Problem(_TOO_DEEP, str(file))]) from None
    if found:
        raise ConfigError([Problem(o.message, str(file), suggestion=o.cure or None) for o in found])
    try:
        return msgspec.convert(data, kind)
    except msgspec.ValidationError as error:  # what a type checks by itself
        message, _, _ = str(error).partition(" - at `")
        raise ConfigError([Problem(message, str(file))]) from None


def _unprintable(data: object, path: Path) -> Iterator[Misfit]:
    """Texts and keys that a terminal would obey."""
    if isinstance(data, dict):
        for key, value in cast("dict[str, object]", data).items():
            yield from _unprintable(key, path)
            yield from _unprintable(value, (*path, key))
    elif isinstance(data, list | tuple):
        for index, value in enumerate(cast("list[object]", data)):
            yield from _unprintable(value, (*path, index))
    elif isinstance(data, str) and not is_printable(data):
        text = f"holds what cannot be printed: {printable(data)[:_SHOWN]}"
        yield Misfit(path, f"{dotted(path) or 'the file'} {text}", "leave it out")
