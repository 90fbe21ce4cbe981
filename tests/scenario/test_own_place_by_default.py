"""Where a robot has a map, nobody has to say that its own lidar tells it where it is."""

from __future__ import annotations

import json
from pathlib import Path

from tests.scenario.executive.test_resume import cut

BY_LIDAR, BY_ORACLE = "it found its place by its own lidar", "an oracle tells the robot where it is"


def header(folder: str) -> dict[str, object]:
    return json.loads(Path(folder, "run.json").read_text())


def test_in_the_kitchen_it_finds_itself_and_goes_on_and_repeats_byte_for_byte(humanoid):
    status, text = humanoid("do", "turn left", "--fast", "--run-dir", "runs/a")
    assert status == 0, text
    assert BY_LIDAR in text and BY_ORACLE not in text
    assert header("runs/a")["localisation"] == "lidar"
    assert json.loads(Path("runs/a/summary.json").read_text())["localisation"] == "lidar"
    whole = cut("runs/a", "runs/b", 0.6)
    status, text = humanoid("resume", "runs/b")
    assert status == 0, text
    assert Path("runs/b/journal.jsonl").read_bytes() == whole
    status, text = humanoid("replay", "runs/a")
    assert "Identical: it repeats byte for byte" in text, text


def test_where_it_has_no_map_an_oracle_tells_it_which_is_said_once(humanoid):
    status, text = humanoid("do", "nod", "--fast", "--world", "bench", "--run-dir", "runs/a")
    assert status == 0, text
    assert text.count(BY_ORACLE) == 1 and "--localisation lidar" in text
    assert BY_LIDAR not in text
    assert "localisation" not in header("runs/a")


def test_who_asks_for_the_oracle_has_it_and_no_words_about_it(humanoid):
    words = ("do", "nod", "--fast", "--localisation", "oracle", "--run-dir", "runs/a")
    status, text = humanoid(*words)
    assert status == 0, text
    assert BY_LIDAR not in text and BY_ORACLE not in text
    assert "localisation" not in header("runs/a")
