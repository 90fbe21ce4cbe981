"""Objects are where they were seen; gone only when their place was plainly seen to be empty."""

import math

import msgspec
import numpy as np
import pytest

from robot.fusion.world_model import FORGET_S, FRAMES_TO_MISS, Hand, WorldModel
from robot.messages import (
    DepthImage,
    ObjectInfo,
    Obstacle,
    PersonInfo,
    Piece,
    Shape,
    Sighting,
    Sightings,
)
from robot.model import description
from robot.se3 import SE3

WIDTH, HEIGHT, FOVY_RAD = 160, 120, math.radians(60)
CUP = ObjectInfo(
    id="cup", name="cup", category="cup", color="red", mass_kg=0.2,
    shape=Shape(kind="cylinder", size_m=(0.07, 0.07, 0.1)),
)  # fmt: skip
# Camera at 1.2 m looking along +x of the world, level.
X_WC = SE3.from_rotation([[0, 0, 1], [-1, 0, 0], [0, -1, 0]], (0.0, 0.0, 1.2))


def depth(
    metres: float = 3.0, *, patch: tuple[int, int, int, int] | None = None, near: float = 0.5
):
    """An image of a wall, with something `near` in columns and rows of the patch."""
    image = np.full((HEIGHT, WIDTH), metres, np.float32)
    if patch:
        left, right, top, bottom = patch
        image[top:bottom, left:right] = near
    return DepthImage(
        stamp_s=0.0, width=WIDTH, height=HEIGHT, fovy_rad=FOVY_RAD, depth_m=image.tobytes()
    )


def seen(stamp_s: float, p_C: tuple[float, float, float] | None) -> Sightings:
    objects = () if p_C is None else (Sighting(id="cup", X_CO=SE3(p_C)),)
    return Sightings(stamp_s=stamp_s, objects=objects)


@pytest.fixture
def model() -> WorldModel:
    model = WorldModel(camera_range_m=4.0)
    model.know((CUP,))
    return model


def cup(model: WorldModel):
    (track,) = model.tracks()
    return track


def test_a_known_object_is_nowhere_before_it_is_seen(model):
    assert cup(model).X_WO is None
    assert cup(model).seen_s == -math.inf
    for k in range(10):
        model.see(seen(k, None), X_WC, depth())
    assert not cup(model).missing


def test_a_sighting_places_it_in_the_world(model):
    model.see(seen(1.0, (0.1, 0.2, 1.5)), X_WC, None)
    assert cup(model).X_WO.p == pytest.approx((1.5, -0.1, 1.0))
    assert cup(model).seen_s == 1.0


def test_it_is_missing_after_three_clear_frames_and_not_before(model):
    model.see(seen(0.0, (0.0, 0.0, 1.5)), X_WC, depth())
    for k in range(1, FRAMES_TO_MISS):
        model.see(seen(k, None), X_WC, depth())
        assert not cup(model).missing
    model.see(seen(FRAMES_TO_MISS, None), X_WC, depth())
    assert cup(model).missing
    assert cup(model).seen_s == 0.0
    assert cup(model).X_WO.p == pytest.approx((1.5, 0.0, 1.2))


def test_it_is_found_again(model):
    model.see(seen(0.0, (0.0, 0.0, 1.5)), X_WC, depth())
    for k in range(1, 6):
        model.see(seen(k, None), X_WC, depth())
    model.see(seen(6.0, (0.2, 0.0, 1.5)), X_WC, depth())
    assert not cup(model).missing
    assert cup(model).X_WO.p[1] == pytest.approx(-0.2)
    model.see(seen(7.0, None), X_WC, depth())
    assert not cup(model).missing


def test_what_was_another_thing_is_nowhere_again(model):
    model.see(seen(0.0, (0.0, 0.0, 1.5)), X_WC, depth())
    model.mistake({"cup": "blue"})
    assert cup(model).X_WO is None
    assert not cup(model).missing
    model.see(seen(1.0, (0.2, 0.0, 1.5)), X_WC, depth())
    assert cup(model).X_WO.p[1] == pytest.approx(-0.2)


NOT_CLEAR = {
    "hidden": (X_WC, depth(patch=(70, 90, 50, 70))),
    "half hidden": (X_WC, depth(patch=(80, 90, 50, 70))),
    "behind a wall": (X_WC, depth(1.0)),
    "out of range": (SE3((-3.0, 0.0, 0.0)) @ X_WC, depth(9.0)),
    "looking away": (X_WC @ SE3.from_rpy(0.0, math.pi, 0.0, (0, 0, 0)), depth()),
    "at the edge": (X_WC @ SE3.from_rpy(0.0, 0.62, 0.0, (0, 0, 0)), depth()),
    "too near": (SE3((1.4, 0.0, 0.0)) @ X_WC, depth()),
    "no depth": (X_WC, None),
}


@pytest.mark.parametrize("case", NOT_CLEAR.values(), ids=NOT_CLEAR.keys())
def test_it_is_not_missing_while_its_place_is_not_in_clear_view(model, case):
    X_WCamera, image = case
    model.see(seen(0.0, (0.0, 0.0, 1.5)), X_WC, depth())
    for k in range(1, 20):
        model.see(seen(k, None), X_WCamera, image)
    assert not cup(model).missing


def test_nothing_hit_at_all_is_a_clear_view(model):
    model.see(seen(0.0, (0.0, 0.0, 1.5)), X_WC, depth())
    for k in range(1, 4):
        model.see(seen(k, None), X_WC, depth(0.0))
    assert cup(model).missing


def test_objects_that_nobody_told_of_are_tracked_too(model):
    model.see(
        Sightings(stamp_s=0.0, objects=(Sighting(id="ball", X_CO=SE3((0.0, 0.0, 1.0))),)),
        X_WC,
        depth(),
    )
    assert [track.id for track in model.tracks()] == ["cup", "ball"]


JUNO = description.load()
GRIPPING, MOST_M = JUNO.handy.gripping, JUNO.hands["right"].max_opening_m


def hand(x: float, opening_m: float) -> dict:
    return {"right": Hand(SE3.from_xy_yaw(x, 0.0, 0.3, z_m=1.0), opening_m, GRIPPING, MOST_M)}


def test_what_the_fingers_close_on_goes_with_the_hand_and_is_never_missing(model):
    model.see(seen(0.0, (0.0, 0.2, 1.5)), X_WC, depth())
    model.feel(hand(1.52, 0.115))
    assert cup(model).held_by is None, "the hand is open around it"
    model.feel(hand(1.52, 0.070))
    assert cup(model).held_by == "right"
    model.feel(hand(1.02, 0.070))
    assert cup(model).X_WO.p == pytest.approx((1.0, 0.0, 1.0), abs=1e-6)
    for k in range(1, FRAMES_TO_MISS + 2):
        model.see(seen(k, None), X_WC, depth())
    assert not cup(model).missing
    assert cup(model).seen_s == 0.0


def test_a_hand_open_around_the_narrow_side_of_a_box_does_not_hold_it(model):
    box = Shape(kind="box", size_m=(0.10, 0.06, 0.10))
    model.know((msgspec.structs.replace(CUP, shape=box),))
    model.see(seen(0.0, (0.0, 0.2, 1.5)), X_WC, depth())
    X_WO = cup(model).X_WO
    model.feel({"right": Hand(X_WO, 0.10, GRIPPING, MOST_M)})
    assert cup(model).held_by is None, "fingers open along its 6 cm"
    model.feel({"right": Hand(X_WO, 0.06, GRIPPING, MOST_M)})
    assert cup(model).held_by == "right"


def test_an_open_hand_does_not_hold_what_is_nearly_as_wide_as_it_opens(model):
    """Cans of 8.5 cm went along with the open hand that came for them, and with it when it left."""
    wide = Shape(kind="cylinder", size_m=(0.085, 0.085, 0.12))
    model.know((msgspec.structs.replace(CUP, shape=wide),))
    model.see(seen(0.0, (0.0, 0.2, 1.5)), X_WC, depth())
    for x, opening_m in ((1.44, 0.0995), (1.47, 0.0985), (1.5, 0.0965)):
        model.feel(hand(x, opening_m))
        assert cup(model).held_by is None
        assert cup(model).X_WO.p == pytest.approx((1.5, 0.0, 1.0), abs=1e-6)
    for opening_m in (0.093, 0.085, 0.085):
        model.feel(hand(1.5, opening_m))
    assert cup(model).held_by == "right"
    model.feel(hand(1.3, 0.085))
    for x, opening_m in ((1.3, 0.0995), (1.22, 0.0995)):
        model.feel(hand(x, opening_m))
        assert cup(model).held_by is None
    assert cup(model).X_WO.p == pytest.approx((1.3, 0.0, 1.0), abs=1e-6)


def test_what_the_fingers_rest_on_stays_held_however_wide_it_looks(model):
    """Sizes come from eyes: each time one changed by a little it was let go, and taken again."""
    model.see(seen(0.0, (0.0, 0.2, 1.5)), X_WC, depth())
    for opening_m in (0.082, 0.070, 0.070):
        model.feel(hand(1.5, opening_m))
    for width_m in (0.086, 0.054, 0.100, 0.070):
        wide = Shape(kind="cylinder", size_m=(width_m, width_m, 0.1))
        model.measure((msgspec.structs.replace(CUP, shape=wide),))
        model.feel(hand(1.3, 0.0705))
        assert cup(model).held_by == "right"
    model.feel(hand(1.3, 0.050))
    assert cup(model).held_by is None, "it has slipped out, and they have closed further"


def test_fingers_that_are_still_closing_hold_only_what_is_as_wide(model):
    model.see(seen(0.0, (0.0, 0.2, 1.5)), X_WC, depth())
    for opening_m, holds in ((0.082, True), (0.070, True), (0.040, False), (0.0, False)):
        model.feel(hand(1.5, opening_m))
        assert (cup(model).held_by == "right") is holds


def test_fingers_that_waited_around_a_thing_hold_it_all_the_while_they_close(model):
    model.see(seen(0.0, (0.0, 0.2, 1.5)), X_WC, depth())
    for opening_m in (0.083, 0.083, 0.075, 0.066, 0.066):
        model.feel(hand(1.5, opening_m))
        assert cup(model).held_by == "right"


@pytest.mark.parametrize("opening_m", [0.0, 0.105])
def test_what_leaves_the_hand_stays_where_it_was(model, opening_m):
    model.see(seen(0.0, (0.0, 0.2, 1.5)), X_WC, depth())
    for x, opening in ((1.5, 0.07), (1.2, 0.07), (1.2, opening_m), (0.6, opening_m)):
        model.feel(hand(x, opening))
    assert cup(model).held_by is None
    assert cup(model).X_WO.p == pytest.approx((1.2, 0.0, 1.0), abs=1e-6)


def test_what_is_seen_far_from_the_hand_is_not_in_it(model):
    model.see(seen(0.0, (0.0, 0.2, 1.5)), X_WC, depth())
    model.feel(hand(1.5, 0.07))
    model.see(seen(1.0, (0.0, 1.1, 1.5)), X_WC, depth())
    model.feel(hand(1.5, 0.07))
    assert cup(model).held_by is None
    assert cup(model).X_WO.p[2] == pytest.approx(0.1)


@pytest.fixture
def ann() -> WorldModel:
    model = WorldModel(camera_range_m=4.0)
    model.know((), (PersonInfo(id="ann", name="Ann", X_WO=SE3((2.0, 0.0, 0.0))),))
    return model


def glimpse(stamp_s: float, *p_C: tuple[float, float, float]) -> Sightings:
    people = tuple(Sighting(id="ann", X_CO=SE3(p)) for p in p_C)
    return Sightings(stamp_s=stamp_s, objects=(), people=people)


def test_a_person_is_where_the_map_says_until_seen_elsewhere(ann):
    (before,) = ann.people()
    assert (before.X_WO.p, before.seen_s) == ((2.0, 0.0, 0.0), -math.inf)
    ann.see(glimpse(3.0, (0.5, 1.2, 1.5)), X_WC, None)
    (after,) = ann.people()
    assert after.X_WO.p == pytest.approx((1.5, -0.5, 0.0))
    assert after.seen_s == 3.0


def test_a_person_who_has_gone_is_missing(ann):
    for k in range(FRAMES_TO_MISS):
        ann.see(glimpse(float(k)), X_WC, depth())
    assert ann.people()[0].missing


def test_out_of_view_a_person_is_what_the_lidar_sees_nearby(ann):
    ann.see(glimpse(0.0, (0.0, 1.2, 1.5)), X_WC, None)
    near = Obstacle(id="u", name="u", X_WO=SE3((1.8, 0.3, 0.0)), shapes=())
    ann.bump((near,), 0.2)
    assert ann.people()[0].X_WO.p[:2] == pytest.approx((1.5, 0.0)), "still in view"
    ann.bump((near,), 2.0)
    assert ann.people()[0].X_WO.p[:2] == pytest.approx((1.8, 0.3))


def thing_at(name: str, x_m: float, y_m: float) -> Obstacle:
    return Obstacle(id=name, name=name, X_WO=SE3((x_m, y_m, 0.0)), shapes=())


def test_who_walked_on_while_no_sensor_made_them_out_is_what_is_new_nearby(ann):
    """Somebody who had made room was asked again, and stepped back from, where they had stood."""
    ann.see(glimpse(0.0, (0.0, 1.2, 1.5)), X_WC, None)  # at (1.5, 0)
    clutter = thing_at("clutter", 2.3, 0.0)
    ann.bump((clutter, thing_at("legs", 1.5, -0.3)), 1.0)
    ann.bump((clutter,), 1.5)
    ann.bump((clutter,), 2.0)
    assert ann.people()[0].X_WO.p[:2] == pytest.approx((1.5, -0.3))
    ann.bump((clutter, thing_at("new", 1.6, -1.3)), 2.2)
    assert ann.people()[0].X_WO.p[:2] == pytest.approx((1.6, -1.3))


def test_who_was_lost_for_long_is_not_taken_for_whatever_comes_up(ann):
    ann.see(glimpse(0.0, (0.0, 1.2, 1.5)), X_WC, None)
    ann.bump((), 5.0)
    ann.bump((thing_at("new", 1.6, -1.3),), 5.1)
    assert ann.people()[0].X_WO.p[:2] == pytest.approx((1.5, 0.0))


def test_of_several_things_nearby_somebody_out_of_view_is_the_nearest(ann):
    ann.see(glimpse(0.0, (0.0, 1.2, 1.5)), X_WC, None)
    ann.bump((thing_at("far", 1.5, 0.5), thing_at("near", 1.5, -0.2)), 1.0)
    assert ann.people()[0].X_WO.p[:2] == pytest.approx((1.5, -0.2))


def test_who_was_not_seen_for_long_by_any_sensor_has_gone_somewhere(ann):
    ann.see(glimpse(0.0, (0.0, 1.2, 1.5)), X_WC, None)
    ann.bump((), FORGET_S - 1.0)
    assert not ann.people()[0].missing
    ann.bump((), FORGET_S + 1.0)
    assert ann.people()[0].missing


def test_who_was_never_seen_is_where_the_map_says_for_good(ann):
    ann.bump((), 1000.0)
    assert not ann.people()[0].missing


BANANA = Shape(
    kind="box",
    size_m=(0.19, 0.068, 0.036),
    pieces=(
        Piece(kind="box", size_m=(0.08, 0.036, 0.036)),
        Piece(
            kind="box",
            size_m=(0.05, 0.068, 0.036),
            X_ShapePiece=SE3((0.07, 0.0, 0.0)),
            is_held=False,
        ),
    ),
)
BOTTLE = Shape(
    kind="cylinder",
    size_m=(0.075, 0.075, 0.30),
    pieces=(
        Piece(kind="cylinder", size_m=(0.075, 0.075, 0.2), X_ShapePiece=SE3((0, 0, -0.05))),
        Piece(kind="cylinder", size_m=(0.03, 0.03, 0.1), X_ShapePiece=SE3((0, 0, 0.10))),
    ),
)


def test_fingers_open_around_the_middle_of_a_banana_do_not_hold_it(model):
    """They are 8 cm apart, as they come: about as wide as all of it is, bent as it is."""
    model.know((msgspec.structs.replace(CUP, shape=BANANA),))
    model.see(seen(0.0, (0.0, 0.2, 1.5)), X_WC, depth())
    X_WO = cup(model).X_WO
    model.feel({"right": Hand(X_WO, 0.081, GRIPPING, MOST_M)})
    assert cup(model).held_by is None
    model.feel({"right": Hand(X_WO, 0.036, GRIPPING, MOST_M)})
    assert cup(model).held_by == "right"


def test_a_bottle_is_held_by_its_neck_too(model):
    """Fingers 3 cm apart, 10 cm above its middle, hold it; around its belly they do not."""
    model.know((msgspec.structs.replace(CUP, shape=BOTTLE),))
    model.see(seen(0.0, (0.0, 0.2, 1.5)), X_WC, depth())
    X_WO = cup(model).X_WO
    above = X_WO.rotation()[:, 2] * 0.10 + np.array(X_WO.p)
    for p, opening_m, holds in ((X_WO.p, 0.03, False), (tuple(above.tolist()), 0.03, True)):
        model.feel({"right": Hand(SE3(p, X_WO.quat_wxyz), opening_m, GRIPPING, MOST_M)})
        assert (cup(model).held_by == "right") is holds
