"""The gait on an ideal pendulum: it walks, it stops where it should, the DCM stays near its feet.

The pendulum is xidot = omega (xi - zmp) with the ZMP that the gait commands; a swinging foot is
where its reference is and bears weight as soon as it is down.
"""

import itertools
import math

import numpy as np
import pytest

from robot.control.walking.footsteps import Sole, Target, Twist, stance_of
from robot.control.walking.gait import Gait
from robot.model.body import SIDES
from robot.se3 import wrap_angle

DT_S = 0.005
OMEGA_1_S = 4.2


class Pendulum:
    """A gait and what it stands on."""

    def __init__(self, juno):
        half = 0.5 * juno.walking.stance_width_m
        feet = {"left": Sole(0.0, half, 0.0), "right": Sole(0.0, -half, 0.0)}
        self.gait = Gait(juno, dict(feet), omega_1_s=OMEGA_1_S)
        self.feet = feet
        self.xi = [0.0, 0.0]
        self.time_s = 0.0
        self.margin_m = math.inf

    def run(self, duration_s, *, wish=None):
        for _ in range(round(duration_s / DT_S)):
            if wish is not None:
                self.gait.wish = wish(self.time_s)
            self.tick()

    def tick(self):
        gait = self.gait
        load = [0.5, 0.5]
        if gait.swing is not None:
            i = 1 - SIDES.index(gait.support)
            swing = gait.swing
            x, y, yaw = swing.position
            self.feet[SIDES[i]] = Sole(x, y, yaw)
            down = swing.vz < 0.0 and swing.z <= 0.0
            load[i], load[1 - i] = (0.2, 0.8) if down else (0.0, 1.0)
        reference = gait.update(DT_S, tuple(self.xi), dict(self.feet), load)
        growth = math.exp(OMEGA_1_S * DT_S)
        for k in (0, 1):
            p = reference.zmp_command[k]
            self.xi[k] = p + growth * (self.xi[k] - p)
        self.time_s += DT_S
        assert math.isfinite(self.xi[0] + self.xi[1])

    @property
    def stance(self):
        return stance_of(self.feet["left"], self.feet["right"])

    def off_m(self):
        """How far the DCM is from the stance."""
        return math.dist(self.xi, (self.stance.x, self.stance.y))


@pytest.fixture
def pendulum(juno):
    return Pendulum(juno)


def target(x, y, yaw):
    return Target(Sole(x, y, yaw), 0.015, 0.03)


@pytest.mark.parametrize("seed", range(8))
def test_it_stops_where_it_is_sent(juno, seed):
    pendulum = Pendulum(juno)
    rng = np.random.default_rng(seed)
    x, y, yaw = rng.uniform([-0.6, -0.6, -2.0], [1.0, 0.6, 2.0])
    wish = target(float(x), float(y), float(yaw))
    while pendulum.time_s < 60.0:
        pendulum.run(0.5, wish=lambda _: wish)
        assert pendulum.off_m() < 0.35, "the DCM ran away"
        if pendulum.gait.settled():
            break
    stance = pendulum.stance
    assert pendulum.gait.settled()
    assert math.dist((stance.x, stance.y), (x, y)) < 0.016
    assert abs(wrap_angle(stance.yaw - yaw)) < 0.031
    pendulum.run(1.0, wish=lambda _: wish)
    assert pendulum.off_m() < 0.01


@pytest.mark.parametrize(
    "twist",
    [Twist(0.4, 0.0, 0.0), Twist(-0.25, 0.0, 0.0), Twist(0.0, 0.15, 0.0), Twist(0.2, -0.1, 0.3)],
)
def test_it_keeps_walking_and_then_stands(pendulum, twist):
    worst = 0.0
    for _ in range(32):
        pendulum.run(0.25, wish=lambda time_s: twist)
        worst = max(worst, pendulum.off_m())
    assert pendulum.gait.steps_taken >= 12
    assert worst < 0.3
    way = math.hypot(pendulum.stance.x, pendulum.stance.y)
    assert way > 0.7 * 8.0 * math.hypot(twist.forward_m_s, twist.left_m_s) * 0.8
    pendulum.run(4.0, wish=lambda time_s: Twist())
    assert pendulum.gait.phase == "stand"
    assert pendulum.off_m() < 0.01


def test_feet_never_land_on_one_another(pendulum, juno):
    rng = np.random.default_rng(3)
    for _ in range(40):
        twist = Twist(*(float(v) for v in rng.uniform([-0.25, -0.15, -0.6], [0.4, 0.15, 0.6])))
        pendulum.run(0.6, wish=lambda time_s, twist=twist: twist)
        if pendulum.gait.phase == "double":
            left, right = pendulum.feet["left"], pendulum.feet["right"]
            _, width, _ = right.relative(left)
            assert width > 0.1, (left, right)


@pytest.mark.parametrize("kick", [(0.05, 0.0), (-0.04, 0.0), (0.0, 0.06), (0.03, -0.05)])
def test_a_kick_while_walking_is_stepped_out(pendulum, kick):
    def forward(_):
        return Twist(0.3, 0.0, 0.0)

    pendulum.run(4.1, wish=forward)
    pendulum.xi = [pendulum.xi[0] + kick[0], pendulum.xi[1] + kick[1]]
    pendulum.run(4.0, wish=forward)
    assert pendulum.off_m() < 0.3
    pendulum.run(5.0, wish=lambda time_s: Twist())
    assert pendulum.gait.phase == "stand"


def test_standing_takes_no_steps_against_a_small_kick(pendulum):
    pendulum.run(0.5)
    pendulum.xi = [0.03, 0.02]
    pendulum.run(2.0)
    assert pendulum.gait.steps_taken == 0
    assert pendulum.off_m() < 0.005


def test_standing_steps_when_the_dcm_leaves_the_feet(pendulum):
    pendulum.run(0.5)
    pendulum.xi = [0.11, 0.0]
    pendulum.run(5.0)
    assert pendulum.gait.steps_taken >= 1
    assert pendulum.gait.phase == "stand"
    assert pendulum.off_m() < 0.01


def test_on_one_leg_the_foot_stays_up_for_as_long_as_asked(pendulum):
    pendulum.run(0.5)
    pendulum.gait.lift("right", 2.0)
    up_s = 0.0
    for _ in range(1200):
        pendulum.tick()
        if pendulum.gait.phase == "single":
            assert pendulum.gait.support == "right"
            up_s += DT_S
    assert up_s == pytest.approx(2.0, abs=0.15)
    assert pendulum.gait.phase == "stand"
    assert pendulum.gait.settled()


def test_a_dcm_that_escapes_over_the_stance_foot_hastens_the_step(pendulum, juno):
    gait = pendulum.gait
    pendulum.run(1.5, wish=lambda _: Twist(forward_m_s=0.2))
    while gait.phase != "single" or gait.phase_s < 0.05:
        pendulum.tick()
    outward = 1.0 if gait.support == "left" else -1.0
    foot = gait.planted[gait.support]
    pendulum.xi[1] = foot.y + outward * 0.12
    for _ in range(8):
        pendulum.tick()
    assert gait.phase == "single"
    assert gait.duration_s < 0.8 * juno.walking.single_support_s


def test_a_dcm_that_escapes_ahead_hastens_the_step(pendulum, juno):
    """Waiting for it to come back sideways lets it run out of the leg's reach."""
    gait = pendulum.gait
    pendulum.run(0.5)
    pendulum.xi = [0.13, 0.0]
    while gait.phase != "single" or gait.phase_s < 0.1:
        pendulum.tick()
    assert gait.steps_taken == 0
    assert gait.duration_s < 0.8 * juno.walking.single_support_s


def test_a_step_is_put_down_for_what_the_sole_holds_not_the_trunk(pendulum, juno):
    """The trunk's turning helps for a tenth of a second; a DCM behind the heel runs on."""
    gait = pendulum.gait
    pendulum.run(2.0, wish=lambda _: Twist(forward_m_s=0.3))
    while gait.phase != "single" or gait.phase_s < 0.1:
        pendulum.tick()
    foot = gait.planted[gait.support]
    heel_m = juno.feet["left"].half_length_m - juno.balance.zmp_margin_m
    behind = (foot.x - heel_m - 0.03, foot.y)
    for _ in range(20):
        pendulum.xi = list(behind)
        pendulum.tick()
    assert gait.phase == "single"
    assert gait.duration_s < juno.walking.single_support_s  # it does not wait to be brought back,
    assert gait.swing.landing[0] < foot.x - heel_m  # and goes behind the foot that stands


def test_a_foot_that_came_down_early_waits_for_the_dcm(pendulum, juno):
    """With the weight on it at once the robot would be left behind, and run backwards after it."""
    gait = pendulum.gait
    pendulum.run(2.0, wish=lambda _: Twist(forward_m_s=0.35))
    while gait.phase != "single" or gait.phase_s < 0.75 * gait.duration_s:
        pendulum.tick()
    side = SIDES[1 - SIDES.index(gait.support)]
    pendulum.xi[0] -= 1.5 * juno.walking.catching.late_m
    load = [0.4, 0.4]
    xi = tuple(pendulum.xi)
    gait.update(DT_S, xi, dict(pendulum.feet), load)
    assert gait.phase == "double"
    assert gait.support == side
    assert gait.duration_s > 2.0 * juno.walking.catching.double_support_s


def test_a_foot_that_slides_on_as_it_lands_carries_the_robot_where_it_ends(pendulum):
    """Against the support where it touched the DCM would seem to escape, and another step begin."""
    gait = pendulum.gait
    pendulum.run(0.5)
    pendulum.xi = [0.0, 0.16]
    for _ in range(200):
        if gait.steps_taken == 0:
            pendulum.tick()
    assert gait.phase == "double"
    foot = gait.planted["left"]
    pendulum.feet["left"] = Sole(foot.x, foot.y + 0.02, foot.yaw)
    pendulum.xi[1] = foot.y + 0.05
    for _ in range(20):
        pendulum.tick()
    assert gait.steps_taken == 1
    assert gait.planted["left"].y == pytest.approx(foot.y + 0.02)
    pendulum.run(3.0)
    assert gait.steps_taken == 1
    assert gait.phase == "stand"


def test_the_landings_that_are_planned_are_where_the_feet_land(juno):
    """The first of them is of the foot in the air, or that goes into the air next."""
    pendulum = Pendulum(juno)
    gait, landed = pendulum.gait, []
    while len(landed) < 8:
        before, taken = gait.landings, gait.steps_taken
        pendulum.run(DT_S, wish=lambda _: Twist(0.3, 0.0, 0.0))
        if gait.phase != "stand":
            assert gait.landings and gait.landings[0][0] != gait.support
        if gait.steps_taken > taken:
            side, sole = before[0]
            assert math.dist(_xy(gait.planted[side]), _xy(sole)) < 0.01
            landed.append(side)
    assert all(side != after for side, after in itertools.pairwise(landed))
    pendulum.run(6.0, wish=lambda _: Twist())
    assert gait.phase == "stand" and gait.landings == ()


def _xy(sole: Sole) -> tuple[float, float]:
    return sole.x, sole.y
