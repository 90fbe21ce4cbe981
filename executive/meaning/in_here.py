"""Things that are "in here", or beside whoever speaks: nothing tells the robot where that is.

"Somebody left an umbrella in here, find it": it is looked for as if nobody had said where.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import cast

from intents.goals import OPERATOR, Goal, from_builtins, to_builtins

AT = "at"


def without_here(asked: Iterable[Goal]) -> tuple[Goal, ...]:
    """The goals, with no word of where things are that are where the operator is."""
    asked = tuple(asked)
    plain = to_builtins(asked)
    less = _less(plain)
    return asked if less == plain else from_builtins(less)


def _less(plain: object) -> object:
    """Plain data without every `at` that stands for the operator."""
    if isinstance(plain, dict):
        items = cast("dict[str, object]", plain).items()
        return {key: _less(value) for key, value in items if (key, value) != (AT, OPERATOR)}
    return [_less(one) for one in cast("list[object]", plain)] if isinstance(plain, list) else plain
