"""What has been looked over and what has not: points of surfaces, and what each is worth to see.

Only a ledger: what was seen well is for the world model to say, and where to look from for the
planner. A point that twice did not show from where it should have is hidden by things on the
surface, and is let be.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Sequence
from itertools import islice

import msgspec
import numpy as np
from numpy.typing import NDArray

from robot.messages import Looked, Place
from robot.se3 import Vector3

Rows = NDArray[np.intp]

TRIES = 2
AROUND_M = ((0.0, 0.0), (0.5, 0.0), (-0.5, 0.0), (0.0, 0.5), (0.0, -0.5))
FLOOR_M = 0.02
FLOOR_WORTH = 0.5
ENOUGH = 0.7
"""A surface of which this part was seen has been looked at: what stands on it hides some of it."""
MOST_NAMES = 8


class Prospect(msgspec.Struct, frozen=True, kw_only=True):
    """A surface to look over: the higher its `worth` the sooner, those of a lower `rank` before."""

    place: Place
    worth: float = 1.0
    rank: int = 0


class Survey:
    """Points still to be looked at.

    Attributes:
        places: the surfaces it is about.
    """

    def __init__(
        self,
        prospects: Iterable[Prospect],
        *,
        since_s: float = -math.inf,
        fallen_from: Vector3 | None = None,
    ) -> None:
        """Begin with every point left.

        Args:
            prospects: the surfaces.
            since_s: what was seen before counts as not seen.
            fallen_from: the floor around where something may have fallen from is looked at too.
        """
        prospects = list(prospects)
        self.places = tuple(prospect.place for prospect in prospects)
        self._since_s = since_s
        points, worth, ranks = [np.zeros((0, 3))], [np.zeros(0)], [np.zeros(0)]
        self._rows: dict[str, slice] = {}
        count = 0
        for prospect in prospects:
            samples = prospect.place.samples()
            self._rows[prospect.place.id] = slice(count, count + len(samples))
            count += len(samples)
            points.append(samples)
            worth.append(np.full(len(samples), prospect.worth / math.sqrt(len(samples))))
            ranks.append(np.full(len(samples), prospect.rank))
        if fallen_from is not None:
            x_m, y_m, _ = fallen_from
            points.append(np.array([(x_m + dx, y_m + dy, FLOOR_M) for dx, dy in AROUND_M]))
            worth.append(np.full(len(AROUND_M), FLOOR_WORTH))
            ranks.append(np.zeros(len(AROUND_M)))
        self._points, self._worth = np.concatenate(points), np.concatenate(worth)
        self._ranks = np.concatenate(ranks)
        self._floor = np.arange(len(self._points)) >= count
        self._seen, self._given_up, self._cut_off = np.zeros((3, len(self._points)), dtype=bool)
        self._tries = np.zeros(len(self._points), dtype=int)
        self._vain_m: dict[int, tuple[float, float]] = {}

    # --- what is left ---

    @property
    def left(self) -> Rows:
        """Rows of the points to look at now: of the lowest rank of which any is left."""
        open_ = ~self._seen & ~self._given_up
        if not open_.any():
            return np.flatnonzero(open_)
        return np.flatnonzero(open_ & (self._ranks == self._ranks[open_].min()))

    def points_W(self, rows: Rows) -> tuple[Vector3, ...]:
        """Where they are [m]."""
        return tuple((x, y, z) for x, y, z in self._points[rows].tolist())

    def worth(self, rows: Rows) -> tuple[float, ...]:
        """What it is worth to see each of them."""
        return tuple(self._worth[rows].tolist())

    def vain_m(self, rows: Rows) -> dict[int, tuple[float, float]]:
        """From where on the floor those of some rows did not show, by their place among them."""
        found = {k: self._vain_m.get(row) for k, row in enumerate(rows.tolist())}
        return {k: at for k, at in found.items() if at is not None}

    def names(self, rows: Rows) -> str:
        """What they belong to, for people."""
        found = [p.name for p in self.places if self._touches(p, rows)]
        return _listed([f"the {name}" for name in found]) if found else "the floor"

    def unseen(self, rows: Rows) -> bool:
        """Whether any of these has not been seen."""
        return not bool(self._seen[rows].all())

    # --- what happens to them ---

    def favour(self, p_W: Sequence[float], *, within_m: float, factor: float) -> None:
        """Make the points near another one worth more."""
        near = np.linalg.norm(self._points - np.array(p_W), axis=1) < within_m
        self._worth[near] *= factor

    def take(self, looked: Iterable[Looked]) -> None:
        """Take what the world model has seen, and no more where it cannot make something out."""
        for one in looked:
            rows = self._rows.get(one.place_id)
            if rows is not None and rows.stop - rows.start == len(one.seen_s):
                seen_s = np.array(one.seen_s)
                self._seen[rows] = (seen_s >= self._since_s) & np.isfinite(seen_s)

    def tried(self, rows: Rows, at_m: tuple[float, float]) -> None:
        """A view of them, from a place on the floor, is over; what never shows is let be."""
        self._seen[rows] |= self._floor[rows]  # the world model keeps no floor
        self._tries[rows] += 1
        self._vain_m.update(dict.fromkeys(rows.tolist(), at_m))
        self._given_up |= self._tries >= TRIES

    def give_up(self, rows: Rows) -> None:
        """Let them be: they can be seen from nowhere."""
        self._given_up[rows] = True

    def cut_off(self, rows: Rows) -> None:
        """No way leads to where they could be seen from."""
        self._cut_off[rows] = True

    # --- what has come of it ---

    def seen_share(self, place: Place) -> float:
        """How much of a place has been seen, 0 to 1."""
        rows = self._rows[place.id]
        return float(np.count_nonzero(self._seen[rows])) / (rows.stop - rows.start)

    def unseen_W(self, place: Place) -> NDArray[np.float64]:
        """The points of a place that have not been seen [m], shape (n, 3)."""
        rows = self._rows[place.id]
        return self._points[rows][~self._seen[rows]]

    def is_cut_off(self, place: Place) -> bool:
        """Whether no way leads to where any of it could be seen from."""
        return bool(self._cut_off[self._rows[place.id]].any()) and not self.seen_share(place)

    def words(self) -> str:
        """Where it was looked and where not, for people: "looked on the desk; ...".

        The boards of one piece of furniture are named together.
        """
        done = [place for place in self.places if self.seen_share(place) >= ENOUGH]
        partly = [place for place in self.places if 0.0 < self.seen_share(place) < ENOUGH]
        closed = [place for place in self.places if self.is_cut_off(place)]
        nothing = [place for place in self.places if not self.seen_share(place)]
        hidden = [place for place in nothing if place not in closed]
        named = self._named
        parts = [
            f"looked on {_listed(named(done))}" if done else "",
            f"saw only a part of {_listed(named(partly))}" if partly else "",
            f"could not see {_listed(named(hidden))}" if hidden else "",
            f"no way leads to {_listed(named(closed))}" if closed else "",
        ]
        return "; ".join(part for part in parts if part) or "looked around"

    def _named(self, places: list[Place]) -> list[str]:
        boards: dict[str, list[Place]] = defaultdict(list)
        for place in self.places:
            boards[place.of or place.id].append(place)
        names: dict[str, None] = {}
        for place in places:
            whole = boards[place.of or place.id]
            together = len(whole) > 1 and all(board in places for board in whole)
            names[_together(whole) if together else f"the {place.name}"] = None
        return list(names)

    def _touches(self, place: Place, rows: Rows) -> bool:
        own = self._rows[place.id]
        return bool(((rows >= own.start) & (rows < own.stop)).any())


def _together(boards: list[Place]) -> str:
    """All boards of a piece of furniture: "both boards of the bookcase"."""
    count = "both" if len(boards) == 2 else f"all {len(boards)}"
    return f"{count} boards of the {boards[0].of.replace('_', ' ')}"


def _listed(names: Sequence[str]) -> str:
    """As in "the desk, the bed and the shelf"; of many the first ones and how many more."""
    first = list(islice(names, MOST_NAMES))
    more = len(names) - len(first)
    *others, last = [*first, f"{more} more"] if more else first
    return f"{', '.join(others)} and {last}" if others else last
