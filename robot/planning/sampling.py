# pyright: basic
"""The one place that knows OMPL: bidirectional sampling with a budget of checks, from a seed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from ompl import base, geometric, util

from robot.se3 import Array

util.noOutputHandler()


@dataclass(frozen=True, slots=True)
class Found:
    """A path as its corners, shape (k, n), or None; `checks` is the work it took."""

    corners: Array | None
    checks: int


def connect(
    start: Array,
    goals: list[Array],
    *,
    lower: Array,
    upper: Array,
    valid: Callable[[list[float]], bool],
    resolution: float,
    seed: int,
    checks: int,
) -> Found:
    """A short path of straight lines from `start` to one of `goals` (RRT-Connect, shortcut).

    The same arguments give the same path. OMPL keeps its seed in a global: one call at a time.

    Args:
        start: a valid state, shape (n,).
        goals: valid states.
        lower: bounds of the space, shape (n,).
        upper: the same.
        valid: whether a state is free.
        resolution: distance between checked states, in the Euclidean norm of the space.
        seed: of the random numbers.
        checks: how many states may be checked before giving up; simplifying may take as many.
    """
    util.RNG.setSeed(seed % 1_000_000 + 1)
    size = len(start)
    space = base.RealVectorStateSpace(size)
    bounds = base.RealVectorBounds(size)
    for axis in range(size):
        bounds.setLow(axis, float(min(lower[axis], start[axis])))
        bounds.setHigh(axis, float(max(upper[axis], start[axis])))
    space.setBounds(bounds)
    used = 0
    axes = range(size)

    def check(state: Any) -> bool:
        nonlocal used
        used += 1
        return valid([state[axis] for axis in axes])

    setup = geometric.SimpleSetup(space)
    information = setup.getSpaceInformation()
    setup.setStateValidityChecker(check)
    information.setStateValidityCheckingResolution(resolution / space.getMaximumExtent())
    setup.setStartState(_state(space, start))
    goal = base.GoalStates(information)
    for values in goals:
        goal.addState(_state(space, values))
    setup.setGoal(goal)
    setup.setPlanner(geometric.RRTConnect(information))
    setup.solve(base.PlannerTerminationCondition(lambda: used >= checks))
    if not setup.haveExactSolutionPath():
        return Found(None, used)
    path = setup.getSolutionPath()
    simplifier = geometric.PathSimplifier(information)
    simplifier.reduceVertices(path)
    for _ in range(2):
        simplifier.partialShortcutPath(path, 40, 20)
        simplifier.reduceVertices(path)
    simplifier.collapseCloseVertices(path)
    states: Any = path.getStates()
    corners = np.array([[state[axis] for axis in axes] for state in states])
    return Found(corners, used)


def _state(space: base.RealVectorStateSpace, values: Array) -> Any:
    state: Any = space.allocState()
    for axis, value in enumerate(values):
        state[axis] = float(value)
    return state
