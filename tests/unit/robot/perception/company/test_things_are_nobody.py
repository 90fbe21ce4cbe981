"""Things on surfaces are nobody, however near and by whatever sense: nobody is inside furniture."""

import math

import numpy as np
import pytest

from robot.messages import LidarScan, Obstacle, Place, Shape
from robot.perception.company.mapped import SEAT_M, MappedSolids
from robot.perception.company.returns import sweep
from robot.se3 import SE3

BOARD = Place(id="lower", name="lower board", X_WP=SE3((0.8, 0.0, 0.62)), size_m=(0.30, 0.90))
WOOD = Obstacle(
    id="bookcase",
    name="bookcase",
    X_WO=SE3((0.8, 0.0, 0.61)),
    shapes=(Shape(kind="box", size_m=(0.30, 0.90, 0.02)),),
)
RANGES_M = tuple(0.76 if 88 <= k <= 92 else math.inf for k in range(180))
SCAN = LidarScan(
    stamp_s=1.0, angle_min_rad=-math.pi, angle_step_rad=math.radians(2.0), ranges_m=RANGES_M
)


@pytest.mark.parametrize(("z_m", "seen"), [(0.76, 0), (0.95, 0), (0.45, 1)])
def test_returns_from_a_box_on_a_board_are_nobody(z_m: float, seen: int):
    """A tea box in a bookcase was "tom", who stood in it, and the hand waited for him."""
    X_WL = SE3((0.0, 0.0, z_m))
    assert len(sweep(SCAN, X_WL, MappedSolids((WOOD,), (BOARD,))).clusters) == seen
    assert len(sweep(SCAN, X_WL, MappedSolids((WOOD,))).clusters) == 1


def strange(z_m: float, point: tuple[float, float, float], *, floor: bool = False) -> bool:
    top = Place(
        id="top",
        name="top",
        X_WP=SE3.from_xy_yaw(1.0, 0.0, 0.5) @ SE3((0.0, 0.0, z_m)),
        size_m=(0.6, 1.2),
        floor=floor,
    )
    return bool(MappedSolids((), (top,)).strange(np.array([point]), np.array([1.0]))[0])


def test_people_sit_on_seats_and_stand_beside_tables():
    assert not strange(0.74, (1.0, 0.0, 0.85))
    assert strange(SEAT_M - 0.05, (1.0, 0.0, 0.85))
    assert strange(0.0, (1.0, 0.0, 0.85), floor=True)
    assert strange(0.74, (1.5, 0.0, 0.85))
    assert strange(0.74, (1.0, 0.0, 0.3)), "under a table somebody may lie"
