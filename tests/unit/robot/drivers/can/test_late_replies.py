"""An answer about a register that comes late is no feedback, whoever reads it."""

from collections.abc import Sequence
from pathlib import Path

import pytest

from robot.drivers.motors.can import arming
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.interview import interview
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.can.mit11 import register_reply
from robot.drivers.motors.can.ports import Heard
from robot.drivers.motors.can.replies import feedback_of
from robot.drivers.motors.can.verdicts import verdicts
from sim.devices.direct import DirectPorts
from tests.fakes.can_rig import Rig, arm


class Late(DirectPorts):
    """Ports on which a motor's last answer about a register comes again, behind its feedback."""

    def __init__(self, rig: Rig) -> None:
        super().__init__(rig.bench, rig.clock)
        self._kept: dict[int, Heard] = {}

    def receive(self, until_s: float) -> Sequence[Heard]:
        heard: list[Heard] = []
        for one in super().receive(until_s):
            heard.append(one)
            assert one.frame is not None
            if register_reply(one.frame) is not None:
                self._kept[one.frame.id] = one
            elif one.frame.id in self._kept:
                heard.append(self._kept[one.frame.id])
        return heard


@pytest.fixture
def rig(tmp_path: Path) -> Rig:
    return Rig(arm(tmp_path))


def test_an_interview_takes_no_position_out_of_an_answer_about_a_register(rig: Rig):
    with Late(rig) as ports:
        answers = interview(ports, rig.clock, rig.joints)
    for name, joint in rig.joints.joints.items():
        told = answers[name].feedback
        assert told is not None
        assert joint.joint_rad(told.q_rad) == pytest.approx(
            joint.joint_rad(rig.motor(name).shaft.q_rad), abs=0.02
        )
    assert not [one for one in verdicts(rig.joints, answers) if one.is_grave]


def test_a_motor_that_was_enabled_is_not_taken_for_one_that_was_not(rig: Rig):
    with Late(rig) as ports:
        interview(ports, rig.clock, rig.joints)
        arming.arm(ports, rig.clock, rig.joints, _ranges(rig.joints))
    assert [motor.status for motor in rig.bench.devices] == [1, 1, 1]


def test_a_motor_that_did_not_let_go_is_not_taken_for_one_that_did(rig: Rig):
    ranges = _ranges(rig.joints)
    with Late(rig) as ports:
        interview(ports, rig.clock, rig.joints)
        arming.arm(ports, rig.clock, rig.joints, ranges)
        deaf = rig.motor("elbow")
        deaf._obey = lambda _data: None
        assert arming.disable(ports, rig.clock, rig.joints, ranges) == ["elbow"]
    assert deaf.status != 0


def test_feedback_away_from_the_end_of_its_range_is_feedback_whatever_its_third_byte(rig: Rig):
    joint = rig.joints.joints["wrist"]
    frame = Frame(joint.answers_as, bytes((joint.id, 0, 0x33, 21, 0, 0, 0, 0)))
    assert feedback_of(joint, frame, joint.expected) is None
    moved = Frame(joint.answers_as, bytes((joint.id, 0x80, 0x33, 21, 0, 0, 0, 0)))
    assert feedback_of(joint, moved, joint.expected) is not None


def _ranges(joints: JointMap):
    return [one.expected for one in joints.joints.values()]
