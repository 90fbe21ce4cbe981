"""How deep over an edge a mug is really taken and put back, by the height of what it stands on.

A counter against a wall, solid to the floor, and one mug: it is taken and put back where it was,
in contact physics, with other starts and other places along the edge.

    python -m benchmarks.depths --heights 0.9,1.0 --depths 0.2,0.25 --seeds 3 -j 1
"""

from __future__ import annotations

import itertools
import math
from typing import Annotated, Any

import numpy as np
import typer

from benchmarks import campaign
from benchmarks.campaign import Trial
from benchmarks.markdown import table
from executive.skills.catalogue import make
from executive.skills.context import SkillContext
from executive.skills.parameters import SkillParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.skill import SkillReport
from robot.bringup.fast import FastRuntime
from robot.failures import Failure
from robot.model.description import load
from robot.planning.inline import InlinePlanner
from robot.planning.requests import PickRequest, PlanRequest, PlanResult
from robot.planning.worker import Planner
from robot.se3 import SE3
from sim.simulation import SimulatedWorld
from sim.world_schema import Furniture, Object, Room, Start, World

Outcome = dict[str, Any]
HEIGHTS_M = (0.45, 0.55, 0.65, 0.75, 0.85, 0.90, 0.94, 0.98, 1.02, 1.06, 1.10, 1.15)
DEPTHS_M = (0.10, 0.15, 0.20, 0.25, 0.30, 0.35, 0.40, 0.45)
EDGE_M, COUNTER_M = 1.0, (0.90, 1.60)
BACK_M = EDGE_M + COUNTER_M[0]
MUG_M, MUG_KG = (0.08, 0.08, 0.10), 0.30
TICK_S, LIMIT_S = 0.05, 240.0
UPRIGHT = 0.8
WITHIN_M, TILT_RAD = 0.03, math.radians(15.0)
app = typer.Typer(add_completion=False)


def counter(*, height_m: float, depth_m: float, seed: int) -> World:
    """A mug so deep on a counter so high; start and place along the edge go by the seed."""
    rng = np.random.default_rng([seed, 60])
    aside, x, y = rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.1), rng.uniform(-0.8, 0.8)
    middle = EDGE_M + 0.5 * COUNTER_M[0]
    return World(
        name="counter",
        rooms=(Room(id="room", at_m=(BACK_M - 1.7, 0.0), size_m=(3.4, 4.0), walls=("east",)),),
        furniture=(
            Furniture(
                id="counter",
                kind="box",
                movable=False,
                at_m=(middle, 0.0),
                yaw_deg=180.0,
                size_m=(*COUNTER_M, height_m),
            ),
        ),
        objects=(
            Object(
                id="mug",
                category="mug",
                color="red",
                shape="cylinder",
                size_m=MUG_M,
                mass_kg=MUG_KG,
                on="counter",
                at_m=(0.5 * COUNTER_M[0] - depth_m, float(aside)),
            ),
        ),
        categories={"mug": "mugs"},
        start=Start(at_m=(float(x), float(y)), yaw_deg=float(rng.uniform(-60.0, 60.0))),
    )


class Noting:
    """A planner that keeps the answer to what was asked for the hand first."""

    def __init__(self, planner: Planner) -> None:
        """Pass everything on to `planner`."""
        self._planner = planner
        self._picks: set[int] = set()
        self.first: PlanResult | None = None

    def submit(self, request: PlanRequest, *, now_s: float) -> int:
        """Pass on."""
        ticket = self._planner.submit(request, now_s=now_s)
        if isinstance(request, PickRequest):
            self._picks.add(ticket)
        return ticket

    def poll(self, ticket: int, *, now_s: float) -> PlanResult | None:
        """Pass on, and note."""
        result = self._planner.poll(ticket, now_s=now_s)
        if result is not None and ticket in self._picks and self.first is None:
            self.first = result
        return result

    def cancel(self, ticket: int) -> None:
        """Pass on."""
        self._planner.cancel(ticket)


def do(*, height_m: float, depth_m: float, seed: int) -> Outcome:
    """Take the mug and put it back, judged by the simulator's truth."""
    robot = load("juno")
    planner = Noting(InlinePlanner(robot))
    world = SimulatedWorld(counter(height_m=height_m, depth_m=depth_m, seed=seed))
    with FastRuntime(world, seed=seed) as runtime:
        runtime.advance(0.5)
        oracle = runtime.plant.oracle
        context = SkillContext(link=runtime.link, planner=planner, description=robot, seed=seed)
        before = oracle.X_WO("mug")
        picked = _carry_out(runtime, context, PickParams(object_id="mug"))
        outcome: Outcome = {
            "planned": not isinstance(planner.first, Failure),
            "plan": _words(planner.first),
            "picked": picked.status == "succeeded" and _rose(before, oracle.X_WO("mug")),
            "why": _why(picked),
            "pick_s": round(runtime.clock.now_s(), 1),
            "stands": _stands(runtime),
        }
        if not outcome["picked"] or not outcome["stands"]:
            return {**outcome, "ok": not outcome["planned"] and outcome["stands"]}
        X_WO = SE3.from_xy_yaw(before.p[0], before.p[1], 0.0, z_m=before.p[2])
        placed = _carry_out(runtime, context, PlaceParams(object_id="mug", X_WO=X_WO))
        runtime.advance(0.5)
        after = oracle.X_WO("mug")
        tilt_rad = math.acos(max(-1.0, min(1.0, float(after.rotation()[2, 2]))))
        off_m = math.dist(after.p, before.p)
        there = off_m <= WITHIN_M and tilt_rad <= TILT_RAD
        outcome |= {
            "placed": placed.status == "succeeded" and there,
            "why_placed": _why(placed),
            "off_mm": round(1000.0 * off_m, 1),
            "stands": _stands(runtime),
        }
        return {**outcome, "ok": outcome["placed"] and outcome["stands"]}


def _carry_out(runtime: Any, context: SkillContext, wanted: SkillParams) -> SkillReport:
    """Run one skill to its end, or until the robot lies."""
    skill = make(wanted, context)
    skill.start(runtime.clock.now_s())
    end_s = runtime.clock.now_s() + LIMIT_S
    report = skill.step(runtime.clock.now_s())
    while report.status == "running" and runtime.clock.now_s() < end_s and _stands(runtime):
        runtime.advance(TICK_S)
        report = skill.step(runtime.clock.now_s())
    return report


def _stands(runtime: Any) -> bool:
    return float(runtime.plant.oracle.X_WB().rotation()[2, 2]) > UPRIGHT


def _rose(before: SE3, after: SE3) -> bool:
    return math.dist(before.p, after.p) > 0.05


def _why(report: SkillReport) -> str:
    if report.failure is None:
        return "" if report.status == "succeeded" else f"{report.status} while {report.phase}"
    return f"{report.failure.code} while {report.phase}: {report.failure.cause}"


def _words(plan: PlanResult | None) -> str:
    if plan is None or isinstance(plan, Failure):
        return "none" if plan is None else f"{plan.code}: {plan.cause}"
    return f"{plan.side} {plan.posture} {tuple(round(v, 2) for v in plan.stance)}"  # type: ignore[union-attr]


def _floats(text: str) -> tuple[float, ...]:
    return tuple(float(part) for part in text.split(","))


@app.command()
def main(
    *,
    heights: Annotated[str, typer.Option(help="of the counter, m")] = ",".join(map(str, HEIGHTS_M)),
    depths: Annotated[str, typer.Option(help="from its edge, m")] = ",".join(map(str, DEPTHS_M)),
    seeds: Annotated[int, typer.Option(help="trials each")] = 3,
    processes: Annotated[int, typer.Option("-j", help="at a time")] = 1,
    name: Annotated[str, typer.Option(help="of the file of unfinished outcomes")] = "depths",
) -> None:
    """Try every height and depth."""
    cells = list(itertools.product(_floats(heights), _floats(depths)))
    trials = [
        Trial(
            f"{height_m}/{depth_m}/{seed}",
            "benchmarks.depths:do",
            {"height_m": height_m, "depth_m": depth_m, "seed": seed},
        )
        for height_m, depth_m in cells
        for seed in range(seeds)
    ]
    outcomes = campaign.run(name, trials, processes=processes)
    print(render(outcomes))


def render(outcomes: dict[str, Outcome]) -> str:
    """Planned, picked and put back, and falls, by height and depth."""
    cells: dict[tuple[str, str], list[Outcome]] = {}
    for key, one in outcomes.items():
        height, depth, _ = key.split("/")
        cells.setdefault((height, depth), []).append(one)
    heights = list(dict.fromkeys(height for height, _ in cells))
    depths = list(dict.fromkeys(depth for _, depth in cells))
    rows = [[height, *(_cell(cells[height, depth]) for depth in depths)] for height in heights]
    return table(["m high, deep:", *depths], rows)


def _cell(some: list[Outcome]) -> str:
    """`planned picked placed/tried`, and how many fell."""

    def counted(key: str) -> int:
        return sum(bool(one.get(key)) for one in some)

    fell = sum(one.get("stands") is False for one in some)
    words = f"{counted('planned')} {counted('picked')} {counted('placed')}/{len(some)}"
    return words + (f", {fell} fell" if fell else "")


if __name__ == "__main__":
    app()
