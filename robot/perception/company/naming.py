"""Whose name somebody has: who is where an owner told, or the only one that it can be.

Nobody's face is known. A name is kept with the track that has it; who is lost and comes back gets
it again where nobody else can be meant. All others are "a person".
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from robot.perception.company.tracking import Somebody
from robot.se3 import Array

AT_M, APART_M = 1.2, 0.5
"""Who is as near to where somebody was told to be, and as much nearer than to any other's place."""
SETTLED_S = 1.0
"""Believed for so long, who is elsewhere gets the name of the only one who is not accounted for."""


class Names:
    """Of the told people, by their ids."""

    def __init__(self) -> None:
        """Nobody was told of."""
        self._told: dict[str, Array] = {}
        self._away: set[str] = set()
        self._of: dict[int, str] = {}

    def tell(self, places: Mapping[str, Sequence[float]]) -> None:
        """Take where people were told to be."""
        for id, p_W in places.items():
            self._told.setdefault(id, np.array(p_W[:2]))

    def empty(self, id: str) -> None:
        """Take it that somebody is not where they were told to be."""
        self._away.add(id)

    def of(self, track: Somebody) -> str:
        """The id of a told one, "" of an unknown one."""
        return self._of.get(track.number, "")

    def settle(self, believed: Sequence[Somebody], now_s: float) -> None:
        """Give names to who has none."""
        numbers = {track.number for track in believed}
        for number in [number for number in self._of if number not in numbers]:
            self._told[self._of[number]] = self._told[self._of[number]]
            del self._of[number]
        for track in sorted(believed, key=lambda track: track.number):
            if track.number not in self._of and (id := self._meant(track, now_s)):
                self._of[track.number] = id
                self._away.discard(id)

    def left(self, track: Somebody) -> None:
        """Take it that somebody was seen to have left their place."""
        id = self._of.pop(track.number, "")
        if id:
            self._told[id] = track.p_W.copy()
            self._away.add(id)

    def _meant(self, track: Somebody, now_s: float) -> str:
        free = [id for id in self._told if id not in self._of.values()]
        if not free:
            return ""
        if len(self._told) == 1:
            return free[0]
        by_m = sorted((float(math.dist(self._told[id], track.p_W)), id) for id in free)
        nearest_m, id = by_m[0]
        if nearest_m < AT_M and (len(by_m) == 1 or by_m[1][0] > nearest_m + APART_M):
            return id
        away = [id for id in free if id in self._away]
        if now_s - track.believed_s < SETTLED_S:
            return ""
        if len(free) == 1:
            return free[0]
        return away[0] if len(away) == 1 else ""
