"""Who holds a folder, and who cannot keep its owner out of it."""

from __future__ import annotations

import fcntl
import os

import pytest

from executive.journal import holding, journal
from executive.runs import run_folder


def test_a_folder_is_held_by_one_until_it_lets_go(tmp_path):
    assert holding.is_held(tmp_path) is None
    held = holding.hold(tmp_path)
    assert holding.is_held(tmp_path) and journal.is_written(tmp_path)
    with pytest.raises(BlockingIOError):
        holding.hold(tmp_path)
    os.close(held)
    assert holding.is_held(tmp_path) is False
    os.close(holding.hold(tmp_path))


@pytest.mark.parametrize("kind", [fcntl.LOCK_EX, fcntl.LOCK_SH])
def test_locks_of_whoever_may_read_keep_nobody_out(tmp_path, kind):
    folder = tmp_path / "mine"
    folder.mkdir(mode=0o755)
    (folder / journal.FILE).touch(0o644)
    os.close(holding.hold(folder))
    read = [os.open(path, os.O_RDONLY) for path in (folder, folder / journal.FILE)]
    for one in read:
        fcntl.flock(one, kind)
    assert (folder / holding.LOCK).stat().st_mode & 0o777 == 0o600
    assert not journal.is_written(folder)
    run_folder.claim(folder)
    assert journal.is_written(folder)
    for one in read:
        os.close(one)


@pytest.mark.parametrize("kind", ["readable", "link", "folder"])
def test_a_lock_that_others_may_have_is_none(tmp_path, kind):
    path = tmp_path / holding.LOCK
    if kind == "link":
        (tmp_path / "other").touch(0o600)
        path.symlink_to("other")
    elif kind == "folder":
        path.mkdir()
    else:
        path.touch(0o644)
    assert holding.is_held(tmp_path) is None
    opened = os.open(tmp_path, os.O_RDONLY)
    theirs = os.open(path, os.O_RDONLY)
    fcntl.flock(theirs, fcntl.LOCK_EX)
    held = holding.hold(tmp_path, opened)
    again = os.open(tmp_path, os.O_RDONLY)
    with pytest.raises(BlockingIOError):
        holding.hold(tmp_path, again)
    for one in (opened, theirs, held, again):
        os.close(one)


def test_a_folder_in_which_nothing_can_be_made_is_held_all_the_same(tmp_path, monkeypatch):
    def full(_):
        raise OSError

    monkeypatch.setattr(holding, "_file_of", full)
    opened = os.open(tmp_path, os.O_RDONLY)
    held = holding.hold(tmp_path, opened)
    with pytest.raises(BlockingIOError):
        holding.hold(tmp_path, again := os.open(tmp_path, os.O_RDONLY))
    for one in (opened, again, held):
        os.close(one)
