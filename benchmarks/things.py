"""The catalogue of things in contact physics: do they stand still, and which can be brought.

python -m benchmarks.things standing
python -m benchmarks.things bringing --kinds mug,apple --variants 2 -j 1
python -m benchmarks.things speed
"""

from __future__ import annotations

import math
import time
from typing import Annotated, Any

import msgspec
import mujoco
import numpy as np
import typer

from benchmarks import campaign
from benchmarks.campaign import Trial
from benchmarks.markdown import table
from executive.skills.catalogue import make
from executive.skills.context import SkillContext
from executive.skills.parameters import SkillParams
from executive.skills.pick import Pick, PickParams
from executive.skills.place import PlaceParams
from executive.skills.skill import SkillReport
from robot.bringup.fast import FastRuntime
from robot.model.description import load
from robot.planning.inline import InlinePlanner
from sim import assembly
from sim.simulation import SimulatedWorld
from sim.things import catalogue
from sim.things.making import made
from sim.world_schema import Furniture, Object, Room, Start, World

Outcome = dict[str, Any]
TICK_S, LIMIT_S = 0.05, 240.0
UPRIGHT = 0.8
TILT_RAD = math.radians(15.0)
REST_S, STILL_M, STILL_RAD = 10.0, 0.002, math.radians(1.0)
MANY = 30
TAKEN = "drink_can"
"""What is taken among many."""
app = typer.Typer(add_completion=False)


def thing(
    name: str,
    *,
    variant: int,
    on: str,
    at_m: tuple[float, float],
    number: int = 0,
    yaw_deg: float = 0.0,
) -> Object:
    """An object of a kind."""
    one = made(name, variant)
    return Object(
        id=f"{name}_{number}" if number else name, category=one.category, color=one.color,
        shape=one.shape, size_m=one.size_m, mass_kg=one.mass_kg, on=on, at_m=at_m, yaw_deg=yaw_deg,
        kind=name, variant=variant,
    )  # fmt: skip


def two_tables(name: str, *, variant: int, seed: int) -> World:
    """A thing near the edge of a table, any way round, and an empty table across the room."""
    rng = np.random.default_rng([seed, variant, 17])
    radius = made(name, variant).radius_m
    at = (0.3 - max(radius + 0.02, 0.12), float(rng.uniform(-0.3, 0.3)))
    return World(
        name="tables",
        rooms=(Room(id="room", at_m=(0.0, 0.0), size_m=(5.0, 4.0)),),
        furniture=(
            Furniture(id="table", kind="table", at_m=(1.6, 0.0), yaw_deg=180.0),
            Furniture(id="desk", kind="table", at_m=(-1.6, 0.0)),
        ),
        objects=(
            thing(
                name, variant=variant, on="table", at_m=at, yaw_deg=float(rng.uniform(-180, 180))
            ),
        ),
        start=Start(at_m=(0.0, float(rng.uniform(-0.5, 0.5))), yaw_deg=float(rng.uniform(-60, 60))),
    )


def bring(*, kind: str, variant: int, seed: int) -> Outcome:
    """Take a thing from one table to the other, judged by the simulator's truth."""
    robot = load("juno")
    world = SimulatedWorld(two_tables(kind, variant=variant, seed=seed))
    refusal = Pick.refusal(PickParams(object_id=kind), world.map, robot)
    if refusal is not None:
        return {"ok": False, "stage": "refused", "why": refusal.cause}
    with FastRuntime(world, seed=seed) as runtime:
        runtime.advance(0.5)
        oracle = runtime.plant.oracle
        context = SkillContext(
            link=runtime.link, planner=InlinePlanner(robot), description=robot, seed=seed
        )
        before = oracle.X_WO(kind)
        wanted = PickParams(object_id=kind, for_place_id="desk")
        picked = _carry_out(runtime, context, wanted)
        if picked.status != "succeeded":
            planned = picked.failure is not None and picked.failure.code in PLANNERS
            return {"ok": False, "stage": "planning" if planned else "picking", "why": _why(picked)}
        placed = _carry_out(runtime, context, PlaceParams(object_id=kind, place_id="desk"))
        runtime.advance(1.0)
        after = oracle.X_WO(kind)
        lean = float(before.rotation()[:, 2] @ after.rotation()[:, 2])
        tilt_rad = math.acos(max(-1.0, min(1.0, lean)))
        on_desk = abs(after.p[0] + 1.6) < 0.32 and abs(after.p[2] - before.p[2]) < 0.02
        ok = on_desk and tilt_rad < TILT_RAD and placed.status == "succeeded" and _stands(runtime)
        why = _why(placed) or (
            "" if ok else f"at {after.p}, tilted by {math.degrees(tilt_rad):.0f}"
        )
        return {"ok": ok, "stage": "" if ok else "placing", "why": why,
                "time_s": round(runtime.clock.now_s(), 1)}  # fmt: skip


PLANNERS = (
    "no_grasp",
    "goal_in_collision",
    "out_of_reach",
    "no_stance",
    "no_path",
    "planner_timeout",
)


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


def _why(report: SkillReport) -> str:
    if report.failure is None:
        return "" if report.status == "succeeded" else f"{report.status} while {report.phase}"
    return f"{report.failure.code} while {report.phase}: {report.failure.cause}"


def moved(kind: str, variant: int, *, rest_s: float = REST_S) -> tuple[float, float]:
    """How far a thing creeps [m] and turns [rad] on a table, awake all the time."""
    item = thing(kind, variant=variant, on="table", at_m=(0.0, 0.0))
    world = World(
        name="rest",
        rooms=(Room(id="room", at_m=(0.0, 0.0), size_m=(3.0, 3.0)),),
        furniture=(Furniture(id="table", kind="table", at_m=(0.0, 0.0)),),
        objects=(item,),
    )
    spec = mujoco.MjSpec()
    assembly.set_physics(spec)
    spec.option.enableflags &= ~mujoco.mjtEnableBit.mjENBL_SLEEP.value
    assembly.furnish(spec, world)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 200)  # it settles on its soles: fractions of a millimetre
    body = data.body(f"object/{kind}")
    at, way = body.xpos.copy(), body.xmat.copy()
    mujoco.mj_step(model, data, nstep=round(rest_s / model.opt.timestep))
    cosine = (float(np.dot(way, body.xmat)) - 1.0) / 2.0
    return float(np.linalg.norm(body.xpos - at)), math.acos(max(-1.0, min(1.0, cosine)))


def _chosen(kinds: str) -> list[str]:
    return kinds.split(",") if kinds else list(catalogue.kinds())


@app.command()
def standing(*, kinds: str = "", variants: int = 2) -> None:
    """Stand each of them on a table for 10 s."""
    still = 0
    names = _chosen(kinds)
    for name in names:
        for variant in range(variants):
            by_m, by_rad = moved(name, variant)
            ok = by_m < STILL_M and by_rad < STILL_RAD
            still += ok
            if not ok:
                print(f"{name}/{variant}: {1000 * by_m:.1f} mm, {math.degrees(by_rad):.1f} degrees")
    print(f"{still} of {len(names) * variants} stand still for {REST_S:g} s")


@app.command()
def bringing(
    *,
    kinds: str = "",
    variants: int = 1,
    seeds: int = 1,
    processes: Annotated[int, typer.Option("-j", help="at a time")] = 1,
    name: Annotated[str, typer.Option(help="of the file of unfinished outcomes")] = "things",
) -> None:
    """Bring each of them from one table to another."""
    trials = [
        Trial(f"{kind}/{variant}/{seed}", "benchmarks.things:bring",
              {"kind": kind, "variant": variant, "seed": seed})
        for kind in _chosen(kinds) for variant in range(variants) for seed in range(seeds)
    ]  # fmt: skip
    print(render(campaign.run(name, trials, processes=processes)))


def render(outcomes: dict[str, Outcome]) -> str:
    """How many came, by family, and what became of the others."""
    of = {kind: family for family, kinds in catalogue.families().items() for kind in kinds}
    rows: list[list[str]] = []
    for family in catalogue.families():
        some = {key: one for key, one in outcomes.items() if of[key.partition("/")[0]] == family}
        left = [key for key, one in some.items() if not one.get("ok")]
        if some:
            rows.append([family, f"{len(some) - len(left)} of {len(some)}", ", ".join(left)])
    came = sum(bool(one.get("ok")) for one in outcomes.values())
    rows.append(["all", f"{came} of {len(outcomes)}", ""])
    reasons = [f"{key}: {one.get('stage', 'error')}: {one.get('why') or one.get('error', '')}"
               for key, one in outcomes.items() if not one.get("ok")]  # fmt: skip
    return table(["family", "brought", "not brought"], rows) + "\n\n" + "\n".join(reasons)


@app.command()
def speed(*, rounds: int = 3) -> None:
    """Time compiling, stepping and sensing of 30 things, beside as many primitives."""
    every = list(catalogue.kinds())
    names = [every[round(k * (len(every) - 1) / (MANY - 1))] for k in range(MANY)]
    names[MANY // 2] = TAKEN
    print(table(
        ["30 things", "compile, ms", "a step asleep, us", "1 s of standing, ms",
         "1 s of taking one, ms"],
        [[label, *_timed(names, real=real, rounds=rounds)]
         for label, real in (("primitives", False), ("real forms", True))],
    ))  # fmt: skip


def _timed(names: list[str], *, real: bool, rounds: int) -> list[str]:
    """Least of some rounds, processor time."""
    objects: list[Object] = []
    for number, name in enumerate(names):
        item = thing(name, variant=0, number=number + 1, on=f"table_{number // 6}",
                     at_m=(0.0, -0.9 + 0.36 * (number % 6)))  # fmt: skip
        if not real:
            shape = {"kind": "", "size_m": (item.size_m[0], item.size_m[0], item.size_m[2])}
            item = msgspec.structs.replace(item, **shape)
        objects.append(item)
    world = World(
        name="many",
        rooms=(Room(id="room", at_m=(0.0, 0.0), size_m=(14.0, 8.0)),),
        furniture=tuple(
            Furniture(
                id=f"table_{k}", kind="table", at_m=(-5.0 + 2.0 * k, 1.5), size_m=(0.8, 2.2, 0.72)
            )
            for k in range(5)
        ),
        objects=tuple(objects),
        start=Start(at_m=(0.0, -1.5), yaw_deg=90.0),
    )
    compiles, seconds, steps, taking = (list[float]() for _ in range(4))
    for _ in range(rounds):
        begin = time.process_time()
        spec = mujoco.MjSpec()
        assembly.set_physics(spec)
        assembly.furnish(spec, world)
        model = spec.compile()
        compiles.append(time.process_time() - begin)
        data = mujoco.MjData(model)
        mujoco.mj_step(model, data, nstep=2000)
        begin = time.process_time()
        mujoco.mj_step(model, data, nstep=1000)
        steps.append(time.process_time() - begin)
        with FastRuntime(SimulatedWorld(world), seed=0) as runtime:
            runtime.advance(3.0)  # until what stands there sleeps
            begin = time.process_time()
            runtime.advance(2.0)
            seconds.append((time.process_time() - begin) / 2.0)
        taking.append(_taking(world))
    found = (min(compiles), min(steps), min(seconds), min(taking))
    return [f"{1000 * one:.0f}" for one in found]


def _taking(world: World) -> float:
    """Processor time of a simulated second while one thing is found, taken and held."""
    robot = load("juno")
    with FastRuntime(SimulatedWorld(world), seed=0) as runtime:
        context = SkillContext(
            link=runtime.link, planner=InlinePlanner(robot), description=robot, seed=0
        )
        runtime.advance(0.5)
        taken = next(item.id for item in world.objects if item.id.startswith(TAKEN))
        begin = time.process_time()
        report = _carry_out(runtime, context, PickParams(object_id=taken))
        spent = time.process_time() - begin
        if report.status != "succeeded":
            print(f"{taken}: {_why(report)}")
        return spent / runtime.clock.now_s()


if __name__ == "__main__":
    app()
