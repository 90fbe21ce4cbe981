"""A plan that is asked about: its numbers, and the words that change it."""

import pytest

from benchmarks.intents.replies import HOME
from intents import goals as g
from intents import plans
from intents.goals import ObjectQuery
from intents.outcomes import Question

PLAN = (
    g.Place(object=ObjectQuery(name="plate"), in_="dishwasher"),
    g.Pick(object=ObjectQuery(name="mug", color="red")),
    g.GoTo(place="study"),
    g.Place(object=ObjectQuery(held=True), on="sideboard"),
    g.Place(object=ObjectQuery(name="mug", color="white"), on="sofa"),
    g.Gesture(kind="wave"),
)
ASKED = Question(question="?", goals=PLAN, kind="confirmation", parser="model")
CHANGES = {
    "skip three": [1, 2, 4, 5, 6],
    "no, skip step 2": [1, 3, 5, 6],  # the mug is not fetched, so it is not put anywhere
    "yes, but skip the waving": [1, 2, 3, 4, 5],
    "skip one and skip two": [3, 5, 6],
    "skip two to four": [1, 5, 6],
    "leave the red mug out": [1, 3, 5, 6],
    "without the last one": [1, 2, 3, 4, 5],
    "not the plate": [2, 3, 4, 5, 6],
    "but don't touch the plate, please": [2, 3, 4, 5, 6],
    "everything but the wave": [1, 2, 3, 4, 5],
    "only one and six": [1, 6],
    "only four": [2, 4],  # which is done with what two fetches
    "just the plate": [1],
    "first the mugs": [2, 4, 5, 1, 3, 6],
    "the mugs first please": [2, 4, 5, 1, 3, 6],
    "start with number six": [6, 1, 2, 3, 4, 5],
    "the plate last": [2, 3, 4, 5, 6, 1],
    "what is on the couch at the end": None,
    "5 before 1": [5, 1, 2, 3, 4, 6],
    "do one after six": [2, 3, 4, 5, 6, 1],
    "swap one and five": [5, 2, 3, 4, 1, 6],
    "first wave, then skip the plate": [6, 2, 3, 4, 5],
    "yes": None,
    "no": None,
    "bring me the plate": None,
    "put the plate on the sofa instead": None,
    "first the piano": None,
    "skip " * 100: None,
}


@pytest.mark.parametrize(("said", "left"), CHANGES.items())
def test_words_change_a_plan_or_are_none_of_its(said: str, left: list[int] | None) -> None:
    changed = plans.changed(said, ASKED, HOME)
    if left is None:
        assert changed is None
    else:
        assert changed is not None
        assert [PLAN.index(goal) + 1 for goal in changed.goals] == left
        assert "Shall I?" in changed.question
        assert changed.parser == "model"


@pytest.mark.parametrize(
    ("said", "told"),
    [("skip nine", "There is no step 9."), ("9 first", "There is no step 9."),
     ("skip the piano", "No step speaks of “the piano”"),
     ("skip one to six", "Nothing is left"), ("skip all of it", "say “no”"),
     ("first one", "That is so already")],
)  # fmt: skip
def test_what_cannot_be_changed_is_said_and_changes_nothing(said: str, told: str) -> None:
    changed = plans.changed(said, ASKED, HOME)
    assert changed is not None
    assert told in changed.question
    assert changed.goals == PLAN


def test_several_steps_are_shown_by_numbers_and_one_in_a_sentence() -> None:
    asked = plans.proposal(PLAN[:2], "it is sharp")
    assert asked == (
        "I shall do this; it is sharp:\n"
        "  1. put the plate into the dishwasher\n"
        "  2. pick up the red mug\n"
        "Shall I?"
    )
    assert plans.proposal(PLAN[:1], "") == "I shall put the plate into the dishwasher. Shall I?"


def test_only_what_asks_whether_to_do_several_things_is_a_plan() -> None:
    one = Question(question="?", goals=PLAN[:1], kind="confirmation")
    which = Question(question="?", goals=PLAN, kind="choice")
    assert plans.changed("skip one", one, HOME) is None
    assert plans.changed("skip one", which, HOME) is None
