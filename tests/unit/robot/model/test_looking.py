"""How far a body looks, and how fast it gets there, follow from its description."""

import math

import msgspec
import pytest

from executive.skills.motions import glances
from robot.model import description, looking
from robot.planning import views


@pytest.fixture(scope="module")
def juno():
    return description.load()


def test_junos_figures_are_those_that_searching_was_measured_with(juno):
    """To the last bit: its plans are the same as with the figures themselves."""
    assert juno.neck_rad == 1.4
    assert views.HEAD_SHARE * looking.aside_rad(juno) == 0.95
    assert glances.HEAD_SHARE * looking.aside_rad(juno) == 1.3
    assert looking.cone_rad(juno) == 0.42
    assert looking.walk_m_s(juno) == 0.2
    assert looking.turn_rad_s(juno) == 0.4


def test_without_a_neck_it_is_the_waist_and_the_picture(juno):
    gaze = msgspec.structs.replace(juno.gaze, waist_yaw_rad=0.5)
    groups = {**juno.groups, "head": ()}
    stiff = msgspec.structs.replace(juno, groups=groups, gaze=gaze, neck_rad=0.0)
    half_rad = math.atan(math.tan(0.5 * juno.sensors.camera.fovy_rad) * 4 / 3)
    assert looking.aside_rad(stiff) == pytest.approx(0.5 + 0.7 * half_rad)


def test_a_slower_robot_with_a_narrower_camera_reckons_with_less(juno):
    camera = msgspec.structs.replace(juno.sensors.camera, fovy_rad=0.5)
    sensors = msgspec.structs.replace(juno.sensors, camera=camera)
    paces = msgspec.structs.replace(juno.paces, walk_m_s=0.1, turn_rad_s=0.19)
    slow = msgspec.structs.replace(juno, sensors=sensors, paces=paces)
    assert looking.walk_m_s(slow) < 0.5 * looking.walk_m_s(juno)
    assert looking.turn_rad_s(slow) == pytest.approx(0.2)
    assert looking.cone_rad(slow) < 0.5 * looking.cone_rad(juno)
