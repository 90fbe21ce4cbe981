"""`python -m benchmarks.localisation`: where the robot believes to be, against the truth.

Parts: `job` (the main job, shuffled), `stand` (60 s), `kidnap` (set down elsewhere), `walk`
(through every room of a home). With its lidar in its own map, or by the oracle, to compare.
"""

from __future__ import annotations

import json
import math
import time
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from benchmarks import mission
from benchmarks.markdown import table
from executive.meaning import request
from executive.meaning.request import Setting, Understood
from executive.runs import lidar_maps, task_run
from executive.runs.lidar_maps.led_walk import goals_of
from executive.runs.runtimes import Opened, Setup
from executive.runs.session import Session
from executive.runs.task_run import Assignment
from intents.goals import GoTo
from robot.bringup.fast import FastRuntime
from robot.clock import WallClock
from robot.messages import LocalisedBy
from robot.planning.inline import InlinePlanner
from robot.reality.faults import Kidnap
from robot.se3 import SE3, wrap_angle
from sim.simulation import Simulation

PERIOD_S = 0.05
STAND_S = 60.0
SETTLE_S = 3.0
WITHIN_S, WRONG_M, WATCH_S = 20.0, 0.3, 3.0
"""A kidnapped robot has so long; farther off than that it is wrong; it is watched so long after it
has found itself."""
KIDNAPS = (
    (1.0, -1.2, 100.0),
    (-1.4, 0.6, -150.0),
    (0.2, 1.1, 60.0),
    (2.2, -1.6, 180.0),
    (-0.6, -0.4, 20.0),
)
"""x, y [m] of the kitchen, and by how much it is turned [deg]."""
HEAD = [
    "",
    "done",
    "off by, p50 p95 worst",
    "turned by, p50 p95 worst",
    "lost",
    "cup off by",
    "real time",
]


class Truth:
    """What the robot believes, tick by tick, against what is so."""

    def __init__(self, runtime: FastRuntime) -> None:
        """Look at a robot that is up."""
        self._runtime = runtime
        self.rows: list[tuple[float, float, float, float, float]] = []
        self.lost_s = 0.0

    def look(self) -> None:
        """Once a tick."""
        world, body = self._runtime.link.world(), self._runtime.link.body()
        if world is None or body is None or world.lost:
            self.lost_s += PERIOD_S
            return
        believed, true = world.X_WN @ body.X_NB, self._runtime.plant.oracle.X_WB()
        self.rows.append(
            (
                self._runtime.clock.now_s(),
                believed.p[0] - true.p[0],
                believed.p[1] - true.p[1],
                wrap_angle(believed.yaw_rad - true.yaw_rad),
                math.hypot(*true.p[:2]),
            )
        )

    def report(self) -> dict[str, Any]:
        """Percentiles, and the worst instant."""
        rows = np.array(self.rows).reshape(-1, 5)
        if not len(rows):
            return {"lost_s": round(self.lost_s, 2)}
        off_mm, turned = 1000.0 * np.hypot(rows[:, 1], rows[:, 2]), np.degrees(np.abs(rows[:, 3]))
        worst = int(np.argmax(off_mm))
        return {
            "off_mm": [round(float(v), 1) for v in np.percentile(off_mm, (50, 95, 100))],
            "turned_deg": [round(float(v), 2) for v in np.percentile(turned, (50, 95, 100))],
            "worst_at_s": round(float(rows[worst, 0]), 2),
            "lost_s": round(self.lost_s, 2),
        }


def _where(
    world: str, reality: str, by: LocalisedBy, *, vary_seed: int | None = None
) -> tuple[Setting, Path | None]:
    there = Simulation(reality, localisation=by)
    where = request.setting(there, world, robot="juno", vary_seed=vary_seed)
    return where, lidar_maps.needed(where)


def job(seed: int, reality: str, by: LocalisedBy) -> dict[str, Any]:
    """The main job of a seed."""
    sentence, cup = mission.words(seed)
    where, lidar_map = _where("kitchen", reality, by, vary_seed=seed)
    understood = request.request(sentence, where)
    if not isinstance(understood, Understood):
        return {"ok": False, "code": understood.outcome}
    begin_s, begin_cpu_s = time.perf_counter(), time.process_time()
    with FastRuntime(where.world, "juno", seed=seed, lidar_map=lidar_map) as runtime:
        witness, truth = mission.Witness(InlinePlanner(where.description)), Truth(runtime)
        setup = Setup(where=where, kind="fast", seed=seed)
        with Session(setup, Opened(runtime, witness)) as session:
            session.on_tick(truth.look)
            assignment = Assignment(understood=understood)
            done = task_run.do(assignment, session, show=mission.silent, wall=WallClock())
        judged = mission.judged(runtime, done, witness.X_WO, cup.replace(" ", "_"))
        judged["cup_off_mm"] = judged.pop("off_mm")
    simulated_s = done.simulated_s
    return {
        "code": done.code, "recoveries": done.recoveries, **judged, **truth.report(),
        "simulated_s": simulated_s,
        "factor": round(simulated_s / (time.perf_counter() - begin_s), 2),
        "cpu_factor": round(simulated_s / (time.process_time() - begin_cpu_s), 2),
    }  # fmt: skip


def stand(seed: int, reality: str, by: LocalisedBy) -> dict[str, Any]:
    """Sixty seconds on the spot: how far what it believes of its odometry frame wanders."""
    where, lidar_map = _where("kitchen", reality, by)
    with FastRuntime(where.world, "juno", seed=seed, lidar_map=lidar_map) as runtime:
        truth, seen = Truth(runtime), list[SE3]()
        while runtime.clock.now_s() < STAND_S + SETTLE_S:
            runtime.advance(PERIOD_S)
            truth.look()
            if runtime.clock.now_s() > SETTLE_S and (world := runtime.link.world()) is not None:
                seen.append(world.X_WN)
    spread = np.array([X.p[:2] for X in seen])
    apart_mm = 1000.0 * np.hypot(*(spread - spread.mean(axis=0)).T)
    spread_mm = [round(float(v), 1) for v in np.percentile(apart_mm, (50, 95, 100))]
    return {"ok": True, "spread_mm": spread_mm, **truth.report()}


def kidnap(number: int, reality: str, by: LocalisedBy) -> dict[str, Any]:
    """Set down elsewhere while it stands: how long until it says so, and until it knows better."""
    x_m, y_m, turn_deg = KIDNAPS[number]
    where, lidar_map = _where("kitchen", reality, by)
    with FastRuntime(where.world, "juno", seed=number, lidar_map=lidar_map) as runtime:
        runtime.advance(SETTLE_S)
        runtime.inject(Kidnap(at_m=(x_m, y_m), turn_deg=turn_deg))
        noticed_s = found_s = math.inf
        wrong_s, off_m = 0.0, math.inf
        while (since_s := runtime.clock.now_s() - SETTLE_S) < WITHIN_S:
            runtime.advance(PERIOD_S)
            world, body = runtime.link.world(), runtime.link.body()
            if world is None or body is None:
                continue
            believed = world.X_WN @ body.X_NB
            off_m = math.dist(believed.p[:2], runtime.plant.oracle.X_WB().p[:2])
            if world.lost:
                noticed_s, found_s = min(noticed_s, since_s), math.inf
            elif off_m < WRONG_M:
                found_s = min(found_s, since_s)
                if since_s > found_s + WATCH_S:
                    break
            else:
                wrong_s += PERIOD_S
        lost = world.lost if world is not None else ""
    return {
        "ok": bool(lost) or off_m < WRONG_M, "noticed_s": round(noticed_s, 2),
        "found_s": round(found_s, 2), "sure_and_wrong_s": round(wrong_s, 2),
        "off_mm": [round(1000.0 * off_m, 1)], "lost": lost,
    }  # fmt: skip


def walk(seed: int, reality: str, by: LocalisedBy, *, world: str) -> dict[str, Any]:
    """Through every room of a home, from goal to goal."""
    where, lidar_map = _where(world, reality, by)
    way_m, reached = 0.0, 0
    with FastRuntime(where.world, "juno", seed=seed, lidar_map=lidar_map) as runtime:
        truth, setup = Truth(runtime), Setup(where=where, kind="fast", seed=seed)
        before = runtime.plant.oracle.X_WB().p
        with Session(setup, Opened(runtime, InlinePlanner(where.description))) as session:

            def look() -> None:
                nonlocal way_m, before
                truth.look()
                now = runtime.plant.oracle.X_WB().p
                if (step_m := math.dist(now[:2], before[:2])) > 0.1:
                    way_m, before = way_m + step_m, now

            session.on_tick(look)
            goals = goals_of(where.world_map)
            for goal in goals:
                asked = request.meant(f"go to {goal}", (GoTo(place=goal),), where)
                if isinstance(asked, Understood):
                    session.submit(asked)
                    session.run()
                    reached += session.executive.jobs[-1].state == "done"
    return {
        "ok": True, "way_m": round(way_m, 1), "goals": f"{reached} of {len(goals)}",
        "simulated_s": round(runtime.clock.now_s(), 1), **truth.report(),
    }  # fmt: skip


def main(
    part: Annotated[str, typer.Argument(help="job, stand, kidnap or walk")] = "job",
    *,
    seeds: Annotated[int, typer.Option(help="how many")] = 10,
    first: Annotated[int, typer.Option(help="the first of them")] = 0,
    reality: Annotated[str, typer.Option(help="ideal, real or harsh")] = "real",
    by: Annotated[str, typer.Option(help="lidar or oracle")] = "lidar",
    world: Annotated[str, typer.Option(help="of a walk")] = "flat:3",
    out: Annotated[Path | None, typer.Option(help="a file for the outcomes, a line each")] = None,
) -> None:
    """Measure, and print a line a run, then a table."""
    localised: LocalisedBy = "lidar" if by == "lidar" else "oracle"
    rows: list[list[str]] = []
    for seed in range(first, first + (min(seeds, len(KIDNAPS)) if part == "kidnap" else seeds)):
        match part:
            case "stand":
                found = stand(seed, reality, localised)
            case "kidnap":
                found = kidnap(seed, reality, localised)
            case "walk":
                found = walk(seed, reality, localised, world=world)
            case _:
                found = job(seed, reality, localised)
        line = json.dumps({"part": part, "seed": seed, "reality": reality, "by": by, **found})
        print(line, flush=True)
        if out is not None:
            with out.open("a", encoding="utf-8") as file:
                file.write(line + "\n")
        rows.append(_row(f"{part} {seed}, {reality}, {by}", found))
    print(table(HEAD, rows))


def _row(name: str, found: dict[str, Any]) -> list[str]:
    def shown(key: str, unit: str) -> str:
        values = found.get(key)
        return " ".join(f"{value:g}" for value in values) + unit if values else ""

    cup_mm = found.get("cup_off_mm")
    return [
        name,
        "yes" if found["ok"] else f"no: {found.get('code', '')}",
        shown("off_mm", " mm"),
        shown("turned_deg", " deg"),
        f"{found.get('lost_s', 0.0):g} s" if "lost_s" in found else str(found.get("lost", "")),
        f"{cup_mm:g} mm" if cup_mm is not None else "",
        f"{found['factor']:g} x" if "factor" in found else "",
    ]


if __name__ == "__main__":
    typer.run(main)
