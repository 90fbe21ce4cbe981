"""Picks and places stand where they can, in the room there is; failures name the cause."""

import itertools
import math
from dataclasses import replace

import msgspec
import numpy as np
import pytest

from robot.failures import Failure
from robot.messages import PersonInfo, Piece, Shape, Side
from robot.planning import handling, trials
from robot.planning import place as place_planning
from robot.planning.checks import Checker
from robot.planning.floor import Floor
from robot.planning.handling_problem import Choice, HandlingProblem
from robot.planning.requests import (
    BodyPosture,
    Held,
    ObjectPose,
    PickPlan,
    PlacePlan,
    Surroundings,
)
from robot.planning.robot_body import Body
from robot.planning.scene import HELD
from robot.planning.solids import solids_of
from robot.planning.solve import Solver
from robot.planning.trials import STRAIN_COST
from robot.se3 import SE3
from tests.fakes.handling_plans import (
    BOARD,
    LYING,
    TABLE,
    check_standing,
    on_a_counter,
    pick,
    place,
    reaches,
)
from tests.fakes.planning_room import (
    BOARDS_M,
    CUP,
    block,
    on_table,
    room,
    surroundings,
)


@pytest.mark.parametrize("turn_rad", [math.pi, 2.6])
def test_a_mug_that_turns_its_handle_to_the_robot_is_taken(solver: Solver, turn_rad: float) -> None:
    """A wall behind it: no hand comes from the other side."""
    handle = Piece(
        kind="box", size_m=(0.03, 0.01, 0.06), X_ShapePiece=SE3((0.055, 0, 0)), is_held=False
    )
    mug = Shape(
        kind="cylinder",
        size_m=(0.08, 0.08, 0.10),
        pieces=(Piece(kind="cylinder", size_m=(0.08, 0.08, 0.10)), handle),
    )
    around = on_a_counter(0.75, 0.15)
    thing = around.objects[0]
    turned = SE3.from_xy_yaw(*thing.X_WO.p[:2], turn_rad, z_m=thing.X_WO.p[2])
    thing = msgspec.structs.replace(thing, shape=mug, X_WO=turned)
    around = msgspec.structs.replace(around, objects=(thing,))
    plan = pick(solver, around)
    assert isinstance(plan, PickPlan), plan


@pytest.mark.parametrize(
    "shape",
    [
        Shape(kind="box", size_m=(0.05, 0.16, 0.03)),
        Shape(kind="cylinder", size_m=(0.06, 0.06, 0.04)),
    ],
)
def test_what_lies_flat_on_the_table(solver: Solver, shape: Shape) -> None:
    on = on_table(-0.1, 0.2).X_WO.p
    z = on[2] - 0.5 * CUP.size_m[2] + 0.5 * shape.size_m[2]
    flat = ObjectPose(id="cup", shape=shape, X_WO=SE3((on[0], on[1], z)))
    plan = pick(solver, surroundings(flat))
    assert isinstance(plan, PickPlan), plan
    assert plan.margin > 0.3


def test_hands_keep_away_from_who_stands_beside(solver: Solver) -> None:
    around = surroundings(on_table(-0.1, 0.0))
    alone = pick(solver, around)
    assert isinstance(alone, PickPlan)
    (x, y, yaw), sign = alone.standoff, 1.0 if alone.side == "left" else -1.0
    ann = PersonInfo(
        id="ann",
        name="Ann",
        X_WO=SE3((x - 0.9 * sign * math.sin(yaw), y + 0.9 * sign * math.cos(yaw), 0.0)),
    )
    beside = msgspec.structs.replace(around, map=msgspec.structs.replace(around.map, people=(ann,)))
    plan = pick(solver, beside)
    assert isinstance(plan, PickPlan)
    x, y, yaw = plan.standoff
    aside = 0.25 if plan.side == "left" else -0.25
    raised = (
        x + 0.3 * math.cos(yaw) - aside * math.sin(yaw),
        y + 0.3 * math.sin(yaw) + aside * math.cos(yaw),
    )
    assert math.dist(raised, ann.X_WO.p[:2]) > ann.radius_m + 0.5


def test_a_stance_is_not_beside_somebody_where_there_is_another(solver: Solver) -> None:
    """Her outline is 0.45 m from where the feet would be, on the side of the hand that hangs."""
    held = Held(id="cup", shape=CUP, X_GO=SE3())
    alone = place(solver, TABLE, surroundings(), held=held, side="left")
    assert isinstance(alone, PlacePlan), alone
    x, y, yaw = alone.stance
    aside = SE3((x + 0.7 * math.sin(yaw), y - 0.7 * math.cos(yaw), 0.0))
    ann = PersonInfo(id="ann", name="Ann", X_WO=aside)
    around = surroundings()
    beside = msgspec.structs.replace(around, map=msgspec.structs.replace(around.map, people=(ann,)))
    plan = place(solver, TABLE, beside, held=held, side="left")
    assert isinstance(plan, PlacePlan), plan
    assert math.dist(plan.stance[:2], ann.X_WO.p[:2]) > ann.radius_m + 0.6


@pytest.mark.parametrize("yaw_rad", [-2.0, 0.0, 1.6])
def test_a_thin_torch_that_lies_on_the_table(solver: Solver, yaw_rad: float) -> None:
    shape = Shape(kind="cylinder", size_m=(0.045, 0.045, 0.16))
    on = on_table(-0.1, 0.2).X_WO.p
    z = on[2] - 0.5 * CUP.size_m[2] + 0.5 * shape.size_m[0]
    X_WO = SE3.from_xy_yaw(on[0], on[1], yaw_rad, z_m=z) @ LYING
    plan = pick(solver, surroundings(ObjectPose(id="cup", shape=shape, X_WO=X_WO)))
    assert isinstance(plan, PickPlan), plan
    assert plan.margin > 0.2


@pytest.mark.parametrize(
    ("yaw_rad", "height_m"),
    [
        (0.0, 1.02),
        pytest.param(0.0, 1.06, marks=pytest.mark.rest),
        pytest.param(0.1, 1.02, marks=pytest.mark.rest),
        (0.1, 1.06),
    ],
)
def test_a_box_that_turns_its_long_side_to_the_edge_is_taken_with_the_hand_along_it(
    solver: Solver, height_m: float, yaw_rad: float
) -> None:
    shape = Shape(kind="box", size_m=(0.06, 0.12, 0.07))
    counter = block("counter", 1.65, -2.0, (0.90, 1.40, height_m))
    X_WO = SE3.from_xy_yaw(1.30, -2.0, yaw_rad, z_m=height_m + 0.035)
    box = ObjectPose(id="cup", shape=shape, X_WO=X_WO)
    plan = pick(solver, Surroundings(map=room(counter), objects=(box,)))
    assert isinstance(plan, PickPlan), plan
    assert plan.opening_m == pytest.approx(0.06)


def test_a_bottle_with_4_cm_above_it_comes_out_from_under_a_board(solver: Solver) -> None:
    board = BOARD[BOARDS_M[1]]
    tall_m = board.clearance_m - 0.04
    shape = Shape(kind="cylinder", size_m=(0.07, 0.07, tall_m))
    at = board.X_WP.apply((0.03, 0.1, 0.5 * tall_m))
    bottle = ObjectPose(id="cup", shape=shape, X_WO=SE3((float(at[0]), float(at[1]), float(at[2]))))
    plan = pick(solver, surroundings(bottle))
    assert isinstance(plan, PickPlan), plan
    assert plan.X_WG_lift.p[2] - plan.X_WG_grasp.p[2] < 0.04


@pytest.mark.parametrize("x", [-0.2, 0.0, 0.2])
@pytest.mark.parametrize("y", [-0.5, 0.0, 0.5])
def test_a_cup_anywhere_on_the_table(solver: Solver, x: float, y: float) -> None:
    around = surroundings(on_table(x, y))
    plan = pick(solver, around, seed=3)
    assert isinstance(plan, PickPlan), plan
    check_standing(solver.body, around, plan)
    X_WO = around.objects[0].X_WO
    assert np.allclose((X_WO @ plan.X_OG).matrix(), plan.X_WG_grasp.matrix(), atol=1e-9)
    assert plan.X_WG_lift.p[2] - plan.X_WG_grasp.p[2] >= 0.04
    behind = plan.X_WG_grasp.inverse().apply(plan.X_WG_pre.p)
    assert behind == pytest.approx([-0.087, 0.0, 0.0], abs=0.03)
    x0, y0, yaw = plan.stance
    for dx, dy, turn in ((0, 0, 0), (0.015, 0.01, 0.02), (-0.015, -0.01, -0.02)):
        for X_WG in (plan.X_WG_pre, plan.X_WG_grasp, plan.X_WG_lift):
            assert reaches(solver.body, plan, X_WG, (x0 + dx, y0 + dy, yaw + turn)) < 2e-3


def test_the_hand_asked_for_is_used(solver: Solver) -> None:
    for side in ("left", "right"):
        plan = pick(solver, surroundings(on_table(0.0, 0.0)), side=side)
        assert isinstance(plan, PickPlan)
        assert plan.side == side


def test_a_table_against_a_wall_is_reached_from_the_other_sides(solver: Solver) -> None:
    far = block("partition", 1.85, 0.8, (0.04, 1.6, 1.5))
    around = surroundings(on_table(-0.05, 0.0), more=(far,))
    plan = pick(solver, around)
    assert isinstance(plan, PickPlan), plan
    assert plan.stance[0] < 1.4
    check_standing(solver.body, around, plan)


def test_a_deep_reach_leans_the_trunk(solver: Solver) -> None:
    """The cup at the far edge, walls on three sides: only over the table."""
    walls = (
        block("east", 1.85, 0.8, (0.04, 1.6, 1.5)),
        block("north", 1.5, 1.45, (0.6, 0.04, 1.5)),
        block("south", 1.5, 0.15, (0.6, 0.04, 1.5)),
    )
    plan = pick(solver, surroundings(on_table(0.12, 0.0), more=walls))
    assert isinstance(plan, PickPlan), plan
    assert plan.posture.pitch_rad > 0.0


@pytest.mark.parametrize("deep", [0.12, 0.16])
def test_on_a_counter_as_high_as_the_elbow_the_elbow_swings_up(solver: Solver, deep: float) -> None:
    counter = block("counter", 1.5, -1.0, (0.60, 1.80, 0.88))
    cup = ObjectPose(id="cup", shape=CUP, X_WO=SE3((1.2 + deep, -1.0, 0.88 + 0.05)))
    around = Surroundings(map=room(counter), objects=(cup,))
    plan = pick(solver, around)
    assert isinstance(plan, PickPlan), plan
    scene = solver.body.scenes.get(solids_of(around))
    standing = solver.body.standing(plan.posture, plan.side)
    q = standing.q.copy()
    q[solver.body.arms[plan.side].motors] = plan.pre_rad
    scene.pose(SE3.from_xy_yaw(*plan.stance) @ standing.X_SB, q)
    scene.set_clearance(0.0)
    scene.update()
    assert not scene.touches(scene.arm_geoms(plan.side))


@pytest.mark.parametrize(
    ("height", "deep"),
    [
        pytest.param(0.74, 0.40, marks=pytest.mark.rest),
        pytest.param(0.90, 0.40, marks=pytest.mark.rest),
        (0.98, 0.30),
        (1.02, 0.25),
    ],
)
def test_deep_on_a_counter_the_arm_comes_over_the_edge(
    solver: Solver, height: float, deep: float
) -> None:
    plan = pick(solver, on_a_counter(height, deep))
    assert isinstance(plan, PickPlan), plan
    check_standing(solver.body, on_a_counter(height, deep), plan)
    if plan.posture.height_m == 0.65:
        assert plan.over is not None


@pytest.mark.parametrize(
    ("height", "deep", "side"),
    [
        (1.10, 0.20, "left"),
        pytest.param(1.10, 0.20, "right", marks=pytest.mark.rest),
        pytest.param(1.15, 0.15, "left", marks=pytest.mark.rest),
        (1.15, 0.15, "right"),
    ],
)
def test_higher_than_the_shoulder_the_arm_goes_up_beside_the_edge(
    solver: Solver, height: float, deep: float, side: Side
) -> None:
    around = on_a_counter(height, deep)
    plan = pick(solver, around, side=side)
    assert isinstance(plan, PickPlan), plan
    check_standing(solver.body, around, plan)
    assert plan.over is not None
    elbow_up_rad = plan.over.at_rad[0]
    assert elbow_up_rad < -1.8
    floor = Floor(solids_of(around), around.map.bounds_m)
    assert floor.clearance_m(*plan.standoff[:2]) >= 0.4


def test_an_arm_that_goes_up_keeps_clear_of_the_head_wherever_it_looks(solver: Solver) -> None:
    body = solver.body
    plan = pick(solver, on_a_counter(1.10, 0.20))
    assert isinstance(plan, PickPlan), plan
    standing, scene = body.standing(BodyPosture()), body.scenes.get(())
    q = standing.q.copy()
    q[body.arms[plan.side].motors] = plan.ready_rad
    scene.set_clearance(0.0)
    head = body.description.indices("head")
    ranges = [(body.model.lower_rad[k], 0.0, body.model.upper_rad[k]) for k in head]
    for look in itertools.product(*ranges):
        q[head] = look
        scene.pose(standing.X_SB, q)
        scene.update()
        assert not scene.touches(scene.arm_geoms(plan.side))


@pytest.mark.parametrize(
    ("earlier", "over", "taken"),
    [(0.3, 0.5, 0.3), (0.0, 0.1, 0.1), (0.0, None, 0.0), (0.0, 0.0, 0.0), (None, 0.2, 0.2)],
)
def test_an_arm_that_has_nothing_left_is_for_where_nothing_else_leads(
    solver: Solver,
    monkeypatch: pytest.MonkeyPatch,
    earlier: float | None,
    over: float | None,
    taken: float,
) -> None:
    """By the margins that each stage of the search finds, of poses at their limits: 0."""
    plan = pick(solver, surroundings(on_table(-0.1, 0.2)))
    assert isinstance(plan, PickPlan)
    found: list[Choice] = []
    passing = handling.passing

    def staged(body, problem, batch, tally, *, last=False):
        if not found:
            good = passing(body, problem, batch, tally, last=last)
            found.append(next(choice for choice in good if choice is not None))
        margin = over if last else earlier
        if margin is not None:
            strain = STRAIN_COST if margin == 0.0 else 0.0
            yield replace(found[0], margin=margin, steadiness=1.0, score=margin - last - strain)

    monkeypatch.setattr(handling, "passing", staged)
    plan = pick(solver, surroundings(on_table(-0.1, 0.2)))
    assert isinstance(plan, PickPlan)
    assert plan.margin == taken


@pytest.mark.parametrize(
    ("height", "deep"), [(0.98, 0.45), pytest.param(1.05, 0.35, marks=pytest.mark.rest)]
)
def test_what_stands_too_deep_is_refused_with_the_figures(
    solver: Solver, height: float, deep: float
) -> None:
    refused = pick(solver, on_a_counter(height, deep))
    assert isinstance(refused, Failure)
    assert refused.code == "out_of_reach"
    assert refused.evidence["from_edge_m"] == pytest.approx(deep)
    assert refused.evidence["deep_m"] < deep
    assert f"{100 * deep:.0f} cm from the edge, {height:.2f} m up" in refused.cause


def test_carrying_is_near_the_body_and_upright(solver: Solver) -> None:
    plan = pick(solver, surroundings(on_table(-0.1, 0.2)))
    assert isinstance(plan, PickPlan)
    arm, standing = solver.body.arms[plan.side], solver.body.standing(plan.posture)
    rotation, position = arm.chain.forward(np.array([plan.carry_rad]))
    X_SG = standing.X_ST[plan.side] @ SE3.from_rotation(rotation[0], position[0])
    assert math.hypot(*X_SG.p[:2]) < 0.45
    up = (X_SG @ plan.X_OG.inverse()).rotation()[2, 2]
    assert up == pytest.approx(1.0, abs=1e-3)


def test_what_is_carried_and_the_arms_stay_inside_the_circle_that_ways_are_planned_for(
    solver: Solver,
) -> None:
    around = surroundings(on_table(-0.1, 0.2))
    plan = pick(solver, around)
    assert isinstance(plan, PickPlan)
    body, X_WS = solver.body, SE3()
    standing = body.standing(BodyPosture())
    held = Held(id="cup", shape=CUP, X_GO=plan.X_OG.inverse())
    scene = body.scenes.get((), (plan.side, held))
    for carried in (False, True):
        q = standing.q.copy()
        if carried:
            q[body.arms[plan.side].motors] = plan.carry_rad
        scene.pose(X_WS @ standing.X_SB, q)
        scene.update()
        for side, arm in body.arms.items():
            geoms = scene.arm_geoms(side)
            if side == plan.side and not carried:
                geoms = geoms & np.array([name != HELD for name in scene.names])
            assert scene.around_m(geoms, X_WS) <= body.description.body_radius_m, arm.side


@pytest.mark.parametrize(("side", "seed"), [("right", 0), ("left", 2), ("left", 4)])
def test_arm_and_body_may_sway_on_the_steps_to_a_shelf(
    solver: Solver, side: Side, seed: int
) -> None:
    around = surroundings()
    plan = place(solver, BOARD[BOARDS_M[0]], around, side=side, seed=seed)
    assert isinstance(plan, PlacePlan)
    body = solver.body
    standing, hand = body.standing(BodyPosture(), side), body.description.hands[side]
    scene = body.scenes.get(solids_of(around))
    scene.set_clearance(0.0)
    hands = {hand.body, *hand.finger_bodies}
    links = np.array([name not in hands for name in scene.names]) & ~scene.solid_geoms
    q = standing.q.copy()
    q[body.arms[side].motors] = plan.ready_rad
    X_WS = SE3.from_xy_yaw(*plan.stance)
    step_m = math.dist(plan.stance[:2], plan.standoff[:2])
    for back_m in (0.0, 0.5 * step_m, step_m):
        for aside_m in (-body.description.walking.sway_m, body.description.walking.sway_m):
            scene.pose(X_WS @ SE3((-back_m, aside_m, 0.0)) @ standing.X_SB, q)
            scene.update()
            assert not scene.touches(links, solids_only=True)


def test_the_same_seed_gives_the_same_plan(solver: Solver) -> None:
    around = surroundings(on_table(0.1, -0.2))
    first = pick(solver, around, seed=4)
    pick(solver, surroundings(on_table(-0.2, 0.4)), seed=5)
    assert pick(solver, around, seed=4) == first
    assert pick(Solver(solver.body.description), around, seed=4) == first


def rooms_m(
    solver: Solver, monkeypatch: pytest.MonkeyPatch, *, cost_per_m: float
) -> dict[str, float]:
    """What the arm keeps from things where a cup is put on a board, and beside one on the table."""
    found: list[float] = []
    search = handling.search

    def noted(body: Body, problem: HandlingProblem, *args, **more) -> Choice | Failure:
        choice = search(body, problem, *args, **more)
        assert isinstance(choice, Choice), choice
        checker = Checker(body, problem)
        checker.prepare(choice.candidate, choice.side, choice.main)
        found.append(checker.room_m(choice.q_back, choice.q_up))
        return choice

    with monkeypatch.context() as patched:
        patched.setattr(trials, "TIGHT_COST_PER_M", cost_per_m)
        patched.setattr(place_planning, "search", noted)
        for on in (TABLE, BOARD[BOARDS_M[0]], BOARD[BOARDS_M[1]]):
            assert isinstance(place(solver, on, surroundings()), PlacePlan)
    return dict(zip(("table", "lower board", "upper board"), found, strict=True))


def test_where_there_is_a_choice_the_arm_has_the_more_room(
    solver: Solver, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A hand 12 mm past the edge of a board came 1 cm lower, stuck, and the robot fell."""
    liked = rooms_m(solver, monkeypatch, cost_per_m=trials.TIGHT_COST_PER_M)
    any_way = rooms_m(solver, monkeypatch, cost_per_m=0.0)
    assert all(liked[on] >= any_way[on] for on in liked), (liked, any_way)
    assert sum(liked.values()) > sum(any_way.values()), (liked, any_way)
