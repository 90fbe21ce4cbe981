"""Arm motions: inverse kinematics for the goal, RRT-Connect against MuJoCo's collision, timing."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from robot.failures import Failure, failure
from robot.planning import numerics, sampling
from robot.planning.requests import ArmPlan, ArmRequest
from robot.planning.robot_body import Arm, Body
from robot.planning.scene import HELD, Scene, Touch
from robot.planning.solids import solids_of
from robot.planning.timing import Timed, rounded, time_path
from robot.se3 import SE3, Array

CLEARANCE_M = 0.012  # with less the fingers topple what they pass by
SPLINE_CLEARANCE_M = 0.008
"""The spline may stray from the path by the difference [m]."""
GOAL_CLEARANCE_M = 0.003
OVERLAP_M = 0.003
"""Start poses may overlap by this much: the world is not known better."""
RESOLUTION_RAD = 0.02  # 0.05 let collisions through
CUTS_RAD = (0.30, 0.12, 0.03)
CHECKS = 12_000  # instead of a time, so that a seed gives the same plan on any machine
ATTEMPTS = 3  # the spline of one path in six leaves what was checked
TILT_RAD = 0.35
LINE_M = 0.03
SEEDS = 24
GOALS = 3


@dataclass(slots=True)
class Corridor:
    """Whether an arm's joint values are free; remembers what was in the way."""

    scene: Scene
    arm: Arm
    allowed: frozenset[str]
    slack: dict[tuple[str, str], float] = field(default_factory=dict)
    ups: list[Array] = field(default_factory=list)
    blocked: Counter[str] = field(default_factory=Counter)

    def touches(self, q: Array | list[float]) -> list[Touch]:
        """What the arm is too near to."""
        self.scene.set_motors(self.arm.motors, q)
        self.scene.update()
        return self.scene.touches(
            self.scene.arm_geoms(self.arm.side), allowed=self.allowed, slack=self.slack
        )

    def free(self, q: Array | list[float]) -> bool:
        """Whether it is near nothing, and upright if it must be."""
        touches = self.touches(q)
        if touches:
            self.blocked[touches[0].second] += 1
            return False
        return not self.ups or self._upright()

    def _upright(self) -> bool:
        up = self.scene.grasp_rotation(self.arm.side)[6:9]
        if max(float(up @ wanted) for wanted in self.ups) >= math.cos(TILT_RAD):
            return True
        self.blocked["keeping it upright"] += 1
        return False

    def keep_upright(self, q: Array) -> None:
        """From now on the hand's tilt must be about that at `q` (or at others so given)."""
        self.scene.set_motors(self.arm.motors, q)
        self.scene.update()
        self.ups.append(self.scene.grasp_rotation(self.arm.side)[6:9].copy())

    def line_free(self, a: Array, b: Array) -> bool:
        """Whether the straight line between two free states is free."""
        count = max(2, math.ceil(float(np.linalg.norm(b - a)) / RESOLUTION_RAD))
        # Coarse steps first, then those between: what is in the way is met soonest.
        order = sorted(range(1, count), key=lambda i: i & -i, reverse=True)
        return self.free(b) and all(self.free(a + (b - a) * (i / count)) for i in order)

    def all_free(self, path: Array) -> bool:
        """Whether every state of a dense path is free."""
        return all(self.free(q) for q in path)


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
    scene.set_clearance(CLEARANCE_M)
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
    timed = _find(body, corridor, request, start, goals)
    if isinstance(timed, Failure):
        return timed
    return ArmPlan(
        side=request.side,
        times_s=tuple(float(t) for t in timed.times_s),
        positions_rad=tuple(tuple(float(v) for v in q) for q in timed.positions_rad),
        duration_s=float(timed.times_s[-1]),
    )


def _admit(
    corridor: Corridor, q: Array, request: ArmRequest, *, code: str, least_m: float
) -> Failure | None:
    """Let pairs stay as near as they are at `q`, or say what overlaps there."""
    for touch in sorted(corridor.touches(q), key=lambda touch: touch.distance_m):
        if touch.distance_m < least_m:
            return _in_collision(touch, request, code)
        pair = (touch.first, touch.second)
        limit = touch.distance_m - 0.001
        corridor.slack[pair] = min(corridor.slack.get(pair, np.inf), limit)
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
    body: Body, corridor: Corridor, request: ArmRequest, start: Array, goals: list[Array]
) -> Timed | Failure:
    """The first motion whose spline is free, straight if possible."""
    checks = 0
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
                checks=CHECKS,
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
    corridor.scene.set_clearance(SPLINE_CLEARANCE_M)
    free = corridor.all_free(dense)
    corridor.scene.set_clearance(CLEARANCE_M)
    return timed if free else None


def _limits(body: Body, arm: Arm, speed: float) -> tuple[Array, Array]:
    """Velocities [rad/s] and accelerations [rad/s2], shape (n,)."""
    top, arms = body.model.velocity_limit_rad_s[arm.motors], body.description.arms
    most = np.full(len(top), speed**2 * arms.acceleration_rad_s2)
    return speed * np.minimum(arms.speed_rad_s, 0.8 * top), most
