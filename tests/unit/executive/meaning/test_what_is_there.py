"""What is on a table is what is believed to be there by then: not what the world began with."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from executive.blackboard import GIVEN, HELD, WORLD, Blackboard
from executive.engine.handled import Handled
from executive.meaning import answers, request
from executive.meaning.knowledge import Knowledge
from executive.meaning.robot_state import state_of
from executive.skills.holding import Held, Holdings
from executive.trees.parts import Branch, Settle, errands, walk
from intents.goals import ObjectQuery, Pick, Place, from_builtins
from intents.grounding import Entity, Unknown, ground
from intents.numbers import Noun
from intents.replies import where
from intents.state import RobotState
from intents.undoing import undone
from robot.failures import Failure
from robot.messages import Shape, Track, Unnamed, WorldState
from robot.se3 import SE3
from tests.fakes.worlds import WHERE, world_map

KNOWLEDGE = Knowledge(world_map())
SURFACES = [place for place in world_map().places if not place.floor and place.name != "table"]


def on(place_name: str, *, aside_m: float = 0.0) -> SE3:
    """Standing on a surface."""
    x, y, z = KNOWLEDGE.places(place_name)[0].X_WP.p
    return SE3((x, y + aside_m, z + 0.05))


def board(where_to: dict[str, SE3], *, given=(), held=(), held_by=None, unnamed=()) -> Blackboard:
    made = Blackboard()
    tracks = tuple(
        Track(id=name, X_WO=X_WO, seen_s=0.0, held_by=held_by) for name, X_WO in where_to.items()
    )
    world = WorldState(
        stamp_s=0.0, X_WN=SE3(), X_WB=SE3(), fix_age_s=0.0, tracks=tracks, unnamed=unnamed
    )
    writer = made.claim(WORLD.writer)
    writer.set(WORLD, world)
    writer.set(GIVEN, dict(given))
    writer.set(HELD, dict(held))
    return made


def understood(state: RobotState, **query: object) -> request.Understood:
    goals = from_builtins([{"goal": "pick", "object": {"at": "table", "count": "all", **query}}])
    found = request.meant("take them", goals, WHERE, state=state)
    assert isinstance(found, request.Understood), found
    return found


def settles(task: request.Understood) -> list[Settle]:
    return [part for _, part in walk(task.task) if isinstance(part, Settle)]


def everything_elsewhere() -> dict[str, SE3]:
    elsewhere = SURFACES[0].name
    return {info.id: on(elsewhere, aside_m=0.05 * n) for n, info in enumerate(world_map().objects)}


CUPS_AWAY = (
    f"; the red cup is on the {SURFACES[0].name} and the blue cup is on the {SURFACES[0].name}"
)


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ({"name": "cup"}, "there is no cup on the table" + CUPS_AWAY),
        ({}, "there is nothing on the table"),
        ({"except": {"name": "cup", "color": "blue"}},
         "there is nothing on the table but the blue cup"),
        ({"name": "cup", "count": 1}, "there is no cup on the table" + CUPS_AWAY),
    ],
)  # fmt: skip
def test_what_is_believed_to_be_elsewhere_is_not_taken_from_there(query, said):
    believed = board(everything_elsewhere())
    (settle,) = settles(understood(state_of(believed, KNOWLEDGE), **query))
    assert settle.looks  # somebody may have put one there
    found = settle.question(believed)
    assert isinstance(found, Failure)
    assert found.cause == said


def test_of_all_on_the_table_those_are_meant_that_are_there():
    spots = {**everything_elsewhere(), "cup_blue": on("table")}
    task = understood(state_of(board(spots), KNOWLEDGE), name="cup")
    assert not settles(task)
    assert {one.object_id for one in errands(task.task)} - {""} == {"cup_blue"}


def test_after_something_else_it_is_seen_then_what_is_there():
    spots = {**everything_elsewhere(), "cup_blue": on("table")}
    state = replace(state_of(board(spots), KNOWLEDGE), doing="put the blue cup on the shelf")
    task = understood(state, name="cup")
    (settle,) = settles(task)
    assert settle.question(board(spots)) == ("cup_blue",)
    assert isinstance(settle.question(board(everything_elsewhere())), Failure)
    assert task.whereabouts is not None and task.whereabouts.busy


def test_what_a_hand_holds_is_on_no_table():
    table = [place for place in world_map().places if place.name == "table"]
    there = answers.is_there(frozenset({"cup_red"}), table)
    spot = {"cup_red": on("table")}
    assert there(board(spot))
    assert not there(board(spot, held={"left": "cup_red"}))
    assert not there(board(spot, held_by="left"))
    assert not there(board(spot, given={"cup_red": "operator"}))


def test_who_was_given_a_thing_has_it_until_it_is_seen_to_stand_somewhere():
    holdings, X_GO = Holdings(), SE3()
    held = Held(object_id="cup_red", side="right", X_GO=X_GO, gap_m=0.05, mass_kg=0.1, carry_rad=())
    handled = Handled(holdings)
    shape = KNOWLEDGE.object("cup_red").shape  # type: ignore[union-attr]

    def look(stamp_s: float, X_WO: SE3, held_by=None) -> None:
        track = Track(id="cup_red", X_WO=X_WO, seen_s=stamp_s, held_by=held_by)
        handled.look(
            WorldState(
                stamp_s=stamp_s, X_WN=SE3(), X_WB=SE3(), fix_age_s=0.0, tracks=(track,)
            ),
            world_map(),
        )  # fmt: skip

    x, y, z = KNOWLEDGE.places("table")[0].X_WP.p
    standing = SE3((x, y, z + 0.5 * shape.size_m[2] - shape.X_BodyShape.p[2]))
    look(1.0, standing)
    holdings.take(held)
    look(2.0, SE3((0.0, 0.0, 1.0)), held_by="right")
    assert handled.taken_from == {"cup_red": standing}
    holdings.hand_over("right", "operator")
    look(3.0, SE3((0.0, 0.0, 1.0)))
    look(4.0, SE3((x, y, z + 0.25)))  # held above a table
    assert handled.given == {"cup_red": "operator"}
    look(5.0, standing)
    assert handled.given == {}
    assert holdings.find("cup_red") is None


def test_where_a_thing_is_that_somebody_was_given():
    person = world_map().people[0]
    state = state_of(
        board({"cup_red": SE3((0.0, 0.0, 1.0))}, given={"cup_red": person.id}), KNOWLEDGE
    )
    told = where(ObjectQuery(name="cup", color="red"), state)
    assert told is not None and told.casefold() == f"{person.name} has the red cup.".casefold()
    here = ground(ObjectQuery(name="cup", color="red", at="table"), state.entities)
    assert isinstance(here, Unknown)


def test_a_thing_that_nobody_had_seen_before_goes_back_to_where_it_was_taken_from():
    before = RobotState(entities=(Entity(id="cup", name="cup", color="red"),))
    now = RobotState(
        entities=(Entity(id="cup", name="cup", color="red", at="counter", came_from="table"),)
    )
    cup = ObjectQuery(name="cup", color="red")
    goals = (Pick(object=cup), Place(object=cup, on="counter"))
    assert undone("undo that", goals, before, now) == (Place(object=cup, on="table"),)
    nowhere = replace(now, entities=(replace(now.entities[0], came_from=""),))
    assert undone("undo that", goals, before, nowhere) == "I do not know where the red cup was."


def nameless(where_to: dict[str, SE3], *may_be: str) -> Blackboard:
    """With something on the table that nobody has made out."""
    shape = Shape(kind="cylinder", size_m=(0.08, 0.08, 0.1))
    thing = Unnamed(id="unnamed_3", words="white thing of 10 cm", X_WO=on("table"), shape=shape,
                    seen_s=0.0, may_be=may_be)  # fmt: skip
    return board(where_to, unnamed=(thing,))


def test_a_table_with_something_that_may_be_meant_and_has_no_name_is_not_empty():
    (settle, *_) = settles(understood(state_of(board({}), KNOWLEDGE)))
    ids = [info.id for info in world_map().objects]
    found = settle.question(board(everything_elsewhere()))
    assert isinstance(found, Failure) and found.code == "object_not_seen"
    found = settle.question(nameless(everything_elsewhere(), ids[0]))
    assert isinstance(found, Failure) and found.code == "not_made_out"
    assert "white thing of 10 cm on the table" in found.cause


def test_who_takes_everything_sees_to_it_in_the_end_that_nothing_is_left_without_a_name():
    (settle, *_) = settles(understood(state_of(board({}), KNOWLEDGE)))
    ids = [info.id for info in world_map().objects]
    branches = [part for _, part in walk(settle.then((ids[0],))) if isinstance(part, Branch)]
    (left,) = [part for part in branches if part.name.startswith("is anything left")]
    assert not left.question(board(everything_elsewhere()))
    assert left.question(nameless(everything_elsewhere(), ids[0]))
    assert not left.question(nameless(everything_elsewhere(), "what nobody told"))


def test_a_count_says_what_may_be_one_more():
    ids = frozenset(info.id for info in world_map().objects)
    table = KNOWLEDGE.places("table")
    words = answers.count(
        ids, table, noun=Noun("cup", "cups"), where=" on the table", of=KNOWLEDGE.map
    )
    assert words(board({})).text == "I see 0 cups on the table."
    told = words(nameless({}, *ids)).text
    assert told.endswith("I cannot tell what a white thing of 10 cm on the table is.")
