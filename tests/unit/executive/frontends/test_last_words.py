"""How a command ends that did nothing: what it says to do fits what is wrong."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from executive.frontends.exit import NothingMoved, before_it_moves, ended_by
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus

STANDING = "What to do: correct that, then try again"


def told(error: BaseException, capsys) -> str:
    ended_by(error, as_json=False)
    return capsys.readouterr().err


def test_where_nothing_is_to_be_corrected_only_the_cure_is_told(capsys):
    error = ConfigError([Problem("runs/a has ended", suggestion="ask for it anew")])
    assert told(error, capsys) == "Not done:\n  runs/a has ended (ask for it anew)\n"


@pytest.mark.parametrize(
    "problems",
    [
        [Problem("no such key", "it.yaml", 3, suggestion="did you mean name?")],
        [Problem("no such option")],
        [Problem("has ended", suggestion="ask for it anew"), Problem("no such option")],
    ],
)
def test_what_is_to_be_corrected_is_told_as_such(problems, capsys):
    assert STANDING in told(ConfigError(problems), capsys)


def test_programs_get_the_cure_where_there_is_one(capsys):
    ended_by(ConfigError([Problem("it has ended", suggestion="ask anew")]), as_json=True)
    assert json.loads(capsys.readouterr().out)["suggestion"] == "ask anew"


def test_ctrl_c_before_it_moves_says_so(capsys):
    with pytest.raises(NothingMoved) as wish, before_it_moves():
        raise KeyboardInterrupt
    assert ended_by(wish.value, as_json=False) == ExitStatus.FAILED
    text = "Stopped on request.\n  nothing was started, and nothing has moved\n"
    assert capsys.readouterr().err == text
    assert told(KeyboardInterrupt(), capsys) == "Stopped on request.\n"


def test_a_current_folder_that_is_gone_is_no_mistake_of_this_software(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    gone = tmp_path / "gone"
    gone.mkdir()
    os.chdir(gone)
    gone.rmdir()
    with pytest.raises(FileNotFoundError) as error:
        Path.cwd()
    assert ended_by(error.value, as_json=False) == ExitStatus.INVALID
    text = capsys.readouterr().err
    assert text.startswith("Not done:\n  the current folder is not there any more\n")
    assert "cd" in text
