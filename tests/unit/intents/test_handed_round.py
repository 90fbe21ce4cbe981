"""Something for each of several, one here and one there, and places told from afar."""

import pytest

from intents.goals import to_builtins
from intents.outcomes import Goals
from tests.unit.intents.hotel_words import assert_means_the_same, heard


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("bring Olga and Hans a cola each", "bring a cola to Olga and Hans"),
        ("could you give Olga, Hans and Ravi each a torch", "give a torch to Olga, Hans and Ravi"),
        ("take Hans and Lucia two teas each, please", "take two teas to Hans and Lucia"),
        ("bring a menu each to Olga and Ravi", "bring a menu to Olga and Ravi"),
        ("nod and fetch Olga and Ravi a cap each", "nod and fetch a cap to Olga and Ravi"),
    ],
)  # fmt: skip
def test_several_get_one_each(said: str, plainly: str):
    assert_means_the_same(said, plainly)


def test_one_thing_is_not_handed_round():
    outcome = heard("bring Olga and Hans the menu")
    both = isinstance(outcome, Goals) and to_builtins(outcome.goals)
    assert both != to_builtins(getattr(heard("bring the menu to Olga and Hans"), "goals", ()))


def test_one_more_of_any_is_any():
    outcome = heard("put a cola on the trolley and one on the bar")
    assert isinstance(outcome, Goals)
    assert [getattr(goal, "object", None).count for goal in outcome.goals] == [1, 1]


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("put the teapot in the pantry, on the trolley", "put the teapot on the trolley"),
        (
            "leave it in the suite, on the side table, and wave",
            "leave it on the side table and wave",
        ),
        ("go and have a look in the lobby, then the spa", "go to the lobby, then go to the spa"),
        ("go have a quick peek in the spa", "go to the spa"),
        ("bring the menu to Olga, please see to that", "bring the menu to Olga"),
        ("close the wardrobe. See to it, please", "close the wardrobe"),
        (
            "if the cap is on the bar carry it to the trolley, if it isn't do nothing",
            "if the cap is on the bar carry it to the trolley, otherwise do nothing",
        ),
    ],
)
def test_told_from_afar_and_in_many_words(said: str, plainly: str):
    assert_means_the_same(said, plainly)


def test_a_room_that_is_gone_to_stays_one():
    plainly = "go to the pantry. Put the cap on the bar"
    assert_means_the_same("go to the pantry, then put the cap on the bar", plainly)


def test_what_something_else_is_seen_to_is_still_asked_about():
    assert not isinstance(heard("the desk lamp flickers, see to it"), Goals)
