"""A folder that may not be written is refused before anything starts, with what to do."""

import errno
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from executive.frontends import launching
from executive.frontends.service import detached
from executive.frontends.service.options import Up
from executive.runs import run_folder
from robot.errors import ConfigError

NOBODY = 65534


@contextmanager
def an_ordinary_user() -> Iterator[None]:
    """Whom the mode of a folder binds: root is bound by none."""
    me = os.geteuid()
    if me == 0:
        os.seteuid(NOBODY)
    try:
        yield
    finally:
        os.seteuid(me)


@pytest.fixture
def barred(monkeypatch) -> Iterator[Path]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o555)
        monkeypatch.chdir(folder)
        monkeypatch.setenv("HOME", str(folder))
        monkeypatch.delenv("XDG_STATE_HOME", raising=False)
        with an_ordinary_user():
            yield folder
        folder.chmod(0o700)
        monkeypatch.undo()


@pytest.mark.parametrize(
    "begin",
    [
        lambda: launching.folder_for(None, "nod"),
        lambda: launching.new_folder("eval"),
        lambda: detached.up(Up(name="barred", detach=True)),
    ],
)
def test_nothing_is_begun_in_a_folder_that_cannot_be_written(barred, begin):
    with pytest.raises(ConfigError) as refused:
        begin()
    (problem,) = refused.value.problems
    assert str(barred) in problem.message
    assert "cannot be written" in problem.message
    assert "--run-dir" in problem.suggestion
    assert not list(barred.iterdir())


def test_a_disk_without_room_stops_nobody(tmp_path, monkeypatch):
    def full(*_args, **_more):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "mkdir", full)
    assert run_folder.folder_for("nod", stamp="20260101-120000", base=tmp_path).parent == tmp_path


def test_a_file_system_that_is_read_only_is_refused_too(tmp_path, monkeypatch):
    def read_only(*_args, **_more):
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr(Path, "mkdir", read_only)
    with pytest.raises(ConfigError, match="Read-only file system"):
        run_folder.folder_for("nod", stamp="20260101-120000", base=tmp_path)
