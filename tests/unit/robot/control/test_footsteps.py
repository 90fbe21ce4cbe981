"""Footsteps: inside the limits, the outward foot first, and goals that are reached."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from robot.control.walking.footsteps import (
    FootstepPlanner,
    Sole,
    Target,
    Twist,
    other,
    sign_of,
    stance_of,
)
from robot.model import description
from robot.se3 import wrap_angle
from tests.fakes.bodies import shipped_or_skip

ROBOT = description.load()
WALKING, FOOT = ROBOT.walking, ROBOT.feet["left"]
HALF_M = 0.5 * WALKING.stance_width_m
START = {"left": Sole(0.0, HALF_M, 0.0), "right": Sole(0.0, -HALF_M, 0.0)}

places = st.floats(-3.0, 3.0)
headings = st.floats(-math.pi, math.pi)
stances = st.builds(Sole, places, places, headings)
twists = st.builds(Twist, st.floats(-0.3, 0.5), st.floats(-0.18, 0.18), st.floats(-0.7, 0.7))


@pytest.fixture(scope="module")
def planner():
    return FootstepPlanner(WALKING, FOOT)


def target(goal):
    return Target(goal, 0.015, 0.03)


def feet_of(stance):
    return {"left": stance.offset(0.0, HALF_M), "right": stance.offset(0.0, -HALF_M)}


def walk(planner, feet, wish, *, first, steps):
    """Landings (side, sole, support) until the wish is met, at most `steps`."""
    feet, side, landings = dict(feet), first, []
    while len(landings) < steps:
        landing = planner.next(feet[other(side)], feet[side], side, wish)
        if landing is None:
            break
        landings.append((side, landing, feet[other(side)]))
        feet[side] = landing
        side = other(side)
    return landings, feet


def within_limits(side, landing, support):
    forward, left, turn = support.relative(landing)
    s = sign_of(side)
    width = s * left
    # the landing is offset from the stance's line, turned by at most one step's turn
    slack = 2.0 * HALF_M * (1.0 - math.cos(WALKING.max_step_turn_rad)) + 1e-9
    assert abs(forward) <= WALKING.max_step_length_m + HALF_M * math.sin(abs(turn)) + 1e-9
    assert width >= WALKING.min_stance_width_m - slack
    assert width <= WALKING.stance_width_m + WALKING.max_step_width_m + slack
    assert abs(turn) <= WALKING.max_step_turn_rad + 1e-9
    for x in (-FOOT.half_length_m, FOOT.half_length_m):
        for y in (-FOOT.half_width_m, FOOT.half_width_m):
            corner = landing.offset(x, y)
            _, corner_left, _ = support.relative(corner)
            assert s * corner_left >= FOOT.half_width_m + WALKING.sole_gap_m - 1e-9


@given(twists, st.sampled_from(["left", "right"]))
def test_steps_of_a_twist_keep_the_limits(planner, twist, first):
    landings, _ = walk(planner, START, twist, first=first, steps=8)
    for side, landing, support in landings:
        within_limits(side, landing, support)


@given(stances)
def test_a_goal_is_reached_in_finitely_many_steps_within_the_limits(planner, goal):
    wish = target(goal)
    first = planner.first_swing(START["left"], START["right"], wish)
    landings, feet = walk(planner, START, wish, first=first, steps=120)
    for side, landing, support in landings:
        within_limits(side, landing, support)
    stance = stance_of(feet["left"], feet["right"])
    assert len(landings) < 120
    if landings:
        assert math.dist((stance.x, stance.y), (goal.x, goal.y)) < 0.03
        assert abs(wrap_angle(stance.yaw - goal.yaw)) < 0.06


@given(stances)
def test_a_goal_that_is_met_asks_for_no_step(planner, goal):
    feet = feet_of(goal)
    for side in ("left", "right"):
        assert planner.next(feet[other(side)], feet[side], side, target(goal)) is None


@given(stances)
def test_no_twist_on_a_square_stance_asks_for_no_step(planner, stance):
    feet = feet_of(stance)
    for side in ("left", "right"):
        assert planner.next(feet[other(side)], feet[side], side, Twist()) is None


@given(st.floats(0.02, 0.18), st.sampled_from([1.0, -1.0]), st.floats(-0.1, 0.1))
def test_the_outward_foot_moves_first_sideways(planner, speed, sign, forward):
    side = planner.first_swing(START["left"], START["right"], Twist(forward, sign * speed, 0.0))
    assert side == ("left" if sign > 0.0 else "right")


@given(st.floats(0.3, math.pi - 0.01), st.sampled_from([1.0, -1.0]))
def test_the_outward_foot_moves_first_in_a_turn(planner, turn, sign):
    wish = target(Sole(0.0, 0.0, sign * turn))
    side = planner.first_swing(START["left"], START["right"], wish)
    assert side == ("left" if sign > 0.0 else "right")


@given(stances, st.sampled_from([0.05, -0.05]))
def test_a_staggered_stance_is_squared_when_asked_to_stand(planner, stance, lead):
    feet = feet_of(stance)
    feet["left"] = feet["left"].offset(lead, 0.0)
    landing = planner.next(feet["right"], feet["left"], "left", Twist())
    assert landing is not None
    forward, left, turn = feet["right"].relative(landing)
    assert math.isclose(forward, 0.0, abs_tol=1e-9)
    assert math.isclose(left, WALKING.stance_width_m, abs_tol=1e-9)
    assert math.isclose(turn, 0.0, abs_tol=1e-9)


@given(twists)
def test_two_steps_of_a_steady_twist_advance_as_asked(planner, twist):
    """Inside the limits of a step, a pair of steps covers what the twist covers in that time."""
    pair_s = 2.0 * planner.step_time_s
    assume(twist != Twist())
    assume(abs(twist.turn_rad_s) * pair_s < 0.95 * WALKING.max_step_turn_rad)
    assume(abs(twist.left_m_s) * pair_s < 0.95 * WALKING.max_step_width_m)
    assume(abs(twist.forward_m_s) * planner.step_time_s < 0.9 * WALKING.max_step_length_m)
    assume(twist.forward_m_s > -0.9 * WALKING.max_backward_m_s)
    landings, _ = walk(planner, START, twist, first="left", steps=10)
    soles = (
        {side: sole for side, sole, _ in landings[:8]},
        {side: sole for side, sole, _ in landings},
    )
    before, after = (stance_of(pair["left"], pair["right"]) for pair in soles)
    _, _, turned = before.relative(after)
    moved = math.dist((before.x, before.y), (after.x, after.y))
    assert math.isclose(turned, twist.turn_rad_s * pair_s, abs_tol=1e-6)
    asked = math.hypot(twist.forward_m_s, twist.left_m_s) * pair_s
    assert moved == pytest.approx(asked, rel=0.15, abs=0.02)  # feet that turn apart


@pytest.mark.parametrize("name", ["juno", "g1", "t1"])
def test_steps_are_long_enough_for_the_top_speed(name):
    robot = description.load(shipped_or_skip(name))
    gait = robot.walking
    planner = FootstepPlanner(gait, robot.feet["left"])
    half_m = 0.5 * gait.stance_width_m
    feet = {"left": Sole(0.0, half_m, 0.0), "right": Sole(0.0, -half_m, 0.0)}
    top = Twist(gait.max_forward_m_s)
    landings, _ = walk(planner, feet, top, first="left", steps=10)
    strides_m = [
        b.x - a.x for (_, a, _), (_, b, _) in zip(landings[2:], landings[4:], strict=False)
    ]
    asked_m = 2.0 * planner.step_time_s * gait.max_forward_m_s
    assert strides_m == pytest.approx([asked_m] * len(strides_m), abs=1e-6)


@given(stances, st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), headings)
def test_offset_and_relative_undo_each_other(sole, forward, left, turn):
    assert sole.relative(sole.offset(forward, left, turn_rad=turn)) == pytest.approx(
        (forward, left, wrap_angle(turn)), abs=1e-9
    )
