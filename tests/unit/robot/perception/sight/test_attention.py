"""When it is worth a picture: a table of where the camera is, and how often is looked."""

import itertools
import math

import pytest

from robot.perception.sight.attention import AGAIN_S, LOOKS, PASSING_S, WATCH_S, Attention
from robot.se3 import SE3

PERIOD_S = 0.1


def looks(poses: list[SE3], attention: Attention, *, from_s: float = 0.0) -> list[float]:
    """When is looked, with the camera at one of these poses after the other."""
    times = [from_s + PERIOD_S * k for k in range(len(poses))]
    return [time_s for time_s, X in zip(times, poses, strict=True) if attention.wants(time_s, X)]


def there(yaw_rad: float = 0.0) -> SE3:
    return SE3.from_xy_yaw(1.0, 2.0, yaw_rad)


def test_eyes_at_rest_look_some_times_at_once_and_then_now_and_then():
    taken = looks([there()] * 60, Attention())
    spans = [b - a for a, b in itertools.pairwise(taken)]
    assert all(span >= AGAIN_S - 1e-6 for span in spans)
    assert spans[: LOOKS - 1] == pytest.approx([AGAIN_S] * (LOOKS - 1))
    assert all(span >= WATCH_S - 1e-6 for span in spans[LOOKS:])
    assert len(taken) < 60 * PERIOD_S / WATCH_S + LOOKS + 1


def test_where_the_head_has_turned_to_is_looked_at_soon_after_it_has_come_to_rest():
    attention = Attention()
    looks([there()] * 30, attention)
    turn = [there(0.05 * k) for k in range(10)]
    looks(turn, attention, from_s=3.0)
    taken = looks([there(0.45)] * 10, attention, from_s=4.0)
    assert taken[0] < 4.0 + 2 * AGAIN_S + 1e-6
    assert len(taken) >= 3, "a skill waits for three sightings"


def test_in_passing_there_are_glances_no_more():
    walk = [SE3.from_xy_yaw(0.04 * k, 0.0, 0.0) for k in range(100)]
    taken = looks(walk, Attention())
    assert len(taken) <= math.ceil(100 * PERIOD_S / PASSING_S) + 1
    assert len(taken) >= 5


def test_the_same_poses_are_looked_from_at_the_same_times():
    walk = [SE3.from_xy_yaw(0.01 * (k // 7), 0.0, 0.1 * (k // 20)) for k in range(100)]
    assert looks(walk, Attention()) == looks(walk, Attention())
