"""Words whose meaning is in the world: how many, which, and what is looked at for them."""

from __future__ import annotations

import math

import msgspec
import pytest

from executive.meaning.answers import not_looked_over
from executive.meaning.request import Refused, Understood, meant, request
from executive.skills.give import GiveParams
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.search import SearchParams
from executive.trees.parts import Branch, Each, Errand, Part, Settle, errands, walk
from intents import goals
from intents.relations import Viewpoint
from intents.state import RobotState
from robot import messages as m
from robot.failures import Failure
from robot.se3 import SE3
from tests.fakes.mugs import (
    OIL,
    SEEN,
    WHERE,
    MugKitchen,
    board,
    parts,
    understood,
)

# --- how many -----------------------------------------------------------------------------------

WORDS = {
    "a mug": 1, "both bottles": 2, "the two bottles": 2, "two mugs": 2, "all mugs": 3,
    "all the mugs": 3, "every mug": 3, "the three mugs": 3, "all of the bottles": 2,
}  # fmt: skip
SAID = {
    "put {} on the table": PlaceParams,
    "bring {} to the table": PlaceParams,
    "take {} to the counter": PlaceParams,
    "put {} next to the tea box": None,
    "give {} to mia": GiveParams,
    "bring {} to mia": GiveParams,
    "find {}": SearchParams,
    "look at {}": SearchParams,
}


@pytest.mark.parametrize(("words", "count"), WORDS.items())
@pytest.mark.parametrize(("said", "takes"), SAID.items())
def test_a_number_reaches_every_skill(words, count, said, takes):
    task = understood(said.format(words)).task
    if takes is None:
        named = {e.object_id for e in errands(task) if e.name.startswith("put ")}
    else:
        named = {e.object_id for e in errands(task) if isinstance(e.params, takes)}
    assert len(named) == count


@pytest.mark.parametrize("words", ["both bottles", "two mugs"])
def test_two_are_taken_into_two_hands(words):
    taken = [e.params for e in errands(understood(f"pick up {words}").task)]
    assert len({p.object_id for p in taken if isinstance(p, PickParams)}) == 2


@pytest.mark.parametrize("said", ["count all the mugs", "how many mugs are in the whole house?"])
def test_a_count_of_all_there_are_looks_over_every_room(said):
    chest = m.Place(
        id="chest", name="chest", X_WP=SE3((6.0, 2.0, 0.8)), size_m=(0.4, 0.8), room="hall"
    )
    world = MugKitchen()
    world.map = msgspec.structs.replace(world.map, places=(*world.map.places, chest))
    outcome = request(said, msgspec.structs.replace(WHERE, world=world))
    assert isinstance(outcome, Understood)
    look, _ = errands(outcome.task)
    assert {"counter", "table", "upper_rack", "chest"} <= set(look.params.place_ids)


@pytest.mark.parametrize("to", ["put {} on the table", "bring {} to the counter"])
def test_of_several_what_is_there_already_stays(to):
    for part in parts(to.format("all mugs"), Each):
        for one in part.parts:
            assert isinstance(one, Branch)
            (there,) = {
                e.params.place_id for e in errands(one) if isinstance(e.params, PlaceParams)
            }
            y_m = 0.0 if there == "table" else 2.5
            name = next(e.object_id for e in errands(one))
            assert one.question(board(**{name: (0.2, y_m)}))
            assert not one.question(board(**{name: (0.2, 2.5 - y_m)}))
            assert not one.question(board())


def test_of_several_the_ones_that_can_be_handled_are_enough_to_begin():
    kitchen = MugKitchen()
    heavy = msgspec.structs.replace(kitchen.map.objects[0], mass_kg=9.0)
    kitchen.map = msgspec.structs.replace(kitchen.map, objects=(heavy, *kitchen.map.objects[1:]))
    where = msgspec.structs.replace(WHERE, world=kitchen)
    assert isinstance(request("put all mugs on the table", where), Understood)
    assert isinstance(request("put the red mug on the table", where), Refused)


def test_more_than_there_are_is_refused():
    assert isinstance(request("put five mugs on the table", WHERE), Refused)


# --- which --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("said", "spot"), SEEN.items())
@pytest.mark.parametrize("from_x_m", [-1.5, 0.0, 1.5])
def test_a_relative_description_is_settled_by_looking(said, spot, from_x_m):
    (part,) = parts(f"bring the mug {said} to the table", Settle)
    seen = board(at=(from_x_m, 1.2), blue=spot, red=(-0.8, 0.1), oil=OIL, wine=(0.8, 2.4))
    assert part.question(seen) == ("blue",)
    fetched = [e.params for e in errands(part.then(("blue",)))]
    assert [p.object_id for p in fetched if isinstance(p, PickParams | PlaceParams)] == ["blue"] * 2
    assert any(e.object_id == "oil" for look in part.looks for e in errands(look))


def test_what_it_stands_beside_is_seen_with_it_and_not_looked_for_elsewhere():
    """A goblet in another room was looked for, to know what is between those on this table."""
    (part,) = parts("take the mug on the table between the bottles", Settle)
    looked = [e.name for look in part.looks for e in errands(look)]
    assert looked == ["look over the table"]
    seen = board(blue=(0.0, 0.0), oil=(-0.3, 0.0), wine=(0.3, 0.0), red=(0.8, 0.0))
    assert part.question(seen) == ("blue",)


def test_nothing_that_stands_so_is_a_failure_with_what_was_seen():
    (part,) = parts("take the mug behind the oil bottle", Settle)
    found = part.question(board(oil=OIL, red=(0.0, 0.0)))
    assert isinstance(found, Failure)
    assert found.code == "object_not_seen"
    assert "the red mug at the table" in found.cause


def test_two_that_stand_so_are_asked_about_only_now():
    (part,) = parts("take the mug next to the oil bottle", Settle)
    found = part.question(board(oil=OIL, red=(0.2, 2.4), blue=(-0.2, 2.4)))
    assert isinstance(found, Failure)
    assert found.code == "ambiguous"
    assert "red" in found.suggestion
    assert "blue" in found.suggestion


def test_the_one_next_to_it_is_the_nearer_one():
    (part,) = parts("take the mug next to the oil bottle", Settle)
    assert part.question(board(oil=OIL, red=(0.12, 2.4), blue=(-0.3, 2.4))) == ("red",)


@pytest.mark.parametrize(
    ("words", "means"),
    [
        ("the mug", {"red"}),
        ("a mug", {"red"}),
        ("all mugs", {"red"}),
        ("everything", {"red", "tea"}),
    ],
)
def test_what_is_on_a_surface_is_what_was_seen_there(words, means):
    (part,) = parts(f"bring {words} on the counter to the table", Settle)
    found = part.question(board(red=(0.3, 2.5), tea=(-0.3, 2.5), blue=(0.3, 0.0)))
    assert isinstance(found, tuple)
    assert set(found) == means


def test_what_stands_on_a_rack_stands_on_any_of_its_boards():
    (part,) = parts("bring all mugs on the rack to the table", Settle)
    found = part.question(board(red=(-3.0, 0.2), blue=(0.3, 0.0)))  # on the upper board
    assert found == ("red",)
    looked = [e.params.place_ids for look in part.looks for e in errands(look)]
    assert looked == [("lower_rack",), ("upper_rack",)]


def test_it_is_what_was_settled():
    (part,) = parts("take the mug on the counter and put it on the table", Settle)
    fetched = {e.object_id for e in errands(part.then(("green",)))}
    assert fetched == {"green"}


def test_fewer_than_asked_for_are_not_enough():
    (part,) = parts("put both mugs on the counter on the table", Settle)
    assert isinstance(part.question(board(red=(0.3, 2.5))), Failure)
    assert len(part.question(board(red=(0.3, 2.5), blue=(0.1, 2.5)))) == 2


def test_what_only_one_thing_can_be_needs_no_looking():
    (there,) = parts("bring the red mug on the counter to the table", Settle)
    assert not there.looks


def test_what_is_known_of_all_is_not_looked_for_again():
    settled = {"red": "counter", "blue": "table", "green": "table"}
    entities = [
        msgspec.structs.replace(entity, at=settled[entity.id], p_WO=(0.0, 0.0, 1.0))
        if entity.id in settled else entity
        for entity in WHERE.knowledge.entities()
    ]  # fmt: skip
    state = RobotState(entities=tuple(entities))
    goal = goals.Pick(object=goals.ObjectQuery(name="mug", at="counter"))
    outcome = meant("take the mug on the counter", (goal,), WHERE, state=state)
    assert isinstance(outcome, Understood)
    picked = [e.object_id for e in errands(outcome.task) if isinstance(e.params, PickParams)]
    assert picked == ["red"]


# --- the end ------------------------------------------------------------------------------------


def test_of_several_things_only_those_are_looked_for_that_nobody_has_seen():
    """Between two cans the robot went to see the second one before it went to take it."""
    searched = [
        part
        for part in parts("put all mugs on the table", Branch)
        if any(isinstance(one.params, SearchParams) for one in errands(part.otherwise))
        and not list(errands(part.then))
        and len(list(errands(part.otherwise))) == 1
    ]
    assert len(searched) == 3
    for branch in searched:
        (look,) = errands(branch.otherwise)
        mug = look.params.object_id
        assert branch.question(board(**{mug: (0.0, 2.5)}))
        assert not branch.question(board())


def test_a_count_in_a_room_says_what_could_not_be_seen():
    look, tell = understood("how many boxes are there in the kitchen?").task.parts[0].parts
    assert dict(look.handlers).keys() == {"place_not_seen"}  # the top of the fridge, say
    told = tell.params(board()).text
    assert told.startswith("I see 0 boxes in the kitchen. I have not seen all of the ")


def _counting(world: MugKitchen, *, at_x_m: float) -> list[tuple[str, Part]]:
    goal = goals.Count(object=goals.ObjectQuery(name="tea box"))
    state = RobotState(view=Viewpoint(x_m=at_x_m, y_m=0.0, yaw_rad=0.0))
    where = msgspec.structs.replace(WHERE, world=world)
    outcome = meant("count the tea boxes", (goal,), where, state=state)
    assert isinstance(outcome, Understood)
    return list(walk(outcome.task))


def _with_a_cellar() -> MugKitchen:
    """North of the kitchen, with a bench."""
    world = MugKitchen()
    table, hall = world.map.place("table"), world.map.place("hall")
    assert table is not None
    assert hall is not None
    bench = msgspec.structs.replace(table, id="bench", X_WP=SE3((0, 6, 1)), room="cellar")
    cellar = msgspec.structs.replace(
        hall, id="cellar", name="cellar", room="cellar", X_WP=SE3((0, 6.2, 0))
    )
    world.map = msgspec.structs.replace(world.map, places=(*world.map.places, cellar, bench))
    return world


def test_a_count_of_no_place_goes_on_in_the_rooms_around_where_none_is_here():
    steps = _counting(_with_a_cellar(), at_x_m=0.0)
    (branch,) = [part for _, part in steps if isinstance(part, Branch)]
    (further,) = errands(branch.otherwise)
    assert further.params.place_ids == ("bench",)
    assert not list(errands(branch.then))
    assert branch.question(board(tea=(0.0, 2.5)))
    assert not branch.question(board(red=(0.0, 2.5)))


def test_a_count_in_a_corridor_looks_over_the_rooms_around():
    steps = _counting(_with_a_cellar(), at_x_m=6.0)
    assert not [part for _, part in steps if isinstance(part, Branch)]
    around, further, _ = [part for _, part in steps if isinstance(part, Errand)]
    assert around.params.place_ids == ()
    assert set(further.params.place_ids) == {"counter", "table", "lower_rack", "upper_rack"}


def test_what_was_not_looked_at_is_told_by_rooms_where_there_are_several():
    """What the world model lists is not all seen: it says of each sample when, if ever."""
    kitchen = [place for place in WHERE.world.map.places if not place.floor]
    desk, bench = (msgspec.structs.replace(kitchen[0], id=name, name=name, room="hall")
                   for name in ("desk", "bench"))  # fmt: skip

    def missed(*seen: str, of: list[m.Place]) -> str:
        looked = tuple(
            m.Looked(
                place_id=one.id,
                seen_s=(5.0 if one.id in seen else -math.inf,) * len(one.samples()),
            )
            for one in of
        )
        return not_looked_over(board(looked=looked), WHERE.world.map, of)

    assert missed("counter", of=kitchen[:2]) == "the table"
    both = [*kitchen[:2], desk, bench]
    assert missed(of=both) == "the kitchen and the hall"
    assert missed("counter", "desk", "bench", of=both) == "parts of the kitchen"
    assert missed(*(place.id for place in both), of=both) == ""


def test_what_a_condition_found_is_taken_from_where_it_is_said_to_be():
    text = "if there is a mug on the table, put it on the counter"
    branch = parts(text, Branch)[0]
    taken = [
        one.params.object_id for one in errands(branch.then) if hasattr(one.params, "object_id")
    ]
    assert set(taken) == {"red"}
    assert not [part for _, part in walk(branch.then) if isinstance(part, Settle)]


def test_what_is_counted_is_said_in_the_worlds_own_plural():
    *_, tell = errands(understood("how many boxes are there on the counter?").task)
    assert isinstance(tell, Errand)
    assert callable(tell.params)
    assert tell.params(board()).text == "I see 0 boxes on the counter."
    assert tell.params(board(tea=(0.0, 2.5))).text == "I see 1 box on the counter."


# --- looking --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("text", "at_x_m", "goes"), [
    ("look at the hall", 0.0, True), ("have a look in the kitchen", 0.0, False),
    ("look at the counter", 6.0, True), ("look at the counter", 0.0, False),
])  # fmt: skip
def test_what_is_in_another_room_is_looked_at_from_there(text: str, at_x_m: float, goes: bool):
    """From this one nobody sees it, and the robot said "Done." all the same."""
    (near,) = (part for part in parts(text, Branch) if isinstance(part, Branch))
    then = near.then if near.question(board(at=(at_x_m, 1.0))) else near.otherwise
    assert [one.params for _, one in walk(then) if isinstance(one, Errand)] == (
        [NavigateParams(place_id=text.rsplit(maxsplit=1)[-1])] if goes else []
    )
    *_, look = parts(text, Errand)
    assert isinstance(look, Errand)
    assert look.name.startswith("look ")
