"""What the launcher says to the executive: whole, in place, and however full the disk is."""

import errno
import os
from pathlib import Path

import pytest

from robot.bringup import mailbox
from robot.bringup.mailbox import FRONT_FILE, ROOM_BYTES, STATE_FILE, Front, Handle, State
from robot.errors import ProcessError


def front(deaths: int, text: str = "wave") -> Front:
    return Front(entry="do", options={"text": text}, deaths=deaths)


def test_what_is_said_again_takes_no_more_room(tmp_path: Path) -> None:
    path = tmp_path / FRONT_FILE
    mailbox.save(path, front(0))
    first = path.stat()
    mailbox.save(path, front(1))
    again = path.stat()
    assert mailbox.read(path, Front) == front(1)
    assert (first.st_ino, first.st_size, first.st_blocks) == (
        again.st_ino, again.st_size, again.st_blocks,
    )  # fmt: skip
    assert [one.name for one in tmp_path.iterdir()] == [FRONT_FILE]


@pytest.mark.parametrize("letters", [0, ROOM_BYTES, 3 * ROOM_BYTES])
def test_what_is_longer_than_usual_is_read_whole_and_a_shorter_one_after_it(
    tmp_path: Path, letters: int
) -> None:
    path = tmp_path / FRONT_FILE
    for said in (front(0, "x" * letters), front(1, "y"), front(2, "z" * letters)):
        mailbox.save(path, said)
        assert mailbox.read(path, Front) == said


def test_what_is_not_there_or_not_whole_is_nothing(tmp_path: Path) -> None:
    path = tmp_path / STATE_FILE
    assert mailbox.read(path, State) is None
    mailbox.save(path, State(pids={"plant": 1}))
    handle = Handle(tmp_path)
    assert handle.pid("plant") == 1
    whole = path.read_bytes()
    path.write_bytes(whole.replace(b"1", b"2", 1))
    assert mailbox.read(path, State) is None
    assert handle.pid("plant") == 1  # as it was told last
    path.write_bytes(b"")
    assert mailbox.read(path, State) is None


def test_no_room_is_said_with_the_place_and_a_cure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "open", full)
    with pytest.raises(ProcessError, match=r"front\.json cannot be written.*make room"):
        mailbox.save(tmp_path / FRONT_FILE, front(0))
