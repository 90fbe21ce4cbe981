"""What is put on a low board, another close above it: the hand is out as the robot stands up."""

import math

import msgspec
import pytest

from robot.messages import Obstacle, Place, Shape, WorldMap
from robot.planning.requests import Held, PlacePlan, PlaceRequest, Surroundings
from robot.planning.solve import Solver
from robot.se3 import SE3
from tests.fakes.planning_room import START, room

DEPTH_M, WIDTH_M, PANEL_M = 0.30, 1.20, 0.02
TRAIN = Shape(kind="box", size_m=(0.055, 0.12, 0.07))


def low_shelf(low_m: float, high_m: float) -> tuple[WorldMap, Place]:
    """The room with a shelf of two boards before its south wall; and the lower one of them."""

    def part(y_m: float, z_m: float, size_m: tuple[float, float, float]) -> Shape:
        return Shape(kind="box", size_m=size_m, X_BodyShape=SE3((0.0, y_m, z_m)))

    boards = [part(0.0, z - PANEL_M / 2, (DEPTH_M, WIDTH_M, PANEL_M)) for z in (low_m, high_m)]
    side_m = (DEPTH_M, PANEL_M, high_m)
    sides = [part(s * (WIDTH_M + PANEL_M) / 2, high_m / 2, side_m) for s in (1, -1)]
    X_WO = SE3.from_xy_yaw(1.0, -2.7, math.pi / 2)
    shelf = Obstacle(id="low_shelf", name="low shelf", X_WO=X_WO, shapes=(*boards, *sides))
    place = Place(
        id="lower",
        name="lower board",
        X_WP=X_WO @ SE3((0.0, 0.0, low_m)),
        size_m=(DEPTH_M, WIDTH_M),
        clearance_m=high_m - PANEL_M - low_m,
        of="low_shelf",
    )
    whole = room(shelf)
    return msgspec.structs.replace(whole, places=(*whole.places, place)), place


def held(pitch_rad: float, yaw_rad: float) -> Held:
    """A toy train across the hand, which points down by so much."""
    at = (-0.026 * math.cos(yaw_rad), -0.026 * math.sin(yaw_rad), 0.018)
    return Held(id="train", shape=TRAIN, X_GO=SE3.from_rpy(0.0, pitch_rad, yaw_rad, at).inverse())


@pytest.mark.parametrize("yaw_rad", [math.pi / 2, -math.pi / 2])
@pytest.mark.parametrize("pitch_rad", [-0.02, 0.02, 0.1, 0.2])
def test_a_train_goes_on_a_low_board_however_the_hand_is_tilted(
    solver: Solver, pitch_rad: float, yaw_rad: float
) -> None:
    world, board = low_shelf(0.45, 0.75)
    around = Surroundings(map=world)
    for side in ("left", "right"):
        request = PlaceRequest(
            place=board,
            side=side,
            held=held(pitch_rad, yaw_rad),
            around=around,
            start=START,
        )
        plan = solver.solve(request)
        assert isinstance(plan, PlacePlan), plan
