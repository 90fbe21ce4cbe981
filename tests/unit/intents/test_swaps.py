"""What is meant in place of what, told by name, of whichever order speaks of it."""

import pytest

from intents.dialogue import Dialogue
from intents.goals import Bring, Goal, GoTo, Person
from intents.grounding import Entity
from intents.outcomes import Goals, Question, Refusal
from intents.state import RobotState
from intents.swaps import swap
from intents.vocabulary import Thing, Vocabulary
from intents.wording import in_words

HOME = Vocabulary.of(
    objects=[Thing(name="mug", color="green"), Thing(name="mug", color="white"), "flask", "tin"],
    places=["bench", "rack"],
    people=["Ida"],
)
STATE = RobotState(
    doing="walk to the rack",
    entities=(
        Entity(id="m1", name="mug", color="green", at="bench"),
        Entity(id="m2", name="mug", color="white", at="rack"),
        Entity(id="f", name="flask", at="rack"),
        Entity(id="t", name="tin", at="rack"),
    ),
)


def after(*lines: str) -> Dialogue:
    dialogue = Dialogue(HOME)
    for line in lines:
        dialogue.hear(line, STATE)
    return dialogue


@pytest.mark.parametrize(
    ("before", "text", "meant"),
    [
        ("bring me the flask", "not the flask, the tin", "bring the tin to you"),
        ("bring me the flask", "no, not the flask but the tin", "bring the tin to you"),
        ("bring me the flask", "the tin, not the flask", "bring the tin to you"),
        ("bring me the flask", "the tin instead of the flask", "bring the tin to you"),
        ("bring me the flask", "take the tin instead of the flask", "bring the tin to you"),
        ("bring me the flask", "I meant the tin, not the flask", "bring the tin to you"),
        ("bring me the flask", "bring me the tin, not the flask", "bring the tin to you"),
        ("bring me the flask", "don't bring the flask, bring the tin", "bring the tin to you"),
        ("look at the green mug", "not the green one, the white one", "look at the white mug"),
        ("bring the flask to Ida", "not to Ida, to me", "bring the flask to you"),
        ("go to the bench", "not the bench, the rack", "go to the rack"),
        ("put the tin on the bench", "on the rack, not on the bench", "put the tin on the rack"),
    ],
)  # fmt: skip
def test_what_is_named_is_swapped(before: str, text: str, meant: str):
    turn = after(before).hear(text, STATE)
    assert isinstance(turn, Goals)
    assert turn.instead
    assert in_words(turn.goals) == meant


def test_which_is_asked_before_it_takes_the_place():
    dialogue = after("bring me the flask")
    assert isinstance(dialogue.hear("not the flask, the mug", STATE), Question)
    turn = dialogue.hear("the white one", STATE)
    assert isinstance(turn, Goals)
    assert turn.instead


def test_something_else_than_an_answer_takes_no_place():
    dialogue = after("bring me the flask")
    assert isinstance(dialogue.hear("not the flask, the mug", STATE), Question)
    turn = dialogue.hear("go to the rack", STATE)
    assert isinstance(turn, Goals)
    assert not turn.instead


@pytest.mark.parametrize(
    "text", ["put the tin on the rack, not on the bench", "go to the rack, not to the bench"]
)
def test_an_order_that_differs_in_more_is_one_of_its_own(text: str):
    turn = after("put the flask on the bench").hear(text, STATE)
    assert isinstance(turn, Goals)
    assert not turn.instead


@pytest.mark.parametrize(
    "text", ["not the mug, the tin", "not the flask, please", "not the flask", "the tin, please"]
)
def test_what_names_nothing_that_was_asked_for_swaps_nothing(text: str):
    turn = after("bring me the flask").hear(text, STATE)
    assert isinstance(turn, Question | Refusal)


def test_an_unknown_name_is_told():
    turn = after("bring me the flask").hear("not the flask, the plumbus", STATE)
    assert isinstance(turn, Refusal)
    assert "plumbus" in turn.reason


def test_the_order_that_speaks_of_it_is_known():
    dialogue = after("bring me the flask", "walk to the rack")
    goals: dict[str, tuple[Goal, ...]] = {}
    for line in ("bring the flask to Ida", "walk to the rack"):
        turn = Dialogue(HOME).hear(line, STATE)
        assert isinstance(turn, Goals)
        goals[line] = turn.goals
    assert dialogue.corrects("not the flask, the tin", goals["bring the flask to Ida"], STATE)
    assert not dialogue.corrects("not the flask, the tin", goals["walk to the rack"], STATE)
    assert isinstance(goals["walk to the rack"][0], GoTo)
    dialogue.about(goals["bring the flask to Ida"])
    turn = dialogue.hear("not the flask, the tin", STATE)
    assert isinstance(turn, Goals)
    assert isinstance(turn.goals[0], Bring)
    assert turn.goals[0].to == Person(name="Ida")


def test_the_parts_are_told_apart():
    found = swap("oh sorry, not the flask but the white mug, please")
    assert found is not None
    assert (found.old, found.new) == ("the flask", "the white mug")
    assert swap("not now") is None
    assert swap("do not go to the bench") is None
