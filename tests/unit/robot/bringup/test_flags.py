"""What launcher and executives tell by flags: it needs no room, and is told once."""

import errno
import os
import resource
from pathlib import Path

import pytest

from robot.bringup import flags, mailbox
from robot.bringup.mailbox import FRONT_FILE, Front, Handle
from robot.errors import ProcessError


@pytest.fixture
def full(tmp_path, monkeypatch):
    """A folder in which from now on nothing new can be made."""
    mailbox.save(tmp_path / FRONT_FILE, Front(entry="do", options={}, deaths=1))
    made = flags.make(tmp_path)
    opens = os.open

    def refuse(path, how, *rest, **more):
        if how & os.O_CREAT and not Path(path).exists():
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return opens(path, how, *rest, **more)

    monkeypatch.setattr(os, "open", refuse)
    return made


def test_a_stop_is_left_and_heeded_once_however_full_the_place_is(full, tmp_path):
    before = (tmp_path / flags.FILE).stat()
    full.leave_stop()
    assert Handle(tmp_path, deaths=1).hear()
    assert not Handle(tmp_path, deaths=1).hear()
    after = (tmp_path / flags.FILE).stat()
    assert (before.st_size, before.st_blocks) == (after.st_size, after.st_blocks)


def test_who_hears_says_so_however_full_the_place_is(full, tmp_path):
    assert not full.hears(1)
    Handle(tmp_path, deaths=1).hear()
    assert full.hears(1)
    assert not full.hears(2)  # the one after it has yet to say so


def test_a_stop_of_another_process_is_left_until_somebody_hears(full, tmp_path):
    mailbox.leave_stop_for_next(tmp_path)
    assert full.take_stop()
    full.say_it_hears(1)
    mailbox.leave_stop_for_next(tmp_path)
    assert not full.take_stop()


def test_a_stop_needs_no_descriptor(full, monkeypatch):
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (full.file, hard))
    try:
        full.leave_stop()
        assert full.take_stop()
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))


def test_a_run_that_is_gone_is_told_nothing(tmp_path):
    mailbox.leave_stop_for_next(tmp_path)
    mailbox.save(tmp_path / FRONT_FILE, Front(entry="do", options={}, deaths=1))
    mailbox.leave_stop_for_next(tmp_path)


def test_no_room_at_the_start_is_said(tmp_path):
    with pytest.raises(ProcessError, match="no stop could be left"):
        flags.make(tmp_path / "missing")
