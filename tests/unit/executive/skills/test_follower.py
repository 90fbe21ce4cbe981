"""The path follower: within the gait's limits, and it gets there."""

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.skills.motions.path_follower import Follower, Stretch, turn_towards
from robot.model.description import load
from robot.se3 import SE3, wrap_angle

GAIT = load("juno").walking
coordinate = st.floats(-4.0, 4.0)
angle = st.floats(-math.pi, math.pi)
stance = st.tuples(coordinate, coordinate, angle)


def follower_of(start, waypoints):
    return Follower(start, waypoints, walking=GAIT, speeds_m_s=[0.4] * len(waypoints))


@given(stance, st.lists(stance, min_size=1, max_size=5), stance)
def test_twists_stay_within_the_gait(start, waypoints, here):
    follower = follower_of(start, waypoints)
    twist = follower.twist(SE3.from_xy_yaw(*here))
    assert -GAIT.max_backward_m_s - 1e-9 <= twist.forward_m_s <= GAIT.max_forward_m_s + 1e-9
    assert abs(twist.left_m_s) <= GAIT.max_sideways_m_s + 1e-9
    assert abs(twist.turn_rad_s) <= GAIT.max_turn_rad_s + 1e-9


def walk(follower, X_WS, seconds=90.0, dt_s=0.05):
    trail = [X_WS]
    for _ in range(int(seconds / dt_s)):
        twist = follower.twist(X_WS)
        if follower.done:
            break
        X_WS = X_WS @ SE3.from_xy_yaw(
            twist.forward_m_s * dt_s, twist.left_m_s * dt_s, twist.turn_rad_s * dt_s
        )
        trail.append(X_WS)
    return trail


def facing_path(points, start_yaw):
    """Waypoints that turn on the spot at every corner, then walk straight ahead."""
    stances, yaw = [], start_yaw
    for a, b in itertools.pairwise(points):
        yaw = math.atan2(b[1] - a[1], b[0] - a[0])
        stances += [(*a, yaw), (*b, yaw)]
    return stances


@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), min_size=2, max_size=4), angle)
def test_it_gets_to_the_end_and_stays_near_the_path(corners, yaw):
    points = [corners[0]]
    points += [b for a, b in itertools.pairwise(corners) if a != b]
    if len(points) < 2:
        return
    points = [(float(x), float(y)) for x, y in points]
    start = (*points[0], yaw)
    follower = follower_of(start, facing_path(points, yaw))
    trail = walk(follower, SE3.from_xy_yaw(*start))
    assert follower.done
    assert math.dist(trail[-1].p[:2], points[-1]) < 0.2
    for X_WS in trail:
        off_m = min(_distance(X_WS.p[:2], a, b) for a, b in itertools.pairwise(points))
        assert off_m < 0.15


@given(st.floats(-0.3, 0.3), st.floats(-0.5, 0.5))
def test_it_comes_back_onto_the_path(aside_m, askew_rad):
    follower = follower_of((0.0, 0.0, 0.0), [(4.0, 0.0, 0.0)])
    trail = walk(follower, SE3.from_xy_yaw(0.0, aside_m, askew_rad))
    late = [X_WS for X_WS in trail if X_WS.p[0] > 2.5]
    assert late
    assert all(abs(X_WS.p[1]) < 0.05 for X_WS in late)


@pytest.mark.parametrize("bearing", [0.5 * math.pi, -0.5 * math.pi, math.pi])
def test_it_steps_sideways_and_backwards_where_the_path_says_so(bearing):
    goal = (math.cos(bearing), math.sin(bearing), 0.0)
    follower = follower_of((0.0, 0.0, 0.0), [goal])
    trail = walk(follower, SE3())
    assert follower.done
    assert max(abs(X_WS.yaw_rad) for X_WS in trail) < 0.05


def test_remaining_never_grows_and_ends_at_nothing():
    path = facing_path([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.5, 0.5)], 2.0)
    follower = follower_of((0.0, 0.0, 2.0), path)
    remaining, X_WS = [], SE3.from_xy_yaw(0.0, 0.0, 2.0)
    for _ in range(1500):
        twist = follower.twist(X_WS)
        remaining.append(follower.remaining_m)
        X_WS = X_WS @ SE3.from_xy_yaw(
            twist.forward_m_s * 0.05, twist.left_m_s * 0.05, twist.turn_rad_s * 0.05
        )
    assert all(b <= a + 1e-9 for a, b in itertools.pairwise(remaining))
    assert remaining[-1] == pytest.approx(0.0)


def test_where_the_path_comes_back_on_itself_it_does_not_jump_ahead():
    there_and_back = [(3.0, 0.0, 0.0), (3.0, 0.0, math.pi), (0.0, 0.0, math.pi)]
    follower = follower_of((0.0, 0.0, 0.0), there_and_back)
    trail = walk(follower, SE3())
    assert max(X_WS.p[0] for X_WS in trail) > 2.7
    assert abs(trail[-1].p[0]) < 0.2


def test_a_way_that_begins_behind_is_taken_up_ahead():
    follower = follower_of((0.0, 0.0, 0.0), [(-0.06, 0.0, 0.0), (2.0, 0.0, 0.0)])
    trail = walk(follower, SE3())
    assert follower.done
    assert min(X_WS.p[0] for X_WS in trail) > -0.1


@given(st.lists(stance, min_size=2, max_size=4), st.floats(-1.0, 20.0))
def test_a_stance_along_a_run_lies_on_it(stances, along_m):
    if any(math.dist(a[:2], b[:2]) < 1e-3 for a, b in itertools.pairwise(stances)):
        return
    x, y, yaw = Stretch(stances, [0.4] * (len(stances) - 1)).stance(along_m)
    off_m = min(_distance((x, y), a[:2], b[:2]) for a, b in itertools.pairwise(stances))
    assert off_m < 1e-6
    assert abs(wrap_angle(yaw)) <= math.pi


@given(angle)
def test_turning_goes_the_short_way(error):
    assert turn_towards(error, GAIT).turn_rad_s * error >= 0.0


def _distance(p, a, b):
    ux, uy = b[0] - a[0], b[1] - a[1]
    span = ux * ux + uy * uy
    t = max(0.0, min(1.0, ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / span))
    return math.hypot(p[0] - a[0] - t * ux, p[1] - a[1] - t * uy)


@pytest.mark.parametrize("angle_rad", [0.5, 1.0, 1.57, 2.2])
@pytest.mark.parametrize("lag_s", [0.3, 0.6])
@pytest.mark.parametrize("fast_m_s", [0.0, 0.53])
def test_a_body_that_lags_does_not_cut_corners(angle_rad, lag_s, fast_m_s):
    """A table may stand in the corner: 6 cm is all that the planner keeps clear."""
    path = rounded_corner(angle_rad)
    ends_m_s, corner_m_s = (fast_m_s, 0.30) if fast_m_s else (0.4, 0.4)
    speeds_m_s = [ends_m_s, *[corner_m_s] * (len(path) - 2), ends_m_s]
    follower = Follower((0.0, 0.0, 0.0), path, walking=GAIT, speeds_m_s=speeds_m_s)
    X_WS, velocity, worst_m, dt_s = SE3(), [0.0, 0.0, 0.0], 0.0, 0.05
    stops = [(0.0, 0.0, 0.0), *path]
    for _ in range(600):
        twist = follower.twist(X_WS)
        velocity = [v + dt_s / lag_s * (t - v) for v, t in zip(velocity, twist, strict=True)]
        X_WS = X_WS @ SE3.from_xy_yaw(*(v * dt_s for v in velocity))
        off_m = min(_distance(X_WS.p[:2], a, b) for a, b in itertools.pairwise(stops))
        worst_m = max(worst_m, off_m)
    assert follower.done
    late_m = 0.03 if fast_m_s and lag_s > 0.5 else 0.0  # `Committed` makes up for most of a lag
    assert worst_m < 0.06 + late_m


def rounded_corner(angle_rad, leg_m=1.5, cut_m=0.35):
    """Straight on, a rounded corner, straight on: stances that look along the path."""
    end = (leg_m + leg_m * math.cos(angle_rad), leg_m * math.sin(angle_rad))
    after = (
        leg_m + cut_m * math.cos(angle_rad),
        cut_m * math.sin(angle_rad),
    )
    points = [(0.5, 0.0), (leg_m - cut_m, 0.0)]
    for t in (0.25, 0.5, 0.75, 1.0):
        x = (1 - t) ** 2 * (leg_m - cut_m) + 2 * t * (1 - t) * leg_m + t**2 * after[0]
        points.append((x, t**2 * after[1]))
    points.append(end)
    ways = [math.atan2(b[1] - a[1], b[0] - a[0]) for a, b in itertools.pairwise(points)]
    yaws = [ways[0], *(0.5 * (a + b) for a, b in itertools.pairwise(ways)), ways[-1]]
    return [(x, y, yaw) for (x, y), yaw in zip(points, yaws, strict=True)]


def test_only_the_narrow_part_of_a_way_is_walked_slowly():
    path = [(1.0, 0.0, 0.0), (2.0, 0.0, 0.0), (5.0, 0.0, 0.0)]
    follower = Follower((0.0, 0.0, 0.0), path, walking=GAIT, speeds_m_s=[0.4, 0.2, 0.4])
    speeds = [follower.twist(SE3((0.3 * i, 0.0, 0.0))).forward_m_s for i in range(1, 11)]
    slow = [0.8 < 0.3 * i < 2.0 for i in range(1, 11)]
    assert speeds == pytest.approx([0.2 if narrow else 0.4 for narrow in slow])


NARROW_M_S, WIDE_M_S = 0.30, 0.50


@given(st.floats(0.0, 0.6), st.sampled_from([NARROW_M_S, WIDE_M_S]))
def test_a_bend_slows_what_is_fast_and_not_twice_what_is_slow(bend_rad, here_m_s):
    """Where it is slow for want of room it goes no slower for a bend that takes no more."""
    x_m, y_m = 1.0 + math.cos(bend_rad), math.sin(bend_rad)
    waypoints = [(1.0, 0.0, 0.0), (x_m, y_m, bend_rad), (2.0 * x_m, 2.0 * y_m, bend_rad)]
    speeds_m_s = [here_m_s, here_m_s, WIDE_M_S]
    start = (0.0, 0.0, 0.0)
    follower = Follower(start, waypoints, walking=GAIT, speeds_m_s=speeds_m_s)
    twist = follower.twist(SE3.from_xy_yaw(0.55, 0.0, 0.0))
    way = Stretch([start, *waypoints], speeds_m_s)
    turning_rad = abs(way.stance(0.55 + GAIT.following.bend_ahead_m)[2])
    bends_m_s = WIDE_M_S / (1.0 + GAIT.following.slow_in_bends_1_rad * turning_rad)
    speed_m_s = math.hypot(twist.forward_m_s, twist.left_m_s)
    assert speed_m_s == pytest.approx(min(here_m_s, bends_m_s), rel=1e-6)
