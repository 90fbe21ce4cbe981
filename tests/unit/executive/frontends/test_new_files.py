"""What a command reads is not written over, by whatever name."""

from pathlib import Path

import pytest

from executive.frontends.new_files import put, refuse_inputs, write
from robot.errors import ConfigError


@pytest.fixture(autouse=True)
def _files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("log").write_text("log")
    Path("link").symlink_to("log")
    Path("hard").hardlink_to("log")
    Path("folder").mkdir()


@pytest.mark.parametrize("name", ["log", "./log", "folder/../log", "link", "hard"])
def test_an_input_is_no_output(name):
    with pytest.raises(ConfigError, match="is read by this very command"):
        refuse_inputs([None, Path("other"), Path(name)], [None, Path("log")])


@pytest.mark.parametrize("name", ["new", "./new", "folder/../new"])
def test_two_outputs_are_two_files(name):
    with pytest.raises(ConfigError, match="is written twice"):
        refuse_inputs([Path("new"), Path(name)], [Path("log")])


def test_others_are_nobodys_business():
    refuse_inputs([Path("new"), Path("folder/log"), None], [Path("log"), Path("gone"), None])
    refuse_inputs([Path("n" * 5000)], [Path("log")])


@pytest.mark.parametrize("begin", [
    lambda: put(Path("log/new"), "text"), lambda: write(Path("log/new"), b"", run=Path("run")),
])  # fmt: skip
def test_where_nothing_can_be_written_another_place_is_the_cure(begin):
    with pytest.raises(ConfigError, match="cannot be written") as refused:
        begin()
    assert "another place" in (refused.value.problems[0].suggestion or "")
