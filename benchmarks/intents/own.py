"""The project's own sentences, compared strictly: every slot of every goal."""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast

import msgspec

from intents.goals import from_builtins, to_builtins
from intents.outcomes import Goals, Outcome
from intents.vocabulary import Names, Vocabulary

HERE = Path(__file__).resolve().parent
DIGITS = 2
ME = {"who": "operator"}
"""Whom something is told, if nobody else is named."""


class Sentence(msgspec.Struct, frozen=True, kw_only=True):
    """A sentence, the goals that it asks for, and other goals that are as right."""

    id: str
    text: str
    gold: list[dict[str, Any]]
    alternatives: list[list[dict[str, Any]]] = msgspec.field(name="or", default_factory=list)


def vocabulary() -> Vocabulary:
    """The made-up home that the sentences speak of."""
    return msgspec.json.decode((HERE / "own.vocab.json").read_bytes(), type=Names).vocabulary()


def sentences(name: str = "own") -> list[Sentence]:
    """Those of the first set or of the "second"; their gold is valid, or this raises."""
    lines = (HERE / f"{name}.jsonl").read_text(encoding="utf-8").splitlines()
    found = [msgspec.json.decode(line, type=Sentence) for line in lines]
    for sentence in found:
        from_builtins(sentence.gold)
    return found


def is_right(sentence: Sentence, outcome: Outcome) -> bool:
    """Whether goals are those of the gold, or of one of its alternatives."""
    said = _plain(to_builtins(outcome.goals)) if isinstance(outcome, Goals) else None
    return said in [_plain(gold) for gold in (sentence.gold, *sentence.alternatives)]


def types_are_right(sentence: Sentence, outcome: Outcome) -> bool:
    """Whether the goals are of the right types, whatever is in them."""
    said = to_builtins(outcome.goals) if isinstance(outcome, Goals) else []
    return [goal["goal"] for goal in said] in [
        [goal["goal"] for goal in gold] for gold in (sentence.gold, *sentence.alternatives)
    ]


def _plain(value: object) -> object:
    """Rounded, and without what says nothing: a count of one, no goals."""
    if isinstance(value, float):
        return round(value, DIGITS)
    if isinstance(value, list):
        return [_plain(item) for item in cast("list[object]", value)]
    if isinstance(value, dict):
        items = dict(cast("dict[str, object]", value))
        if items.get("goal") in ("tell", "count", "say") and items.get("to") == ME:
            del items["to"]
        said = {k: v for k, v in items.items() if not (k == "count" and v == 1) and v != []}
        return {k: _plain(v) for k, v in said.items()}
    return value
