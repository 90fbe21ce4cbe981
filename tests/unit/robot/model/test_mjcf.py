"""An overlay adds to a published model; a model that is not there is an error with its cure."""

import math

import mujoco
import pytest

from robot.errors import DescriptionError
from robot.model import mjcf
from robot.model.published import Published

BASE = """
<mujoco>
  <compiler angle="radian"/>
  <default><default class="own"><joint damping="1"/></default></default>
  <asset><mesh name="cube" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>
  <worldbody>
    <light pos="0 0 3"/>
    <body name="trunk" childclass="own">
      <freejoint/>
      <geom size="0.1" mass="2"/>
      <geom type="mesh" mesh="cube" mass="0"/>
      <body name="arm">
        <joint name="elbow" axis="0 1 0" range="-1 1"/>
        <geom size="0.1" mass="1"/>
      </body>
    </body>
  </worldbody>
  <keyframe><key qpos="0 0 0 1 0 0 0 0"/></keyframe>
</mujoco>
"""
OVERLAY = """
<mujoco>
  <default><default class="own"><joint damping="3"/></default></default>
  <worldbody>
    <body name="arm">
      <joint name="elbow" range="-2 1"/>
      <site name="tip" pos="0 0 1"/>
      <body name="hand"><joint name="wrist" axis="1 0 0"/><geom size="0.1" mass="0.5"/></body>
    </body>
  </worldbody>
  <sensor><force name="felt" site="tip"/></sensor>
</mujoco>
"""


@pytest.fixture
def model(tmp_path):
    (tmp_path / "base.xml").write_text(BASE)
    (tmp_path / "overlay.xml").write_text(OVERLAY)
    return mjcf.compiled(laid_over(tmp_path, "cube"))


def laid_over(folder, *without):
    base, overlay = str(folder / "base.xml"), str(folder / "overlay.xml")
    return mjcf.Source(base, str(folder), overlay, overlay_folder=str(folder), without=without)


def test_an_overlay_adds_to_the_bodies_of_the_same_name(model):
    assert model.body("hand").parentid == model.body("arm").id
    assert model.site("tip").bodyid == model.body("arm").id
    assert model.sensor("felt").type == mujoco.mjtSensor.mjSENS_FORCE
    assert model.body_mass.sum() == 3.5


def test_an_overlay_changes_joints_and_classes(model):
    assert model.joint("elbow").range.tolist() == [-2.0, 1.0]
    assert model.joint("elbow").damping == model.joint("wrist").damping == 3.0


def test_keyframes_light_and_unwanted_meshes_are_left_out(model):
    assert (model.nkey, model.nlight) == (0, 0)
    assert mujoco.mjtGeom.mjGEOM_MESH not in model.geom_type


def test_a_body_of_the_overlay_that_does_not_compile_is_named(tmp_path):
    (tmp_path / "base.xml").write_text(BASE)
    (tmp_path / "overlay.xml").write_text("<mujoco><sensor><force site='none'/></sensor></mujoco>")
    with pytest.raises(DescriptionError, match=r"overlay\.xml"):
        mjcf.compiled(laid_over(tmp_path))


def test_a_published_model_is_taken_from_the_first_place_that_has_it(tmp_path):
    (tmp_path / "second").mkdir()
    (tmp_path / "second" / "it.xml").write_text(BASE)
    model = Published(places=("first", "second"), cure="get it", source="us")
    assert model.find("it.xml", description=tmp_path / "it.yaml") == tmp_path / "second"


def test_a_published_model_that_is_nowhere_is_an_error_with_the_cure(tmp_path):
    model = Published(places=("first", "~/second"), cure="git clone it", source="us")
    with pytest.raises(DescriptionError, match=r"it\.xml is in none of") as caught:
        model.find("it.xml", description=tmp_path / "it.yaml")
    (problem,) = caught.value.problems
    assert problem.suggestion == "git clone it"
    assert str(tmp_path / "first") in problem.message


@pytest.mark.parametrize("place", ["/", "~", "..", "../..", "~/.."])
def test_a_published_model_is_no_pretext_for_all_that_lies_around(tmp_path, monkeypatch, place):
    own = tmp_path / "home" / "robots" / "mine"
    own.mkdir(parents=True)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    model = Published(places=(place,), cure="none", source="none")
    with pytest.raises(DescriptionError, match="holds more than a published model"):
        model.find("it.xml", description=own / "it.yaml")


def test_a_warning_of_mujoco_goes_through_no_link_that_lies_where_we_stand(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    theirs = tmp_path / "theirs"
    (tmp_path / "MUJOCO_LOG.TXT").symlink_to(theirs)
    model = mujoco.MjModel.from_xml_string(BASE)
    data = mujoco.MjData(model)
    data.qpos[0] = math.nan
    mujoco.mj_step(model, data)
    assert data.warning[mujoco.mjtWarning.mjWARN_BADQPOS].number == 1
    assert not theirs.exists()
