"""Who is around: scans and depth images in, people with names, places and covariances out."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.messages import DepthImage, LidarScan, PersonInfo, RgbdImage, Track, WorldMap
from robot.perception.company.figures import figures
from robot.perception.company.mapped import MappedSolids
from robot.perception.company.naming import Names
from robot.perception.company.returns import sweep
from robot.perception.company.tracking import Everybody, Somebody
from robot.perception.company.view import DepthView, of_depth, of_picture
from robot.se3 import SE3, Array, Vector3

FLOOR_M, FLOOR_PER_M2, HIGHEST_M = 0.06, 0.008, 2.3
"""What is lower is the floor, by the noise of depth at a range; and what is higher is nobody."""
NEAR_SELF_M, ARM_M = 0.42, 0.2
"""About the body, and about an arm with what it holds: what is seen there is the robot."""
PATCH_M, CHEST_M = 0.12, 1.0
EMPTY_SHARE, VIEW_M = 0.9, 3.6
"""Of a chest's pixels, and how far off a depth camera of 4 m is sure that there is none."""
STRANGER = "a person"
MOST_STRANGERS = 20


class Around(NamedTuple):
    """What is published.

    Attributes:
        tracks: of everybody; who was told of and was not seen yet is where they were told to be.
        strangers: who has no name.
        unsure: where somebody may be whom nobody has looked at, x and y [m] in W.
    """

    tracks: tuple[Track, ...]
    strangers: tuple[PersonInfo, ...]
    unsure: tuple[tuple[float, float], ...]


class Company:
    """Follows people."""

    def __init__(self) -> None:
        """Know nothing of the place."""
        self._solids = MappedSolids()
        self._everybody, self._names = Everybody(), Names()
        self._told: dict[str, Track] = {}
        self._strangers: dict[str, Track] = {}
        self._misses: dict[str, int] = {}
        self._body = np.zeros(2)
        self._arms: Array = np.zeros((0, 2, 2))

    def know(self, world_map: WorldMap) -> None:
        """Take what stands fast, and who an owner said is where."""
        people = {person.id for person in world_map.people}
        fast = (one for one in world_map.obstacles if one.id not in people)
        self._solids = MappedSolids(fast, world_map.places)
        for person in world_map.people:
            x_m, y_m, z_m = person.X_WO.p
            unseen = Track(id=person.id, X_WO=SE3((x_m, y_m, z_m)), seen_s=-math.inf)
            self._told.setdefault(person.id, unseen)
        self._names.tell({person.id: person.X_WO.p for person in world_map.people})

    def feel(self, X_WB: SE3, hands_W: Iterable[Vector3]) -> None:
        """Take where the robot's body and hands are, which its sensors see as well."""
        self._body = np.array(X_WB.p[:2])
        self._arms = np.array([[X_WB.p[:2], p_W[:2]] for p_W in hands_W]).reshape(-1, 2, 2)

    def forget(self) -> None:
        """Forget where everybody is: the robot was elsewhere than it thought."""
        self._everybody.forget()

    def scan(self, scan: LidarScan, X_WL: SE3) -> None:
        """Take one scan of a lidar at X_WL."""
        swept = sweep(scan, X_WL, self._solids)
        clusters = tuple(one for one in swept.clusters if not self._is_own(one.p_W[None])[0])
        self._everybody.scan(swept._replace(clusters=clusters))
        self._settle(scan.stamp_s)

    def see_depth(self, image: DepthImage, X_WC: SE3) -> None:
        """Take one depth image of a camera at X_WC."""
        self._see(of_depth(image, X_WC))

    def see_picture(self, image: RgbdImage, X_WC: SE3) -> None:
        """Take one picture of a camera at X_WC; one without depth tells nothing."""
        view = of_picture(image, X_WC)
        if view is not None:
            self._see(view)

    def around(self, now_s: float) -> Around:
        """Everybody, as it is believed."""
        self._settle(now_s)
        tracks = (*self._told.values(), *self._strangers.values())
        strangers = tuple(
            PersonInfo(id=one.id, name=STRANGER, X_WO=one.X_WO or SE3())
            for one in self._strangers.values()
        )
        unsure = tuple(
            (float(one.p_W[0]), float(one.p_W[1])) for one in self._everybody.unsure(now_s)
        )
        return Around(tracks, strangers, unsure)

    def _see(self, view: DepthView) -> None:
        height_m = view.points_W[..., 2]
        strange = (view.depth_m > 0.0) & (height_m < HIGHEST_M)
        strange &= height_m > FLOOR_M + FLOOR_PER_M2 * view.depth_m**2
        points = view.points_W[strange]
        keep = ~self._is_own(points[:, :2])
        keep &= self._solids.strange(points, view.depth_m[strange].astype(np.float64))
        strange[strange] = keep
        found = figures(view, strange)
        empty = [one for one in self._everybody.tracks if is_clear(view, one.p_W)]
        self._everybody.look(found, empty, view.stamp_s)
        for id, track in self._told.items():
            if math.isinf(track.seen_s) and track.X_WO is not None and not track.missing:
                self._miss_told(id, view, np.array(track.X_WO.p[:2]))

    def _miss_told(self, id: str, view: DepthView, p_W: Array) -> None:
        """Take it that somebody is not where they were told to be, once it is seen to be empty."""
        if not is_clear(view, p_W):
            return
        self._misses[id] = self._misses.get(id, 0) + 1
        if self._misses[id] >= 3:
            self._told[id] = _gone(self._told[id])
            self._names.empty(id)

    def _is_own(self, points: Array) -> NDArray[np.bool_]:
        """Which points of the floor, shape (n, 2), are under the robot or what it holds."""
        own = np.linalg.norm(points - self._body, axis=1) < NEAR_SELF_M
        for begin, end in self._arms:
            line = end - begin
            along = np.clip((points - begin) @ line / max(float(line @ line), 1e-9), 0.0, 1.0)
            own |= np.linalg.norm(points - begin - along[:, None] * line, axis=1) < ARM_M
        return own

    def _settle(self, now_s: float) -> None:
        """Bring names and tracks together."""
        for one in self._everybody.take_gone():
            name = self._names.of(one)
            if name:
                self._told[name] = _gone(self._told[name])
            self._names.left(one)
            stranger = f"somebody_{one.number}"
            if stranger in self._strangers:
                self._strangers[stranger] = _gone(self._strangers[stranger])
        believed = self._everybody.believed()
        self._names.settle(believed, now_s)
        live: set[str] = set()
        for one in believed:
            name = self._names.of(one)
            known = self._told if name else self._strangers
            id = name or f"somebody_{one.number}"
            known[id] = _track(id, one)
            live.add(id)
        for id, track in self._strangers.items():
            if id not in live and not track.missing:
                self._strangers[id] = _gone(track)
        while len(self._strangers) > MOST_STRANGERS:
            del self._strangers[next(iter(self._strangers))]


def is_clear(view: DepthView, p_W: Array) -> bool:
    """Whether nothing is seen at, or before, all of somebody's chest.

    What gives no depth counts as far away: the lidar sees who wears black.
    """
    X_CW = view.X_WC.inverse()
    x, y, z = X_CW.apply((float(p_W[0]), float(p_W[1]), CHEST_M)).tolist()
    if not 0.4 < z < VIEW_M:
        return False
    rows, columns = view.depth_m.shape
    u, v = columns / 2 - 0.5 + view.focal_px * x / z, rows / 2 - 0.5 + view.focal_px * y / z
    reach = view.focal_px * PATCH_M / z
    left, right = int(np.floor(u - reach)), int(np.ceil(u + reach)) + 1
    top, bottom = int(np.floor(v - reach)), int(np.ceil(v + reach)) + 1
    if left < 1 or top < 1 or right > columns - 1 or bottom > rows - 1:
        return False
    patch = view.depth_m[top:bottom, left:right]
    return bool(((patch == 0.0) | (patch > z + 0.35)).mean() >= EMPTY_SHARE)


def _gone(track: Track) -> Track:
    return Track(
        id=track.id, X_WO=track.X_WO, seen_s=track.seen_s, missing=True,
        covariance=track.covariance, posture=track.posture,
    )  # fmt: skip


def _track(id: str, one: Somebody) -> Track:
    x_m, y_m, vx, vy = one.state.tolist()
    walks = math.hypot(vx, vy) > 0.2
    yaw_rad = math.atan2(vy, vx) if walks else 0.0
    return Track(
        id=id,
        X_WO=SE3.from_xy_yaw(x_m, y_m, yaw_rad),
        seen_s=one.seen_s,
        covariance=tuple(one.covariance[:2, :2].ravel().tolist()),
        posture=f"{one.posture}, a hand up" if one.raises_hand else one.posture,
    )
