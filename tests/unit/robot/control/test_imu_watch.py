"""What an IMU that broke is known by, how soon, and what is not taken for it."""

import numpy as np
import pytest

from robot.control.imu_watch import FROZEN_S, NO_NUMBERS, SILENT_S, ImuWatch
from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motor_bus import MotorState
from robot.physics import GRAVITY_M_S2

PERIOD_S = 0.002
UP = np.array((0.0, 0.0, GRAVITY_M_S2))
NOTHING = np.full(3, np.nan)


class Bench:
    """A watch, and a body whose encoders and IMU are noisy."""

    def __init__(self, *, clock_s=0.0, noise=1e-3):
        self.watch, self.now_s = ImuWatch(), 100.0
        self._rng, self._clock_s, self._noise = np.random.default_rng(3), clock_s, noise
        self._last = None

    def period(self, how="", *, still=False):
        """One period; returns what the robot goes by, and what its IMU said."""
        self.now_s += PERIOD_S
        fresh = self._noise * self._rng.standard_normal((2, 3))
        imu = ImuReading(self.now_s + self._clock_s, fresh[0], UP + fresh[1])
        last = self._last or imu
        if how == "silent":
            imu = last
        elif how == "frozen":
            imu = ImuReading(imu.stamp_s, last.gyro_rad_s, last.accel_m_s2)
        elif how == "no numbers":
            imu = ImuReading(imu.stamp_s, NOTHING, UP)
        else:
            self._last = imu
        qd = np.zeros(4) if still else self._rng.standard_normal(4)
        zero, wrench = np.zeros(4), np.zeros((2, 6))
        motors = MotorState(
            self.now_s, zero, qd, zero, zero, zero, watchdog=False, command_stamp_s=self.now_s
        )
        sample = BodySample(motors, imu, ForceReading(self.now_s, wrench, wrench))
        return self.watch.take(sample), imu

    def periods_until_alarm(self, how):
        """Periods that the IMU is so before it is told; none is waited for longer than 0.1 s."""
        for count in range(1, 51):
            self.period(how)
            if self.watch.alarms:
                return count
        return None


@pytest.mark.parametrize("clock_s", [0.0, -3000.0], ids=["one clock", "a clock of its own"])
@pytest.mark.parametrize(
    ("how", "code", "within_s"),
    [
        ("silent", "imu_silent", SILENT_S),
        ("frozen", "imu_frozen", FROZEN_S),
        ("no numbers", "imu_no_numbers", (NO_NUMBERS - 1) * PERIOD_S),
    ],
)
def test_each_way_to_break_is_told_in_its_time_and_latched(how, code, within_s, clock_s):
    bench = Bench(clock_s=clock_s)
    for _ in range(100):
        bench.period()
    assert bench.periods_until_alarm(how) == round(within_s / PERIOD_S) + 1
    (alarm,) = bench.watch.alarms
    assert (alarm.code, alarm.who, alarm.level) == (code, "IMU", "SIT")
    assert "cable" in alarm.cure
    for _ in range(100):  # it comes back: nobody knows for how long
        bench.period()
    assert bench.watch.alarms == (alarm,)


@pytest.mark.parametrize(("how", "periods"), [("silent", 5), ("frozen", 25), ("no numbers", 2)])
def test_what_is_shorter_is_bridged_by_the_last_good_reading(how, periods):
    bench = Bench()
    good, _ = bench.period()
    for _ in range(20):
        for _ in range(periods):
            taken, _ = bench.period(how)
            assert np.array_equal(taken.gyro_rad_s, good.gyro_rad_s)
            assert np.isfinite(taken.gyro_rad_s).all()
        good, said = bench.period()
        assert good is said
    assert bench.watch.alarms == ()


def test_an_imu_at_500_hz_that_comes_at_100_is_not_silent():
    bench = Bench()
    for period in range(500):
        bench.period("" if period % 5 == 0 else "silent")
    assert bench.watch.alarms == ()


def test_a_world_without_noise_that_has_come_to_rest_is_no_broken_imu():
    bench = Bench(noise=0.0)
    for _ in range(500):
        bench.period(still=True)
    assert bench.watch.alarms == ()
    assert bench.periods_until_alarm("frozen") is not None  # the joints move, the IMU does not
