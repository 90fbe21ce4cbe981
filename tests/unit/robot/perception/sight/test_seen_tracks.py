"""Things over several looks: one stays one, what moved is where it is, what is gone is gone."""

import math

import numpy as np
import pytest

from robot.perception.sight.tracking import MISSES, Tracks
from robot.perception.things.inputs import sight
from robot.se3 import SE3
from tests.fakes.things_in_view import measured, picture_of

AHEAD = SE3.from_rpy(-math.pi / 2, 0.0, -math.pi / 2, (0.0, 0.0, 0.76))
"""A camera that looks along x of the world."""


def view(depth_m: float):
    found = sight(picture_of(np.full((60, 80), depth_m, np.float32)), AHEAD)
    assert found is not None
    return found


def test_looks_at_one_thing_make_one_track_that_gets_surer():
    rng, tracks, sigmas = np.random.default_rng(3), Tracks(), []
    for k in range(10):
        x, y = (0.004 * rng.standard_normal(2)).tolist()
        (track,) = tracks.add([measured((1.0 + x, y, 0.76))], 0.2 * k)
        sigmas.append(float(np.trace(track.covariance_W)))
    assert len(tracks.things) == 1
    assert sigmas == sorted(sigmas, reverse=True)
    assert np.linalg.norm(track.p_W - [1.0, 0.0, 0.76]) < 0.004


def test_two_that_stand_side_by_side_are_two_and_stay_so():
    tracks = Tracks()
    for k in range(4):
        pair = [measured((1.0, 0.0, 0.76)), measured((1.0, 0.075, 0.76))]
        first, second = tracks.add(pair if k % 2 else pair[::-1], 0.2 * k)
        assert first.number != second.number
    assert len(tracks.things) == 2
    assert sorted(round(float(t.p_W[1]), 3) for t in tracks.things) == [0.0, 0.075]


def test_what_was_pushed_is_where_it_is_now():
    tracks = Tracks()
    for k in range(5):
        tracks.add([measured()], 0.2 * k)
    (track,) = tracks.add([measured((1.05, 0.0, 0.76))], 1.2)
    assert track.looks == 6
    assert track.p_W[0] == pytest.approx(1.05, abs=0.003)


def test_a_part_that_shows_beside_the_hand_does_not_move_a_thing():
    tracks = Tracks()
    for k in range(5):
        tracks.add([measured()], 0.2 * k)
    (track,) = tracks.add([measured((1.03, 0.02, 0.76), is_whole=False, sigma_m=0.02)], 1.2)
    assert np.linalg.norm(track.p_W - [1.0, 0.0, 0.76]) < 0.005


@pytest.mark.parametrize(
    ("depth_m", "is_gone"),
    [(1.5, True), (0.96, False), (0.5, False), (0.0, False)],
    ids=["behind it", "its own front", "something before it", "no depth"],
)
def test_gone_is_what_can_be_looked_through(depth_m, is_gone):
    tracks = Tracks()
    tracks.add([measured()], 0.0)
    tracks.add([measured()], 0.2)
    for k in range(MISSES):
        tracks.miss(view(depth_m), [], 0.4 + 0.2 * k)
    assert (not tracks.things) == is_gone


def test_what_is_beside_the_picture_is_not_missed():
    tracks = Tracks()
    tracks.add([measured((1.0, 3.0, 0.76))], 0.0)
    assert tracks.miss(view(2.0), [], 0.2) == []


def test_what_is_seen_a_little_aside_as_the_robot_errs_in_where_it_is_is_not_gone():
    tracks = Tracks()
    for k in range(3):
        tracks.add([measured()], 0.2 * k)
    depth_m = np.full((60, 80), 1.6, np.float32)
    depth_m[20:40, 36:50] = 0.96  # 7 cm wide, its middle 2 cm beside where it is believed to be
    seen = sight(picture_of(depth_m), AHEAD)
    assert seen is not None
    for k in range(2 * MISSES):
        tracks.miss(seen, [], 1.0 + 0.2 * k)
    assert len(tracks.things) == 1


def test_what_looks_round_again_and_again_is_surely_round():
    tracks = Tracks()
    for k in range(6):
        (track,) = tracks.add([measured()._replace(roundness=1.0)], 0.2 * k)
        if not k:
            first = track.roundness
    assert track.roundness > first > 0.0
