"""The main job, many times over: another start, other spots, another cup, another board.

As `humanoid do` does it by default: its reality, its eyes, its way to find its place.
"""

from __future__ import annotations

import math
import time
from collections import Counter
from typing import Any

import numpy as np

from benchmarks.campaign import UNFINISHED, Trial
from benchmarks.markdown import share, table
from executive.engine.executive import Executive
from executive.frontends.progress import Silent
from executive.meaning import request
from executive.runs import lidar_maps, runtimes, task_run
from executive.runs.runtimes import Opened, Setup
from executive.runs.session import Session
from executive.runs.summary import Summary
from executive.runs.task_run import Assignment, Progress
from robot.clock import WallClock
from robot.planning.requests import PlacePlan, PlanRequest, PlanResult
from robot.planning.worker import Planner
from robot.reality.contract import USUAL
from robot.se3 import SE3
from sim.simulation import Simulation

Outcomes = dict[str, dict[str, Any]]
WORLD, ROBOT = "kitchen", "juno"
CUPS = ("red cup", "blue cup")
BOARDS = ("lower shelf", "middle shelf", "upper shelf")
WITHIN_M = 0.03
UPRIGHT_RAD = math.radians(15.0)
STANDING_M = 0.45


def jobs(*, quick: bool) -> list[Trial]:
    """50 `fast` missions and 5 `live` ones; quick, 4 and none."""
    fast = [
        Trial(f"fast/{seed}", "benchmarks.mission:do", {"seed": seed})
        for seed in range(4 if quick else 50)
    ]
    live = [
        Trial(f"live/{seed}", "benchmarks.mission:do", {"seed": seed, "live": True}, alone=True)
        for seed in range(0 if quick else 5)
    ]
    return fast + live


class Witness:
    """A planner that remembers where an object was meant to go."""

    def __init__(self, planner: Planner) -> None:
        """Pass everything on to `planner`."""
        self._planner = planner
        self.X_WO: SE3 | None = None

    def submit(self, request: PlanRequest, *, now_s: float) -> int:
        """Pass on."""
        return self._planner.submit(request, now_s=now_s)

    def poll(self, ticket: int, *, now_s: float) -> PlanResult | None:
        """Pass on, and note the spot of a plan for placing."""
        result = self._planner.poll(ticket, now_s=now_s)
        if isinstance(result, PlacePlan):
            self.X_WO = result.X_WO
        return result

    def cancel(self, ticket: int) -> None:
        """Pass on."""
        self._planner.cancel(ticket)


def words(seed: int) -> tuple[str, str]:
    """The sentence of a seed, and its cup."""
    rng = np.random.default_rng([seed, 50])
    cup, board = str(rng.choice(CUPS)), str(rng.choice(BOARDS))
    return f"pick up the {cup} and put it on the {board}", cup


def do(*, seed: int, live: bool = False) -> dict[str, Any]:
    """One mission; `fast` is judged by the simulator's truth, `live` by the robot's own report."""
    sentence, cup = words(seed)
    where = lidar_maps.localised(
        request.setting(Simulation().under(USUAL, eyes="auto"), WORLD, robot=ROBOT, vary_seed=seed),
        "auto",
        tell=lambda _text: None,
    )
    understood = request.request(sentence, where)
    if isinstance(understood, request.Refused):
        return {"ok": False, "code": understood.outcome, "cause": understood.reason}
    folder = UNFINISHED / "missions" / f"{'live' if live else 'fast'}-{seed}"
    kind: runtimes.Kind = "live" if live else "fast"
    setup = Setup(where=where, kind=kind, seed=seed, folder=folder)
    begin_s = time.perf_counter()
    with runtimes.opened(setup) as (runtime, planner):
        ready_s = time.perf_counter() - begin_s
        witness = Witness(planner)
        begin_cpu_s = time.process_time()
        summary = _carry_out(understood, setup, Opened(runtime, witness))
        cpu_s = time.process_time() - begin_cpu_s
        known = {**_report(summary, sentence, ready_s), "cpu_s": round(cpu_s, 2)}
        if live:
            body = runtime.link.body()
            standing = body is not None and body.mode == "stand"
            return {**known, "ok": summary.status == "done" and standing, "standing": standing}
        return {**known, **judged(runtime, summary, witness.X_WO, cup.replace(" ", "_"))}


def _carry_out(understood: request.Understood, setup: Setup, robot: Opened) -> Summary:
    with Session(setup, robot, time_of_day=time.time) as session:
        assignment = Assignment(understood=understood)
        return task_run.do(assignment, session, show=silent, wall=WallClock())


def silent(_executive: Executive) -> Progress:
    return Silent()


def _report(summary: Summary, sentence: str, ready_s: float) -> dict[str, Any]:
    return {
        "sentence": sentence,
        "code": summary.code,
        "cause": summary.cause,
        "recoveries": summary.recoveries,
        "simulated_s": summary.simulated_s,
        "mission_wall_s": summary.wall_s,
        "factor": round(summary.real_time_factor, 2),
        "ready_s": round(ready_s, 2),
        "clamped": summary.clamped,
        "late": list(summary.late),
    }


def judged(runtime: Any, summary: Summary, X_WO: SE3 | None, object_id: str) -> dict[str, Any]:
    """What truly became of it: the cup against the spot it was meant for, the robot on its feet."""
    oracle = runtime.plant.oracle
    X_true, X_WB = oracle.X_WO(object_id), oracle.X_WB()
    tilt_rad = math.acos(max(-1.0, min(1.0, float(X_true.rotation()[2, 2]))))
    standing = X_WB.p[2] > STANDING_M and float(X_WB.rotation()[2, 2]) > 0.9
    off_m = math.inf if X_WO is None else math.dist(X_true.p, X_WO.p)
    placed = off_m <= WITHIN_M and tilt_rad <= UPRIGHT_RAD
    return {
        "ok": placed and standing and summary.status == "done",
        "placed": placed,
        "standing": standing,
        "off_mm": round(1000.0 * off_m, 1) if X_WO is not None else None,
        "tilt_deg": round(math.degrees(tilt_rad), 1),
    }


def render(outcomes: Outcomes) -> str:
    """Outcomes of fast and live missions, and what went wrong."""
    parts = [_table(outcomes), _codes(outcomes), _speed(outcomes), _late(outcomes)]
    return "\n\n".join(part for part in parts if part)


def _of(outcomes: Outcomes, kind: str) -> Outcomes:
    return {key: one for key, one in outcomes.items() if key.startswith(f"{kind}/")}


def _table(outcomes: Outcomes) -> str:
    rows = []
    for kind, judged in (("fast", "the simulator's truth"), ("live", "the robot's own report")):
        some = _of(outcomes, kind)
        if some:
            offs = sorted(one["off_mm"] for one in some.values() if one["ok"] and one.get("off_mm"))
            off = f"{offs[len(offs) // 2]:.0f} mm, worst {offs[-1]:.0f} mm" if offs else ""
            again = sum(one.get("recoveries", 0) > 0 for one in some.values() if one["ok"])
            rows.append([f"`{kind}`", share(some), off, str(again), judged])
    head = ["", "placed within 3 cm, upright, standing", "off by", "with recoveries", "judged by"]
    return table(head, rows)


def _codes(outcomes: Outcomes) -> str:
    """Failures by code, with their seeds."""
    failed = {key: one for key, one in outcomes.items() if not one["ok"]}
    if not failed:
        return "No failure." if outcomes else ""
    counts = Counter(_code(one) for one in failed.values())
    rows = [
        [
            f"`{code}`",
            str(count),
            ", ".join(key for key, one in failed.items() if _code(one) == code),
            next(_cause(one) for one in failed.values() if _code(one) == code),
        ]
        for code, count in counts.most_common()
    ]
    return table(["failure", "missions", "which", "for example"], rows)


def _code(one: dict[str, Any]) -> str:
    if "error" in one:
        return "exception"
    return "not where it was meant" if one["code"] == "done" else str(one["code"])


def _cause(one: dict[str, Any]) -> str:
    if "error" in one:
        return str(one["error"]).strip().splitlines()[-1]
    return str(one["cause"]) or f"{one.get('off_mm')} mm off, {one.get('tilt_deg')}° tilted"


def _speed(outcomes: Outcomes) -> str:
    fast = [one for one in _of(outcomes, "fast").values() if one.get("cpu_s")]
    if not fast:
        return ""
    simulated = sum(one["simulated_s"] for one in fast)
    wall = sum(one["mission_wall_s"] for one in fast)
    cpu = sum(one["cpu_s"] for one in fast)
    each = sorted(one["simulated_s"] for one in fast)[len(fast) // 2]
    ready = sorted(one["ready_s"] for one in fast)[len(fast) // 2]
    return (
        f"A mission takes {each:.0f} simulated seconds (median). `fast` ran at "
        f"**{simulated / wall:.1f} simulated seconds a wall second**, two missions at a time, "
        f"sensing and planning included; {simulated / cpu:.1f} a second of CPU time. "
        f"A runtime is ready in {ready:.1f} s (median)."
    )


def _late(outcomes: Outcomes) -> str:
    """How well the 500 Hz loops kept their time in the live missions."""
    lines = [
        f"- {key}: {line}"
        for key, one in _of(outcomes, "live").items()
        for line in one.get("late", ())
    ]
    return "Lateness of the 500 Hz loops:\n\n" + "\n".join(lines) if lines else ""
