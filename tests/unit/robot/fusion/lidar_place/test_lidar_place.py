"""A robot finds itself in its own map, says how sure it is, and says when it does not know."""

import numpy as np
import pytest

from robot.fusion.lidar_place.finder import through
from robot.fusion.lidar_place.levelled import levelled
from robot.fusion.lidar_place.lidar_place import MISFIT, SEARCHING, UNSURE
from robot.fusion.lidar_place.mapping import told_outlines
from robot.fusion.slam.map_file import load, save
from robot.messages import Obstacle, Shape
from robot.se3 import SE3
from tests.fakes import buildings, surveyed
from tests.fakes.surveyed import Walker

STILL = np.zeros(3)


@pytest.fixture(scope="module")
def room():
    walls = buildings.room()
    return walls, surveyed.mapped(walls, surveyed.ROUND)


def nearest_wall_m(walls, points):
    """How far points are from the nearest wall."""
    begin, along = walls[:, :2], walls[:, 2:] - walls[:, :2]
    off = points[:, None] - begin
    share = np.clip((off * along).sum(-1) / (along**2).sum(-1), 0.0, 1.0)
    return np.linalg.norm(off - share[..., None] * along, axis=2).min(axis=1)


def test_a_walk_makes_a_map_whose_walls_are_where_they_are(room):
    walls, saved = room
    off_m = nearest_wall_m(walls, saved.surface[:, :2])
    assert np.percentile(off_m, 90) < 0.03
    assert saved.height_m == pytest.approx(surveyed.HEIGHT_M)


def test_a_map_comes_back_from_its_file_with_the_height_of_its_lidar(room, tmp_path):
    _, saved = room
    save(tmp_path / "room.map.npz", saved)
    again = load(tmp_path / "room.map.npz")
    assert again.height_m == saved.height_m
    assert np.allclose(again.surface, saved.surface, atol=1e-6)


def test_a_lidar_that_leans_shows_the_same_walls():
    walls, pose = buildings.room(), np.array([1.5, 1.5, 0.4])
    scan = surveyed.taken(walls, pose, rng=np.random.default_rng(0))
    level = levelled(scan, surveyed.at(pose))
    yaw, lean = SE3.from_xy_yaw(1.5, 1.5, 0.4, z_m=0.64), np.radians(2.0)
    leaning = yaw @ SE3.from_rpy(0.0, lean, 0.0, (0.0, 0.0, 0.0))
    # What a beam that leans measures to an upright wall is longer by the cosine of its slope.
    angles = scan.angle_min_rad + scan.angle_step_rad * np.arange(len(scan.ranges_m))
    rows = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1) @ leaning.rotation().T
    headings = np.arctan2(rows[:, 1], rows[:, 0])
    flat = np.array([buildings.ranges_m(walls, np.array([1.5, 1.5, h]),
                     buildings.Lidar(beams=1, first_rad=0.0))[0] for h in headings])  # fmt: skip
    longer = flat / np.hypot(rows[:, 0], rows[:, 1])
    tilted = levelled(
        surveyed.LidarScan(stamp_s=0.0, angle_min_rad=scan.angle_min_rad,
                           angle_step_rad=scan.angle_step_rad, ranges_m=tuple(longer.tolist())),
        leaning,
    )  # fmt: skip
    assert tilted.tilt_rad == pytest.approx(lean)
    points = tilted.scan.points
    world = points @ np.array([[np.cos(0.4), np.sin(0.4)], [-np.sin(0.4), np.cos(0.4)]]) + pose[:2]
    assert nearest_wall_m(walls, world).max() < 1e-6
    assert len(points) > 0.5 * len(level.scan.points)


def test_it_finds_itself_standing_and_keeps_up_though_odometry_drifts(room):
    walls, saved = room
    walker = Walker(saved, walls, surveyed.ROUND[0])
    first = walker.stand(1)[0]
    assert first.X_WN is None and first.lost == SEARCHING
    assert walker.stand(15)[-1].X_WN is not None
    off_m = walker.follow(surveyed.ROUND)
    assert len(off_m) == len(surveyed.ROUND)
    assert np.percentile(off_m, 95) < 0.03 and max(off_m) < 0.05


def test_it_does_not_move_while_it_stands(room):
    walls, saved = room
    walker = Walker(saved, walls, surveyed.ROUND[40])
    walker.stand(60)
    poses = np.array([where.X_WN for where in walker.stand(200)])
    assert np.ptp(poses[:, 0]) < 0.005 * 2 and np.ptp(poses[:, 1]) < 0.005 * 2
    assert poses[:, :2].std(axis=0).max() < 0.002


def test_it_is_about_as_unsure_as_it_is_wrong(room):
    walls, saved = room
    walker = Walker(saved, walls, surveyed.ROUND[0])
    walker.stand(20)
    off_m, sigma_m = [], []
    for pose in surveyed.ROUND[1:]:
        where = walker.go(buildings.between(walker.true, pose))
        off_m.append(walker.off_m(where))
        sigma_m.append(np.sqrt(np.trace(where.covariance[:2, :2])))
    assert np.sqrt(np.mean(np.square(off_m))) < 2.0 * np.mean(sigma_m)
    assert np.mean(sigma_m) < 0.03


def test_people_who_walk_about_do_not_lead_it_astray(room):
    walls, saved = room
    walker = Walker(saved, walls, surveyed.ROUND[0])
    walker.stand(15)
    worst_m = 0.0
    for k, pose in enumerate(surveyed.ROUND):
        along = 0.03 * k
        walker.people = [
            surveyed.person(*(pose[:2] + 0.8 * np.array([np.cos(a), np.sin(a)])))
            for a in (along, along + 2.0, along + 4.0)
        ]
        where = walker.go(buildings.between(walker.true, pose))
        worst_m = max(worst_m, walker.off_m(where))
    assert worst_m < 0.06


def test_set_down_elsewhere_it_says_that_it_is_lost_and_finds_itself_again(room):
    walls, saved = room
    walker = Walker(saved, walls, surveyed.ROUND[0])
    walker.stand(20)
    walker.carry(np.array([6.0, 2.0, 2.5]))
    said = walker.stand(60)
    lost = [where.lost for where in said]
    assert MISFIT in lost[:15]
    assert not lost[-1] and walker.off_m(said[-1]) < 0.05
    assert walker.place.losses == 1
    wrong = [walker.off_m(where) > 0.3 for where in said[12:] if where.X_WN is not None]
    assert not any(wrong), "it was sure and wrong"


def test_a_covered_lidar_is_noticed_after_a_while(room):
    walls, saved = room
    walker = Walker(saved, walls, surveyed.ROUND[0])
    walker.stand(20)
    walker.blind = True
    said = walker.stand(300)
    assert said[0].lost == "" and said[-1].lost == UNSURE
    walker.blind = False
    assert walker.stand(40)[-1].lost == ""


def test_along_a_bare_corridor_it_gets_unsure_and_says_so():
    walls = np.array([(0.0, 0.0, 90.0, 0.0), (0.0, 1.6, 90.0, 1.6), (0.0, 0.0, 0.0, 1.6)])
    way = surveyed.loop([(1.0, 0.8), (40.0, 0.8)], step_m=0.5)
    saved = surveyed.mapped(walls, way, scale=0.1)
    walker = Walker(saved, walls, np.array([2.0, 0.8, 0.0]))
    filter = walker.place._filter
    filter.begin(np.array([2.0, 0.8, 0.0]), walker.odometry, np.array([0.02, 0.02, 0.02]))
    walker.place._lost = ""
    walker.walls = walls[:2]  # its end is out of sight
    along, across = [], []
    for _ in range(300):
        where = walker.go(np.array([0.1, 0.0, 0.0]))
        if where.X_WN is None:
            break
        along.append(np.sqrt(where.covariance[0, 0]))
        across.append(np.sqrt(where.covariance[1, 1]))
    assert where.lost == UNSURE
    assert along[-1] > 4.0 * across[-1] and across[-1] < 0.05


def test_in_a_room_that_is_like_itself_it_stays_lost():
    walls = np.array(buildings.box(0.0, 0.0, 4.0, 4.0))
    saved = surveyed.mapped(walls, surveyed.loop([(1, 1), (3, 1), (3, 3), (1, 3), (1, 1)]))
    walker = Walker(saved, walls, np.array([1.5, 1.5, 0.0]))
    assert all(where.X_WN is None for where in walker.stand(40))


def test_the_same_scans_give_the_same_poses(room):
    walls, saved = room
    first, second = (Walker(saved, walls, surveyed.ROUND[0]).stand(30) for _ in range(2))
    assert np.array_equal(first[-1].X_WN, second[-1].X_WN)


def test_beams_through_walls_are_counted(room):
    walls, saved = room
    pose = surveyed.ROUND[30]
    scan = surveyed.sweeps(walls, pose[None], np.zeros((1, 3)), seed=4)[0].scan
    assert through(saved.grid, scan, pose) < 0.1
    assert through(saved.grid, scan, pose + np.array([1.5, 1.0, 1.0])) > 0.2


def test_outlines_are_the_sides_that_the_lidar_could_see():
    table = Obstacle(
        id="table", name="table", X_WO=SE3.from_xy_yaw(2.0, 1.0, np.pi / 2),
        shapes=(
            Shape(kind="box", size_m=(0.6, 1.2, 0.04), X_BodyShape=SE3((0.0, 0.0, 0.7))),
            Shape(kind="box", size_m=(0.4, 0.2, 0.68), X_BodyShape=SE3((0.0, 0.0, 0.34))),
        ),
    )  # fmt: skip
    outlines = told_outlines([table], 0.64)
    assert outlines is not None
    assert outlines.points.min(axis=0) == pytest.approx([1.9, 0.8], abs=1e-9)
    assert outlines.points.max(axis=0) == pytest.approx([2.1, 1.2], abs=1e-9)
    assert told_outlines([table], 2.0) is None
