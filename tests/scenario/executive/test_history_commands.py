"""`humanoid why` and `history` after runs of a puppet that ended in every way there is."""

import json
import re
from pathlib import Path

from executive.journal.journal import Journal
from robot.failures import failure
from robot.planning.requests import PickRequest
from tests.scenario.test_cli import press, runtime  # noqa: F401 - a fixture

MISSED = failure("grasp_missed", "the fingers closed on air", gap_m=0.002)


def test_a_run_that_recovered_and_one_that_did_not_are_explained(runtime, humanoid):  # noqa: F811
    runtime.planner.failures[PickRequest] = [MISSED]
    assert humanoid("do", "pick up the red cup", "--fast", "--run-dir", "runs/a")[0] == 0
    status, text = humanoid("why")
    assert status == 0
    assert text.startswith("Done after ")
    assert "(grasp_missed: gap 0.002 m)" in text
    assert "then: look again, then retry (1 of 2)" in text
    assert text.rstrip().endswith("(runs/a)")


def test_a_failed_run_is_explained_to_its_first_cause(runtime, humanoid):  # noqa: F811
    runtime.planner.failures[PickRequest] = [MISSED] * 100
    assert humanoid("do", "pick up the red cup", "--fast", "--run-dir", "runs/a")[0] == 1
    status, text = humanoid("why", "--json")
    told = json.loads(text)
    assert (status, told["status"]) == (0, "failed")
    chain = r'Because "pick up the red cup" failed (twice|\d+ times), the last time first:'
    assert any(re.fullmatch(chain, line) for line in told["lines"])
    assert any("no recovery" in line for line in told["lines"])
    assert told["lines"][-1] == "What to do: check where the object is."


def test_history_lists_every_way_to_end(runtime, humanoid, monkeypatch):  # noqa: F811
    assert "There is no run" in humanoid("history")[1]
    assert humanoid("do", "squat", "--fast", "--run-dir", "runs/1-done")[0] == 0
    runtime.lost = failure("plant_lost", "the simulation died")
    assert humanoid("do", "squat", "--fast", "--run-dir", "runs/2-lost")[0] == 3
    runtime.lost = None
    press(monkeypatch, runtime, runtime.puppet.time_s + 0.5)
    assert humanoid("do", "squat", "--fast", "--run-dir", "runs/3-stopped")[0] == 1
    killed = Path("runs/4-killed/journal.jsonl")
    killed.parent.mkdir()
    whole = Path("runs/1-done/journal.jsonl").read_bytes()
    killed.write_bytes(whole[: len(whole) // 2])
    with Journal(Path("runs/5-going")) as going:
        going.write(0.0, "run", text="squat", world="kitchen", runtime="live", seed=0)
        listed = json.loads(humanoid("history", "--json")[1])
    endings = {Path(one["folder"]).name: (one["ending"], one["code"]) for one in listed}
    assert endings == {
        "1-done": ("done", "done"),
        "2-lost": ("failed", "plant_lost"),
        "3-stopped": ("stopped", "cancelled"),
        "4-killed": ("cut off", ""),
        "5-going": ("under way", ""),
    }
    text = humanoid("history", "-n", "2")[1]
    assert "older ones" in text
    assert "Stopped after" in humanoid("why", "3-stopped")[1]
    assert "cut off" in humanoid("why", "4-k")[1]


def test_a_run_that_is_not_there_names_the_nearest(runtime, humanoid):  # noqa: F811
    status, text = humanoid("why")
    assert status == 2
    assert "there is no run in runs/" in text
    humanoid("do", "squat", "--fast", "--run-dir", "runs/squat")
    status, text = humanoid("why", "squad")
    assert (status, "did you mean 'squat'?" in text) == (2, True)
    assert "the newest is 'squat'; `humanoid history` shows all" in humanoid("why", "xyz")[1]
