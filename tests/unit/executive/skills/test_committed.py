"""What the feet are committed to: where a body that lags will be, and that it swings less so."""

import math

import pytest

from executive.skills.motions.committed import Committed
from executive.skills.motions.path_follower import Velocity, turn_towards
from robot.model.description import load
from robot.se3 import SE3, wrap_angle

GAIT = load("juno").walking
LAG_S = GAIT.lag_steps * (GAIT.single_support_s + GAIT.double_support_s)
DT_S = 0.05


def test_without_a_twist_it_stays():
    assert Committed(GAIT).ahead(SE3.from_xy_yaw(1.0, 2.0, 0.5), now_s=3.0).p == (1.0, 2.0, 0.0)


def test_a_steady_walk_leads_ahead_by_the_lag():
    committed = Committed(GAIT)
    for k in range(40):
        committed.told(Velocity(0.3, 0.0, 0.0), now_s=k * DT_S)
    ahead = committed.ahead(SE3.from_xy_yaw(1.0, 0.0, math.pi / 2), now_s=40 * DT_S)
    assert ahead.p[1] == pytest.approx(0.3 * LAG_S, abs=0.3 * DT_S)
    assert ahead.p[0] == pytest.approx(1.0)


def test_what_was_told_changes_no_faster_than_the_gait():
    committed = Committed(GAIT)
    committed.told(Velocity(0.0, 0.0, 0.0), now_s=0.0)
    committed.told(Velocity(0.5, 0.0, 0.0), now_s=DT_S)
    ahead = committed.ahead(SE3(), now_s=2 * DT_S)
    assert ahead.p[0] <= GAIT.acceleration_m_s2 * DT_S**2 + 1e-9


def turned(*, foresight):
    """Headings of a body that does what it was told a lag ago, turning to 1.5 rad."""
    committed, told, X_WS, headings = Committed(GAIT), [Velocity(0.0, 0.0, 0.0)], SE3(), [0.0]
    for k in range(200):
        now_s = k * DT_S
        seen = committed.ahead(X_WS, now_s=now_s) if foresight else X_WS
        twist = turn_towards(wrap_angle(1.5 - seen.yaw_rad), GAIT)
        committed.told(twist, now_s=now_s)
        told.append(twist)
        late = told[max(0, len(told) - round(1.2 * LAG_S / DT_S))]
        X_WS = X_WS @ SE3.from_xy_yaw(0.0, 0.0, late.turn_rad_s * DT_S)
        headings.append(X_WS.yaw_rad)
    return headings


def test_a_body_that_lags_more_than_was_thought_hardly_overshoots():
    assert max(turned(foresight=True)) < 1.6 < 1.75 < max(turned(foresight=False))
    assert turned(foresight=True)[-1] == pytest.approx(1.5, abs=0.05)
