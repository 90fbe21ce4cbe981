"""Bounds that no goal carries are asked about, whoever reads them; the others are not."""

import pytest

from intents.bounds import unkept
from intents.dialogue import Dialogue
from intents.goals import GoTo
from intents.grounding import Entity
from intents.outcomes import Goals, Question, Refusal
from intents.parser import hear, parse
from intents.state import RobotState
from intents.vocabulary import Thing, Vocabulary

HOME = Vocabulary.of(
    objects=[Thing(name="mug", color="green"), Thing(name="mug", color="white"), "flask"],
    places=["bench", "rack"],
    people=["Ida"],
)
ASKED = [
    "walk 4 metres, not more than 3",
    "walk 4 metres forward, no quicker than 0.3 metres per second",
    "walk to the bench, never faster than 1 km/h",
    "go to the rack without going faster than 0.2 m/s",
    "go to Ida, but not nearer than 1.5 metres",
    "go to the bench but not closer than a metre",
    "walk 2 metres forward, but not closer than 2 metres to the bench",
    "squat, but not lower than half way",
    "walk 3 metres forward, not exceeding 0.2 m/s",
    "pick up one of the mugs, whichever is white",
    "put a mug on the rack, whichever is heavier",
    "bring me a mug, whichever is closer",
    "go to the bench, at least 2 metres from it",
    "go to the rack, 2 metres away from it",
]
KEPT = [
    "walk at most 2 metres forward",
    "walk up to 3 metres",
    "turn no more than 30 degrees left",
    "wait at least 7 seconds",
    "pick up a mug, whichever you like",
    "bring me whichever mug is white",
    "bring me whatever mug is on the bench",
    "take the flask to Ida because she is up to her elbows in flour",
    "say it is no further than the moon",
]


@pytest.mark.parametrize("text", ASKED)
def test_a_bound_that_no_goal_carries_is_a_question(text: str):
    outcome = parse(text, HOME)
    assert isinstance(outcome, Question), outcome
    assert outcome.kind == "confirmation"
    walks = [goal.by.forward_m for goal in outcome.goals if isinstance(goal, GoTo) and goal.by]
    assert walks in ([], [2.0], [3.0], [4.0])
    assert not any(isinstance(goal, GoTo) and goal.pose for goal in outcome.goals)


@pytest.mark.parametrize("text", KEPT)
def test_a_bound_that_a_goal_carries_is_none_to_ask_about(text: str):
    assert isinstance(parse(text, HOME), Goals)


@pytest.mark.parametrize(
    "text", ["step 1 metre away from the bench", "walk 2 metres from the rack", "step off from it"]
)
def test_away_from_something_is_no_walk_forward(text: str):
    assert isinstance(parse(text, HOME), Refusal | Question)


@pytest.mark.parametrize(
    "text", ["go to x 2 y 1", "go to 2, 1", "walk to position 2 1", "go to the coordinates 2 and 1"]
)
def test_coordinates_have_a_form_of_their_own(text: str):
    outcome = parse(text, HOME)
    assert isinstance(outcome, Goals)
    assert [(goal.pose.x_m, goal.pose.y_m) for goal in outcome.goals] == [(2.0, 1.0)]


def test_a_bound_is_kept_to_by_no_goals_of_a_language_model_either():
    goals = (GoTo(place="bench"),)
    outcome, _ = hear(
        "zoom to the bench pronto like, no faster than 0.2 m/s",
        HOME,
        fallback=lambda *_: Goals(goals=goals, parser="model"),
    )
    assert isinstance(outcome, Question)
    assert outcome.parser != "model"  # so that no `--yes` agrees to it


def test_what_is_agreed_to_is_done_though_the_bound_is_not_kept():
    dialogue = Dialogue(HOME)
    state = RobotState(entities=(Entity(id="f", name="flask"),))
    assert isinstance(
        dialogue.hear("go to the bench, but not closer than a metre", state), Question
    )
    turn = dialogue.hear("yes", state)
    assert isinstance(turn, Goals)
    assert turn.goals == (GoTo(place="bench"),)


def test_no_bound_is_looked_for_where_nothing_is_asked_for():
    assert unkept("no faster than light", ()) == ""
