"""The shipped missions in physics: each does what it says, and the world is as it expects."""

from __future__ import annotations

import json

import pytest

from executive.frontends.missions import run as mission_run
from executive.frontends.missions.options import Run
from executive.missions.load import FOLDER, shipped
from tests.fakes.missions import check

LONG = ("bring", "tidy", "greet", "patrol")
REST = ("bring", "tidy", "patrol", "inspect")
"""Errands of a minute: what they are made of, skills_in_physics and the others show one by one."""


def run(name: str, folder, first: str = "") -> int:
    return mission_run.run(Run(file=name, first=first, fast=True, run_dir=folder, as_json=True))


def events(folder) -> list[dict]:
    return [json.loads(line) for line in (folder / "journal.jsonl").read_text().splitlines()]


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(
            path.stem,
            marks=[
                *([pytest.mark.slow] if path.stem in LONG else []),
                *([pytest.mark.rest] if path.stem in REST else []),
            ],
        )
        for path in shipped()
    ],
)
def test_a_shipped_mission_does_what_it_says(name, tmp_path, capsys):
    folder = tmp_path / "run"
    assert run(name, folder) == 0, capsys.readouterr().out
    summary = json.loads((folder / "summary.json").read_text())
    wanted = check(FOLDER / f"{name}.yaml").mission.record.expect
    assert len(summary["expected"]) >= len(wanted)
    assert all(item["so"] for item in summary["expected"])
    faults = check(FOLDER / f"{name}.yaml").faults
    assert sum(event["event"] == "fault" for event in events(folder)) == len(faults)


def test_a_mission_begins_at_a_step_and_fails_where_the_world_is_not_as_expected(tmp_path, capsys):
    path = tmp_path / "it.yaml"
    path.write_text(
        "name: it\nsteps:\n  - wait: 500\n  - say: one\n  - say: two\nexpect:\n"
        "  - holding: red cup\n  - not: {holding: blue cup}\n"
    )
    folder = tmp_path / "run"
    assert run(str(path), folder, first="3") == 1
    said = [event["text"] for event in events(folder) if event["event"] == "said"]
    assert said == ["two"]
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["code"] == "not_as_expected"
    assert [(item["check"], item["so"]) for item in summary["expected"]] == [
        ("the red cup is held", False),
        ("not: the blue cup is held", True),
    ]
    assert summary["expected"][0]["found"] == "the robot holds nothing"
