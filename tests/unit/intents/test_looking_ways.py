"""A way to look ("around", "up") is no place: nothing is ever sought, counted or left there."""

import pytest

from intents import allowed
from intents.goals import Count, Find, LookAt, ObjectQuery, Place
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Thing, Vocabulary

FLAT = Vocabulary.of(
    objects=[Thing(name="power bank", category="power bank"), Thing(name="mug", category="mug")],
    places=["low table"],
    rooms=["kitchen"],
    people=["Priya"],
    categories={"power bank": "power banks", "mug": "mugs"},
)


@pytest.mark.parametrize("way", [*allowed.DIRECTIONS, "around the kitchen", "at the low table"])
@pytest.mark.parametrize(
    "said",
    [
        "look {} and count the mugs",
        "look {} and tell me how many mugs there are",
        "I can't find my power bank, have a look {}",
        "I can't find my power bank, have a look {} and leave it on the low table when you have it",
        "I can't find Priya, look {}",
    ],
)
def test_every_place_in_the_goals_is_one_that_there_is(said, way):
    outcome = parse(said.format(way), FLAT)
    if isinstance(outcome, Goals):
        assert allowed.fault(outcome.goals, FLAT) == ""


def test_to_look_around_for_what_is_lost_is_to_look_for_it():
    outcome = parse("i can't find my power bank, have a look around and leave it on the low table "
                    "when you have it", FLAT)  # fmt: skip
    bank = ObjectQuery(name="power bank")
    assert isinstance(outcome, Goals)
    assert outcome.goals == (Find(object=bank), Place(object=bank, on="low table"))


def test_to_look_around_first_and_count_is_both():
    outcome = parse("look around and count the mugs", FLAT)
    assert isinstance(outcome, Goals)
    assert outcome.goals == (LookAt(place="around"), Count(object=ObjectQuery(name="mug")))
