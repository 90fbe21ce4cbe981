"""Where a thing is and how large, from rays at a cup and a box on a table: by their true sizes."""

import math

import msgspec
import mujoco
import numpy as np
import pytest

from robot.messages import Place
from robot.perception.sight.measuring import measured
from robot.perception.things.eyes import SeenThing
from robot.perception.things.inputs import sight
from robot.perception.things.naming import Name
from robot.se3 import SE3
from sim.camera.by_rays import Tracer
from sim.camera.scene_view import Pinhole
from tests.fakes.things_in_view import picture_of

TABLE = Place(id="table", name="table", X_WP=SE3((1.0, 0.0, 0.7)), size_m=(0.6, 1.2))
PINHOLE = Pinhole(320, 240, 208.0)
GEOMS = {
    "cup": '<geom type="cylinder" size="0.035 0.05" pos="1 0 0.75"/>',
    "box": '<geom type="box" size="0.03 0.05 0.06" pos="1 0 0.76" euler="0 0 30"/>',
    "none": "",
}
TABLE_XML = '<geom type="box" size="0.3 0.6 0.02" pos="1 0 0.68"/>'


def looked_at(thing: str, *, away_m: float = 0.6, up_m: float = 0.4, hand: bool = False):
    """A thing from a distance; `hand` hides its left half."""
    xml = f"<mujoco><worldbody>{TABLE_XML}{GEOMS[thing]}</worldbody></mujoco>"
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    eye = np.array([1.0 - away_m, 0.0, 0.75 + up_m])
    z = np.array([1.0, 0.0, 0.75]) - eye
    z /= np.linalg.norm(z)
    x = np.array([0.0, -1.0, 0.0])
    R = np.column_stack([x, np.cross(z, x), z])
    tracer = Tracer(model, data, PINHOLE)
    depth_m = tracer.look(eye, R).depth_m
    image = picture_of(np.where(np.isfinite(depth_m), depth_m, 0.0).astype(np.float32))
    pixels, hidden = tracer.met == 1, np.zeros(depth_m.shape, dtype=np.bool_)
    if hand:
        hidden[:, : PINHOLE.width // 2] = True
        pixels = pixels & ~hidden
    return image, SE3.from_rotation(R, eye), pixels, hidden


def taken(thing: str, places=(TABLE,), *, piece: float = 1.0, lower_m=0.0, tilt_rad=0.0, **how):
    """What is measured of a thing, of which only the lowest rows were found if it is a piece.

    The robot may hold its camera to be lower than it is, and to look further down.
    """
    image, X_WC, pixels, hidden = looked_at(thing, **how)
    rows = np.flatnonzero(pixels.any(axis=1))
    pixels[: rows[-1] - round(piece * len(rows))] = False
    middle = ((PINHOLE.width - 1) / 2, (PINHOLE.height - 1) / 2)
    image = msgspec.structs.replace(
        image, focal_px=(PINHOLE.focal_px, PINHOLE.focal_px), centre_px=middle
    )
    wrong = SE3.from_rpy(0.0, tilt_rad, 0.0, (0.0, 0.0, 0.0)).rotation() @ X_WC.rotation()
    view = sight(image, SE3.from_rotation(wrong, np.array(X_WC.p) - [0.0, 0.0, lower_m]))
    assert view is not None
    vague = SeenThing(
        name=Name("", "", 0.0), chances=np.ones(3) / 3, colours=("red",),
        p_W=np.array([1.0, 0.0, 0.75]), covariance_W=np.eye(3), size_m=(0.1, 0.1, 0.1),
        upright=1.0, pixels=pixels, range_m=0.7,
    )  # fmt: skip
    return measured(view, vague, places, hidden=hidden)


@pytest.mark.parametrize(("away_m", "up_m"), [(0.5, 0.3), (0.7, 0.45), (1.1, 0.4)])
def test_a_cup_is_where_it_is_and_as_large_as_it_is(away_m, up_m):
    cup = taken("cup", away_m=away_m, up_m=up_m)
    assert cup is not None and cup.is_whole
    assert np.linalg.norm(cup.p_W - [1.0, 0.0, 0.75]) < 0.008
    assert cup.width_m == pytest.approx(0.07, abs=0.006)
    assert cup.size_m[2] == pytest.approx(0.10, abs=0.008)
    assert cup.foot_m == pytest.approx(0.7)


def test_a_cup_further_away_stands_on_its_table_for_a_robot_that_errs_in_its_tilt():
    straight = taken("cup", away_m=1.35, up_m=0.35)
    assert straight is not None
    cup = taken("cup", away_m=1.35, up_m=0.35, lower_m=0.02, tilt_rad=0.012)
    assert cup is not None and cup.foot_m == pytest.approx(0.7)
    assert np.linalg.norm(cup.p_W[:2] - straight.p_W[:2]) < 0.05


def test_what_is_seen_through_a_table_top_still_stands_on_nothing():
    assert taken("cup", away_m=1.35, up_m=0.35, lower_m=0.1) is None


def test_a_box_has_its_two_sides_and_its_turn():
    box = taken("box", up_m=0.6)
    assert box is not None
    sides = sorted(box.size_m[:2])
    assert sides == pytest.approx([0.06, 0.10], abs=0.015)
    along = box.yaw_rad if box.size_m[0] < box.size_m[1] else box.yaw_rad + math.pi / 2
    off = (along - math.radians(30.0) + math.pi / 2) % math.pi - math.pi / 2
    assert abs(off) < math.radians(8.0)


def test_half_behind_the_hand_it_is_not_whole_and_much_less_sure():
    whole, half = taken("cup"), taken("cup", hand=True)
    assert whole is not None and half is not None
    assert whole.is_whole and not half.is_whole
    assert np.trace(half.covariance_W) > 4.0 * np.trace(whole.covariance_W)


def test_what_stands_on_nothing_that_is_known_is_no_thing():
    assert taken("cup", places=()) is None


@pytest.mark.parametrize("away_m", [0.45, 0.7])
def test_a_piece_of_a_thing_is_no_smaller_thing(away_m):
    """The lower half of a bottle, up to its label, was taken for a can."""
    whole, piece = taken("cup", away_m=away_m), taken("cup", away_m=away_m, piece=0.5)
    assert whole is not None and piece is not None
    assert whole.is_whole and not piece.is_whole
    assert whole.size_sigma_m < 0.02 < 0.05 < piece.size_sigma_m
    assert piece.covariance_W[2, 2] > 10.0 * whole.covariance_W[2, 2]
