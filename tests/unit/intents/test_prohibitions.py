"""What is not to be done, heard in any sentence, and goals that go against it."""

import pytest

from benchmarks.intents.replies import HOME
from intents import goals as g
from intents.goals import Goal, ObjectQuery
from intents.prohibitions import broken

RED = ObjectQuery(name="mug", color="red")
WHITE = ObjectQuery(name="mug", color="white")
PLATE = ObjectQuery(name="plate")


def put(query: ObjectQuery, on: str = "sideboard") -> Goal:
    return g.Place(object=query, on=on)


BREAKS = {
    "tidy up but don't touch the red mug": put(RED),
    "without touching the plate, tidy up": g.Bring(object=PLATE, to="sofa"),
    "tidy up and leave the plate alone": g.Pick(object=PLATE),
    "the plate must not be moved, tidy the rest": put(PLATE),
    "clear everything except the plate": g.ForEach(
        object=ObjectQuery(at="coffee table"), goals=(put(ObjectQuery(held=True)),)
    ),
    "never mind me, but stay out of the study": g.GoTo(place="study"),
    "do not put anything on the sofa": put(RED, "sofa"),
    "hands off the dishes": put(ObjectQuery(category="dish")),
    "don't take anything from the sofa": put(ObjectQuery(name="tea towel", at="sofa")),
    "don't touch the mugs": put(WHITE),
    "whatever you do, do not go near the dishwasher": g.Place(object=PLATE, in_="dishwasher"),
}
KEEPS = {
    "tidy up but don't touch the red mug": put(WHITE),
    "do not put the plate on the sofa": put(PLATE),
    "clear everything except the plate": g.ForEach(
        object=ObjectQuery(at="coffee table", except_=PLATE), goals=(g.Wait(),)
    ),
    "I do not know where the plate is": put(PLATE),
    "why don't you put the plate away": put(PLATE),
    "not only the plate but also the mugs": put(PLATE),
    "the plate is not on the sofa": put(PLATE, "sofa"),
    "don't touch the plate": g.LookAt(object=PLATE),
    "leave the plate on the sofa": put(PLATE, "sofa"),
    "do not make a mess": put(PLATE),
}


@pytest.mark.parametrize(("said", "goal"), BREAKS.items())
def test_what_is_not_to_be_done_is_found_in_a_plan(said: str, goal: Goal) -> None:
    assert "the person said" in broken((goal,), (said,), HOME)


@pytest.mark.parametrize(("said", "goal"), KEEPS.items())
def test_nothing_else_is(said: str, goal: Goal) -> None:
    assert broken((goal,), (said,), HOME) == ""


def test_it_is_found_at_any_depth() -> None:
    deep = g.Repeat(times=2, goals=(g.If(condition=g.Present(object=RED), then=(put(RED),)),))
    assert broken((deep,), ("keep your hands off the red mug",), HOME)
