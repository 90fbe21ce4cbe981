"""The contact of an emergency stop: all that is not plainly released is pressed."""

import pytest

from robot.drivers.stop_input import StopInput
from robot.errors import DeviceNotAllowed, DriverError


@pytest.fixture
def line(tmp_path):
    """The file of a contact, and it opened."""
    path = tmp_path / "value"
    path.write_text("1\n")
    with StopInput(path, is_emulated=True) as contact:
        contact.open()
        yield path, contact


@pytest.mark.parametrize("text", ["1", "1\n", " 1 \n"])
def test_a_one_is_released(line, text):
    path, contact = line
    path.write_text(text)
    assert not contact.is_pressed()


@pytest.mark.parametrize("text", ["0\n", "", "\n", "11\n", "one", "1 0\n", "\0", "2\n", "-1\n"])
def test_everything_else_is_pressed(line, text):
    path, contact = line
    path.write_text(text)
    assert contact.is_pressed()


def test_it_is_looked_at_anew_each_time(line):
    path, contact = line
    for text, is_pressed in [("0\n", True), ("1\n", False), ("0\n", True)]:
        path.write_text(text)
        assert contact.is_pressed() == is_pressed


def test_one_that_is_closed_is_pressed(line):
    _, contact = line
    contact.close()
    contact.close()
    assert contact.is_pressed()


def test_one_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(DriverError, match="stop input"):
        StopInput(tmp_path / "none", is_emulated=True).open()


def test_a_device_that_the_user_did_not_name_is_not_opened(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    with pytest.raises(DeviceNotAllowed, match="gpio"):
        StopInput("/sys/class/gpio/gpio17/value", is_emulated=False)
