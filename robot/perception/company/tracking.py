"""Whoever may be somebody, followed: a Kalman filter of constant velocity, and how sure it is.

What the lidar alone sees is followed, and told only once it is believed: a figure with head and
shoulders, or something that walks. What is hidden stays where it was, less and less sure; what is
seen through is gone.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import count

import numpy as np

from robot.perception.company.figures import Figure, Posture
from robot.perception.company.free_floor import FreeFloor
from robot.perception.company.returns import Returns, Sweep, sees_through
from robot.perception.people.assignment import least_costs
from robot.se3 import Array

PUSH_M_S2 = 1.5
"""1 sigma of how somebody speeds up or turns: from a walk of 1.2 m/s to a stand in a second."""
SLOWS_1_S = 1.0
"""How fast a speed is forgotten of who is not seen."""
START_M_S = 0.5
NEAR_M, SURELY_M = 0.7, 0.35
"""A measurement further from where somebody must be is not theirs; of a cluster that is new."""
SIGMAS = 3.0
FIGURE_WORTH = 0.35
"""Of a look's evidence: ten looks a second are much the same look."""
UNSURE, BELIEVED, DOUBTED = -1.2, 1.2, -0.4
"""Log-odds of what the map does not explain, from which on it is told, and until when."""
CAME, CAME_SCANS, CAME_WITHIN_M, CAME_WIDE_M = 0.8, 3, 3.0, 0.07
"""Evidence of each of the first scans of what stands where the floor was free before, if it is near
enough to be sure of that and no thinner than a shin."""
CLOSE_M, BODY_WIDE_M, CLOSE = 1.5, (0.10, 0.65), 0.3
"""What is so near, stands free and is as wide as a body is taken for somebody, until a look says
that it is not: being wrong costs a detour, and the other way round a blow."""
REFUTED, BESIDE_M = -2.0, 0.9
"""What is no person for sure, and how far off what is seen new is a part of it."""
LEAST, MOST = -4.0, 3.5
WALK_S, WALKED_M, STRAIGHT, WALKING = 1.2, 0.35, 0.7, 0.35
"""What has gone so far in that time, and not to and fro, walks; evidence of each scan of it."""
MISSES = 5
"""Scans or images in a row in which a place is seen through, until who was there is gone."""
FORGET_S, FORGET_KNOWN_S = 1.5, 60.0
"""Unseen for so long, what may be somebody is forgotten, and who is believed, or refuted."""
LARGEST_M = 2.5
"""1 sigma of where somebody hidden may be by now: no more than that is said."""
BEAM_HALF_M, BEYOND_M = 0.22, 0.45
JUST_S = 0.35
FEWEST_BEAMS = 2
FEWEST_STEPS = 8
WAY = 16
"""Scans of a way that are looked at, at the least, and kept."""
HAND_LOOKS = 3


@dataclass
class Somebody:
    """A track.

    Attributes:
        number: of it, never used again.
        state: x, y [m], velocity x, y [m/s] in W.
        covariance: of that.
        nats: log-odds that it is somebody.
        seen_s: when a sensor made it out last.
        is_believed: whether it is told.
        posture, height_m: by figures; the greatest height of late.
        raises_hand: whether a hand was beside or above the head of late.
        colour: red, green, blue of the trunk; None: never seen.
    """

    number: int
    state: Array
    covariance: Array
    nats: float
    seen_s: float
    way: deque[tuple[float, Array]] = field(
        default_factory=lambda: deque[tuple[float, Array]](maxlen=WAY)
    )
    is_believed: bool = False
    posture: Posture = "stands"
    height_m: float = 0.0
    colour: Array | None = None
    believed_s: float = field(default=float("inf"))
    misses: int = 0
    came: int = 0
    hand_looks: int = 0

    @property
    def p_W(self) -> Array:
        """Where they are on the floor [m], shape (2,)."""
        return self.state[:2]

    @property
    def is_known(self) -> bool:
        """Whether it is told, or refuted."""
        return self.is_believed or self.nats <= REFUTED

    @property
    def raises_hand(self) -> bool:
        """Whether a hand is beside or above the head, in several looks."""
        return self.hand_looks >= HAND_LOOKS

    def advance(self, passed_s: float, now_s: float) -> None:
        """Let time pass."""
        step = np.eye(4)
        step[:2, 2:] = passed_s * np.eye(2)
        if now_s - self.seen_s > 0.3:
            step[2:, 2:] *= np.exp(-SLOWS_1_S * passed_s)
        push = np.vstack((0.5 * passed_s**2 * np.eye(2), passed_s * np.eye(2)))
        self.state = step @ self.state
        self.covariance = step @ self.covariance @ step.T + PUSH_M_S2**2 * push @ push.T
        largest = float(np.sqrt(np.linalg.eigvalsh(self.covariance[:2, :2])[-1]))
        if largest > LARGEST_M:
            self.covariance *= (LARGEST_M / largest) ** 2

    def correct(self, p_W: Array, noise: Array, now_s: float) -> None:
        """Take in a measured place with its covariance."""
        seen = self.covariance[:, :2]
        gain = seen @ np.linalg.inv(seen[:2] + noise)
        self.state = self.state + gain @ (p_W - self.state[:2])
        covariance = self.covariance - gain @ seen.T
        self.covariance = 0.5 * (covariance + covariance.T)  # rounding grows otherwise
        self.seen_s, self.misses = max(now_s, self.seen_s), 0

    def weigh(self, nats: float, now_s: float) -> None:
        """Take in evidence."""
        self.nats = min(max(self.nats + nats, LEAST), MOST)
        if self.nats >= BELIEVED and not self.is_believed:
            self.is_believed, self.believed_s = True, now_s
        elif self.nats <= DOUBTED:
            self.is_believed = False

    def off(self, p_W: Array, noise: Array) -> tuple[float, float]:
        """How far a measured place is off [m], and in standard deviations."""
        away = p_W - self.state[:2]
        spread = self.covariance[:2, :2] + noise
        return float(np.hypot(*away)), float(np.sqrt(away @ np.linalg.solve(spread, away)))


class Everybody:
    """All tracks."""

    def __init__(self) -> None:
        """Nobody yet."""
        self.tracks: list[Somebody] = []
        self.gone: list[Somebody] = []
        self._floor = FreeFloor()
        self._numbers = count(1)
        self._now_s: float | None = None

    def believed(self) -> list[Somebody]:
        """Who is told."""
        return [track for track in self.tracks if track.is_believed]

    def unsure(self, now_s: float) -> list[Somebody]:
        """Who was seen just now and may be somebody, and no look has said."""
        return [
            track
            for track in self.tracks
            if not track.is_believed and track.nats >= UNSURE and now_s - track.seen_s < JUST_S
        ]

    def take_gone(self) -> list[Somebody]:
        """Who was believed and has left since this was asked last."""
        gone, self.gone = self.gone, []
        return gone

    def forget(self) -> None:
        """Forget where everybody is: it was told by a pose that was wrong."""
        self.tracks.clear()
        self._floor.forget()

    def scan(self, swept: Sweep) -> None:
        """Take a scan."""
        now_s = swept.stamp_s
        self._advance(now_s)
        clusters = swept.clusters
        noises = [np.eye(2) * one.sigma_m**2 for one in clusters]
        owners = self._owners([one.p_W for one in clusters], noises)
        for number, track in owners.items():
            track.correct(clusters[number].p_W, noises[number], now_s)
            track.way.append((now_s, track.p_W.copy()))
            if _walks(track, now_s):
                track.weigh(WALKING, now_s)
            if UNSURE <= track.nats < BELIEVED and _may_be_close(clusters[number]):
                track.weigh(min(CLOSE, BELIEVED - track.nats), now_s)
            if track.came:
                track.came -= 1
                track.weigh(CAME, now_s)
        for number, one in enumerate(clusters):
            if number not in owners and one.beams >= FEWEST_BEAMS:
                self._begin(one, noises[number], now_s)
        seen = list(owners.values())
        self._floor.look(swept)
        self._miss(
            [
                track
                for track in self.tracks
                if not any(track is one for one in seen)
                and track.posture != "lies"
                and sees_through(swept, track.p_W, half_m=BEAM_HALF_M, beyond_m=BEYOND_M)
            ]
        )

    def look(self, found: Sequence[Figure], empty: Sequence[Somebody], now_s: float) -> None:
        """Take the figures of an image.

        Args:
            found: in it.
            empty: tracks whose place was in clear view, with nothing there.
            now_s: its stamp.
        """
        self._advance(now_s)
        owners = self._owners([one.p_W for one in found], [one.covariance for one in found])
        for number, one in enumerate(found):
            track = owners.get(number)
            if track is None:
                if one.evidence <= 0.0:
                    continue
                track = self._track(one.p_W, one.covariance, now_s)
                if self._floor.was_free(one.p_W):
                    track.weigh(CAME, now_s)
            else:
                track.correct(one.p_W, one.covariance, now_s)
            _take(track, one)
            track.weigh(FIGURE_WORTH * one.evidence, now_s)
        seen = list(owners.values())
        self._miss([track for track in empty if not any(track is one for one in seen)])

    def _advance(self, now_s: float) -> None:
        passed_s = 0.0 if self._now_s is None else max(0.0, now_s - self._now_s)
        self._now_s = now_s if self._now_s is None else max(now_s, self._now_s)
        for track in self.tracks:
            track.advance(passed_s, now_s)
        self._drop(
            [
                track
                for track in self.tracks
                if now_s - track.seen_s > (FORGET_KNOWN_S if track.is_known else FORGET_S)
            ]
        )

    def _miss(self, missed: Sequence[Somebody]) -> None:
        for track in missed:
            track.misses += 1
        self._drop([track for track in self.tracks if track.misses >= MISSES])

    def _drop(self, dropped: Sequence[Somebody]) -> None:
        for track in dropped:
            if track.is_believed:
                self.gone.append(track)
        self.tracks = [track for track in self.tracks if not any(track is one for one in dropped)]

    def _owners(self, places: Sequence[Array], noises: Sequence[Array]) -> dict[int, Somebody]:
        """Measurements to tracks at the least sum of distances; who is believed goes first."""
        if not self.tracks or not places:
            return {}
        costs = np.full((len(places), len(self.tracks)), 1e3)
        for row, (p_W, noise) in enumerate(zip(places, noises, strict=True)):
            for column, track in enumerate(self.tracks):
                off_m, off_sigmas = track.off(p_W, noise)
                hidden_m = float(np.sqrt(track.covariance[0, 0] + track.covariance[1, 1]))
                if off_m < max(SURELY_M, min(NEAR_M + hidden_m, SIGMAS * hidden_m)) and (
                    off_sigmas < SIGMAS or off_m < SURELY_M
                ):
                    costs[row, column] = off_m + (0.0 if track.is_believed else 0.2)
        return {
            row: self.tracks[column]
            for row, column in least_costs(costs)
            if costs[row, column] < 1e2
        }

    def _begin(self, one: Returns, noise: Array, now_s: float) -> None:
        track = self._track(one.p_W, noise, now_s)
        if self._has_come(one):
            track.came = CAME_SCANS - 1
            track.weigh(CAME, now_s)
        self._floor.occupy(one.p_W)

    def _has_come(self, one: Returns) -> bool:
        """Whether it stands where the floor was free before."""
        part = any(
            track.nats <= REFUTED and np.hypot(*(track.p_W - one.p_W)) < BESIDE_M
            for track in self.tracks
        )
        near = one.range_m < CAME_WITHIN_M and one.width_m > CAME_WIDE_M and one.is_free
        return near and not part and self._floor.was_free(one.p_W)

    def _track(self, p_W: Array, noise: Array, now_s: float) -> Somebody:
        covariance = np.zeros((4, 4))
        covariance[:2, :2], covariance[2:, 2:] = noise, START_M_S**2 * np.eye(2)
        track = Somebody(
            number=next(self._numbers),
            state=np.array([*p_W, 0.0, 0.0]),
            covariance=covariance,
            nats=UNSURE,
            seen_s=now_s,
        )
        self.tracks.append(track)
        return track


def _take(track: Somebody, one: Figure) -> None:
    """What a figure tells besides its place."""
    if one.evidence <= 0.0:
        return
    track.height_m = max(0.95 * track.height_m, one.top_m)
    track.posture = one.posture
    track.hand_looks = (
        min(track.hand_looks + 1, 2 * HAND_LOOKS)
        if one.raises_hand
        else max(track.hand_looks - 1, 0)
    )
    if one.colour is not None:
        before = one.colour if track.colour is None else track.colour
        track.colour = 0.8 * before + 0.2 * one.colour


def _walks(track: Somebody, now_s: float) -> bool:
    """Whether it goes on: what flickers along a wall that is askew on the map goes to and fro."""
    way = [p_W for stamp_s, p_W in track.way if now_s - stamp_s < WALK_S]
    if len(way) < FEWEST_STEPS:
        return False
    steps = np.diff(np.array(way)[::2], axis=0)
    went_m = float(np.hypot(*steps.sum(axis=0)))
    return went_m > max(WALKED_M, STRAIGHT * float(np.hypot(*steps.T).sum()))


def _may_be_close(one: Returns) -> bool:
    return one.is_free and one.range_m < CLOSE_M and BODY_WIDE_M[0] < one.width_m < BODY_WIDE_M[1]
