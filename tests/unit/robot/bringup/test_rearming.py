"""A person's word that motors may be commanded again: which run it goes to, and its answer."""

import msgspec
import pytest

from robot.bringup import private_folder, rearming
from robot.bringup.mailbox import RUN_FILE
from robot.bus.run import Run
from robot.clock import SimulatedClock
from robot.drivers.motor_bus import MotorState
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.owned.memory import OwnerMemory, Reported, Standing
from robot.errors import ConfigError, DriverError
from robot.model import description

ROBOT = description.load("juno")


class Owner:
    """One that runs, in a folder of its own, and answers while somebody waits for it."""

    def __init__(self, folder, *, refused: str = "") -> None:
        folder.mkdir()
        run = Run(folder=str(folder), sockets=str(folder), robot="juno", world="empty", owned=True)
        run.save(folder / RUN_FILE)
        self.folder, self.refused = folder, refused
        self.memory = OwnerMemory(ROBOT, folder, create=True)

    def stands(self, level: Level, *, answered: int = 0) -> None:
        zero = [0.0] * len(ROBOT.motors)
        state = MotorState(1.0, zero, zero, zero, zero, zero, watchdog=False, command_stamp_s=0.0)
        self.memory.publish(state, Standing(level, 0.0, answered))

    def answer(self) -> None:
        if (wish := self.memory.wish()) is not None:
            self.memory.say(Reported(refused=self.refused))
            self.stands(Level.OFF if self.refused else Level.OK, answered=wish)


class Clock(SimulatedClock):
    """While it is waited on, an owner works."""

    def __init__(self, owner: Owner | None = None) -> None:
        super().__init__()
        self.owner = owner

    def sleep_until(self, time_s: float) -> None:
        super().sleep_until(time_s)
        if self.owner is not None:
            self.owner.answer()


@pytest.fixture
def place(monkeypatch, tmp_path):
    """Where runs have their folders."""
    monkeypatch.setattr(private_folder, "IN_MEMORY", tmp_path)
    monkeypatch.setattr(private_folder, "LAST", tmp_path)
    monkeypatch.setattr(private_folder, "_temporary", lambda: tmp_path)
    return tmp_path


def test_an_owner_that_took_the_torque_off_is_armed_again(place):
    owner = Owner(place / f"{private_folder.PREFIX}a")
    owner.stands(Level.OFF)
    told = rearming.rearm(rearming.newest(), Clock(owner))
    assert told == rearming.Rearmed("juno", "OFF", "")


def test_why_it_is_refused_is_told(place):
    owner = Owner(place / f"{private_folder.PREFIX}a", refused="the stop is pressed: release it")
    owner.stands(Level.OFF)
    told = rearming.rearm(rearming.newest(), Clock(owner))
    assert told.refused == "the stop is pressed: release it"


def test_of_several_runs_it_is_the_one_whose_owner_acts_alone(place):
    for name, level in (("a", Level.OK), ("b", Level.DAMP), ("c", Level.OK)):
        Owner(place / f"{private_folder.PREFIX}{name}").stands(level)
    assert rearming.newest().name.endswith("b")


def test_without_a_run_whose_motors_are_owned_it_says_so(place):
    (place / f"{private_folder.PREFIX}a").mkdir()
    (place / "owner").write_text("no run's")
    with pytest.raises(ConfigError, match="bus_owner"):
        rearming.newest()


def test_an_owner_that_is_gone_does_not_answer_and_that_ends(place):
    owner = Owner(place / f"{private_folder.PREFIX}a")
    owner.stands(Level.OFF)
    clock = Clock()
    with pytest.raises(DriverError, match="does not answer"):
        rearming.rearm(owner.folder, clock)
    assert clock.now_s() < rearming.PATIENCE_S + 1.0


def test_a_run_that_ended_meanwhile_is_a_mistake_that_is_told(place):
    owner = Owner(place / f"{private_folder.PREFIX}a")
    (owner.folder / RUN_FILE).unlink()
    with pytest.raises(ConfigError):
        rearming.rearm(owner.folder, Clock())


def test_a_description_asks_for_an_owner_with_one_line(tmp_path):
    text = ROBOT.path().read_text().replace("\ndrivers: ", "\nbus_owner: {}\ndrivers: ")
    for file in ROBOT.path().parent.iterdir():
        if file.is_file():
            (tmp_path / file.name).write_bytes(file.read_bytes())
    (tmp_path / ROBOT.file).write_text(text)
    owned = description.load(str(tmp_path / ROBOT.file))
    assert owned.bus_owner is not None
    assert owned.bus_owner.stop_input == ""
    assert ROBOT.bus_owner is None
    assert msgspec.structs.replace(owned, bus_owner=None).digest() == ROBOT.digest()
