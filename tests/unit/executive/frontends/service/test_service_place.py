"""Where robots can be reached: by this user alone, and only while somebody is there."""

from __future__ import annotations

import os
import signal
import socket

import pytest

from executive.frontends.line_server import is_own
from executive.frontends.service import place as places
from executive.frontends.service.place import SOCKET, Place, Running, claimed
from robot.errors import ConfigError

RUNNING = Running(pid=1, run="r", private="", world="empty", robot="juno", runtime="fast")


@pytest.fixture(autouse=True)
def base(tmp_path, monkeypatch):
    """A runtime folder of this user's, and a home, both fresh."""
    runtime = tmp_path / "run"
    runtime.mkdir(mode=0o700)
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(runtime))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return runtime / "humanoid"


def test_nobody_else_enters_the_folder_of_a_robot_or_its_socket(base):
    with claimed("kitchen") as place, places.listen(place, RUNNING, backlog=1):
        assert place.folder == base / "kitchen"
        assert place.folder.stat().st_mode & 0o777 == 0o700
        assert (place.folder / SOCKET).stat().st_mode & 0o077 == 0
        assert (place.folder / places.RUNNING).stat().st_mode & 0o077 == 0
        assert places.running(place) == RUNNING
        places.connect(place).close()
        assert places.places_up() == [place]
    assert places.places_up() == []
    assert not (place.folder / SOCKET).exists()


def test_a_name_has_one_robot_at_a_time():
    with claimed("kitchen"):
        with pytest.raises(ConfigError, match="kitchen is up already"), claimed("kitchen"):
            pass
        with claimed("hall"):
            assert [one.name for one in places.places_up()] == ["hall", "kitchen"]
    with claimed("kitchen"):
        pass


def test_what_a_killed_robot_left_is_nobody(base):
    folder = base / "kitchen"
    folder.mkdir(mode=0o700, parents=True)
    base.chmod(0o700)
    left = socket.socket(socket.AF_UNIX)
    left.bind(str(folder / SOCKET))
    left.close()
    assert places.places_up() == []
    with pytest.raises(ConfigError, match="no robot called kitchen is up"):
        places.find("kitchen")
    with claimed("kitchen") as place:
        assert not (place.folder / SOCKET).exists()


def test_a_folder_that_others_may_enter_is_not_used(base, tmp_path):
    base.mkdir(mode=0o700)
    base.chmod(0o755)
    with claimed("kitchen") as place:
        assert place.folder == tmp_path / "state" / "humanoid" / "up" / "kitchen"
    open_one = Place("hall", base / "hall")
    open_one.folder.mkdir(mode=0o755)
    assert not places.is_up(open_one)
    with pytest.raises(OSError, match="others may enter"):
        places.connect(open_one)


def test_a_link_in_the_place_of_a_folder_is_not_followed(base, tmp_path):
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir(mode=0o700)
    base.mkdir(mode=0o700)
    (base / "kitchen").symlink_to(elsewhere)
    with claimed("kitchen") as place:
        assert place.folder.parent != base
    assert [*elsewhere.iterdir()] == []


def test_a_runtime_folder_of_others_is_passed_over(monkeypatch, tmp_path):
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    theirs.chmod(0o777)
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(theirs))
    assert places.bases()[-1] == tmp_path / "state" / "humanoid" / "up"
    assert theirs / "humanoid" not in places.bases()


def test_who_is_another_user_is_not_heard_and_not_told(monkeypatch):
    with claimed("kitchen") as place, places.listen(place, RUNNING, backlog=1) as listening:
        here = places.connect(place)
        there, _ = listening.accept()
        assert is_own(here) and is_own(there)
        uid = os.geteuid()
        monkeypatch.setattr(os, "geteuid", lambda: uid + 1)
        assert not is_own(here) and not is_own(there)
        there.close()
        here.close()


def test_a_path_longer_than_a_sockets_is_as_good_as_any(monkeypatch, tmp_path):
    deep = tmp_path / ("x" * 120)
    deep.mkdir(mode=0o700)
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(deep))
    with claimed("kitchen") as place, places.listen(place, RUNNING, backlog=1):
        places.connect(place).close()


def test_a_signal_while_it_is_waited_for_makes_no_connection():
    before = signal.signal(signal.SIGALRM, lambda *_: None)
    with (
        claimed("kitchen") as place,
        places.listen(place, RUNNING, backlog=0),
        places.connect(place),  # as many as there is room for
    ):
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        try:
            with pytest.raises(BlockingIOError):
                places.connect(place, wait_s=0.5)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("name", ["", "..", "a/b", "-x", "Kitchen", "x" * 33, "a\nb", "ä"])
def test_what_is_no_name_is_refused(name):
    with pytest.raises(ConfigError, match="no name for a robot"), claimed(name):
        pass


def test_without_a_name_there_must_be_one():
    with pytest.raises(ConfigError, match=r"no robot is up.*humanoid up"):
        places.find(None)
    with claimed("kitchen") as kitchen:
        assert places.find(None) == kitchen
        with claimed("hall") as hall:
            with pytest.raises(ConfigError, match="more than one robot is up: hall, kitchen"):
                places.find(None)
            assert places.find("hall") == hall
            with pytest.raises(ConfigError, match="these are: hall, kitchen"):
                places.find("cellar")


def test_what_is_written_there_by_mistake_says_nothing(base):
    with claimed("kitchen") as place:
        for junk in (b"", b"{", b'{"pid": "x"}', b"[" * 10_000):
            (place.folder / places.RUNNING).write_bytes(junk)
            (place.folder / places.RUNNING).chmod(0o600)
            assert places.running(place) is None
