"""Where to look from next: of all places to stand, the one that shows most for the time it takes.

A view is a stance and a few directions of the head. What it shows is reckoned with the prior map
and the things seen so far: a point of a surface is seen from near enough, not at a grazing angle,
with nothing between. What it costs is the way to walk there, around walls and through doors. Where
likely points are worth more, taking the best ratio first is what brings the expected time to a find
down.
"""

from __future__ import annotations

import math
from functools import lru_cache

import msgspec
import mujoco
import numpy as np

from robot.model import looking
from robot.model.description import RobotDescription
from robot.planning.base_path import LEAST
from robot.planning.floor import Floor, with_room
from robot.planning.numerics import Indices, Mask, even
from robot.planning.requests import LookPlan, LookRequest, Stance
from robot.planning.robot_body import UPRIGHT, Body
from robot.planning.sight import Screens
from robot.planning.solids import Solid, solid, solids_of
from robot.se3 import Array, Vector3

CELL_M = 0.2
"""Distance of the places to stand that are tried: narrower than anything is looked into."""
NEAR_M = 1.9
"""Somewhat nearer than what perception takes for seen well, so that a planned view is one."""
GRAZING_RAD, STEEP_RAD = 0.06, 1.05
"""Least and greatest angle at which eyes look down on a surface; below that the chest is. Eyes that
are level with a small thing see it from the side."""
ABOVE_M = 0.04
"""Half the height of a small thing: so much above the surface the line of sight ends."""
STANDING_M = 0.05
"""What is so near to a point stands on it; perception takes that for seen up to 0.07 m."""
HEAD_SHARE = 0.95 / 1.4
"""Of how far a robot looks to a side (`looking.aside_rad`): a view that is planned is one where it
stands turned otherwise, too."""
HEADINGS = 8
SET_OFF_S, TURN_S, LOOK_S = 5.0, 1.5, 0.7
"""As timed in a flat and an office: setting off and stepping in cost seconds on any way."""
SWAY_M, NARROW_S_PER_M = 0.13, 120.0
"""Who stands sways, and steps in some centimetres off: with no more than the arms' own room they
touched walls or furniture in 7 of 30 tasks. A place that lacks all of it costs 16 s."""
APART_M, NEARER = 0.3, 0.75
"""A point that did not show is looked at from so far away from there: planned lines of sight pass
edges that the real ones, from a body that sways and stops centimetres off, do not. What did not
show may also have been too small to be made out: a share of that distance is nearer."""


class _View(msgspec.Struct, frozen=True):
    """What can be seen from a stance, by the points' rows, and what it takes to get there."""

    worth_per_s: float
    stance: Stance
    rows: Indices
    cell: int | None = None


def plan_look(body: Body, request: LookRequest) -> LookPlan:
    """The best view of the points asked for; a plan without a stance where there is none."""
    points, worth = np.array(request.points_W).reshape(-1, 3), np.array(request.worth)
    radius_m = body.description.body_radius_m
    around, start = request.around, request.start
    robot = body.description
    head_rad = HEAD_SHARE * looking.aside_rad(robot)
    floor = Floor(solids_of(around), with_room(around.map.bounds_m, *start[:2], radius_m=radius_m))
    standing = tuple(
        solid(thing.id, thing.X_WO, shape)
        for thing in around.map.obstacles
        for shape in thing.shapes
    )
    atlas = _atlas(standing, around.map.bounds_m, _eye_m(body))
    lengths_m = floor.ways_m(*start[:2], radius_m=LEAST * radius_m).lengths_m(atlas.cells)
    clearances_m = floor.clearances_m(atlas.cells)
    stands = clearances_m >= radius_m
    narrow_m = np.maximum(0.0, radius_m + SWAY_M - clearances_m)
    there_s = SET_OFF_S + lengths_m / looking.walk_m_s(robot) + LOOK_S + NARROW_S_PER_M * narrow_m
    things = Screens(
        tuple(solid(thing.id, thing.X_WO, thing.shape) for thing in around.objects),
        on_m=STANDING_M,
    )
    shown = atlas.shown(points) & (stands & (not request.stay))
    shown = _past(things, points, shown, atlas.eyes_W(atlas.cells))
    near, reached = atlas.shown_at(points, start[:2])[:, None], np.isfinite(lengths_m)
    near = _past(things, points, near, atlas.eyes_W(np.array([start[:2]])))[:, 0]
    turns = floor.clearance_m(*start[:2]) >= radius_m
    wanted, wanted_here = _from_elsewhere(request, atlas.cells, shown & reached, near)
    views = [
        *_views_here(points, worth, wanted_here, start, robot=robot, turns=turns),
        *_views_there(points, worth, wanted, atlas.cells, there_s, head_rad=head_rad),
    ]
    beyond = shown.any(axis=1) & ~near & ~(shown & reached).any(axis=1)
    cut_off = tuple(np.flatnonzero(beyond).tolist())
    if not views:
        return LookPlan(stance=None, cut_off=cut_off)
    best = max(views, key=lambda view: view.worth_per_s)
    return LookPlan(
        stance=best.stance,
        gazes_W=_gazes(points, worth, best, eye_m=_eye_m(body), cone_rad=looking.cone_rad(robot)),
        sees=tuple(best.rows.tolist()),
        worth_per_s=best.worth_per_s,
        length_m=0.0 if best.cell is None else float(lengths_m[best.cell]),
        cut_off=cut_off,
    )


def _from_elsewhere(
    request: LookRequest, cells: Array, shown: Mask, near: Mask
) -> tuple[Mask, Mask]:
    """The same views without those from where a point did not show, if others are left."""
    shown, near = shown.copy(), near.copy()
    for number, vain in request.vain_m.items():
        apart = np.hypot(*(cells - vain).T) >= APART_M
        here = math.dist(vain, request.start[:2]) >= APART_M
        if (shown[number] & apart).any() or (near[number] and here):
            shown[number] &= apart
            near[number] &= here
        point = request.points_W[number][:2]
        nearer = np.hypot(*(cells - point).T) < NEARER * math.dist(vain, point)
        if (shown[number] & nearer).any():
            shown[number] &= nearer
            near[number] &= math.dist(request.start[:2], point) < NEARER * math.dist(vain, point)
    return shown, near


def _past(things: Screens, points: Array, shown: Mask, eyes_W: Array) -> Mask:
    """Which of the lines of sight from points to eyes, shape (points, eyes), pass the things."""
    passed = np.zeros_like(shown)
    for number in np.flatnonzero(shown.any(axis=1)).tolist():
        eyes = np.flatnonzero(shown[number])
        above = points[number] + np.array([0.0, 0.0, ABOVE_M])
        passed[number, eyes] = things.in_sight(above, eyes_W[eyes])
    return passed


def _views_here(
    points: Array, worth: Array, near: Mask, start: Stance, *, robot: RobotDescription, turns: bool
) -> list[_View]:
    """The view without turning, and those after turning on the spot, if there is room for it."""
    head_rad, rate_rad_s = HEAD_SHARE * looking.aside_rad(robot), looking.turn_rad_s(robot)
    rows = np.flatnonzero(near)
    bearings = np.arctan2(points[rows, 1] - start[1], points[rows, 0] - start[0])
    views: list[_View] = []
    for k in range(HEADINGS if turns else 1):
        yaw = start[2] + 2.0 * math.pi * k / HEADINGS
        inside = rows[np.abs(_wrapped(bearings - yaw)) < head_rad]
        if len(inside):
            turn_s = TURN_S + abs(float(_wrapped(yaw - start[2]))) / rate_rad_s if k else 0.0
            rate = float(worth[inside].sum()) / (turn_s + LOOK_S)
            views.append(_View(rate, (*start[:2], float(_wrapped(yaw))), inside))
    return views


def _views_there(
    points: Array, worth: Array, shown: Mask, cells: Array, cost_s: Array, *, head_rad: float
) -> list[_View]:
    """The best view from somewhere else, if there is any.

    `shown` has a row a point and a column a cell, `cost_s` is what a view from each cell takes.
    """
    rows, columns = np.nonzero(shown)
    if not len(rows):
        return []
    off = points[rows, :2] - cells[columns]
    bearings = np.arctan2(off[:, 1], off[:, 0])
    best = (0.0, 0, 0.0)
    for yaw in (2.0 * math.pi * k / HEADINGS for k in range(HEADINGS)):
        inside = np.abs(_wrapped(bearings - yaw)) < head_rad
        gains = np.bincount(columns[inside], worth[rows[inside]], minlength=len(cells))
        rates = gains / np.where(np.isfinite(cost_s), cost_s, np.inf)
        cell = int(np.argmax(rates))
        best = max(best, (float(rates[cell]), cell, yaw))
    rate, cell, yaw = best
    inside = (columns == cell) & (np.abs(_wrapped(bearings - yaw)) < head_rad)
    mean = _mean_bearing(bearings[inside], worth[rows[inside]])
    seen = (columns == cell) & (np.abs(_wrapped(bearings - mean)) < head_rad)
    x_m, y_m = cells[cell].tolist()
    return [_View(rate, (x_m, y_m, mean), rows[seen], cell)]


def _gazes(
    points: Array, worth: Array, view: _View, *, eye_m: float, cone_rad: float
) -> tuple[Vector3, ...]:
    """Points to look at so that all of a view comes into the picture, what is worth most first."""
    eye = np.array((*view.stance[:2], eye_m))
    left, lines = view.rows, points - eye
    lines /= np.maximum(np.linalg.norm(lines, axis=1, keepdims=True), 1e-9)
    gazes: list[Vector3] = []
    while len(left):
        together = lines[left] @ lines[left].T > math.cos(cone_rad)
        first = int(np.argmax(together @ worth[left]))
        x, y, z = points[left[first]].tolist()
        gazes.append((x, y, z))
        left = left[~together[first]]
    return tuple(gazes)


class _Atlas:
    """From where on the floor of a map each point can be seen; remembered point by point."""

    def __init__(
        self,
        standing: tuple[Solid, ...],
        bounds_m: tuple[float, float, float, float],
        eye_m: float,
    ) -> None:
        x0, y0, x1, y1 = bounds_m
        xs = even(x0, x1, 1 + max(1, round((x1 - x0) / CELL_M)))
        ys = even(y0, y1, 1 + max(1, round((y1 - y0) / CELL_M)))
        grid_x, grid_y = np.meshgrid(xs, ys)
        self.cells = np.stack([grid_x.ravel(), grid_y.ravel()], axis=1)
        self._screens, self._eye_m = Screens(standing), eye_m
        self._known: dict[tuple[float, ...], Mask] = {}

    def shown(self, points: Array) -> Mask:
        """Which points are seen from which cells, shape (points, cells)."""
        rows = [self._shown(tuple(point)) for point in points.tolist()]
        return np.array(rows, dtype=bool).reshape(len(points), len(self.cells))

    def shown_at(self, points: Array, at: tuple[float, float]) -> Mask:
        """Which points are seen from one place, shape (points,)."""
        here, seen = np.array([at]), np.zeros(len(points), dtype=bool)
        for number in np.flatnonzero((np.abs(points[:, :2] - here) < NEAR_M).all(axis=1)).tolist():
            seen[number] = self._sees(points[number], here)[0]
        return seen

    def eyes_W(self, cells: Array) -> Array:
        """The eyes of one who stands on each of some places, shape (n, 3)."""
        return np.column_stack([cells, np.full(len(cells), self._eye_m)])

    def _shown(self, point: tuple[float, ...]) -> Mask:
        if point not in self._known:
            self._known[point] = self._sees(np.array(point), self.cells)
        return self._known[point]

    def _sees(self, point: Array, cells: Array) -> Mask:
        off = cells - point[:2]
        near = np.flatnonzero((np.abs(off) < NEAR_M).all(axis=1))  # little of a large home
        aside_m, above_m = np.hypot(off[near, 0], off[near, 1]), self._eye_m - point[2]
        slope = np.arctan2(above_m, aside_m)
        fine = (np.hypot(aside_m, above_m) < NEAR_M) & (slope < STEEP_RAD)
        fine &= (slope > GRAZING_RAD) | (above_m < ABOVE_M)
        above = point + np.array([0.0, 0.0, ABOVE_M])
        fine[fine] = self._screens.in_sight(above, self.eyes_W(cells[near[fine]]))
        seen: Mask = np.zeros(len(cells), dtype=bool)
        seen[near] = fine
        return seen


@lru_cache(maxsize=4)
def _atlas(
    standing: tuple[Solid, ...], bounds_m: tuple[float, float, float, float], eye_m: float
) -> _Atlas:
    return _Atlas(standing, bounds_m, eye_m)


@lru_cache(maxsize=4)
def _eye_m(body: Body) -> float:
    """How high the camera is over the floor when the robot stands."""
    standing, data = body.standing(UPRIGHT), body.model.data()
    body.model.write_base(data, standing.X_SB)
    body.model.write_joints(data, standing.q)
    mujoco.mj_kinematics(body.model.model, data)
    camera = body.model.site_id(body.description.sensors.camera.site)
    return float(body.model.site_pose(data, camera).p[2])


def _mean_bearing(bearings: Array, worth: Array) -> float:
    return math.atan2(float(worth @ np.sin(bearings)), float(worth @ np.cos(bearings)))


def _wrapped(angles_rad: Array | float) -> Array:
    return (np.asarray(angles_rad) + math.pi) % (2.0 * math.pi) - math.pi
