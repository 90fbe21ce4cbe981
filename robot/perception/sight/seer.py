"""Sight: pictures in, sightings of the things that an owner named out, with the sizes they have."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import msgspec
import numpy as np
from numpy.typing import NDArray

from robot.messages import (
    ObjectInfo,
    Place,
    RgbdImage,
    Shape,
    Sighting,
    Sightings,
    Unnamed,
    WorldMap,
)
from robot.perception.sight.at_hand import apart_from_hands
from robot.perception.sight.doubt import doubtful
from robot.perception.sight.likeness import Knowledge
from robot.perception.sight.measuring import Measured, is_cut_off, measured
from robot.perception.sight.recognising import Recogniser
from robot.perception.sight.tracking import Seen, Tracks
from robot.perception.sight.unnamed import unnamed
from robot.perception.things.eyes import Eyes, SeenThing
from robot.perception.things.inputs import Sight, sight
from robot.se3 import SE3, Vector3
from robot.usual_things import usual

FAR_M = 3.4
"""Beyond it depth says little of a small thing."""
SAME_SHARE, SAME_M = 0.6, 0.02
"""Two parts of one thing: alike in colour and nearer than that share of the larger one's width, or
nearer than two things can be."""
IN_HAND_M = 0.07
"""What is so near to where a held thing should be is that."""
RESIZED_M = 0.003
"""A size that has changed by less is not told again."""
LIES_BELOW, LIES_RATIO = 0.35, 0.8
"""How likely it is at most that a thing stands, and how low it is for its length, when it lies."""


class Look(NamedTuple):
    """What came of one picture.

    Attributes:
        sightings: the named things in it.
        missed: named things whose place is in plain view and empty.
        mistaken: what something was taken for that turns out to be another thing, also in a hand,
            with what that is; where the real one is, nobody has seen.
        things: everything that was measured in it, with the name it was given or "".
        doubts: where something stands that nobody has made out yet [m], in W.
        unnamed: what stands somewhere without a name.
    """

    sightings: Sightings
    missed: frozenset[str]
    mistaken: dict[str, str]
    things: tuple[tuple[Seen, str], ...]
    doubts: tuple[Vector3, ...] = ()
    unnamed: tuple[Unnamed, ...] = ()


class Seer:
    """Remembers what was seen where, and which of it is what."""

    def __init__(self, eyes: Eyes | None = None) -> None:
        """Load the networks. Raises ConfigError if onnxruntime is missing."""
        self._eyes = eyes or Eyes()
        namer = self._eyes.namer
        self._recogniser = Recogniser(Knowledge(namer.classes, namer.sure, namer.voted))
        self._tracks = Tracks()
        self._places: tuple[Place, ...] = ()
        self._told: dict[str, ObjectInfo] = {}
        self._infos: dict[str, ObjectInfo] = {}
        self._named: dict[str, Seen] = {}

    def tell(self, world_map: WorldMap) -> None:
        """Take the surfaces of a map, and the names, categories and colours of its things."""
        self._places = world_map.places
        told = tuple(one.told() for one in world_map.objects)
        self._told = {one.id: one for one in told}
        self._infos = self._told | self._infos
        self._recogniser.tell(told, world_map.categories, world_map.places)

    def infos(self) -> tuple[ObjectInfo, ...]:
        """What is known of every named thing by now: its size, once it was seen."""
        return tuple(self._infos.values())

    @property
    def named(self) -> dict[str, Seen]:
        """What has a name by now, by the thing's id."""
        return dict(self._named)

    def forget(self) -> None:
        """Forget where things are: the robot was elsewhere than it thought."""
        self._tracks, self._named = Tracks(), {}

    def look(
        self,
        image: RgbdImage,
        X_WC: SE3,
        *,
        own: NDArray[np.bool_],
        held: Mapping[str, SE3],
        hands_W: Sequence[Vector3] = (),
    ) -> Look:
        """Look at one picture.

        Args:
            image: the picture.
            X_WC: where the camera was.
            own: pixels that show the robot.
            held: where the things in its hands are, by id.
            hands_W: where what the hands hold is [m], in W.
        """
        view = sight(image, X_WC)
        nothing = Sightings(stamp_s=image.stamp_s, objects=(), source="sensor")
        if view is None:
            return Look(nothing, frozenset(), {}, ())
        self._carry(held)
        looked = [
            thing for thing in self._eyes.look(image, view.X_WC, but=own) if thing.range_m < FAR_M
        ]
        self._look_at_hands(looked, held)
        found = apart_from_hands(self._found(looked, view, own), hands_W)
        seen = self._tracks.add(found, image.stamp_s)
        before = {track.number: id for id, track in self._named.items()}
        gone = self._tracks.miss(_without(view, own), seen, image.stamp_s)
        self._named = self._recogniser.named(self._tracks.things)
        names = {track.number: id for id, track in self._named.items()}
        sighted = {names[track.number] for track in seen if track.number in names}
        mistaken = {
            name: what for name, what in self._recogniser.mistaken.items() if name not in sighted
        }
        self._infos |= {name: self._told[name] for name in mistaken}
        self._measure(seen, names)
        X_CW = X_WC.inverse()
        sightings = tuple(
            Sighting(id=names[track.number], X_CO=X_CW @ self._pose(names[track.number], track))
            for track in seen
            if track.number in names and names[track.number] not in held
        )
        return Look(
            Sightings(stamp_s=image.stamp_s, objects=sightings, source="sensor"),
            frozenset(before[track.number] for track in gone if track.number in before) - set(held),
            mistaken,
            tuple((track, names.get(track.number, "")) for track in seen),
            self._doubts(looked),
            unnamed(self._tracks.things, names, self._recogniser.may_be),
        )

    def _doubts(self, looked: Sequence[SeenThing]) -> tuple[Vector3, ...]:
        clear = {self._named[name].number: odds for name, odds in self._recogniser.clear.items()}
        cut_off = (one for one in looked if is_cut_off(one.pixels))
        return doubtful(self._tracks.things, clear, cut_off)

    def _carry(self, held: Mapping[str, SE3]) -> None:
        """What is in a hand is where the hand is."""
        for name, X_WO in held.items():
            track = self._named.get(name)
            if track is not None:
                track.p_W, track.misses = np.array(X_WO.p), 0

    def _look_at_hands(self, looked: Sequence[SeenThing], held: Mapping[str, SE3]) -> None:
        """What is in a hand stands nowhere, and fingers hide its form: its colours are seen."""
        for name, X_WO in held.items():
            track, at_W = self._named.get(name), np.array(X_WO.p)
            near = [one for one in looked if np.linalg.norm(one.p_W - at_W) < IN_HAND_M]
            if track is not None and near:
                track.add_colours(max(near, key=lambda one: int(one.pixels.sum())))

    def _found(
        self, looked: Sequence[SeenThing], view: Sight, own: NDArray[np.bool_]
    ) -> list[Measured]:
        """What stands somewhere in a picture; parts of one thing are put together."""
        found = [one for thing in looked if (one := self._measured(view, thing, own)) is not None]
        whole: list[Measured] = []
        for one in sorted(found, key=lambda one: -int(one.seen.pixels.sum())):
            other = next((k for k, larger in enumerate(whole) if _are_one(larger, one)), None)
            if other is None:
                whole.append(one)
                continue
            larger = whole[other].seen
            joined = larger._replace(pixels=larger.pixels | one.seen.pixels)
            again = self._measured(view, joined, own)
            whole[other] = again or whole[other]
        return whole

    def _measured(self, view: Sight, thing: SeenThing, own: NDArray[np.bool_]) -> Measured | None:
        return measured(view, thing, self._places, hidden=own)

    def _measure(self, seen: Sequence[Seen], names: Mapping[int, str]) -> None:
        """Take the sizes of named things as they are seen."""
        for track in seen:
            name = names.get(track.number)
            if name is None or _lies(track):
                continue
            info = self._infos[name]
            x, y, z, width_m = (max(0.005, float(value)) for value in track.size_m)
            kind = usual(info.category).kind
            size: Vector3 = (width_m, width_m, z) if kind == "cylinder" else (x, y, z)
            if max(abs(a - b) for a, b in zip(size, info.shape.size_m, strict=True)) > RESIZED_M:
                rounded = (round(size[0], 4), round(size[1], 4), round(size[2], 4))
                shape = Shape(kind=kind, size_m=rounded)
                self._infos[name] = _with_shape(info, shape)

    def _pose(self, name: str, track: Seen) -> SE3:
        """Where a named thing is, upright, or on its side where it looks like that."""
        x, y, z = track.p_W.tolist()
        if _lies(track):
            return SE3.from_rpy(0.0, math.pi / 2, track.last.yaw_rad, (x, y, z))
        if self._infos[name].shape.kind == "cylinder":
            return SE3((x, y, z))
        return SE3.from_xy_yaw(x, y, track.last.yaw_rad) @ SE3((0.0, 0.0, z))


def _with_shape(info: ObjectInfo, shape: Shape) -> ObjectInfo:
    return msgspec.structs.replace(info, shape=shape)


def _lies(track: Seen) -> bool:
    """Whether a thing lies on its side."""
    long_m = max(track.last.size_m[:2])
    return track.last.seen.upright < LIES_BELOW and track.last.size_m[2] < LIES_RATIO * long_m


def _are_one(larger: Measured, other: Measured) -> bool:
    """Whether two finds are parts of one thing."""
    apart_m = float(np.linalg.norm((larger.p_W - other.p_W)[:2]))
    width_m = max(*larger.size_m[:2], *other.size_m[:2])
    alike = bool(set(larger.seen.colours) & set(other.seen.colours))
    return apart_m < SAME_M or (alike and apart_m < SAME_SHARE * width_m)


def _without(view: Sight, own: NDArray[np.bool_]) -> Sight:
    """A view in which the robot itself hides nothing and shows nothing: no depth there."""
    return view._replace(depth_m=np.where(own, np.float32(0.0), view.depth_m))
