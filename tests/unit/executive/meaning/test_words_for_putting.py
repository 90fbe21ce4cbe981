"""Words of where a thing is put: beside what, on which part, what is there already."""

from __future__ import annotations

import math

import msgspec
import pytest

from executive.blackboard import HELD, Blackboard
from executive.meaning.request import Refused, Understood, meant
from executive.meaning.robot_state import state_of
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.say import SayParams
from executive.trees.parts import Branch, Kept, Part, Settle, errands, walk
from intents import goals
from robot.failures import Failure
from tests.fakes.mugs import (
    OIL,
    SEEN,
    WHERE,
    board,
    parts,
    understood,
)


def put(text: str, blackboard: Blackboard) -> PlaceParams:
    """What the skill is asked for by the end of a sentence."""
    *_, last = (e for e in errands(understood(text).task) if e.carries)
    assert callable(last.params)
    params = last.params(blackboard)
    assert isinstance(params, PlaceParams), params
    return params


@pytest.mark.parametrize(("said", "spot"), SEEN.items())
def test_beside_a_thing_is_where_it_would_be_called_so(said, spot):
    seen = board(oil=OIL, wine=(0.8, 2.4))
    params = put(f"put the red mug {said}", seen)
    assert params.place_id == "counter"
    (asked,) = parts(f"take the mug {said}", Settle)
    for x_m, y_m in params.spots:
        assert asked.question(board(oil=OIL, wine=(0.8, 2.4), red=(x_m, y_m))) == ("red",)
        if "between" not in said:
            assert 0.07 < math.dist((x_m, y_m), OIL) <= 0.3
    assert len(params.spots) >= 5


def test_the_landmark_is_found_before_a_thing_is_put_beside_it():
    names = [e.name for e in errands(understood("put the red mug next to the oil bottle").task)]
    assert names.index("find the oil bottle") < len(names) - 1
    unseen = board()
    *_, last = (e for e in errands(understood("put the red mug next to the oil bottle").task))
    assert isinstance(last.params(unseen), Failure)


@pytest.mark.parametrize(
    ("part", "holds"),
    [
        ("in the middle of", lambda x, y: math.hypot(x, y) < 0.2),
        ("at the other end of", lambda x, y: x > 0.4),  # the robot stands at the near one
        ("at the edge of", lambda x, y: min(1.0 - abs(x), 0.3 - abs(y)) < 0.13),
    ],
)
def test_a_part_of_a_surface_is_that_part(part, holds):
    params = put(f"put the red mug {part} the table", board(at=(-1.0, -0.8)))
    assert params.spots
    assert all(holds(x_m, y_m) for x_m, y_m in params.spots)


@pytest.mark.parametrize("said", ["bring the red mug to the front door", "take {} to the hall"])
def test_a_spot_of_the_floor_is_a_place_to_be_with_a_thing(said):
    outcome = understood(said.format("the red mug"))
    *_, go, tell = errands(outcome.task)
    assert isinstance(go.params, NavigateParams)
    assert isinstance(tell.params, SayParams)
    assert "red mug" in tell.params.text
    assert outcome.holds == ("red",)


def test_a_room_with_furniture_is_a_place_to_put_things():
    *_, last = errands(understood("bring the red mug to the kitchen").task)
    assert isinstance(last.params, PlaceParams)
    assert last.params.place_id in ("counter", "table")


def put_where(believed: Blackboard) -> Part:
    """What "put the red mug on the table" means when that is believed."""
    goal = goals.Place(object=goals.ObjectQuery(name="red"), on="table")
    state = state_of(believed, WHERE.knowledge)
    held = tuple(believed.read(HELD).values())
    found = meant("put the red mug on the table", (goal,), WHERE, held=held, state=state)
    assert isinstance(found, Understood), found
    return found.task


def test_what_is_believed_to_be_there_already_is_left_there_and_told():
    (branch,) = (
        part for _, part in walk(put_where(board(red=(0.2, 0.1)))) if isinstance(part, Branch)
    )
    assert branch.question(board(red=(0.2, 0.1)))
    (tell,) = errands(branch.then)
    assert isinstance(tell.params, SayParams)
    assert tell.params.text == "The red mug is on the table already."
    assert not branch.question(board(red=(0.2, 2.5)))
    assert [type(one.params) for one in errands(branch.otherwise)] == [PickParams, PlaceParams]


@pytest.mark.parametrize("believed", [board(red=(0.2, 2.5)), board(left="red"), board()])
def test_what_is_elsewhere_or_in_the_hand_is_put_without_a_question(believed):
    assert not [part for _, part in walk(put_where(believed)) if isinstance(part, Branch)]


@pytest.mark.parametrize(
    "goal",
    [
        goals.Pick(object=goals.ObjectQuery(name="red")),
        goals.Place(object=goals.ObjectQuery(name="red"), on="table"),
        goals.Bring(object=goals.ObjectQuery(name="red"), to=goals.Person(who="operator")),
    ],
)
def test_what_somebody_has_is_not_taken_from_them(goal):
    believed = board(given="red")
    state = state_of(believed, WHERE.knowledge)
    refused = meant("do it", (goal,), WHERE, state=state)
    assert isinstance(refused, Refused)
    assert (refused.reason, refused.suggestion) == ("mia has the red mug", "ask mia to put it down")


@pytest.mark.parametrize("text", ["collect all mugs and put them on the table",
                                  "pick up all mugs and bring them to the table"])  # fmt: skip
def test_who_takes_all_and_puts_them_somewhere_leaves_those_that_are_there(text):
    """A book that was in place was taken out of its shelf and put back."""
    asked = [part for part in parts(text, Branch) if "there already" in part.name]
    assert {part.name for part in asked} == {
        f"is the {color} mug there already" for color in ("red", "blue", "green")
    }
    assert all(part.question(board(red=(0.1, 0.0))) for part in asked if "red" in part.name)
    assert not any(part.question(board(blue=(0.1, 2.5))) for part in asked if "blue" in part.name)


@pytest.mark.parametrize(
    ("text", "checked"),
    [
        ("put the red mug on the table", True),
        ("pick up the red mug", True),
        ("go to the table", False),
        ("find all mugs", False),
    ],
)
def test_what_is_put_down_is_compared_at_the_end(text, checked):
    assert bool(parts(text, Kept)) is checked


def test_what_fell_or_was_taken_away_is_named():
    (part,) = parts("put the red mug on the table", Kept)
    assert isinstance(part, Kept)
    put_down = {"red": "table"}
    assert part.gone(board(red=(0.2, 0.1)), put_down, ()) == []
    assert part.gone(board(red=(0.2, 2.5)), put_down, ()) == ["the red mug on the table"]
    assert part.gone(board(), put_down, ()) == []


def test_what_was_taken_and_is_not_held_is_named():
    (part,) = parts("pick up the red mug", Kept)
    assert isinstance(part, Kept)
    assert part.gone(board(red=(0.2, 0.1)), {}, {"red"}) == ["the red mug in the hand"]
    assert part.gone(board(left="red"), {}, {"red"}) == []


def test_what_was_taken_from_beside_something_is_put_where_it_goes():
    """The place that it goes to is said with it: "put it in the kitchen on the table"."""
    beside = goals.Relation(how="near", of=goals.ObjectQuery(name="tea box"))
    mug = goals.ObjectQuery(name="mug", relation=beside)
    put = goals.Place(object=msgspec.structs.replace(mug, at="kitchen"), on="table")
    outcome = meant("", (goals.Pick(object=mug), put), WHERE)
    assert isinstance(outcome, Understood)
    (settle,) = [part for _, part in walk(outcome.task) if isinstance(part, Settle)]
    assert isinstance(settle.then(("blue",)), Part)
    done = [type(one.params) for one in errands(settle.then(("blue",)))]
    assert done == [PickParams, PlaceParams]
