"""A robot's description and its MJCF: what they give, and what is said when they disagree."""

import math
import re
import shutil
from pathlib import Path

import msgspec
import mujoco
import numpy as np
import pytest

from robot.errors import ConfigError, DescriptionError
from robot.model import description
from robot.model.body import BodyModel

JUNO = Path(description.__file__).parent / "juno"


@pytest.fixture(scope="module")
def juno():
    return description.load()


@pytest.fixture(scope="module")
def body(juno):
    return BodyModel(juno)


@pytest.fixture
def edited(tmp_path):
    """A copy of Juno with text replaced in one of its files; gives the description's path."""

    def edit(file, pattern, replacement):
        folder = tmp_path / "juno"
        shutil.copytree(JUNO, folder, dirs_exist_ok=True)
        path = folder / file
        text, count = re.subn(pattern, replacement, path.read_text())
        assert count > 0
        path.write_text(text)
        return folder / "juno.yaml"

    return edit


def test_a_robot_is_about_as_large_as_it_says(body):
    assert 30.0 < body.mass_kg < 40.0
    assert body.count == len(body.description.motors) == 33


def test_an_unknown_robot_is_named_with_the_nearest():
    with pytest.raises(ConfigError, match=r"unknown robot 'jun' \(did you mean 'juno'\?\)"):
        description.load("jun")


@pytest.mark.parametrize(
    ("pattern", "replacement", "message"),
    [
        (r"joint: left_knee,", "joint: right_knee,", "joint 'right_knee' has several motors"),
        (r"left_leg: \[", "left_leg: [left_knee, ", "names motor 'left_knee' more than once"),
        (r"left_leg: \[", "left_leg: [right_knee, ", "motor 'right_knee' is in several"),
        (r"(?ms)^feet:.*?(?=^hands:)", "feet: {}\n", "the left foot is missing"),
        (r"(?m)^name: .*", "name: ''", "name is empty"),
        (r"(?m)^name: .*", r'name: "a\\nb"', "must be one line of text"),
        (r"(?m)^mjcf: .*", "mjcf: ''", "mjcf is empty"),
    ],
)
def test_what_is_doubled_or_not_there_is_told_as_such(edited, pattern, replacement, message):
    with pytest.raises(ConfigError) as caught:
        description.load(edited("juno.yaml", pattern, replacement))
    assert any(message in str(problem) for problem in caught.value.problems)


def test_a_missing_joint_is_named_with_the_cure(edited):
    path = edited("juno.yaml", r"\{joint: left_knee,", "{joint: left_kneee,")
    with pytest.raises(DescriptionError) as caught:
        BodyModel(description.load(path))
    (problem,) = caught.value.problems
    assert "'left_kneee'" in problem.message
    assert problem.file.endswith("juno.xml")
    assert "add the joint" in problem.suggestion


@pytest.mark.parametrize(
    ("pattern", "replacement", "words"),
    [
        (r"sole_site: left_sole", "sole_site: left_soul", "site 'left_soul'"),
        (r"grasp_site: right_grasp", "grasp_site: right_grip", "site 'right_grip'"),
        (r"base_body: pelvis", "base_body: hips", "body 'hips'"),
        (r"imu: \{site: imu", "imu: {site: imux", "site 'imux'"),
    ],
)
def test_every_name_of_the_description_must_be_in_the_mjcf(edited, pattern, replacement, words):
    path = edited("juno.yaml", pattern, replacement)
    with pytest.raises(DescriptionError, match=words):
        BodyModel(description.load(path))


@pytest.mark.parametrize(
    ("pattern", "replacement", "words"),
    [
        (r"  waist: \[waist_yaw", "  waist: [waist_yow", "names motor 'waist_yow'"),
        (r"motor: left_gripper", "motor: left_griper", "did you mean 'left_gripper'"),
        (r"  head: \[head_yaw, head_pitch\]\n", "", "joint group 'head' is missing"),
        (r"    left_knee: 1.0", "    left_kne: 1.0", "posture 'nominal'"),
        (r"  left_knee: \{joint[^\n]*\n", "", "names motor 'left_knee', not in motors"),
        (r"raised: raised", "raised: risen", "signs name posture 'risen'"),
        (r"(?s)handling:.*?\n\nsigns", "signs", "there are hands, and no 'handling'"),
        (r"torque_limit_nm: 139", "torque_limit: 139", "unknown key 'torque_limit'"),
    ],
)
def test_names_inside_the_description_must_point_at_each_other(edited, pattern, replacement, words):
    path = edited("juno.yaml", pattern, replacement)
    with pytest.raises(ConfigError, match=words):
        description.load(path)


def test_a_broken_mjcf_is_named(edited):
    path = edited("juno.xml", r"</mujoco>", "")
    with pytest.raises(DescriptionError, match="does not compile"):
        BodyModel(description.load(path))


def test_a_posture_outside_the_joint_limits_is_named(edited):
    path = edited("juno.yaml", r"left_elbow: -1.55", "left_elbow: 0.6")
    with pytest.raises(DescriptionError, match=r"'nominal' puts left_elbow to 0.6, it goes -2.3"):
        BodyModel(description.load(path))


def test_written_joints_are_read_back_and_mimics_follow(juno, body):
    data = body.data()
    q = np.linspace(0.1, 0.9, body.count) * (body.upper_rad - body.lower_rad) + body.lower_rad
    body.write_joints(data, q, 0.5 * q)
    np.testing.assert_allclose(data.qpos[body.qpos_of], q)
    np.testing.assert_allclose(data.qvel[body.dof_of], 0.5 * q)
    mujoco.mj_forward(body.model, data)
    equalities = data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY
    assert np.count_nonzero(equalities) > 0
    assert np.abs(data.efc_pos[equalities]).max() < 1e-9


def test_nominal_stands_on_flat_soles_at_the_gait_height(juno, body):
    data = body.data()
    body.write_joints(data, np.array(juno.posture("nominal")))
    data.qpos[3] = 1.0
    mujoco.mj_kinematics(body.model, data)
    for side in ("left", "right"):
        sole = body.site_pose(data, body.sole_site[side])
        np.testing.assert_allclose(sole.rotation()[:, 2], [0.0, 0.0, 1.0], atol=1e-9)
        assert math.isclose(data.qpos[2] - sole.p[2], juno.walking.base_height_m, abs_tol=2e-3)


def test_nominal_touches_nothing(juno, body):
    data = body.data()
    body.write_joints(data, np.array(juno.posture("nominal")))
    mujoco.mj_forward(body.model, data)
    assert data.ncon == 0


def spare(value):
    """A struct as builtins, without all that its type has a value for; `walking` and the like."""
    if not isinstance(value, msgspec.Struct):
        return msgspec.to_builtins(value)
    fields = msgspec.structs.fields(value)
    return {
        field.name: spare(getattr(value, field.name))
        for field in fields
        if field.default is msgspec.NODEFAULT
    }


@pytest.mark.parametrize("part", ["walking", "balance", "arms", "signs", "gaze", "getting_up"])
def test_what_an_older_description_leaves_out_is_as_junos(juno, part):
    said = getattr(juno, part)
    assert msgspec.convert(spare(said), type(said)) == said


def test_what_an_older_description_leaves_out_of_hands_is_as_junos(juno):
    handling = juno.handling
    read = msgspec.convert(spare(handling), type(handling))
    assert (read.gripping, read.speeds, read.giving) == (
        handling.gripping,
        handling.speeds,
        handling.giving,
    )
    assert read.reaching.raising == handling.reaching.raising
    assert read.reaching.stepping_in == handling.reaching.stepping_in


def test_every_limit_has_a_source(juno):
    assert all(motor.source for motor in juno.motors.values())
