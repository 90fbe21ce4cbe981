"""A stranger's MJCF is compiled within bounds of memory and time, ours without that trial."""

import shutil
from importlib import resources
from pathlib import Path

import pytest

from robot.errors import DescriptionError
from robot.model import description, mjcf, trial

BODY = '<body><freejoint/><geom size=".1" mass="30"/></body>'


def model(tmp_path, inside="", top=""):
    path = tmp_path / "robot.xml"
    path.write_text(f"<mujoco>{top}<worldbody>{BODY}{inside}</worldbody></mujoco>")
    return mjcf.Source(str(path), str(tmp_path))


def test_a_small_model_passes_and_is_tried_once(tmp_path, monkeypatch):
    source = model(tmp_path)
    trial.check(source)
    monkeypatch.setattr(trial.subprocess, "run", None)
    trial.check(source)


@pytest.mark.parametrize(
    ("inside", "top", "words"),
    [
        (
            '<replicate count="3000000" offset="1 0 0"><body><geom size=".1"/></body></replicate>',
            "",
            "to compile .leave out replicate",
        ),
        ("", '<size memory="1000G"/>', "to compile .leave out replicate"),
        (
            "",
            '<option iterations="2000000000"/>',
            "iterations is 2e.09, and must be from 0 to 1000",
        ),
        ("", '<include file="nowhere.xml"/>', "does not compile"),
    ],
)
def test_a_model_without_bounds_is_refused_with_the_cure(tmp_path, inside, top, words):
    with pytest.raises(DescriptionError, match=words):
        trial.check(model(tmp_path, inside, top))


@pytest.mark.parametrize("overlay", [None, "over/overlay.xml"])
def test_a_model_named_from_where_one_stands_passes(tmp_path, monkeypatch, overlay):
    (tmp_path / "robot").mkdir()
    (tmp_path / "over").mkdir()
    model(tmp_path / "robot")
    (tmp_path / "over" / "overlay.xml").write_text("<mujoco><option timestep='.001'/></mujoco>")
    monkeypatch.chdir(tmp_path)
    trial.check(mjcf.Source("robot/robot.xml", "robot", overlay, "over" if overlay else ""))


@pytest.mark.parametrize("name", ["missing.xml", "."])
def test_what_is_no_file_is_said_at_once(tmp_path, name):
    with pytest.raises(DescriptionError, match="cannot be read"):
        trial.check(mjcf.Source(str(tmp_path / name), str(tmp_path)))


def test_our_own_models_are_not_tried_nor_are_copies_of_them(tmp_path, monkeypatch):
    monkeypatch.setattr(trial, "check", None)
    assert description.load("juno").name == "juno"
    ours = Path(str(resources.files("robot.model"))) / "juno"
    shutil.copytree(ours, tmp_path / "juno")
    assert description.load(str(tmp_path / "juno" / "juno.yaml")).name == "juno"


def test_a_model_of_ours_that_was_changed_is_tried(tmp_path, monkeypatch):
    tried = []
    monkeypatch.setattr(trial, "check", tried.append)
    ours = Path(str(resources.files("robot.model"))) / "juno"
    shutil.copytree(ours, tmp_path / "juno")
    changed = tmp_path / "juno" / "juno.xml"
    changed.write_text(changed.read_text() + "<!-- changed -->\n")
    description.load(str(tmp_path / "juno" / "juno.yaml"))
    assert [source.path for source in tried] == [str(changed)]
