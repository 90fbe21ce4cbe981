"""The world as a drawing from above, and what moves in it, as plain values for the journal."""

from __future__ import annotations

import math
from itertools import product
from typing import TypeAlias

from robot.messages import Obstacle, Place, Shape, WorldMap, WorldState
from robot.se3 import SE3

MOVED_M, TURNED_RAD = 0.01, 0.02
"""What the robot moves or turns by without being news."""
SHIFTED_M = 0.02
"""What the belief where an object is may shift by without being news."""

Plain: TypeAlias = dict[str, object]


def drawing(world_map: WorldMap) -> Plain:
    """The data of a ``map`` event: outlines in W [m], names, colours; heights are left out.

    An outline is a list of corners (x, y).
    """
    people = {person.id for person in world_map.people}
    rooms = [p for p in world_map.places if p.floor and p.id == p.room]
    spots = [p for p in world_map.places if p.floor and p.id != p.room]
    return {
        "name": world_map.name,
        "bounds_m": [_m(value) for value in world_map.bounds_m],
        "rooms": [{"name": p.name, "outline_m": _place_outline(p)} for p in rooms],
        "spots": [{"name": p.name, "outline_m": _place_outline(p)} for p in spots],
        "furniture": [
            {"id": o.id, "name": o.name, "outline_m": outline(o)}
            for o in world_map.obstacles
            if o.id not in people
        ],
        "objects": [{"id": o.id, "name": o.name, "color": o.color} for o in world_map.objects],
        "people": [
            {"name": p.name, "x_m": _m(p.X_WO.p[0]), "y_m": _m(p.X_WO.p[1]), "radius_m": p.radius_m}
            for p in world_map.people
        ],
    }


class PoseWatch:
    """Where the robot and the things are believed to be, told when it changes.

    The data of a ``pose`` event: ``x_m``, ``y_m``, ``yaw_rad`` of the pelvis in W, the body's
    ``mode`` when it is another one, and those ``objects`` that are somewhere else than before, by
    id: ``x_m``, ``y_m``, ``z_m``, ``held`` by which hand, ``missing`` where it should be; and
    ``unmapped`` outlines that the map does not explain, by id, empty when gone.
    """

    def __init__(self) -> None:
        """Nothing is known."""
        self._pose = (math.inf, math.inf, 0.0)
        self._mode = ""
        self._objects: dict[str, Plain] = {}
        self._unmapped: dict[str, list[list[float]]] = {}

    def news(self, world: WorldState, *, mode: str) -> Plain:
        """The data of a ``pose`` event, empty when there is no news."""
        x_m, y_m, _ = world.X_WB.p
        pose = (_m(x_m), _m(y_m), _m(world.X_WB.yaw_rad))
        news: Plain = {}
        if mode != self._mode:
            news["mode"] = self._mode = mode
        objects = self._moved(world)
        if objects:
            news["objects"] = objects
        unmapped = self._unexplained(world.unmapped)
        if unmapped:
            news["unmapped"] = unmapped
        if not news and not _differ(pose, self._pose):
            return {}
        self._pose = pose
        return {"x_m": pose[0], "y_m": pose[1], "yaw_rad": pose[2], **news}

    def _moved(self, world: WorldState) -> dict[str, Plain]:
        moved: dict[str, Plain] = {}
        for track in world.tracks:
            if track.X_WO is None:
                continue
            x_m, y_m, z_m = (_m(value) for value in track.X_WO.p)
            entry: Plain = {"x_m": x_m, "y_m": y_m, "z_m": z_m}
            if track.held_by:
                entry["held"] = track.held_by
            if track.missing:
                entry["missing"] = True
            if _is_news(self._objects.get(track.id), entry):
                moved[track.id] = self._objects[track.id] = entry
        return moved

    def _unexplained(self, unmapped: tuple[Obstacle, ...]) -> dict[str, list[list[float]]]:
        seen = {obstacle.id: outline(obstacle) for obstacle in unmapped}
        news = {
            name: corners
            for name, corners in seen.items()
            if name not in self._unmapped or _apart(corners, self._unmapped[name])
        }
        gone: dict[str, list[list[float]]] = {n: [] for n in self._unmapped if n not in seen}
        self._unmapped.update(news)
        for name in gone:
            del self._unmapped[name]
        return {**news, **gone}


def outline(obstacle: Obstacle) -> list[list[float]]:
    """The smallest rectangle along the obstacle's own axes, as corners in W [m]."""
    corners = [corner for shape in obstacle.shapes for corner in _corners(shape)]
    xs, ys = [x for x, _ in corners] or [0.0], [y for _, y in corners] or [0.0]
    return _rectangle(obstacle.X_WO, (min(xs), min(ys), max(xs), max(ys)))


def _corners(shape: Shape) -> list[tuple[float, float]]:
    half_x, half_y = 0.5 * shape.size_m[0], 0.5 * shape.size_m[1]
    points = [shape.X_BodyShape.apply((a * half_x, b * half_y, 0.0)) for a, b in _SIGNS]
    return [(float(point[0]), float(point[1])) for point in points]


_SIGNS = tuple(product((-1.0, 1.0), repeat=2))


def _place_outline(place: Place) -> list[list[float]]:
    x, y = 0.5 * place.size_m[0], 0.5 * place.size_m[1]
    return _rectangle(place.X_WP, (-x, -y, x, y))


def _rectangle(X_WA: SE3, box: tuple[float, float, float, float]) -> list[list[float]]:
    x0, y0, x1, y1 = box
    points = [X_WA.apply((x, y, 0.0)) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
    return [[_m(float(point[0])), _m(float(point[1]))] for point in points]


def _differ(a: tuple[float, float, float], b: tuple[float, float, float]) -> bool:
    turned_rad = abs(math.remainder(a[2] - b[2], math.tau))
    return math.dist(a[:2], b[:2]) > MOVED_M or turned_rad > TURNED_RAD


def _is_news(before: Plain | None, after: Plain) -> bool:
    if before is None or before.keys() != after.keys() or before.get("held") != after.get("held"):
        return True
    return any(abs(_number(before[k]) - _number(after[k])) > SHIFTED_M for k in _AXES)


_AXES = ("x_m", "y_m", "z_m")


def _number(value: object) -> float:
    return value if isinstance(value, float) else 0.0


def _apart(a: list[list[float]], b: list[list[float]]) -> bool:
    return any(math.dist(p, q) > 2.0 * SHIFTED_M for p, q in zip(a, b, strict=True))


def _m(value: float) -> float:
    """To the millimetre (or milliradian); -0.0 is 0.0."""
    return round(value, 3) + 0.0
