"""Another distribution that is called like a package of ours is noticed, with the cure."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from executive.frontends import namesakes

OUTSIDE = {"PATH": os.environ["PATH"]}


def test_our_names_are_ours():
    assert namesakes.elsewhere() == []
    assert namesakes.owners() == []


def stranger(folder: Path, name: str) -> Path:
    """A distribution as pip installs it, with a package of that name."""
    metadata = folder / "stranger-1.dist-info"
    for one in (folder / name, metadata):
        one.mkdir()
    (folder / name / "__init__.py").write_text("")
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: stranger\nVersion: 1\n")
    (metadata / "RECORD").write_text(f"{name}/__init__.py,,\n")
    (metadata / "top_level.txt").write_text(f"{name}\n")
    return folder


@pytest.mark.parametrize("name", ["robot", "sim", "intents"])
def test_a_stranger_that_stands_before_ours_is_told_at_the_start(tmp_path, name):
    paths = [str(stranger(tmp_path, name)), str(namesakes.ROOT)]
    done = subprocess.run(
        [sys.executable, "-P", "-m", "executive", "worlds"],
        env={**OUTSIDE, "PYTHONPATH": os.pathsep.join(paths)},
        cwd=tmp_path / name, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 3
    assert "Traceback" not in done.stderr
    assert f"the package {name!r} is that of {tmp_path / name}" in done.stderr
    assert namesakes.CURE in done.stderr


def test_a_stranger_behind_ours_is_told_by_the_doctor(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(stranger(tmp_path, "robot")))
    assert namesakes.owners() == ["stranger owns the package 'robot' as well"]


def test_a_module_that_is_gone_from_ours_is_explained_by_its_namesake(tmp_path, monkeypatch):
    gone = ImportError("cannot import name 'ConfigError'", name="robot.errors")
    assert namesakes.explained(gone) == []
    assert namesakes.explained(ImportError("no", name="yaml")) == []
    monkeypatch.syspath_prepend(str(stranger(tmp_path, "robot")))
    assert namesakes.explained(gone)[-1] == "stranger owns the package 'robot' as well"


STOPPED_WHILE_LOADING = """
import os, signal, sys
from executive.__main__ import main

module = sys.argv[1]

class Stops:
    def find_spec(self, name, path=None, target=None):
        if name == module:
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Stops())
sys.argv[1:] = ["do", "squat", "--fast"]
main()
"""


@pytest.mark.parametrize(
    "module", ["executive.frontends.namesakes", "executive.frontends.cli", "executive.frontends.do"]
)
def test_ctrl_c_while_it_loads_is_a_wish_to_stop_and_no_traceback(tmp_path, module):
    done = subprocess.run(
        [sys.executable, "-P", "-c", STOPPED_WHILE_LOADING, module],
        env={**OUTSIDE, "PYTHONPATH": str(namesakes.ROOT)},
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    told = "Stopped on request.\n  nothing was started, and nothing has moved\n"
    assert (done.returncode, done.stdout, done.stderr) == (1, "", told)
