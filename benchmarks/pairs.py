"""Whether every object can be taken from every surface and put on every other, by plans alone.

Each pair of surfaces is one chain of plans, as in `benchmarks.planning`; the object stands where
an arm may reach it, at most `DEEP_M` behind the front edge, or where the planner would put it.

    python -m benchmarks.pairs --world kitchen
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
import typer

from benchmarks import planning
from benchmarks.planning import Robot, Study
from robot.messages import ObjectInfo, Place
from robot.model import description
from robot.planning.requests import Held, ObjectPose, PickPlan
from robot.planning.solve import Solver
from robot.se3 import SE3
from sim.simulation import Simulation

DEEP_M = 0.28
HEAD_ROOM_M = 0.03
app = typer.Typer(add_completion=False)


def near_front(study: Study, info: ObjectInfo, on: Place) -> ObjectPose:
    """The object near the front edge of a place, anywhere along it."""
    x_m, y_m, _ = planning.somewhere(study, info, on).X_WO.p
    x, y, z = on.X_WP.inverse().apply((x_m, y_m, on.X_WP.p[2]))
    deepest = 0.5 * on.size_m[0] - DEEP_M
    outmost = 0.5 * on.size_m[0] - 0.5 * info.shape.size_m[0] - planning.EDGE_M
    x = float(study.rng.uniform(min(deepest, outmost), outmost)) if deepest > x else x
    z += 0.5 * info.shape.size_m[2] - info.shape.X_BodyShape.p[2]
    turn = float(study.rng.uniform(-np.pi, np.pi))
    X_WO = on.X_WP @ SE3.from_xy_yaw(x, y, turn, z_m=z)
    return ObjectPose(id=info.id, shape=info.shape, X_WO=X_WO)


def taken(study: Study, info: ObjectInfo, on: Place) -> PickPlan | None:
    """Take an object from a place; None if no chain holds."""
    plans: list[PickPlan] = []
    robot = Robot(study.solver.body, planning.start_stance(study.map))
    thing = near_front(study, info, on)
    planning.attempt(
        study,
        f"{info.id} from {on.id}",
        lambda: plans.append(planning.pick(study, robot, thing, ())),
    )
    return plans[0] if plans else None


def put(study: Study, info: ObjectInfo, plan: PickPlan, on: Place) -> bool:
    """Put what a plan took on a place."""
    held = Held(id=info.id, shape=info.shape, X_GO=plan.X_OG.inverse())
    robot = Robot(study.solver.body, plan.standoff)
    robot.arms[plan.side], robot.openings[plan.side] = plan.carry_rad, plan.opening_m
    return planning.attempt(
        study,
        f"{info.id} to {on.id}",
        lambda: planning.place(study, robot, on, held=held, side=plan.side),
    )


@app.command()
def main(
    *,
    world: Annotated[str, typer.Option(help="a world")] = "kitchen",
    times: Annotated[int, typer.Option(help="chains for each object and pair of surfaces")] = 1,
    object_id: Annotated[str, typer.Option(help="only this object")] = "",
    seed: Annotated[int, typer.Option()] = 0,
) -> None:
    """Study every object, from every surface to every other that it fits under."""
    solver = Solver(description.load())
    study = Study(solver, Simulation().world(world).map, np.random.default_rng(seed))
    surfaces = [place for place in study.map.places if not place.floor]
    surfaces = list({place.X_WP.p: place for place in surfaces}.values())
    for info in study.map.objects:
        if object_id not in ("", info.id):
            continue
        roomy = [on for on in surfaces if on.clearance_m > info.shape.size_m[2] + HEAD_ROOM_M]
        for source in roomy * times:
            plan = taken(study, info, source)
            for target in roomy:
                if plan is not None and target.id != source.id:
                    put(study, info, plan, target)
    planning.report(study)


if __name__ == "__main__":
    app()
