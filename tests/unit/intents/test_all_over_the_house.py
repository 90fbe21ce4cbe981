"""All over the house, one of the same kind, several that belong somewhere, for whom it is put."""

import pytest

from intents.goals import Count, ObjectQuery, Place, Relation, Say
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Thing, Vocabulary
from tests.unit.intents.hotel_words import HOTEL, assert_means_the_same, heard

POTTERY = Vocabulary.of(
    objects=[
        *(Thing(name="jar", category="jar", color=color) for color in ("red", "blue", "green")),
        *(Thing(name=f"{color} glaze", category="glaze") for color in ("white", "black")),
        Thing(name="bowl", category="bowl", color="green"),
        Thing(name="vase", category="vase"),
    ],
    places=["rack", "bench", "house door"],
    rooms=["studio", "shop"],
    people=["Ada"],
)


def _goals(said: str) -> tuple[object, ...]:
    outcome = parse(said, POTTERY)
    assert isinstance(outcome, Goals), outcome
    return outcome.goals


@pytest.mark.parametrize(
    "said",
    [
        "how many saucers are there in the house?",
        "how many saucers do we have in the whole hotel?",
        "how many saucers are there in total?",
        "how many saucers are there all over the entire building?",
        "count the saucers everywhere",
    ],
)
def test_a_count_all_over_the_house_is_of_all(said: str) -> None:
    outcome = heard(said)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (Count(object=ObjectQuery(name="saucer", count="all")),)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("find the torch somewhere in the house", "find the torch"),
        ("look everywhere for the torch", "look for the torch"),
        ("bring all the saucers in the flat to the bar", "bring all the saucers to the bar"),
        ("is there a hammer anywhere in this building?", "is there a hammer?"),
        ("count the saucers in the suite in total", "count the saucers in the suite"),
    ],
)
def test_wherever_there_is_anything_says_nothing_more(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


def test_what_is_told_keeps_the_house() -> None:
    outcome = heard("tell Olga that there is tea in the house")
    assert isinstance(outcome, Goals), outcome
    (goal,) = outcome.goals
    assert isinstance(goal, Say)
    assert goal.what == "there is tea in the house"


def test_a_place_of_that_name_is_meant() -> None:
    called = Vocabulary.of(objects=["torch"], places=["shelf"], rooms=["building", "hall"])
    outcome = parse("how many torches are in the building?", called)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (Count(object=ObjectQuery(name="torch", at="building")),)


@pytest.mark.parametrize(
    ("said", "of"),
    [
        ("put the blue jar next to the green one", ObjectQuery(name="jar", color="green")),
        ("put the blue jar on the rack next to the red one", ObjectQuery(name="jar", color="red")),
        ("move the blue jar next to the red one", ObjectQuery(name="jar", color="red")),
        ("put the white glaze next to the black one", ObjectQuery(name="black glaze")),
    ],
)
def test_one_beside_a_thing_is_of_its_kind(said: str, of: ObjectQuery) -> None:
    (goal,) = _goals(said)
    assert isinstance(goal, Place)
    assert goal.relation == Relation(how="near", of=of)


def test_one_that_was_spoken_of_is_not_where_the_other_was() -> None:
    *_, goal = _goals("take the blue jar from the rack and put it next to the green one")
    assert isinstance(goal, Place)
    assert goal.relation == Relation(how="near", of=ObjectQuery(name="jar", color="green"))


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("the saucer and the menu should go on the bar",
         "put the saucer on the bar, put the menu on the bar"),
        ("the cap and the scarf belong in the wardrobe",
         "put the cap in the wardrobe, put the scarf in the wardrobe"),
        ("the cap, the scarf and the torch go to Olga",
         "bring the cap to Olga, bring the scarf to Olga, bring the torch to Olga"),
        ("put the menu on the bar for Olga", "put the menu on the bar"),
        ("find the menu and put it on the bar for me", "find the menu and put it on the bar"),
        ("check if the menu is still on the bar and if so put it on the counter",
         "check if the menu is on the bar and if so put it on the counter"),
        ("how many saucers are on the bar and how many on the counter?",
         "count the saucers on the bar, then count the saucers on the counter"),
        ("how many saucers are on the bar? how many are on the counter?",
         "count the saucers on the bar, then count the saucers on the counter"),
    ],
)  # fmt: skip
def test_it_means_the_same(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize("verb", ["check", "see", "find out"])
def test_what_somebody_is_to_find_out_is_no_condition_of_telling_them(verb: str) -> None:
    said = f"{verb} if the menu is on the bar"
    outcome = heard(f"tell Olga to {said}")
    assert isinstance(outcome, Goals), outcome
    (goal,) = outcome.goals
    assert isinstance(goal, Say)
    assert goal.what == said


def test_how_many_of_nothing_is_asked_back() -> None:
    assert not isinstance(parse("how many on the bar?", HOTEL), Goals)
