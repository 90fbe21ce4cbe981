"""Whether plans can be carried out: chains of plans for random picks and places in a world.

No physics: every pose of a pick (or a place) is checked by inverse kinematics and collision, from
the stance as planned and from stances that are off by as much as walking leaves them.

    python -m benchmarks.planning --world kitchen --picks 100 --places 20
"""

from __future__ import annotations

import math
import time
from collections import Counter, defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from robot.failures import Failure
from robot.messages import ObjectInfo, Place, Side, WorldMap
from robot.model import description
from robot.planning import scene
from robot.planning.requests import (
    ArmPlan,
    ArmRequest,
    BasePathRequest,
    BodyPosture,
    Held,
    Joints,
    ObjectPose,
    PickPlan,
    PickRequest,
    PlacePlan,
    PlaceRequest,
    PlanRequest,
    PlanResult,
    Stance,
    Surroundings,
)
from robot.planning.robot_body import UPRIGHT, Body, Standing
from robot.planning.scene import Scene, Touch
from robot.planning.solve import Solver
from robot.se3 import SE3
from sim.simulation import Simulation

STANCE_ERROR_M, STANCE_ERROR_RAD = 0.015, 0.026
OBJECT_ERROR_M = 0.005
EDGE_M = 0.03
APART_M = 0.14
LINE_STEPS = 6
app = typer.Typer(add_completion=False)


class Broken(Exception):
    """A chain that did not hold, at a named step."""


class Counted(Scene):
    """A scene that counts how often any is asked what touches what."""

    checks = 0

    def touches(self, *args: Any, **kwargs: Any) -> list[Touch]:
        """Count, and answer."""
        Counted.checks += 1
        return super().touches(*args, **kwargs)


@dataclass
class Study:
    """Times of requests, and where chains broke."""

    solver: Solver
    map: WorldMap
    rng: np.random.Generator
    seconds: dict[str, list[float]] = field(default_factory=lambda: defaultdict(list))
    checks: dict[str, list[int]] = field(default_factory=lambda: defaultdict(list))
    moving_s: list[float] = field(default_factory=list)
    clear: Counter[str] = field(default_factory=Counter)
    done: Counter[str] = field(default_factory=Counter)
    tried: Counter[str] = field(default_factory=Counter)
    broken: Counter[str] = field(default_factory=Counter)

    def ask(self, name: str, request: PlanRequest) -> PlanResult:
        """Plan, and keep the (process) time; raises Broken on a failure."""
        begin, before = time.process_time(), Counted.checks
        answer = self.solver.solve(request)
        self.seconds[name].append(time.process_time() - begin)
        self.checks[name].append(Counted.checks - before)
        if isinstance(answer, ArmPlan):
            self.moving_s.append(answer.duration_s)
            self.clear[f"{100 * answer.clearance_m:.1f} cm: {name}"] += 1
        if isinstance(answer, Failure):
            raise Broken(f"{name}: {answer.code}: {answer.cause}")
        return answer

    def off(self, stance: Stance) -> Stance:
        """Where the robot really stops for a stance."""
        dx, dy = self.rng.uniform(-STANCE_ERROR_M, STANCE_ERROR_M, 2).tolist()
        turn = float(self.rng.uniform(-STANCE_ERROR_RAD, STANCE_ERROR_RAD))
        return (stance[0] + dx, stance[1] + dy, stance[2] + turn)


@dataclass
class Robot:
    """Where the robot stands and how its arms are."""

    body: Body
    stance: Stance
    posture: BodyPosture = UPRIGHT
    arms: dict[Side, Joints] = field(default_factory=dict)
    openings: dict[Side, float] = field(default_factory=dict)

    def q_rad(self) -> Joints:
        """All motors."""
        return tuple(self._standing().q.tolist())

    def _standing(self) -> Standing:
        q = self.body.nominal.copy()
        for side, joints in self.arms.items():
            q[self.body.arms[side].motors] = joints
        for side, opening in self.openings.items():
            hand = self.body.description.hands[side]
            q[self.body.motor(hand.motor)] = opening / hand.opening_per_motor
        return self.body.stand(self.posture, q)

    def X_WB(self) -> SE3:
        """The base."""
        return SE3.from_xy_yaw(*self.stance) @ self._standing().X_SB

    def line(self, side: Side, X_WG: SE3) -> None:
        """Move a hand on a straight line, as far as inverse kinematics follows; raises Broken."""
        arm = self.body.arms[side]
        X_WT = SE3.from_xy_yaw(*self.stance) @ self._standing().X_ST[side]
        q = np.array([self.arms[side]])
        _, position = arm.chain.forward(q)
        goal = X_WT.inverse() @ X_WG
        for share in np.linspace(0.0, 1.0, LINE_STEPS + 1)[1:].tolist():
            at = (1 - share) * position + share * np.array(goal.p)
            solved = arm.chain.solve(goal.rotation()[None], at, q, iterations=30)
            if not solved.ok(2e-3, 0.01)[0]:
                raise Broken(f"line: {1000 * solved.position_error_m[0]:.0f} mm short")
            if np.max(np.abs(solved.q - q)) > 0.6:
                raise Broken("line: the arm flips")
            q = solved.q
        self.arms[side] = tuple(q[0].tolist())


def move(
    study: Study,
    name: str,
    robot: Robot,
    *,
    side: Side,
    goal: SE3 | Joints,
    around: Surroundings,
    held: Held | None = None,
    near: Joints | None = None,
) -> None:
    """Plan an arm motion and be at its end."""
    plan = study.ask(
        name,
        ArmRequest(
            side=side,
            q_start_rad=robot.q_rad(),
            X_WB=robot.X_WB(),
            goal=goal,
            around=around,
            held=held,
            keep_upright=held is not None,
            near_rad=near,
            seed=len(study.seconds[name]),
        ),
    )
    assert isinstance(plan, ArmPlan)
    robot.arms[side] = plan.positions_rad[-1]


def pick(study: Study, robot: Robot, thing: ObjectPose, others: tuple[ObjectPose, ...]) -> PickPlan:
    """A whole pick; the robot ends at the standoff, the thing held upright."""
    around = Surroundings(map=study.map, objects=(thing, *others))
    without = Surroundings(map=study.map, objects=others)
    seed = len(study.seconds["pick"])
    plan = study.ask(
        "pick", PickRequest(object_id=thing.id, around=around, start=robot.stance, seed=seed)
    )
    assert isinstance(plan, PickPlan)
    study.ask("path", BasePathRequest(start=robot.stance, goal=plan.standoff, around=around))
    side = plan.side
    robot.stance = study.off(plan.standoff)
    robot.openings[side] = 0.1
    move(study, "ready", robot, side=side, goal=plan.ready_rad, around=around)
    robot.stance, robot.posture = study.off(plan.stance), plan.posture
    jitter = study.rng.uniform(-OBJECT_ERROR_M, OBJECT_ERROR_M, 2).tolist()
    seen = SE3((thing.X_WO.p[0] + jitter[0], thing.X_WO.p[1] + jitter[1], thing.X_WO.p[2]))
    X_OW = seen @ SE3(quat_wxyz=thing.X_WO.quat_wxyz) @ thing.X_WO.inverse()
    X_WG_pre = X_OW @ plan.X_WG_pre
    move(study, "pre-grasp", robot, side=side, goal=X_WG_pre, around=around, near=plan.pre_rad)
    robot.line(side, X_OW @ plan.X_WG_grasp)
    robot.openings[side] = plan.opening_m
    robot.line(side, X_OW @ plan.X_WG_lift)
    robot.stance, robot.posture = study.off(plan.standoff), UPRIGHT
    held = Held(id=thing.id, shape=thing.shape, X_GO=plan.X_OG.inverse())
    move(study, "carry", robot, side=side, goal=plan.carry_rad, around=without, held=held)
    return plan


def place(
    study: Study,
    robot: Robot,
    on: Place,
    *,
    held: Held,
    side: Side,
    others: tuple[ObjectPose, ...] = (),
) -> None:
    """A whole place; the robot ends at the standoff with its arm in the posture it stands in."""
    around = Surroundings(map=study.map, objects=others)
    seed = len(study.seconds["place"])
    request = PlaceRequest(
        place=on, side=side, held=held, around=around, start=robot.stance, seed=seed
    )
    plan = study.ask("place", request)
    assert isinstance(plan, PlacePlan)
    study.ask("path", BasePathRequest(start=robot.stance, goal=plan.standoff, around=around))
    robot.stance = study.off(plan.standoff)
    move(study, "ready", robot, side=side, goal=plan.ready_rad, around=around, held=held)
    robot.stance, robot.posture = study.off(plan.stance), plan.posture
    X_WG_pre, near = plan.X_WG_pre, plan.pre_rad
    move(study, "pre-place", robot, side=side, goal=X_WG_pre, around=around, held=held, near=near)
    robot.line(side, plan.X_WG_release)
    robot.openings[side] = 0.1
    robot.line(side, plan.X_WG_retreat)
    robot.stance, robot.posture = study.off(plan.standoff), UPRIGHT
    put = ObjectPose(id=held.id, shape=held.shape, X_WO=plan.X_WO)
    home = study.solver.body.nominal[study.solver.body.arms[side].motors]
    move(
        study,
        "home",
        robot,
        side=side,
        goal=tuple(home.tolist()),
        around=Surroundings(map=study.map, objects=(*others, put)),
    )


def attempt(study: Study, name: str, chain: Callable[[], object]) -> bool:
    """Run a chain; keep whether it held, or where it broke."""
    study.tried[name] += 1
    try:
        chain()
    except Broken as end:
        study.broken[f"{name}: {end}"] += 1
        return False
    study.done[name] += 1
    return True


def somewhere(study: Study, info: ObjectInfo, on: Place) -> ObjectPose:
    """The object anywhere on a place, as far as its edge allows."""
    half = [0.5 * size - 0.5 * info.shape.size_m[0] - EDGE_M for size in on.size_m]
    x, y = (float(study.rng.uniform(-h, h)) for h in half)
    z = 0.5 * info.shape.size_m[2] - info.shape.X_BodyShape.p[2]
    yaw = float(study.rng.uniform(-math.pi, math.pi))
    X_WO = on.X_WP @ SE3.from_xy_yaw(x, y, yaw, z_m=z)
    return ObjectPose(id=info.id, shape=info.shape, X_WO=X_WO)


def beside(study: Study, thing: ObjectPose, on: Place) -> ObjectPose:
    """Another object on the same place, `APART_M` from the thing at least (middle to middle)."""
    others = [info for info in study.map.objects if info.id != thing.id]
    info = others[int(study.rng.integers(len(others)))]
    while True:
        other = somewhere(study, info, on)
        if math.dist(other.X_WO.p[:2], thing.X_WO.p[:2]) >= APART_M:
            return other


def start_stance(map: WorldMap) -> Stance:
    """Where the robot begins."""
    return (map.start_X_WS.p[0], map.start_X_WS.p[1], map.start_X_WS.yaw_rad)


@app.command()
def main(
    *,
    world: Annotated[str, typer.Option(help="a world")] = "kitchen",
    picks: Annotated[int, typer.Option(help="random poses of each object on the table")] = 100,
    places: Annotated[int, typer.Option(help="runs on each surface")] = 20,
    on: Annotated[str, typer.Option(help="where objects are picked from")] = "table",
    clutter: Annotated[int, typer.Option(help="other things on the surface")] = 1,
    object_id: Annotated[str, typer.Option(help="only this object")] = "",
    seed: Annotated[int, typer.Option()] = 0,
) -> None:
    """Study how many picks and places have a whole chain of plans."""
    scene.Scene = Counted
    solver = Solver(description.load())
    study = Study(solver, Simulation().world(world).map, np.random.default_rng(seed))
    surfaces = [place for place in study.map.places if not place.floor]
    source = next(place for place in surfaces if place.id == on)
    for info in study.map.objects:
        if object_id not in ("", info.id):
            continue
        held_by: list[PickPlan] = []
        for _ in range(picks):
            robot = Robot(solver.body, start_stance(study.map))
            thing = somewhere(study, info, source)
            others = tuple(beside(study, thing, source) for _ in range(clutter))
            attempt(
                study,
                f"pick {info.id} from {on}",
                lambda robot=robot, thing=thing, others=others, kept=held_by: kept.append(
                    pick(study, robot, thing, others)
                ),
            )
        for target in surfaces if held_by else ():
            for k in range(places):
                plan = held_by[k % len(held_by)]
                held = Held(id=info.id, shape=info.shape, X_GO=plan.X_OG.inverse())
                robot = Robot(solver.body, plan.standoff)
                robot.arms[plan.side], robot.openings[plan.side] = plan.carry_rad, plan.opening_m
                attempt(
                    study,
                    f"place {info.id} on {target.id}",
                    lambda robot=robot, target=target, held=held, plan=plan: place(
                        study, robot, target, held=held, side=plan.side
                    ),
                )
    report(study)


def report(study: Study) -> None:
    """Print what held, how long it took, and what broke."""
    console = Console(width=150)
    chains = Table("chain", "whole", "tried")
    for name, tried in study.tried.items():
        chains.add_row(name, str(study.done[name]), str(tried))
    head = ("median ms", "p95 ms", "max ms", "median checks", "p95 checks", "max checks")
    times = Table("request", "n", *head, title="process time, and questions what touches what")
    for name, seconds in study.seconds.items():
        both = (1000.0 * np.array(seconds), np.array(study.checks[name]))
        cells = [
            f"{v:.0f}" for row in both for v in (np.median(row), np.percentile(row, 95), max(row))
        ]
        times.add_row(name, str(len(seconds)), *cells)
    console.print(chains, times)
    if study.moving_s:
        console.print(f"an arm moves for {np.mean(study.moving_s):.2f} s a motion (mean)")
        console.print("kept clear of everything:", *map(str, sorted(study.clear.items())))
    for cause, count in study.broken.most_common(20):
        console.print(f"{count:4d}  {cause}")


if __name__ == "__main__":
    app()
