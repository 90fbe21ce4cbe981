"""What a sentence means after another one: answers that point, and the last goal anew."""

import pytest
from msgspec.structs import replace

from intents.context import Context
from intents.goals import Goal, to_builtins
from intents.grounding import Entity
from intents.outcomes import Goals, Question
from intents.parser import hear
from intents.relations import Viewpoint
from intents.vocabulary import Thing, Vocabulary

WORDS = Vocabulary.of(
    objects=[Thing(name="jar", color="green"), Thing(name="jar", color="white"), "hammer"],
    places=["bench", "ledge"],
    people=["Emil", "Noor"],
)
SEEN = Context(
    entities=(
        Entity(id="a", name="jar", color="green", at="bench", p_WO=(2.0, 0.5, 0.8)),
        Entity(id="b", name="jar", color="white", at="ledge", p_WO=(2.0, -0.5, 0.8)),
        Entity(id="h", name="hammer", at="bench", p_WO=(2.0, 0.7, 0.8)),
    ),
    view=Viewpoint(x_m=0.0, y_m=0.0, yaw_rad=0.0),
)


def last_of(*turns: str) -> list[dict[str, object]]:
    context, outcome = SEEN, None
    for turn in turns:
        outcome, context = hear(turn, WORDS, context=context)
    assert isinstance(outcome, Goals), outcome
    return to_builtins(outcome.goals)


@pytest.mark.parametrize(
    ("answer", "color"),
    [
        ("the left one", "green"),
        ("the one on the right", "white"),
        ("the one on the ledge", "white"),
        ("the one next to the hammer", "green"),
        ("any", "green"),
    ],
)
def test_an_answer_may_point(answer: str, color: str) -> None:
    (goal,) = last_of("take the jar", answer)
    assert isinstance(goal["object"], dict)
    assert (goal["goal"], goal["object"]["color"]) == ("pick", color)


def test_both_are_all_of_them() -> None:
    (goal,) = last_of("look at the jar", "both")
    assert goal["object"] == {"name": "jar", "count": "all"}


def test_an_answer_that_points_at_another_thing_is_none() -> None:
    _, context = hear("take the jar", WORDS, context=SEEN)
    assert not isinstance(hear("the one behind the bench", WORDS, context=context)[0], Goals)


@pytest.mark.parametrize(
    ("before", "said", "plainly"),
    [
        ("put the hammer on the ledge", "and the green jar", "put the green jar on the ledge"),
        ("put the hammer on the ledge", "and the white jar on the bench",
         "put the white jar on the bench"),
        ("take the green jar", "now the other one", "take the white jar"),
        ("take the green jar", "now the white one", "take the white jar"),
        ("put the hammer on the ledge", "Okay, now the green jar.",
         "put the green jar on the ledge"),
        ("bring me the hammer", "now, the white jar please", "bring me the white jar"),
        ("bring me the hammer", "what about the white jar?", "bring me the white jar"),
        ("greet Emil", "and Noor", "greet Noor"),
        ("walk forward 20 cm", "a bit more", "walk forward 10 cm"),
        ("open the drawer", "and the fridge", "open the fridge"),
    ],
)  # fmt: skip
def test_what_follows_does_the_last_goal_anew(before: str, said: str, plainly: str) -> None:
    assert last_of(before, said) == last_of(plainly)


@pytest.mark.parametrize("said", ["more", "and the hammer", "the other one"])
def test_nothing_follows_nothing(said: str) -> None:
    assert not isinstance(hear(said, WORDS)[0], Goals)


@pytest.mark.parametrize("said", ["now the hammer is on the bench", "now where is the hammer"])
def test_what_is_told_or_asked_now_is_no_other_thing(said: str) -> None:
    outcome, _ = hear("take the green jar", WORDS, context=SEEN)
    assert isinstance(outcome, Goals)
    told, _ = hear(said, WORDS, context=replace(SEEN, goals=outcome.goals))
    assert not (isinstance(told, Goals) and to_builtins(told.goals)[0].get("kind") == "pick")


def test_beside_another_thing_is_where_that_thing_stands() -> None:
    outcome, _ = hear("put the hammer on the ledge next to the green jar", WORDS)
    assert to_builtins(_goals(outcome)) == last_of("put the hammer next to the green jar")


def test_a_sentence_cut_off_is_completed_by_the_next() -> None:
    outcome, context = hear("put the hammer on the", WORDS)
    assert isinstance(outcome, Question)
    assert to_builtins(_goals(hear("ledge", WORDS, context=context)[0])) == last_of(
        "put the hammer on the ledge"
    )


def _goals(outcome: object) -> tuple[Goal, ...]:
    assert isinstance(outcome, Goals), outcome
    return outcome.goals
