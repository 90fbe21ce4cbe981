"""A step that catches a push comes down under the DCM, where the leg can put it."""

import math

import pytest

from robot.control.walking.catching import (
    LONGEST_SHARE,
    SHORTEST_SHARE,
    Catch,
)
from robot.control.walking.dcm import DcmPlan, Segment
from robot.control.walking.footsteps import FootstepPlanner, Sole

PLANNED_S, OMEGA_1_S = 0.4, 4.2


@pytest.fixture
def catch(juno):
    """A step of the left foot straight ahead, the DCM off its plan by so much."""
    half_m = 0.5 * juno.walking.stance_width_m
    support, planned = Sole(0.0, -half_m, 0.0), Sole(0.1, half_m, 0.0)
    stance = (support.x, support.y)
    plan = DcmPlan([Segment(stance, stance, PLANNED_S)], (0.1, 0.0), OMEGA_1_S)

    def make(dx_m=0.0, dy_m=0.0, *, past_s=0.1):
        x, y = plan.at(past_s)[0]
        return Catch(
            plan=plan, planned_s=PLANNED_S, past_s=past_s, omega_1_s=OMEGA_1_S,
            gain_1_s=juno.balance.dcm_1_s,
            xi=(x + dx_m, y + dy_m), zmp=stance, planned=planned, support=support, side="left",
            planner=FootstepPlanner(juno.walking, juno.feet["left"]),
        )  # fmt: skip

    return make


def test_a_step_that_goes_as_planned_is_left_alone(catch):
    step = catch()
    assert step.shift(PLANNED_S) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert step.landing(step.shift(PLANNED_S)) == step.planned


@pytest.mark.parametrize("angle_rad", [0.0, 0.7, 1.5])
def test_the_landing_goes_where_the_dcm_goes_less_a_deadband(catch, juno, angle_rad):
    off_m = 0.03
    step = catch(off_m * math.cos(angle_rad), off_m * math.sin(angle_rad))
    shift = step.shift(PLANNED_S)
    grown_m = off_m * math.exp(OMEGA_1_S * (PLANNED_S - 0.1))
    assert math.hypot(*shift) == pytest.approx(grown_m, rel=1e-6)
    landing = step.landing(shift)
    moved = landing.x - step.planned.x, landing.y - step.planned.y
    ignored_m = juno.walking.catching.ignored_m
    assert math.hypot(*moved) == pytest.approx(grown_m - ignored_m, rel=1e-6)
    assert math.atan2(moved[1], moved[0]) == pytest.approx(angle_rad, abs=1e-6)


@pytest.mark.parametrize("dx_m", [-1.0, 0.0, 1.0])
@pytest.mark.parametrize("dy_m", [-1.0, 0.0, 1.0])
def test_no_landing_is_out_of_reach_or_on_the_other_foot(catch, juno, dx_m, dy_m):
    step = catch(dx_m, dy_m)
    forward, left, _ = step.support.relative(step.landing(step.shift(PLANNED_S)))
    assert abs(forward) <= juno.walking.catching.forward_m + 1e-9
    assert 2.0 * juno.feet["left"].half_width_m < left <= juno.walking.catching.side_m + 1e-9


@pytest.mark.parametrize("past_s", [0.02, 0.15, 0.3])
@pytest.mark.parametrize("dx_m", [-0.1, 0.0, 0.1])
def test_the_time_stays_near_the_planned_one_and_ahead(catch, dx_m, past_s):
    best_s = catch(dx_m, past_s=past_s).best_time(0.0, 0.05)
    assert max(SHORTEST_SHARE * PLANNED_S, past_s) <= best_s <= LONGEST_SHARE * PLANNED_S


def test_a_push_that_the_planned_step_cannot_catch_is_met_sooner(catch):
    """Far out at the planned time, within reach before."""
    assert catch(0.0, 0.15).best_time(0.1, 0.06) < PLANNED_S
