"""One program at a time commands a bus, and nobody else can take that from its user."""

import hashlib
import os
import socket
from contextlib import suppress
from pathlib import Path

import pytest

from robot.drivers.motors.claim import Claim
from robot.errors import DriverError


@pytest.fixture
def state(tmp_path, monkeypatch) -> Path:
    folder = tmp_path / "state"
    folder.mkdir(mode=0o700)
    monkeypatch.setenv("XDG_STATE_HOME", str(folder))
    return folder / "humanoid"


def test_one_of_two_holds_it_until_it_lets_go(state):
    one, other = Claim(["a:0", "a:1"]), Claim(["a:1", "a:2"])
    assert one.take()
    assert not other.is_free()
    assert not other.take()
    assert Claim(["a:2"]).is_free()  # the one that did not get all holds none
    one.release()
    assert other.take()
    other.release()


def test_a_program_that_dies_lets_go(state):
    reading, writing = os.pipe()
    if not (child := os.fork()):
        os.write(writing, b"y" if Claim(["a:0"]).take() else b"n")
        os.kill(os.getpid(), 9)
    assert os.read(reading, 1) == b"y"
    os.waitpid(child, 0)
    spare = Claim(["a:0"])
    assert spare.take()
    spare.release()


def test_who_was_refused_has_it_once_the_other_lets_go_and_opens_nothing_until_then(
    state, monkeypatch
):
    one, other = Claim(["a:0", "a:1"]), Claim(["a:1", "a:2"])
    opened = []
    open_file = os.open
    monkeypatch.setattr(os, "open", lambda *args: opened.append(args) or open_file(*args))
    assert one.take()
    for _ in range(50):
        assert not other.take()
        assert not other.is_free()
    assert len(opened) <= 4
    (state / "can" / "claims.lock").unlink()  # it is not the file that counts, but who holds it
    assert not other.take()
    one.release()
    assert other.take()
    assert not Claim(["a:2"]).take()
    other.release()


def test_who_was_refused_and_leaves_leaves_nothing_open(state):
    one, other = Claim(["a:0"]), Claim(["a:0"])
    assert one.take()
    before = held(state)
    assert not other.take()
    other.release()
    assert held(state) == before
    one.release()


def held(folder: Path) -> list[str]:
    """What is open of a folder; what else this process has open is others' affair."""
    found = []
    for link in Path("/proc/self/fd").iterdir():
        with suppress(OSError):  # closed meanwhile
            found.append(str(link.readlink()))
    return sorted(one for one in found if one.startswith(str(folder)))


def test_a_name_that_others_can_bind_is_no_claim(state):
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as squatter:
        squatter.bind(f"\0humanoid-can/{hashlib.blake2b(b'a:0', digest_size=16).hexdigest()}")
        one = Claim(["a:0"])
        assert one.take()
        one.release()


def test_locks_lie_where_nobody_else_can_open_them(state):
    one = Claim(["a:0"])
    assert one.take()
    one.release()
    assert (state / "can").stat().st_mode & 0o777 == 0o700
    assert [path.stat().st_mode & 0o777 for path in (state / "can").iterdir()] == [0o600]


def test_a_folder_that_is_open_to_others_holds_no_claim(state, monkeypatch):
    state.mkdir()
    (state / "can").mkdir()
    (state / "can").chmod(0o777)
    monkeypatch.setattr(os, "geteuid", lambda: 2**31 - 5)  # of whom there is no session
    with pytest.raises(DriverError, match="folder"):
        Claim(["a:0"]).take()
