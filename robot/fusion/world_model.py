"""Where the known objects are believed to be, and which of them are gone from where they were."""

from __future__ import annotations

import math

import msgspec
import numpy as np
from numpy.typing import NDArray

from robot.messages import DepthImage, ObjectInfo, Sightings, Track
from robot.se3 import SE3, Vector3

FRAMES_TO_MISS = 3
MIN_DEPTH_M = 0.15
DEPTH_TOLERANCE_M = 0.03
EDGE_PX = 6


class WorldModel:
    """One track an object; sightings move it, clear views of an empty place mark it missing."""

    def __init__(self, *, camera_range_m: float) -> None:
        self._range_m = camera_range_m
        self._tracks: dict[str, Track] = {}
        self._radius_m: dict[str, float] = {}
        self._misses: dict[str, int] = {}

    def know(self, objects: tuple[ObjectInfo, ...]) -> None:
        """Learn which objects there are; those already tracked keep their tracks."""
        for info in objects:
            self._tracks.setdefault(info.id, Track(id=info.id, X_WO=None, seen_s=-math.inf))
            self._radius_m[info.id] = 0.5 * max(info.shape.size_m[:2])

    def tracks(self) -> tuple[Track, ...]:
        """Every track, in the order they became known."""
        return tuple(self._tracks.values())

    def see(self, sightings: Sightings, X_WC: SE3, depth: DepthImage | None) -> None:
        """Take one frame of the camera at X_WC; without depth nothing can be missed."""
        seen = {sighting.id: X_WC @ sighting.X_CO for sighting in sightings.objects}
        for name, X_WO in seen.items():
            self._tracks[name] = Track(id=name, X_WO=X_WO, seen_s=sightings.stamp_s)
            self._misses[name] = 0
        if depth is None:
            return
        view = View(depth, X_WC, range_m=self._range_m)
        for name, track in self._tracks.items():
            if track.X_WO is None or name in seen:
                continue
            if view.is_clear(track.X_WO.p, self._radius_m.get(name, 0.0)):
                self._misses[name] = self._misses.get(name, 0) + 1
                if self._misses[name] == FRAMES_TO_MISS:
                    self._tracks[name] = msgspec.structs.replace(track, missing=True)


class View:
    """A depth image from a known place: what it can say about points of the world."""

    def __init__(self, image: DepthImage, X_WC: SE3, *, range_m: float) -> None:
        self._X_CW = X_WC.inverse()
        self._range_m = range_m
        self._width, self._height = image.width, image.height
        self._focal_px = 0.5 * image.height / math.tan(0.5 * image.fovy_rad)
        flat: NDArray[np.float32] = np.frombuffer(image.depth_m, dtype=np.float32)
        self._depth_m = flat.reshape(image.height, image.width)

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
        patch = self._depth_m[top:bottom, left:right]
        return not bool(np.any((patch > 0.0) & (patch < front_m)))
