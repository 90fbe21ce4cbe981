"""Arm motions: inverse kinematics for the goal, RRT-Connect against MuJoCo's collision, timing."""

from __future__ import annotations

import math

import numpy as np

from robot.failures import Failure, failure
from robot.messages import Side
from robot.planning import numerics, sampling
from robot.planning.corridor import RESOLUTION_RAD, RUNGS, Corridor
from robot.planning.requests import ArmPlan, ArmRequest
from robot.planning.robot_body import Arm, Body
from robot.planning.scene import HELD, Touch
from robot.planning.solids import solids_of
from robot.planning.timing import Timed, rounded, time_path
from robot.se3 import SE3, Array

GOAL_CLEARANCE_M = 0.003
OVERLAP_M = 0.003
"""Start poses may overlap by this much: the world is not known better."""
CUTS_RAD = (0.30, 0.12, 0.03)
ATTEMPTS = 3  # the spline of one path in six leaves what was checked
LINE_M = 0.03
SEEDS = 24
GOALS = 3


def plan_arm(body: Body, request: ArmRequest) -> ArmPlan | Failure:
    """A timed motion from where the arm is to the goal, or why there is none."""
    arm = body.arms[request.side]
    if len(request.q_start_rad) != body.model.count:
        raise ValueError(f"q_start_rad has {len(request.q_start_rad)} values")
    held = (request.side, request.held) if request.held else None
    skip = {request.held.id} if request.held else set[str]()
    solids = tuple(s for s in solids_of(request.around) if s.id not in skip)
    scene = body.scenes.get(solids, held)
    scene.pose(request.X_WB, request.q_start_rad)
    corridor = Corridor(scene, arm, frozenset(request.allowed))
    start = np.array(request.q_start_rad)[arm.motors]
    start = np.clip(start, arm.lower, arm.upper)
    problem = _admit(corridor, start, request, code="start_in_collision", least_m=-OVERLAP_M)
    if problem is not None:
        return problem
    goals = _goals(body, corridor, request, start)
    if isinstance(goals, Failure):
        return goals
    if request.keep_upright:
        corridor.keep_upright(start)
        corridor.keep_upright(goals[0])
    timed: Timed | Failure | None = None
    for rung in RUNGS:
        wide = corridor.wider(rung.clearance_m, [start, goals[0]])
        ends = [goals[0], *(q for q in goals[1:] if not wide.touches(q))]
        timed = _find(body, wide, request, (start, ends), most_checks=rung.checks)
        if isinstance(timed, Timed):
            return _plan(timed, request.side, rung.clearance_m)
    assert timed is not None
    return timed


def _plan(timed: Timed, side: Side, clearance_m: float) -> ArmPlan:
    return ArmPlan(
        side=side,
        times_s=tuple(float(t) for t in timed.times_s),
        positions_rad=tuple(tuple(float(v) for v in q) for q in timed.positions_rad),
        duration_s=float(timed.times_s[-1]),
        clearance_m=clearance_m,
    )


def _admit(
    corridor: Corridor, q: Array, request: ArmRequest, *, code: str, least_m: float
) -> Failure | None:
    """Let pairs stay as near as they are at `q`, or say what overlaps there."""
    for touch in sorted(corridor.touches(q), key=lambda touch: touch.distance_m):
        if touch.distance_m < least_m:
            return _in_collision(touch, request, code)
        corridor.admit([touch])
    return None


def _in_collision(touch: Touch, request: ArmRequest, code: str) -> Failure:
    first = _thing(touch.first, request)
    second = _thing(touch.second, request)
    where = "where the arm is now" if code == "start_in_collision" else "where the arm should go"
    return failure(
        code,
        f"{where}, {first} and {second} overlap by {-1000 * touch.distance_m:.0f} mm",
        first=first,
        blocked_by=second,
        overlap_m=-touch.distance_m,
    )


def _thing(name: str, request: ArmRequest) -> str:
    return request.held.id if name == HELD and request.held else name


def _goals(
    body: Body, corridor: Corridor, request: ArmRequest, start: Array
) -> list[Array] | Failure:
    """Free joint values at the goal, the nearest first; slack is given where it is tight there."""
    arm = corridor.arm
    if isinstance(request.goal, SE3):
        X_WT = corridor.scene.body_pose(arm.chain.body)
        found = _solve(body, arm, request, X_WT, start)
        if isinstance(found, Failure):
            return found
    else:
        found = [np.array(request.goal)]
        if (
            len(found[0]) != len(start)
            or np.any(found[0] < arm.lower - 0.01)
            or np.any(found[0] > arm.upper + 0.01)
        ):
            return failure(
                "invalid_goal", "the joint values asked for are outside the arm's limits"
            )
        found = [np.clip(found[0], arm.lower, arm.upper)]
    free = [q for q in found if not corridor.touches(q)]
    if free:
        return free[:GOALS]
    problem: Failure | None = None
    for q in found:
        problem = _admit(corridor, q, request, code="goal_in_collision", least_m=GOAL_CLEARANCE_M)
        if problem is None:
            return [q]
    assert problem is not None
    return problem


def _solve(
    body: Body, arm: Arm, request: ArmRequest, X_WT: SE3, start: Array
) -> list[Array] | Failure:
    """Joint values for the goal's pose, nearest to `near_rad` or the start first; T: arm's root."""
    X_WG = request.goal
    assert isinstance(X_WG, SE3)
    near = np.array(request.near_rad) if request.near_rad is not None else start
    postures = [
        np.array(body.description.posture(name))[arm.motors]
        for name in ("nominal", "carry")
        if name in body.description.postures
    ]
    rng = np.random.default_rng(request.seed)
    share = rng.uniform(0.1, 0.9, (SEEDS, len(start)))
    seeds = np.stack([near, start, *postures, *(arm.lower + share * (arm.upper - arm.lower))])
    count = len(seeds)
    X_TG = X_WT.inverse() @ X_WG
    solved = arm.chain.solve(
        np.tile(X_TG.rotation(), (count, 1, 1)), np.tile(X_TG.p, (count, 1)), seeds, iterations=40
    )
    ok = np.flatnonzero(solved.ok())
    if not len(ok):
        short = float(np.min(solved.position_error_m))
        twist = float(np.min(solved.rotation_error_rad[solved.position_error_m <= short + 1e-3]))
        return failure(
            "out_of_reach",
            f"the {request.side} hand stays {100 * short:.1f} cm and "
            f"{math.degrees(twist):.0f} degrees short of the pose",
            short_m=short,
            short_rad=twist,
            height_m=X_WG.p[2],
        )
    values = solved.q[ok]
    order = np.argsort(np.linalg.norm(values - near, axis=1), kind="stable")
    result: list[Array] = []
    for q in values[order]:
        if all(np.max(np.abs(q - other)) > 0.05 for other in result):
            result.append(q)
    return result


def _find(
    body: Body,
    corridor: Corridor,
    request: ArmRequest,
    ends: tuple[Array, list[Array]],
    *,
    most_checks: int,
) -> Timed | Failure:
    """The first motion from start to a goal whose spline is free, straight if possible."""
    (start, goals), checks = ends, 0
    velocity, acceleration = _limits(body, corridor.arm, request.speed)
    for attempt in range(ATTEMPTS):
        corners = _straight(corridor, start, goals[0]) if attempt == 0 else None
        if corners is None:
            found = sampling.connect(
                start,
                goals,
                lower=corridor.arm.lower,
                upper=corridor.arm.upper,
                valid=corridor.free,
                resolution=RESOLUTION_RAD,
                seed=request.seed * ATTEMPTS + attempt,
                checks=most_checks,
            )
            corners, checks = found.corners, checks + found.checks
        if corners is None:
            break
        timed = _timed(corridor, corners, velocity, acceleration)
        if timed is not None:
            return timed
    name, _ = (corridor.blocked.most_common(1) or [("nothing", 0)])[0]
    blocker = _thing(name, request)
    return failure(
        "planner_timeout",
        f"no free way for the {request.side} arm in {checks} checks; {blocker} is in the way",
        blocked_by=blocker,
        checks=float(checks),
    )


def _straight(corridor: Corridor, start: Array, goal: Array) -> Array | None:
    """A straight line of the joints, or of the hand, if it is free."""
    if corridor.line_free(start, goal):
        return np.stack([start, goal])
    chain = corridor.arm.chain
    (R0, R1), (p0, p1) = chain.forward(np.stack([start, goal]))
    turn = numerics.turn_between(R0, R1)
    count = max(3, math.ceil(float(np.linalg.norm(p1 - p0)) / LINE_M))
    path = [start]
    for share in (step / count for step in range(1, count + 1)):
        R = numerics.turned(R0, share * turn)
        near = path[-1] + (goal - path[-1]) * 0.2
        solved = chain.solve(R[None], ((1 - share) * p0 + share * p1)[None], near[None])
        if not solved.ok()[0] or not corridor.line_free(path[-1], solved.q[0]):
            return None
        path.append(solved.q[0])
    if not corridor.line_free(path[-1], goal):
        return None
    return np.stack([*path, goal])


def _timed(
    corridor: Corridor, corners: Array, velocity: Array, acceleration: Array
) -> Timed | None:
    """The path with its corners cut as far as is free, timed; None if its spline is not free."""
    cuts = np.zeros(len(corners))
    for i in range(1, len(corners) - 1):
        for cut in CUTS_RAD:
            single = np.zeros(3)
            single[1] = cut
            around = rounded(corners[i - 1 : i + 2], single)
            cuts[i] = cut
            if corridor.all_free(around):
                break
    timed = time_path(rounded(corners, cuts), velocity=velocity, acceleration=acceleration)
    positions = np.clip(timed.positions_rad, corridor.arm.lower, corridor.arm.upper)
    timed = Timed(timed.times_s, positions)
    dense = timed.sampled(3 * len(timed.times_s))
    dense = np.clip(dense, corridor.arm.lower, corridor.arm.upper)
    return timed if corridor.spline_free(dense) else None


def _limits(body: Body, arm: Arm, speed: float) -> tuple[Array, Array]:
    """Velocities [rad/s] and accelerations [rad/s2], shape (n,)."""
    top, arms = body.model.velocity_limit_rad_s[arm.motors], body.description.arms
    most = np.full(len(top), speed**2 * arms.acceleration_rad_s2)
    return speed * np.minimum(arms.speed_rad_s, 0.8 * top), most
