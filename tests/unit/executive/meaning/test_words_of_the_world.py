"""Words whose meaning is in the world: how many, relative to what, on which part, which floor."""

from __future__ import annotations

import math

import msgspec
import pytest

from executive.blackboard import GIVEN, HELD, WORLD, Blackboard
from executive.meaning.answers import not_looked_over
from executive.meaning.request import Refused, Setting, Understood, meant, request
from executive.meaning.robot_state import state_of
from executive.skills.give import GiveParams
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.say import SayParams
from executive.skills.search import SearchParams
from executive.trees.parts import Branch, Each, Errand, Kept, Part, Settle, errands, walk
from intents import goals
from intents.relations import Viewpoint
from intents.state import RobotState
from robot import messages as m
from robot.failures import Failure
from robot.se3 import SE3
from tests.fakes.worlds import JUNO, Mapped, MappedWorld

COUNTER_M = 0.9
"""Height of the surfaces."""


def _map() -> m.WorldMap:
    """A kitchen with a counter before its north wall, a table in the middle, a door to the hall."""

    def surface(name: str, x_m: float, y_m: float, **more: object) -> m.Place:
        return m.Place(
            id=name, name=name, X_WP=SE3((x_m, y_m, COUNTER_M)), size_m=(2.0, 0.6), room="kitchen",
            **more,  # type: ignore[arg-type]
        )  # fmt: skip

    def thing(object_id: str, name: str, category: str, color: str) -> m.ObjectInfo:
        shape = m.Shape(kind="cylinder", size_m=(0.07, 0.07, 0.1))
        return m.ObjectInfo(
            id=object_id, name=name, category=category, color=color, shape=shape, mass_kg=0.2
        )

    def floor(name: str, x_m: float, room: str) -> m.Place:
        return m.Place(
            id=name, name=name, X_WP=SE3((x_m, 0, 0)), size_m=(6, 6), room=room, floor=True
        )

    return m.WorldMap(
        stamp_s=0.0,
        name="a kitchen and a hall",
        obstacles=(),
        places=(
            surface("counter", 0.0, 2.5),
            surface("table", 0.0, 0.0),
            *_rack(),
            floor("kitchen", 0.0, "kitchen"),
            floor("hall", 6.0, "hall"),
            m.Place(id="door", name="front door", X_WP=SE3((8.0, 0, 0)), size_m=(0.6, 0.6),
                    room="hall", floor=True),
        ),
        objects=(
            thing("red", "mug", "mug", "red"),
            thing("blue", "mug", "mug", "blue"),
            thing("green", "mug", "mug", "green"),
            thing("oil", "oil bottle", "bottle", ""),
            thing("wine", "wine bottle", "bottle", ""),
            thing("tea", "tea box", "box", ""),
        ),
        people=(m.PersonInfo(id="mia", name="mia", X_WO=SE3((2.0, -2.0, 0.0))),),
        categories={"mug": "mugs", "bottle": "bottles", "box": "boxes"},
        bounds_m=(-4, -4, 10, 4),
    )  # fmt: skip


def _rack() -> tuple[m.Place, ...]:
    """Two boards; as a whole it is the lower one by another name."""
    heights_m = {"lower rack": 0.5, "upper rack": COUNTER_M, "rack": 0.5}
    return tuple(
        m.Place(
            id=name.replace(" ", "_"), name=name, X_WP=SE3((-3.0, 0.0, height_m)), of="rack",
            size_m=(0.4, 1.0), clearance_m=0.38, room="kitchen",
        )
        for name, height_m in heights_m.items()
    )  # fmt: skip


class _Kitchen(MappedWorld):
    def __init__(self) -> None:
        super().__init__("kitchen")
        self.map = _map()


WHERE = Setting(reality=Mapped(), world=_Kitchen(), description=JUNO, robot_name="juno")


def understood(text: str) -> Understood:
    outcome = request(text, WHERE)
    assert not isinstance(outcome, Refused), outcome
    return outcome


def parts(text: str, kind: type) -> list[Part]:
    return [part for _, part in walk(understood(text).task) if isinstance(part, kind)]


def board(
    *,
    at: tuple[float, float] = (0.0, 1.0),
    left: str = "",
    given: str = "",
    looked: tuple[m.Looked, ...] = (),
    **things: tuple[float, float],
) -> Blackboard:
    """What is believed: the robot at a point, things at points of the surface they are over.

    `left` is in the left hand; `given` was given to Mia.
    """
    blackboard = Blackboard()
    tracks = tuple(
        m.Track(id=name, X_WO=SE3((x_m, y_m, COUNTER_M + 0.05)), seen_s=1.0)
        for name, (x_m, y_m) in things.items()
    )
    X_WB = SE3.from_xy_yaw(*at, 0.5 * math.pi)
    state = m.WorldState(
        stamp_s=1.0, X_WN=SE3(), X_WB=X_WB, fix_age_s=0.0, tracks=tracks, looked=looked
    )
    sense = blackboard.claim("sense")
    sense.set(WORLD, state)
    sense.set(HELD, {"left": left} if left else {})
    sense.set(GIVEN, {given: "mia"} if given else {})
    return blackboard


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
    world = _Kitchen()
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
    kitchen = _Kitchen()
    heavy = msgspec.structs.replace(kitchen.map.objects[0], mass_kg=9.0)
    kitchen.map = msgspec.structs.replace(kitchen.map, objects=(heavy, *kitchen.map.objects[1:]))
    where = msgspec.structs.replace(WHERE, world=kitchen)
    assert isinstance(request("put all mugs on the table", where), Understood)
    assert isinstance(request("put the red mug on the table", where), Refused)


def test_more_than_there_are_is_refused():
    assert isinstance(request("put five mugs on the table", WHERE), Refused)


# --- which --------------------------------------------------------------------------------------

OIL = (0.0, 2.4)
SEEN = {
    "behind the oil bottle": (0.0, 2.62),
    "in front of the oil bottle": (0.0, 2.24),
    "left of the oil bottle": (-0.2, 2.4),
    "right of the oil bottle": (0.2, 2.4),
    "next to the oil bottle": (0.15, 2.45),
    "between the oil bottle and the wine bottle": (0.4, 2.42),
}


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


# --- where to put it ----------------------------------------------------------------------------


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


# --- the end ------------------------------------------------------------------------------------


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


def test_a_count_in_a_room_says_what_could_not_be_seen():
    look, tell = understood("how many boxes are there in the kitchen?").task.parts[0].parts
    assert dict(look.handlers).keys() == {"place_not_seen"}  # the top of the fridge, say
    told = tell.params(board()).text
    assert told.startswith("I see 0 boxes in the kitchen. I have not seen all of the ")


def _counting(world: _Kitchen, *, at_x_m: float) -> list[tuple[str, Part]]:
    goal = goals.Count(object=goals.ObjectQuery(name="tea box"))
    state = RobotState(view=Viewpoint(x_m=at_x_m, y_m=0.0, yaw_rad=0.0))
    where = msgspec.structs.replace(WHERE, world=world)
    outcome = meant("count the tea boxes", (goal,), where, state=state)
    assert isinstance(outcome, Understood)
    return list(walk(outcome.task))


def _with_a_cellar() -> _Kitchen:
    """North of the kitchen, with a bench."""
    world = _Kitchen()
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
