"""Plans for picking up: grasp, stance, posture, and how to carry the thing away."""

from __future__ import annotations

import numpy as np

from robot.failures import Failure, failure
from robot.messages import Side
from robot.planning import reach
from robot.planning.floor import Floor
from robot.planning.grasps import pick_options
from robot.planning.handling import search
from robot.planning.handling_problem import Choice, HandlingProblem
from robot.planning.reach import Targets, Trunks
from robot.planning.requests import Held, Joints, ObjectPose, PickPlan, PickRequest, pitched_rad
from robot.planning.robot_body import UPRIGHT, Body
from robot.planning.solids import Solid, people_of, solid, solids_of
from robot.planning.stances import posture_of
from robot.se3 import SE3, Array

LIFTS_M = (0.10, 0.06, 0.04, 0.025)  # the least for what stands tall under a board
CARRY_CLEARANCE_M = 0.02
TUCK_STEPS = 4
"""How far the elbow swings in: a carried mug then is within 0.26 m, where it was 0.32."""


def plan_pick(body: Body, request: PickRequest) -> PickPlan | Failure:
    """How to pick up an object, or why it cannot be."""
    around = request.around
    thing = next((thing for thing in around.objects if thing.id == request.object_id), None)
    if thing is None:
        return failure(
            "object_not_seen", f"it is not known where {request.object_id} is", id=request.object_id
        )
    others = tuple(s for s in solids_of(around) if s.id != thing.id)
    floor = Floor(others, around.map.bounds_m)
    hands = body.description.hands
    sides: tuple[Side, ...] = (request.side,) if request.side else tuple(sorted(hands))
    robot = body.description
    options = pick_options(
        thing.shape, thing.X_WO, hand=robot.hands[sides[0]], gripping=robot.handy.gripping
    )
    if isinstance(options, Failure):
        return options
    options = [option for option in options if pitched_rad(option.R0) <= request.most_tilt_rad]
    if not options:
        text = "no grasp of it is as level as it is wanted"
        return failure("no_grasp", text, most_tilt_rad=request.most_tilt_rad)
    names = {info.id: info.name for info in around.map.objects}
    problem = HandlingProblem(
        kind="pick",
        object_id=thing.id,
        shape=thing.shape,
        options=options,
        references=np.array([thing.X_WO.p]),
        reference_cost=np.zeros(1),
        others=others,
        lifts_m=LIFTS_M,
        walk_cost_per_m=request.walk_cost_per_m,
        people=people_of(request.around),
        what="the " + names.get(thing.id, thing.id),
        below_m=thing.X_WO.p[2] - solid(thing.id, thing.X_WO, thing.shape).z_range_m()[0],
    )
    choice = search(body, problem, floor, sides=sides, start=request.start, seed=request.seed)
    if isinstance(choice, Failure):
        return choice
    carry = carry_posture(body, choice, thing, others)
    if carry is None:
        return failure(
            "goal_in_collision",
            f"{problem.what} cannot be held upright near the body with this grasp",
            blocked_by="the body",
        )
    return _plan(body, choice, thing, carry)


def _plan(body: Body, choice: Choice, thing: ObjectPose, carry: Joints) -> PickPlan:
    X_WG = choice.main.pose(0)
    lean = body.description.handy.reaching.leans[int(choice.candidate.lean[0])]
    return PickPlan(
        side=choice.side,
        standoff=choice.candidate.standoff_of(0),
        stance=choice.candidate.stance_of(0),
        posture=posture_of(lean, choice.side),
        ready_rad=_joints(choice.q_ready),
        X_OG=thing.X_WO.inverse() @ X_WG,
        X_WG_pre=choice.back.pose(0),
        X_WG_grasp=X_WG,
        X_WG_lift=choice.up.pose(0),
        pre_rad=_joints(choice.q_back),
        carry_rad=carry,
        opening_m=choice.option.opening_m,
        margin=choice.margin,
        over=choice.over(body),
    )


def carry_posture(
    body: Body, choice: Choice, thing: ObjectPose, others: tuple[Solid, ...]
) -> Joints | None:
    """Joints that hold the object as upright as it stood, near the body and clear of it.

    They are free at the standoff, where the arm is brought to them, and if possible stick out of
    the circle that ways are planned for nowhere: it goes through doorways, and turns, like that.
    That takes the elbow close to the body.
    """
    side, arm = choice.side, body.arms[choice.side]
    sign = 1.0 if side == "left" else -1.0
    standing, carrying = body.standing(UPRIGHT), body.description.handy.reaching.carrying
    grid = np.array(
        [
            (x, sign * y, z, -sign * turn)
            for x in carrying.ahead_m
            for y in carrying.aside_m
            for z in carrying.up_m
            for turn in carrying.turns_rad
        ]
    )
    n = len(grid)
    stance, X_ST = np.zeros((n, 3)), standing.X_ST[side]
    trunks = Trunks(stance, np.tile(X_ST.rotation(), (n, 1, 1)), np.tile(X_ST.p, (n, 1)))
    at = grid[:, :3] + np.array(standing.X_SB.p)
    targets = Targets(reach.rotations_z(grid[:, 3]) @ choice.option.R0, at)
    reached = reach.first_reach(body, arm, trunks, targets)
    relaxed = arm.chain.relax(reached.q)
    inwards = np.tile(X_ST.rotation().T @ np.array([0.0, -sign, -0.5]), (n, 1))
    q_arm = np.concatenate([arm.chain.swing(relaxed, inwards, steps=TUCK_STEPS), relaxed])
    ahead_m, aside_m = carrying.best_m
    off_m = np.hypot(grid[:, 0] - ahead_m, grid[:, 1] - sign * aside_m)
    liked = reach.margins(arm, q_arm) - 0.8 * np.tile(off_m, 2)
    held = Held(id=thing.id, shape=thing.shape, X_GO=choice.option.X_GO)
    scene = body.scenes.get(others, (side, held))
    scene.set_clearance(CARRY_CLEARANCE_M, held_m=CARRY_CLEARANCE_M)
    X_WS = SE3.from_xy_yaw(*choice.candidate.standoff_of(0))
    hand = body.description.hands[side]
    q = standing.q.copy()
    q[body.motor(hand.motor)] = choice.option.opening_m / hand.opening_per_motor
    narrowest: tuple[float, Joints] | None = None
    for i in np.argsort(-liked, kind="stable").tolist():
        if not reached.ok[i % n]:
            continue
        q[arm.motors] = q_arm[i]
        scene.pose(X_WS @ standing.X_SB, q)
        scene.update()
        if scene.touches(scene.arm_geoms(side)):
            continue
        radius_m = scene.around_m(scene.arm_geoms(side), X_WS)
        if radius_m <= body.description.body_radius_m:
            return _joints(q_arm[i])
        if narrowest is None or radius_m < narrowest[0]:
            narrowest = (radius_m, _joints(q_arm[i]))
    return narrowest[1] if narrowest else None


def _joints(q: Array) -> Joints:
    return tuple(q.tolist())
