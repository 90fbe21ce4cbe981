"""Skills that are about people: give, follow, gestures; and looking around."""

import math

import pytest

from executive.skills.follow import FollowParams
from executive.skills.gesture import TIMES, GestureParams
from executive.skills.give import GiveParams
from executive.skills.look import LookParams
from executive.skills.pick import PickParams
from robot.messages import Grip, Look, MoveArm, Stand, Walk, WalkTo
from robot.planning.requests import ArmRequest
from robot.se3 import SE3
from tests.fakes.stage import DESCRIPTION, Stage

PULL_N = DESCRIPTION.handy.giving.pull_n

GIVE = GiveParams(object_id="cup", person_id="ann")


@pytest.fixture
def stage():
    return Stage()


@pytest.fixture
def carrying(stage):
    assert stage.run(PickParams(object_id="cup")).status == "succeeded"
    return stage


def pulls(stage, newtons: float) -> None:
    """Ann pulls once the robot has asked her to take it."""
    tick = stage.puppet.tick

    def at_last():
        stage.puppet.pull_n = newtons if stage.said else 0.0
        tick()

    stage.puppet.tick = at_last


def test_it_is_held_out_before_the_person_and_let_go_when_they_pull(carrying):
    pulls(carrying, 2 * PULL_N)
    report = carrying.run(GIVE)
    assert report.status == "succeeded", report
    assert carrying.said == ["Please take the red cup."]
    assert carrying.context.holdings.all() == ()
    assert carrying.puppet.holding == {}
    assert carrying.puppet.payload_kg == {"left": 0.0, "right": 0.0}
    assert 0.8 < math.dist(carrying.puppet.X_WS.p[:2], (0.0, 3.0)) < 1.2


def test_the_fingers_stay_closed_without_a_pull_and_the_object_is_kept(carrying):
    grips = len(carrying.commands(Grip))
    pulls(carrying, 0.3 * PULL_N)
    report = carrying.run(GIVE)
    assert report.failure.code == "not_taken"
    assert len(carrying.commands(Grip)) == grips
    assert carrying.context.holdings.find("cup") is not None
    assert len(carrying.said) == 2, "it asks once more"
    held = carrying.context.holdings.find("cup")
    indices = carrying.puppet.description.indices(f"{held.side}_arm")
    assert [carrying.puppet.q_rad[i] for i in indices] == pytest.approx(held.carry_rad)


def test_nothing_is_given_by_an_empty_hand(stage):
    report = stage.run(GIVE)
    assert report.failure.code == "not_holding"
    assert not stage.commands(Walk)


def test_being_stopped_while_it_is_held_out_keeps_it(carrying):
    carrying.run(GIVE, until_phase="waiting for")
    report = carrying.stop()
    assert report.failure.code == "cancelled"
    assert carrying.puppet.holding


def walking(stage, path) -> None:
    """Ann is at `path(seconds)`."""
    tick = stage.puppet.tick

    def step():
        tick()
        at = path(stage.puppet.time_s)
        if at is None:
            stage.puppet.people.pop("ann", None)
        else:
            stage.puppet.people["ann"] = SE3((*at, 0.0))

    stage.puppet.tick = step


def test_it_stays_behind_somebody_until_they_stop(stage):
    walking(stage, lambda t: (2.0 + 0.2 * min(t, 15.0), 0.0))
    report = stage.run(FollowParams(person_id="ann"))
    assert report.status == "succeeded", report
    assert 0.9 < math.dist(stage.puppet.X_WS.p[:2], (5.0, 0.0)) < 1.75
    assert stage.puppet.time_s > 15.0
    assert stage.puppet.mode == "stand"


def test_it_follows_to_a_place_and_no_longer(stage):
    walking(stage, lambda t: (max(-1.0, 1.8 - 0.2 * t), min(1.0, 0.1 * t)))
    report = stage.run(FollowParams(person_id="ann", place_id="door"))
    assert report.status == "succeeded", report
    assert stage.puppet.time_s < 30.0


def test_somebody_who_is_gone_is_lost(stage):
    walking(stage, lambda t: (2.0 + 0.2 * t, 0.0) if t < 4.0 else None)
    report = stage.run(FollowParams(person_id="ann"))
    assert report.failure.code == "person_not_seen"
    assert stage.puppet.mode == "stand"


def test_nodding_moves_the_head_alone(stage):
    skill = stage.make(GestureParams(kind="nod"))
    assert skill.resources == {"head"}
    assert stage.run(GestureParams(kind="nod")).status == "succeeded"
    heights = [command.p_N[2] for command in stage.commands(Look)]
    assert len(heights) == 2 * TIMES + 1
    assert {type(command) for command in stage.puppet.sent} == {Look}
    assert heights[0] < heights[-1] < heights[1]


def test_shaking_the_head_goes_left_and_right(stage):
    assert stage.run(GestureParams(kind="shake_head")).status == "succeeded"
    points = [(stage.puppet.X_WN @ SE3(c.p_N)).p for c in stage.commands(Look)]
    assert {round(p[2], 6) for p in points} == {round(points[0][2], 6)}
    assert points[0][1] * points[1][1] < 0


def test_bowing_leans_and_straightens_up(stage):
    assert stage.run(GestureParams(kind="bow")).status == "succeeded"
    pitches = [command.pitch_rad for command in stage.commands(Stand)]
    assert pitches[0] > 0.2
    assert pitches[-1] == 0.0


def test_waving_ends_with_the_arm_home(stage):
    assert stage.run(GestureParams(kind="wave", person_id="ann")).status == "succeeded"
    description = stage.puppet.description
    names = description.groups["right_arm"]
    yaws = [c.positions_rad[-1][names.index("right_shoulder_yaw")] for c in stage.commands(MoveArm)]
    assert max(yaws) > 0.2
    assert min(yaws) < -0.2
    nominal = description.posture("nominal")
    for i in description.indices("right_arm"):
        assert stage.puppet.q_rad[i] == pytest.approx(nominal[i])


def test_the_hand_that_is_named_waves(stage):
    assert stage.run(GestureParams(kind="wave", side="left")).status == "succeeded"
    names = stage.puppet.description.groups["left_arm"]
    assert all(len(c.positions_rad[-1]) == len(names) for c in stage.commands(MoveArm))
    assert {c.side for c in stage.commands(MoveArm)} == {"left"}
    with pytest.raises(ValueError, match="not done with one hand"):
        GestureParams(kind="bow", side="left")


@pytest.mark.parametrize(
    ("kind", "sides"),
    [
        ("lower_left_arm", {"left"}),
        ("lower_right_arm", {"right"}),
        ("lower_arm", {"left", "right"}),
        ("lower_both_arms", {"left", "right"}),
    ],
)
def test_an_arm_that_is_lowered_comes_home_and_goes_nowhere_else(stage, kind, sides):
    puppet, nominal = stage.puppet, stage.puppet.description.posture("nominal")
    up = puppet.description.posture(puppet.description.signs.raised)
    for side in ("left", "right"):
        for i in puppet.description.indices(f"{side}_arm"):
            puppet.q_rad[i] = up[i]
    assert stage.run(GestureParams(kind=kind)).status == "succeeded"
    assert {command.side for command in stage.commands(MoveArm)} == sides
    for side in sides:
        for i in puppet.description.indices(f"{side}_arm"):
            assert puppet.q_rad[i] == pytest.approx(nominal[i])


def test_arms_that_are_down_stay_as_they_are(stage):
    assert stage.run(GestureParams(kind="lower_both_arms")).status == "succeeded"
    assert not stage.commands(MoveArm)


def test_a_full_hand_does_not_wave(carrying):
    report = carrying.run(GestureParams(kind="raise_right_arm"))
    assert report.failure.code == "hands_full"
    assert carrying.puppet.holding


def test_pointing_stretches_the_nearer_arm_along_the_line(stage):
    assert stage.run(GestureParams(kind="point", object_id="cup")).status == "succeeded"
    asked = next(r for r in stage.planner.requests if isinstance(r, ArmRequest))
    x = asked.goal.rotation()[:, 0]
    cup = stage.puppet.things["cup"].X_WO.p
    to = [a - b for a, b in zip(cup, asked.goal.p, strict=True)]
    norm = math.dist(cup, asked.goal.p)
    assert sum(a * b / norm for a, b in zip(x, to, strict=True)) > 0.999


def test_what_is_behind_is_turned_to(stage):
    stage.puppet.X_WS = SE3.from_xy_yaw(0.0, 0.0, math.pi)
    assert stage.run(GestureParams(kind="point", place_id="table")).status == "succeeded"
    assert abs(stage.puppet.turned_rad) > 2.0


def test_pointing_needs_a_target():
    with pytest.raises(ValueError, match="towards one thing"):
        GestureParams(kind="point")


def test_looking_around_moves_nothing_but_the_head(stage):
    assert stage.run(LookParams(around=True)).status == "succeeded"
    assert {type(command) for command in stage.puppet.sent} == {Look}
    bearings = [math.atan2(*reversed((stage.puppet.X_WN @ SE3(c.p_N)).p[:2]))
                for c in stage.commands(Look)]  # fmt: skip
    assert max(bearings) > 0.7
    assert min(bearings) < -0.7
    assert not stage.commands(WalkTo)
