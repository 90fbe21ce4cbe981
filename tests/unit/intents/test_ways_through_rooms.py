"""A way through a room is two walks; and a colour tells which kind a common word means."""

import pytest

from intents.goals import to_builtins
from intents.outcomes import Goals, Question, Refusal
from intents.parser import parse
from intents.vocabulary import Spot, Thing, Vocabulary

HOUSE = Vocabulary.of(
    objects=[
        Thing(name="folder", category="folder"),
        *(Thing(name="coffee bowl", category="coffee bowl", color=c) for c in ("teal", "white")),
        *(Thing(name="sugar bowl", category="sugar bowl", color=c) for c in ("teal", "yellow")),
        Thing(name="jug", category="jug"),
    ],
    places=[Spot(name="back gate"), Spot(name="long bench", furniture=True)],
    rooms=["lobby", "studio", "boiler room"],
    people=["Ines"],
)


def walked(said: str) -> list[object]:
    outcome = parse(said, HOUSE)
    assert isinstance(outcome, Goals), outcome
    return [goal.get("place", goal["goal"]) for goal in to_builtins(outcome.goals)]


@pytest.mark.parametrize(
    ("said", "places"),
    [
        ("go through the boiler room to the back gate", ["boiler room", "back gate"]),
        ("walk through the lobby into the studio", ["lobby", "studio"]),
        ("go to the back gate through the boiler room", ["boiler room", "back gate"]),
        ("go to the studio, then through the lobby to the back gate",
         ["studio", "lobby", "back gate"]),
        ("go to the studio first, then through the lobby and on to the back gate",
         ["studio", "lobby", "back gate"]),
        ("go through the lobby to the studio and wave", ["lobby", "studio", "gesture"]),
        ("walk through the lobby and the boiler room into the studio, then wait at the back gate",
         ["lobby", "boiler room", "studio", "back gate", "wait"]),
        ("head through the lobby, then through the boiler room to the back gate",
         ["lobby", "boiler room", "back gate"]),
        ("walk through the boiler room", ["boiler room"]),
    ],
)  # fmt: skip
def test_a_way_through_a_room_is_gone_room_by_room(said: str, places: list[str]) -> None:
    assert walked(said) == places


def test_nobody_walks_through_furniture_and_a_load_is_put_down_once() -> None:
    assert not isinstance(parse("go through the long bench to the studio", HOUSE), Goals)
    carried = parse("take the folder through the lobby to the studio", HOUSE)
    goals = to_builtins(carried.goals) if isinstance(carried, Goals) else []
    assert [goal["goal"] for goal in goals] != ["place", "place"]


def test_the_words_of_a_message_stay_as_they_are() -> None:
    outcome = parse("tell Ines that she may go through the lobby to the studio", HOUSE)
    assert isinstance(outcome, Goals), outcome
    (say,) = to_builtins(outcome.goals)
    assert "through the lobby to the studio" in str(say["what"])


def test_a_colour_tells_which_of_two_kinds_is_meant() -> None:
    outcome = parse("put the jug between the yellow bowl and the white bowl", HOUSE)
    assert isinstance(outcome, Goals), outcome
    (goal,) = to_builtins(outcome.goals)
    assert goal["relation"] == {
        "how": "between",
        "of": {"name": "sugar bowl", "color": "yellow"},
        "other": {"name": "coffee bowl", "color": "white"},
    }
    assert isinstance(parse("take the teal bowl", HOUSE), Question)
    assert isinstance(parse("take the black bowl", HOUSE), Question | Refusal)
