"""A bus that cannot be opened is told with its cure, whatever python-can's interface raises."""

import can
import pytest

from robot.clock import WallClock
from robot.drivers.motors.can.joint_map import Bus
from robot.drivers.motors.can.ports import PythonCan
from robot.errors import DriverError


@pytest.mark.parametrize(
    "bus",
    [
        Bus(channel="can0", interface="nosuch"),
        Bus(channel="x", interface="virtual"),  # it has no descriptor to wait for
        Bus(channel="nosuch0"),
        Bus(channel="/dev/zero", interface="slcan"),
        Bus(channel="\x1b[2J", interface="serial"),
    ],
    ids=lambda bus: bus.interface,
)
def test_what_cannot_be_opened_is_named_with_a_cure(bus):
    with (
        pytest.raises(DriverError, match="cannot be opened") as told,
        PythonCan({"arm": bus}, WallClock()),
    ):
        pass
    assert "arm" in str(told.value)
    assert "\n" not in str(told.value)


def test_an_interface_that_raises_what_it_likes_leaves_nothing_open(monkeypatch):
    closed: list[str] = []

    class Odd:
        socket = None

        def fileno(self):
            raise RuntimeError

        def shutdown(self):
            closed.append("odd")

    monkeypatch.setattr(can, "Bus", lambda **_: Odd())
    with (
        pytest.raises(DriverError, match="RuntimeError"),
        PythonCan({"arm": Bus(channel="can0")}, WallClock()),
    ):
        pass
    assert closed == ["odd"]
