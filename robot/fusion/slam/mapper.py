"""Simultaneous localisation and mapping in the plane: scans and odometry in, poses out."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from robot.fusion.slam import loops
from robot.fusion.slam.front_end import FrontEnd
from robot.fusion.slam.loops import Loop, Places
from robot.fusion.slam.numerics import inverse_of
from robot.fusion.slam.planar import between, compose, wrapped
from robot.fusion.slam.pose_graph import PoseGraph
from robot.fusion.slam.scan import Scan
from robot.se3 import Array

STEP_M = 0.03
STEP_RAD = np.radians(0.5)
LOOP_M = 0.03
LOOP_RAD = np.radians(0.5)
"""1 sigma of a relative pose from the front end, and from a loop."""
OPEN = np.diag([10.0, 10.0, 100.0])
"""Information of a direction that a match says nothing of: 0.3 m, 0.1 rad."""
OPTIMISE_EVERY = 25
CONFIRM = 3
CONFIRM_WITHIN = 15
CONFIRM_M = 0.4
CONFIRM_RAD = np.radians(3.0)
"""A far loop counts when this many of so many key frames say the same."""


@dataclass
class Mapper:
    """Builds a map, scan by scan.

    Attributes:
        scans: of the key frames.
        poses: of the key frames, smoothed so far, (n, 3).
        graph: what is known between them.
    """

    front: FrontEnd = field(default_factory=FrontEnd)
    closing: bool = True

    def __post_init__(self) -> None:
        """Begin empty."""
        self.scans: list[Scan] = []
        self.graph = PoseGraph()
        self.poses = np.zeros((0, 3))
        self._tracked: list[Array] = []
        self._of_keys: list[int] = []
        self._fronts: list[Array] = []
        self._places = Places(self.scans)
        self._pending: list[Loop] = []
        self._since = 0

    def add(self, scan: Scan, odometry: Array) -> None:
        """Take the next scan."""
        tracked = self.front.track(scan, odometry)
        self._tracked.append(tracked.pose)
        if not tracked.key:
            return
        self._of_keys.append(len(self._tracked) - 1)
        self._fronts.append(tracked.pose)
        self.scans.append(scan)
        if len(self.scans) == 1:
            self.poses = tracked.pose[None].copy()
            return
        step = between(self._fronts[-2], self._fronts[-1])
        self.graph.add(
            len(self.scans) - 2,
            len(self.scans) - 1,
            step,
            _information(tracked.information, STEP_M, STEP_RAD, blind=tracked.blind),
            robust=False,
            length_m=loops.length_of(step, tracked.blind),
        )
        self.poses = np.vstack([self.poses, compose(self.poses[-1], step)])
        if self.closing:
            self._close()

    def _close(self) -> None:
        added = far = False
        for loop in self._seen_again(len(self.scans) - 1):
            if loop.window_m > loops.ALONE_M:
                far = self._confirm(loop) or far
            else:
                self._add(loop)
                added = True
        self._since += added
        if far or self._since >= OPTIMISE_EVERY:
            self.poses = self.graph.optimised(self.poses, iterations=20 if far else 3)
            self._since = 0
            if far:
                self._places.forget()
                self._pending.clear()

    def _seen_again(self, current: int) -> list[Loop]:
        """The loops that a key frame closes with older ones."""
        way_m = loops.along(self.poses)
        place, heading = loops.unsureness(self.graph, current, way_m)
        targets = loops.targets(
            self.poses, current, place, sight_m=self._sight_m(current), way_m=way_m
        )
        closed = [
            loops.close(
                self._places,
                self.scans[current],
                self.poses,
                begin=target,
                end=current,
                place_m=float(place[target]),
                heading_rad=float(heading[target]),
            )
            for target in targets
        ]
        return [loop for loop in closed if loop is not None]

    def _confirm(self, loop: Loop) -> bool:
        """Keep a far loop until others say the same; whether it now counts."""
        self._pending = [other for other in self._pending if other.end > loop.end - CONFIRM_WITHIN]
        self._pending.append(loop)
        mine = compose(self.poses[loop.begin], loop.measured)
        same: list[Loop] = []
        for other in self._pending:
            theirs = compose(
                compose(self.poses[other.begin], other.measured),
                between(self.poses[other.end], self.poses[loop.end]),
            )
            apart = between(mine, theirs)
            if np.hypot(apart[0], apart[1]) < CONFIRM_M and abs(apart[2]) < CONFIRM_RAD:
                same.append(other)
        if len({other.end for other in same}) < CONFIRM:
            return False
        for other in same:
            self._add(other)
        return True

    def _add(self, loop: Loop) -> None:
        self.graph.add(
            loop.begin,
            loop.end,
            loop.measured,
            _information(loop.information, LOOP_M, LOOP_RAD),
            robust=True,
            length_m=loops.LENGTH_M,
        )

    def _sight_m(self, key: int) -> float:
        points = self.scans[key].points
        return float(np.median(np.hypot(points[:, 0], points[:, 1]))) if len(points) else 0.0

    def finish(self) -> None:
        """Bring all measurements together, and look again where no loop was found on the way."""
        self.poses = self.graph.optimised(self.poses)
        if not self.closing:
            return
        self._places.forget()
        looped = self.graph.looped()
        for current in range(1, len(self.scans)):
            if current not in looped:
                for loop in self._seen_again(current):
                    if loop.window_m <= loops.ALONE_M:
                        self._add(loop)
        self.poses = self.graph.optimised(self.poses)

    def trajectory(self) -> Array:
        """Poses (n, 3) of all scans: between two key frames the front end's way, bent to fit."""
        tracked = np.array(self._tracked).reshape(-1, 3)
        keys = np.array(self._of_keys)
        before = np.searchsorted(keys, np.arange(len(tracked)), side="right") - 1
        after = np.minimum(before + 1, len(keys) - 1)
        from_before = compose(self.poses[before], between(tracked[keys[before]], tracked))
        from_after = compose(self.poses[after], between(tracked[keys[after]], tracked))
        span = np.maximum(keys[after] - keys[before], 1)
        share = np.clip((np.arange(len(tracked)) - keys[before]) / span, 0.0, 1.0)
        share = np.where(after == before, 0.0, share)
        apart = from_after - from_before
        apart[:, 2] = wrapped(apart[:, 2])
        result = from_before + share[:, None] * apart
        result[:, 2] = wrapped(result[:, 2])
        return result


def _information(
    matched: Array, sigma_m: float, sigma_rad: float, *, blind: Array | None = None
) -> Array:
    """Of a match whose errors have a floor: what the points leave open stays open.

    Args:
        matched: (3, 3) information of the match.
        sigma_m: the floor of its place.
        sigma_rad: the floor of its heading.
        blind: (3,) variances that are added.
    """
    floor = np.diag([sigma_m**2, sigma_m**2, sigma_rad**2])
    if blind is not None:
        floor = floor + np.diag(blind)
    return inverse_of(floor + inverse_of(matched + OPEN))
