"""X_WN is found under noise, follows drift, ignores outliers, and jumps aloud."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robot.fusion.history import BodyHistory
from robot.fusion.localisation import FIXES_TO_JUMP, Localiser
from robot.messages import PoseFix
from robot.se3 import SE3, wrap_angle
from tests.fakes.messages_for_tests import body_state


class Walk:
    """A robot that walks a circle; its true X_WN may be changed on the way."""

    def __init__(self, X_WN: SE3, *, seed: int = 0, noise_m: float = 0.0, noise_rad: float = 0.0):
        self.X_WN = X_WN
        self.history = BodyHistory()
        self.localiser = Localiser(self.history)
        self.time_s = 0.0
        self._noise = (noise_m, noise_rad)
        self._rng = np.random.default_rng(seed)

    def base(self, time_s: float) -> SE3:
        angle = 0.2 * time_s
        return SE3.from_rpy(
            0.02 * math.sin(time_s),
            0.05,
            angle,
            (2 * math.sin(angle), 2 - 2 * math.cos(angle), 0.6),
        )

    def fix(self, stamp_s: float, *, offset: SE3 | None = None) -> PoseFix:
        noise_m, noise_rad = self._noise
        x, y, z = (self._rng.standard_normal(3) * noise_m).tolist()
        turn = SE3.from_rpy(*(self._rng.standard_normal(3) * noise_rad).tolist(), (0, 0, 0))
        X_WB = (offset or SE3()) @ self.X_WN @ self.base(stamp_s) @ turn
        p = (X_WB.p[0] + x, X_WB.p[1] + y, X_WB.p[2] + z)
        return PoseFix(stamp_s=stamp_s, X_WB=SE3(p, X_WB.quat_wxyz), source="oracle")

    def run(self, duration_s: float, *, offset: SE3 | None = None, latency_s: float = 0.0) -> None:
        """States at 50 Hz, fixes at 10 Hz that arrive `latency_s` late."""
        end_s = self.time_s + duration_s
        while self.time_s < end_s - 1e-9:
            self.time_s = round(self.time_s + 0.02, 9)
            self.history.add(body_state(self.time_s, self.base(self.time_s)))
            tenth = round(self.time_s / 0.1, 6)
            if abs(tenth - round(tenth)) < 1e-6 and self.time_s > latency_s:
                self.localiser.add(self.fix(self.time_s - latency_s, offset=offset))

    def error(self) -> tuple[float, float]:
        X_NB = self.base(self.time_s)
        found, true = self.localiser.X_WN @ X_NB, self.X_WN @ X_NB
        yaw = wrap_angle(self.localiser.X_WN.yaw_rad - self.X_WN.yaw_rad)
        return math.dist(found.p, true.p), abs(yaw)


poses = st.builds(SE3.from_xy_yaw, st.floats(-5, 5), st.floats(-5, 5), st.floats(-math.pi, math.pi))


@given(X_WN=poses, seed=st.integers(0, 1000))
@settings(max_examples=25)
def test_a_frame_is_found_under_noise(X_WN, seed):
    walk = Walk(X_WN, seed=seed, noise_m=0.005, noise_rad=0.005)
    walk.run(5.0)
    distance_m, yaw_rad = walk.error()
    assert distance_m < 0.010
    assert yaw_rad < 0.010
    assert walk.localiser.jumps == 0
    assert walk.localiser.rejected == 0


def test_without_noise_the_first_fix_is_exact():
    walk = Walk(SE3.from_xy_yaw(1.0, -2.0, 2.5))
    walk.run(0.1)
    assert walk.error() == pytest.approx((0.0, 0.0), abs=1e-9)


def test_noise_is_smoothed():
    walk = Walk(SE3.from_xy_yaw(1.0, 0.5, -1.0), noise_m=0.01)
    errors = []
    for _ in range(100):
        walk.run(0.1)
        errors.append(walk.error()[0])
    rms = math.sqrt(sum(error * error for error in errors[20:]) / len(errors[20:]))
    assert rms < 0.6 * 0.01 * math.sqrt(3)


def test_a_late_fix_meets_the_pose_of_its_own_time():
    walk = Walk(SE3.from_xy_yaw(0.3, 0.4, 0.5))
    walk.run(5.0, latency_s=0.3)
    assert walk.error()[0] < 1e-6


def test_drift_is_followed():
    walk = Walk(SE3())
    walk.run(1.0)
    for k in range(300):
        walk.X_WN = SE3.from_xy_yaw(0.001 * k, 0.0, 0.0005 * k)
        walk.run(0.1)
    assert walk.error()[0] < 0.02
    assert walk.localiser.jumps == 0


def test_one_outlier_is_ignored_and_counted():
    walk = Walk(SE3())
    walk.run(2.0)
    before = walk.localiser.X_WN
    assert not walk.localiser.add(walk.fix(2.0, offset=SE3((1.0, 0.0, 0.0))))
    assert before == walk.localiser.X_WN
    assert walk.localiser.rejected == 1
    walk.run(1.0)
    assert walk.localiser.jumps == 0
    assert walk.error()[0] < 1e-6


@pytest.mark.parametrize("offset", [SE3((0.5, 0.0, 0.0)), SE3.from_xy_yaw(0.0, 0.0, 0.6)])
def test_a_jump_is_flagged_ages_the_fix_and_is_taken(offset):
    walk = Walk(SE3())
    walk.run(2.0)
    walk.run(0.1 * (FIXES_TO_JUMP - 1), offset=offset)
    assert walk.localiser.jumps == 0
    assert walk.time_s - walk.localiser.fixed_s == pytest.approx(0.1 * (FIXES_TO_JUMP - 1))
    walk.run(0.1, offset=offset)
    assert walk.localiser.jumps == 1
    assert walk.localiser.fixed_s == pytest.approx(walk.time_s)
    walk.X_WN = offset @ walk.X_WN
    assert walk.error()[0] < 0.02


def test_wild_fixes_that_disagree_never_win():
    walk = Walk(SE3())
    walk.run(2.0)
    for k in range(40):
        walk.localiser.add(walk.fix(2.0, offset=SE3((1.0 + k % 3, 0.0, 0.0))))
    assert walk.localiser.jumps == 0
    assert walk.localiser.X_WN.p == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)


def test_a_new_odometry_frame_is_taken_at_once():
    walk = Walk(SE3())
    walk.run(2.0)
    away = SE3.from_xy_yaw(3.0, 1.0, 1.0)
    restarted = away.inverse() @ walk.base(2.02)
    walk.history.add(body_state(2.02, restarted))
    X_WB = walk.X_WN @ walk.base(2.02)
    assert walk.localiser.add(PoseFix(stamp_s=2.02, X_WB=X_WB, source="oracle"))
    assert math.dist((walk.localiser.X_WN @ restarted).p, X_WB.p) < 1e-9


@pytest.mark.parametrize("p", [(math.nan, 0.0, 0.0), (0.0, math.inf, 0.0)])
def test_what_is_no_number_is_no_fix(p):
    walk = Walk(SE3())
    walk.run(1.0)
    assert not walk.localiser.add(PoseFix(stamp_s=1.0, X_WB=SE3(p), source="oracle"))
    assert walk.error()[0] < 1e-6


def test_without_a_body_state_of_its_time_a_fix_is_not_believed():
    localiser = Localiser(BodyHistory())
    assert not localiser.add(PoseFix(stamp_s=0.0, X_WB=SE3(), source="oracle"))
    assert math.isinf(localiser.fixed_s)
