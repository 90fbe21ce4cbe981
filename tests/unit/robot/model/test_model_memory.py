"""What is kept of compiled models has a bound: a process lives for weeks, and sees many robots."""

import shutil

import mujoco

from robot.model import description
from robot.model.mjcf import MOST_KEPT_BYTES
from robot.planning import scene


def test_mujoco_keeps_the_meshes_of_one_robot_and_not_of_all():
    assert mujoco.mj_getCacheCapacity(mujoco.mj_getCache()) == MOST_KEPT_BYTES


def test_of_robots_that_are_planned_for_the_newest_are_kept(tmp_path):
    before = dict(scene._SPECS)
    try:
        for name in ("one", "two", "three", "one"):
            shutil.copytree("robot/model/juno", tmp_path / name, dirs_exist_ok=True)
            scene._robot_spec(description.load(str(tmp_path / name / "juno.yaml")))
        kept = [tmp_path.joinpath(name) for name in ("three", "one")]
        assert len(scene._SPECS) == scene.MOST_SPECS == len(kept)
        for source, folder in zip(scene._SPECS, kept, strict=True):
            assert str(folder) in source.path
    finally:
        scene._SPECS.clear()
        scene._SPECS.update(before)
