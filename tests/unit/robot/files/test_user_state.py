"""Where what is a user's is kept."""

from __future__ import annotations

from pathlib import Path

import pytest

from executive.frontends.prompt.terminal import history_at_home
from executive.frontends.service.place import bases
from robot.files.user_state import user_state_folder


def test_it_is_where_the_user_wants_state(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert user_state_folder() == tmp_path / "humanoid"
    assert history_at_home() == tmp_path / "humanoid/history"
    assert bases()[-1] == tmp_path / "humanoid/up"


@pytest.mark.parametrize("said", ["", "relative/path"])
def test_it_is_at_home_when_nothing_of_use_is_said(
    said: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
):
    monkeypatch.setenv("XDG_STATE_HOME", said)
    monkeypatch.setenv("HOME", str(tmp_path))
    assert user_state_folder() == tmp_path / ".local/state/humanoid"
    assert history_at_home() == tmp_path / ".local/state/humanoid/history"


def test_a_home_that_may_not_be_looked_at_is_none(monkeypatch: pytest.MonkeyPatch):
    def refused(*_args: object, **_options: object):
        raise PermissionError(13, "Permission denied")

    monkeypatch.delenv("XDG_STATE_HOME", raising=False)
    monkeypatch.setenv("HOME", "/closed/home")
    monkeypatch.setattr("os.stat", refused)
    assert user_state_folder() is None


@pytest.mark.parametrize("home", ["/no/such/home", "relative"])
def test_a_home_that_is_not_there_is_none(
    home: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
):
    monkeypatch.delenv("XDG_STATE_HOME", raising=False)
    monkeypatch.setenv("HOME", home)
    monkeypatch.chdir(tmp_path)
    assert user_state_folder() is None
    assert history_at_home() is None
    assert not [base for base in bases() if base.is_relative_to(home)]
