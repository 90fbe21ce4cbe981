"""A room that a thing is taken to on its way is no place to put it down in."""

import pytest
from msgspec.structs import replace

from executive.meaning.identify import Scene
from executive.meaning.knowledge import Knowledge
from executive.meaning.stopovers import without_stopovers
from executive.meaning.tasks import understand
from executive.skills.place import PlaceParams
from executive.trees.parts import errands
from intents import goals
from robot.messages import Place
from robot.se3 import SE3
from tests.fakes.worlds import world_map

HALL = Place(id="hall", name="hall", X_WP=SE3((20, 0, 0)), size_m=(2, 2), room="hall", floor=True)


def knowledge() -> Knowledge:
    """The shelf and the table are in the kitchen, the loft is in the hall."""
    whole = world_map()
    rooms = {"loft": "hall"}
    places = [replace(one, room=rooms.get(one.id, "kitchen")) for one in whole.places]
    return Knowledge(replace(whole, places=(*places, HALL)))


def thing(name: str = "bottle", **more) -> goals.ObjectQuery:
    return goals.ObjectQuery(name=name, **more)


def put(on: str, query: goals.ObjectQuery | None = None, **more) -> goals.Place:
    return goals.Place(object=query or thing(), on=on, **more)


ANN = goals.Person(name="Ann")


@pytest.mark.parametrize(
    ("first", "then"),
    [
        (put("kitchen", thing(at="loft")), put("table")),
        (put("kitchen", thing(at="loft")), put("table", goals.ObjectQuery(held=True))),
        (goals.Bring(object=thing(at="loft"), to="kitchen"), put("lower shelf")),
        (put("kitchen", thing(at="loft", count=1)), put("table", thing(), part="left_end")),
        (put("kitchen", thing(at="loft", count="all")), put("table", thing(count="all"))),
        (put("kitchen", thing(at="loft")), goals.Give(object=thing(), to=ANN)),
        (put("kitchen", thing(at="loft")), goals.Bring(object=thing(), to=ANN)),
    ],
)
def test_what_is_taken_to_a_room_and_put_on_something_there_is_put_down_once(
    first: goals.Place | goals.Bring, then: goals.Place
) -> None:
    (whole,) = without_stopovers((first, then), knowledge())
    assert whole == replace(then, object=first.object)


@pytest.mark.parametrize(
    ("first", "then"),
    [
        (put("hall"), put("table")),  # it stands elsewhere
        (put("table"), put("lower shelf")),  # it was to be put there
        (put("kitchen"), put("table", thing("crate"))),  # two things
        (put("kitchen", thing(count=1)), put("table", thing(count=1))),  # one, and another one
        (put("kitchen", thing(color="red")), put("table", thing(color="blue"))),
        (put("kitchen", part="left_end"), put("table")),
        (put("kitchen"), put("kitchen")),
        (put("hall"), goals.Give(object=thing(), to=ANN)),
    ],
)
def test_what_is_something_of_its_own_stays(first: goals.Goal, then: goals.Goal) -> None:
    assert without_stopovers((first, then), knowledge()) == (first, then)


def test_what_is_done_in_between_keeps_them_apart() -> None:
    asked = (put("kitchen"), goals.Wait(duration_s=5.0), put("table"))
    assert without_stopovers(asked, knowledge()) == asked


def test_the_task_puts_it_down_once() -> None:
    task = understand((put("kitchen"), put("lower shelf")), Scene(knowledge()))
    params = [errand.params for errand in errands(task)]
    (down,) = [one for one in params if isinstance(one, PlaceParams)]
    assert down.place_id == "shelf_lower"
