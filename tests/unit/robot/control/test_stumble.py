"""A swing foot that meets an edge goes back and over it, or comes down before it."""

import numpy as np
import pytest

from robot.control.walking import stumble
from robot.control.walking.footsteps import Sole
from robot.control.walking.swing import Swing
from robot.model import description

DT_S = 0.005
WALKING = description.load("juno").walking
START, LANDING = Sole(0.0, 0.1, 0.0), Sole(0.44, 0.1, 0.0)
DURATION_S = 0.45
WEIGHT_N = 340.0


def fly(swing, *, wall_x_m=np.inf, high_m=0.0):
    """Advance to the end of the step; a foot below `high_m` gets no further than the wall."""
    x_m, way = START.x, []
    while swing.time_s < DURATION_S - 1e-9:
        swing.heed(Sole(x_m, swing.position[1], swing.position[2]))
        swing.advance(DT_S)
        held = swing.z < high_m and x_m <= wall_x_m
        x_m = min(swing.position[0], wall_x_m) if held else swing.position[0]
        way.append((x_m, swing.z))
    return way


def test_a_foot_that_nothing_holds_goes_its_way():
    swing, alone = (Swing(START, LANDING, DURATION_S, WALKING) for _ in range(2))
    fly(swing)
    while alone.time_s < DURATION_S - 1e-9:
        alone.advance(DT_S)
    assert swing.position == alone.position
    assert (swing.raises, swing.blocked) == (0, False)


def test_a_foot_that_is_held_early_goes_over_and_still_lands_where_it_was_to():
    swing = Swing(START, LANDING, DURATION_S, WALKING)
    way = fly(swing, wall_x_m=0.02, high_m=0.06)  # higher than an ordinary step goes
    assert swing.raises >= 1
    assert not swing.blocked
    assert max(z for _, z in way) > WALKING.step_height_m + 0.5 * stumble.RAISE_M
    assert way[-1][0] == pytest.approx(LANDING.x, abs=2e-3)


def test_a_foot_that_is_held_goes_back_before_it_goes_on():
    swing = Swing(START, LANDING, DURATION_S, WALKING)
    while swing.position[0] < 0.05:
        swing.advance(DT_S)
    swing.heed(Sole(0.02, START.y, 0.0))
    assert swing.position[0] == pytest.approx(0.02 - stumble.BACK_M)
    assert swing.velocity == [0.0, 0.0, 0.0]


def test_a_foot_that_is_held_late_comes_down_before_what_holds_it():
    swing = Swing(START, LANDING, DURATION_S, WALKING)
    wall_x_m = 0.36
    way = fly(swing, wall_x_m=wall_x_m, high_m=1.0)
    assert swing.blocked
    assert wall_x_m - 2.0 * stumble.BACK_M < way[-1][0] <= wall_x_m
    swing.aim(LANDING, DT_S)
    assert swing.landing[0] <= wall_x_m


def test_a_foot_is_not_lifted_for_ever():
    swing = Swing(START, LANDING, DURATION_S, WALKING)
    fly(swing, wall_x_m=0.02, high_m=1.0)
    assert swing.raises <= stumble.MOST_RAISES
    assert swing.height_m <= WALKING.step_height_m + stumble.MOST_RAISES * stumble.RAISE_M + 1e-9


@pytest.mark.parametrize("across", [(-81.0, 0.0), (0.0, 81.0), (60.0, -60.0)])
def test_what_pushes_a_foot_along_without_bearing_it_is_no_floor(across):
    wrenches = np.zeros((2, 6))
    wrenches[0, :3] = 10.0, 5.0, 300.0
    wrenches[1, :2], wrenches[1, 2] = across, 45.0
    load = [300.0 / WEIGHT_N, 45.0 / WEIGHT_N]
    assert stumble.bearing(load, wrenches, WEIGHT_N) == [load[0], 0.0]


def test_a_floor_bears_as_far_as_friction_goes_however_lightly_and_sensors_may_be_off():
    wrenches = np.zeros((2, 6))
    wrenches[0, :3] = 250.0, 0.0, 300.0
    wrenches[1, :3] = -20.0, 10.0, 7.0
    load = [300.0 / WEIGHT_N, 7.0 / WEIGHT_N]
    assert stumble.bearing(load, wrenches, WEIGHT_N) == load
