"""A run folder may be a stranger's: it asks for a closed set of things, and stays inside itself."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from executive.frontends import launching
from executive.journal import past_runs
from executive.journal.journal import Event
from executive.missions.check import Options
from executive.runs import mission_assignment, run_folder
from executive.runs.again import recording, requests
from executive.runs.mission_assignment import keep, origin
from robot.errors import ConfigError, Problem
from tests.fakes.missions import check, known

WHERE = known("empty", robot="juno")
SQUAT = b'{"n":0,"t_s":0.0,"event":"run","text":"squat","world":"empty","seed":3}\n'
SUBMIT: dict[str, Any] = {"request": "submit", "text": "x", "urgent": False, "limits": {},
                          "origin": {"goals": []}}  # fmt: skip


def event(**data: Any) -> Event:
    return Event(1, 0.1, "request", data)


@pytest.mark.parametrize(
    "data",
    [
        {"request": "__reduce_ex__", "protocol": 2},
        {"request": "tick", "now_s": 1.0},
        {"request": "on_request"},
        {"request": "abandon_all"},
        {"request": "pause"},
        {"request": "pause", "why": 3},
        {"request": "pause", "why": "x", "more": 1},
        {"request": "cancel", "number": "1", "why": "x"},
        {"request": "move", "number": 1, "place": None},
        {"request": "answer", "text": "perhaps"},
        {"request": ["pause"]},
        {"request": None},
        {},
        {**SUBMIT, "urgent": "no"},
        {**SUBMIT, "limits": {"speed_m_s": "fast"}},
        {**SUBMIT, "origin": []},
    ],
)
def test_what_is_not_of_the_set_is_refused(data):
    with pytest.raises(ConfigError, match=r"event 1 of the journal is no request"):
        requests.read(event(**data))


def test_what_an_executive_writes_is_of_the_set():
    assert requests.read(event(**SUBMIT, job=1)) == requests.Submit(
        text="x", urgent=False, limits=requests.Limits(), origin={"goals": []}
    )
    assert requests.read(event(request="pause", why="tea")) == requests.Pause(why="tea")
    assert requests.read(event(request="abandon")) == requests.Abandon()


@pytest.mark.parametrize(
    "made_from",
    [
        {"goals": [], "held": [[1]]},
        {"goals": [], "done": 3},
        {"goals": [], "done": [["x"]]},
        {"goals": [], "whereabouts": "here"},
        {"goals": "all"},
        {"goals": [{"goal": "nothing"}]},
        {"mission": ["x"]},
        {"mission": "x", "params": {"a": [1]}},
        {"mission": "x", "kept": 1},
        {},
    ],
)
def test_a_job_that_is_made_from_nonsense_is_refused(tmp_path, made_from):
    with pytest.raises(ConfigError):
        recording.assigned(event(**{**SUBMIT, "origin": made_from}), tmp_path, WHERE)


# --- files outside ---


@pytest.fixture
def kept(tmp_path: Path) -> tuple[Path, dict[str, Any]]:
    """A run's folder with the copy of a mission, and what its journal says of that."""
    mission = tmp_path / "mission.yaml"
    mission.write_text("name: m\nworld: empty\nsteps:\n  - wave\n")
    checked = check(mission)
    folder = tmp_path / "run"
    keep(checked, folder)
    made_from = origin(checked, Options(), path=str(mission))
    mission.unlink()
    return folder, made_from


def test_a_copy_inside_the_folder_is_taken(kept):
    folder, made_from = kept
    assert mission_assignment.restore(made_from, folder, WHERE).text == "m"


@pytest.mark.parametrize("lead", ["up", "root", "link"])
def test_a_copy_outside_the_folder_is_not_read_and_not_shown(kept, tmp_path, lead):
    folder, made_from = kept
    secret = tmp_path / "secret.yaml"
    secret.write_text("top secret: [1\n")
    (folder / "missions" / "link.yaml").symlink_to(secret)
    way = {"up": "../secret.yaml", "root": str(secret), "link": "missions/link.yaml"}[lead]
    for named in ({"kept": way}, {"kept": "", "mission": str(secret)}):
        data = {**SUBMIT, "origin": {**made_from, **named}}
        with pytest.raises(ConfigError) as error:
            recording.assigned(event(**data), folder, WHERE)
        assert "top secret" not in str(error.value)


def test_what_is_wrong_with_a_file_elsewhere_is_not_told(tmp_path):
    inside = Problem("line of it", str(tmp_path / "a"))
    with pytest.raises(ConfigError) as error, recording.discreet(tmp_path):
        raise ConfigError([inside, Problem("root:x:0:0", "/etc/passwd", 1, 2)])
    assert error.value.problems[0] == inside
    assert "root:x" not in str(error.value)
    assert "/etc/passwd: this is not what the run was recorded with" in str(error.value)


def test_only_what_lies_inside_is_carried_over(kept, tmp_path):
    folder, made_from = kept
    (tmp_path / "secret.yaml").write_text("x")
    (folder / "missions" / "link.yaml").symlink_to(tmp_path / "secret.yaml")
    (folder / "missions" / "zero.yaml").symlink_to("/dev/zero")
    os.mkfifo(folder / "missions" / "pipe.yaml")
    run_folder.carry_missions_over(folder, tmp_path / "new")
    files = {path.name for path in (tmp_path / "new").rglob("*") if path.is_file()}
    assert files == {Path(made_from["kept"]).name}


# --- whose folder it is ---


HOLDS = """
import sys
from pathlib import Path
from executive.runs import run_folder
run_folder.claim(Path(sys.argv[1]))
print("held", flush=True)
sys.stdin.read()
"""


def test_a_folder_is_one_runs_at_a_time(tmp_path):
    folder = tmp_path / "run"
    command = [sys.executable, "-c", HOLDS, str(folder)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as other:
        assert other.stdin and other.stdout
        assert other.stdout.readline() == b"held\n"
        with pytest.raises(ConfigError, match="used by another run just now"):
            run_folder.claim(folder)
        other.stdin.close()
    run_folder.claim(folder)
    run_folder.claim(folder)  # it is this process's
    assert folder.stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize("kind", ["file", "pipe", "dangling"])
def test_what_is_no_folder_is_refused(tmp_path, kind):
    path = tmp_path / "run"
    match kind:
        case "file":
            path.write_text("")
        case "pipe":
            os.mkfifo(path)
        case _:
            path.symlink_to(tmp_path / "nowhere")
    with pytest.raises(ConfigError, match=r"no folder|cannot be used"):
        run_folder.claim(path)


def test_a_folder_that_is_to_lie_in_a_file_is_refused_where_somebody_named_it(tmp_path):
    (tmp_path / "file").write_text("words")
    run_folder.claim(tmp_path / "file" / "run", wanted=False)
    with pytest.raises(ConfigError, match="is no folder"):
        run_folder.claim(tmp_path / "file" / "run")


def test_a_folder_that_cannot_be_made_is_refused_where_somebody_named_it(tmp_path):
    folder = tmp_path / ("x" * 300)
    run_folder.claim(folder, wanted=False)
    with pytest.raises(ConfigError, match="too long"):
        run_folder.claim(folder)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a folder away")
def test_a_folder_of_another_user_is_refused(tmp_path):
    os.chown(tmp_path, 65534, 65534)
    with pytest.raises(ConfigError, match="another user"):
        run_folder.claim(tmp_path)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a folder away")
@pytest.mark.parametrize("link", [False, True])
def test_a_folder_of_runs_that_another_user_has_made_is_refused_with_the_cure(tmp_path, link):
    base = tmp_path / "runs"
    if link:
        base.symlink_to(tmp_path)
    else:
        base.mkdir()
    os.chown(base, 65534, 65534, follow_symlinks=False)
    with pytest.raises(ConfigError, match="belongs to another user") as refused:
        run_folder.folder_for("squat", stamp="20260101-120000", base=base)
    assert "--run-dir" in (refused.value.problems[0].suggestion or "")
    assert [path.name for path in tmp_path.iterdir()] == ["runs"]
    assert link or not list(base.iterdir())


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a folder away")
@pytest.mark.parametrize(
    "by", ["its parent", "a link on the way", "the parent of what a link names"]
)
def test_a_folder_that_another_user_could_exchange_is_refused_and_nothing_made(tmp_path, by):
    theirs, mine = tmp_path / "theirs", tmp_path / "mine"
    (theirs / "deep").mkdir(parents=True)
    mine.mkdir()
    os.chown(theirs, 65534, 65534)
    way = {
        "its parent": theirs / "deep",
        "a link on the way": tmp_path / "link",
        "the parent of what a link names": mine / "link",
    }[by]
    if by == "a link on the way":
        way.symlink_to(mine)
        os.chown(way, 65534, 65534, follow_symlinks=False)
    elif way != theirs / "deep":
        way.symlink_to(theirs / "deep")
    before = sorted(tmp_path.rglob("*"))
    for begin in (
        lambda: run_folder.folder_for("squat", stamp="20260101-120000", base=way / "runs"),
        lambda: run_folder.claim(way / "run"),
        lambda: run_folder.claim(way / "run", wanted=False),
    ):
        with pytest.raises(ConfigError, match="another user, who could exchange"):
            begin()
    assert sorted(tmp_path.rglob("*")) == before


def test_a_folder_whose_parent_every_user_can_write_into_is_refused_unless_it_is_sticky(tmp_path):
    shared = tmp_path / "shared"
    (shared / "runs").mkdir(parents=True)
    shared.chmod(0o777)
    with pytest.raises(ConfigError, match="every user"):
        run_folder.claim(shared / "runs" / "one")
    shared.chmod(0o1777)
    run_folder.claim(shared / "runs" / "one")


def test_a_folder_of_runs_in_which_every_user_can_exchange_them_is_refused(tmp_path):
    base = tmp_path / "runs"
    base.mkdir()
    base.chmod(0o777)
    with pytest.raises(ConfigError, match="every user"):
        run_folder.folder_for("squat", stamp="20260101-120000", base=base)
    base.chmod(0o1777)
    assert run_folder.folder_for("squat", stamp="20260101-120000", base=base).is_dir()


@pytest.mark.parametrize("state", [None, "state"])
def test_below_a_folder_of_others_a_run_is_kept_at_home_and_found_there(
    tmp_path, monkeypatch, capsys, state
):
    theirs, home = tmp_path / "theirs", tmp_path / "home"
    for folder in (theirs, home):
        folder.mkdir()
    theirs.chmod(0o777)
    monkeypatch.chdir(theirs)
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.delenv("XDG_STATE_HOME", raising=False)
    if state:
        monkeypatch.setenv("XDG_STATE_HOME", str(home / state))
    folder = launching.folder_for(None, "squat")
    assert folder.is_relative_to(home / (state or ".local/state") / "humanoid" / "runs")
    assert {path.stat().st_mode & 0o777 for path in (folder, *list(folder.parents)[:2])} == {0o700}
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "This run is kept in" in told
    assert "can be changed by every user" in told
    (folder / "journal.jsonl").write_bytes(SQUAT)
    assert past_runs.find(None) == past_runs.find("squat") == folder
    assert [Path(one.folder) for one in past_runs.history()] == [folder]
    monkeypatch.chdir(home)  # what lies there is of the other folder
    assert past_runs.runs() == []
    assert list(theirs.iterdir()) == []


def test_who_names_a_folder_of_others_is_refused(tmp_path, monkeypatch):
    shared = tmp_path / "shared"
    shared.mkdir()
    shared.chmod(0o777)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    with pytest.raises(ConfigError, match="every user"):
        launching.folder_for(shared / "run", "squat")
    monkeypatch.chdir(shared)
    shared.chmod(0o777)
    (tmp_path / "home").write_text("no folder")
    with pytest.raises(ConfigError, match="every user"):  # no home to go to
        launching.folder_for(None, "squat")


def test_a_link_in_the_place_of_a_journal_is_one_that_is_there(tmp_path):
    (tmp_path / "journal.jsonl").symlink_to(tmp_path / "nowhere")
    with pytest.raises(ConfigError, match="holds a run"):
        run_folder.check_free(tmp_path)


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"", "its journal is empty"),
        (b"\n", "its journal is empty"),
        (b"{", "events are missing or cannot be read"),
        (SQUAT + b"?\n", "events are missing or cannot be read"),
        (None, "its journal is a link"),
    ],
)
def test_a_journal_that_cannot_be_done_again_is_told_with_what_ails_it(tmp_path, content, told):
    file = tmp_path / "journal.jsonl"
    if content is None:
        file.symlink_to("elsewhere")
    else:
        file.write_bytes(content)
    with pytest.raises(ConfigError, match=told) as error:
        recording.load(tmp_path)
    assert all(problem.suggestion for problem in error.value.problems)
