"""The servo map as people write it: what is read, and what is refused with its line and a cure."""

import os
import pty

import pytest

from robot.bringup import motor_families
from robot.drivers.motors.dynamixel import load
from robot.drivers.motors.dynamixel import ports as serial_ports
from robot.drivers.motors.dynamixel.joint_map import Port
from robot.errors import ConfigError, DriverError
from tests.fakes.dynamixel_rig import ARM, arm


def test_a_map_is_read_with_what_it_leaves_out(tmp_path):
    found = arm(tmp_path)
    assert list(found.joints) == ["shoulder", "elbow", "wrist"]
    assert (found.watchdog_s, found.watchdog_steps, found.others) == (0.04, 2, "")
    assert found.ports["arm"].latency_s == 0.001
    assert motor_families.of_file(tmp_path / "dynamixel.yaml").of.map is type(found)
    for name, one in found.joints.items():
        assert one.most_steps * abs(one.nm_a_step) <= one.torque_limit_nm, name


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("port: arm, model: XM540-W270", "port: amr, model: XM540-W270", 5, "no port 'amr'"),
        ("XM540-W150", "XM540-W105", 6, "unknown model 'XM540-W105'"),
        ("id: 3", "id: 2", 7, "2 on the port 'arm' is elbow's already"),
        ("id: 3", "id: 253", 7, "id is 253, and must be from 0 to 252"),
        ("baud_hz: 3000000", "baud_hz: 250000", 3, "no bit rate of 250000"),
        ("lower_rad: -1.0", "lower_rad: 1.5", 7, "lower_rad is not below upper_rad"),
        ("gear: 1.25", "gear: 1.5", 6, "within one turn only"),
        ("torque_limit_nm: 8", "torque_limit_nm: 80", 5, "gives 10.6 N m at most"),
        ("velocity_limit_rad_s: 3,", "velocity_limit_rad_s: 6,", 5, "gives 3.14 rad/s at most"),
        ("rate_hz: 250", "rate_hz: 250\nwatchdog_s: 0.05", 2, "in steps of 20 ms"),
        ("rate_hz: 250", "rate_hz: 50", 1, "a late period is enough"),
        ("rate_hz: 250", "rate_hz: 1000", 3, "no number of ports is enough"),
    ],
)
def test_what_cannot_be_meant_is_refused_with_its_line(tmp_path, old, new, line, said):
    assert old in ARM
    with pytest.raises(ConfigError) as caught:
        arm(tmp_path, ARM.replace(old, new))
    assert said in str(caught.value)
    assert f"dynamixel.yaml:{line}:" in str(caught.value)


def test_the_load_counts_every_byte_and_what_the_adapter_keeps():
    """Of a period: currents out, one question, one answer; 4 servos at 1 Mbit/s."""
    out, asked, answer = 14 + 3 * 4, 14 + 4, 8 + 4 * (4 + 21)
    assert load.period_bytes(4) == out + asked + answer
    assert load.busy_s(4, 1_000_000) == pytest.approx(10e-6 * (out + asked + answer) + 1e-4)
    assert load.is_enough(4, 200, 1_000_000, 0.001)
    assert not load.is_enough(4, 200, 1_000_000, 0.016)  # an adapter as it is sold
    for count in range(1, 30):
        ports = load.ports_needed(count, 200, 1_000_000, 0.001)
        assert load.is_enough(-(-count // ports), 200, 1_000_000, 0.001)


def test_a_slow_latency_timer_is_refused_with_its_cure(tmp_path, monkeypatch):
    """Where the system says how long an adapter holds answers back."""
    master, slave = pty.openpty()
    device = os.ttyname(slave)
    folder = tmp_path / device.rsplit("/", 1)[1]
    folder.mkdir()
    (folder / "latency_timer").write_text("16\n")
    monkeypatch.setattr(serial_ports, "SYSFS", tmp_path)
    ports = serial_ports.SerialPorts({"arm": Port(device=device)})
    with (
        pytest.raises(DriverError, match=r"holds answers back for 16 ms.*echo 1 \| sudo tee"),
        ports,
    ):
        pass
    (folder / "latency_timer").write_text("1\n")
    with ports:
        ports.write("arm", b"x")
        assert os.read(master, 1) == b"x"
        os.write(master, b"y")
        while not (came := ports.read("arm")):
            pass
        assert came == b"y"
        os.close(master)
        with pytest.raises(DriverError, match="gone"):
            for _ in range(100):
                ports.read("arm")
                ports.write("arm", b"x")
    os.close(slave)


def test_a_port_that_is_not_there_is_an_error_with_a_cure(tmp_path):
    ports = serial_ports.SerialPorts({"arm": Port(device=str(tmp_path / "nowhere"))})
    with pytest.raises(DriverError, match=r"nowhere cannot be opened.*dialout"), ports:
        pass


def test_a_port_that_goes_away_while_it_is_opened_is_an_error_with_a_cure(tmp_path, monkeypatch):
    """Then flushing it raises what is no OSError."""
    master, slave = pty.openpty()
    device = os.ttyname(slave)

    def unplug(_: object) -> None:
        os.close(master)
        os.close(slave)

    monkeypatch.setattr(serial_ports.serial.Serial, "_update_dtr_state", lambda _: None)
    monkeypatch.setattr(serial_ports.serial.Serial, "_update_rts_state", unplug)
    with (
        pytest.raises(DriverError, match=r"cannot be opened.*dialout"),
        serial_ports.SerialPorts({"arm": Port(device=device)}),
    ):
        pass
