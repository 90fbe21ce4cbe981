"""Removing old runs: those that are asked for, and nothing else whatever stands in their place."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from executive.frontends.output import Screen
from executive.frontends.past_runs import printing, pruning
from executive.journal import holding, past_runs, places
from executive.journal.journal import FILE, WALL_FILE
from robot.errors import ConfigError
from robot.exit_status import ExitStatus

DAY_S = 86_400
NOW_S = 1_800_000_000.0


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    folder = tmp_path / "here"
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.setattr(pruning.time, "time", lambda: NOW_S)
    return folder


def run(name: str, *, days_ago: float = 0.0, base: Path = Path("runs")) -> Path:
    folder = base / name
    folder.mkdir(parents=True)
    (folder / FILE).write_text("")
    (folder / WALL_FILE).write_text(f'{{"n":0,"wall_s":{NOW_S - days_ago * DAY_S:.3f}}}\n')
    (folder / "logs").mkdir()
    (folder / "logs" / "plant.log").write_text("x" * 1000)
    return folder


def prune(**how):
    said = {"keep": None, "older_than_days": None, "everywhere": False, "yes": True}
    return pruning.prune(**{**said, "dry_run": False, **how})


def names() -> list[str]:
    return [folder.name for folder in past_runs.runs()]


def test_the_newest_stay():
    for age in range(5):
        run(f"run-{age}", days_ago=age)
    assert prune(keep=2) == ExitStatus.DONE
    assert names() == ["run-1", "run-0"]


def test_the_young_stay_and_so_do_the_newest():
    for age in range(5):
        run(f"run-{age}", days_ago=age)
    assert prune(older_than_days=2.5, keep=4) == ExitStatus.DONE
    assert names() == ["run-3", "run-2", "run-1", "run-0"]
    assert prune(older_than_days=1.5) == ExitStatus.DONE
    assert names() == ["run-1", "run-0"]


def test_a_run_that_is_nested_as_none_is_keeps_no_other_one(capsys, monkeypatch):
    """Deeper than a path may be long, and than Python calls itself."""
    deep = run("deep", days_ago=9)
    run("b", days_ago=2)
    top = Path.cwd()
    monkeypatch.chdir(deep)
    for _ in range(1200):
        Path("down").mkdir()
        os.chdir("down")
    os.chdir(top)
    try:
        assert prune(keep=0, dry_run=True) == ExitStatus.DONE
        assert prune(keep=0) == ExitStatus.FAILED
        assert deep.is_dir() and "b" not in names()
        assert "deep cannot be removed" in capsys.readouterr().err
    finally:  # pytest could not, either
        subprocess.run(["rm", "-r", str(deep)], check=True)


def test_nothing_goes_unless_it_is_said_which_and_by_whom(monkeypatch):
    run("a")
    with pytest.raises(ConfigError, match="which runs may go"):
        prune()
    monkeypatch.setattr("sys.stdin", open(os.devnull))  # noqa: PTH123, SIM115
    with pytest.raises(ConfigError, match=r"nobody is there.*--yes"):
        prune(keep=0, yes=False)
    assert prune(keep=0, dry_run=True) == ExitStatus.DONE
    assert names() == ["a"]


def test_a_run_that_is_under_way_stays(capsys):
    folder = run("a")
    lock = holding.hold(folder)
    assert prune(keep=0) == ExitStatus.DONE
    assert names() == ["a"]
    assert "under way" in capsys.readouterr().err
    os.close(lock)
    prune(keep=0)
    assert names() == []


def test_a_link_is_neither_followed_nor_removed(tmp_path, capsys):
    elsewhere = run("elsewhere", base=tmp_path)
    Path("runs").mkdir()
    Path("runs/link").symlink_to(elsewhere)
    assert prune(keep=0) == ExitStatus.DONE
    assert (elsewhere / FILE).exists()
    assert Path("runs/link").is_symlink()
    Path("runs/link").unlink()
    Path("runs").rmdir()
    Path("runs").symlink_to(tmp_path)
    assert prune(keep=0) == ExitStatus.DONE
    assert (elsewhere / FILE).exists() and not pruning.removed(Path("runs/elsewhere"))
    assert "through a link" in capsys.readouterr().err
    Path("runs").unlink()
    inner = run("b")
    (inner / "kept").symlink_to(elsewhere)
    prune(keep=0)
    assert not inner.exists() and (elsewhere / FILE).exists()


def test_nothing_is_removed_where_others_could_put_another_folder_in_its_place(here, capsys):
    folder = run("a")
    here.chmod(0o777)
    assert prune(keep=0) == ExitStatus.DONE
    assert not pruning.removed(folder)
    assert names() == ["a"] and not (folder / holding.LOCK).exists()
    assert "can be changed by every user" in capsys.readouterr().err
    here.chmod(0o1777)
    prune(keep=0)
    assert names() == []


@pytest.mark.skipif(os.geteuid() != 0, reason="takes root to give a file away")
def test_another_users_run_stays(capsys):
    folder = run("a")
    os.chown(folder, 12345, 12345)
    assert prune(keep=0) == ExitStatus.DONE
    assert names() == ["a"]
    assert "another user" in capsys.readouterr().err


def test_what_is_no_run_is_not_looked_at():
    notes = Path("runs/notes")
    notes.mkdir(parents=True)
    (notes / "mine.txt").write_text("kept")
    assert prune(keep=0) == ExitStatus.DONE
    assert (notes / "mine.txt").exists()


# --- runs of every folder ---


def test_history_is_of_this_folder_or_of_every_one(tmp_path, capsys):
    run("mine")
    there = tmp_path / "there" / "runs"
    run("other", base=there)
    places.remember(there)
    printing.history(count=10, as_json=False)
    assert "other" not in capsys.readouterr().out
    printing.history(count=10, as_json=True, everywhere=True)
    out = capsys.readouterr().out
    assert "other" in out and "mine" in out


@pytest.mark.parametrize("columns", [20, 40, 71, 72, 200])
def test_history_says_how_a_run_ended_and_what_it_was_about_however_narrow(
    columns, capsys, monkeypatch
):
    folder = run("20260101-120000-walk")
    (folder / "run.json").write_text('{"text": "go home", "runtime": "live"}')
    (folder / "summary.json").write_text('{"code": "no_path", "simulated_s": 12.3}')
    monkeypatch.setattr(printing, "table_screen", lambda: Screen(width=columns))
    printing.history(count=10, as_json=False)
    out = capsys.readouterr().out
    assert all(words in out for words in ("20260101-120000", "12 s", "live", "no_path", "go home"))


def test_a_place_is_noted_once_and_forgotten_when_it_is_gone(tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    for place in (first, second, first):
        place.mkdir(exist_ok=True)
        places.remember(place)
    assert {first, second} <= set(places.everywhere())
    index = tmp_path / "state" / "humanoid" / places.INDEX
    assert index.read_text().splitlines() == [str(first), str(second)]
    first.rmdir()
    places.remember(tmp_path)
    assert index.read_text().splitlines() == [str(second), str(tmp_path)]


@pytest.mark.parametrize("junk", [b"", b"\xff\n", b"relative\n\n../x\n", b"/not/there\n", b"\x00"])
def test_an_index_that_is_none_adds_nothing(tmp_path, junk):
    index = tmp_path / "state" / "humanoid" / places.INDEX
    index.parent.mkdir(parents=True)
    index.write_bytes(junk)
    run("mine")
    assert [folder.name for folder in past_runs.runs(places=places.everywhere())] == ["mine"]


def test_one_run_is_told_of_as_one(capsys):
    run("run-0")
    assert prune(keep=0) == ExitStatus.DONE
    told = capsys.readouterr().out
    assert "1 of 1 run," in told and "Removed: 1 run." in told


@pytest.mark.parametrize("content", ["", "?\n"])
def test_of_a_journal_that_holds_nothing_no_answer_is_well(content):
    """Among the commands on past runs `why` tells the same as `resume` and `replay`: status 2."""
    (run("run-0") / FILE).write_text(content)
    assert printing.why("run-0", as_json=False) == ExitStatus.INVALID
