"""The controller on other bodies: variants of Juno, and others where their models are found."""

import math

import pytest

from benchmarks.rig import Rig
from robot.messages import Grip, Look, MoveArm, Stand, Walk
from robot.se3 import SE3
from tests.fakes import bodies

VARIANTS = ("handless", "neckless", "smaller")
PUBLISHED = ("g1", "t1")


@pytest.fixture(scope="module")
def robot(request, tmp_path_factory) -> str:
    """The file of a body, or its name."""
    if request.param in PUBLISHED:
        return bodies.shipped_or_skip(request.param)
    folder = tmp_path_factory.mktemp(request.param)
    variant = {
        "handless": lambda _: bodies.handless(),
        "neckless": bodies.neckless,
        "smaller": bodies.smaller,
        "stiff": bodies.stiff,
    }[request.param]
    return bodies.written(variant(folder), folder)


def standing(robot: str, *, reality: str = "ideal") -> Rig:
    rig = Rig(robot=robot, reality=reality)
    assert rig.run(0.3)
    return rig


def on(*names: str):
    return pytest.mark.parametrize("robot", names, indirect=True)


@on(*VARIANTS, *PUBLISHED)
def test_it_walks_and_stops_without_falling_or_being_clamped(robot):
    rig = standing(robot)
    rig.send(Walk, forward_m_s=0.3, left_m_s=0.0, turn_rad_s=0.0, hold_s=4.0)
    assert rig.wait("legs", 8.0) == "done"
    assert rig.X_WS.p[0] > 0.7
    assert abs(rig.X_WS.p[1]) < 0.05
    assert rig.loop.state().clamped == 0


@on("g1")
def test_short_narrow_soles_walk_a_bend_with_late_motors_and_loose_gears(robot):
    rig = standing(robot, reality="real")
    fastest = rig.robot.walking.max_forward_m_s
    rig.send(Walk, forward_m_s=fastest, left_m_s=0.0, turn_rad_s=0.5, hold_s=8.0)
    assert rig.run(8.0)
    assert rig.upright
    assert rig.loop.state().clamped == 0


@on(*VARIANTS, *PUBLISHED)
def test_it_squats_and_leans_within_its_limits(robot):
    rig = standing(robot)
    balance = rig.robot.balance
    for height_m in (balance.squat_base_m, balance.lowest_base_m, balance.highest_base_m):
        rig.send(Stand, height_m=height_m)
        assert rig.wait("legs", 8.0) == "done"
        assert rig.X_WB.p[2] == pytest.approx(height_m, abs=0.01)
    for lean_rad in (balance.lean_forward_rad, balance.lean_back_rad):
        rig.send(Stand, pitch_rad=lean_rad)
        assert rig.wait("legs", 8.0) == "done"
    assert rig.loop.state().clamped == 0


def trunk_rad(rig) -> tuple[float, float]:
    """Truly: its turn against the feet, and how far it leans forward."""
    trunk = rig.plant.data.body(rig.robot.torso_body).xmat.reshape(3, 3)
    yaw_rad = math.atan2(trunk[1, 0], trunk[0, 0]) - rig.X_WS.yaw_rad
    return yaw_rad, math.atan2(-trunk[2, 0], trunk[2, 2])


@on("stiff", *PUBLISHED)
def test_a_lean_leans_the_trunk_and_a_turn_turns_it(robot):
    rig = standing(robot)
    balance = rig.robot.balance
    for yaw_rad, pitch_rad in ((0.0, balance.lean_forward_rad), (balance.turn_rad, 0.0)):
        rig.send(Stand, yaw_rad=yaw_rad, pitch_rad=pitch_rad)
        assert rig.wait("legs", 8.0) == "done"
        assert rig.run(1.0)
        assert trunk_rad(rig) == pytest.approx((yaw_rad, pitch_rad), abs=0.08)
    assert rig.loop.state().clamped == 0


def seen_at_rad(rig, p_W) -> tuple[float, float]:
    """How far off the middle of the picture a point is: aside, and up or down."""
    X_WC = rig.site(rig.robot.sensors.camera.site)
    x, y, z = X_WC.inverse().apply(p_W)
    return math.atan2(x, z), math.atan2(y, math.hypot(x, z))


@on("neckless", "g1")
@pytest.mark.parametrize("aside_rad", [0.9, -0.9])
def test_without_a_neck_it_looks_with_its_waist(robot, aside_rad):
    rig = standing(robot)
    p_W = (1.2 * math.cos(aside_rad), 1.2 * math.sin(aside_rad), 0.7)
    before_rad, _ = seen_at_rad(rig, p_W)
    rig.send(Look, p_N=(rig.X_WN.inverse() @ SE3(p_W)).p)
    assert rig.wait("head", 6.0) == "done"
    assert rig.run(0.5)
    after_rad, _ = seen_at_rad(rig, p_W)
    assert abs(before_rad) > 0.7
    assert abs(after_rad) < 0.65
    rig.send(Stand)
    assert rig.wait("legs", 5.0) == "done"
    assert abs(seen_at_rad(rig, p_W)[0]) > 0.7


@on("neckless")
def test_a_waist_that_leans_is_not_turned_to_look(robot):
    rig = standing(robot)
    rig.send(Stand, pitch_rad=0.3)
    assert rig.wait("legs", 5.0) == "done"
    before = rig.site(rig.robot.sensors.camera.site).yaw_rad
    rig.send(Look, p_N=(0.0, 2.0, 0.7))
    assert rig.run(2.0)
    assert rig.site(rig.robot.sensors.camera.site).yaw_rad == pytest.approx(before, abs=0.02)


@on("handless")
def test_without_hands_the_arms_still_move(robot):
    rig = standing(robot)
    rig.send(Grip, side="left", opening_m=0.05)
    assert rig.run(0.1)
    activity = rig.loop.state().activities["left_hand"]
    assert (activity.status, activity.detail) == ("failed", "this robot has no left hand")
    names = rig.robot.groups["left_arm"]
    raised = dict(zip(rig.robot.motors, rig.robot.posture("raised"), strict=True))
    goal = tuple(raised[name] for name in names)
    rig.send(MoveArm, side="left", times_s=(1.5,), positions_rad=(goal,))
    assert rig.wait("left_arm", 5.0) == "done"
