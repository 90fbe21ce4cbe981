"""Folders of runs: one each, whoever begins beside it."""

from pathlib import Path

import pytest

from executive.runs import run_folder

STAMP = "20260101-120000"


def test_its_name_sorts_by_time_and_says_what_it_was_about(tmp_path: Path):
    folder = run_folder.folder_for("Pick up the red cup!", stamp=STAMP, base=tmp_path)
    assert folder == tmp_path / f"{STAMP}-pick-up-the-red-cup"
    assert folder.is_dir()


def test_two_that_begin_in_the_same_second_have_one_each(tmp_path: Path):
    folders = [run_folder.folder_for("squat", stamp=STAMP, base=tmp_path) for _ in range(3)]
    assert len(set(folders)) == 3
    assert sorted(folders) == folders


@pytest.mark.parametrize("kind", ["file", "nowhere"])
def test_where_none_can_be_made_it_is_named_all_the_same(tmp_path: Path, kind: str):
    base = tmp_path / "runs"
    base.write_text("") if kind == "file" else base.symlink_to("/nonexistent/at/all")
    assert run_folder.folder_for("", stamp=STAMP, base=base) == base / f"{STAMP}-run"
