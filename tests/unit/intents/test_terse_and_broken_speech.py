"""How those speak who are in haste, type with their thumbs or learn the language."""

import pytest

from intents.goals import Balance, Bring, Give, ObjectQuery, Person, Report
from intents.outcomes import Goals, Question
from intents.parser import parse
from intents.vocabulary import Vocabulary
from tests.unit.intents.hotel_words import assert_means_the_same, heard

GARAGE = Vocabulary.of(
    objects=["bicycle pump", "oil drip tray", "magazine", "yellow rag", "wheel brace"],
    places=["bench", "tv", "rack"],
    rooms=["yard"],
    people=["Edda"],
)

THE_SAME = [
    ("6 pillows plus 2 saucers, deliver to the suite",
     "bring 6 pillows and 2 saucers to the suite"),
    ("teapot, counter: move to the bar", "move the teapot from the counter to the bar"),
    ("cap and scarf, move to the wardrobe", "put the cap and the scarf on the wardrobe"),
    ("Olga cannot walk good, bring for her hair dryer", "bring the hair dryer to Olga"),
    ("is possible bring torch for Ravi in spa?", "bring the torch to Ravi in the spa"),
    ("Ravi need torch, bring to him", "Ravi needs the torch, bring it to him"),
    ("bring me the cap, I shall be in the lobby", "bring me the cap"),
    ("chuk the torch in the bin", "chuck the torch in the bin"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "plainly"), THE_SAME, ids=[row[0] for row in THE_SAME])
def test_terse_and_broken_orders_are_plain_ones(said: str, plainly: str):
    assert_means_the_same(said, plainly)


def test_how_long_stands_behind_a_comma():
    outcome = heard("squat, 4 s. Return to standing.")
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (Balance(mode="squat", duration_s=4), Balance(mode="stand"))
    assert isinstance(heard("wave, 4 s"), Question)


@pytest.mark.parametrize("said", ["battery state?", "power level", "motor status, please"])
def test_the_state_of_a_part_is_reported(said: str):
    outcome = heard(said)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (Report(topic="health"),)


def test_you_give_goes_to_who_wants_it():
    outcome = heard("Ravi cry, he want cap. You give.")
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (Give(object=ObjectQuery(name="cap"), to=Person(name="Ravi")),)


@pytest.mark.parametrize(
    ("said", "name"),
    [
        ("bring me the bike pump", "bicycle pump"),
        ("bring me the od tray", "oil drip tray"),
        ("bring me the mag", "magazine"),
        ("rag yellow, bring me", "yellow rag"),
    ],
)
def test_names_are_known_by_short_words_initials_and_the_colour_behind(said: str, name: str):
    outcome = parse(said, GARAGE)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (Bring(object=ObjectQuery(name=name), to=Person(who="operator")),)


def test_a_letter_typed_twice_in_a_short_name_is_none():
    outcome, plain = parse("tvv off", GARAGE), parse("tv off", GARAGE)
    assert isinstance(outcome, Goals), outcome
    assert isinstance(plain, Goals), plain
    assert outcome.goals == plain.goals


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        (
            "whatever pillows are left, onto the bar with them",
            "put all the pillows on the bar",
        ),
        ("put whatever saucers there are on the bar", "put all the saucers on the bar"),
        ("Hans: sitting or lying?", "is Hans sitting or lying?"),
        ("report posture: Olga", "what is the posture of Olga?"),
        (
            "the cap always hung on the luggage rack, so put it there",
            "put the cap on the luggage rack",
        ),
    ],
)
def test_whatever_there_is_and_what_is_noted_down(said: str, plainly: str):
    one, other = heard(said), heard(plainly)
    assert isinstance(one, Goals), one
    assert isinstance(other, Goals), other
    assert one.goals == other.goals


def test_whom_a_colon_stands_behind_is_not_spoken_to():
    assert not isinstance(heard("Hans, sit down"), Goals)
