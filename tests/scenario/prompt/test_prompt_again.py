"""What was done at a prompt and cut off goes on at a prompt."""

from pathlib import Path

from executive.journal.journal import read
from tests.scenario.executive.test_replay import anew  # noqa: F401 - a fixture
from tests.scenario.executive.test_resume import cut
from tests.scenario.test_cli import runtime  # noqa: F401 - a fixture

MISSION = "name: again\nworld: kitchen\nsteps:\n  - say hello\n  - go to the table\n  - bow\n"


def at_the_prompt(monkeypatch, *lines: str) -> None:
    file = Path("lines")
    file.write_text("\n".join(lines) + "\n")
    monkeypatch.setattr("sys.stdin", file.open())


def cut_after(event: str, step: str) -> None:
    """Leave the journal of runs/a up to an event of a step in runs/b."""
    found = next(
        e.n for e in read(Path("runs/a")) if e.event == event and e.data.get("step") == step
    )
    lines = Path("runs/a/journal.jsonl").read_bytes().splitlines(keepends=True)
    share = sum(map(len, lines[: found + 1])) / sum(map(len, lines))
    cut("runs/a", "runs/b", share)


def newest() -> list:
    (folder,) = [path for path in Path("runs").iterdir() if path.name not in ("a", "b")]
    return read(folder)


def test_resume_gives_the_prompt_back_with_what_was_open(
    runtime, humanoid, anew, monkeypatch  # noqa: F811
):  # fmt: skip
    at_the_prompt(monkeypatch, "say hello", "squat for 2 seconds, then bow", "nod")
    assert humanoid("repl", "--fast", "--run-dir", "runs/a")[0] == 0
    cut_after("step", "bow")
    anew()
    at_the_prompt(monkeypatch, "go to the table", "history")
    status, text = humanoid("resume", "runs/b")
    assert status == 0, text
    assert "going on with “squat for 2 seconds, then bow”: with a new robot" in " ".join(
        text.split()
    )
    done = [event.data["step"] for event in newest() if event.event == "done"]
    assert done == ["bow", "go to the table"]


def test_the_leftmost_is_the_one_that_it_was_when_it_was_said(
    runtime, humanoid, anew, monkeypatch  # noqa: F811
):  # fmt: skip
    at_the_prompt(monkeypatch, "say hello", "squat for 2 seconds, then look at the leftmost cup")
    assert humanoid("repl", "--fast", "--run-dir", "runs/a")[0] == 0
    cut_after("done", "squat for 2 s")
    anew()
    at_the_prompt(monkeypatch, "status")
    status, text = humanoid("resume", "runs/b")
    assert status == 0, text
    done = [event.data["step"] for event in newest() if event.event == "done"]
    assert done == ["look at the red cup"]


def test_a_mission_goes_on_from_the_copy_of_its_file(
    runtime, humanoid, anew, monkeypatch, tmp_path  # noqa: F811
):  # fmt: skip
    mission = tmp_path / "again.yaml"
    mission.write_text(MISSION)
    at_the_prompt(monkeypatch, f"run {mission}")
    assert humanoid("repl", "--fast", "--run-dir", "runs/a")[0] == 0
    cut_after("step", "go to the table")
    Path("runs/a/missions").rename("runs/b/missions")
    mission.unlink()
    anew()
    at_the_prompt(monkeypatch, "status")
    status, text = humanoid("resume", "runs/b")
    assert status == 0, text
    done = [event.data["step"] for event in newest() if event.event == "done"]
    assert done == ["go to the table", "bow"]


def test_nothing_goes_on_where_nothing_was_open(runtime, humanoid, monkeypatch):  # noqa: F811
    at_the_prompt(monkeypatch, "say hello")
    assert humanoid("repl", "--fast", "--run-dir", "runs/a")[0] == 0
    status, text = humanoid("resume", "runs/a")
    assert status == 2
    assert "nothing is left of it" in text
