"""Several looks at one thing: they vote for its name, and its place gets surer."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from robot.perception.things.eyes import SeenThing
from robot.perception.things.naming import Classes, Name, Sure
from robot.se3 import Array, Vector3

NEAR_M, NEAR_SIGMAS = 0.06, 3.0
"""What is seen so near to where a thing was is that thing."""
SHARED = 0.6
"""How much of the error of one look is that of the next one too: the share of its variance that
more looks do not take away, and of the evidence that they do not add."""
LEAST_LOOKS = 3
"""Before that a kind is not believed."""


@dataclass
class Sighted:
    """One thing over several looks.

    Attributes:
        p_W, covariance_W: where it is [m], [m²].
        looks: how often it was seen.
        last: as it was seen last.
    """

    p_W: Array
    covariance_W: Array
    last: SeenThing
    looks: int = 0
    _logs: Array = field(default_factory=lambda: np.zeros(0))
    _sizes: Array = field(default_factory=lambda: np.zeros(3))
    _pixels: float = 0.0
    _information: Array = field(default_factory=lambda: np.zeros((3, 3)))
    _weighted: Array = field(default_factory=lambda: np.zeros(3))
    _floor: Array = field(default_factory=lambda: np.zeros((3, 3)))

    def add(self, seen: SeenThing) -> None:
        """One more look."""
        logs = np.log(np.maximum(seen.chances, 1e-6))
        self._logs = logs if not self.looks else self._logs + logs
        pixels = float(seen.pixels.sum())
        self._sizes = self._sizes + pixels * np.log(np.array(seen.size_m))
        self._pixels += pixels
        precision = np.linalg.inv(seen.covariance_W)
        self._information = self._information + precision
        self._weighted = self._weighted + precision @ seen.p_W
        if not self.looks or np.trace(seen.covariance_W) < np.trace(self._floor):
            self._floor = seen.covariance_W
        self.looks += 1
        self.last = seen
        pooled = np.linalg.inv(self._information)
        self.p_W = pooled @ self._weighted
        self.covariance_W = pooled + SHARED * (1.0 - 1.0 / self.looks) * self._floor

    @property
    def size_m(self) -> Vector3:
        """As it looks on the whole, looks with more pixels counting more."""
        x, y, z = np.exp(self._sizes / self._pixels).tolist()
        return x, y, z

    @property
    def chances(self) -> Array:
        """Probabilities of the classes: a geometric mean of all looks, and sharper than that."""
        power = 1.0 / (SHARED * self.looks + 1.0 - SHARED)
        raised = np.exp((self._logs - self._logs.max()) * power)
        return raised / raised.sum()

    def name(self, classes: Classes, sure: Sure) -> Name:
        """What it is taken for by now."""
        name = classes.name(self.chances, sure, self.size_m)
        if name.kind and self.looks < LEAST_LOOKS:
            return Name("", name.family, name.score)
        return name


class Votes:
    """Every thing that was seen since the beginning."""

    def __init__(self) -> None:
        """Start without any."""
        self.things: list[Sighted] = []

    def add(self, looked: list[SeenThing]) -> list[Sighted]:
        """Take one picture's things; the tracked thing of each, in their order."""
        taken: set[int] = set()
        found: list[Sighted] = []
        for seen in looked:
            track = self._nearest(seen, taken)
            if track is None:
                track = Sighted(seen.p_W, seen.covariance_W, seen)
                self.things.append(track)
            taken.add(id(track))
            track.add(seen)
            found.append(track)
        return found

    def _nearest(self, seen: SeenThing, taken: set[int]) -> Sighted | None:
        best, least = None, np.inf
        for track in self.things:
            if id(track) in taken:
                continue
            off = seen.p_W - track.p_W
            away_m = float(np.linalg.norm(off))
            sigmas = float(
                np.sqrt(off @ np.linalg.solve(seen.covariance_W + track.covariance_W, off))
            )
            near = away_m < NEAR_M or (sigmas < NEAR_SIGMAS and away_m < 3.0 * NEAR_M)
            if near and away_m < least:
                best, least = track, away_m
        return best
