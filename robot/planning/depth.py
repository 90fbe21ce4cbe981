"""How deep on a surface something stands, and how deep a hand comes there: words for a refusal."""

from __future__ import annotations

import numpy as np

from robot.failures import Failure, failure
from robot.model.handling import Reaching
from robot.planning.checks import END
from robot.planning.floor import Floor
from robot.planning.handling_problem import HandlingProblem
from robot.planning.solids import Solid
from robot.se3 import Array

ON_M = 0.02
"""Between the bottom of what stands on something and its top, at most."""


def too_deep(
    problem: HandlingProblem, floor: Floor, reaching: Reaching, *, blockers: list[str]
) -> Failure | None:
    """That a thing stands further from every edge than a hand comes; None: it is not that."""
    if problem.kind != "pick" or not reaching.deep_m:
        return None
    at = problem.references[0]
    support = _support(problem, at)
    if support is None or not set(blockers) <= {support.id, END}:
        return None
    from_edge_m, height_m = _from_edge_m(support, floor, at, reaching), support.z_range_m()[1]
    heights, depths = zip(*reaching.deep_m, strict=True)
    deep_m = float(np.interp(height_m, heights, depths))
    if not deep_m < from_edge_m < np.inf:
        return None
    return failure(
        "out_of_reach",
        f"{problem.what} stands {100 * from_edge_m:.0f} cm from the edge, {height_m:.2f} m up; "
        f"a hand comes {100 * deep_m:.0f} cm deep there",
        from_edge_m=from_edge_m,
        deep_m=deep_m,
        height_m=height_m,
    )


def _support(problem: HandlingProblem, at: Array) -> Solid | None:
    """The level box that the object stands on."""
    bottom_m = float(at[2]) - problem.below_m
    for solid in problem.others:
        x, y, _ = np.abs(np.array(solid.X_WG.inverse().apply((at[0], at[1], solid.X_WG.p[2]))))
        inside = x <= 0.5 * solid.size_m[0] and y <= 0.5 * solid.size_m[1]
        if solid.kind == "box" and inside and abs(solid.z_range_m()[1] - bottom_m) < ON_M:
            return solid
    return None


def _from_edge_m(support: Solid, floor: Floor, at: Array, reaching: Reaching) -> float:
    """From the nearest edge with room to stand before it [m]; infinite if there is none."""
    x, y, _ = support.X_WG.inverse().apply((at[0], at[1], support.X_WG.p[2]))
    half_x, half_y = 0.5 * support.size_m[0], 0.5 * support.size_m[1]
    off_m = reaching.stepping_in.beside_edge_m
    beside = [
        (half_x - x, (half_x + off_m, y, 0.0)),
        (half_x + x, (-half_x - off_m, y, 0.0)),
        (half_y - y, (x, half_y + off_m, 0.0)),
        (half_y + y, (x, -half_y - off_m, 0.0)),
    ]
    free = floor.clearances_m(np.array([support.X_WG.apply(p)[:2] for _, p in beside])) > 0.0
    found = [d for (d, _), ok in zip(beside, free.tolist(), strict=True) if ok]
    return float(min(found, default=np.inf))
