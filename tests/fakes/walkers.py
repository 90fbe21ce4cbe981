"""A room with people who walk, in front of a laser: scans in which it is known where they are."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from benchmarks.people.scenes import Laser, Room, seen
from robot.perception.people.scan import PlanarScan

LASER = Laser(step_rad=np.radians(0.352), beams=768, noise_m=0.008, reach_m=12.0, lost=0.005)
PERIOD_S = 0.1
STRIDE_M, PACE_HZ = 0.3, 0.9
Places = Sequence[tuple[float, float]]


def furnished() -> Room:
    """Walls, a chair of four legs, a table, a pole as thick as a leg, a bin."""
    room = Room()
    room.add_box(1.5, 0.2, 8.0, 6.0, 0.05)
    for x_m, y_m in ((1.6, 1.4), (2.0, 1.4), (1.6, 1.8), (2.0, 1.8)):
        room.add_round(x_m, y_m, 0.015)
    for x_m, y_m in ((2.4, -1.9), (3.4, -1.9), (2.4, -2.5), (3.4, -2.5)):
        room.add_box(x_m, y_m, 0.05, 0.05, 0.0)
    room.add_round(1.2, -1.2, 0.06)
    room.add_round(4.2, 1.6, 0.15)
    return room


def walker(way: Places, speed_m_s: float, now_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Where somebody is who walks along corners and back again, and the feet, shape (2, 2)."""
    corners = np.array([*way, *list(way)[-2:0:-1], way[0]], dtype=float)
    lengths_m = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    gone_m = (speed_m_s * now_s) % lengths_m.sum()
    leg = int(np.searchsorted(np.cumsum(lengths_m), gone_m))
    along = (corners[leg + 1] - corners[leg]) / lengths_m[leg]
    place = corners[leg] + (gone_m - lengths_m[:leg].sum()) * along
    left = np.array([-along[1], along[0]])
    swing_m = STRIDE_M * np.sin(2.0 * np.pi * PACE_HZ * now_s) if speed_m_s else 0.0
    feet = np.array([place + 0.1 * left + swing_m * along, place - 0.1 * left - swing_m * along])
    return place, feet


def recorded(
    ways: Sequence[Places], *, seconds: float, speed_m_s: float = 0.9, seed: int = 0
) -> tuple[list[PlanarScan], np.ndarray]:
    """Scans of the furnished room, and where everybody is, shape (scans, people, 2)."""
    random = np.random.default_rng(seed)
    scans: list[PlanarScan] = []
    places: list[list[np.ndarray]] = []
    for number in range(round(seconds / PERIOD_S)):
        now_s, room = number * PERIOD_S, furnished()
        there = [walker(way, speed_m_s, now_s) for way in ways]
        for person, (_, feet) in enumerate(there):
            for foot in feet.tolist():
                room.add_round(foot[0], foot[1], 0.065, person)
        scans.append(seen(room, LASER, random, t_s=now_s)[0])
        places.append([place for place, _ in there])
    return scans, np.array(places)
