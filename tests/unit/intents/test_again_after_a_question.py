"""What "again" repeats: an order, however much was asked since."""

import pytest

from intents.dialogue import Dialogue
from intents.goals import Gesture
from intents.grounding import Entity
from intents.outcomes import Goals, Reply
from intents.state import RobotState
from intents.vocabulary import Spot, Thing, Vocabulary

WORDS = Vocabulary.of(
    objects=[Thing(name="cup", color="red"), Thing(name="cup", color="blue")],
    places=[Spot(name="table", furniture=True)],
    rooms=[],
    people=[],
    categories={},
)
STATE = RobotState(
    entities=(
        Entity(id="red", name="cup", color="red", at="table"),
        Entity(id="blue", name="cup", color="blue", at="table"),
    )
)


@pytest.mark.parametrize("text", ["again", "once more", "do it again", "Again, please!"])
def test_a_question_in_between_is_not_what_is_done_again(text):
    dialogue = Dialogue(WORDS)
    first = dialogue.hear("wave", STATE)
    assert isinstance(dialogue.hear("where is the red cup?", STATE), Reply)
    turn = dialogue.hear(text, STATE)
    assert isinstance(first, Goals) and isinstance(turn, Goals)
    assert [type(goal) for goal in turn.goals] == [Gesture]


def test_without_an_order_the_question_is_answered_again():
    dialogue = Dialogue(WORDS)
    told = dialogue.hear("where is the red cup?", STATE)
    again = dialogue.hear("again", STATE)
    assert isinstance(told, Reply) and isinstance(again, Reply)
    assert again.text == told.text


def test_what_follows_a_question_is_about_that_still():
    dialogue = Dialogue(WORDS)
    dialogue.hear("wave", STATE)
    dialogue.hear("where is the red cup?", STATE)
    turn = dialogue.hear("and the blue one?", STATE)
    assert isinstance(turn, Reply)
    assert "blue" in turn.text
