"""What several names end with is a category: "the mugs" of a red mug and a blue mug."""

from __future__ import annotations

import pytest

from intents.context import Context
from intents.goals import to_builtins
from intents.grounding import Entity
from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.vocabulary import Vocabulary

FARM = Vocabulary.of(
    objects=["tin pail", "wooden pail", "copper pail", "hay rope", "long rope", "lantern"],
    places=["trough", "loft"],
    rooms=["barn", "dairy"],
    people=["Oona"],
)
PAILS = {"category": "pail"}


def goals(text: str, **context: object) -> list[dict[str, object]]:
    outcome = parse(text, FARM, context=Context(**context))  # type: ignore[arg-type]
    assert isinstance(outcome, Goals), outcome
    return to_builtins(outcome.goals)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("count the pails", [{"goal": "count", "object": PAILS}]),
        ("how many pails are in the loft?",
         [{"goal": "count", "object": {**PAILS, "at": "loft"}}]),
        ("bring me a pail",
         [{"goal": "bring", "object": {**PAILS, "count": 1}, "to": {"who": "operator"}}]),
        ("bring two ropes to Oona",
         [{"goal": "bring", "object": {"category": "rope", "count": 2}, "to": {"name": "Oona"}}]),
        ("pick up the largest pail",
         [{"goal": "pick", "object": {**PAILS, "superlative": "largest"}}]),
        ("put the pails in the trough",
         [{"goal": "for_each", "object": PAILS,
           "goals": [{"goal": "place", "object": {"held": True}, "in": "trough"}]}]),
    ],
)  # fmt: skip
def test_what_names_end_with_is_a_kind_of_thing(text: str, meant: list[dict[str, object]]) -> None:
    assert goals(text) == meant


@pytest.mark.parametrize("text", ["bring me the pail", "take my rope to Oona", "pail to Oona"])
def test_a_certain_one_of_them_is_asked_about(text: str) -> None:
    outcome = parse(text, FARM)
    assert isinstance(outcome, Question)
    assert "Which" in outcome.question


def test_the_things_that_are_there_are_of_that_kind() -> None:
    there = [
        Entity(id=name, name=name, at="loft") for name in ("tin pail", "wooden pail", "lantern")
    ]
    assert goals("bring any pail to Oona", entities=tuple(there))
    outcome = parse("bring three pails to Oona", FARM, context=Context(entities=tuple(there)))
    assert not isinstance(outcome, Goals)
    assert "only 2" in outcome.reason  # type: ignore[union-attr]
