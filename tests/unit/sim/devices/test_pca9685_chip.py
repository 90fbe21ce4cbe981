"""The emulated chip, against its data sheet and a client that nobody here wrote."""

import errno
import inspect

import PCA9685_smbus2.PCA9685 as public
import pytest
import smbus2

from robot.clock import SimulatedClock
from robot.drivers.motors.pwm import pca9685
from sim.devices.i2c_bus import EmulatedSmbus, I2cBus
from sim.devices.pca9685 import Pca9685Chip

ADDRESS = 0x40


class Bench:
    def __init__(self) -> None:
        self.clock = SimulatedClock(10.0)
        self.bus = I2cBus(self.clock.now_s)
        self.chip = self.bus.chips[ADDRESS] = Pca9685Chip()
        self.smbus = EmulatedSmbus(self.bus)

    def sleep(self, span_s: float) -> None:
        self.clock.sleep_until(self.clock.now_s() + span_s)

    def pulse_us(self, channel: int) -> float | None:
        pulse_s = self.chip.pulse_s(channel, self.clock.now_s())
        return None if pulse_s is None else 1e6 * pulse_s


@pytest.fixture
def bench() -> Bench:
    return Bench()


@pytest.mark.parametrize(
    "name", ["write_byte_data", "read_byte_data", "write_i2c_block_data", "read_i2c_block_data"]
)
def test_its_bus_is_called_as_smbus2s_is(name):
    ours = inspect.signature(getattr(EmulatedSmbus, name)).parameters
    theirs = inspect.signature(getattr(smbus2.SMBus, name)).parameters
    assert [(one.name, one.default) for one in ours.values()] == [
        (one.name, one.default) for one in theirs.values()
    ]
    wanted = inspect.signature(getattr(pca9685.SmBus, name)).parameters
    assert [*wanted] == [*theirs][: len(wanted)]


def test_no_block_is_longer_than_smbus2_takes(bench):
    assert smbus2.smbus2.I2C_SMBUS_BLOCK_MAX == pca9685.MOST_BLOCK == 32
    with pytest.raises(ValueError, match="Data length cannot exceed 32 bytes"):
        bench.smbus.write_i2c_block_data(ADDRESS, 6, [0] * 33)
    with pytest.raises(ValueError, match="32"):
        bench.smbus.read_i2c_block_data(ADDRESS, 6, 33)


def test_after_power_it_sleeps_with_the_registers_of_its_sheet_and_gives_no_pulse(bench):
    read = bench.smbus.read_byte_data
    told = [read(ADDRESS, register) for register in (0, 1, 2, 3, 4, 5, 0xFE)]
    assert told == [0x11, 0x04, 0xE2, 0xE4, 0xE8, 0xE0, 0x1E]
    assert read(ADDRESS, 0x06 + 4 * 7 + 3) == 0x10
    assert all(bench.pulse_us(channel) is None for channel in range(16))


def test_without_auto_increment_a_block_goes_into_one_register(bench):
    bench.smbus.write_i2c_block_data(ADDRESS, 0x06, [1, 2, 3])
    assert bench.smbus.read_byte_data(ADDRESS, 0x06) == 3
    bench.smbus.write_byte_data(ADDRESS, 0x00, 0x31)
    bench.smbus.write_i2c_block_data(ADDRESS, 0x06, [1, 2, 3])
    assert bench.smbus.read_i2c_block_data(ADDRESS, 0x06, 3) == [1, 2, 3]


def test_its_frames_can_be_changed_only_while_it_sleeps(bench):
    bench.smbus.write_byte_data(ADDRESS, 0x00, 0x20)
    bench.smbus.write_byte_data(ADDRESS, 0xFE, 121)
    assert bench.smbus.read_byte_data(ADDRESS, 0xFE) == 0x1E
    bench.smbus.write_byte_data(ADDRESS, 0x00, 0x30)
    bench.smbus.write_byte_data(ADDRESS, 0xFE, 121)
    assert bench.chip.frame_hz == pytest.approx(50.03, abs=0.01)
    bench.smbus.write_byte_data(ADDRESS, 0xFE, 1)
    assert bench.smbus.read_byte_data(ADDRESS, 0xFE) == 3  # 1526 Hz at most


def test_full_off_wins_and_all_leds_are_written_and_never_read(bench):
    write = bench.smbus.write_byte_data
    write(ADDRESS, 0x00, 0x20)
    bench.sleep(0.001)
    bench.smbus.write_i2c_block_data(ADDRESS, 0x06, [0, 0, 0x33, 0x01])
    assert bench.pulse_us(0) is not None
    write(ADDRESS, 0xFD, 0x10)
    assert bench.pulse_us(0) is None
    assert bench.smbus.read_byte_data(ADDRESS, 0xFD) == 0
    assert bench.smbus.read_byte_data(ADDRESS, 0x09) == 0x10


def test_asleep_while_it_pulses_it_asks_for_a_restart(bench):
    write, read = bench.smbus.write_byte_data, bench.smbus.read_byte_data
    write(ADDRESS, 0x00, 0x20)
    bench.sleep(0.001)
    bench.smbus.write_i2c_block_data(ADDRESS, 0x06, [0, 0, 0x33, 0x01])
    write(ADDRESS, 0x00, 0x30)
    assert read(ADDRESS, 0x00) == 0xB0
    assert bench.pulse_us(0) is None
    write(ADDRESS, 0x00, 0x20)
    bench.sleep(0.001)
    assert bench.pulse_us(0) is None
    write(ADDRESS, 0x00, 0xA0)
    assert read(ADDRESS, 0x00) == 0x20
    assert bench.pulse_us(0) is not None


def test_nobody_at_an_address_and_a_held_bus_are_the_errors_of_linux(bench):
    with pytest.raises(OSError, match="Remote I/O") as caught:
        bench.smbus.read_byte_data(0x41, 0)
    assert caught.value.errno == errno.EREMOTEIO
    bench.bus.trouble.is_stuck = True
    with pytest.raises(TimeoutError) as caught:
        bench.smbus.read_byte_data(ADDRESS, 0)
    assert caught.value.errno == errno.ETIMEDOUT
    bench.smbus.close()
    with pytest.raises(OSError, match="Bad file descriptor"):
        bench.smbus.read_byte_data(ADDRESS, 0)


def test_a_public_client_turns_the_emulated_servo_where_it_turns_a_real_one(bench, monkeypatch):
    """Adafruit's, as it is sold for smbus2: 1.5 ms at 50 Hz."""
    monkeypatch.setattr(public, "SMBus", lambda _: EmulatedSmbus(bench.bus))
    monkeypatch.setattr(public.time, "sleep", bench.sleep)
    client = public.PCA9685(interface=1, address=ADDRESS)
    client.set_pwm_freq(50)
    assert bench.chip.frame_hz == pytest.approx(50.0, rel=0.01)
    client.set_pwm(5, 0, 307)
    bench.sleep(0.001)
    assert bench.pulse_us(5) == pytest.approx(1500.0, rel=0.005)
    client.set_all_pwm(0, 0x1000)
    assert bench.pulse_us(5) is None


def test_the_driver_and_the_public_client_write_the_same_pulses(bench, monkeypatch):
    ours = pca9685.Pca9685(bench.smbus, ADDRESS, pca9685.pre_scale(50.0, 25e6))
    assert ours.start(bench.sleep)
    ours.write(3, [205, 307, 410, pca9685.OFF])
    said = bench.smbus.read_i2c_block_data(ADDRESS, 0x06 + 12, 16)
    monkeypatch.setattr(public, "SMBus", lambda _: EmulatedSmbus(bench.bus))
    monkeypatch.setattr(public.time, "sleep", bench.sleep)
    client = public.PCA9685(interface=1, address=ADDRESS)
    for channel, count in ((3, 205), (4, 307), (5, 410), (6, 0x1000)):
        client.set_pwm(channel, 0, count)
    assert [bench.smbus.read_byte_data(ADDRESS, 0x06 + 12 + k) for k in range(16)] == said


@pytest.mark.parametrize("frame_hz", [50.0, 60.0, 100.0, 200.0, 330.0])
@pytest.mark.parametrize("oscillator_hz", [24.2e6, 25e6, 27.1e6])
def test_frames_are_never_faster_than_asked_for(bench, frame_hz, oscillator_hz):
    bench.chip.oscillator_hz = oscillator_hz
    scale = pca9685.pre_scale(frame_hz, oscillator_hz)
    device = pca9685.Pca9685(bench.smbus, ADDRESS, scale)
    assert device.start(bench.sleep)
    assert frame_hz * 0.94 < bench.chip.frame_hz <= frame_hz * 1.000001
    assert pca9685.frame_s(scale, oscillator_hz) == pytest.approx(1.0 / bench.chip.frame_hz)
    for count in (1, 205, 4095):
        device.write(9, [count])
        wanted_us = 1e6 * count / 4096 / bench.chip.frame_hz
        assert bench.pulse_us(9) == pytest.approx(wanted_us)
        assert device.read(9, 1) == [count]
    device.all_off()
    assert device.are_off(range(16))
    assert device.read(0, 16) == [pca9685.OFF] * 16
