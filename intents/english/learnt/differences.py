"""What differs between two lists of goals: in which slots, and which acts only one of them has."""

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import Any, cast

from intents.goals import Goal, to_builtins

_Plain = dict[str, Any]


def differences(own: Sequence[Goal], other: Sequence[Goal]) -> Iterator[str]:
    """The slots in which two lists of goals differ, as features; nothing where they do not.

    ``~`` stands before what both have and tell otherwise, ``-`` before what only the first has,
    ``+`` before what only the second has.
    """
    one, two = (cast("list[_Plain]", to_builtins(tuple(goals))) for goals in (own, other))
    acts = [Counter(str(goal["goal"]) for goal in goals) for goals in (one, two)]
    yield from (f"-act {act}" for act in acts[0] - acts[1])
    yield from (f"+act {act}" for act in acts[1] - acts[0])
    if len(one) != len(two):
        yield f"goals {min(4, len(two)) - min(4, len(one))}"
    found: set[str] = set()
    nothing: _Plain = {}
    for these, those in zip_longest(one, two, fillvalue=nothing):
        told = [dict(_slots(goal, "")) for goal in (these, those)]
        found |= {f"-{slot}" for slot in told[0].keys() - told[1].keys()}
        found |= {f"+{slot}" for slot in told[1].keys() - told[0].keys()}
        both = told[0].keys() & told[1].keys()
        found |= {f"~{slot}" for slot in both if told[0][slot] != told[1][slot]}
    yield from sorted(found)


def _slots(value: object, path: str) -> Iterator[tuple[str, object]]:
    """Every slot that something is told in, by its path, and what is told."""
    if isinstance(value, dict):
        for key, inner in cast("_Plain", value).items():
            name = "name" if key == "category" else key
            yield from _slots(inner, f"{path}.{name}" if path else name)
    elif isinstance(value, list):
        for inner in cast("list[object]", value):
            yield from _slots(inner, path)
    else:
        yield path, value.lower() if isinstance(value, str) else value
