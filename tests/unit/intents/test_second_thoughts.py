"""What is taken back after it was said, what takes another order's place, and what "it" is then."""

import pytest

from intents.goals import If, Place
from intents.outcomes import Goals, Question, Refusal
from intents.parser import parse
from intents.vocabulary import Vocabulary
from tests.unit.intents.hotel_words import assert_means_the_same, heard

SAME = [
    # "It" is what can be switched, opened or closed
    ("put the teapots on the heater and turn it on",
     "put the teapots on the heater, turn the heater on"),
    ("stow the cola in the minibar and shut it", "put the cola in the minibar, shut the minibar"),
    ("go to the desk lamp, then switch it off", "go to the desk lamp, switch the desk lamp off"),
    # denied in the same verb, or in one for all
    ("greet Olga, no, leave Olga alone, greet Ravi", "greet Ravi"),
    ("go to the spa, no wait, don't go to the spa, go to the suite", "go to the suite"),
    ("hand Hans the menu, oh no, don't do that, wave at him", "wave at Hans"),
    ("Tell Lucia her tea is cold. No, that is unkind, don't tell her that, only wave to her.",
     "wave to Lucia"),
    ("fetch the scarf, wait, no, don't, open the door", "open the door"),
    # broken off before what is to be said
    ("say to Olga, no, leave Olga be, say to Ravi that supper waits",
     "say to Ravi that supper waits"),
    ("tell Hans, no sorry, tell Lucia that the taxi waits", "tell Lucia that the taxi waits"),
    ("tell Hans, no, Lucia, that the taxi waits", "tell Lucia that the taxi waits"),
    # the other way round
    ("turn the heater on. No, off.", "turn the heater off"),
    ("desk lamp off... oh, it is off already. On, then, please.", "turn the desk lamp on"),
    ("turn the heater on, then off again", "turn the heater on, turn the heater off"),
    ("Turn left. No, right.", "turn right"),
    ("Take two steps back. Sorry, three.", "take three steps back"),
    # what is to be said ends where something else is to be done
    ("if Olga is in the spa tell her the car is here; if she isn't, do nothing",
     "if Olga is in the spa, tell her the car is here"),
    ("if Ravi is in the lobby say hello there; otherwise come back",
     "if Ravi is in the lobby, say hello there, otherwise, come back"),
    # inside of what was opened
    ("open the wardrobe, get the scarf inside, close it",
     "open the wardrobe, put the scarf in the wardrobe, close the wardrobe"),
]  # fmt: skip


@pytest.mark.parametrize(("said", "plainly"), SAME)
def test_last_thought_counts(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize(
    "said",
    [
        "the menu goes to Ravi, but if he isn't in the suite put it on the bar instead",
        "take the menu to Ravi; if he isn't in the suite, put it on the bar",
        "bring Ravi the menu, but if he is lying down leave it on the bar",
    ],
)
def test_one_or_other_and_not_both(said: str) -> None:
    outcome = heard(said)
    assert isinstance(outcome, Goals)
    (goal,) = outcome.goals
    assert isinstance(goal, If)
    assert len(goal.then) == len(goal.else_) == 1


def test_other_room_is_no_denial_of_what_was_asked() -> None:
    outcome = heard("go to the spa, no, don't go to the pantry, go to the suite")
    assert isinstance(outcome, Goals)
    assert len(outcome.goals) == 2


@pytest.mark.parametrize(
    "said",
    ["put the peach on the counter and switch it on", "take the bath towels inside"],
)
def test_what_may_be_either_is_asked(said: str) -> None:
    assert isinstance(heard(said), Question)


def test_what_is_only_taken_back_is_not_done() -> None:
    assert isinstance(heard("bring me the menu, oh no, don't bring it, I have one"), Refusal)


def test_said_later_is_still_said() -> None:
    outcome = heard("tell Ravi to hurry, otherwise we are late")
    assert isinstance(outcome, Goals)
    assert "otherwise we are late" in str(outcome.goals)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("keep walking until you are at the bar, and stop there", "go to the bar and stop there"),
        ("keep going till you're in the pantry", "go to the pantry"),
        ("go on until you come to the lift", "go to the lift"),
    ],
)
def test_walk_with_an_end_is_a_walk_there(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


@pytest.mark.parametrize("said", ["keep walking", "keep going forward", "go on with the tea"])
def test_walk_without_an_end_is_asked_about(said: str) -> None:
    assert not isinstance(heard(said), Goals)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("Furthest left on the bar there's a saucer, take it to Olga",
         "take the leftmost saucer on the bar to Olga"),
        ("on the far right of the counter is a menu, bring it to me",
         "bring me the rightmost menu on the counter"),
        ("under the side table there is a cap, give it to Hans",
         "there is a cap under the side table, give it to Hans"),
    ],
)  # fmt: skip
def test_where_something_is_may_be_told_first(said: str, plainly: str) -> None:
    assert_means_the_same(said, plainly)


def test_all_things_wanted_in_a_room_are_asked_about() -> None:
    outcome = heard("I want every bath towel in the spa")
    assert isinstance(outcome, Question)
    assert "spa" in outcome.question


def test_all_that_is_there_is_put_away() -> None:
    outcome = heard("on the trolley there's a saucer and a peach, put them in the bin")
    assert isinstance(outcome, Goals)
    assert [
        (goal.object.name, goal.object.at) for goal in outcome.goals if isinstance(goal, Place)
    ] == [
        ("saucer", "trolley"),
        ("peach", "trolley"),
    ]


def test_place_that_may_be_either_is_asked_about_where_it_is_told() -> None:
    world = Vocabulary.of(objects=["cup"], places=["low table", "high table", "sink"])
    outcome = parse("there are two cups on the table, put them in the sink", world)
    assert isinstance(outcome, Question)
