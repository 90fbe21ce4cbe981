"""The driver on emulated RobStrides, alone and beside Damiaos: what only they have."""

from pathlib import Path

import pytest

from robot.bringup import can_tools
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.can.interview import interview
from robot.drivers.motors.can.verdicts import verdicts
from robot.errors import ConfigError, DriverError
from sim.devices.direct import DirectPorts
from sim.devices.robstride import HOT, RobStride
from tests.fakes.can_rig import ROBSTRIDES, ROBSTRIDES_AND_A_DAMIAO, Rig, arm


@pytest.fixture
def rig(tmp_path: Path) -> Rig:
    return Rig(arm(tmp_path, ROBSTRIDES))


def motor(rig: Rig, name: str = "wrist") -> RobStride:
    found = rig.bench.motors[name]
    assert isinstance(found, RobStride)
    return found


def advance(rig: Rig, span_s: float) -> None:
    rig.clock.sleep_until(rig.clock.now_s() + span_s)
    rig.bench.advance(rig.clock.now_s())


def test_a_motor_that_gives_less_than_its_joint_may_is_refused(rig: Rig):
    motor(rig, "elbow").parameters[0x700B] = 5.0
    with pytest.raises(DriverError, match=r"elbow.*gives 5 N m at most \(register 0x700b\)"):
        rig.driver.__enter__()


@pytest.mark.parametrize(("bits", "code"), [(0x02, "over_current"), (0x10, "overload")])
def test_strain_holds_every_joint(rig: Rig, bits: int, code: str):
    with rig.driver:
        rig.cycle(50)
        motor(rig).trouble.status = bits
        rig.cycle(3)
        assert {one.code: one.who for one in rig.driver.alarms.on} == {code: "wrist"}
        assert rig.driver.alarms.level == Level.HOLD


@pytest.mark.parametrize(("bits", "code"), [(HOT, "winding_hot"), (0x08, "encoder")])
def test_other_faults_are_latched(rig: Rig, bits: int, code: str):
    with rig.driver:
        rig.cycle(50)
        motor(rig).trouble.status = bits
        rig.cycle(3)
        motor(rig).trouble.status = None
        rig.cycle(100)
        assert code in {one.code for one in rig.driver.alarms.on}
        assert rig.driver.alarms.level == Level.SIT


def test_reports_that_nobody_asked_for_are_feedback_and_faults_are_none(rig: Rig):
    with rig.driver:
        rig.cycle(20)
        motor(rig)._reports_to = 0xFD
        rig.cycle(100)
        assert rig.driver.reception.ignored == 0
        assert rig.driver.alarms.level == Level.OK


def test_a_scan_finds_both_families(tmp_path):
    rig = Rig(arm(tmp_path, ROBSTRIDES_AND_A_DAMIAO))
    with DirectPorts(rig.bench, rig.clock) as ports:
        found = can_tools.scan(ports, rig.clock, rig.joints, 16)
    assert {(one.id, one.joint) for one in found} == {(1, "shoulder"), (1, "elbow"), (3, "wrist")}
    assert {one.joint: one.ranges is None for one in found} == {
        "shoulder": True, "elbow": False, "wrist": True
    }  # fmt: skip


def test_readings_say_position_supply_and_heat(rig: Rig):
    with DirectPorts(rig.bench, rig.clock) as ports:
        (_, _, wrist) = can_tools.readings(ports, rig.clock, rig.joints)
    assert (wrist.status, wrist.supply_v, wrist.winding_c) == ("disabled", 24.0, 25.0)
    assert wrist.q_rad == pytest.approx(0.2, abs=0.05)


def test_a_fine_arm_has_no_findings(rig: Rig):
    with DirectPorts(rig.bench, rig.clock) as ports:
        assert not verdicts(rig.joints, interview(ports, rig.clock, rig.joints))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("model: RS00, id: 3", "model: RS00, id: 3, reply_id: 20", "leave reply_id out"),
        ("model: RS00, id: 3", "model: RS00, id: 300", "from 1 to 127, not 300"),
        ("model: RS00, id: 3", "model: RS00, id: 2", "2 on the bus 'arm' is elbow's already"),
        ("rate_hz: 500", "rate_hz: 1000", "96%"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, old: str, new: str, said: str):
    assert old in ROBSTRIDES
    with pytest.raises(ConfigError) as caught:
        arm(tmp_path, ROBSTRIDES.replace(old, new))
    assert said in str(caught.value)
