"""The driver of hobby servos: what it says of what it does not know, and what goes wrong."""

import threading
import time

import msgspec
import numpy as np
import pytest

from robot.clock import WallClock
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.pwm.chips import ThreadedChips
from robot.drivers.motors.pwm.joint_map import Chip
from robot.errors import DriverError
from sim.devices.i2c_bus import EmulatedSmbus, I2cBus
from sim.devices.pca9685 import Pca9685Chip
from tests.fakes.pwm_rig import Rig, head

FRAME_S = 0.0202


@pytest.fixture
def joints(tmp_path):
    return head(tmp_path)


@pytest.fixture
def rig(joints):
    return Rig(joints)


def codes(rig: Rig) -> set[str]:
    return {alarm.code for alarm in rig.driver.alarms.on}


def standing(rig: Rig) -> dict[str, float]:
    joints = rig.joints.joints
    return {name: joints[name].joint_rad(rig.servo(name).shaft.q_rad) for name in joints}


def outputs(rig: Rig) -> list[float | None]:
    chip = rig.bench.chips["hat"]
    return [chip.pulse_s(channel, rig.clock.now_s()) for channel in range(16)]


def test_joints_get_where_they_are_sent_through_pulses_signs_gears_and_offsets(rig):
    with rig.driver:
        rig.cycle(600, q=0.3, kp=5.0)
        for q in standing(rig).values():
            assert q == pytest.approx(0.3, abs=0.01)
        pulses = outputs(rig)
        # yaw: 0.3 of ±1.5708 rad over 500 to 2500 us; pitch turns the other way, 0.1 rad from its
        # zero, 1.4 rad to 900 us; jaw turns twice as far, over 1000 to 2000
        assert pulses[0] == pytest.approx(1e-6 * (1500 + 1000 * 0.3 / 1.5708), abs=3e-6)
        assert pulses[3] == pytest.approx(1e-6 * (1500 - 900 * 0.1 / 1.4), abs=3e-6)
        assert pulses[15] == pytest.approx(1e-6 * (1500 + 500 * 0.6 / 0.7854), abs=3e-6)
        assert not rig.driver.alarms.on


def test_it_measures_nothing_and_says_so(rig):
    assert rig.driver.capabilities == frozenset()
    with rig.driver as driver:
        state = rig.cycle(100, q=0.3, kp=5.0)
        assert np.isinf(state.age_s).all()
        assert np.isnan(state.tau).all()
        assert np.isnan(state.temperature_c).all()
        assert driver.status_of(0) == "assumed"
        rig.servo("yaw").shaft.q_rad = -1.0  # somebody turns it: nobody is told
        after = rig.cycle(1, q=0.3, kp=5.0)
        assert after.q[0] == pytest.approx(0.3, abs=0.005)


def test_no_pulse_leads_past_a_limit_or_faster_than_the_joint_may(rig):
    limits = rig.joints.joints["yaw"]
    step = limits.velocity_limit_rad_s * rig.joints.period_s
    with rig.driver as driver:
        before = 0.0
        for k in range(800):
            sent = driver.write(rig.hold(9.0 if k < 400 else -9.0, kp=5.0))
            driver.read()
            assert abs(sent.q_des[0] - before) <= 2 * step + 0.006
            assert limits.lower_rad - 0.006 <= sent.q_des[0] <= limits.upper_rad + 0.006
            before = sent.q_des[0]
        assert driver.limiter.clipped["position"] > 0


def test_a_joint_that_moves_by_less_than_a_tick_a_period_gets_there(joints):
    slow = msgspec.structs.replace(joints.joints["yaw"], velocity_limit_rad_s=0.5)
    rig = Rig(msgspec.structs.replace(joints, joints={**joints.joints, "yaw": slow}))
    with rig.driver:
        state = rig.cycle(250, q=0.3, kp=5.0)
        assert state.q[0] == pytest.approx(0.25, abs=0.008)
        assert 0.18 < standing(rig)["yaw"] < 0.25  # a servo lags behind its pulses
        rig.cycle(100, q=0.3, kp=5.0)
        assert standing(rig)["yaw"] == pytest.approx(0.3, abs=0.005)


def test_its_chip_is_told_once_a_frame_however_often_it_is_commanded(rig):
    bus = rig.bench.buses["hat"]
    with rig.driver as driver:
        rig.cycle(10, kp=5.0)
        before = bus.transfers
        rig.cycle(1000, kp=5.0)  # 2 s
        frames = 2.0 / FRAME_S
        # two blocks of eight outputs a frame, and two registers read every tenth
        assert bus.transfers - before == pytest.approx(2.2 * frames, rel=0.05)
        assert driver.late == 0


def test_without_stiffness_a_joint_gets_no_pulse_and_goes_where_it_is_sent_after(rig):
    with rig.driver as driver:
        rig.cycle(300, q=0.3, kp=5.0)
        limp = rig.hold(0.3, kp=5.0)
        limp.kp[0] = 0.0
        for _ in range(60):
            driver.write(limp)
            driver.read()
        assert [pulse is None for pulse in outputs(rig)].count(False) == 2
        assert not rig.servo("yaw").is_on
        assert driver.status_of(0) == "no_pulse"
        rig.cycle(300, q=0.2, kp=5.0)
        assert standing(rig)["yaw"] == pytest.approx(0.2, abs=0.01)


@pytest.mark.parametrize("error", [None, RuntimeError("in the loop")])
def test_leaving_takes_all_pulses_away(rig, error):
    try:
        with rig.driver:
            rig.cycle(100, kp=5.0)
            assert any(outputs(rig))
            if error is not None:
                raise error
    except RuntimeError:
        assert error is not None
    assert not any(outputs(rig))
    rig.let_pass(0.2)
    assert not any(servo.is_on for servo in rig.bench.servos.values())


def test_killed_it_leaves_its_pulses_and_the_next_program_takes_them_up(rig):
    """There is no watchdog: the servos go on."""
    with rig.driver as driver:
        rig.cycle(300, q=0.35, kp=5.0)
        driver._is_armed = False  # the system took its process away
        driver._claim.release()
        rig.let_pass(5.0)
        assert len([one for one in outputs(rig) if one]) == 3
        with rig.another() as spare:
            sent = spare.write(rig.hold(0.2, kp=5.0))
            assert sent.q_des[0] == pytest.approx(0.35, abs=0.03)  # from where it stands, slowly
            assert len([one for one in outputs(rig) if one]) == 3
    assert not any(outputs(rig))


@pytest.mark.parametrize(
    ("flaw", "said"),
    [("silent", "does not answer: Remote I/O error"), ("stuck", "does not answer")],
)
def test_a_chip_that_is_not_there_is_said_with_its_cure(joints, flaw, said):
    rig = Rig(joints, yaw=flaw)
    with pytest.raises(DriverError, match="i2cdetect -y 1") as caught, rig.driver:
        pass
    assert said in str(caught.value)


def test_another_chip_at_that_address_is_refused(rig):
    rig.bench.chips["hat"]._put = lambda *_: None
    with rig.driver as driver, pytest.raises(DriverError, match="is it a PCA9685"):
        driver.write(rig.hold())


def test_refused_writes_hold_and_then_sit_and_end_when_it_takes_them_again(rig):
    with rig.driver as driver:
        rig.cycle(300, q=0.3, kp=5.0)
        rig.bench.buses["hat"].trouble.refuses = 4
        began_s = rig.clock.now_s()
        while driver.alarms.level < Level.HOLD:
            state = rig.cycle(1, q=0.1, kp=5.0)
        assert rig.clock.now_s() - began_s < 4.5 * FRAME_S
        assert state.alarms[0].code == "i2c_refused"
        assert "Remote I/O error" in state.alarms[0].cause
        rig.cycle(60, q=0.1, kp=5.0)
        assert not driver.alarms.on
        rig.bench.chips["hat"].is_powered = False
        rig.cycle(150, q=0.1, kp=5.0)
        assert driver.alarms.level == Level.SIT
        rig.bench.chips["hat"].is_powered = True
        rig.cycle(150, q=0.1, kp=5.0)
        assert driver.alarms.level == Level.SIT  # latched
        driver.reset()
        rig.cycle(20, q=0.1, kp=5.0)
        assert not driver.alarms.on


def test_a_chip_that_lost_its_power_is_found_asleep_and_starts_anew_after_a_reset(rig):
    with rig.driver as driver:
        rig.cycle(300, q=0.3, kp=5.0)
        rig.bench.chips["hat"].power_up()
        began_s = rig.clock.now_s()
        while driver.alarms.level < Level.SIT:
            rig.cycle(1, q=0.3, kp=5.0)
        assert rig.clock.now_s() - began_s < 12 * FRAME_S
        assert codes(rig) == {"restarted"}
        assert not any(outputs(rig))
        driver.reset()
        rig.cycle(300, q=0.3, kp=5.0)
        assert not driver.alarms.on
        assert standing(rig)["yaw"] == pytest.approx(0.3, abs=0.01)


def test_leaving_a_chip_that_does_not_answer_says_to_cut_the_power(rig):
    rig.driver.__enter__()
    rig.cycle(30, kp=5.0)
    rig.bench.chips["hat"].is_powered = False
    with pytest.raises(DriverError, match=r"not seen to let go: yaw, pitch, jaw \(cut the power"):
        rig.driver.close()
    with pytest.raises(DriverError, match="not open"):
        rig.driver.read()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_not_a_number_is_refused_and_nothing_is_sent(rig, value):
    with rig.driver as driver:
        rig.cycle(300, q=0.3, kp=5.0)
        before = outputs(rig)
        bad = rig.hold(0.0, kp=5.0)
        bad.q_des[1] = value
        with pytest.raises(DriverError, match="q_des of pitch"):
            driver.write(bad)
        rig.let_pass(0.1)
        assert outputs(rig) == before


# --- by a thread, on the wall's clock ------------------------------------------------------------


class SlowBus(EmulatedSmbus):
    """One whose transfers take their time, as those of a real one do; `held`: do not end."""

    def __init__(self, bus: I2cBus) -> None:
        super().__init__(bus)
        self.held = threading.Event()
        self.held.set()

    def write_i2c_block_data(self, i2c_addr, register, data, force=None):
        self.held.wait(3.0)
        time.sleep(0.003)
        super().write_i2c_block_data(i2c_addr, register, data, force)


@pytest.fixture
def threaded():
    clock = WallClock()
    bus = I2cBus(clock.now_s)
    bus.chips[0x40] = Pca9685Chip()
    slow = SlowBus(bus)
    chips = ThreadedChips(
        {"hat": Chip(frame_hz=100.0)}, {"hat": [0, 1]}, clock, opens=lambda _: slow
    )
    with chips:
        chips.start()
        yield chips, bus, slow
        slow.held.set()


def waited_for(happens) -> bool:
    until_s = time.monotonic() + 5.0
    while time.monotonic() < until_s:
        if happens():
            return True
        time.sleep(0.005)
    return False


@pytest.mark.live
def test_handing_pulses_over_never_waits_for_the_bus_and_the_newest_is_written(threaded):
    chips, bus, _ = threaded
    longest_s = 0.0
    for k in range(300):
        began_s = time.thread_time()
        chips.put("hat", [200 + k, 300])
        longest_s = max(longest_s, time.thread_time() - began_s)
        time.sleep(0.001)
    assert longest_s < 0.002
    assert waited_for(lambda: bus.chips[0x40].counts(0) == (0, 499))
    assert chips.health("hat").writes <= 80  # 100 Hz of 0.3 s and what it waited then


@pytest.mark.live
def test_a_bus_that_is_held_is_seen_and_holds_up_nobody(threaded):
    chips, _, slow = threaded
    chips.put("hat", [200, 300])
    assert waited_for(lambda: chips.health("hat").writes > 2)
    slow.held.clear()
    assert waited_for(lambda: chips.health("hat").waits_s > 0.05)
    began_s = time.monotonic()
    for _ in range(100):
        chips.put("hat", [210, 300])
    assert time.monotonic() - began_s < 0.05
    slow.held.set()
    assert waited_for(lambda: chips.health("hat").waits_s < 0.05)
    assert chips.off() == []


def test_a_write_that_does_not_end_is_an_alarm_and_latched(rig, monkeypatch):
    with rig.driver as driver:
        rig.cycle(30, kp=5.0)
        health = rig.chips[0].health
        for waits_s, level, after in (
            (0.05, Level.OK, Level.OK),
            (0.07, Level.HOLD, Level.OK),
            (0.51, Level.SIT, Level.SIT),
        ):
            with monkeypatch.context() as held:
                held.setattr(
                    rig.chips[0], "health", lambda c, s=waits_s: health(c)._replace(waits_s=s)
                )
                rig.cycle(1, kp=5.0)
                assert driver.alarms.level == level
                assert codes(rig) == ({"i2c_stuck"} if level else set())
            rig.cycle(30, kp=5.0)
            assert driver.alarms.level == after
