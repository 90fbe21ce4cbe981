"""What is only a part of an order is neither lost nor taken for an order of its own."""

import pytest

from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.plain_words import plainly
from intents.vocabulary import Thing, Vocabulary

INN = Vocabulary(
    objects=(
        *(Thing(name=name, category="instrument") for name in ("fiddle", "drum", "flute")),
        *(Thing(name=name) for name in ("jug", "ladle", "lantern lamp")),
    ),
    places=Vocabulary.of(places=["bar", "chest", "side door", "dresser", "bunk"]).places,
    rooms=Vocabulary.of(rooms=["cellar", "taproom"]).rooms,
    people=Vocabulary.of(people=["Nell", "Gus", "Ivo"]).people,
    categories=Vocabulary.of(categories={"instrument": "instruments"}).categories,
)


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("side door shut, lamp on", "close the side door ; switch on the lantern lamp"),
        ("lamp off, side door closed", "switch off the lantern lamp ; close the side door"),
        (
            "guide Nell to the cellar, then Gus",
            "guide Nell to the cellar ; guide Gus to the cellar",
        ),
        ("go to the bar and lead Nell there", "go to the bar ; guide Nell to the bar"),
        (
            "bring the jug and then the ladle to Nell",
            "bring the jug to Nell ; bring the ladle to Nell",
        ),
        (
            "bring me the jug and then the ladle to Nell",
            "bring the jug to me ; bring the ladle to Nell",
        ),
        ("the jug is to be handed to the guest, Nell", "bring the jug to Nell"),
        (
            "a jug to Nell, a ladle to Gus. Then wave",
            "bring a jug to Nell ; bring a ladle to Gus ; wave",
        ),
        (
            "the instruments go in the chest, but the drum stays",
            "for every instrument except the drum : put it into the chest",
        ),
        (
            "all the instruments into the chest but leave the drum",
            "for every instrument except the drum : put it into the chest",
        ),
        (
            "put all the instruments in the chest, but keep the drum out",
            "for every instrument except the drum : put it into the chest",
        ),
        (
            "open the chest and count the instruments in it",
            "open the chest ; count the instruments at the chest",
        ),
        (
            "put the jug on the bar, the one that is on the bunk",
            "put the jug at the bunk on the bar",
        ),
        ("about turn and back to the bar", "turn 180° left ; go to the bar"),
        ("start at the bar, then go to the cellar", "go to the bar ; go to the cellar"),
        (
            "report how many people are at the bar, then report how many jugs are on it",
            "count the people at the bar ; count the jugs at the bar",
        ),
        ("explain yourself", "why did you stop"),
    ],
)
def test_each_part_comes_back(said: str, meant: str) -> None:
    outcome = parse(said, INN)
    assert isinstance(outcome, Goals), outcome
    assert plainly(outcome.goals) == meant


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("to turn down the bunk, take the jug off it", "pick up the jug at the bunk"),
        ("take the jug off the bunk, I want to lie down", "pick up the jug at the bunk"),
    ],
)
def test_a_purpose_is_no_order(said: str, meant: str) -> None:
    outcome = parse(said, INN)
    assert isinstance(outcome, Goals), outcome
    assert plainly(outcome.goals) == meant


@pytest.mark.parametrize(
    "said",
    [
        "close the side door and lock it",
        "jug -> Nell -> say “go”",
        "in case of fire, open the side door",
        "in the event of rain, close the side door",
        "answer the telephone",
        "turn down the bunk",
    ],
)
def test_what_cannot_be_done_whole_is_not_done_in_silence(said: str) -> None:
    outcome = parse(said, INN)
    assert not isinstance(outcome, Goals), outcome


def test_a_lock_is_named_in_the_question() -> None:
    outcome = parse("lock the side door", INN)
    assert isinstance(outcome, Question) and "lock" in outcome.question
