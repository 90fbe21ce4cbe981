"""The map explains what it can; what it cannot is reported where it is."""

import math

import numpy as np
import pytest

from robot.fusion.unmapped import FORGET_S, SCANS_TO_BELIEVE, UnmappedObstacles
from robot.messages import DepthImage, LidarScan, Obstacle, Shape
from robot.se3 import SE3

BEAMS = 180
STEP_RAD = 2 * math.pi / BEAMS
TABLE = Obstacle(
    id="table", name="table", X_WO=SE3.from_xy_yaw(2.0, 0.0, 0.4),
    shapes=(Shape(kind="box", size_m=(0.6, 1.2, 0.7), X_BodyShape=SE3((0.0, 0.0, 0.35))),),
)  # fmt: skip


def scan(stamp_s: float, X_WL: SE3, discs: list[tuple[float, float, float]]) -> LidarScan:
    """What a lidar at X_WL (upright) measures of upright cylinders (x, y, radius) in W."""
    ranges = []
    for k in range(BEAMS):
        angle = -math.pi + k * STEP_RAD + X_WL.yaw_rad
        ux, uy = math.cos(angle), math.sin(angle)
        best = math.inf
        for x, y, radius in discs:
            dx, dy = x - X_WL.p[0], y - X_WL.p[1]
            along, across = dx * ux + dy * uy, dx * uy - dy * ux
            if along > 0 and abs(across) < radius:
                best = min(best, along - math.sqrt(radius**2 - across**2))
        ranges.append(best)
    return LidarScan(
        stamp_s=stamp_s, angle_min_rad=-math.pi, angle_step_rad=STEP_RAD, ranges_m=tuple(ranges)
    )


@pytest.fixture
def unmapped() -> UnmappedObstacles:
    unmapped = UnmappedObstacles(body_radius_m=0.27)
    unmapped.know((TABLE,))
    return unmapped


def look(unmapped, discs, *, scans=SCANS_TO_BELIEVE, X_WL=None, begin_s=0.0):
    X_WL = X_WL or SE3.from_xy_yaw(0.0, 0.0, 0.3, z_m=0.6)
    for k in range(scans):
        unmapped.see(scan(begin_s + 0.1 * k, X_WL, discs), X_WL)
    return unmapped.obstacles()


def test_a_person_beside_the_map_is_found_where_they_stand(unmapped):
    (found,) = look(unmapped, [(1.0, 1.5, 0.25)])
    assert math.dist(found.X_WO.p[:2], (1.0, 1.5)) < 0.3
    (shape,) = found.shapes
    assert min(shape.size_m[:2]) > 0.1
    assert max(shape.size_m[:2]) < 0.7


def test_what_is_kept_for_a_while_is_told_from_what_is_seen_now(unmapped):
    """Where somebody had stood kept them there, as the world believed, for two seconds more."""
    (found,) = look(unmapped, [(1.0, 1.5, 0.25)])
    assert unmapped.obstacles(since_s=0.1) == (found,)
    look(unmapped, [(-1.0, 1.5, 0.25)], begin_s=0.5)
    assert found in unmapped.obstacles()
    (other,) = unmapped.obstacles(since_s=0.5)
    assert other.X_WO.p[0] < 0.0


def test_what_the_map_has_is_no_news(unmapped):
    discs = [(2.0, 0.0, 0.05), (2.0 + 0.25 * math.cos(0.4), 0.25 * math.sin(0.4), 0.1)]
    assert look(unmapped, discs, scans=10) == ()


def test_one_scan_is_not_believed(unmapped):
    assert look(unmapped, [(1.0, 1.5, 0.25)], scans=1) == ()


def test_it_is_forgotten_when_it_is_gone(unmapped):
    assert look(unmapped, [(1.0, 1.5, 0.25)])
    assert look(unmapped, [], begin_s=0.3, scans=2)
    assert look(unmapped, [], begin_s=0.5 + FORGET_S, scans=1) == ()


def test_it_is_forgotten_when_it_was_seen_from_a_wrong_pose(unmapped):
    assert look(unmapped, [(1.0, 1.5, 0.25)])
    unmapped.forget()
    assert unmapped.obstacles() == ()
    assert look(unmapped, [(1.0, 1.5, 0.25)], begin_s=1.0)


def test_someone_who_walks_stays_one_obstacle(unmapped):
    X_WL = SE3.from_xy_yaw(0.0, 0.0, 0.0, z_m=0.6)
    for k in range(20):
        unmapped.see(scan(0.1 * k, X_WL, [(-1.0, 1.5 - 0.1 * k, 0.25)]), X_WL)
    found = [one for one in unmapped.obstacles() if one.X_WO.p[0] < 0]
    assert [one for one in found if abs(one.X_WO.p[1] - (1.5 - 1.9)) < 0.3]
    assert len({one.id for one in found}) <= 2


def test_a_tilted_lidar_that_hits_the_floor_reports_nothing(unmapped):
    X_WL = SE3.from_rpy(0.0, 0.3, 0.0, (0.0, 0.0, 0.6))
    ranges = []
    for k in range(BEAMS):
        down = -(X_WL.rotation() @ [math.cos(-math.pi + k * STEP_RAD),
                                    math.sin(-math.pi + k * STEP_RAD), 0.0])[2]  # fmt: skip
        ranges.append(0.6 / down if down > 0.05 else math.inf)
    for k in range(5):
        unmapped.see(
            LidarScan(
                stamp_s=k, angle_min_rad=-math.pi, angle_step_rad=STEP_RAD, ranges_m=tuple(ranges)
            ),
            X_WL,
        )
    assert unmapped.obstacles() == ()


def test_the_robots_own_hands_are_not_obstacles(unmapped):
    assert look(unmapped, [(0.28, 0.1, 0.04)], scans=5) == ()


def test_an_arm_that_is_stretched_out_and_what_it_holds_is_no_obstacle(unmapped):
    out = [(0.55, 0.15, 0.06)]
    assert look(unmapped, out)
    unmapped.forget()
    unmapped.feel(SE3(), [(0.5, 0.15, 0.9), (0.2, -0.2, 0.8)])
    assert look(unmapped, out, begin_s=1.0, scans=5) == ()
    assert look(unmapped, [*out, (0.6, -0.6, 0.25)], begin_s=2.0)  # somebody beside the arm is one


def test_an_empty_scan_and_an_empty_map_are_fine():
    unmapped = UnmappedObstacles(body_radius_m=0.27)
    assert look(unmapped, []) == ()
    assert len(look(unmapped, [(1.0, 1.0, 0.3)])) == 1
    assert np.isfinite(unmapped.obstacles()[0].X_WO.p).all()


def image(stamp_s: float, seat: tuple[float, float, float] | None) -> tuple[DepthImage, SE3]:
    """What a level camera, 1.2 m up at the origin, sees of a level disc (x, y, z) and the floor."""
    width, height, fovy_rad = 80, 60, math.radians(60)
    X_WC = SE3.from_rotation([[0, -0.5, 0.866], [-1, 0, 0], [0, -0.866, -0.5]], (0.0, 0.0, 1.2))
    focal = 0.5 * height / math.tan(0.5 * fovy_rad)
    columns, rows = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    rays_C = np.stack(
        [(columns - width / 2) / focal, (rows - height / 2) / focal, np.ones_like(columns)], axis=-1
    )
    rays = rays_C @ X_WC.rotation().T
    depth = np.where(rays[..., 2] < -1e-3, -1.2 / np.minimum(rays[..., 2], -1e-3), 0.0)
    if seat is not None:
        reach = (seat[2] - 1.2) / np.minimum(rays[..., 2], -1e-3)
        x, y = reach * rays[..., 0] - seat[0], reach * rays[..., 1] - seat[1]
        depth = np.where(np.hypot(x, y) < 0.21, reach, depth)
    data = depth.astype(np.float32).tobytes()
    message = DepthImage(stamp_s=stamp_s, width=width, height=height, fovy_rad=fovy_rad,
                         depth_m=data)  # fmt: skip
    return message, X_WC


def watch(unmapped, seat, *, X_WB=SE3((-0.1, 0.0, 0.6))):  # noqa: B008
    for k in range(SCANS_TO_BELIEVE):
        message, X_WC = image(0.1 * k, seat)
        unmapped.see_depth(message, X_WC, X_WB)
    return unmapped.obstacles()


def test_the_camera_sees_a_seat_that_the_lidar_passes_over(unmapped):
    (found,) = watch(unmapped, (1.2, 0.3, 0.45))
    assert math.dist(found.X_WO.p[:2], (1.2, 0.3)) < 0.25
    assert max(found.shapes[0].size_m[:2]) > 0.25


def test_the_floor_alone_is_nothing(unmapped):
    assert watch(unmapped, None) == ()


def test_a_table_of_the_map_is_no_news_to_the_camera(unmapped):
    assert watch(unmapped, (1.9, 0.0, 0.7)) == ()


def test_what_is_close_may_be_the_robots_own_hand(unmapped):
    assert watch(unmapped, (0.3, 0.1, 0.8)) == ()
