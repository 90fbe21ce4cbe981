"""Deterministic lines, times of day kept apart, and a full disk that stops nobody."""

import errno
import json
import os
import re
from pathlib import Path

import pytest

import executive
from executive.journal.files import LineFile
from executive.journal.journal import Journal


def play(folder, wall):
    ticks = iter(wall)
    with Journal(folder, wall_s=lambda: next(ticks)) as journal:
        journal.write(0.05, "step", step="walk", data={"b": 1, "a": 2.5})
        journal.write(0.1, "done", step="walk")
    return (folder / "journal.jsonl").read_bytes()


def test_content_does_not_depend_on_the_wall_clock(tmp_path):
    first = play(tmp_path / "a", [10.0, 11.0])
    second = play(tmp_path / "b", [99.0, 123.0])
    assert first == second
    lines = [json.loads(line) for line in first.splitlines()]
    assert [(line["n"], line["t_s"], line["event"]) for line in lines] == [
        (0, 0.05, "step"),
        (1, 0.1, "done"),
    ]
    wall = (tmp_path / "b" / "wall.jsonl").read_text().splitlines()
    assert [json.loads(line) for line in wall] == [
        {"n": 0, "wall_s": 99.0},
        {"n": 1, "wall_s": 123.0},
    ]


def test_a_line_is_on_the_disk_when_write_returns(tmp_path):
    journal = Journal(tmp_path)
    journal.write(0.0, "step", step="x")
    assert (tmp_path / "journal.jsonl").read_bytes().endswith(b"\n")
    journal.close()
    journal.close()


class Disk:
    """os.write with a number of bytes that still fit."""

    def __init__(self, room):
        self.room = room

    def write(self, file, data):
        if self.room <= 0:
            raise OSError(errno.ENOSPC, "No space left on device")
        count = self.true_write(file, bytes(data[: self.room]))
        self.room -= count
        return count

    true_write = staticmethod(os.write)


@pytest.mark.parametrize("room", [0, 1, 30, 57, 58, 120])
def test_a_full_disk_loses_nothing_that_fits_the_ring(tmp_path, monkeypatch, room):
    disk = Disk(room)
    monkeypatch.setattr(os, "write", disk.write)
    journal = Journal(tmp_path)
    warnings = []
    journal.listen(lambda event: warnings.append(event) if event.event == "warning" else None)
    for n in range(8):
        journal.write(n * 0.05, "step", step=f"step {n}")
    assert len(warnings) == 1
    assert "No space left" in journal.problem
    disk.room = 10_000
    journal.write(1.0, "done", step="all")
    lines = (tmp_path / "journal.jsonl").read_text().splitlines()
    assert [json.loads(line)["n"] for line in lines] == list(range(9))
    assert len(warnings) == 2


def test_the_oldest_are_dropped_when_the_ring_is_full(tmp_path, monkeypatch):
    disk = Disk(10)  # half of the first line gets out
    monkeypatch.setattr(os, "write", disk.write)
    lines = LineFile(tmp_path / "x.jsonl", capacity=5)
    for n in range(20):
        lines.append(json.dumps({"number": n}).encode())
    assert lines.waiting == 5
    assert lines.dropped == 15
    disk.room = 10_000
    lines.append(b'{"number": 20}')
    found = [json.loads(line)["number"] for line in (tmp_path / "x.jsonl").read_text().splitlines()]
    assert found == [0, 17, 18, 19, 20]


def test_a_folder_that_cannot_be_made_is_a_warning_not_an_error(tmp_path):
    (tmp_path / "file").write_text("")
    journal = Journal(tmp_path / "file" / "run")
    heard = []
    journal.listen(heard.append)
    journal.write(0.0, "step", step="x")
    assert [event.event for event in heard] == ["step", "warning"]


def test_a_wall_clock_that_steps_back_changes_nothing(tmp_path):
    assert play(tmp_path / "a", [1e9, 1e9 - 3600.0]) == play(tmp_path / "b", [10.0, 11.0])
    wall = [
        json.loads(line)["wall_s"]
        for line in (tmp_path / "a" / "wall.jsonl").read_text().splitlines()
    ]
    assert wall == [1e9, 1e9 - 3600.0]


def test_the_time_of_day_is_read_by_the_command_line_only():
    """Everything else runs on clocks that never step (`robot.clock`)."""
    root = Path(executive.__file__).parent.parent
    readers = {
        str(path.relative_to(root))
        for package in ("executive", "intents", "robot", "sim")
        for path in (root / package).rglob("*.py")
        if re.search(r"datetime\.now|datetime\.today|time\.time\(", path.read_text())
    }
    assert all(
        name.startswith("executive/frontends/") or name == "executive/evaluation/work.py"
        for name in readers
    ), readers
