"""Rooms made from a seed, with people and clutter, as a planar laser at knee height sees them.

People are two ellipses in stride, or one (a skirt, a coat, a leg behind the other); clutter is
what looks like them: legs of chairs and tables, poles, bins, boxes, corners, broken walls.
Nothing in here comes from a recording.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from robot.perception.people.scan import Array, PlanarScan

NOBODY = -1
SKIN_M = 0.012
"""Trousers fold: their surface strays by so much."""


@dataclass(frozen=True)
class Laser:
    """A planar laser."""

    step_rad: float
    beams: int
    noise_m: float
    reach_m: float
    lost: float
    """Share of beams that do not come back."""


@dataclass
class Room:
    """What stands in a room. Numbers of persons are `NOBODY` for things."""

    ellipses: list[tuple[float, float, float, float, float]] = field(
        default_factory=list[tuple[float, float, float, float, float]]
    )
    """Centre x, y, half axes, direction of the first: [m] and [rad]."""
    persons: list[int] = field(default_factory=list[int])
    """Whose each ellipse is."""
    walls: list[tuple[float, float, float, float]] = field(
        default_factory=list[tuple[float, float, float, float]]
    )
    """From x, y to x, y [m]."""

    def add_box(self, x_m: float, y_m: float, length_m: float, width_m: float, yaw: float) -> None:
        """Four walls."""
        cos, sin = np.cos(yaw), np.sin(yaw)
        corners = 0.5 * np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * (length_m, width_m)
        corners = corners @ np.array([[cos, sin], [-sin, cos]]) + (x_m, y_m)
        for one, other in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            self.walls.append((*one.tolist(), *other.tolist()))

    def add_round(self, x_m: float, y_m: float, radius_m: float, person: int = NOBODY) -> None:
        """Something round."""
        self.ellipses.append((x_m, y_m, radius_m, radius_m, 0.0))
        self.persons.append(person)


def a_laser(random: Generator) -> Laser:
    """One of the kinds there are."""
    step_rad = np.radians(random.choice([0.25, 0.352, 0.352, 0.352, 0.5, 0.5, 1.0]))
    view_rad = np.radians(random.choice([180.0, 240.0, 270.0, 360.0]))
    return Laser(
        step_rad=float(step_rad),
        beams=int(view_rad / step_rad),
        noise_m=float(random.choice([0.003, 0.006, 0.01, 0.015, 0.02])),
        reach_m=float(random.choice([5.6, 10.0, 12.0, 30.0])),
        lost=float(random.uniform(0.0, 0.02)),
    )


def a_room(random: Generator) -> Room:
    """Walls with gaps and niches, furniture, clutter and people around the laser at the origin."""
    room = Room()
    length_m, width_m = random.uniform(4.0, 14.0), random.uniform(3.0, 10.0)
    x_m, y_m = random.uniform(-0.35, 0.35) * length_m, random.uniform(-0.35, 0.35) * width_m
    yaw = random.uniform(0.0, np.pi)
    _add_walls(room, random, (x_m, y_m, length_m, width_m, yaw))
    for _ in range(random.integers(0, 4)):
        _add_chair(room, random, _somewhere(random))
    for _ in range(random.integers(0, 3)):
        _add_table(room, random, _somewhere(random))
    for _ in range(random.integers(0, 5)):  # boxes, cupboards, cases, computers, bags
        size_m = random.uniform(0.08, 1.0, 2)
        room.add_box(*_somewhere(random), *size_m.tolist(), random.uniform(0.0, np.pi))
    for _ in range(random.integers(0, 3)):  # poles, bins, flower pots
        room.add_round(*_somewhere(random), random.choice([0.015, 0.025, 0.04, 0.12, 0.16, 0.22]))
    for person in range(random.integers(1, 5)):
        add_person(room, random, _somewhere(random), person=person)
    return room


def add_person(room: Room, random: Generator, place_m: tuple[float, float], *, person: int) -> None:
    """Two legs in some phase of a stride, or one wide thing."""
    heading = random.uniform(0.0, 2.0 * np.pi)
    ahead, left = np.array([np.cos(heading), np.sin(heading)]), None
    left = np.array([-ahead[1], ahead[0]])
    if random.random() < 0.08:  # a skirt, a long coat
        half_m = random.uniform(0.12, 0.22, 2)
        room.ellipses.append((*place_m, float(half_m[0]), float(half_m[1]), heading))
        room.persons.append(person)
        return
    half_stride_m = random.choice([0.0, 1.0], p=[0.25, 0.75]) * random.uniform(-0.35, 0.35)
    half_width_m = random.uniform(0.05, 0.17)
    along_m, across_m = random.uniform(0.045, 0.10), random.uniform(0.04, 0.085)
    for side in (-1.0, 1.0):
        centre = np.array(place_m) + side * (half_stride_m * ahead + half_width_m * left)
        turn = heading + random.normal(0.0, 0.2)
        room.ellipses.append((*centre.tolist(), along_m, across_m, turn))
        room.persons.append(person)


def _somewhere(random: Generator) -> tuple[float, float]:
    """A place that is not on top of the laser: as often near as far."""
    distance_m, bearing = random.uniform(0.45, 6.0), random.uniform(-np.pi, np.pi)
    return float(distance_m * np.cos(bearing)), float(distance_m * np.sin(bearing))


def _add_walls(
    room: Room, random: Generator, box: tuple[float, float, float, float, float]
) -> None:
    """The room's own walls, with doors in them, and a neighbouring room's behind."""
    whole = Room()
    whole.add_box(*box)
    for grown in (1.4, 2.0):
        whole.add_box(box[0], box[1], box[2] * grown, box[3] * grown, box[4])
    for x1, y1, x2, y2 in whole.walls:
        one, other = np.array([x1, y1]), np.array([x2, y2])
        cuts = np.sort(random.random(2 * random.integers(0, 4)))
        ends = [0.0, *cuts.tolist(), 1.0]
        normal = np.array([-(other - one)[1], (other - one)[0]])
        normal /= np.linalg.norm(normal)
        for begin, end in zip(ends[::2], ends[1::2], strict=True):  # every second piece is a door
            back = normal * random.choice([0.0, 0.0, 0.1, 0.3])
            piece = [*(one + begin * (other - one) + back), *(one + end * (other - one) + back)]
            room.walls.append((piece[0], piece[1], piece[2], piece[3]))


def _add_chair(room: Room, random: Generator, place_m: tuple[float, float]) -> None:
    """Four legs, or a star of five feet around a column."""
    centre, yaw = np.array(place_m), random.uniform(0.0, 2.0 * np.pi)
    count = int(random.choice([4, 5]))
    if count == 5:
        room.add_round(*place_m, random.uniform(0.02, 0.045))
    reach_m, radius_m = random.uniform(0.2, 0.34), random.uniform(0.008, 0.025)
    for leg in range(count):
        angle = yaw + 2.0 * np.pi * leg / count
        at = centre + reach_m * np.array([np.cos(angle), np.sin(angle)])
        if count == 5 and random.random() < 0.5:
            out = centre + 1.1 * (at - centre)
            room.walls.append((*(0.6 * at + 0.4 * centre).tolist(), *out.tolist()))
        else:
            room.add_round(float(at[0]), float(at[1]), radius_m)


def _add_table(room: Room, random: Generator, place_m: tuple[float, float]) -> None:
    """Legs at the corners, round or square."""
    size_m, yaw = random.uniform(0.5, 1.8, 2), random.uniform(0.0, np.pi)
    thick_m = random.uniform(0.03, 0.09)
    turned = np.array([[np.cos(yaw), np.sin(yaw)], [-np.sin(yaw), np.cos(yaw)]])
    for corner in 0.5 * np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * size_m @ turned:
        x_m, y_m = (corner + place_m).tolist()
        if random.random() < 0.5:
            room.add_box(x_m, y_m, thick_m, thick_m, yaw)
        else:
            room.add_round(x_m, y_m, 0.5 * thick_m)


def seen(
    room: Room, laser: Laser, random: Generator, *, t_s: float = 0.0
) -> tuple[PlanarScan, NDArray[np.intp]]:
    """A scan of a room, and whose leg each of its returns is (`NOBODY`: nobody's)."""
    step_rad, beams = laser.step_rad, laser.beams
    begin_rad = -0.5 * step_rad * (beams - 1)
    bearings = begin_rad + step_rad * np.arange(beams)
    rays = np.column_stack((np.cos(bearings), np.sin(bearings)))
    round_m = _to_ellipses(rays, np.array(room.ellipses).reshape(-1, 5))
    flat_m = _to_walls(rays, np.array(room.walls).reshape(-1, 4))
    nearest = round_m.argmin(axis=1) if round_m.shape[1] else np.zeros(beams, dtype=np.intp)
    round_m = round_m.min(axis=1, initial=np.inf)
    flat_m = flat_m.min(axis=1, initial=np.inf)
    whose = np.where(round_m < flat_m, np.array([*room.persons, NOBODY])[nearest], NOBODY)
    ranges_m = np.minimum(round_m, flat_m)
    ranges_m = ranges_m + random.normal(0.0, laser.noise_m, beams)
    ranges_m += np.where(whose != NOBODY, random.uniform(-SKIN_M, SKIN_M, beams), 0.0)
    # A beam that hits an edge comes back from in between, now and then.
    edges = np.flatnonzero(np.abs(np.diff(np.minimum(ranges_m, 1e3))) > 0.1)
    mixed = edges[random.random(len(edges)) < 0.15]
    share = random.random(len(mixed))
    ranges_m[mixed] = share * ranges_m[mixed] + (1.0 - share) * ranges_m[mixed + 1]
    gone = (ranges_m > laser.reach_m) | (random.random(beams) < laser.lost)
    ranges_m = np.round(np.where(gone | ~np.isfinite(ranges_m), 0.0, ranges_m), 3)
    scan = PlanarScan(t_s=t_s, ranges_m=ranges_m, angle_min_rad=begin_rad, angle_step_rad=step_rad)
    return scan, whose[scan.returned]


def _to_ellipses(rays: Array, ellipses: Array) -> Array:
    """The distance along each ray to each ellipse [m], inf past it: shape (rays, ellipses)."""
    centres, half_m, yaw = ellipses[:, :2], ellipses[:, 2:4], ellipses[:, 4]
    turned = np.stack(
        [np.stack([np.cos(yaw), np.sin(yaw)], -1), np.stack([-np.sin(yaw), np.cos(yaw)], -1)], -2
    )
    along = np.einsum("eij,rj->rei", turned, rays) / half_m
    start = -np.einsum("eij,ej->ei", turned, centres) / half_m
    a, b = (along**2).sum(-1), (along * start).sum(-1)
    c = (start**2).sum(-1) - 1.0
    inside = b**2 - a * c
    distance_m = (-b - np.sqrt(np.maximum(inside, 0.0))) / a
    return np.where((inside > 0.0) & (distance_m > 0.0), distance_m, np.inf)


def _to_walls(rays: Array, walls: Array) -> Array:
    """The distance along each ray to each stretch of wall [m], inf past it: (rays, walls)."""
    start, along = walls[:, :2], walls[:, 2:] - walls[:, :2]
    across = rays[:, None, 0] * along[None, :, 1] - rays[:, None, 1] * along[None, :, 0]
    across = np.where(np.abs(across) < 1e-12, np.nan, across)
    distance_m = (start[:, 0] * along[:, 1] - start[:, 1] * along[:, 0])[None, :] / across
    part = (start[None, :, 0] * rays[:, None, 1] - start[None, :, 1] * rays[:, None, 0]) / across
    hit = (distance_m > 0.0) & (part >= 0.0) & (part <= 1.0)
    return np.where(hit, distance_m, np.inf)
