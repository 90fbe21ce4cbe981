"""Place: the object ends where it was to go, let go only when it stands on something."""

import math

import pytest
from msgspec.structs import replace

from executive.skills.motions.support import occupant
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams, PutDown
from robot.failures import failure
from robot.messages import Grip, MoveHand, Unnamed
from robot.physics import GRAVITY_M_S2
from robot.planning.requests import ArmRequest, PlaceRequest
from robot.se3 import SE3
from tests.fakes.puppet import Thing
from tests.fakes.stage import DESCRIPTION, TABLE_M, Stage

ON_COUNTER = PlaceParams(object_id="cup", place_id="counter")


@pytest.fixture
def stage():
    stage = Stage()
    assert stage.run(PickParams(object_id="cup")).status == "succeeded"
    return stage


def test_the_object_stands_on_the_place_and_the_hand_is_empty(stage):
    report = stage.run(ON_COUNTER)
    assert report.status == "succeeded", report
    cup = stage.puppet.things["cup"]
    assert math.dist(cup.X_WO.p, (2.0, 2.5, TABLE_M + 0.05)) < 0.03
    assert stage.context.holdings.all() == ()
    assert stage.puppet.holding == {}
    assert stage.puppet.payload_kg["right"] == 0.0
    assert stage.puppet.mode == "stand"


def test_it_is_lowered_slowly_until_its_weight_is_off(stage):
    stage.run(ON_COUNTER)
    down = [c for c in stage.commands(MoveHand) if c.stop_load_n is not None]
    assert down
    assert all(c.speed_m_s <= 0.05 for c in down)
    assert all(0.5 <= c.stop_load_n <= 0.2 * GRAVITY_M_S2 for c in down)


def test_the_fingers_open_only_after_it_was_lowered(stage):
    before = len(stage.puppet.sent)
    stage.run(ON_COUNTER)
    sent = stage.puppet.sent[before:]
    first_open = next(i for i, c in enumerate(sent) if isinstance(c, Grip))
    last_down = max(
        i for i, c in enumerate(sent) if isinstance(c, MoveHand) and c.stop_load_n is not None
    )
    assert first_open > last_down


def test_an_exact_pose_is_met(stage):
    target = SE3((1.9, 2.3, TABLE_M + 0.05))
    report = stage.run(PlaceParams(object_id="cup", X_WO=target))
    assert report.status == "succeeded"
    assert math.dist(stage.puppet.things["cup"].X_WO.p, target.p) < 0.03
    request = next(r for r in stage.planner.requests if isinstance(r, PlaceRequest))
    assert request.place.id == "counter"
    assert request.target == target


def test_the_object_is_kept_clear_and_upright_until_it_is_let_go(stage):
    before = len(stage.planner.requests)
    stage.run(ON_COUNTER)
    asked = [r for r in stage.planner.requests[before:] if isinstance(r, ArmRequest)]
    assert [request.held is not None for request in asked] == [True, True, False]
    assert [request.keep_upright for request in asked] == [True, True, False]


def test_an_object_that_is_not_held_cannot_be_placed(stage):
    stage.context.holdings.release("right")
    sent = len(stage.puppet.sent)
    report = stage.run(ON_COUNTER)
    assert report.failure.code == "not_holding"
    assert len(stage.commands(Grip)) == len(
        [c for c in stage.puppet.sent[:sent] if isinstance(c, Grip)]
    )


def test_what_was_put_there_and_is_another_thing_is_a_miss_that_says_so(stage):
    stage.run(ON_COUNTER, until_phase="stepping back")
    stage.puppet.blind = True  # nothing of its name is seen there any more
    stage.puppet.things["cup"].unlike = "white"
    while (report := stage.skill.step(stage.puppet.time_s)).status == "running":
        stage.puppet.tick()
    assert report.failure.code == "place_missed"
    assert "is white" in report.failure.cause


def test_what_topples_is_a_miss(stage):
    tick = stage.puppet.tick

    def toppled():
        tick()
        if stage.skill.body.phase.startswith("stepping back"):
            cup = stage.puppet.things["cup"]
            cup.X_WO = SE3.from_rpy(math.pi / 2, 0.0, 0.0, cup.X_WO.p)

    stage.puppet.tick = toppled
    report = stage.run(ON_COUNTER)
    assert report.failure.code == "place_missed"
    assert "toppled" in report.failure.cause


def test_what_is_gone_afterwards_is_a_miss(stage):
    stage.run(ON_COUNTER, until_phase="stepping back")
    stage.puppet.blind = True
    while (report := stage.skill.step(stage.puppet.time_s)).status == "running":
        stage.puppet.tick()
    assert report.failure.code == "place_missed"


def test_something_under_it_is_noticed_before_the_fingers_open(stage):
    stage.run(ON_COUNTER, until_phase="reaching over")
    stage.puppet.surface_m = TABLE_M + 0.05
    while (report := stage.skill.step(stage.puppet.time_s)).status == "running":
        stage.puppet.tick()
    assert report.failure.code == "place_missed"
    assert stage.context.holdings.find("cup") is not None
    assert stage.puppet.holding


def test_a_failure_over_the_place_draws_back_with_the_object(stage):
    arm = stage.planner._arm
    far = failure("out_of_reach", "20 cm short", short_m=0.2)
    stage.planner._arm = lambda r: far if isinstance(r.goal, SE3) else arm(r)
    report = stage.run(ON_COUNTER)
    assert report.failure.code == "out_of_reach"
    assert stage.context.holdings.find("cup") is not None
    assert stage.puppet.holding
    assert stage.puppet.X_WS.p[0] < 1.4
    held = stage.context.holdings.find("cup")
    indices = stage.puppet.description.indices("right_arm")
    assert [stage.puppet.q_rad[i] for i in indices] == pytest.approx(held.carry_rad)


def test_a_few_centimetres_short_are_stepped(stage):
    arm, told = stage.planner._arm, []

    def once(request):
        if isinstance(request.goal, SE3) and not told:
            told.append(request)
            return failure("out_of_reach", "1 cm short", short_m=0.01)
        return arm(request)

    stage.planner._arm = once
    assert stage.run(ON_COUNTER).status == "succeeded"
    assert "stepping nearer" in stage.phases


def test_a_drop_on_the_way_is_a_drop(stage):
    stage.puppet.slips_at_s = stage.puppet.time_s + 2.0
    report = stage.run(ON_COUNTER)
    assert report.failure.code == "object_dropped"


@pytest.mark.parametrize("code", ["no_free_spot", "no_stance"])
def test_the_planners_refusal_is_reported_and_the_object_kept(stage, code):
    stage.planner.failures[PlaceRequest] = [failure(code, "as the planner says")] * 2
    report = stage.run(ON_COUNTER)
    assert report.failure.code == code
    assert stage.puppet.holding


def test_where_one_board_is_full_it_goes_on_another_that_will_do(stage):
    full = failure("no_free_spot", "the table has no free spot 12 cm wide")
    stage.planner.failures[PlaceRequest] = [full]
    wanted = PlaceParams(object_id="cup", place_id="table", or_place_ids=("counter",))
    assert stage.run(wanted).status == "succeeded"
    assert math.dist(stage.puppet.things["cup"].X_WO.p, (2.0, 2.5, TABLE_M + 0.05)) < 0.03
    assert f"planning how to put it on the counter, as {full.cause}" in stage.phases


def test_where_all_that_would_do_are_full_each_says_why(stage):
    reasons = [failure("no_free_spot", "the table is full"), failure("out_of_reach", "too deep")]
    stage.planner.failures[PlaceRequest] = reasons
    wanted = PlaceParams(object_id="cup", place_id="table", or_place_ids=("counter",))
    report = stage.run(wanted)
    assert (report.failure.code, report.failure.cause) == (
        "no_free_spot", "the table is full; too deep",
    )  # fmt: skip
    assert stage.puppet.holding


def test_another_board_is_no_cure_for_a_planner_that_broke(stage):
    stage.planner.failures[PlaceRequest] = [failure("internal", "it broke")]
    wanted = PlaceParams(object_id="cup", place_id="table", or_place_ids=("counter",))
    assert stage.run(wanted).failure.code == "internal"


def test_who_stands_before_the_place_is_walked_up_to(stage):
    stage.planner.failures[PlaceRequest] = [failure("no_stance", "Ann stands there")]
    assert stage.run(ON_COUNTER).status == "succeeded"
    past = [r for r in stage.planner.requests if isinstance(r, PlaceRequest)][1]
    assert past.around.ignored == ("cup", "ann")


def test_an_unknown_place_moves_nothing(stage):
    sent = len(stage.puppet.sent)
    report = stage.run(PlaceParams(object_id="cup", place_id="moon"))
    assert report.failure.code == "unknown_place"
    assert not [c for c in stage.puppet.sent[sent:] if isinstance(c, MoveHand | Grip)]


PHASES = ["planning", "walking", "raising", "stepping up", "reaching", "lowering", "letting go",
          "drawing", "stepping back", "bringing", "checking"]  # fmt: skip


@pytest.mark.parametrize("phase", PHASES)
def test_it_can_be_stopped_in_any_phase_and_stands(stage, phase):
    assert stage.run(ON_COUNTER, until_phase=phase).status == "running"
    stage.puppet.tick()
    stage.skill.step(stage.puppet.time_s)
    report = stage.stop()
    assert report.failure.code == "cancelled"
    assert stage.puppet.mode == "stand"
    assert stage.planner.open == {}
    believed = stage.context.holdings.find("cup") is not None
    assert believed or phase not in ("planning", "walking", "raising", "reaching", "lowering")


def test_a_spot_that_is_taken_by_now_is_given_up_for_another(stage):
    taken = failure("goal_in_collision", "red cup and box overlap by 50 mm")
    arm = stage.planner._arm
    tried = []

    def once(request):
        if isinstance(request.goal, SE3) and not tried:
            tried.append(request)
            return taken
        return arm(request)

    stage.planner._arm = once
    report = stage.run(ON_COUNTER)
    assert report.status == "succeeded", report
    plans = [request for request in stage.planner.requests if isinstance(request, PlaceRequest)]
    assert len(plans) == 2
    assert plans[1].walk_cost_per_m > plans[0].walk_cost_per_m


def come_to_stand(stage: Stage, X_WO: SE3) -> None:
    """A box has come to stand there, and is seen."""
    cup = stage.puppet.world_map.objects[0]
    box = replace(cup, id="box", name="box", category="box", color="yellow")
    stage.puppet.world_map = replace(stage.puppet.world_map, objects=(cup, box))
    stage.puppet.things["box"] = Thing("box", X_WO, seen_s=stage.puppet.time_s)


@pytest.mark.parametrize("off_m", [0.0, 0.06])
def test_what_has_come_to_stand_there_is_not_pressed_on(stage, off_m):
    """The arm's way to above the spot is free all the same."""
    place, plans = stage.planner._place, []

    def elsewhere(request):
        plans.append(place(replace(request, target=SE3((2.0, 2.5 - 0.3 * len(plans), 0.75)))))
        return plans[-1]

    stage.planner._place = elsewhere
    stage.run(ON_COUNTER, until_phase="stepping up")
    come_to_stand(stage, SE3((2.0 + off_m, 2.5, TABLE_M + 0.05)))
    while (report := stage.skill.step(stage.puppet.time_s)).status == "running":
        stage.puppet.tick()
    assert report.status == "succeeded", report
    assert len(plans) == 2
    assert stage.puppet.things["cup"].X_WO.p[1] == pytest.approx(2.2, abs=0.03)


def test_what_has_come_to_stand_there_and_has_no_name_is_seen_before_the_hand_is_over_it(stage):
    place, plans = stage.planner._place, []

    def elsewhere(request):
        plans.append(request)
        return place(replace(request, target=SE3((2.0, 2.5 - 0.3 * (len(plans) - 1), 0.75))))

    stage.planner._place = elsewhere
    stage.run(ON_COUNTER, until_phase="stepping up")
    X_WO, cup = SE3((2.03, 2.5, TABLE_M + 0.05)), stage.puppet.world_map.objects[0]
    unknown = Unnamed(id="unnamed_4", words="blue thing of 10 cm", X_WO=X_WO, shape=cup.shape,
                      seen_s=stage.puppet.time_s)  # fmt: skip
    stage.puppet.unnamed = (unknown,)
    while (report := stage.skill.step(stage.puppet.time_s)).status == "running":
        assert not (len(plans) == 1 and stage.skill.body.phase.startswith("reaching over"))
        stage.puppet.tick()
    assert report.status == "succeeded", report
    assert len(plans) == 2
    assert "unnamed_4" in {thing.id for thing in plans[1].around.objects}
    assert stage.puppet.things["cup"].X_WO.p[1] == pytest.approx(2.2, abs=0.03)


def test_what_was_glimpsed_from_afar_takes_no_room(stage):
    stage.run(ON_COUNTER, until_phase="stepping up")
    cup = stage.puppet.things["cup"]
    glimpsed = Unnamed(
        id="unnamed_4", words="red thing of 10 cm", X_WO=cup.X_WO, seen_s=0.0, near=False,
        shape=stage.puppet.world_map.objects[0].shape,
    )  # fmt: skip
    info = stage.puppet.world_map.objects[0]
    stage.puppet.unnamed = (glimpsed,)
    assert occupant(stage.skill.body, info, cup.X_WO) is None
    stage.puppet.unnamed = (replace(glimpsed, near=True),)
    assert occupant(stage.skill.body, info, cup.X_WO) is not None


def test_what_nobody_saw_and_is_felt_on_the_way_down_is_put_beside(stage):
    place, plans, tick = stage.planner._place, [], stage.puppet.tick

    def elsewhere(request):
        plans.append(request)
        return place(replace(request, target=SE3((2.0, 2.5 - 0.3 * (len(plans) - 1), 0.75))))

    def stands_there():
        stage.puppet.surface_m = TABLE_M + (0.05 if len(plans) == 1 else 0.0)
        tick()

    stage.planner._place = elsewhere
    stage.puppet.tick = stands_there
    report = stage.run(ON_COUNTER)
    assert report.status == "succeeded", report
    (felt,) = (thing for thing in plans[1].around.objects if thing.id == "felt_0")
    assert felt.X_WO.p[:2] == pytest.approx((2.0, 2.5), abs=0.01)
    assert felt.shape.size_m[2] == pytest.approx(0.05, abs=0.015)
    assert stage.puppet.things["cup"].X_WO.p[1] == pytest.approx(2.2, abs=0.03)


def test_what_stands_beside_it_is_no_matter(stage):
    stage.run(ON_COUNTER, until_phase="stepping up")
    come_to_stand(stage, SE3((2.1, 2.5, TABLE_M + 0.05)))
    while (report := stage.skill.step(stage.puppet.time_s)).status == "running":
        stage.puppet.tick()
    assert report.status == "succeeded", report
    plans = [request for request in stage.planner.requests if isinstance(request, PlaceRequest)]
    assert len(plans) == 1


@pytest.mark.parametrize(
    ("height_m", "refused"), [(0.30, True), (0.45, False), (1.15, False), (1.3, True)]
)
def test_a_surface_beyond_what_was_measured_is_refused_with_the_figures(height_m, refused):
    stage = Stage()
    spot = PlaceParams(object_id="cup", X_WO=SE3((2.0, 0.0, height_m)))
    found = PutDown.refusal(spot, stage.puppet.map(), DESCRIPTION)
    assert (found is not None) == refused
    if found is not None:
        assert found.code == "out_of_reach"
        assert "the hands reach 0.35 to 1.22 m" in found.cause
