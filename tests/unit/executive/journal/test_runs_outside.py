"""Runs that were kept where somebody wanted them are found from where they were started."""

from __future__ import annotations

import json

import pytest

from executive.journal import past_runs, places
from executive.journal.journal import FILE, WALL_FILE


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    return tmp_path


def a_run(folder, wall_s):
    folder.mkdir(parents=True)
    (folder / FILE).write_text("{}\n")
    (folder / WALL_FILE).write_text(f'{{"wall_s":{wall_s}}}\n')
    return folder


def test_one_that_was_kept_elsewhere_is_the_newest_and_listed_once(here):
    inside = a_run(here / "here" / "runs" / "a", 1)
    wanted = a_run(here / "there" / "b", 2)
    for folder in (wanted, inside, wanted):
        places.remember_outside(folder)
    assert [folder.name for folder in past_runs.runs()] == ["a", "b"]
    assert past_runs.find(None) == wanted
    assert past_runs.find("b") == wanted
    assert past_runs.runs(places=places.all_places()) == [inside.relative_to(here / "here")]


def test_another_folders_are_not_taken_for_this_ones(here, monkeypatch):
    places.remember_outside(a_run(here / "there" / "b", 2))
    (here / "elsewhere").mkdir()
    monkeypatch.chdir(here / "elsewhere")
    assert past_runs.runs() == []
    assert [folder.name for folder in places.outside(anywhere=True)] == ["b"]


@pytest.mark.parametrize(
    "line",
    ["", "[", '["/a"]', "[1, 2]", '["/a", "b"]', "[" * 5000, '["/a", "/x\\u0000y"]', "\udcff"],
)
def test_what_makes_no_sense_there_is_passed_over(here, line):
    good = a_run(here / "there" / "b", 2)
    places.remember_outside(good)
    index = here / "state" / "humanoid" / places.OUTSIDE
    kept = index.read_bytes()
    index.write_bytes(line.encode(errors="surrogateescape") + b"\n" + kept)
    assert past_runs.runs() == [good]


def test_only_so_many_are_kept_and_what_is_gone_is_not_listed(here, monkeypatch):
    monkeypatch.setattr(places, "MOST_OUTSIDE", 3)
    for n in range(5):
        places.remember_outside(here / f"gone-{n}")
    lines = (here / "state" / "humanoid" / places.OUTSIDE).read_text().splitlines()
    assert [json.loads(line)[1][-1] for line in lines] == ["2", "3", "4"]
    assert past_runs.runs() == []


def test_a_home_that_is_not_there_is_not_made(tmp_path, monkeypatch):
    monkeypatch.delenv("XDG_STATE_HOME", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "no" / "home"))
    places.remember(tmp_path / "runs")
    places.remember_outside(tmp_path / "run")
    assert not (tmp_path / "no").exists()
    assert places.at_home() is None
