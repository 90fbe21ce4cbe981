"""Where the known objects and people are believed to be, and which are gone from where they were.

An object in a closed hand goes where the hand goes: the fingers are as far apart as it is wide, and
it is between them. Once they have come to rest on it their own opening says whether they still have
it: how wide it looks changes with every look. Fingers that are as far apart as they go hold
nothing, however wide a thing between them is.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import msgspec
import numpy as np

from robot.messages import (
    DepthImage,
    ObjectInfo,
    Obstacle,
    PersonInfo,
    Shape,
    Side,
    Sighting,
    Sightings,
    Track,
)
from robot.model.handling import Gripping
from robot.se3 import SE3, Vector3

FRAMES_TO_MISS = 3
MIN_DEPTH_M = 0.15
DEPTH_TOLERANCE_M = 0.03
EDGE_PX = 6
WAIST_M, WAIST_RADIUS_M = 0.9, 0.12
SAME_PERSON_M = 0.6
WALKS_M_S, LOST_S = 0.4, 2.5
"""How far somebody may have walked whom no sensor made out for a moment, no longer than that."""
RESTS_M = 0.001
"""An opening that has changed by less since it was felt last is at rest."""
UNSEEN_S = 0.5
FORGET_S = 20.0


@dataclass(frozen=True, slots=True)
class Hand:
    """One hand: its grasp frame in W, how far apart its fingers are, and what they are like.

    `most_m`: how far apart they go.
    """

    X_WG: SE3
    opening_m: float
    gripping: Gripping
    most_m: float

    @property
    def is_open(self) -> bool:
        """Whether they are as far apart as they go: the widest thing to take is narrower."""
        return self.opening_m > self.most_m - 0.5 * self.gripping.spare_m


class Hold(NamedTuple):
    """An object in a hand.

    Attributes:
        side: of the hand.
        X_GO: the object in its grasp frame.
        opening_m: of its fingers when they were felt last, or came to rest.
        rests: whether they have come to rest on it.
    """

    side: Side
    X_GO: SE3
    opening_m: float
    rests: bool = False


class WorldModel:
    """One track an object; sightings move it, clear views of an empty place mark it missing."""

    def __init__(self, *, camera_range_m: float) -> None:
        self._range_m = camera_range_m
        self._tracks: dict[str, Track] = {}
        self._people: dict[str, Track] = {}
        self._shapes: dict[str, Shape] = {}
        self._misses: dict[str, int] = {}
        self._holds: dict[str, Hold] = {}
        self._just_seen: set[str] = set()
        self._around: dict[str, frozenset[str]] = {}  # by person: what stood anywhere by then

    def know(self, objects: tuple[ObjectInfo, ...], people: tuple[PersonInfo, ...] = ()) -> None:
        """Learn what and who there is; those already tracked keep their tracks."""
        for info in objects:
            self._tracks.setdefault(info.id, Track(id=info.id, X_WO=None, seen_s=-math.inf))
        self.measure(objects)
        for person in people:
            unseen = Track(id=person.id, X_WO=person.X_WO, seen_s=-math.inf)
            self._people.setdefault(person.id, unseen)

    def measure(self, objects: tuple[ObjectInfo, ...]) -> None:
        """Learn what objects are like that are known already."""
        self._shapes.update((info.id, info.shape) for info in objects)

    def held(self) -> dict[str, Side]:
        """Which objects the hands have."""
        return {name: hold.side for name, hold in self._holds.items()}

    def tracks(self) -> tuple[Track, ...]:
        """Every object's track, in the order they became known."""
        return tuple(self._tracks.values())

    def people(self) -> tuple[Track, ...]:
        """Every person's track, in the order they became known."""
        return tuple(self._people.values())

    def see(self, sightings: Sightings, X_WC: SE3, depth: DepthImage | None) -> None:
        """Take one frame of the camera at X_WC; without depth nothing can be missed."""
        _place(self._tracks, self._misses, sightings.objects, X_WC, sightings.stamp_s)
        _place(self._people, self._misses, sightings.people, X_WC, sightings.stamp_s)
        seen = {sighting.id for sighting in (*sightings.objects, *sightings.people)}
        self._just_seen |= seen
        if depth is None:
            return
        view = View(depth, X_WC, range_m=self._range_m)
        self._miss_objects(view, seen)
        for name, track in self._people.items():
            if track.X_WO is None or name in seen:
                continue
            if view.is_clear((*track.X_WO.p[:2], WAIST_M), WAIST_RADIUS_M):
                self._miss(self._people, name)

    def miss(self, names: Collection[str]) -> None:
        """Take it that objects were looked for in plain view, and that their places are empty."""
        for name in names:
            if self._tracks[name].X_WO is not None and name not in self._holds:
                self._miss(self._tracks, name)

    def mistake(self, names: Mapping[str, str]) -> None:
        """Take it that objects were never where they were seen, or what a hand has.

        Args:
            names: of them, with what is there instead, in words.
        """
        for name, what in names.items():
            self._tracks[name] = Track(id=name, X_WO=None, seen_s=-math.inf, unlike=what)
            self._misses.pop(name, None)
            self._holds.pop(name, None)

    def _miss_objects(self, view: View, seen: Collection[str]) -> None:
        for name, track in self._tracks.items():
            if track.X_WO is None or name in seen or name in self._holds:
                continue
            radius_m = 0.5 * max(self._shapes[name].size_m[:2]) if name in self._shapes else 0.0
            if view.is_clear(track.X_WO.p, radius_m):
                self._miss(self._tracks, name)

    def _miss(self, tracks: dict[str, Track], name: str) -> None:
        self._misses[name] = self._misses.get(name, 0) + 1
        if self._misses[name] == FRAMES_TO_MISS:
            tracks[name] = msgspec.structs.replace(tracks[name], missing=True)

    def feel(self, hands: Mapping[Side, Hand]) -> None:
        """Take the hands as they are: what one holds moves along, what one lets go stays."""
        for name, track in self._tracks.items():
            shape = self._shapes.get(name)
            if track.X_WO is None or shape is None:
                continue
            before = self._holds.get(name) or _hold(hands, shape, track.X_WO)
            if before is None:
                continue
            hand, seen = hands.get(before.side), name in self._just_seen
            hold = None if hand is None else _still(before, hand, shape)
            if hand is None or hold is None or (seen and _is_far(hand, shape, track.X_WO)):
                self._holds.pop(name, None)
                self._tracks[name] = msgspec.structs.replace(track, held_by=None)
            else:
                self._holds[name] = hold
                X_WO = hand.X_WG @ hold.X_GO
                self._tracks[name] = msgspec.structs.replace(track, X_WO=X_WO, held_by=hold.side)
        self._just_seen.clear()

    def bump(self, obstacles: tuple[Obstacle, ...], now_s: float) -> None:
        """Take what else the sensors see: a person out of the camera's view may be one of it.

        One who has not been seen by any sensor for `FORGET_S` has gone somewhere.
        """
        for name, track in self._people.items():
            unseen_s = now_s - track.seen_s
            if track.X_WO is None or track.missing or not UNSEEN_S < unseen_s < math.inf:
                self._around[name] = frozenset(one.id for one in obstacles)
                continue
            X_WO = self._walked_to(name, track.X_WO, unseen_s, obstacles)
            if X_WO is not None:
                at = SE3((*X_WO.p[:2], track.X_WO.p[2]), track.X_WO.quat_wxyz)
                self._people[name] = Track(id=name, X_WO=at, seen_s=now_s)
                self._around[name] = frozenset(one.id for one in obstacles)
            elif unseen_s > FORGET_S:
                self._people[name] = msgspec.structs.replace(track, missing=True)

    def _walked_to(
        self, name: str, X_WO: SE3, unseen_s: float, obstacles: tuple[Obstacle, ...]
    ) -> SE3 | None:
        """Where somebody is by now: the nearest of what stands about where they were.

        Farther off, as far as they can have walked, only what was not around when they were made
        out last, and is nobody else: the rest is furniture.
        """
        walked_m = WALKS_M_S * unseen_s if unseen_s < LOST_S else 0.0
        before = self._around.get(name, frozenset())
        others = [
            track.X_WO.p[:2]
            for track in self._people.values()
            if track.id != name and track.X_WO is not None and not track.missing
        ]

        def may_be(one: Obstacle, apart_m: float) -> bool:
            new = one.id not in before
            alone = all(math.dist(one.X_WO.p[:2], other) > SAME_PERSON_M for other in others)
            return apart_m < SAME_PERSON_M or (apart_m < SAME_PERSON_M + walked_m and new and alone)

        away = [(math.dist(one.X_WO.p[:2], X_WO.p[:2]), one) for one in obstacles]
        found = [(apart_m, one.X_WO) for apart_m, one in away if may_be(one, apart_m)]
        return min(found, key=lambda one: one[0])[1] if found else None


def _place(
    tracks: dict[str, Track],
    misses: dict[str, int],
    sightings: tuple[Sighting, ...],
    X_WC: SE3,
    stamp_s: float,
) -> None:
    """Put what was seen where it was seen; who holds it is left to the hands."""
    for sighting in sightings:
        before = tracks.get(sighting.id)
        tracks[sighting.id] = Track(
            id=sighting.id,
            X_WO=X_WC @ sighting.X_CO,
            seen_s=stamp_s,
            held_by=before.held_by if before is not None else None,
        )
        misses[sighting.id] = 0


def _hold(hands: Mapping[Side, Hand], shape: Shape, X_WO: SE3) -> Hold | None:
    """The hand that has an object between its fingers, and the object in it."""
    for side, hand in hands.items():
        if hand.is_open:  # though about as wide as a can of 8.5 cm
            continue
        X_GO = hand.X_WG.inverse() @ X_WO
        within = _inside(shape, X_GO).away_m < hand.gripping.held_within_m
        if within and _fits(hand, shape, X_GO):
            return Hold(side, X_GO, math.inf)
    return None


def _still(hold: Hold, hand: Hand, shape: Shape) -> Hold | None:
    """The hold with the fingers as they are now; None if they have let go of it.

    Until they rest they are as far apart as it looks wide, then as they were when they came to it.
    """
    if hand.is_open:
        return None
    if hold.rests and abs(hand.opening_m - hold.opening_m) < hand.gripping.gap_m:
        return hold
    if not _fits(hand, shape, hold.X_GO):
        return None
    rests = abs(hand.opening_m - hold.opening_m) < RESTS_M
    return hold._replace(opening_m=hand.opening_m, rests=rests)


def _fits(hand: Hand, shape: Shape, X_GO: SE3) -> bool:
    """Whether the fingers, which close along y of G, are as far apart as an object is wide there.

    Not along its other sides: an open hand around a box of 6 x 10 cm is as wide as it is deep.
    """
    return abs(hand.opening_m - _inside(shape, X_GO).width_m) < hand.gripping.gap_m


def _is_far(hand: Hand, shape: Shape, X_WO: SE3) -> bool:
    X_GO = hand.X_WG.inverse() @ X_WO
    return _inside(shape, X_GO).away_m > hand.gripping.lost_beyond_m


class _Inside(NamedTuple):
    """What is between the fingers: how far its middle is from the grasp point, and its width."""

    away_m: float
    width_m: float


def _inside(shape: Shape, X_GO: SE3) -> _Inside:
    """The piece that can be held and is next to the grasp point; a shape without pieces is one."""
    if not shape.pieces:
        across = np.abs((X_GO @ shape.X_BodyShape).rotation()[1])
        return _Inside(math.hypot(*X_GO.p), shape.size_m[int(np.argmax(across))])
    found: list[_Inside] = []
    for piece in shape.held_pieces:
        X_GP = X_GO @ shape.X_BodyShape @ piece.X_ShapePiece
        across = np.abs(X_GP.rotation()[1])
        found.append(_Inside(math.hypot(*X_GP.p), piece.size_m[int(np.argmax(across))]))
    return min(found, default=_Inside(math.inf, math.inf))


class View:
    """A depth image from a known place: what it can say about points of the world."""

    def __init__(self, image: DepthImage, X_WC: SE3, *, range_m: float) -> None:
        self._X_CW = X_WC.inverse()
        self._range_m = range_m
        self._width, self._height = image.width, image.height
        self._focal_px = 0.5 * image.height / math.tan(0.5 * image.fovy_rad)
        self._image = image

    def is_clear(self, p_W: Vector3, radius_m: float) -> bool:
        """Whether the whole disc of `radius_m` about a point is in view with nothing before it."""
        x, y, z = self._X_CW.apply(p_W).tolist()
        front_m = z - radius_m - DEPTH_TOLERANCE_M
        if front_m < MIN_DEPTH_M or z > self._range_m:
            return False
        column = 0.5 * self._width + self._focal_px * x / z
        row = 0.5 * self._height + self._focal_px * y / z
        reach_px = self._focal_px * radius_m / z
        left, right = int(column - reach_px), int(column + reach_px) + 1
        top, bottom = int(row - reach_px), int(row + reach_px) + 1
        inside = (
            left >= EDGE_PX
            and top >= EDGE_PX
            and right <= self._width - EDGE_PX
            and bottom <= self._height - EDGE_PX
        )
        if not inside:
            return False
        patch = self._image.pixels()[top:bottom, left:right]
        return not bool(np.any((patch > 0.0) & (patch < front_m)))
