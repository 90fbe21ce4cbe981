# pyright: basic
# SciPy ships no types.
"""Which goes to which, at the least sum of costs."""

from __future__ import annotations

from scipy.optimize import linear_sum_assignment

from robot.perception.people.scan import Array


def least_costs(costs: Array) -> list[tuple[int, int]]:
    """Rows and columns that belong together, each at most once: min(rows, columns) pairs."""
    rows, columns = linear_sum_assignment(costs)
    return list(zip(rows.tolist(), columns.tolist(), strict=True))
