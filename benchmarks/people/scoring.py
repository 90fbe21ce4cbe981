"""How well legs are found, against labels that were made automatically.

The labels of such recordings are every cluster of returns in a sector ahead (15 degrees to each
side, 5 m) in which nothing but the walking person was: whatever is in there counts as legs, an edge
of a door too, and what walks elsewhere is not labelled. So precision is told twice: of what was
found in the sector, and, as an upper bound of what is wrong, how much was found outside, where real
people who are not labelled walk as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from robot.perception.people.assignment import least_costs
from robot.perception.people.finder import Found
from robot.perception.people.scan import Array

MATCH_M = 0.3
SECTOR_RAD, SECTOR_M = np.radians(15.0), 5.0


@dataclass(frozen=True, kw_only=True)
class Score:
    """Counts over a recording."""

    scans: int
    labels: int
    matched: int
    wrong: int
    """Found in the labelled sector, matched by no label."""
    outside: int
    """Found elsewhere: people who are not labelled, and mistakes."""

    @property
    def recall(self) -> float:
        """Share of the labels that were found."""
        return self.matched / max(1, self.labels)

    @property
    def precision(self) -> float:
        """Share of what was found in the sector that is labelled."""
        return self.matched / max(1, self.matched + self.wrong)


def read_labels(path: Path) -> Array:
    """Labelled legs [m] of each scan, NaN where there are fewer, shape (scans, most, 2)."""
    with np.load(path, allow_pickle=False) as arrays:
        return arrays["legs_xy"]


def score(found: Sequence[Found], labels: Array) -> Score:
    """Match each leg with at most one label, `MATCH_M` away at most."""
    matched = wrong = outside = count = 0
    for one, row in zip(found, labels, strict=True):
        labelled_m = row[np.isfinite(row).all(axis=-1)]
        legs_m = np.array([(leg.x, leg.y) for leg in one.legs]).reshape(-1, 2)
        far_m = np.linalg.norm(legs_m[:, None] - labelled_m[None], axis=-1)
        costs = np.where(far_m <= MATCH_M, far_m, 1e3)
        good = {leg for leg, label in least_costs(costs) if costs[leg, label] <= MATCH_M}
        inside = np.abs(np.arctan2(legs_m[:, 1], legs_m[:, 0])) < SECTOR_RAD
        inside &= np.linalg.norm(legs_m, axis=1) < SECTOR_M
        count += len(labelled_m)
        matched += len(good)
        wrong += sum(bool(inside[leg]) for leg in range(len(legs_m)) if leg not in good)
        outside += sum(not inside[leg] for leg in range(len(legs_m)) if leg not in good)
    return Score(scans=len(found), labels=count, matched=matched, wrong=wrong, outside=outside)
