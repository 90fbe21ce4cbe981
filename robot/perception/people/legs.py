"""Which clusters of a scan are legs: by their shape, and by what always stands there."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from robot.perception.people.clusters import Cluster, clusters
from robot.perception.people.forest import leg_forest
from robot.perception.people.scan import PlanarScan
from robot.perception.people.shape import WIDEST_M, shape
from robot.perception.people.standing import UNKNOWN, StandingThings

FREE, STANDS = 2.0, -6.0
"""Evidence [nats] for a person where a place is free at other times, and where it never is."""
TELLS = 16.0
"""Evidence for each part of the time by which a place was free for longer than is expected."""
SUREST = 6.0


@dataclass(frozen=True, kw_only=True)
class Leg:
    """A cluster that may be a leg, or two that stand close together."""

    x_m: float
    y_m: float
    """The mean of its returns, in the laser's frame."""
    score: float
    """How likely it is of a person, 0 to 1, by this scan and what is known of the place."""


def legs(scan: PlanarScan, standing: StandingThings, *, at_least: float = 0.0) -> list[Leg]:
    """The clusters of a scan that are no wall, with their scores, counter-clockwise."""
    narrow = [cluster for cluster in clusters(scan) if _width_m(cluster) <= WIDEST_M]
    if not narrow:
        return []
    likely = leg_forest().probability(np.array([shape(scan, cluster) for cluster in narrow]))
    found: list[Leg] = []
    for cluster, probability in zip(narrow, likely.tolist(), strict=True):
        share = float(standing.share(scan, cluster.points_m).mean())
        moves = min(max(TELLS * (UNKNOWN - share), STANDS), FREE)
        evidence = _logit(probability) + moves
        score = 1.0 / (1.0 + math.exp(-evidence))
        if score >= at_least:
            x_m, y_m = cluster.centre_m.tolist()
            found.append(Leg(x_m=x_m, y_m=y_m, score=score))
    return found


def _width_m(cluster: Cluster) -> float:
    return float(np.linalg.norm(cluster.points_m[-1] - cluster.points_m[0]))


def _logit(probability: float) -> float:
    """Log-odds, at most `SUREST` either way."""
    bound = 1.0 / (1.0 + math.exp(SUREST))
    probability = min(max(probability, bound), 1.0 - bound)
    return math.log(probability / (1.0 - probability))
