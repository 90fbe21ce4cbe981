"""The node as a whole: what the camera saw is placed in the world by fix, odometry and head."""

import math

import mujoco
import numpy as np
import pytest

from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers.simulation.plant_sensors import emulated
from robot.drivers.wiring import Wiring
from robot.messages import (
    DepthImage,
    LidarScan,
    ObjectInfo,
    PoseFix,
    Shape,
    Sighting,
    Sightings,
    WorldMap,
)
from robot.model import description
from robot.model.body import BodyModel
from robot.perception.node import PATIENCE_S, PerceptionNode
from robot.se3 import SE3
from tests.fakes.messages_for_tests import body_state

X_WN = SE3.from_xy_yaw(1.0, -2.0, 0.7)
X_NB = SE3.from_rpy(0.02, -0.03, 0.4, (0.3, 0.1, 0.6))
X_CO = SE3((0.05, -0.1, 1.5))


@pytest.fixture(scope="module")
def robot():
    return description.load("juno")


@pytest.fixture
def node(robot):
    bus = LocalBus()
    wiring = Wiring(robot=robot, clock=SimulatedClock(), bus=bus)
    with PerceptionNode(wiring) as node:
        yield bus, node, bus.subscribe(topics.WORLD_STATE)


def joints(robot) -> np.ndarray:
    q = np.array(robot.posture("nominal"))
    q[robot.indices("head")] = (0.5, 0.3)
    q[robot.indices("waist")] = (0.2, 0.0, 0.1)
    return q


def camera_pose(robot) -> SE3:
    """X_WC by its own forward kinematics."""
    body = BodyModel(robot)
    data = body.data()
    body.write_base(data, X_NB)
    body.write_joints(data, joints(robot))
    mujoco.mj_kinematics(body.model, data)
    return X_WN @ body.site_pose(data, body.site_id(robot.sensors.camera.site))


def world_map() -> WorldMap:
    shape = Shape(kind="cylinder", size_m=(0.07, 0.07, 0.1))
    cup = ObjectInfo(id="cup", name="cup", category="cup", color="red", shape=shape, mass_kg=0.2)
    return WorldMap(
        stamp_s=0.0, name="test", obstacles=(), places=(), objects=(cup,), people=(),
        categories={}, bounds_m=(-5, -5, 5, 5),
    )  # fmt: skip


def publish(bus, robot, stamp_s: float, *, sight: bool = True) -> None:
    q = tuple(joints(robot).tolist())
    bus.publish(topics.BODY_STATE, body_state(stamp_s, X_NB, q_rad=q))
    fix = PoseFix(stamp_s=stamp_s, X_WB=X_WN @ X_NB, source="oracle")
    bus.publish(topics.ORACLE_FIX, fix)
    objects = (Sighting(id="cup", X_CO=X_CO),) if sight else ()
    bus.publish(topics.ORACLE_SIGHTINGS, Sightings(stamp_s=stamp_s, objects=objects))


def test_a_sighting_is_placed_through_waist_and_head(node, robot):
    bus, perception, worlds = node
    bus.publish(topics.ORACLE_MAP, world_map())
    publish(bus, robot, 0.1)
    perception.step()
    state = worlds.latest
    assert state is not None
    (track,) = state.tracks
    assert math.dist(track.X_WO.p, (camera_pose(robot) @ X_CO).p) < 1e-6
    assert math.dist(state.X_WB.p, (X_WN @ X_NB).p) < 1e-6
    assert (state.fix_age_s, state.source, state.jumps) == (0.0, "oracle", 0)


def test_nothing_is_said_before_the_robot_knows_where_it_is(node, robot):
    bus, perception, worlds = node
    bus.publish(topics.BODY_STATE, body_state(0.1, X_NB, q_rad=tuple(joints(robot).tolist())))
    bus.publish(topics.ORACLE_SIGHTINGS, Sightings(stamp_s=0.1, objects=()))
    perception.step()
    assert worlds.latest is None


def test_a_sensor_that_is_ahead_of_the_body_waits_for_it(node, robot):
    bus, perception, worlds = node
    bus.publish(topics.ORACLE_MAP, world_map())
    q = tuple(joints(robot).tolist())
    bus.publish(topics.BODY_STATE, body_state(0.08, SE3(), q_rad=q))
    bus.publish(topics.ORACLE_FIX, PoseFix(stamp_s=0.1, X_WB=X_WN @ X_NB, source="oracle"))
    perception.step()
    assert worlds.latest is None
    bus.publish(topics.BODY_STATE, body_state(0.1, X_NB, q_rad=q))
    perception.step()
    assert worlds.latest.X_WN.yaw_rad == pytest.approx(X_WN.yaw_rad)


def test_a_pose_that_is_thrown_over_takes_what_stood_in_the_way_with_it(node, robot):
    """It was placed by that pose; a robot that believed in it stood in the middle of it."""
    bus, perception, worlds = node
    bus.publish(topics.ORACLE_MAP, world_map())
    q = tuple(joints(robot).tolist())
    wrong = SE3.from_xy_yaw(0.6, 0.4, 0.0) @ X_WN @ X_NB
    for k in range(1, 40):
        ahead = tuple(1.2 if abs(n - 90) < 6 else 9.0 for n in range(180))
        turn = 2.0 * math.pi / 180
        scan = LidarScan(
            stamp_s=0.1 * k, angle_min_rad=-math.pi, angle_step_rad=turn, ranges_m=ahead
        )
        bus.publish(emulated(topics.LIDAR), scan)
        bus.publish(topics.BODY_STATE, body_state(0.1 * k, X_NB, q_rad=q))
        pose = X_WN @ X_NB if k < 20 else wrong
        bus.publish(topics.ORACLE_FIX, PoseFix(stamp_s=0.1 * k, X_WB=pose, source="oracle"))
        perception.step()
        state = worlds.latest
        if state is not None and state.jumps:
            break
        before = state.unmapped if state is not None else ()
    assert before
    assert state.jumps == 1
    assert state.unmapped == ()


def test_without_fixes_the_age_grows_and_the_rest_goes_on(node, robot):
    bus, perception, worlds = node
    publish(bus, robot, 0.1)
    q = tuple(joints(robot).tolist())
    for k in range(2, 20):
        bus.publish(topics.BODY_STATE, body_state(0.1 * k, X_NB, q_rad=q))
        perception.step()
    assert worlds.latest.stamp_s == pytest.approx(1.9)
    assert worlds.latest.fix_age_s == pytest.approx(1.8)


def test_world_states_come_at_ten_hertz_however_often_it_is_stepped(node, robot):
    bus, perception, worlds = node
    for k in range(100):
        publish(bus, robot, 0.02 * k)
        perception.step()
    stamps = [state.stamp_s for state in worlds.take()]
    assert np.diff(stamps) == pytest.approx(0.1)


def test_a_taken_cup_is_missed_by_depth_and_camera_together(node, robot):
    bus, perception, worlds = node
    bus.publish(topics.ORACLE_MAP, world_map())
    camera = robot.sensors.camera
    empty = np.full((camera.height, camera.width), 3.5, np.float32).tobytes()
    for k in range(1, 6):
        image = DepthImage(
            stamp_s=0.1 * k, width=camera.width, height=camera.height,
            fovy_rad=camera.fovy_rad, depth_m=empty,
        )  # fmt: skip
        bus.publish(emulated(topics.DEPTH), image)
        publish(bus, robot, 0.1 * k, sight=k == 1)
        perception.step()
        (track,) = worlds.latest.tracks
        assert track.missing == (k >= 4)


def test_what_never_meets_a_body_state_is_dropped(node, robot):
    bus, perception, _ = node
    bus.publish(topics.BODY_STATE, body_state(0.0, X_NB))
    for k in range(100):
        stamp_s = 1.0 + k * PATIENCE_S
        bus.publish(topics.ORACLE_FIX, PoseFix(stamp_s=stamp_s, X_WB=SE3(), source="oracle"))
        perception.step()
    assert len(perception._waiting) < 5


def test_what_its_sensors_bring_is_published(node, robot):
    bus, perception, _ = node
    heard = [bus.subscribe(topic) for topic in (topics.DEPTH, topics.LIDAR)]
    image = DepthImage(stamp_s=0.1, width=2, height=1, fovy_rad=1.0, depth_m=bytes(8))
    scan = LidarScan(stamp_s=0.1, angle_min_rad=-3.1, angle_step_rad=0.1, ranges_m=(1.0, 2.0))
    bus.publish(emulated(topics.DEPTH), image)
    bus.publish(emulated(topics.LIDAR), scan)
    perception.step()
    perception.step()
    assert [reader.take() for reader in heard] == [[image], [scan]]
