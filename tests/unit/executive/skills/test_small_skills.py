"""Balance, look, search, say, wait and stop."""

import math

import pytest

from executive.skills.balance import BalanceParams
from executive.skills.gesture import GestureParams
from executive.skills.look import LookParams
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.say import SayParams
from executive.skills.search import SearchParams
from executive.skills.stop import StopParams
from executive.skills.wait import WaitParams
from robot.messages import Look, MoveArm, OneLeg, Stand, Walk
from robot.se3 import SE3
from tests.fakes.bodies import handless
from tests.fakes.puppet import Puppet
from tests.fakes.stage import Stage, kitchen


@pytest.fixture
def stage():
    return Stage()


def test_a_squat_goes_down_holds_and_comes_up(stage):
    report = stage.run(BalanceParams(mode="squat", duration_s=2.0))
    assert report.status == "succeeded"
    heights = [command.height_m for command in stage.commands(Stand)]
    assert heights[0] < 0.5
    assert heights[-1] is None
    assert stage.puppet.time_s > 2.0


@pytest.mark.parametrize(
    ("side", "sign"), [("forward", (1, 0)), ("backward", (-1, 0)), ("left", (0, 1)), (None, (1, 0))]
)
def test_a_lean_leans_to_its_side_and_straightens(stage, side, sign):
    assert stage.run(BalanceParams(mode="lean", side=side)).status == "succeeded"
    first, last = stage.commands(Stand)[0], stage.commands(Stand)[-1]
    assert math.copysign(1, first.pitch_rad) * abs(sign[0]) == sign[0]
    assert (first.yaw_rad > 0) == (sign[1] > 0)
    assert last.pitch_rad == last.yaw_rad == 0.0


@pytest.mark.parametrize("side", ["left", "right"])
def test_one_leg_is_stood_on_for_its_time(stage, side):
    report = stage.run(BalanceParams(mode="one_leg", side=side, duration_s=3.0))
    assert report.status == "succeeded", report
    assert stage.commands(OneLeg)[0].side == side


def test_a_foot_that_comes_down_early_is_lost_balance(stage):
    stage.puppet._lifted = lambda side: False
    report = stage.run(BalanceParams(mode="one_leg", duration_s=2.0))
    assert report.failure.code == "lost_balance"


def test_holding_takes_its_time(stage):
    stage.run(BalanceParams(mode="hold", duration_s=4.0))
    assert stage.puppet.time_s == pytest.approx(4.0, abs=0.6)


def test_looking_at_an_object_waits_until_it_is_seen(stage):
    assert stage.run(LookParams(object_id="cup")).status == "succeeded"
    assert stage.puppet.things["cup"].seen_s > 0.0


def test_an_object_that_does_not_show_fails_the_look(stage):
    stage.puppet.blind = True
    assert stage.run(LookParams(object_id="cup")).failure.code == "object_not_seen"


@pytest.mark.parametrize(
    ("target", "p_W"),
    [
        ({"place_id": "counter"}, (2.0, 2.5, 0.7)),
        ({"person_id": "ann"}, (0.0, 3.0, 1.5)),
        ({"p_W": (1.0, 1.0, 0.5)}, (1.0, 1.0, 0.5)),
    ],
)
def test_the_head_is_sent_to_the_point_in_the_odometry_frame(stage, target, p_W):
    assert stage.run(LookParams(**target)).status == "succeeded"
    p_N = stage.commands(Look)[-1].p_N
    assert (stage.puppet.X_WN @ SE3(p_N)).p == pytest.approx(p_W)
    assert not stage.commands(Walk)


@pytest.mark.parametrize(
    ("side", "bearing_rad", "above"),
    [("ahead", 0.0, 0), ("left", 0.5 * math.pi, 0), ("right", -0.5 * math.pi, 0), ("up", 0.0, 1),
     ("down", 0.0, -1)],
)  # fmt: skip
def test_a_side_is_that_of_the_robot_wherever_it_stands(stage, side, bearing_rad, above):
    stage.puppet.X_WS = X_WS = SE3.from_xy_yaw(0.5, -0.3, 2.0)
    assert stage.run(LookParams(towards=side)).status == "succeeded"
    x_m, y_m, z_m = (X_WS.inverse() @ stage.puppet.X_WN @ SE3(stage.commands(Look)[-1].p_N)).p
    assert math.atan2(y_m, x_m) == pytest.approx(bearing_rad, abs=0.05)
    assert (z_m > 1.5) - (z_m < 0.5) == above
    assert not stage.commands(Walk)


def test_a_search_of_the_places_says_where_it_looked(stage):
    cup = stage.puppet.things["cup"]
    cup.known, cup.seen_s = False, -math.inf
    stage.puppet.blind = True
    report = stage.run(SearchParams(object_id="cup"), limit_s=400)
    assert report.failure.code == "object_not_seen"
    assert "table" in report.failure.cause
    assert "counter" in report.failure.cause


def test_a_search_finds_what_was_moved(stage):
    stage.puppet.things["cup"].X_WO = SE3((2.0, 2.4, 0.75))
    stage.puppet.things["cup"].seen_s = -math.inf
    stage.puppet.things["cup"].known = False
    report = stage.run(SearchParams(object_id="cup", place_ids=("counter",)), limit_s=200)
    assert report.status == "succeeded"
    assert stage.puppet.things["cup"].seen_s > 0.0


def test_words_go_to_the_voice(stage):
    assert stage.run(SayParams(text="hello")).status == "succeeded"
    assert stage.said == ["hello"]
    assert stage.puppet.sent == []


def test_waiting_takes_as_long_as_it_should(stage):
    stage.run(WaitParams(duration_s=1.5))
    assert stage.puppet.time_s == pytest.approx(1.55, abs=0.051)
    assert stage.puppet.sent == []


def test_waiting_without_end_ends_when_stopped(stage):
    stage.run(WaitParams(), until_phase="waiting")
    for _ in range(100):
        stage.puppet.tick()
        assert stage.skill.step(stage.puppet.time_s).status == "running"
    assert stage.stop().failure.code == "cancelled"


def test_stop_stands(stage):
    stage.puppet.mode = "walk"
    assert stage.run(StopParams()).status == "succeeded"
    assert [type(command) for command in stage.puppet.sent] == [Stand]
    assert stage.puppet.mode == "stand"


@pytest.mark.parametrize(
    "wanted",
    [
        GestureParams(kind="nod"),
        GestureParams(kind="wave"),
        BalanceParams(mode="squat"),
        LookParams(place_id="counter"),
        NavigateParams(place_id="door"),
        PickParams(object_id="cup"),
    ],
)
def test_who_lies_already_does_not_fall_again(stage, wanted):
    stage.puppet.mode = "fallen"
    reason = stage.run(wanted).failure
    assert reason.code == "fallen"
    assert reason.cause == "the robot lies on the floor"


@pytest.mark.parametrize("kind", ["wave", "raise_both_arms"])
def test_arms_without_hands_wave(kind):
    stage = Stage(Puppet(handless(), {}, kitchen()))
    assert stage.run(GestureParams(kind=kind)).status == "succeeded"
    assert stage.commands(MoveArm)


def test_an_arm_without_a_hand_waits_for_people_too():
    stage = Stage(Puppet(handless(), {}, kitchen()))
    x_m, y_m, _ = stage.puppet.X_WN.apply(stage.puppet.body().arm_ends_N["right"])
    stage.puppet.people["ann"] = SE3((x_m + 0.3, y_m, 0.0))
    stage.run(GestureParams(kind="wave"), until_phase="waiting for Ann")
    assert any(phase.startswith("waiting for Ann") for phase in stage.phases)


def test_who_falls_says_what_it_was_doing(stage):
    stage.run(GestureParams(kind="nod"), until_phase="nodding")
    stage.puppet.mode = "fallen"
    reason = stage.skill.step(stage.puppet.time_s).failure
    assert reason.cause == "the robot fell while nodding"
