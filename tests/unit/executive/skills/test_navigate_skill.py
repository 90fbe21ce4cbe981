"""Navigate: gets there exactly, replans around what blocks, and says why not."""

import math
from dataclasses import replace

import msgspec
import pytest

from executive.skills.holding import Held
from executive.skills.motions.body_access import Body
from executive.skills.motions.reach import posture_rad
from executive.skills.navigate import FloorPose, Navigate, NavigateParams, Step
from robot.failures import failure
from robot.messages import MoveArm, Obstacle, Shape, Stand, Walk, WalkTo
from robot.planning.requests import ArmRequest, BasePathRequest
from robot.se3 import SE3, wrap_angle
from tests.fakes.puppet import Thing
from tests.fakes.stage import DESCRIPTION, Stage


@pytest.fixture
def stage():
    return Stage()


def to(x_m, y_m, yaw_rad=None):
    return NavigateParams(pose=FloorPose(x_m=x_m, y_m=y_m, yaw_rad=yaw_rad))


@pytest.mark.parametrize("goal", [(2.0, 0.0, 0.0), (-1.5, 1.0, 2.0), (0.2, 0.1, 0.3), (0, 0, 3.1)])
def test_it_stands_exactly_where_it_was_sent(stage, goal):
    report = stage.run(to(*goal))
    assert report.status == "succeeded", report
    assert math.dist(stage.puppet.X_WS.p[:2], goal[:2]) < 0.03
    assert abs(wrap_angle(stage.puppet.X_WS.yaw_rad - goal[2])) < math.radians(3)
    assert stage.puppet.mode == "stand"


def test_without_a_heading_it_arrives_as_it_came(stage):
    stage.run(to(0.0, -2.0))
    assert stage.puppet.X_WS.yaw_rad == pytest.approx(-math.pi / 2, abs=0.05)


def test_the_goal_is_aimed_at_again_when_localisation_moves(stage):
    stage.puppet.drift_m_s = 0.02
    report = stage.run(to(2.0, 1.0, 0.0))
    assert report.status == "succeeded"
    assert math.dist(stage.puppet.X_WS.p[:2], (2.0, 1.0)) < 0.03


def test_a_walk_that_ends_aside_is_corrected_twice_then_fails(stage):
    stage.puppet.miss_m = 0.06
    report = stage.run(to(1.5, 0.0, 0.0))
    assert report.failure.code == "walk_stalled"
    assert report.failure.evidence["off_m"] == pytest.approx(0.06, abs=0.01)
    assert len(stage.commands(WalkTo)) == 3


def test_legs_that_do_not_move_are_noticed(stage):
    stage.puppet.stuck_legs = True
    report = stage.run(to(2.0, 0.0, 0.0), limit_s=30.0)
    assert report.failure.code == "walk_stalled"
    assert isinstance(stage.puppet.sent[-1], Stand)


def box(x_m, y_m, name="unmapped 1"):
    shape = Shape(kind="box", size_m=(0.3, 0.3, 1.0))
    return Obstacle(id=name, name=name, X_WO=SE3((x_m, y_m, 0.5)), shapes=(shape,))


def test_a_blocked_path_is_planned_again_three_times_then_named(stage):
    stage.puppet.unmapped = (box(1.0, 0.0, "a chair"),)
    report = stage.run(to(2.0, 0.0, 0.0))
    assert report.failure.code == "path_blocked"
    assert "a chair" in report.failure.cause
    asked = [r for r in stage.planner.requests if isinstance(r, BasePathRequest)]
    assert len(asked) == 4
    assert all(request.around.unmapped for request in asked)
    assert stage.puppet.X_WS.p[0] < 0.7


def test_a_flicker_of_an_obstacle_does_not_stop_the_walk(stage):
    tick = stage.puppet.tick

    def flicker():
        tick()
        ahead = stage.puppet.X_WS @ SE3((0.6, 0.0, 0.0))
        now = round(stage.puppet.time_s / 0.05) % 10 < 4
        stage.puppet.unmapped = (box(*ahead.p[:2]),) if now else ()

    stage.puppet.tick = flicker
    assert stage.run(to(2.0, 0.0, 0.0)).status == "succeeded"


def test_what_is_beside_the_path_does_not_block(stage):
    stage.puppet.unmapped = (box(1.0, 0.6),)
    assert stage.run(to(2.0, 0.0, 0.0)).status == "succeeded"


def test_the_planners_failure_is_the_skills(stage):
    inside = failure("goal_in_collision", "inside the table")
    stage.planner.failures[BasePathRequest] = [inside, inside]
    report = stage.run(to(2.0, 0.0, 0.0))
    assert report.failure.code == "goal_in_collision"
    assert stage.commands(Walk) == []


def test_who_closes_the_only_way_is_walked_up_to(stage):
    closed = failure("no_path", "Ann closes every way", blocked_by="ann")
    stage.planner.failures[BasePathRequest] = [closed, closed]
    assert stage.run(to(2.0, 0.0, 0.0)).status == "succeeded"
    wide, close, past = [r for r in stage.planner.requests if isinstance(r, BasePathRequest)][:3]
    assert wide.around.map.people[0].radius_m > close.around.map.people[0].radius_m
    assert "ann" not in close.around.ignored
    assert "ann" in past.around.ignored


def test_what_the_sensors_see_of_them_is_left_out_with_them(stage):
    stage.puppet.unmapped = (box(0.05, 3.2, "in view 1"), box(2.5, -2.5, "in view 2"))
    closed = failure("no_path", "Ann closes every way", blocked_by="ann")
    stage.planner.failures[BasePathRequest] = [closed, closed]
    stage.run(to(2.0, 0.0, 0.0))
    past = [r for r in stage.planner.requests if isinstance(r, BasePathRequest)][2]
    assert past.around.ignored == ("ann", "in view 1")


def test_furniture_that_closes_the_way_is_no_person(stage):
    closed = failure("goal_in_collision", "inside the table", blocked_by="table")
    stage.planner.failures[BasePathRequest] = [closed, closed]
    assert stage.run(to(2.0, 0.0, 0.0)).failure.code == "goal_in_collision"
    asked = [r for r in stage.planner.requests if isinstance(r, BasePathRequest)]
    assert len(asked) == 2


def test_at_a_surface_it_faces_it_from_the_near_side(stage):
    report = stage.run(NavigateParams(place_id="table"))
    assert report.status == "succeeded"
    assert math.dist(stage.puppet.X_WS.p[:2], (1.3, 0.0)) < 0.03
    assert abs(stage.puppet.X_WS.yaw_rad) < 0.06


def test_a_side_that_is_not_free_is_left_for_the_next(stage):
    stage.planner.failures[BasePathRequest] = [failure("goal_in_collision", "a chair is there")]
    report = stage.run(NavigateParams(place_id="table"))
    assert report.status == "succeeded"
    assert math.dist(stage.puppet.X_WS.p[:2], (1.3, 0.0)) > 0.5


def test_it_stops_before_a_person_facing_them(stage):
    stage.run(NavigateParams(person_id="ann"))
    X_WS = stage.puppet.X_WS
    assert math.dist(X_WS.p[:2], (0.0, 3.0)) == pytest.approx(1.25, abs=0.04)
    assert X_WS.yaw_rad == pytest.approx(math.pi / 2, abs=0.06)


@pytest.mark.parametrize("unknown", [{"place_id": "moon"}, {"person_id": "nobody"}])
def test_an_unknown_id_moves_nothing(stage, unknown):
    report = stage.run(NavigateParams(**unknown))
    assert report.failure.code == "unknown_place"
    assert stage.commands(Walk) == []


@pytest.mark.parametrize(
    ("step", "goal"),
    [
        (Step(forward_m=1.0), (1.0, 0.0, 0.0)),
        (Step(forward_m=-0.6), (-0.6, 0.0, 0.0)),
        (Step(left_m=0.5), (0.0, 0.5, 0.0)),
        (Step(turn_rad=math.pi / 2), (0.0, 0.0, math.pi / 2)),
        (Step(turn_rad=math.pi / 2, forward_m=1.0), (0.0, 1.0, math.pi / 2)),
    ],
)
def test_steps_are_relative_to_here(stage, step, goal):
    assert stage.run(NavigateParams(by=step)).status == "succeeded"
    assert math.dist(stage.puppet.X_WS.p[:2], goal[:2]) < 0.03
    assert abs(wrap_angle(stage.puppet.X_WS.yaw_rad - goal[2])) < 0.06


def test_a_short_step_frees_a_robot_that_touches_something(stage):
    touching = failure("start_in_collision", "its hand touches the table")
    stage.planner.failures[BasePathRequest] = [touching, touching]
    assert stage.run(NavigateParams(by=Step(forward_m=-0.3))).status == "succeeded"
    assert stage.puppet.X_WS.p[0] == pytest.approx(-0.3, abs=0.03)
    stage.planner.failures[BasePathRequest] = [touching, touching]
    report = stage.run(NavigateParams(by=Step(forward_m=1.0)))
    assert report.failure.code == "start_in_collision"


def test_a_way_is_wide_around_people_unless_there_is_none_so_wide(stage):
    asked, plan = [], stage.planner.path

    def path(request):
        asked.append(request.around.map.people[0].radius_m)
        return plan(request)

    stage.planner.path = path
    own_m = stage.puppet.world_map.people[0].radius_m
    assert stage.run(to(1.0, 0.0, 0.0)).status == "succeeded"
    assert min(asked) > own_m
    stage.planner.failures[BasePathRequest] = [failure("no_path", "somebody stands there")]
    assert stage.run(to(0.0, 0.0, 0.0)).status == "succeeded"
    assert asked[-1] == own_m


def test_a_step_back_does_not_turn_around(stage):
    headings = []
    tick = stage.puppet.tick

    def watch():
        tick()
        headings.append(abs(stage.puppet.X_WS.yaw_rad))

    stage.puppet.tick = watch
    stage.run(NavigateParams(by=Step(forward_m=-1.0)))
    assert max(headings) < 0.1


@pytest.mark.parametrize("turns", [1.0, -2.0])
def test_full_turns_are_turned_in_full(stage, turns):
    stage.run(NavigateParams(by=Step(turn_rad=turns * 2 * math.pi)))
    assert stage.puppet.turned_rad == pytest.approx(turns * 2 * math.pi, abs=0.1)


def test_an_arm_that_is_out_is_brought_home_first(stage):
    for i in stage.puppet.description.indices("right_arm"):
        stage.puppet.q_rad[i] += 0.5
    stage.run(to(1.0, 0.0))
    kinds = [type(command) for command in stage.puppet.sent]
    assert kinds.index(MoveArm) < kinds.index(Walk)


def test_a_dropped_object_stops_the_walk(stage):
    thing = Thing("cup", SE3((9, 9, 0.75)))
    stage.puppet.things["cup"] = thing
    stage.puppet.holding["right"] = ("cup", SE3())
    stage.puppet._openings["right"] = thing.width_m
    stage.puppet._wanted["right"] = 0.0
    stage.puppet.slips_at_s = 4.0
    held = Held(
        object_id="cup",
        side="right",
        X_GO=SE3(),
        gap_m=0.07,
        mass_kg=0.2,
        carry_rad=posture_rad(Body(stage.context), "right", "nominal"),
    )
    stage.context.holdings.take(held)
    report = stage.run(to(3.0, 0.0))
    assert report.failure.code == "object_dropped"
    assert stage.context.holdings.find("cup") is None
    assert stage.puppet.payload_kg["right"] == 0.0
    assert stage.puppet.mode == "stand"


def test_stop_in_mid_walk_stands_and_forgets_nothing_open(stage):
    stage.run(to(3.0, 0.0), until_phase="walking", limit_s=5.0)
    for _ in range(60):
        stage.puppet.tick()
        stage.skill.step(stage.puppet.time_s)
    report = stage.stop()
    assert report.failure.code == "cancelled"
    assert stage.puppet.mode == "stand"
    assert stage.planner.open == {}
    assert stage.stop() == report


def test_stop_while_planning_cancels_the_plan(stage):
    stage.skill = stage.make(to(3.0, 0.0))
    stage.skill.start(0.0)
    stage.skill.step(0.0)
    assert stage.planner.open
    stage.stop()
    assert stage.planner.open == {}
    assert stage.planner.cancelled


def test_it_walks_no_faster_than_it_may_even_if_that_changes_on_the_way(stage):
    limits = iter([0.2] * 40 + [0.1] * 10_000)
    stage.context = replace(stage.context, speed_limit=lambda: next(limits))
    assert stage.run(to(2.0, 0.0, 0.0)).status == "succeeded"
    speeds = [math.hypot(walk.forward_m_s, walk.left_m_s) for walk in stage.commands(Walk)]
    assert max(speeds[:40]) == pytest.approx(0.2, abs=1e-3)
    assert max(speeds[40:]) == pytest.approx(0.1, abs=1e-3)


def test_an_interrupted_step_goes_on_to_where_it_would_have_led(stage):
    wanted = stage.puppet.X_WS @ SE3((1.5, 0.0, 0.0))
    stage.run(NavigateParams(by=Step(forward_m=1.5)), until_phase="walking")
    for _ in range(40):
        stage.puppet.tick()
        stage.skill.step(stage.puppet.time_s)
    rest = stage.skill.remaining()
    stage.stop()
    assert stage.run(rest).status == "succeeded"
    assert math.dist(stage.puppet.X_WS.p[:2], wanted.p[:2]) < 0.03


@pytest.mark.parametrize("after", [1, 30, 70, 120])
def test_an_interrupted_turn_turns_what_is_left_of_it(stage, after):
    whole_rad = 2.5 * math.pi
    stage.run(NavigateParams(by=Step(turn_rad=whole_rad)), until_phase="walking")
    for _ in range(after):
        stage.puppet.tick()
        stage.skill.step(stage.puppet.time_s)
    rest = stage.skill.remaining()
    stage.stop()
    assert stage.run(rest).status == "succeeded"
    assert stage.puppet.turned_rad == pytest.approx(whole_rad, abs=0.15)


@pytest.mark.parametrize("step", [Step(forward_m=9.0), Step(turn_rad=math.pi, forward_m=3.1),
                                  Step(left_m=-2.96)])  # fmt: skip
def test_a_step_out_of_the_map_is_refused_before_anything_moves(stage, step):
    report = stage.run(NavigateParams(by=step))
    assert report.failure.code == "invalid_goal"
    assert report.failure.suggestion == "x from -2.94 to 3.94 m, y from -2.94 to 3.94 m"
    for kind in (Walk, WalkTo, MoveArm):
        assert not stage.commands(kind)


def test_who_is_out_of_the_map_may_step_back_into_it(stage):
    stage.puppet.X_WS = SE3.from_xy_yaw(-3.2, 0.0, 0.0)
    assert stage.run(NavigateParams(by=Step(forward_m=0.2))).status == "succeeded"


@pytest.mark.parametrize(
    ("wanted", "words"),
    [
        (to(4.0, 1.0), "at the very edge of this world"),
        (to(3.97, 1.0), "at the very edge of this world"),
        (to(9.0, 1.0), "outside this world"),
        (NavigateParams(by=Step(forward_m=10.5)), "10.5 m from here is outside this world"),
    ],
)
def test_what_lies_beyond_the_map_is_refused_wherever_the_robot_stands(stage, wanted, words):
    refusal = Navigate.refusal(wanted, stage.puppet.map(), DESCRIPTION)
    assert refusal is not None
    assert words in refusal.cause
    assert " m" in refusal.suggestion


def test_what_lies_in_the_map_is_not_refused(stage):
    for wanted in (to(3.9, 2.9), to(-2.94, 0.0), NavigateParams(by=Step(forward_m=9.0))):
        assert Navigate.refusal(wanted, stage.puppet.map(), DESCRIPTION) is None


@pytest.mark.parametrize(("wall_m", "backed_m"), [(2.0, 0.3), (0.5, 0.2), (0.3, 0.0)])
def test_a_hand_among_things_is_freed_by_a_step_back_no_further_than_there_is_room(
    stage, wall_m, backed_m
):
    shape = Shape(kind="box", size_m=(0.02, 4.0, 2.0))
    wall = Obstacle(id="wall", name="wall", X_WO=SE3((-wall_m, 0.0, 1.0)), shapes=(shape,))
    stage.puppet.world_map = msgspec.structs.replace(stage.puppet.world_map, obstacles=(wall,))
    for i in stage.puppet.description.indices("left_arm"):
        stage.puppet.q_rad[i] += 0.5
    stage.planner.failures[ArmRequest] = [failure("no_path", "among things")] * 2
    report = stage.run(to(1.0, 0.0))
    assert (report.status == "succeeded") == (backed_m > 0.0)
    first = next(iter(stage.commands(WalkTo)), None)
    at = stage.puppet.X_WN @ SE3((first.x_m, first.y_m, 0.0)) if first else SE3()
    assert at.p[:2] == pytest.approx((-backed_m, 0.0), abs=0.01)


def wall_behind(stage, wall_m: float) -> None:
    shape = Shape(kind="box", size_m=(0.02, 4.0, 0.7))
    wall = Obstacle(id="bench", name="bench", X_WO=SE3((-wall_m, 0.0, 0.35)), shapes=(shape,))
    stage.puppet.world_map = msgspec.structs.replace(stage.puppet.world_map, obstacles=(wall,))


def test_a_step_back_into_furniture_is_refused_by_name(stage):
    wall_behind(stage, 0.4)
    touching = failure("start_in_collision", "its foot touches the bench")
    stage.planner.failures[BasePathRequest] = [touching, touching]  # frees nothing by going there
    report = stage.run(NavigateParams(by=Step(forward_m=-0.3)))
    assert report.failure.code == "goal_in_collision"
    assert "the bench would be 9 cm from its middle" in report.failure.cause
    assert not stage.commands(WalkTo)
    assert stage.run(NavigateParams(by=Step(forward_m=-0.1))).status == "succeeded"


def test_a_step_back_that_makes_room_goes_where_room_is(stage):
    wall_behind(stage, 0.3)
    report = stage.run(NavigateParams(by=Step(forward_m=-0.3, or_less=True)))
    assert report.status == "succeeded", report
    x_m, y_m, _ = stage.puppet.X_WS.p
    assert x_m > -0.04 and math.hypot(x_m, y_m) > 0.09


def test_an_arm_with_no_place_at_the_side_is_brought_in_after_a_step_to_where_it_has(stage):
    wall_behind(stage, 0.2)
    for i in stage.puppet.description.indices("left_arm"):
        stage.puppet.q_rad[i] += 0.5
    overlap = failure("goal_in_collision", "where the arm should go, it overlaps the bench")
    stage.planner.failures[ArmRequest] = [overlap]
    report = stage.run(NavigateParams(by=Step(turn_rad=0.3)))
    assert report.status == "succeeded", report
    assert stage.puppet.X_WS.p[0] > 0.05, "away from the bench"
