"""Writes what is sensed and planned, for those who look on: see `executive.journal.sensed`."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from PIL import Image

from executive.blackboard import BODY, GOAL, HELD, WORLD, Blackboard
from executive.journal import sensed
from executive.journal.files import Lines
from executive.journal.motion import flat
from executive.journal.sensed import ArmMotion, Planar, Reach, Scan, Sensed
from robot import shots
from robot.link import BodyLink
from robot.messages import BodyState, DepthImage, LidarScan, Track, WorldState
from robot.model.description import RobotDescription
from robot.planning.requests import (
    ArmPlan,
    BasePath,
    PickPlan,
    PickRequest,
    PlacePlan,
    PlaceRequest,
    PlanRequest,
    PlanResult,
    Stance,
)
from robot.se3 import SE3
from robot.shots import Shot

TORQUE_S, SCAN_S, DEPTH_S, HEAT_S = 0.2, 0.5, 1.0, 2.0
"""How often each of them is written (design: what an eye follows, and a disk does not notice)."""
SEEN_S = 0.7
"""Who was seen so lately is seen now: people are looked for less often than things."""
MOST_WIDE = 80
"""Pixels of a row of a depth image that are kept: enough to see what stands where."""
LANDED_M = 0.01
"""What a planned landing shifts by without being news."""


class SensedWatch:
    """Follows one executive: `update` after every tick, `planned` at answers of the planner."""

    def __init__(
        self,
        board: Blackboard,
        link: BodyLink,
        description: RobotDescription,
        *,
        lines: Lines,
        depths: Lines,
        after_s: float = -math.inf,
    ) -> None:
        """Write to `lines`, and depth images to `depths`, what comes after a time."""
        self._board, self._link, self._description = board, link, description
        self._lines, self._depths = lines, depths
        self._after_s = after_s
        self._plans: dict[str, Any] = {}
        self._due_s: dict[str, float] = {}
        self._steps: tuple[tuple[int, float, float, float], ...] = ()
        self._sees: tuple[str, ...] | None = None
        self._held: tuple[str, ...] = ()
        self._has_way = self._has_reach = False
        self._walked = False

    def planned(self, request: PlanRequest, result: PlanResult) -> None:
        """Hear of an answer of the planner; it is written after this tick."""
        match result:
            case BasePath():
                self._plans["way"] = tuple(_planar(one) for one in result.waypoints)
            case PickPlan() if isinstance(request, PickRequest):
                hand = (result.X_WG_pre, result.X_WG_grasp, result.X_WG_lift)
                self._plans["reach"] = _reach("pick", result, request.object_id, hand)
            case PlacePlan() if isinstance(request, PlaceRequest):
                hand = (result.X_WG_pre, result.X_WG_release, result.X_WG_retreat)
                self._plans["reach"] = _reach("place", result, request.held.id, hand)
            case ArmPlan():
                self._plans["arm"] = ArmMotion(
                    side=result.side,
                    motors=tuple(self._description.indices(f"{result.side}_arm")),
                    times_s=tuple(round(float(one), 3) for one in result.times_s),
                    positions=tuple(
                        tuple(round(float(q), 3) for q in positions)
                        for positions in result.positions_rad
                    ),
                    clear_m=round(float(result.clearance_m), 3),
                )
            case _:
                pass

    def update(self, now_s: float) -> None:
        """Write what is new since the last line."""
        body, world = self._board.read(BODY), self._board.read(WORLD)
        if body is None or world is None or now_s <= self._after_s:
            return
        news = self._end_plans(body) | self._plans
        self._plans = {}
        self._has_way = bool(news.get("way", self._has_way))
        self._has_reach = "reach" in news or (self._has_reach and "no_reach" not in news)
        news |= self._landings(body, world) | self._sights(world, now_s)
        if self._is_due("torque", TORQUE_S, now_s):
            news["torque"] = tuple(round(float(one), 1) for one in body.tau_nm)
        if self._is_due("heat", HEAT_S, now_s):
            news["heat"] = tuple(round(float(one), 1) for one in body.temperature_c)
        scan = self._link.lidar()
        if scan is not None and self._is_due("scan", SCAN_S, now_s):
            news["scan"] = _scan(scan)
        if news:
            self._lines.append(sensed.encode(Sensed(t_s=round(now_s, 3), **news)))
        depth = self._link.depth()
        if depth is not None and depth.depth_m and self._is_due("depth", DEPTH_S, now_s):
            range_m = self._description.sensors.camera.range_m
            self._depths.append(shots.encode(_depth(depth, range_m=range_m)))

    def _is_due(self, what: str, period_s: float, now_s: float) -> bool:
        if now_s < self._due_s.get(what, -math.inf):
            return False
        self._due_s[what] = now_s + period_s - 1e-6
        return True

    def _end_plans(self, body: BodyState) -> dict[str, Any]:
        """Plans that are over: a way once it was walked, a grasp once the hand has it."""
        news: dict[str, Any] = {}
        walks, held = body.mode == "walk", tuple(sorted(self._board.read(HELD).values()))
        idle = not self._board.read(GOAL)
        if self._has_way and (idle or (self._walked and not walks)):
            news["way"] = ()
        if self._has_reach and (idle or held != self._held):
            news["no_reach"] = True
        self._walked, self._held = walks, held
        return news

    def _landings(self, body: BodyState, world: WorldState) -> dict[str, Any]:
        steps = tuple(
            (
                0 if one.side == "left" else 1,
                *_planar_of(world.X_WN @ SE3.from_xy_yaw(one.x_m, one.y_m, one.yaw_rad)),
            )
            for one in body.steps
        )
        same = len(steps) == len(self._steps) and all(
            one[0] == other[0] and math.dist(one[1:3], other[1:3]) < LANDED_M
            for one, other in zip(steps, self._steps, strict=True)
        )
        if same:
            return {}
        self._steps = steps
        return {"steps": steps}

    def _sights(self, world: WorldState, now_s: float) -> dict[str, Any]:
        sees = tuple(_seen((*world.tracks, *world.people), now_s))
        if sees == self._sees:
            return {}
        self._sees = sees
        return {"sees": sees, "source": world.source}


def _seen(tracks: Iterable[Track], now_s: float) -> list[str]:
    return sorted(
        one.id
        for one in tracks
        if one.X_WO is not None and not one.missing and now_s - one.seen_s <= SEEN_S
    )


def _scan(scan: LidarScan) -> Scan:
    ranges_mm = np.rint(1000.0 * np.array(scan.ranges_m))
    ranges_mm[~((ranges_mm > 0.0) & (ranges_mm < np.iinfo(np.uint16).max))] = 0
    return Scan(
        from_rad=round(scan.angle_min_rad, 5),
        step_rad=round(scan.angle_step_rad, 6),
        ranges_mm=ranges_mm.astype("<u2").tobytes(),
    )


def _depth(image: DepthImage, *, range_m: float) -> Shot:
    """The depth image in shades of grey: 0 is nothing, 255 what is as far as it sees."""
    coarser = -(-image.width // MOST_WIDE)
    pixels = image.pixels()[::coarser, ::coarser]
    grey = np.where(pixels > 0.0, np.clip(np.rint(255.0 * pixels / range_m), 1, 255), 0)
    data = io.BytesIO()
    Image.fromarray(grey.astype(np.uint8)).save(data, "PNG", compress_level=3)
    height, width = grey.shape
    focal_px = 0.5 * image.height / math.tan(0.5 * image.fovy_rad) / coarser
    return Shot(
        t_s=round(image.stamp_s, 3),
        kind="depth",
        type="png",
        data=data.getvalue(),
        width=width,
        height=height,
        focal_px=(focal_px, focal_px),
        centre_px=(0.5 * (image.width - 1) / coarser, 0.5 * (image.height - 1) / coarser),
        range_m=range_m,
        source=image.source,
    )


def _reach(kind: str, plan: PickPlan | PlacePlan, thing: str, hand: tuple[SE3, SE3, SE3]) -> Reach:
    return Reach(
        kind="pick" if kind == "pick" else "place",
        side=plan.side,
        thing=thing,
        hand=(flat(hand[0]), flat(hand[1]), flat(hand[2])),
        stance=_planar(plan.stance),
    )


def _planar(stance: Stance) -> Planar:
    x, y, yaw = (round(float(one), 3) for one in stance)
    return (x, y, yaw)


def _planar_of(X: SE3) -> Planar:
    return _planar((X.p[0], X.p[1], X.yaw_rad))
