"""How deep over an edge each hand is planned to take a thing, by the height of what it stands on.

A counter against a wall, solid to the floor, and one thing on it; no physics: plans alone, from
other starts, at other places along the edge, the thing turned otherwise. Of each trial the deepest
place that a plan leads to is found by bisection.

    python -m benchmarks.planned_depths --heights 1.05,1.10 --things mug,box --seeds 3

`python -m benchmarks.depths` does it in contact physics.
"""

from __future__ import annotations

import itertools
import math
import time
from collections import Counter
from functools import cache
from typing import Annotated, Any

import numpy as np
import typer

from benchmarks import campaign
from benchmarks.campaign import Trial
from benchmarks.markdown import table
from robot.failures import Failure
from robot.messages import Obstacle, Shape, Side, WorldMap
from robot.model.body import SIDES
from robot.model.description import load
from robot.planning.requests import ObjectPose, PickPlan, PickRequest, Surroundings
from robot.planning.solve import Solver
from robot.se3 import SE3

Outcome = dict[str, Any]
HEIGHTS_M = (0.70, 0.80, 0.90, 1.00, 1.05, 1.10, 1.15)
THINGS = {
    "mug": Shape(kind="cylinder", size_m=(0.08, 0.08, 0.10)),
    "box": Shape(kind="box", size_m=(0.12, 0.08, 0.06)),
    "bottle": Shape(kind="cylinder", size_m=(0.07, 0.07, 0.24)),
}
EDGE_M, COUNTER_M, WALL_M = 1.0, (0.90, 1.60), (0.04, 4.0, 2.2)
STEP_M, STEPS = 0.02, 24
"""Depths that are tried: 0 to 0.48 m from the edge to the thing's middle."""
app = typer.Typer(add_completion=False)


def request(*, thing: str, side: Side, height_m: float, depth_m: float, seed: int) -> PickRequest:
    """To take a thing so deep on a counter so high; the rest goes by the seed."""
    rng = np.random.default_rng([seed, 61])
    x, y, aside, turn = rng.uniform((-0.3, -0.8, -0.3, 0.0), (0.1, 0.8, 0.3, math.pi)).tolist()
    shape = THINGS[thing]
    at = SE3.from_xy_yaw(EDGE_M + depth_m, aside, turn, z_m=height_m + 0.5 * shape.size_m[2])
    return PickRequest(
        object_id=thing,
        side=side,
        around=Surroundings(
            map=_room(height_m), objects=(ObjectPose(id=thing, shape=shape, X_WO=at),)
        ),
        start=(x, y, float(rng.uniform(-1.0, 1.0))),
        seed=seed,
    )


def do(*, thing: str, side: Side, height_m: float, seed: int) -> Outcome:
    """The deepest place that a plan leads to, what ends it, and what each plan took."""
    solver = _solver()
    seconds: list[float] = []
    low, high, why = 0, STEPS + 1, "the end of the search"
    while high - low > 1:
        step = (low + high) // 2
        asked = request(thing=thing, side=side, height_m=height_m, depth_m=STEP_M * step, seed=seed)
        begin = time.process_time()
        answer = solver.solve(asked)
        seconds.append(round(time.process_time() - begin, 3))
        if isinstance(answer, PickPlan):
            low = step
        else:
            assert isinstance(answer, Failure)
            high, why = step, answer.code
    return {"ok": low > 0, "deep_m": round(STEP_M * low, 3), "why": why, "seconds": seconds}


@cache
def _solver() -> Solver:
    return Solver(load("juno"))


def _room(height_m: float) -> WorldMap:
    """The counter, from `EDGE_M` on, and the wall behind it."""
    middle = EDGE_M + 0.5 * COUNTER_M[0]
    back = EDGE_M + COUNTER_M[0]
    return WorldMap(
        stamp_s=0.0,
        name="counter",
        obstacles=(
            _block("counter", middle, (*COUNTER_M, height_m)),
            _block("wall", back + 0.5 * WALL_M[0], WALL_M),
        ),
        places=(),
        objects=(),
        people=(),
        categories={},
        bounds_m=(back - 3.4, -2.0, back, 2.0),
    )


def _block(name: str, x: float, size_m: tuple[float, float, float]) -> Obstacle:
    shape = Shape(kind="box", size_m=size_m, X_BodyShape=SE3((0.0, 0.0, 0.5 * size_m[2])))
    return Obstacle(id=name, name=name, X_WO=SE3((x, 0.0, 0.0)), shapes=(shape,))


@app.command()
def main(
    *,
    heights: Annotated[str, typer.Option(help="of the counter, m")] = ",".join(map(str, HEIGHTS_M)),
    things: Annotated[str, typer.Option(help="to take")] = ",".join(THINGS),
    seeds: Annotated[int, typer.Option(help="trials each, of each hand")] = 3,
    processes: Annotated[int, typer.Option("-j", help="at a time")] = 1,
    name: Annotated[
        str, typer.Option(help="of the file of unfinished outcomes")
    ] = "planned_depths",
) -> None:
    """Try every height and thing with both hands."""
    wanted = [one.strip() for one in things.split(",")]
    unknown = sorted(set(wanted) - set(THINGS))
    if unknown:
        raise typer.BadParameter(f"{', '.join(unknown)}: not one of {', '.join(THINGS)}")
    trials = [
        Trial(
            f"{height_m}/{thing}/{side}/{seed}",
            "benchmarks.planned_depths:do",
            {"thing": thing, "side": side, "height_m": float(height_m), "seed": seed},
        )
        for height_m, thing, side, seed in itertools.product(
            heights.split(","), wanted, SIDES, range(seeds)
        )
    ]
    print(render(campaign.run(name, trials, processes=processes)))


def render(outcomes: dict[str, Outcome]) -> str:
    """Depths by height, thing and hand, and what plans took."""
    cells: dict[tuple[str, str], list[Outcome]] = {}
    for key, one in outcomes.items():
        height, thing, side, _ = key.split("/")
        cells.setdefault((height, f"{thing}, {side}"), []).append(one)
    heights = list(dict.fromkeys(height for height, _ in cells))
    kinds = list(dict.fromkeys(kind for _, kind in cells))
    rows = [[height, *(_cell(cells[height, kind]) for kind in kinds)] for height in heights]
    took = [s for one in outcomes.values() for s in one.get("seconds", ())]
    ends = Counter(one.get("why", "error") for one in outcomes.values())
    return "\n\n".join(
        [
            "median (least) depth in cm",
            table(["m high", *kinds], rows),
            f"{len(took)} plans took (median, p95, most) "
            f"{np.median(took):.2f}, {np.quantile(took, 0.95):.2f}, {max(took):.2f} s of CPU; "
            f"ended by {', '.join(f'{why}: {n}' for why, n in ends.most_common())}",
        ]
    )


def _cell(some: list[Outcome]) -> str:
    deep = [100.0 * one.get("deep_m", 0.0) for one in some]
    return f"{np.median(deep):.0f} ({min(deep):.0f})"


if __name__ == "__main__":
    app()
