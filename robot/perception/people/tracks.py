"""Persons followed from scan to scan: a Kalman filter of constant velocity for each of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import count

import numpy as np

from robot.perception.people.assignment import least_costs
from robot.perception.people.legs import Leg
from robot.perception.people.scan import Array

# Compared on three recordings at a time, the fourth left out (docs/perception.md).
PUSH_M_S2 = 2.5
"""Standard deviation of how a person speeds up or turns, taken as white between scans."""
OFF_M = 0.12
"""How far the mean of the legs in view is from the person: half a stride, one leg may be hidden."""
NEAR_M, NEAREST_PERSON_M = 0.6, 0.55
"""A leg further than this from where a person must be by now is not theirs; nor are two legs that
are further from each other: a stride of an adult, 1.1 m, has its feet so far from the middle."""
START_M_S = 1.0
LEAST_START = 0.5
"""A leg less likely than this goes on with a person, and begins none."""
FORGET_S = 1.0
FORGET_KNOWN_S = 2.5
SURE = 3
"""Scans in which a person was seen, to be no blink."""
WALKED_M = 0.4
"""Further than somebody who stands sways, or a chair is pushed by a knee."""
LIKELY = 0.6
"""Of the legs of a person on average: what seems to walk where beams flicker between two things
that stand is less likely than that."""


@dataclass
class Track:
    """A person, as far as known."""

    id: int
    state: Array
    """x, y [m], velocity x, y [m/s], in the frame of the place."""
    covariance: Array
    seen_s: float
    begun_m: Array
    scores: list[float] = field(default_factory=list[float])
    walked_m: float = 0.0
    """The furthest that the person was from where it was seen first."""

    @property
    def believed(self) -> bool:
        """Whether this is a person, and not a chair or a blink."""
        if len(self.scores) < SURE or self.walked_m < WALKED_M:
            return False
        return float(np.mean(self.scores)) >= LIKELY

    @property
    def score(self) -> float:
        """How likely the legs of this person were, of late."""
        return float(np.mean(self.scores[-10:]))

    def advance(self, passed_s: float) -> None:
        """Let time pass."""
        step = np.eye(4)
        step[:2, 2:] = passed_s * np.eye(2)
        push = np.vstack((0.5 * passed_s**2 * np.eye(2), passed_s * np.eye(2)))
        self.state = step @ self.state
        self.covariance = step @ self.covariance @ step.T + PUSH_M_S2**2 * push @ push.T

    def correct(self, place_m: Array, score: float, now_s: float) -> None:
        """Take in where the legs are on average."""
        seen = self.covariance[:, :2]
        gain = seen @ np.linalg.inv(seen[:2] + OFF_M**2 * np.eye(2))
        self.state = self.state + gain @ (place_m - self.state[:2])
        self.covariance = self.covariance - gain @ seen.T
        self.scores.append(score)
        self.seen_s = now_s
        moved_m = float(np.linalg.norm(self.state[:2] - self.begun_m))
        self.walked_m = max(self.walked_m, moved_m)


class Tracks:
    """All persons around."""

    def __init__(self) -> None:
        """Nobody yet."""
        self.people: list[Track] = []
        self._ids = count(1)
        self._now_s: float | None = None

    def step(self, now_s: float, legs: list[Leg], places_m: Array) -> dict[int, Track]:
        """Take in the legs of a scan; whose each is.

        Args:
            now_s: the stamp of the scan; not before the last one.
            legs: of the scan.
            places_m: where they are in the frame of the place, shape (legs, 2).

        Returns:
            By the number of the leg: the person it was taken for. The others are nobody's.
        """
        passed_s = 0.0 if self._now_s is None else max(0.0, now_s - self._now_s)
        self._now_s = now_s
        for track in self.people:
            track.advance(passed_s)
        self.people = [track for track in self.people if not self._lost(track, now_s)]
        owners = self._owners(places_m)
        for track in self.people:
            own = [leg for leg, owner in owners.items() if owner is track]
            if own:
                scores = [legs[leg].score for leg in own]
                track.correct(places_m[own].mean(axis=0), max(scores), now_s)
        rest = [leg for leg in range(len(legs)) if leg not in owners]
        return owners | self._begin(now_s, legs, places_m, rest)

    def _lost(self, track: Track, now_s: float) -> bool:
        return now_s - track.seen_s > (FORGET_KNOWN_S if track.believed else FORGET_S)

    def _owners(self, places_m: Array) -> dict[int, Track]:
        """Legs to persons at the least sum of distances, at most two a person."""
        if not self.people or not len(places_m):
            return {}
        ahead_m = np.array([track.state[:2] for track in self.people])
        far_m = np.linalg.norm(places_m[:, None] - ahead_m[None], axis=-1)
        # Those who are believed go first: what has just begun must not take their legs away.
        later_m = np.array([0.0 if track.believed else 0.3 for track in self.people])
        costs = np.where(far_m <= NEAR_M, far_m + later_m, 1e3)
        costs = np.concatenate((costs, costs + 0.1), axis=1)  # a second leg, after others' first
        return {
            leg: self.people[column % len(self.people)]
            for leg, column in least_costs(costs)
            if costs[leg, column] < 1e2
        }

    def _begin(
        self, now_s: float, legs: list[Leg], places_m: Array, rest: list[int]
    ) -> dict[int, Track]:
        """New persons out of legs that are nobody's: pairs that stand close, then single legs."""
        found: dict[int, Track] = {}
        for leg in sorted(rest, key=lambda leg: -legs[leg].score):
            if leg in found or legs[leg].score < LEAST_START:
                continue
            own = [leg]
            others = [one for one in rest if one != leg and one not in found]
            if others:
                far_m = np.linalg.norm(places_m[others] - places_m[leg], axis=1)
                if far_m.min() <= NEAREST_PERSON_M:
                    own.append(others[int(far_m.argmin())])
            place_m = places_m[own].mean(axis=0)
            track = Track(
                id=next(self._ids),
                state=np.array([*place_m, 0.0, 0.0]),
                covariance=np.diag([OFF_M**2, OFF_M**2, START_M_S**2, START_M_S**2]),
                seen_s=now_s,
                begun_m=place_m,
                scores=[max(legs[one].score for one in own)],
            )
            self.people.append(track)
            found.update(dict.fromkeys(own, track))
        return found
