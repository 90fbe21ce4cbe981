"""Things over several looks: where they are believed to be, what they look like, which are gone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from robot.perception.sight.measuring import Measured
from robot.perception.things.eyes import SeenThing
from robot.perception.things.inputs import Sight
from robot.perception.things.votes import NEAR_M, NEAR_SIGMAS, SHARED
from robot.se3 import Array, Vector3

WANDER_M = 0.002
"""How far a thing, or the robot's idea of where it is itself, may have moved between two looks."""
MOVED_SIGMAS = 4.0
"""What is seen so far from where it was has been moved."""
SURE_PX = 400.0
"""A look with as many pixels counts fully for what a thing is, one with fewer less."""
FADE = 0.9
"""What a look before counts, to the one after it."""
LEAST_SIGMA_M = 0.002
FIRST = 10.0
"""How much less is known before the first look than after it."""
EMPTY_M, EMPTY_SHARE = 0.04, 0.8
"""What is seen so far behind the middle of a thing, by so much of the pixels there, tells that it
is not there."""
MISSES = 3
"""So often in a row, and it is gone."""
ASIDE_M = 0.025
"""So far aside a thing may be seen from elsewhere, as the robot errs in where it is itself: what is
there counts for it."""
EDGE_PX = 8
FORM_M = 1.25
"""From further away a thing's side says little of whether it is round (`sight/form.py`)."""
FORGET_ONCE_S = 4.0
"""What was seen only once may have been nothing."""


@dataclass
class Seen:
    """One thing over several looks.

    Attributes:
        number: of the track, from 1.
        last: as it was seen last.
        p_W, covariance_W: of its middle [m], [m²].
        size_m, size_sigma_m: its sides, its height, and its width across the line of sight.
        seen_s: when it was seen last.
        looks: how often.
        free_looks: how often away from hands that hold something.
        near_looks: how often from so near that its form can be told, with nothing before it, and
            not at a hand that holds something.
        colour_looks: how often its colours were, in a hand too.
    """

    number: int
    last: Measured
    p_W: Array
    covariance_W: Array
    size_m: Array
    size_sigma_m: float
    seen_s: float
    looks: int = 0
    near_looks: int = 0
    free_looks: int = 0
    misses: int = 0
    colour_looks: int = 0
    _logs: Array = field(default_factory=lambda: np.zeros(0))
    _sizes: Array = field(default_factory=lambda: np.zeros(3))
    _weight: float = 0.0
    _count: float = 0.0
    _coloured: float = 0.0
    _round: float = 0.0
    _warm: float = 0.0
    _colours: dict[str, float] = field(default_factory=dict[str, float])

    def add(self, found: Measured, now_s: float) -> None:
        """One more look."""
        self._vote(found)
        own = found.covariance_W + np.eye(3) * LEAST_SIGMA_M**2
        before = self.covariance_W + np.eye(3) * WANDER_M**2
        off = found.p_W - self.p_W
        sigmas = math.sqrt(float(off @ np.linalg.solve(own + before, off)))
        if sigmas > MOVED_SIGMAS and found.is_whole:
            self.p_W, self.covariance_W = found.p_W, own
        else:
            gain = before @ np.linalg.inv(own + before)
            self.p_W = self.p_W + gain @ off
            self.covariance_W = (np.eye(3) - gain) @ before
        theirs = found.size_sigma_m**2
        mine = self.size_sigma_m**2 + 0.0005**2
        share = mine / (mine + theirs)
        self.size_m = self.size_m + share * (_sizes(found) - self.size_m)
        self.size_sigma_m = math.sqrt((1.0 - share) * mine)
        self.looks, self.misses = self.looks + 1, 0
        near = found.seen.range_m < FORM_M and not found.is_at_hand
        self.near_looks += near and found.is_whole
        self.free_looks += not found.is_at_hand
        self.seen_s, self.last = now_s, found

    def _vote(self, found: Measured) -> None:
        seen = found.seen
        weight = _weight(seen) * (1.0 if found.is_whole else 0.3)
        logs = np.log(np.maximum(seen.chances, 1e-4))
        self._logs = weight * logs if not self.looks else FADE * self._logs + weight * logs
        self._sizes = FADE * self._sizes + weight * np.log(np.array(seen.size_m))
        self._weight = FADE * self._weight + weight
        self._count = FADE * self._count + 1.0
        self._round = FADE * self._round + weight * found.roundness
        self._vote_colours(seen, weight)

    def add_colours(self, seen: SeenThing) -> None:
        """One more look that tells of its colours alone: fingers are around it."""
        self._vote_colours(seen, _weight(seen))

    def _vote_colours(self, seen: SeenThing, weight: float) -> None:
        self._colours = {word: FADE * counted for word, counted in self._colours.items()}
        self.colour_looks += 1
        self._coloured = FADE * self._coloured + weight
        self._warm = FADE * self._warm + weight * seen.warmth
        for word, counts in zip(seen.colours, (1.0, 0.6), strict=False):
            self._colours[word] = self._colours.get(word, 0.0) + weight * counts

    @property
    def chances(self) -> Array:
        """Probabilities of the namer's classes, over all looks."""
        mean = self._logs / max(self._weight, 1e-9)
        power = self._count / (SHARED * self._count + 1.0 - SHARED)
        raised = np.exp((mean - mean.max()) * power)
        return raised / raised.sum()

    @property
    def looks_m(self) -> Vector3:
        """Longer side, shorter side and height as the namer tells them, over all looks."""
        x, y, z = np.exp(self._sizes / max(self._weight, 1e-9)).tolist()
        return x, y, z

    @property
    def support(self) -> float:
        """How many looks with all pixels (`SURE_PX`) it was seen in; the last ones count most."""
        return self._weight

    @property
    def roundness(self) -> float:
        """How much likelier it is round than a box, in logarithms, over all looks."""
        power = self._count / (SHARED * self._count + 1.0 - SHARED)
        return self._round / max(self._weight, 1e-9) * power

    def colour_share(self, word: str) -> float:
        """How much of what was seen of it has a colour, 0 to 1."""
        return self._colours.get(word, 0.0) / max(self._coloured, 1e-9)

    @property
    def warmth(self) -> float:
        """How much of the hue of cream it has, over all looks."""
        return self._warm / max(self._coloured, 1e-9)

    @property
    def colours(self) -> tuple[str, ...]:
        """Its colours, the one that was seen most first."""
        return tuple(sorted(self._colours, key=lambda word: -self._colours[word])[:2])


class Tracks:
    """Everything that stands somewhere and was seen."""

    def __init__(self) -> None:
        """Start without any."""
        self.things: list[Seen] = []
        self._numbers = 0

    def add(self, found: Sequence[Measured], now_s: float) -> list[Seen]:
        """Take one picture's things; the track of each, in their order."""
        pairs = sorted(
            (away_m, row, column)
            for row, one in enumerate(found)
            for column, track in enumerate(self.things)
            if (away_m := _away_m(one, track)) is not None
        )
        mine: dict[int, Seen] = {}
        taken: set[int] = set()
        for _, row, column in pairs:
            if row not in mine and column not in taken:
                mine[row] = self.things[column]
                taken.add(column)
        return [self._taken(one, mine.get(row), now_s) for row, one in enumerate(found)]

    def _taken(self, one: Measured, track: Seen | None, now_s: float) -> Seen:
        if track is None:
            self._numbers += 1
            size, sigma_m = _sizes(one), FIRST * one.size_sigma_m
            covariance = FIRST**2 * one.covariance_W
            track = Seen(self._numbers, one, one.p_W, covariance, size, sigma_m, now_s)
            self.things.append(track)
        track.add(one, now_s)
        return track

    def miss(self, view: Sight, seen: Sequence[Seen], now_s: float) -> list[Seen]:
        """Those whose place is in view and empty; who was missed `MISSES` times is forgotten."""
        there = {track.number for track in seen}
        missed = [
            track for track in self.things if track.number not in there and _is_empty(view, track)
        ]
        for track in missed:
            track.misses += 1
        self.things = [
            track
            for track in self.things
            if track.misses < MISSES and (track.looks > 1 or now_s - track.seen_s < FORGET_ONCE_S)
        ]
        return missed


def _weight(seen: SeenThing) -> float:
    """How much a look counts for what a thing is."""
    return min(1.0, float(seen.pixels.sum()) / SURE_PX)


def _sizes(one: Measured) -> Array:
    return np.array([*one.size_m, one.width_m])


def _away_m(one: Measured, track: Seen) -> float | None:
    """How far something seen is from a thing; None if it cannot be that."""
    off = one.p_W - track.p_W
    away_m = float(np.linalg.norm(off))
    if away_m > 3.0 * NEAR_M:
        return None
    both = one.covariance_W + track.covariance_W + np.eye(3) * LEAST_SIGMA_M**2
    sigmas = math.sqrt(float(off @ np.linalg.solve(both, off)))
    return away_m if away_m < NEAR_M or sigmas < NEAR_SIGMAS else None


def _is_empty(view: Sight, track: Seen) -> bool:
    """Whether a picture shows what is behind the place of a thing."""
    x, y, z = view.X_WC.inverse().apply(tuple(track.p_W.tolist()))
    if z < 0.25:
        return False
    column = round(view.focal_px * x / z + view.centre_px[0])
    row = round(view.focal_px * y / z + view.centre_px[1])
    least_m: float = min(track.size_m.tolist())
    sigma_m = math.sqrt(float(track.covariance_W[0, 0] + track.covariance_W[1, 1]))
    high = max(1, round(0.25 * view.focal_px * least_m / z))
    wide = max(1, round(view.focal_px * (0.25 * least_m + ASIDE_M + sigma_m) / z))
    height, width = view.depth_m.shape
    if not (EDGE_PX + wide <= column < width - EDGE_PX - wide):
        return False
    if not (EDGE_PX + high <= row < height - EDGE_PX - high):
        return False
    patch = view.depth_m[row - high : row + high + 1, column - wide : column + wide + 1]
    there = patch[patch > 0.0]
    behind = int(np.count_nonzero(there > z + EMPTY_M))
    return len(there) > 0.5 * patch.size and behind > EMPTY_SHARE * len(there)
