"""Depth, lidar and oracle: what is there is seen, what is hidden is not."""

import math

import mujoco
import numpy as np
import pytest

from robot.messages import DepthImage, LidarScan, PoseFix, Sightings
from robot.reality import faults
from robot.se3 import SE3
from sim import world
from sim.faults import apply
from sim.plant import Plant
from sim.ray_sensors import Exposure, developed
from sim.rays import Rays


@pytest.fixture
def standing(robot, kitchen):
    """A plant in the kitchen with the robot in front of the table, facing it."""
    plant = Plant(kitchen, robot, seed=2)
    plant.stand(SE3.from_xy_yaw(0.35, 0.3, 0.0))
    return plant


def seen(plant: Plant) -> Sightings:
    return plant.oracle.sightings(plant.time_s)


def ids(plant: Plant) -> set[str]:
    return {item.id for item in seen(plant).objects}


def test_what_stands_in_front_is_seen(standing):
    assert ids(standing) == {"red_cup", "blue_cup"}


def test_what_is_behind_is_not_seen(standing):
    standing.stand(SE3.from_xy_yaw(0.35, 0.3, math.pi))
    assert ids(standing) == set()
    assert seen(standing).people == ()


def test_what_is_hidden_is_not_seen(standing):
    cup = SE3((1.15, 0.15, 0.76))
    between = SE3.from_xy_yaw(0.87, 0.21, math.pi)
    apply(standing, faults.Move(target="anna", X_WO=between))
    mujoco.mj_kinematics(standing.model, standing.data)
    assert standing.oracle.X_WO("red_cup").p == pytest.approx(cup.p)
    assert "red_cup" not in ids(standing)
    assert [person.id for person in seen(standing).people] == ["anna"]


def test_what_is_far_away_is_not_seen(standing):
    standing.put("object/red_cup", SE3((6.0, 0.3, 0.05)))
    assert ids(standing) == {"blue_cup"}


def test_what_is_taken_away_is_not_seen(standing):
    apply(standing, faults.Remove(target="blue_cup"))
    assert ids(standing) == {"red_cup"}


def test_a_sighting_is_off_by_the_pose_error(standing, robot):
    camera = standing.data.site(robot.sensors.camera.site)
    X_WC = SE3.from_rotation(camera.xmat.reshape(3, 3), camera.xpos)
    for item in seen(standing).objects:
        X_WO = X_WC @ item.X_CO
        off = math.dist(X_WO.p, standing.oracle.X_WO(item.id).p)
        assert off == pytest.approx(0.005, abs=0.003)


def test_the_error_stays_in_view_and_changes_after_a_while_unseen(standing):
    def where(stamp_s: float) -> np.ndarray:
        found = {item.id: item.X_CO.p for item in standing.oracle.sightings(stamp_s).objects}
        return np.array(found["red_cup"])

    first = where(0.0)
    assert np.linalg.norm(where(0.1) - first) < 0.004  # jitter only
    assert np.linalg.norm(where(5.0) - first) > 0.004


def test_depth_sees_the_table_at_its_distance(standing, robot):
    image = standing.sending.camera.capture(0.0)
    depth = image.pixels()
    focal = image.height / 2 / math.tan(image.fovy_rad / 2)
    row, column = np.indices(depth.shape)
    x = (column + 0.5 - image.width / 2) / focal * depth
    y = (row + 0.5 - image.height / 2) / focal * depth
    points_C = np.stack([x, y, depth], axis=-1)[depth > 0]
    camera = standing.data.site(robot.sensors.camera.site)
    points_W = points_C @ camera.xmat.reshape(3, 3).T + camera.xpos
    over = np.abs(points_W[:, 0] - 1.3) < 0.55
    over &= (np.abs(points_W[:, 1] - 0.3) < 0.25) & (points_W[:, 2] > 0.5)
    heights = points_W[over, 2]
    assert over.sum() > 100
    assert np.median(heights) == pytest.approx(0.71, abs=0.005)
    floor = points_W[(points_W[:, 2] < 0.1) & (points_W[:, 1] < -0.2), 2]
    assert len(floor) > 25
    assert np.median(floor) == pytest.approx(0.0, abs=0.01)


def test_an_image_shows_what_was_there_when_it_was_taken(standing):
    camera = standing.sending.camera
    rays = Rays(standing.model, standing.data, body=camera.body)
    head = standing.data.site("head_camera")
    frames = []
    for yaw_rad in (-2.0, -1.0, 0.0):
        standing.stand(SE3.from_xy_yaw(1.5, -1.5, yaw_rad))
        x, y = 1.5 + 1.2 * math.cos(yaw_rad), -1.5 + 1.2 * math.sin(yaw_rad)
        standing.put("person/anna", SE3.from_xy_yaw(x, y, 0.0))
        mujoco.mj_kinematics(standing.model, standing.data)
        ahead = head.xmat.reshape(3, 3)[:, 2:].T
        frames.append((camera.capture(0.0), rays.cast(head.xpos, ahead, range_m=9.0)[0][0]))
    for image, ahead_m in frames:
        middle = image.pixels()[image.height // 2 - 1 :, image.width // 2][:2]
        assert middle.mean() == pytest.approx(ahead_m, abs=0.1)
        assert developed(image).pixels().tolist() == image.pixels().tolist()


def test_lidar_measures_the_north_wall(robot):
    plant = Plant(world.load("kitchen"), robot, seed=0)
    plant.stand(SE3.from_xy_yaw(2.0, -1.0, math.pi / 2))
    scan = plant.sending.lidar.scan(0.0)
    ahead = round(-scan.angle_min_rad / scan.angle_step_rad)
    assert scan.ranges_m[ahead] == pytest.approx(2.5 + 1.0 - 0.04, abs=0.08)
    behind = scan.ranges_m[0]
    assert math.isinf(behind)  # open to the south


def test_lidar_does_not_report_the_robot_itself(robot):
    plant = Plant(world.empty(), robot, seed=0, posture="carry")
    assert all(math.isinf(value) for value in plant.sending.lidar.scan(0.0).ranges_m)


def test_a_fix_is_near_the_truth(standing):
    truth = standing.oracle.X_WB()
    fixes = [standing.oracle.fix(0.0) for _ in range(200)]
    off = np.array([np.subtract(fix.X_WB.p, truth.p) for fix in fixes])
    assert off.std() == pytest.approx(0.003, rel=0.15)
    assert {fix.source for fix in fixes} == {"oracle"}


def test_everything_comes_at_its_rate(standing):
    kinds: dict[type, int] = {}
    for _ in range(100):
        for _, message in standing.sense():
            assert message.stamp_s == standing.time_s
            kinds[type(message)] = kinds.get(type(message), 0) + 1
        standing.step(10)
    counts = {kind.__name__: count for kind, count in kinds.items()}
    assert counts == {
        Exposure.__name__: 10, LidarScan.__name__: 10, PoseFix.__name__: 10,
        Sightings.__name__: 10, "WorldMap": 1, "PowerState": 1,
    }  # fmt: skip


def test_a_silent_sensor_says_nothing_for_its_time(standing):
    apply(standing, faults.Silence(topic="sensors/depth", duration_s=0.35))
    heard = []
    for _ in range(50):
        heard += [
            message.stamp_s for _, message in standing.sense() if isinstance(message, DepthImage)
        ]
        standing.step(10)
    assert heard == pytest.approx([0.4])


def test_what_the_camera_cannot_see_need_not_be_tried_against(standing):
    """Rays meet the same at the same distance, whichever way the head looks."""
    model = standing.model
    rays = Rays(model, standing.data, body=standing.sending.camera.body)
    groups = model.geom_group.copy()
    rng = np.random.default_rng(3)
    eye = standing.data.site("head_camera").xpos
    for _ in range(20):
        axis = rng.standard_normal(3)
        axis /= np.linalg.norm(axis)
        near = axis + 0.4 * rng.uniform(-1.0, 1.0, (200, 3))
        directions = near / np.linalg.norm(near, axis=1, keepdims=True)
        half_angle_rad = math.acos(float((directions @ axis).min()))
        expected = rays.cast(eye, directions, range_m=5.0)
        with rays.only_within(eye, axis, half_angle_rad=half_angle_rad, range_m=5.0):
            assert (model.geom_group != groups).any()
            got = rays.cast(eye, directions, range_m=5.0)
        for mine, theirs in zip(got, expected, strict=True):
            np.testing.assert_array_equal(mine, theirs)
        np.testing.assert_array_equal(model.geom_group, groups)
