"""Pictures of a plant that goes on without waiting: what is told, taken, late, and missed."""

import numpy as np
import pytest
from msgspec.structs import replace
from PIL import Image

from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers.simulation.plant_sensors import emulated
from robot.drivers.simulation.shared_plant import PlantServer
from robot.errors import DriverError
from sim import realities, world
from sim.camera.rgbd import RgbdCamera
from sim.live import LivePlant
from sim.photographer import Photographer
from sim.plant import Plant
from sim.scene_memory import SceneMemory


@pytest.fixture
def plant(robot, kitchen) -> Plant:
    return Plant(kitchen, robot, seed=0)


def test_how_everything_stands_crosses_whole_and_once(plant: Plant, robot, kitchen, tmp_path):
    there = Plant(kitchen, robot, seed=0)
    with (
        SceneMemory(plant.model, tmp_path, create=True) as writer,
        SceneMemory(there.model, tmp_path, create=False) as reader,
    ):
        assert reader.read(there.data) is None
        plant.pose({"head_yaw": 0.4})
        plant.data.mocap_pos[:] += 0.25
        writer.write(1.5, plant.data)
        assert reader.read(there.data) == 1.5
        assert reader.read(there.data) is None
    assert np.array_equal(there.data.qpos, plant.data.qpos)
    assert np.array_equal(there.data.mocap_pos, plant.data.mocap_pos)


def test_a_scene_of_another_world_or_of_none_is_refused(plant: Plant, robot, tmp_path):
    with pytest.raises(DriverError, match="cannot be mapped"):
        SceneMemory(plant.model, tmp_path, create=False)
    SceneMemory(plant.model, tmp_path, create=True).close()
    other = Plant(world.empty(), robot, seed=0)
    with pytest.raises(DriverError, match="another world"):
        SceneMemory(other.model, tmp_path, create=False)


def test_the_plant_tells_as_often_as_the_camera_takes_pictures(robot, tmp_path, hold):
    plant = Plant(world.empty(), robot, seed=0)
    with (
        PlantServer(robot, tmp_path) as server,
        SceneMemory(plant.model, tmp_path, create=True) as scene,
        SceneMemory(plant.model, tmp_path, create=False) as reader,
    ):
        live = LivePlant(plant, server, LocalBus(), clock=SimulatedClock(), scene=scene)
        stamps_s = []
        for _ in range(101):
            live.period()
            if (stamp_s := reader.read(plant.data)) is not None:
                stamps_s.append(stamp_s)
            plant.step(2)
    assert stamps_s == pytest.approx([0.0, 0.1, 0.2])


def test_a_picture_comes_late_and_dropped_ones_never_do(plant: Plant, tmp_path):
    clock, bus = SimulatedClock(), LocalBus()
    came = bus.subscribe(emulated(topics.RGBD))
    reality = replace(realities.profile("real").camera, drops=0.3, late_ms=(50.0, 50.0))
    camera = RgbdCamera(
        plant.model, plant.data, plant.robot, seed=1, reality=reality, renderer="rays",
        size=(16, 16),
    )  # fmt: skip
    stamps_s = [round(0.1 * k, 1) for k in range(40)]
    with camera, SceneMemory(plant.model, tmp_path, create=True) as scene:
        album = tmp_path / "seen.png"
        photographer = Photographer(scene, plant.data, camera, bus=bus, clock=clock, album=album)
        arrived = []
        for stamp_s in stamps_s:
            clock.set(stamp_s)
            scene.write(stamp_s, plant.data)
            photographer.step()
            assert not came.take()
            clock.set(stamp_s + 0.06)
            photographer.step()
            arrived += [image.stamp_s for image in came.take()]
        dropped = [stamp_s for stamp_s in stamps_s if camera.late_s(stamp_s) is None]
    assert 4 <= len(dropped) <= 20
    assert sorted(arrived + dropped) == stamps_s
    with Image.open(album) as newest:
        assert newest.size == (16, 16)
