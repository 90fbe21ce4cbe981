"""Why no path leads somewhere: the widest gap on the way, and what it is between."""

from __future__ import annotations

import numpy as np

from robot.failures import Failure, failure
from robot.planning import numerics
from robot.planning.floor import Floor
from robot.planning.floor_field import CELL_M
from robot.planning.numerics import Indices
from robot.planning.requests import Stance
from robot.se3 import Array

STEP_M = 0.01


def explain_no_path(floor: Floor, start: Stance, goal: Stance, *, needed_m: float) -> Failure:
    """The failure of a base path: how wide the widest way is, and what narrows it."""
    ends = np.array([start[:2], goal[:2]])
    wider: Indices | None = None
    for radius in np.arange(0.5 * needed_m, 0.0, -STEP_M).tolist():
        labels = floor.regions(radius)
        at = [floor.home(labels, *end) for end in ends.tolist()]
        if at[0] and at[0] == at[1]:
            place = ends.mean(axis=0) if wider is None else _meeting(floor, wider, labels, ends)
            names = _neighbours(floor, place)
            return failure(
                "no_path",
                f"the widest way is {2 * radius:.2f} m at {' and '.join(names)}; "
                f"the robot needs {needed_m:.2f} m",
                gap_m=2 * radius,
                needed_m=needed_m,
                blocked_by=", ".join(names),
                x_m=float(place[0]),
                y_m=float(place[1]),
            )
        wider = labels
    name = _first_hit(floor, start, goal)
    return failure(
        "no_path",
        f"{name} closes every way between ({start[0]:.1f}, {start[1]:.1f}) and "
        f"({goal[0]:.1f}, {goal[1]:.1f})",
        gap_m=0.0,
        needed_m=needed_m,
        blocked_by=name,
    )


def _meeting(floor: Floor, wider: Indices, labels: Indices, ends: Array) -> Array:
    """Where the two regions of the wider clearance meet through the narrower free space."""
    first, second = (floor.home(wider, *end) for end in ends.tolist())
    grown, target, free = wider == first, wider == second, labels > 0
    if not first or not second:
        return ends[0 if not first else 1]
    for _ in range(400):
        touching = numerics.grown(grown, inside=free)
        if (touching & target).any() or (touching == grown).all():
            break
        grown = touching
    met = np.argwhere(numerics.grown(target) & grown)
    cells = met if len(met) else np.argwhere(grown)
    row, column = cells[len(cells) // 2]
    return np.array([floor.bounds_m[0] + column * CELL_M, floor.bounds_m[1] + row * CELL_M])


def _neighbours(floor: Floor, place: Array) -> list[str]:
    """The two things nearest to a place."""
    ranked = sorted(
        (Floor.distance_m(solid, float(place[0]), float(place[1])), solid.id)
        for solid in floor.solids
    )
    return list(dict.fromkeys(name for _, name in ranked))[:2] or ["the edge of the map"]


def _first_hit(floor: Floor, start: Stance, goal: Stance) -> str:
    """What the straight line to the goal runs into first."""
    for share in np.linspace(0.0, 1.0, 200).tolist():
        x = start[0] + share * (goal[0] - start[0])
        y = start[1] + share * (goal[1] - start[1])
        if floor.clearance_m(x, y) <= 0.0:
            return floor.nearest(x, y)[0]
    return floor.nearest(goal[0], goal[1])[0]
