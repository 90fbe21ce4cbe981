"""Things on surfaces in depth images that are drawn exactly: found, placed, measured, told apart.

A box is x, y of its middle, half its width, and its height above the table.
"""

import math

import numpy as np
import pytest

from robot.messages import RgbdImage
from robot.perception.tabletop.cloud import cloud
from robot.perception.tabletop.surfaces import surfaces
from robot.perception.tabletop.things import things
from robot.se3 import SE3

WIDTH, HEIGHT, FOCAL = 320, 240, 208.0
EYE = (0.0, 0.0, 1.15)
DOWN_RAD = 0.6
TABLE_M = 0.72
FORWARD = SE3.from_rpy(-math.pi / 2 - DOWN_RAD, 0.0, -math.pi / 2, EYE)
"""X_WC: looks along x and down; C has x right, y down, z forward."""


def rays() -> np.ndarray:
    u, v = np.meshgrid(
        (np.arange(WIDTH) - (WIDTH - 1) / 2) / FOCAL, (np.arange(HEIGHT) - (HEIGHT - 1) / 2) / FOCAL
    )
    return np.stack([u, v, np.ones_like(u)], axis=-1) @ FORWARD.rotation().T


def along_box(directions, low, high) -> np.ndarray:
    """How far along each ray an upright box is entered; infinite where it is missed."""
    with np.errstate(divide="ignore", invalid="ignore"):
        first = (np.array(low) - EYE) / directions
        second = (np.array(high) - EYE) / directions
    enter = np.minimum(first, second).max(axis=-1)
    leave = np.maximum(first, second).min(axis=-1)
    return np.where((enter < leave) & (enter > 0.0), enter, np.inf)


def picture(*boxes, noise_per_m=0.0, seed=0, holes=0.0) -> RgbdImage:
    """A table top, a wall behind it, and boxes."""
    directions = rays()
    depth_m = along_box(directions, (0.35, -0.6, TABLE_M - 0.03), (1.25, 0.6, TABLE_M))
    depth_m = np.minimum(depth_m, along_box(directions, (2.0, -3.0, -0.1), (2.1, 3.0, 3.0)))
    for x, y, half, height in boxes:
        low, high = (x - half, y - half, TABLE_M), (x + half, y + half, TABLE_M + height)
        depth_m = np.minimum(depth_m, along_box(directions, low, high))
    rng = np.random.default_rng(seed)
    depth_m = np.where(np.isfinite(depth_m), depth_m, 0.0)
    depth_m = depth_m + noise_per_m * depth_m**2 * rng.standard_normal(depth_m.shape)
    depth_m[rng.random(depth_m.shape) < holes] = 0.0
    return RgbdImage(
        stamp_s=0.0, width=WIDTH, height=HEIGHT, focal_px=(FOCAL, FOCAL),
        centre_px=((WIDTH - 1) / 2, (HEIGHT - 1) / 2), frame="head_camera", colours=b"",
        depth_m=depth_m.astype(np.float32).tobytes(),
    )  # fmt: skip


def found_in(image: RgbdImage, noise_per_m=0.002):
    points = cloud(image, FORWARD, noise_per_m=noise_per_m)
    return things(points, rng=np.random.default_rng(0))


def test_the_table_is_a_level_surface_at_its_height_and_the_wall_is_none():
    points = cloud(picture(noise_per_m=0.004), FORWARD, noise_per_m=0.004)
    (table,) = surfaces(points, rng=np.random.default_rng(0))
    assert -table.plane[3] == pytest.approx(TABLE_M, abs=0.003)
    assert table.plane[2] > 0.999
    assert table.above(np.array([0.8, 0.0, TABLE_M + 0.1])) == pytest.approx(0.1, abs=0.004)
    inside, outside = np.array([0.8, 0.3, 1.0]), np.array([0.8, 0.9, 1.0])
    assert table.holds(inside, margin_m=0.0)
    assert not table.holds(outside, margin_m=0.1)


@pytest.mark.parametrize(("noise_per_m", "holes"), [(0.0, 0.0), (0.004, 0.1)])
def test_a_box_is_where_it_is_as_large_as_it_is(noise_per_m, holes):
    image = picture((0.8, -0.1, 0.04, 0.12), noise_per_m=noise_per_m, holes=holes)
    (thing,) = found_in(image, noise_per_m or 0.002)
    error = thing.p_W - np.array([0.8, -0.1, TABLE_M + 0.06])
    assert np.linalg.norm(error) < 0.012
    assert thing.width_m == pytest.approx(0.08, abs=0.02)
    assert thing.height_m == pytest.approx(0.12, abs=0.012)
    flat = error[:2] @ np.linalg.solve(thing.covariance_W[:2, :2], error[:2])
    assert flat < 9.0


def test_what_is_not_seen_is_less_sure_along_the_line_of_sight_than_across_it():
    (thing,) = found_in(picture((0.8, 0.0, 0.04, 0.12)))
    assert thing.covariance_W[0, 0] > 2 * thing.covariance_W[1, 1]
    assert np.allclose(thing.covariance_W, thing.covariance_W.T)


def test_one_behind_another_and_two_beside_each_other_are_two():
    behind = found_in(picture((0.6, 0.0, 0.04, 0.1), (0.95, 0.02, 0.04, 0.16)))
    beside = found_in(picture((0.8, 0.08, 0.03, 0.1), (0.8, -0.04, 0.03, 0.1)))
    assert [one.p_W[0] for one in behind] == pytest.approx([0.6, 0.95], abs=0.02)
    assert len(beside) == 2


def test_a_bare_table_has_nothing_on_it_whatever_the_noise():
    for seed in range(5):
        image = picture(noise_per_m=0.004, seed=seed, holes=0.05)
        assert found_in(image, 0.004) == []


def test_what_goes_on_above_is_no_thing_on_the_table_and_what_is_cut_off_is_not_measured():
    assert found_in(picture((1.1, 0.1, 0.05, 0.44))) == []
    assert found_in(picture((0.9, 0.1, 0.05, 0.9))) == []
    assert len(found_in(picture((1.1, 0.1, 0.05, 0.2)))) == 1


def test_a_camera_without_depth_shows_no_points():
    image = picture()
    flat = RgbdImage(
        stamp_s=0.0, width=image.width, height=image.height, focal_px=image.focal_px,
        centre_px=image.centre_px, frame=image.frame, colours=b"",
    )  # fmt: skip
    assert cloud(flat, FORWARD, noise_per_m=0.002) is None


def test_nothing_measured_is_nothing_found():
    image = picture(holes=1.0)
    assert found_in(image) == []
