"""The floor that the filter knows: it follows a slope, keeps off a stone, finds a platform."""

import math

import numpy as np
import pytest

from robot.fusion.state_estimator.filter import ContactFilter
from robot.fusion.state_estimator.ground import LEVEL, shares
from robot.fusion.state_estimator.parameters import Parameters
from robot.fusion.state_estimator.turning import exponential
from robot.physics import GRAVITY_M_S2

DEG = math.pi / 180.0
DT_S, STEP_S, SPEED_M_S, HIGH_M, HALF_M = 0.005, 0.5, 0.4, 0.6, 0.1
STRIDE_M = 2.0 * SPEED_M_S * STEP_S


class Walker:
    """A body that glides at one speed while its feet, by turns, stand on what is there."""

    def __init__(self, ground):
        """`ground(x, y, step)`: height [m] and rises towards x and y, of a sole put down there."""
        self.ground, self.time_s, self.step = ground, 0.0, 0
        self.noise = np.random.default_rng(7)
        self.feet = [self._put(0.0, HALF_M), self._put(0.0, -HALF_M)]
        self.filter = ContactFilter(Parameters(), np.eye(3), np.array((0.0, 0.0, HIGH_M)))
        self.base = np.array((0.0, 0.0, HIGH_M))
        self._run(1.0, 0.0, (1.0, 1.0))

    def _put(self, x, y):
        height, along, across = self.ground(x, y, self.step)
        return np.array((x, y, height)), exponential(math.atan(across), -math.atan(along), 0.0)

    def _run(self, duration_s, velocity, load):
        for _ in range(round(duration_s / DT_S)):
            self.base = self.base + DT_S * np.asarray(velocity)
            draw = self.noise.standard_normal
            self.filter.predict(
                DT_S, 1e-3 * draw(3), np.array((0, 0, GRAVITY_M_S2)) + 0.1 * draw(3)
            )
            places = np.stack([place - self.base for place, _ in self.feet])
            places += 1e-3 * draw((2, 3))
            self.filter.correct(DT_S, places, np.stack([turn for _, turn in self.feet]), load)

    def walk(self, steps, *, rise=0.0):
        velocity = np.array((SPEED_M_S, 0.0, SPEED_M_S * rise))
        if self.filter.v[0] < 0.1:
            self.filter.v[:] = velocity  # it is off at once
        for _ in range(steps):
            side = self.step % 2
            self._run(0.4, velocity, (0.0, 1.0) if side == 0 else (1.0, 0.0))
            self.step += 1
            y = HALF_M if side == 0 else -HALF_M
            self.feet[side] = self._put(self.base[0] + 0.5 * STRIDE_M * 0.5, y)
            self._run(0.1, velocity, (1.0, 1.0))

    def over_m(self):
        """How much higher over its floor the filter thinks the base than it is over `step`'s."""
        x, y, z = self.filter.p
        height, *_ = self.ground(self.base[0], self.base[1], math.inf)
        return (z - self.filter.ground.under(x, y)) - (self.base[2] - height)


def flat(_x, _y, _step):
    return 0.0, 0.0, 0.0


def test_a_level_floor_stays_level():
    walker = Walker(flat)
    walker.walk(12)
    ground = walker.filter.ground
    assert math.hypot(ground.along, ground.across) < 0.4 * DEG
    assert abs(walker.over_m()) < 0.003


@pytest.mark.parametrize("rise_deg", [5.0, -5.0, 3.0])
def test_a_slope_is_found_within_a_few_steps(rise_deg):
    rise = math.tan(rise_deg * DEG)
    walker = Walker(lambda x, _y, step: (rise * max(0.0, x - 0.3), rise if x > 0.3 else 0.0, 0.0))
    walker.walk(1)
    walker.walk(8, rise=rise)
    ground = walker.filter.ground
    assert math.degrees(math.atan(ground.along)) == pytest.approx(rise_deg, abs=1.5)
    assert abs(ground.across) < 0.8 * DEG


def test_a_foot_on_a_stone_moves_neither_floor_nor_base():
    stone = 0.025
    walker = Walker(lambda _x, _y, step: (stone if step == 5 else 0.0, 0.0, 0.0))
    walker.walk(5)
    ground = walker.filter.ground
    assert ground.soles_m[0] - ground.height_m == pytest.approx(stone, abs=0.004)
    walker.walk(3)
    assert abs(walker.over_m()) < 0.004
    assert math.hypot(walker.filter.ground.along, walker.filter.ground.across) < 0.5 * DEG


def test_a_platform_is_another_floor_after_three_steps():
    walker = Walker(lambda _x, _y, step: (0.04 if step >= 5 else 0.0, 0.0, 0.0))
    walker.walk(4)
    walker.walk(5)
    assert abs(walker.over_m()) < 0.008


def test_the_slope_of_a_floor_is_of_its_height_elsewhere():
    ground = LEVEL._replace(x_m=1.0, y_m=2.0, height_m=0.1, along=0.05, across=-0.02)
    assert ground.under(1.0, 2.0) == pytest.approx(0.1)
    assert ground.under(3.0, 1.0) == pytest.approx(0.1 + 0.1 + 0.02)


def test_what_is_seen_is_shared_out_among_what_explains_it():
    narrow, wide = np.eye(3), 100.0 * np.eye(3)
    near = shares(np.zeros(3), [narrow, wide], [0.5, 0.5])
    far = shares(np.full(3, 8.0), [narrow, wide], [0.5, 0.5])
    assert sum(near) == pytest.approx(1.0)
    assert near[0] > 0.99
    assert far[1] > 0.99
