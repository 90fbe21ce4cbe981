"""Pick: the object ends in the hand, or the failure says why and the arm is home again."""

import math

import msgspec
import pytest
from msgspec.structs import replace

from executive.skills.motions.approach import TURNED_RAD
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from robot.failures import failure
from robot.messages import (
    DepthImage,
    Grip,
    HoldArm,
    MoveArm,
    MoveHand,
    Obstacle,
    Payload,
    Shape,
    Stand,
    Walk,
    WalkTo,
)
from robot.planning.requests import ArmRequest, PickRequest
from robot.se3 import SE3
from tests.fakes.stage import TABLE_M, Stage

CUP = PickParams(object_id="cup")
AHEAD_M, ASIDE_M = 0.33, 0.22
"""Where `RulePlanner` has who takes a thing stand."""


@pytest.fixture
def stage():
    return Stage()


def test_the_object_ends_in_the_hand_clear_of_the_table(stage):
    report = stage.run(CUP)
    assert report.status == "succeeded", report
    held = stage.context.holdings.find("cup")
    assert held is not None
    assert held.gap_m == pytest.approx(0.07, abs=0.002)
    assert stage.puppet.holding["right"][0] == "cup"
    assert stage.puppet.payload_kg["right"] == pytest.approx(0.2)
    assert stage.puppet.things["cup"].X_WO.p[2] > stage.puppet.surface_m + 0.1
    assert stage.puppet.X_WS.p[0] < 1.2
    assert stage.puppet.mode == "stand"


def test_the_hold_is_known_as_it_is(stage):
    stage.run(CUP)
    held = stage.context.holdings.find("cup")
    believed = stage.puppet.X_WN @ stage.puppet.body().hands["right"].X_NG @ held.X_GO
    assert math.dist(believed.p, stage.puppet.things["cup"].X_WO.p) < 0.01


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_hand_asked_for_is_used(stage, side):
    report = stage.run(PickParams(object_id="cup", side=side))
    assert report.status == "succeeded"
    assert set(stage.puppet.holding) == {side}


def test_fingers_are_open_before_the_hand_moves_in_and_close_before_it_lifts(stage):
    stage.run(CUP)
    order = [c for c in stage.puppet.sent if isinstance(c, Grip | MoveHand)]
    opened = next(i for i, c in enumerate(order) if isinstance(c, Grip) and c.opening_m > 0.08)
    closed = next(i for i, c in enumerate(order) if isinstance(c, Grip) and c.opening_m == 0.0)
    lines = [i for i, c in enumerate(order) if isinstance(c, MoveHand)]
    assert opened < lines[0] < closed < lines[-1]
    assert sum(isinstance(c, Grip) for c in order[closed:]) == 1


def test_the_lift_is_straight_up(stage):
    stage.run(CUP)
    closed = next(
        i for i, c in enumerate(stage.puppet.sent) if isinstance(c, Grip) and c.opening_m == 0.0
    )
    lift = next(c for c in stage.puppet.sent[closed:] if isinstance(c, MoveHand))
    grasp = [c for c in stage.puppet.sent[:closed] if isinstance(c, MoveHand)][-1]
    assert lift.X_NG.p[2] - grasp.X_NG.p[2] == pytest.approx(0.1, abs=0.01)
    assert math.dist(lift.X_NG.p[:2], grasp.X_NG.p[:2]) < 0.01


def test_what_is_held_goes_up_with_the_trunk_as_it_straightens_up(stage):
    """A hand that ended a line stays where it is in the world: its joints are held before that."""
    stage.run(CUP)
    sent = stage.puppet.sent
    lifted = max(i for i, c in enumerate(sent) if isinstance(c, MoveHand))
    after = [c for c in sent[lifted + 1 :] if isinstance(c, HoldArm | Stand | MoveArm)]
    assert isinstance(after[0], HoldArm)
    assert after[0].side == sent[lifted].side
    assert isinstance(after[1], Stand)
    assert after[1].pitch_rad == 0.0


def test_the_held_object_is_planned_with_and_kept_upright(stage):
    stage.run(CUP)
    after = [r for r in stage.planner.requests if isinstance(r, ArmRequest) and r.held is not None]
    assert after
    assert all(request.keep_upright and request.held.id == "cup" for request in after)
    assert all("cup" in request.around.ignored for request in after)


@pytest.mark.parametrize(
    ("off_m", "follows_m"),
    [
        ((-0.03, 0.0), (-0.03, 0.0)),  # nearer than it was seen from afar: the hand pushed it over
        ((-0.02, -0.02), (-0.02, -0.02)),
        ((0.03, 0.0), (0.0, 0.0)),  # the table's edge is where it was
        ((-0.005, 0.005), (0.0, 0.0)),
        ((-0.2, 0.2), (-0.06, 0.03)),
    ],
)
def test_who_steps_in_stands_by_where_the_thing_is_seen_from_near_by(stage, off_m, follows_m):
    cup, tick = stage.puppet.things["cup"], stage.puppet.tick
    x_m, y_m, z_m = cup.X_WO.p

    def seen_better():
        tick()
        if stage.skill.body.phase.startswith("stepping up"):
            cup.X_WO = SE3((x_m + off_m[0], y_m + off_m[1], z_m))

    stage.puppet.tick = seen_better
    stage.run(CUP, until_phase="leaning over")
    (asked,) = (one for one in stage.planner.requests if isinstance(one, PickRequest))
    X_WO = asked.around.objects[0].X_WO
    at = stage.puppet.X_WS.p
    stance = X_WO.p[0] - AHEAD_M, X_WO.p[1] + ASIDE_M
    assert (at[0] - stance[0], at[1] - stance[1]) == pytest.approx(follows_m, abs=0.004)


def test_the_grasp_follows_what_is_seen_not_what_was_planned(stage):
    cup = stage.puppet.things["cup"]
    tick = stage.puppet.tick

    def nudged():
        tick()
        moving_in = "moving in" in stage.skill.body.phase and not stage.puppet.holding
        if moving_in and cup.X_WO.p[1] < 0.119:
            cup.X_WO = SE3((cup.X_WO.p[0], cup.X_WO.p[1] + 0.002, cup.X_WO.p[2]))

    stage.puppet.tick = nudged
    assert stage.run(CUP).status == "succeeded"
    aims = {
        c.X_NG.p
        for c in stage.puppet.sent
        if isinstance(c, MoveHand) and c.speed_m_s == pytest.approx(0.12)
    }
    assert len(aims) > 2


def test_localisation_that_moves_does_not_make_it_miss(stage):
    stage.puppet.drift_m_s = 0.003
    assert stage.run(CUP).status == "succeeded"


def test_an_object_that_is_gone_is_not_grasped_at(stage):
    stage.puppet.things["cup"].known = True
    stage.puppet.blind = True
    report = stage.run(CUP)
    assert report.failure.code == "object_not_seen"
    assert not [c for c in stage.commands(Grip) if c.opening_m == 0.0]
    assert stage.puppet.mode == "stand"


def test_an_object_never_seen_is_searched_for_at_the_places(stage):
    cup = stage.puppet.things["cup"]
    cup.known, cup.seen_s = False, -math.inf
    cup.X_WO = SE3((2.0, 3.7, 0.75))
    far = msgspec.structs.replace(stage.puppet.world_map.places[1], X_WP=SE3((2.0, 3.9, 0.7)))
    places = (stage.puppet.world_map.places[0], far)
    stage.puppet.world_map = msgspec.structs.replace(stage.puppet.world_map, places=places)
    report = stage.run(CUP, limit_s=400.0)
    assert report.status == "succeeded", (report, stage.phases)
    assert "looking over the counter" in stage.phases


def test_what_is_in_sight_from_here_is_found_without_a_step(stage):
    cup = stage.puppet.things["cup"]
    cup.known, cup.seen_s = False, -math.inf
    cup.X_WO = SE3((1.9, 2.4, 0.75))
    stage.run(PickParams(object_id="cup"), limit_s=400.0, until_phase="planning")
    assert stage.phases[:-1] == [
        "looking around for the red cup",
        "looking over the table and the counter",
    ]
    assert not stage.commands(WalkTo)


def snatch(stage, *away):
    """Let the cup be elsewhere each time the fingers close."""
    tick, before, spots = stage.puppet.tick, [""], list(away)

    def snatched():
        phase = stage.skill.body.phase
        if phase.startswith("closing") and before[0] != phase and spots:
            stage.puppet.things["cup"].X_WO = spots.pop(0)
        before[0] = phase
        tick()

    stage.puppet.tick = snatched


def test_closing_on_air_once_is_tried_again_from_the_same_stance(stage):
    snatch(stage, SE3((1.8, 0.30, 0.75)))
    report = stage.run(CUP)
    assert report.status == "succeeded", report
    phases = stage.phases
    again = phases.index("drawing the hand back")
    assert phases[again + 1].startswith("looking at")
    assert not any(phase.startswith("walking") for phase in phases[again:])


def test_a_cup_that_moves_while_the_hand_moves_in_is_aimed_at_again(stage):
    cup, tick, moved = stage.puppet.things["cup"], stage.puppet.tick, []

    def shoved():
        tick()
        if stage.skill.body.phase.startswith("moving in") and not moved:
            moved.append(cup.X_WO)
            cup.X_WO = SE3((cup.X_WO.p[0], cup.X_WO.p[1] + 0.06, cup.X_WO.p[2]))

    stage.puppet.tick = shoved
    report = stage.run(CUP)
    assert report.status == "succeeded", report
    assert stage.phases.count("closing the right fingers") == 1


def test_a_cup_that_falls_over_is_planned_for_again(stage):
    cup, tick = stage.puppet.things["cup"], stage.puppet.tick
    lying = SE3.from_rpy(0.0, math.pi / 2, 0.0, (cup.X_WO.p[0], cup.X_WO.p[1], 0.735))

    def knocked():
        tick()
        if stage.skill.body.phase.startswith("stepping up"):
            cup.X_WO = lying

    stage.puppet.tick = knocked
    stage.run(CUP)
    plans = [request for request in stage.planner.requests if isinstance(request, PickRequest)]
    assert len(plans) > 1
    assert plans[1].walk_cost_per_m > plans[0].walk_cost_per_m


def test_a_cup_on_the_floor_is_not_reached_for(stage):
    stage.puppet.things["cup"].X_WO = SE3((1.0, -1.0, 0.05))
    report = stage.run(CUP)
    assert report.failure.code == "on_the_floor"
    assert not stage.commands(Walk)


def test_a_silent_camera_ends_the_grasp(stage):
    puppet, image = stage.puppet, DepthImage(stamp_s=0.0, width=1, height=1, fovy_rad=1.0,
                                             depth_m=b"")  # fmt: skip

    def depth():
        blind = stage.skill.body.phase.startswith("moving in")
        return image if blind else msgspec.structs.replace(image, stamp_s=puppet.time_s)

    puppet.depth = depth
    report = stage.run(CUP)
    assert report.failure.code == "sensor_silent"
    assert not [c for c in stage.commands(Grip) if c.opening_m == 0.0]
    assert puppet.X_WS.p[0] < 1.2, "it has stepped back"


def test_closing_on_air_twice_backs_off_and_says_so(stage):
    snatch(stage, SE3((1.8, 0.30, 0.75)), SE3((1.8, 0.05, 0.75)))
    report = stage.run(CUP)
    assert report.failure.code == "grasp_missed"
    assert report.failure.evidence["gap_m"] < 0.006
    assert stage.context.holdings.all() == ()
    assert stage.puppet.payload_kg["right"] == 0.0
    nominal = stage.puppet.description.posture("nominal")
    for i in stage.puppet.description.indices("right_arm"):
        assert stage.puppet.q_rad[i] == pytest.approx(nominal[i])
    assert stage.puppet.X_WS.p[0] < 1.2


def test_a_gap_of_another_width_is_a_pinch_off_the_middle(stage):
    stage.puppet.things["cup"].width_m = 0.045
    report = stage.run(CUP)
    assert report.failure.code == "grasp_missed"
    assert "pinched" in report.failure.cause


def test_what_stays_down_is_not_held(stage):
    stage.puppet.things["cup"].mass_kg = 0.01
    report = stage.run(CUP)
    assert report.failure.code == "grasp_missed"
    assert "come up" in report.failure.cause
    assert report.failure.evidence["expected_n"] == pytest.approx(1.96, abs=0.01)


def test_out_of_reach_moves_the_base_twice_then_fails(stage):
    far = failure("out_of_reach", "3 cm short")
    arm = stage.planner._arm
    stage.planner._arm = lambda r: far if isinstance(r.goal, SE3) else arm(r)
    report = stage.run(CUP)
    assert report.failure.code == "out_of_reach"
    picks = [r for r in stage.planner.requests if isinstance(r, PickRequest)]
    assert len(picks) == 3
    assert len({request.seed for request in picks}) == 3


@pytest.mark.parametrize(("wanted", "code"), [(None, ""), ("right", "planner_timeout")])
def test_where_no_way_up_is_found_for_one_hand_the_other_is_taken(stage, wanted, code):
    arm = stage.planner._arm
    stuck = failure("planner_timeout", "no free way for the right arm; counter is in the way")
    stage.planner._arm = lambda r: (
        stuck if r.side == "right" and not isinstance(r.goal, SE3) else arm(r)
    )
    report = stage.run(msgspec.structs.replace(CUP, side=wanted))
    assert (report.failure.code if report.failure else "") == code
    held = stage.context.holdings.find(CUP.object_id)
    assert (held.side if held else None) == (None if wanted else "left")


def test_after_moving_over_it_steps_back_from_where_it_stands(stage):
    pick, arm, plans = stage.planner._pick, stage.planner._arm, []

    def elsewhere(request):
        plan = pick(request)
        (x, y, yaw), (sx, sy, _) = plan.standoff, plan.stance
        left_m, turn_rad = 0.4 * len(plans), 0.5 * len(plans)
        plans.append(
            msgspec.structs.replace(
                plan,
                standoff=(x, y + left_m, yaw + turn_rad),
                stance=(sx, sy + left_m, yaw + turn_rad),
            )
        )
        return plans[-1]

    stage.planner._pick = elsewhere
    far = failure("out_of_reach", "3 cm short")
    stage.planner._arm = lambda r: far if isinstance(r.goal, SE3) else arm(r)
    assert stage.run(CUP).failure.code == "out_of_reach"
    assert len(plans) == 3
    back = stage.puppet.X_WS
    assert (*back.p[:2], back.yaw_rad) == pytest.approx(plans[-1].standoff, abs=0.07)


def test_out_of_reach_once_is_cured_by_another_stance(stage):
    arm, told = stage.planner._arm, []

    def once(request):
        if isinstance(request.goal, SE3) and not told:
            told.append(request)
            return failure("out_of_reach", "3 cm short")
        return arm(request)

    stage.planner._arm = once
    assert stage.run(CUP).status == "succeeded"


def test_a_few_centimetres_short_are_stepped(stage):
    arm, told = stage.planner._arm, []

    def once(request):
        if isinstance(request.goal, SE3) and not told:
            told.append(stage.puppet.X_WS.p[0])
            return failure("out_of_reach", "1 cm short", short_m=0.01)
        return arm(request)

    stage.planner._arm = once
    report = stage.run(CUP, until_phase="moving in")
    assert report.status == "running"
    assert stage.puppet.X_WS.p[0] - told[0] == pytest.approx(0.025, abs=0.005)
    assert len([r for r in stage.planner.requests if isinstance(r, PickRequest)]) == 1
    assert stage.commands(Stand)[-1].pitch_rad == pytest.approx(0.1), "it leans over again"


def test_an_arm_that_stalls_fails_and_is_held(stage):
    stage.run(CUP, until_phase="reaching")
    stage.puppet.stuck_arm = True
    while (report := stage.skill.step(stage.puppet.time_s)).status == "running":
        stage.puppet.tick()
        assert stage.puppet.time_s < 100.0
    assert report.failure.code == "arm_stalled"


def test_a_drop_on_the_way_back_is_noticed(stage):
    stage.run(CUP, until_phase="stepping back")
    stage.puppet.slips_at_s = stage.puppet.time_s + 0.2
    while (report := stage.skill.step(stage.puppet.time_s)).status == "running":
        stage.puppet.tick()
    assert report.failure.code == "object_dropped"
    assert stage.context.holdings.all() == ()


def turns_out_white(stage) -> None:
    stage.puppet.things["cup"].unlike = "white"
    stage.puppet.things["cup"].known = False


def test_what_turns_out_to_be_another_thing_is_put_back_and_not_called_done(stage):
    """A cream box was taken for the orange one, carried there, and reported as done."""
    stage.run(CUP, until_phase="lifting")
    turns_out_white(stage)
    while (report := stage.skill.step(stage.puppet.time_s)).status == "running":
        stage.puppet.tick()
    assert report.failure.code == "wrong_object"
    assert "white" in report.failure.cause
    assert stage.context.holdings.all() == ()
    assert stage.puppet.holding == {}
    assert stage.puppet.things["cup"].X_WO.p[2] == pytest.approx(TABLE_M + 0.05, abs=0.02)


def test_another_thing_in_the_hand_is_not_what_was_to_be_picked_up(stage):
    assert stage.run(CUP).status == "succeeded"
    turns_out_white(stage)
    assert stage.run(CUP).failure.code == "wrong_object"


def test_full_hands_are_refused_before_anything_moves(stage):
    stage.run(PickParams(object_id="cup", side="right"))
    sent = len(stage.puppet.sent)
    held = stage.context.holdings.find("cup")
    stage.context.holdings.take(msgspec.structs.replace(held, object_id="box"))
    report = stage.run(PickParams(object_id="cup", side="right"))
    assert report.failure.code == "hands_full"
    assert not [c for c in stage.puppet.sent[sent:] if isinstance(c, Walk | WalkTo | MoveArm)]


def test_what_is_held_already_need_not_be_picked(stage):
    stage.run(CUP)
    sent = len(stage.puppet.sent)
    assert stage.run(CUP).status == "succeeded"
    assert len(stage.puppet.sent) == sent


def test_a_pick_stopped_with_the_object_in_hand_goes_on_from_there(stage):
    stage.run(CUP, until_phase="straightening")
    stage.stop()
    assert stage.puppet.X_WS.p[0] > 1.4
    assert stage.run(CUP).status == "succeeded"
    held = stage.context.holdings.find("cup")
    indices = stage.puppet.description.indices("right_arm")
    assert [stage.puppet.q_rad[i] for i in indices] == pytest.approx(held.carry_rad)


def test_an_unknown_object_moves_nothing(stage):
    report = stage.run(PickParams(object_id="unicorn"))
    assert report.failure.code == "unknown_object"
    assert not stage.commands(Walk)


def test_the_planners_refusal_is_reported_as_it_is(stage):
    stage.planner.failures[PickRequest] = [failure("no_grasp", "12 cm wide")]
    report = stage.run(CUP)
    assert report.failure.code == "no_grasp"
    assert not stage.commands(Payload)


PHASES = (
    *("planning", "walking", "raising", "stepping up", "leaning", "looking", "reaching"),
    *("moving in", "closing", "lifting", "straightening", "stepping back", "bringing"),
)


@pytest.mark.parametrize("phase", PHASES)
def test_it_can_be_stopped_in_any_phase_and_stands(stage, phase):
    assert stage.run(CUP, until_phase=phase).status == "running"
    for _ in range(3):
        stage.puppet.tick()
        stage.skill.step(stage.puppet.time_s)
    grips = len(stage.commands(Grip))
    report = stage.stop()
    assert report.failure.code == "cancelled"
    assert stage.puppet.mode == "stand"
    assert stage.planner.open == {}
    opened = phase == "closing"  # nobody knows yet what is between the fingers
    assert len(stage.commands(Grip)) == grips + opened, "stopping keeps a grip that is one"
    assert not (opened and stage.puppet.holding)
    assert stage.stop() == report


def arm_moves(stage):
    """What the legs did, and what the skill said, whenever an arm was told to move."""
    send, moves = stage.puppet.send, []

    def listen(command):
        if isinstance(command, MoveArm):
            moves.append((stage.skill.body.phase, stage.puppet.mode))
        send(command)

    stage.puppet.send = listen
    return moves


def test_a_hand_moves_on_the_last_steps_while_it_holds_nothing(stage):
    moves = arm_moves(stage)
    assert stage.run(CUP).status == "succeeded"
    assert moves[0] == ("raising the right hand", "walk")
    assert moves[-1] == ("bringing the right arm in", "stand"), "with the cup"
    moves.clear()
    assert stage.run(PlaceParams(object_id="cup", place_id="counter")).status == "succeeded"
    assert moves[-1] == ("bringing the right arm in", "walk"), "without it"


def test_where_there_is_no_room_for_an_arm_the_feet_stand_first(stage):
    post = Shape(kind="box", size_m=(0.1, 0.1, 1.0))
    near = Obstacle(id="post", name="post", X_WO=SE3((1.1, 0.7, 0.5)), shapes=(post,))
    stage.puppet.world_map = replace(stage.puppet.world_map, obstacles=(near,))
    moves = arm_moves(stage)
    assert stage.run(CUP).status == "succeeded"
    assert moves[0] == ("raising the right hand", "stand")
    assert moves[-1] == ("bringing the right arm in", "stand")


@pytest.mark.parametrize(("wall_y_m", "turned"), [(0.48, True), (0.8, False)])
def test_beside_a_wall_a_hand_comes_up_when_the_body_has_turned(stage, wall_y_m, turned):
    """The cup is taken heading along x, from a standoff beside the wall, coming along the wall."""
    shape = Shape(kind="box", size_m=(6.0, 0.02, 2.0))
    at = SE3((1.12, 0.32 + wall_y_m, 1.0))
    wall = Obstacle(id="wall", name="wall", X_WO=at, shapes=(shape,))
    stage.puppet.world_map = replace(stage.puppet.world_map, obstacles=(wall,))
    stage.puppet.X_WS = SE3.from_xy_yaw(1.12, -1.5, math.pi / 2)
    yaws = []
    send = stage.puppet.send

    def listen(command):
        if isinstance(command, MoveArm):
            yaws.append(stage.puppet.X_WS.yaw_rad)
        send(command)

    stage.puppet.send = listen
    assert stage.run(CUP).status == "succeeded"
    assert (abs(yaws[0]) <= TURNED_RAD) == turned
