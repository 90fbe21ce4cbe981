"""Requests with much around them: may one ask, what one would be glad of, where one goes."""

import pytest

from intents.goals import Bring, Guide, ObjectQuery, Person
from intents.outcomes import Goals, Question
from tests.unit.intents.hotel_words import assert_means_the_same, heard

THE_SAME = [
    ("would it be a frightful cheek to ask for the menu?", "bring me the menu"),
    ("may I possibly ask you for a scarf", "bring me a scarf"),
    ("is it quite in order to ask for the menu that is on the bar?",
     "bring me the menu that is on the bar"),
    ("I should rest so much easier if you would close the door", "close the door"),
    ("it would put my mind at rest if you could tell Ravi that I am upstairs",
     "tell Ravi that I am upstairs"),
    ("I would be ever so glad if the teapot were back on the bar", "put the teapot on the bar"),
    ("it would be lovely if this menu could find its way to Olga", "give this menu to Olga"),
    ("If you please, young man, bring me the menu", "bring me the menu"),
    ("when you have a minute, and only if it is no bother, bring me the menu", "bring me the menu"),
    ("may I ask for the menu, which I rather think is lying on the bar?",
     "bring me the menu that is on the bar"),
    ("the teapot should be back on the bar where it belongs", "put the teapot on the bar"),
    ("pardon me, bring me the menu", "bring me the menu"),
    ("I am looking for a lady named Olga; would you find her for me?", "find the lady named Olga"),
    ("find a Mr Hans for me", "find Hans"),
    ("I have come to see Doctor Lucia", "find Lucia"),
    ("we need the hammer over in the pantry", "bring the hammer to the pantry"),
    ("I want the menu that is on the bar", "bring me the menu that is on the bar"),
    ("Olga is deaf, so rather than calling to her give her a wave", "wave at Olga"),
    ("instead of shouting for Hans, wave at him", "wave at Hans"),
    ("bring Olga the menu rather than the scarf", "bring Olga the menu"),
    ("put the cap in the wardrobe, and not just anywhere", "put the cap in the wardrobe"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "plainly"), THE_SAME, ids=[row[0] for row in THE_SAME])
def test_what_is_put_around_a_request_changes_nothing(said: str, plainly: str):
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    "said",
    [
        "I would be cross if you would bring me the menu",
        "I would not like it if you would close the door",
        "we could drink if the teapot were on the bar",
        "I would leave if the heater were off",
        "I would be sad if the teapot were on the bar",
        "I would be glad if the teapot were not on the bar",
    ],
)
def test_who_would_not_like_it_does_not_ask_for_it(said: str):
    assert not isinstance(heard(said), Goals)


def test_what_who_speaks_is_going_to_do_is_not_asked_for():
    assert not isinstance(heard("I have to go to the pantry to fetch the teapot"), Goals)


@pytest.mark.parametrize(
    "said",
    [
        "I want to go to the spa",
        "we would like to get to the spa",
        "I must to go in spa but I not know way, you bring me there",
        "I need to get to the spa and I am slow, so perhaps you could take me there",
    ],
)
def test_who_has_to_get_somewhere_is_taken_there(said: str):
    outcome = heard(said)
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == (Guide(person=Person(who="operator"), to="spa"),)


@pytest.mark.parametrize("way", ["take {} and {} to the spa", "guide {}, then {} to the spa"])
def test_where_two_are_taken_is_told_once_and_is_for_both(way: str):
    outcome = heard(way.format("Hans", "Lucia"))
    assert isinstance(outcome, Goals), outcome
    assert outcome.goals == tuple(
        Guide(person=Person(name=name), to="spa") for name in ("Hans", "Lucia")
    )


def test_where_one_has_to_go_is_only_told_beside_an_order():
    outcome = heard("I have to go to the lobby, so bring me the scarf")
    assert isinstance(outcome, Goals), outcome
    scarf = Bring(object=ObjectQuery(name="scarf"), to=Person(who="operator"))
    assert outcome.goals == (scarf,)


def test_who_asks_for_the_way_is_offered_to_be_taken():
    outcome = heard("how do I get to the spa?")
    assert isinstance(outcome, Question), outcome
    assert outcome.goals == (Guide(person=Person(who="operator"), to="spa"),)
    assert_means_the_same("which way's the spa, or just take me", "guide me to the spa")


def test_air_is_let_in_by_what_is_named():
    assert_means_the_same("let some fresh air in, the window would do nicely", "open the window")
    outcome = heard("it is stuffy, let some air in")
    assert isinstance(outcome, Question), outcome
    assert not outcome.goals
