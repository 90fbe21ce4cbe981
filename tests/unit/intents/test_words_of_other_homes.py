"""Wishes as people type them in any home: told plainly or roundabout, they are the same goals."""

import pytest

from intents.english.words.lexer import singular
from intents.goals import Find, If, ObjectQuery, Present, Report, Say, to_builtins
from intents.outcomes import Goals
from intents.parser import parse
from intents.vocabulary import Thing, Vocabulary

LIBRARY = Vocabulary.of(
    objects=[
        Thing(name="thermos", category="thermos", color="teal"),
        Thing(name="thermos", category="thermos", color="steel"),
        Thing(name="paint can", category="can", color="cream"),
        Thing(name="paint can", category="can", color="red"),
        Thing(name="cream can", category="can"),
        Thing(name="battery", category="battery"),
        Thing(name="pen", category="pen"),
        Thing(name="ruler", category="ruler"),
    ],
    places=[
        "desk", "cart", "oak bookcase", "upper oak bookcase", "lower oak bookcase", "shelf",
        "upper shelf", "lower shelf", "left file rack", "middle left file rack", "gate",
    ],
    rooms=["archive", "hall", "reading room"],
    people=["Ada", "Emil"],
    categories={"thermos": "thermoses", "can": "cans", "battery": "batteries", "pen": "pens"},
)  # fmt: skip


def _goals(said: str) -> list[dict[str, object]] | str:
    outcome = parse(said, LIBRARY)
    return to_builtins(outcome.goals) if isinstance(outcome, Goals) else repr(outcome)


@pytest.mark.parametrize(
    ("said", "plainly"),
    [
        ("put the pen on the upper board of the oak bookcase",
         "put the pen on the upper oak bookcase"),
        ("put the pen on the bottom shelf of the oak bookcase",
         "put the pen on the lower oak bookcase"),
        ("bring the pen to the middle board of the left file rack",
         "bring the pen to the middle left file rack"),
        ("get me the pen and leave it on the desk", "pick up the pen and put it on the desk"),
        ("Ada needs the pens, bring them to her", "bring the pens to Ada"),
        ("Ada needs the pens", "bring the pens to Ada"),
        ("put the pen on the oak bookcase, top board", "put the pen on the upper oak bookcase"),
        ("put the pen on the oak bookcase top board", "put the pen on the upper oak bookcase"),
        ("put the pen on the oak bookcase, the lowest shelf",
         "put the pen on the lower oak bookcase"),
        ("bring the pen from the oak bookcase, bottom board, to the desk",
         "bring the pen from the lower oak bookcase to the desk"),
        ("how many cans are on the top level of the shelf?",
         "how many cans are on the upper shelf?"),
        ("take the teal thermos to the desk", "put the teal thermos on the desk"),
        ("put the cream paint can on the desk", "place the cream paint can on the desk"),
        ("take the pen and also the ruler to the cart", "put the pen and the ruler on the cart"),
        ("take both the pen and the ruler to the cart", "put the pen and the ruler on the cart"),
        ("the pen belongs on the cart, take it there please", "put the pen on the cart"),
        ("the pen belongs next to the ruler, put it there", "put the pen next to the ruler"),
        ("bring the pen and put it next to the ruler",
         "pick up the pen and put it next to the ruler"),
        ("search for the pen and come to the gate with it",
         "look for the pen and take it to the gate"),
        ("I need the pen on the cart", "put the pen on the cart"),
        ("I would like to have the teal thermos on the cart", "put the teal thermos on the cart"),
        ("I'd like both thermoses on the cart", "put both thermoses on the cart"),
        ("gather the thermoses on the desk", "put all thermoses on the desk"),
        ("collect all the pens on the desk", "put all pens on the desk"),
        ("do a round through all the rooms and then come back here to the archive",
         "go to every room, then go to the archive"),
        ("put the pens from the desk and the cart on the oak bookcase",
         "put all pens from the desk on the oak bookcase, "
         "then put all pens from the cart on the oak bookcase"),
        ("bring all cans from the desk and the gate to the cart",
         "bring all cans from the desk to the cart, then bring all cans from the gate to the cart"),
        ("patrol all rooms twice", "patrol the archive, the hall and the reading room twice"),
        ("clear the pens off the desk and put them on the cart",
         "take all pens from the desk and put them on the cart"),
        ("walk over to the hall, and from there to the archive",
         "go to the hall, then to the archive"),
        ("would you patrol the hall and the archive twice?",
         "patrol the hall and the archive twice"),
        ("do two rounds through the hall and the archive", "patrol the hall and the archive twice"),
        ("make one tour of the hall and the archive", "patrol the hall and the archive"),
        ("go and see how many cans there are in the hall", "how many cans are in the hall?"),
        ("if the desk has no can on it, put the pen there",
         "if there is no can on the desk, put the pen there"),
        ("put the pen on the desk if there is no can on it yet",
         "put the pen on the desk if there is no can on the desk"),
        ("put the pen on the desk, but only if there is no can there yet",
         "put the pen on the desk if there is no can on the desk"),
        ("if the pen is still on the desk bring it to the cart, else walk to the gate",
         "if the pen is on the desk, bring it to the cart, otherwise go to the gate"),
        ("check whether there is a can on the desk. if there is, take it to the cart",
         "if there is a can on the desk, take it to the cart"),
        ("should there be a can on the desk, take it to the cart",
         "if there is a can on the desk, take it to the cart"),
        ("is there a can on the desk? if so, put it on the cart",
         "if there is a can on the desk, put it on the cart"),
        ("look if there's a can on the desk; if yes, put it on the cart, if no, go to the gate",
         "if there is a can on the desk, put it on the cart, otherwise go to the gate"),
        ("check if the pen is on the desk. if it is, bring it to the cart, if not, go to the gate",
         "if the pen is on the desk, bring it to the cart, otherwise go to the gate"),
        ("check if the pen is on the desk. if it is not, go to the gate",
         "if the pen is not on the desk, go to the gate"),
        ("go to the gate if the pen is not on the desk, otherwise put it on the cart",
         "if the pen is not on the desk, go to the gate, "
         "otherwise put the pen from the desk on the cart"),
        ("put a can on the cart if there is one on the desk",
         "if there is a can on the desk, put it on the cart"),
    ],
)  # fmt: skip
def test_said_roundabout_it_is_the_same(said: str, plainly: str):
    goals = _goals(plainly)
    assert isinstance(goals, list), goals
    assert _goals(said) == goals


def test_a_side_that_belongs_to_a_name_is_no_side():
    assert _goals("put the pen on the left file rack") == [
        {"goal": "place", "object": {"name": "pen"}, "on": "left file rack"}
    ]
    (goal,) = _goals("pick up the pen on the left")
    assert goal == {"goal": "pick", "object": {"name": "pen", "superlative": "leftmost"}}


def test_what_is_not_there_is_fetched_from_wherever_it_is():
    for said in (
        "if the pen is not on the desk, put it there",
        "is the pen on the desk? if not, put it there",
    ):
        outcome = parse(said, LIBRARY)
        assert isinstance(outcome, Goals)
        (goal,) = outcome.goals
        assert isinstance(goal, If)
        there = ObjectQuery(name="pen", at="desk")
        assert goal.condition == Present(object=there, negated=True)
        assert to_builtins(goal.then) == _goals("put the pen on the desk")


def test_a_question_whose_answer_decides_nothing_is_still_answered():
    outcome = parse("check whether the pen is on the desk. then go to the gate", LIBRARY)
    assert isinstance(outcome, Goals)
    assert outcome.goals[0] == Find(object=ObjectQuery(name="pen", at="desk"))


def test_any_of_them_are_all_of_them():
    said = "are there any cans on the desk? if there are, take them to the cart"
    outcome = parse(said, LIBRARY)
    assert isinstance(outcome, Goals)
    (goal,) = outcome.goals
    assert isinstance(goal, If)
    assert to_builtins(goal.then) == _goals("bring all cans on the desk to the cart")


@pytest.mark.parametrize("what", ["the pen", "two pens"])
def test_one_thing_is_not_taken_from_two_places(what: str):
    """The second place was dropped without a word."""
    assert not isinstance(_goals(f"put {what} from the desk and the cart on the bookcase"), list)


@pytest.mark.parametrize("verb", ["gather", "collect"])
def test_gathered_to_be_put_elsewhere_they_are_taken_from_there(verb: str):
    said = f"{verb} all the pens on the desk and put them on the cart"
    assert _goals(said) == _goals("pick up all the pens on the desk and put them on the cart")


@pytest.mark.parametrize(
    "said",
    [
        "collect all the pens on the desk and bring them to Ada",
        "collect all the pens from the desk",
        "collect the pens on the desk",
    ],
)
def test_what_is_collected_for_something_else_is_where_it_was_said(said: str):
    assert _goals(said)[0].get("object", {}).get("at") == "desk"


def test_what_is_only_passed_on_is_said_as_it_was_written():
    outcome = parse("tell Ada that it is raining", LIBRARY)
    assert isinstance(outcome, Goals)
    assert [goal.what for goal in outcome.goals if isinstance(goal, Say)] == ["it is raining"]


@pytest.mark.parametrize("said", ["how many batteries are on the desk?", "count the batteries"])
def test_things_that_a_robot_has_too_are_counted(said: str):
    assert "battery" in str(_goals(said))


def test_the_robots_own_battery_is_reported_on():
    outcome = parse("how is your battery?", LIBRARY)
    assert isinstance(outcome, Goals)
    assert outcome.goals == (Report(topic="health"),)


def test_plurals_of_words_in_os():
    assert singular("thermoses") == "thermos"
