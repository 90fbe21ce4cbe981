"""People in the scans of a laser, scan by scan as a robot has them, or of a log as a whole."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from robot.perception.people.legs import Leg, legs
from robot.perception.people.scan import PlanarScan
from robot.perception.people.standing import StandingThings
from robot.perception.people.tracks import Track, Tracks

LEAST_SCORE = 0.1
"""Clusters less likely than this to be legs are not even followed."""
NO_RANGES = np.zeros(0)


@dataclass(frozen=True, kw_only=True)
class FoundLeg:
    """A leg in the laser's frame [m], and the number of the person it belongs to."""

    x: float
    y: float
    score: float
    id: int


@dataclass(frozen=True, kw_only=True)
class FoundPerson:
    """A person in the laser's frame: place [m], velocity over the ground [m/s]."""

    id: int
    x: float
    y: float
    vx: float
    vy: float
    score: float


@dataclass(frozen=True, kw_only=True)
class Found:
    """Who was seen in a scan."""

    t: float
    people: tuple[FoundPerson, ...]
    legs: tuple[FoundLeg, ...]


@dataclass(frozen=True)
class _Seen:
    """A scan, without its ranges, with everything that may turn out to be a person."""

    scan: PlanarScan
    legs: list[Leg]
    owners: dict[int, Track]
    states: dict[int, np.ndarray]
    """By number of a person: what was believed of it then."""

    def of(self, believed: Callable[[Track], bool]) -> Found:
        """What there is of those who are believed to be people."""
        own = {leg: track for leg, track in self.owners.items() if believed(track)}
        tracks = {track.id: track for track in own.values()}
        people: list[FoundPerson] = []
        for track in tracks.values():
            state = self.states[track.id]
            x_m, y_m = self.scan.in_laser(state[None, :2])[0].tolist()
            yaw_rad = self.scan.pose[2]
            cos, sin = float(np.cos(yaw_rad)), float(np.sin(yaw_rad))
            vx_m_s = cos * float(state[2]) + sin * float(state[3])
            vy_m_s = cos * float(state[3]) - sin * float(state[2])
            score = max(self.legs[leg].score for leg, owner in own.items() if owner is track)
            people.append(FoundPerson(id=track.id, x=x_m, y=y_m, vx=vx_m_s, vy=vy_m_s, score=score))
        found = [
            FoundLeg(x=leg.x_m, y=leg.y_m, score=leg.score, id=own[number].id)
            for number, leg in enumerate(self.legs)
            if number in own
        ]
        return Found(t=self.scan.t_s, people=tuple(people), legs=tuple(found))


class PeopleFinder:
    """Finds people while the scans come in, and learns meanwhile what stands still."""

    def __init__(self, standing: StandingThings | None = None) -> None:
        """Know nothing of the place, or what is known to stand there."""
        self._learns = standing is None
        self._standing = standing or StandingThings()
        self._tracks = Tracks()

    def step(self, scan: PlanarScan) -> Found:
        """The people of the next scan."""
        return self.seen(scan).of(lambda track: track.believed)

    def seen(self, scan: PlanarScan) -> _Seen:
        """The next scan with everybody who may turn out to be a person."""
        candidates = legs(scan, self._standing, at_least=LEAST_SCORE)
        places_m = np.array([(leg.x_m, leg.y_m) for leg in candidates]).reshape(-1, 2)
        owners = self._tracks.step(scan.t_s, candidates, scan.in_place(places_m))
        if self._learns:
            self._standing.look(scan)
        where = replace(scan, ranges_m=NO_RANGES)  # a log has many, and their points take room
        return _Seen(where, candidates, owners, {one.id: one.state for one in owners.values()})


def people_of_log(
    scans: Sequence[PlanarScan], progress: Callable[[int], None] = lambda _done: None
) -> list[Found]:
    """The people of a log as a whole: what happens later tells what was a person before.

    What stands still is learnt from all scans first, and somebody who is believed at the end of
    being followed was a person from the beginning. A robot cannot know that: `PeopleFinder`.

    Args:
        scans: in the order in which they were taken.
        progress: is told how many steps are done, of twice as many as there are scans.
    """
    standing = StandingThings()
    for done, scan in enumerate(scans, 1):
        standing.look(scan)
        progress(done)
    finder = PeopleFinder(standing)
    seen: list[_Seen] = []
    for done, scan in enumerate(scans, len(scans) + 1):
        seen.append(finder.seen(scan))
        progress(done)
    return [one.of(lambda track: track.believed) for one in seen]
