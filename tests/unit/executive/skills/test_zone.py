"""Nobody is walked into or reached into: feet and hands wait while a person is near."""

import math

import pytest

from executive.skills.encounters import OVER_S, PLEAS, Encounters
from executive.skills.motions.personal_space import PATIENCE_S
from executive.skills.navigate import FloorPose, NavigateParams, Step
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from robot.messages import Grip, MoveArm, MoveHand, Obstacle, Shape, Walk, WalkTo
from robot.person_distances import ZONE_M
from robot.se3 import SE3
from sim.people import wish_in
from tests.fakes.stage import Stage

AWAY = SE3((9.0, 9.0, 0.0))
THERE = NavigateParams(pose=FloorPose(x_m=2.5, y_m=-2.0, yaw_rad=0.0))


@pytest.fixture
def stage():
    return Stage()


def comes(stage, words: str, X_WO, *, for_s: float = math.inf):
    """Ann steps to a place when a phase begins, and leaves again."""
    tick, since = stage.puppet.tick, []

    def step_in():
        tick()
        now_s = stage.puppet.time_s
        if not since and stage.skill.body.phase.startswith(words):
            since.append(now_s)
        here = since and now_s - since[0] < for_s
        stage.puppet.people["ann"] = X_WO() if here else AWAY

    stage.puppet.tick = step_in


def before(stage, m: float):
    X_WS = stage.puppet.X_WS
    return SE3((X_WS.p[0] + m * math.cos(X_WS.yaw_rad), X_WS.p[1] + m * math.sin(X_WS.yaw_rad), 0))


def test_walking_stops_for_somebody_ahead_and_goes_on_when_they_leave(stage):
    comes(stage, "walking", lambda: before(stage, 0.6), for_s=3.0)
    report = stage.run(THERE)
    assert report.status == "succeeded", report
    assert "stopping for Ann" in stage.phases


def test_who_has_no_room_to_leave_is_given_some(stage):
    """Ann stands in a doorway and comes out of it only when the robot is 1.2 m away."""
    comes(stage, "walking", lambda: where[0], for_s=math.inf)
    where, tick = [SE3((1.0, 0.0, 0.0))], stage.puppet.tick

    def leave():
        tick()
        if math.dist(stage.puppet.X_WS.p[:2], where[0].p[:2]) > 1.2 and len(stage.said) > 1:
            where[0] = AWAY

    stage.puppet.tick = leave
    report = stage.run(THERE)
    assert report.status == "succeeded", report
    assert "stepping back from Ann" in stage.phases
    assert stage.said == list(PLEAS)  # from afar, before her, and when there is room


def test_who_will_not_leave_is_asked_in_each_way_once(stage):
    """However often it is tried anew; how it ends is said by the failure, not by the next plea."""
    comes(stage, "walking", lambda: SE3((2.81, -2.25, 0.0)), for_s=math.inf)
    assert stage.run(THERE).failure.code == "path_blocked"
    assert stage.said[:3] == list(PLEAS)
    assert set(stage.said[3:]) <= {PLEAS[-1]}, "only where the robot has stepped back again"
    stepped_back = stage.phases.count("stepping back from Ann")
    assert stage.said.count(PLEAS[-1]) <= max(1, stepped_back)


def test_who_comes_back_after_a_while_is_met_anew():
    met = Encounters()
    assert [met.open("ann", 0.0), met.open("ann", 1.0), met.plead("ann", 2.0)] == [
        PLEAS[0], "", PLEAS[1],
    ]  # fmt: skip
    assert [met.plead("eve", 0.0, made_room=True) for _ in range(4)] == [*PLEAS, PLEAS[-1]]
    assert met.plead("eve", 1.0) == "", "without more room there is nothing new to say"
    assert met.open("ben", 2.0) == PLEAS[0], "nobody is taken for somebody else"
    met.open("ann", 2.0 + OVER_S)
    assert met.plead("ann", 2.0 + OVER_S) == PLEAS[2], "she has been in the way all the time"
    assert met.open("ann", 3.0 + 2.0 * OVER_S) == PLEAS[0]


def test_every_plea_asks_for_room():
    assert {wish_in(words) for words in PLEAS} == {"make room"}


def test_who_stands_by_the_way_is_asked_from_afar_and_the_walk_goes_on(stage):
    comes(stage, "walking", lambda: where[0], for_s=math.inf)
    where, tick = [SE3((1.65, -0.49, 0.0))], stage.puppet.tick

    def leave():
        tick()
        if stage.said:
            where[0] = AWAY

    stage.puppet.tick = leave
    assert stage.run(THERE).status == "succeeded"
    assert stage.said == ["Excuse me."]
    assert not any(phase.startswith("stopping") for phase in stage.phases)


def test_who_steps_aside_at_once_is_not_backed_away_from(stage):
    comes(stage, "walking", lambda: where[0], for_s=math.inf)
    where, tick = [SE3((1.0, 0.0, 0.0))], stage.puppet.tick

    def leave():
        tick()
        if len(stage.said) > 1:
            where[0] = AWAY

    stage.puppet.tick = leave
    assert stage.run(THERE).status == "succeeded"
    assert "stepping back from Ann" not in stage.phases


def test_nobody_is_stepped_onto_who_stands_where_the_walk_ends(stage):
    """The last steps follow no path: Ann stands just behind the goal."""
    comes(stage, "walking", lambda: SE3((2.81, -2.25, 0.0)), for_s=math.inf)
    report = stage.run(THERE)
    assert report.failure.code == "path_blocked", report


def test_not_a_step_is_sent_while_they_stand_there(stage):
    comes(stage, "walking", lambda: before(stage, 0.6), for_s=4.0)
    stage.run(THERE, until_phase="stopping")
    sent = len(stage.commands(Walk))
    for _ in range(40):
        stage.puppet.tick()
        stage.skill.step(stage.puppet.time_s)
    assert len(stage.commands(Walk)) == sent


def test_somebody_behind_is_no_reason_to_stop(stage):
    comes(stage, "walking", lambda: before(stage, -0.6))
    report = stage.run(THERE)
    assert report.status == "succeeded"
    assert "stopping for Ann" not in stage.phases


def test_the_arm_waits_and_then_goes_on(stage):
    comes(stage, "reaching", lambda: SE3((1.7, 0.3, 0.0)), for_s=3.0)
    report = stage.run(PickParams(object_id="cup"))
    assert report.status == "succeeded", report
    assert "waiting for Ann to step back" in stage.phases


def test_who_leaves_the_hand_at_once_is_told_nothing(stage):
    comes(stage, "reaching", lambda: SE3((1.7, 0.3, 0.0)), for_s=1.0)
    stage.run(PickParams(object_id="cup"))
    assert stage.said == []


def test_who_stays_near_the_hand_is_asked_for_room(stage):
    comes(stage, "reaching", lambda: AWAY if stage.said else SE3((1.7, 0.3, 0.0)))
    report = stage.run(PickParams(object_id="cup"))
    assert report.status == "succeeded", report
    assert stage.said == ["Please step back a little."]


def test_the_arm_does_not_move_on_while_they_are_near(stage):
    comes(stage, "reaching", lambda: SE3((1.7, 0.3, 0.0)), for_s=8.0)
    stage.run(PickParams(object_id="cup"), until_phase="waiting for Ann")
    sent = len(stage.commands(MoveArm)) + len(stage.commands(MoveHand))
    for _ in range(60):
        stage.puppet.tick()
        stage.skill.step(stage.puppet.time_s)
    assert len(stage.commands(MoveArm)) + len(stage.commands(MoveHand)) == sent


def test_somebody_who_stays_ends_the_reach_with_a_name(stage):
    comes(stage, "reaching", lambda: SE3((1.7, 0.3, 0.0)), for_s=2 * PATIENCE_S)
    report = stage.run(PickParams(object_id="cup"))
    assert report.failure.code == "person_near"
    assert "Ann" in report.failure.cause
    assert ZONE_M == 0.5


@pytest.mark.parametrize(("outline_m", "code"), [(0.55, ""), (0.45, "person_near")])
def test_who_stays_just_beyond_the_zone_is_no_reason_to_give_up(stage, outline_m, code):
    """Who has nowhere to go; where they are within it no hand moves, however long they stay."""
    tick, stopped = stage.puppet.tick, []
    radius_m = stage.puppet.world_map.people[0].radius_m

    def stand():
        tick()
        body = stage.skill.body
        if body.phase.startswith("waiting for Ann"):
            stopped.append(body.now_s)
        near = body.phase.startswith(("reaching", "moving in")) or bool(stopped)
        apart_m = radius_m + (outline_m if stopped else 0.45)
        x_m, y_m, _ = body.p_WE("left")
        stage.puppet.people["ann"] = SE3((x_m, y_m + apart_m, 0.0)) if near else AWAY

    stage.puppet.tick = stand
    report = stage.run(PickParams(object_id="cup", side="left"))
    assert "waiting for Ann to step back" in stage.phases
    assert (report.failure.code if report.failure else "") == code


def thing(X_WO: SE3) -> Obstacle:
    shape = Shape(kind="box", size_m=(0.4, 0.4, 1.2))
    return Obstacle(id="unmapped_7", name="something in the way", X_WO=X_WO, shapes=(shape,))


def test_whoever_comes_beside_the_arm_unseen_counts_as_somebody(stage):
    tick, since = stage.puppet.tick, []

    def step_in():
        tick()
        if stage.skill.body.phase.startswith("reaching") and not since:
            since.append(stage.puppet.time_s)
        here = since and stage.puppet.time_s - since[0] < 3.0
        stage.puppet.unmapped = (thing(SE3((1.6, 0.6, 0.0))),) if here else ()

    stage.puppet.tick = step_in
    report = stage.run(PickParams(object_id="cup"))
    assert report.status == "succeeded", report
    assert "waiting for somebody to step back" in stage.phases


def test_what_stood_there_before_the_arm_moved_does_not(stage):
    stage.puppet.unmapped = (thing(SE3((1.6, 0.9, 0.0))),)
    report = stage.run(PickParams(object_id="cup"))
    assert report.status == "succeeded", report
    assert not any(phase.startswith("waiting") for phase in stage.phases)


@pytest.mark.parametrize("stays", [False, True])
def test_who_stands_beside_where_a_hand_will_work_is_asked_before_it_comes_up(stage, stays):
    """Farther from the stance than the body is wide, so no reason to stop, or to fail."""
    beside = SE3((1.25, -0.64, 0.0))
    comes(stage, "walking", lambda: AWAY if len(stage.said) > 1 and not stays else beside)
    report = stage.run(PickParams(object_id="cup", side="left"), until_phase="raising")
    assert report.status == "running", report
    assert "waiting for Ann to step aside" in stage.phases
    assert stage.said == [PLEAS[0], PLEAS[1]], "from afar, and where she has not left"
    assert "stopping for Ann" not in stage.phases


# --- backing away -------------------------------------------------------------------------------


def held_out(stage, ann: SE3) -> None:
    """Ann stands where a hand is stretched out, as when a hand-over was called off."""
    stage.run(PickParams(object_id="cup"))
    held = stage.context.holdings.find("cup")
    for i in stage.puppet.description.indices(f"{held.side}_arm"):
        stage.puppet.q_rad[i] += 0.5  # the arm is not where it is carried
    stage.puppet.people["ann"] = stage.puppet.X_WS @ ann
    stage.puppet.sent.clear()


@pytest.mark.parametrize("ahead_left_m", [(0.9, 0.0), (0.7, -0.4), (0.5, -0.6)])
def test_a_robot_that_is_too_near_backs_away_before_the_arm_moves(stage, ahead_left_m):
    held_out(stage, SE3((*ahead_left_m, 0.0)))
    begin, ann = stage.puppet.X_WS, stage.puppet.people["ann"].p
    nearest_m = [math.inf]
    tick = stage.puppet.tick

    def watch():
        tick()
        nearest_m[0] = min(nearest_m[0], math.dist(stage.puppet.X_WS.p[:2], ann[:2]))

    stage.puppet.tick = watch
    report = stage.run(NavigateParams(pose=FloorPose(x_m=-1.0, y_m=-1.0, yaw_rad=0.0)))
    assert report.status == "succeeded", report
    assert "stepping back from Ann" in stage.phases
    first = next(c for c in stage.puppet.sent if isinstance(c, WalkTo | MoveArm | Walk))
    assert isinstance(first, WalkTo), "the feet first"
    goal = (stage.puppet.X_WN @ SE3((first.x_m, first.y_m, 0.0))).p
    assert math.dist(goal[:2], ann[:2]) > math.dist(begin.p[:2], ann[:2])
    assert nearest_m[0] >= math.dist(begin.p[:2], ann[:2]) - 0.02


def test_it_does_not_back_into_what_stands_behind_it(stage):
    held_out(stage, SE3((0.9, 0.0, 0.0)))
    X_WS = stage.puppet.X_WS
    beside = [thing(X_WS @ SE3((0.0, y_m, 0.0))) for y_m in (-0.55, 0.55)]
    stage.puppet.unmapped = (thing(X_WS @ SE3((-0.55, 0.0, 0.0))), *beside)
    report = stage.run(NavigateParams(by=Step(forward_m=-0.3)))
    assert report.failure.code == "person_near"
    assert not stage.commands(WalkTo)


def test_with_nobody_near_nothing_is_stepped_back_from(stage):
    held_out(stage, SE3((2.5, 0.0, 0.0)))
    assert stage.run(NavigateParams(by=Step(turn_rad=0.5))).status == "succeeded"
    assert "stepping back from Ann" not in stage.phases


def test_what_was_let_go_before_somebody_came_near_is_put_down(stage):
    on_counter = PlaceParams(object_id="cup", place_id="counter")
    assert stage.run(PickParams(object_id="cup")).status == "succeeded"
    comes(stage, "bringing", lambda: stage.puppet.X_WS @ SE3((0.5, -0.2, 0.0)), for_s=60.0)
    report = stage.run(on_counter)
    assert report.failure.code == "person_near"
    assert not stage.puppet.holding
    stage.puppet.people = {}
    opened = len(stage.commands(Grip))
    assert stage.run(on_counter).status == "succeeded"
    assert len(stage.commands(Grip)) == opened
