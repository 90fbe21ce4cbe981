"""`python -m benchmarks.localisation`: where the robot believes to be, against the truth.

Parts: `job` (the main job, shuffled), `find` (where it began), `stand` (60 s), `kidnap` (set down
elsewhere while it stands, or, with `--walking`, while it walks), `walk` (through every room of a
home, again and again for `--least-m`). With its lidar in its own map, or by the oracle, to compare.
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
FOUND_S = 0.5
"""It is watched so long after it has begun and found itself."""
WALKED_S, WALKED_MORE_S, TURNED_MORE_DEG = 4.0, 1.5, 75.0
"""It has walked so long when it is carried off; the second time more, and it is turned more."""
FALLEN_M, MOST_STEP_M = 0.5, 0.2
"""A pelvis that is lower has fallen; a longer way in a tick is not walked."""
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


def find(seed: int, reality: str, by: LocalisedBy) -> dict[str, Any]:
    """Begin somewhere in the kitchen: how long until it knows where, and whether that is so."""
    where, lidar_map = _where("kitchen", reality, by, vary_seed=seed)
    with FastRuntime(where.world, "juno", seed=seed, lidar_map=lidar_map) as runtime:
        while runtime.link.world() is None and runtime.clock.now_s() < WITHIN_S:
            runtime.advance(PERIOD_S)
        found_s = runtime.clock.now_s()
        truth = Truth(runtime)
        while runtime.clock.now_s() < found_s + FOUND_S:
            runtime.advance(PERIOD_S)
            truth.look()
        start = runtime.plant.oracle.X_WB()
    known = truth.report()
    off_mm = known.get("off_mm", [])
    return {
        "ok": not off_mm or off_mm[-1] < 1000.0 * WRONG_M, "found_s": round(found_s, 2),
        "start": [round(start.p[0], 2), round(start.p[1], 2), round(math.degrees(start.yaw_rad))],
        **known,
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


def kidnap(number: int, reality: str, by: LocalisedBy, *, walking: bool) -> dict[str, Any]:
    """Set down elsewhere: how long until it says so, and until it knows better.

    While it walks: the first five times to the shelf and to the table by turns, then again from
    another moment of the way, turned otherwise. Its job is given up once that has been seen.
    """
    x_m, y_m, turn_deg = KIDNAPS[number % len(KIDNAPS)]
    second = number // len(KIDNAPS)
    where, lidar_map = _where("kitchen", reality, by)
    with FastRuntime(where.world, "juno", seed=number, lidar_map=lidar_map) as runtime:
        setup = Setup(where=where, kind="fast", seed=number)
        with Session(setup, Opened(runtime, InlinePlanner(where.description))) as session:
            watched = Kidnapped(
                runtime,
                Kidnap(at_m=(x_m, y_m), turn_deg=turn_deg + TURNED_MORE_DEG * second),
                at_s=SETTLE_S + (WALKED_S + WALKED_MORE_S * second if walking else 0.0),
            )
            session.on_tick(watched.look)
            if walking:
                goal = ("shelf", "table")[number % 2]
                asked = request.meant(f"go to {goal}", (GoTo(place=goal),), where)
                assert isinstance(asked, Understood)
                session.submit(asked)
            session.run(until=watched.over)
            while not watched.over():  # its job is over
                runtime.advance(PERIOD_S)
                watched.look()
    return watched.report()


class Kidnapped:
    """A robot that is set down elsewhere, and watched from then on, tick by tick."""

    def __init__(self, runtime: FastRuntime, fault: Kidnap, *, at_s: float) -> None:
        """It is to happen at `at_s`."""
        self._runtime, self._fault, self._at_s = runtime, fault, at_s
        self._noticed_s = self._found_s = math.inf
        self._before_s = self._wrong_s = 0.0
        self._off_m, self._speed_m_s, self._lost = math.inf, 0.0, ""
        self._way_m, self._fell = 0.0, False
        self._last = runtime.plant.oracle.X_WB().p
        self._happened = False

    def look(self) -> None:
        """Once a tick."""
        runtime = self._runtime
        true = runtime.plant.oracle.X_WB()
        step_m, self._last = math.dist(true.p[:2], self._last[:2]), true.p
        if not self._happened:
            self._speed_m_s = step_m / PERIOD_S
            if runtime.clock.now_s() >= self._at_s:
                runtime.inject(self._fault)
                self._happened = True
            return
        self._fell = self._fell or true.p[2] < FALLEN_M
        world, body = runtime.link.world(), runtime.link.body()
        if world is None or body is None:
            return
        self._lost = world.lost
        self._off_m = math.dist((world.X_WN @ body.X_NB).p[:2], true.p[:2])
        since_s = self._since_s
        if world.lost:
            self._noticed_s, self._found_s = min(self._noticed_s, since_s), math.inf
        elif self._off_m < WRONG_M:
            self._found_s = min(self._found_s, since_s)
        else:
            self._found_s = math.inf
            if self._noticed_s == math.inf:
                self._before_s += PERIOD_S
                self._way_m += step_m if step_m < MOST_STEP_M else 0.0
            else:
                self._wrong_s += PERIOD_S

    @property
    def _since_s(self) -> float:
        return self._runtime.clock.now_s() - self._at_s

    def over(self) -> bool:
        """Whether it has been found for a while, or the time is over."""
        known_s = self._since_s - self._found_s
        return self._happened and (known_s > WATCH_S or self._since_s > WITHIN_S)

    def report(self) -> dict[str, Any]:
        """What became of it."""
        knows = bool(self._lost) or self._off_m < WRONG_M
        return {
            "ok": knows and self._wrong_s == 0.0 and not self._fell,
            "speed_m_s": round(self._speed_m_s, 2), "noticed_s": round(self._noticed_s, 2),
            "found_s": round(self._found_s, 2), "wrong_before_noticed_s": round(self._before_s, 2),
            "way_before_noticed_m": round(self._way_m, 2),
            "sure_and_wrong_after_s": round(self._wrong_s, 2), "fell": self._fell,
            "off_mm": [round(1000.0 * self._off_m, 1)], "lost": self._lost,
        }  # fmt: skip


def walk(seed: int, reality: str, by: LocalisedBy, *, world: str, least_m: float) -> dict[str, Any]:
    """Through every room of a home, from goal to goal, again from the first until `least_m`."""
    where, lidar_map = _where(world, reality, by)
    way_m, asked_for, reached = 0.0, 0, 0
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
            while asked_for < len(goals) or (way_m < least_m and reached > asked_for // 2):
                goal = goals[asked_for % len(goals)]
                asked = request.meant(f"go to {goal}", (GoTo(place=goal),), where)
                asked_for += 1
                if isinstance(asked, Understood):
                    session.submit(asked)
                    session.run()
                    reached += session.executive.jobs[-1].state == "done"
    return {
        "ok": True, "way_m": round(way_m, 1), "goals": f"{reached} of {asked_for}",
        "simulated_s": round(runtime.clock.now_s(), 1), **truth.report(),
    }  # fmt: skip


def main(
    part: Annotated[str, typer.Argument(help="job, find, stand, kidnap or walk")] = "job",
    *,
    seeds: Annotated[int, typer.Option(help="how many")] = 10,
    first: Annotated[int, typer.Option(help="the first of them")] = 0,
    reality: Annotated[str, typer.Option(help="ideal, real or harsh")] = "real",
    by: Annotated[str, typer.Option(help="lidar or oracle")] = "lidar",
    world: Annotated[str, typer.Option(help="of a walk")] = "flat:3",
    least_m: Annotated[float, typer.Option(help="of a walk")] = 0.0,
    walking: Annotated[bool, typer.Option("--walking", help="of kidnap")] = False,
    out: Annotated[Path | None, typer.Option(help="a file for the outcomes, a line each")] = None,
) -> None:
    """Measure, and print a line a run, then a table."""
    localised: LocalisedBy = "lidar" if by == "lidar" else "oracle"
    rows: list[list[str]] = []
    for seed in range(first, first + seeds):
        match part:
            case "find":
                found = find(seed, reality, localised)
            case "stand":
                found = stand(seed, reality, localised)
            case "kidnap":
                found = kidnap(seed, reality, localised, walking=walking)
            case "walk":
                found = walk(seed, reality, localised, world=world, least_m=least_m)
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
