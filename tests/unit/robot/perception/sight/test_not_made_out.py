"""What was seen and not made out is told, until it was seen as well as it can be."""

import numpy as np
import pytest

from robot.messages import ObjectInfo, Place, RgbdImage, Shape, WorldMap
from robot.perception.sight.at_hand import apart_from_hands
from robot.perception.sight.doubt import WELL_ENOUGH, doubtful
from robot.perception.sight.recognising import SETTLED
from robot.perception.sight.seer import Seer
from robot.perception.sight.tracking import Tracks
from robot.perception.sight.unnamed import unnamed
from robot.perception.things.eyes import SeenThing
from robot.se3 import SE3
from tests.fakes.things_in_view import CLASSES, SURE, measured, picture_of

AT = (1.0, 0.0, 0.76)
HERE = pytest.approx(AT, abs=0.01)


def seen_from(range_m: float, *, looks: int, is_whole: bool = True) -> Tracks:
    tracks = Tracks()
    for k in range(looks):
        one = measured(AT, is_whole=is_whole)
        tracks.add([one._replace(seen=one.seen._replace(range_m=range_m))], 0.2 * k)
    return tracks


def test_a_thing_without_a_name_is_in_doubt_until_it_was_seen_from_near_by():
    far, near = seen_from(1.8, looks=12), seen_from(0.8, looks=WELL_ENOUGH)
    assert list(doubtful(far.things, {}, ())) == [HERE]
    assert not doubtful(near.things, {}, ())
    assert doubtful(seen_from(0.8, looks=WELL_ENOUGH, is_whole=False).things, {}, ())


def test_a_name_settles_it_where_no_other_told_thing_might_have_it_as_well():
    far = seen_from(1.8, looks=3).things
    assert not doubtful(far, {1: SETTLED}, ())
    assert doubtful(far, {1: 0.5 * SETTLED}, ())


def test_what_goes_on_beyond_the_border_is_in_doubt_in_that_picture():
    assert doubtful((), {}, [measured(AT).seen]) == (AT,)


class OneThing:
    """Eyes that see one thing, in pixels of their own."""

    class namer:
        classes, sure, voted = CLASSES, SURE, SURE

    def __init__(self, thing: SeenThing) -> None:
        self.thing = thing

    def look(self, *_: object, **__: object) -> list[SeenThing]:
        return [self.thing]


X_WC = SE3.from_rotation([[0, 0, 1], [-1, 0, 0], [0, -1, 0]], (0.0, 0.0, 0.76))
TOLD = ObjectInfo(
    id="pear", name="pear", category="pear", color="green", mass_kg=0.1,
    shape=Shape(kind="box", size_m=(0.07, 0.07, 0.1)),
)  # fmt: skip


def view(rows: slice, columns: slice) -> tuple[RgbdImage, SeenThing]:
    """A wall with something before it, 1 m away."""
    pixels = np.zeros((120, 160), dtype=np.bool_)
    pixels[rows, columns] = True
    thing = measured((1.03, 0.0, 0.76), colours=("red",)).seen._replace(pixels=pixels)
    return picture_of(np.where(pixels, 1.0, 2.0)), thing


@pytest.mark.parametrize(
    ("rows", "columns"), [(slice(50, 70), slice(73, 87)), (slice(50, 70), slice(0, 14))]
)
def test_a_look_tells_where_something_is_that_it_has_no_name_for(rows: slice, columns: slice):
    image, thing = view(rows, columns)
    table = Place(id="t", name="table", X_WP=SE3((1.0, 0.0, 0.71)), size_m=(0.6, 1.2))
    seer = Seer(OneThing(thing))  # pyright: ignore[reportArgumentType]
    seer.tell(
        WorldMap(
            stamp_s=0.0, name="", places=(table,), obstacles=(), objects=(TOLD,), people=(),
            categories={}, bounds_m=(-5.0, -5.0, 5.0, 5.0),
        )
    )  # fmt: skip
    own = np.zeros((120, 160), dtype=np.bool_)
    look = seer.look(image, X_WC, own=own, held={})
    ((x, _, z),) = look.doubts
    assert (x, z) == pytest.approx((1.03, 0.76), abs=0.04)


def test_what_has_no_name_is_told_as_it_looks_but_no_part_of_a_named_thing_is():
    tracks = Tracks()
    alone, named = measured((1.0, 0.5, 0.76), colours=("green",)), measured(AT, colours=("red",))
    part = measured((1.0, 0.07, 0.76), colours=("red",))
    for k in range(3):
        tracks.add([alone, named, part], 0.2 * k)
    assert len(tracks.things) == 3
    (one,) = unnamed(tracks.things, {2: "red_cup"}, {1: ("pear",)})
    assert one.words == "green thing of 10 cm" and one.may_be == ("pear",)
    assert one.X_WO.p == pytest.approx((1.0, 0.5, 0.76), abs=0.01)


def test_what_was_only_seen_at_a_hand_that_holds_something_is_a_piece_of_that():
    held_W, near_W = (1.0, 0.35, 0.8), (1.0, 0.5, 0.76)
    pieces, stood = Tracks(), Tracks()
    for k in range(3):
        stood.add(apart_from_hands([measured(near_W)], ()), 0.2 * k)
    for k in range(6):
        pieces.add(apart_from_hands([measured(near_W), measured(held_W)], (held_W,)), 0.2 * k)
        stood.add(apart_from_hands([measured(near_W)], (held_W,)), 0.6 + 0.2 * k)
    assert not unnamed(pieces.things, {}, {})
    (there,) = unnamed(stood.things, {}, {})  # what a cup comes to stand on, if nobody looks
    assert there.near and there.X_WO.p == pytest.approx(near_W, abs=0.01)


def test_a_glimpse_from_afar_is_not_near_and_one_look_is_nothing_yet():
    (far,) = unnamed(seen_from(1.8, looks=9).things, {}, {})
    assert not far.near
    assert not unnamed(seen_from(0.8, looks=1).things, {}, {})
