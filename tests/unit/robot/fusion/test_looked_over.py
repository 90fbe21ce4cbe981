"""A point of a surface was seen when a small thing there would have been plain to see."""

import math

import numpy as np
import pytest

from robot.fusion.looked_over import WELL_M, LookedOver
from robot.messages import DepthImage, Place
from robot.se3 import SE3

WIDTH, HEIGHT, FOVY_RAD = 53, 40, math.radians(60)
EYE_M = 1.1


def camera(pitch_rad: float = 0.4) -> SE3:
    """At eye height over the origin, looking along +x and down by so much."""
    c, s = math.cos(pitch_rad), math.sin(pitch_rad)
    return SE3.from_rotation([[0, -s, c], [-1, 0, 0], [0, -c, -s]], (0.0, 0.0, EYE_M))


def picture(depth_m: float = 0.0, *, columns: slice = slice(None), stamp_s: float = 1.0):
    """Nothing within range but what is `depth_m` away in some columns."""
    image = np.zeros((HEIGHT, WIDTH), np.float32)
    image[:, columns] = depth_m
    return DepthImage(
        stamp_s=stamp_s, width=WIDTH, height=HEIGHT, fovy_rad=FOVY_RAD, depth_m=image.tobytes()
    )


def table(x_m: float = 1.3, *, z_m: float = 0.7, name: str = "table") -> Place:
    return Place(id=name, name=name, X_WP=SE3((x_m, 0.0, z_m)), size_m=(0.5, 0.5))


def seen(*places: Place, image: DepthImage, X_WC: SE3) -> list[float]:
    """How much of each place one picture shows."""
    looked = LookedOver()
    looked.know(places)
    looked.see(image, X_WC)
    return [np.isfinite(one.seen_s).mean().item() for one in looked.looked()]


def test_a_surface_in_plain_view_is_seen() -> None:
    assert seen(table(), image=picture(), X_WC=camera()) == [1.0]


def test_what_stands_before_a_surface_hides_it() -> None:
    assert seen(table(), image=picture(0.6), X_WC=camera()) == [0.0]
    (share,) = seen(table(), image=picture(0.6, columns=slice(0, WIDTH // 2)), X_WC=camera())
    assert 0.2 < share < 0.8


@pytest.mark.parametrize("x_m", [WELL_M + 0.4, -1.3])
def test_from_afar_or_out_of_the_picture_nothing_is_seen_well(x_m: float) -> None:
    assert seen(table(x_m), image=picture(), X_WC=camera(0.1)) == [0.0]


def test_at_a_grazing_angle_nothing_is_seen_well() -> None:
    grazing, higher = table(1.6, z_m=EYE_M - 0.05), table(z_m=EYE_M - 0.3)
    assert seen(grazing, higher, image=picture(), X_WC=camera(0.1)) == [0.0, 1.0]


@pytest.mark.parametrize("above_m", [0.02, -0.05])
def test_what_eyes_are_level_with_is_seen_from_the_side(above_m: float) -> None:
    level = table(z_m=EYE_M - above_m)
    assert seen(level, image=picture(), X_WC=camera(0.1)) == [1.0]


def test_what_stands_on_a_point_is_seen_there() -> None:
    """The front of a mug is a few centimetres before the point that it stands on."""
    place = Place(id="spot", name="spot", X_WP=SE3((1.3, 0.0, 0.7)), size_m=(0.1, 0.1))
    depth_m = (camera().inverse() @ SE3((1.3, 0.0, 0.74))).p[2]
    assert seen(place, image=picture(depth_m - 0.04), X_WC=camera()) == [1.0]
    assert seen(place, image=picture(depth_m - 0.20), X_WC=camera()) == [0.0]


def test_it_keeps_when_and_survives_the_same_map_again() -> None:
    looked = LookedOver()
    looked.know((table(),))
    looked.see(picture(stamp_s=3.0), camera())
    looked.know((table(), table(9.0, name="other")))
    first, second = looked.looked()
    assert set(first.seen_s) == {3.0}
    assert set(second.seen_s) == {-math.inf}


def test_floors_are_no_surfaces() -> None:
    looked = LookedOver()
    looked.know((Place(id="room", name="room", X_WP=SE3(), size_m=(4.0, 4.0), floor=True),))
    assert looked.looked() == ()


def test_where_something_stands_that_nobody_made_out_a_surface_is_not_looked_over() -> None:
    """A desk with a green thing on it had "no mug on it" by a picture from 1.6 m."""
    place = table()
    looked = LookedOver()
    looked.know((place,))
    looked.see(picture(), camera())
    assert np.isfinite(looked.looked()[0].seen_s).all()
    corner = place.samples()[0]
    unknown = (float(corner[0]), float(corner[1]), 0.76)
    looked.see(picture(stamp_s=2.0), camera(), doubts_W=[unknown])
    (one,) = looked.looked()
    assert one.seen_s[0] == -math.inf
    assert 2.0 in one.seen_s
    looked.see(picture(stamp_s=3.0), camera())
    assert set(looked.looked()[0].seen_s) == {3.0}


def test_what_stands_under_a_board_leaves_no_doubt_about_the_board() -> None:
    looked = LookedOver()
    looked.know((table(),))
    looked.see(picture(), camera(), doubts_W=[(1.3, 0.0, 0.5), (1.3, 0.0, 1.2)])
    assert np.isfinite(looked.looked()[0].seen_s).all()


@pytest.mark.parametrize(("x_m", "looks"), [(0.9, 2), (1.6, 4)])
def test_eyes_that_may_miss_a_thing_look_several_times_and_more_often_from_afar(
    x_m: float, looks: int
) -> None:
    looked = LookedOver(several=True)
    looked.know((table(x_m),))
    for k in range(looks):
        assert set(looked.looked()[0].seen_s) == {-math.inf}
        looked.see(picture(stamp_s=0.2 * k), camera(0.4))
    assert np.isfinite(looked.looked()[0].seen_s).any()


def test_looks_that_are_far_apart_do_not_add_up() -> None:
    looked = LookedOver(several=True)
    looked.know((table(0.9),))
    for k in range(4):
        looked.see(picture(stamp_s=20.0 * k), camera())
    assert set(looked.looked()[0].seen_s) == {-math.inf}
