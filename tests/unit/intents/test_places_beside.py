"""Where things are put relative to others, parts of places, rounds: what is said and what it is."""

from __future__ import annotations

import pytest

from intents.context import Context
from intents.goals import Repeat, to_builtins
from intents.grounding import Entity
from intents.numbers import Noun, plural
from intents.outcomes import Goals, Question, Refusal
from intents.parser import parse
from intents.vocabulary import Thing, Vocabulary
from intents.wording import in_words

SHED = Vocabulary.of(
    objects=[
        Thing(name="jar", color="red", category="jar"),
        Thing(name="jar", color="blue", category="jar"),
        Thing(name="oil can", category="can"),
        Thing(name="glue bottle", category="bottle"),
    ],
    places=["bench", "cabinet", "gate"],
    rooms=["workroom", "yard", "office"],
    people=["ada"],
    categories={"jar": "jars", "can": "cans", "bottle": "bottles"},
)
UNSEEN = tuple(
    Entity(id=name.replace(" ", "_"), name=name.split(" ", 1)[1], color=name.split(" ")[0])
    for name in ("red jar", "blue jar", "green jar")
)
RED = {"name": "jar", "color": "red"}
NEAR_CABINET = {"how": "near", "of": {"name": "cabinet"}}
CAN, GLUE = {"name": "oil can"}, {"name": "glue bottle"}


def goals(text: str, **context: object) -> list[dict[str, object]]:
    outcome = parse(text, SHED, context=Context(**context))  # type: ignore[arg-type]
    assert isinstance(outcome, Goals), outcome
    return to_builtins(outcome.goals)


@pytest.mark.parametrize(
    ("said", "how"),
    [
        ("next to", "near"), ("beside", "near"), ("close to", "near"), ("left of", "left"),
        ("to the left of", "left"), ("to the right of", "right"), ("behind", "behind"),
        ("in front of", "in_front"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("verb", ["put", "place", "move", "set"])
def test_beside_a_thing_is_a_place_to_put_another(verb: str, said: str, how: str) -> None:
    (goal,) = goals(f"{verb} the red jar {said} the oil can")
    assert goal == {"goal": "place", "object": RED, "relation": {"how": how, "of": CAN}}
    assert "oil can" in in_words(parse(f"put the red jar {said} the oil can", SHED).goals)  # type: ignore


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("put the red jar between the oil can and the glue bottle",
         {"relation": {"how": "between", "of": CAN, "other": GLUE}}),
        ("put the red jar on the bench next to the oil can",
         {"relation": {"how": "near", "of": CAN}}),
        ("put the red jar at the other end of the bench", {"on": "bench", "part": "other_end"}),
        ("move the red jar to the far end of the bench", {"on": "bench", "part": "other_end"}),
        ("put the red jar in the middle of the bench", {"on": "bench", "part": "middle"}),
        ("put the red jar at the edge of the bench", {"on": "bench", "part": "edge"}),
    ],
)  # fmt: skip
def test_the_place_is_as_it_was_said(text: str, place: dict[str, object]) -> None:
    assert goals(text) == [{"goal": "place", "object": RED, **place}]


@pytest.mark.parametrize("where", ["next to", "beside", "by", "near", "close to"])
@pytest.mark.parametrize("verb", ["put", "set", "move", "leave", "take the oil can and put"])
def test_next_to_furniture_is_a_place_to_put_a_thing(verb: str, where: str) -> None:
    *_, goal = goals(f"{verb} the red jar {where} the cabinet")
    assert goal == {"goal": "place", "object": RED, "relation": NEAR_CABINET}
    again = in_words(parse(f"put the red jar {where} the cabinet", SHED).goals)  # type: ignore
    assert goals(again)[-1] == goal


def test_next_to_furniture_in_a_room_keeps_the_room() -> None:
    (goal,) = goals("put the oil can next to the cabinet in the yard")
    near = {"how": "near", "of": {"name": "cabinet", "at": "yard"}}
    assert goal == {"goal": "place", "object": CAN, "relation": near}


def test_a_room_is_nothing_to_put_a_thing_next_to() -> None:
    assert isinstance(parse("put the red jar next to the office", SHED), Refusal)


@pytest.mark.parametrize("where", ["behind", "in front of", "to the left of"])
def test_furniture_has_no_sides_to_put_a_thing_on(where: str) -> None:
    assert isinstance(parse(f"put the red jar {where} the bench", SHED), Refusal)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("go to the other end of the yard", "other_end"),
        ("walk to the far end of the yard", "other_end"),
        ("go to the middle of the yard", "middle"),
    ],
)
def test_a_part_of_a_room_is_walked_to(text: str, part: str) -> None:
    assert goals(text) == [{"goal": "go_to", "place": "yard", "part": part}]


@pytest.mark.parametrize(
    ("often", "times"), [("", 1), (" once", 1), (" twice", 2), (" three times", 3), (" 4 times", 4)]
)
@pytest.mark.parametrize("rounds", ["patrol {}", "patrol through {}", "do your rounds in {}"])
def test_a_patrol_passes_all_that_was_named_so_often(rounds: str, often: str, times: int) -> None:
    outcome = parse(rounds.format("the yard, the office and the workroom") + often, SHED)
    assert isinstance(outcome, Goals), outcome
    (goal, *_) = outcome.goals
    found = goal.goals * goal.times if isinstance(goal, Repeat) else outcome.goals
    assert [g["place"] for g in to_builtins(found)] == ["yard", "office", "workroom"] * times


def test_there_is_where_was_spoken_of() -> None:
    *_, goal = goals("go to the office and bring the red jar there")
    assert goal == {"goal": "bring", "object": RED, "to": "office"}


@pytest.mark.parametrize(
    "which",
    ["the jar behind the oil can", "the jar next to the oil can", "the jar on the bench",
     "the jar between the oil can and the glue bottle", "the leftmost jar"],
)  # fmt: skip
@pytest.mark.parametrize("what", ["pick up {}", "put {} on the cabinet", "bring {} to the office"])
def test_what_looking_settles_is_not_asked_back_blind(what: str, which: str) -> None:
    landmarks = (Entity(id="can", name="oil can"), Entity(id="glue", name="glue bottle"))
    assert goals(what.format(which), entities=UNSEEN + landmarks)


@pytest.mark.parametrize("then", ["bring it to the office", "put it on the cabinet"])
def test_it_is_what_was_taken_from_where_it_was_said_to_be(then: str) -> None:
    took, moved = goals(f"take the jar on the bench and {then}", entities=UNSEEN)
    assert took["object"] == {"name": "jar", "at": "bench"}
    assert moved["object"] == {"name": "jar"}


def test_what_looking_does_not_settle_is_asked() -> None:
    assert isinstance(parse("pick up the jar", SHED, context=Context(entities=UNSEEN)), Question)


@pytest.mark.parametrize(
    ("one", "many"),
    [
        ("box", "boxes"), ("spray can", "spray cans"), ("torch", "torches"), ("knife", "knives"),
        ("battery", "batteries"), ("toy", "toys"), ("glass", "glasses"), ("brush", "brushes"),
        ("potato", "potatoes"), ("quiz", "quizzes"), ("pliers", "pliers"),
    ],
)  # fmt: skip
def test_plurals_are_english(one: str, many: str) -> None:
    assert plural(one) == many
    assert Noun(one, many).of(1) == one
    assert Noun(one, many).of(0) == Noun(one, many).of(2) == many
