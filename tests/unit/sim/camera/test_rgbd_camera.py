"""The robot's camera in a simulation: what stands where is seen there, by rays and by GL alike."""

import mujoco
import numpy as np
import pytest

from robot.errors import ConfigError
from robot.se3 import SE3
from sim.camera.by_gl import GlViewer
from sim.camera.by_rays import RayViewer
from sim.camera.rgbd import RgbdCamera
from sim.camera.scene_view import Pinhole
from sim.plant import Plant
from sim.realities import profile

SMALL = (160, 120)


@pytest.fixture
def plant(robot, kitchen) -> Plant:
    """A robot that looks down at the table."""
    plant = Plant(kitchen, robot, seed=0)
    plant.stand(SE3.from_xy_yaw(0.75, 0.2, 0.35))
    plant.pose({"head_pitch": 0.7})
    return plant


def camera(plant: Plant, **options) -> RgbdCamera:
    options = {"seed": 0, "renderer": "rays", "size": SMALL, **options}
    return RgbdCamera(plant.model, plant.data, plant.robot, **options)


def test_a_cup_is_seen_where_the_matrix_says_in_its_colour_and_at_its_distance(plant: Plant):
    with camera(plant, size=(320, 240)) as eye:
        image = eye.take(1.5)
    site = plant.data.site(image.frame)
    X_WC = SE3.from_rotation(site.xmat.reshape(3, 3), site.xpos)
    for body, strongest in (("object/red_cup", 0), ("object/blue_cup", 2)):
        p_WO = np.array(plant.where(body).p)
        p_CO = (X_WC.inverse() @ SE3(tuple(p_WO))).p
        u, v, w = image.matrix() @ p_CO
        column, row = round(u / w), round(v / w)
        assert image.picture()[row, column].argmax() == strongest
        assert image.depth()[row, column] == pytest.approx(p_CO[2], abs=0.06)
    assert (image.stamp_s, image.width, image.height) == (1.5, 320, 240)


def test_depth_is_along_the_optical_axis_and_zero_where_nothing_is(plant: Plant):
    plant.pose({"head_pitch": -0.6})
    with camera(plant) as eye:
        depth_m = eye.take(0.0).depth()
    assert (depth_m == 0.0).mean() > 0.3  # the sky: the kitchen has no ceiling
    plant.pose({"head_pitch": 0.7})
    with camera(plant) as eye:
        depth_m = eye.take(0.0).depth()
    table = depth_m[60, 20:140:10]  # a level edge of a level table, seen from above
    assert np.ptp(table[table > 0.0]) < 1.5


def test_gl_shows_what_rays_show(plant: Plant):
    size = Pinhole.of(plant.robot, width=160, height=120)
    site = plant.robot.sensors.camera.site
    mujoco.mj_forward(plant.model, plant.data)
    rays = RayViewer(plant.model, plant.data, site=site, pinhole=size).look()
    try:
        with GlViewer(plant.model, plant.data, site=site, pinhole=size) as viewer:
            gl = viewer.look()
    except ConfigError as error:
        pytest.skip(str(error))
    there = np.isfinite(rays.depth_m)
    assert (there == np.isfinite(gl.depth_m)).mean() > 0.99
    both = there & np.isfinite(gl.depth_m)
    assert np.percentile(np.abs(rays.depth_m - gl.depth_m)[both], 95) < 0.002
    assert np.percentile(np.abs(np.clip(rays.light, 0, 1) - gl.light), 95) < 0.01
    assert np.percentile(np.abs(rays.facing - gl.facing)[both], 80) < 0.01
    assert (rays.gloss == gl.gloss).mean() > 0.99


def test_without_egl_rays_are_taken_and_named(plant: Plant, monkeypatch):
    def missing(*_size: int) -> None:
        raise ConfigError("no EGL here")

    monkeypatch.setattr("sim.camera.by_gl.gl_context", missing)
    with camera(plant, renderer="auto") as eye:
        assert eye.by == "rays"
    with pytest.raises(ConfigError, match="no EGL here"), camera(plant, renderer="egl"):
        pass


def test_a_picture_depends_on_seed_and_time_and_on_no_picture_before(plant: Plant):
    def taken(seed: int, *stamps_s: float):
        with camera(plant, seed=seed, reality=profile("real").camera) as eye:
            return [eye.take(stamp_s) for stamp_s in stamps_s][-1]

    assert taken(1, 0.5) == taken(1, 0.1, 0.2, 0.5)
    assert taken(1, 0.5).colours != taken(2, 0.5).colours
    assert taken(1, 0.5).depth_m != taken(1, 0.6).depth_m


def test_the_physics_does_not_notice_a_picture(robot, kitchen):
    def fallen(*, is_watched: bool) -> bytes:
        plant = Plant(kitchen, robot, seed=3)
        eye = camera(plant)
        with eye:
            for _ in range(20):
                plant.step(10)
                if is_watched:
                    eye.take(plant.time_s)
        return plant.data.qpos.tobytes() + plant.data.xpos.tobytes()

    assert fallen(is_watched=True) == fallen(is_watched=False)


def test_a_motor_goes_no_further_than_it_can(plant: Plant):
    with pytest.raises(ConfigError, match=r"head_yaw goes from -\d+ to \d+ deg, not to 516"):
        plant.pose({"head_yaw": 9.0})


def test_a_motor_that_is_none_has_no_pose(plant: Plant):
    with pytest.raises(ConfigError, match="did you mean 'head_yaw'"):
        plant.pose({"head_jaw": 0.1})
