"""The runs of the past: one folder that makes no sense must not hide the others."""

import os
from pathlib import Path

import pytest

from executive.frontends.past_runs import printing
from executive.journal import past_runs, successor
from executive.journal.why import told
from robot.errors import ConfigError

JOURNAL = b'{"n":0,"t_s":0.0,"event":"run","text":"squat","world":"kitchen","seed":3}\n'


@pytest.fixture
def run(tmp_path: Path) -> Path:
    folder = tmp_path / "20260101-120000-squat"
    folder.mkdir()
    (folder / "journal.jsonl").write_bytes(JOURNAL)
    return folder


ODD = [
    b"",
    b"{",
    b"[]",
    b"null",
    b"\xff\xfe",
    b"[" * 100_000,
    b'{"code": 1, "simulated_s": "abc", "text": [], "seed": "x", "wall_s": "9"}',
    b'{"code": "done", "simulated_s": 1e999, "text": "a", "seed": 1e99}',
    b'{"code": null, "seed": ' + b"9" * 5001 + b"}",
    b'{"wall_s":99999999999.9}',
    b'{"wall_s":9999999999999999999999}',
    b'{"wall_s":1.2.3}',
]


@pytest.mark.parametrize("name", ["run.json", "summary.json", "wall.jsonl", "journal.jsonl"])
@pytest.mark.parametrize("content", ODD, ids=range(len(ODD)))
def test_a_file_that_makes_no_sense_hides_no_run(run, name, content):
    (run / name).write_bytes(content)
    assert [Path(one.folder).name for one in past_runs.history(run.parent)] == [run.name]


@pytest.mark.parametrize("name", ["run.json", "summary.json", "wall.jsonl", "journal.jsonl"])
@pytest.mark.parametrize("kind", ["pipe", "device", "folder", "loop"])
def test_nor_does_one_that_is_no_file(run, name, kind):
    path = run / name
    path.unlink(missing_ok=True)
    match kind:
        case "pipe":
            os.mkfifo(path)
        case "device":
            path.symlink_to("/dev/zero")
        case "folder":
            path.mkdir()
        case _:
            path.symlink_to(path.name)
    assert len(list(past_runs.history(run.parent))) == len(past_runs.runs(run.parent))


def test_a_folder_of_another_age_hides_no_run(run):
    os.utime(run, (0, 4e13))
    assert len(list(past_runs.history(run.parent))) == 1


def test_an_empty_name_is_no_runs(run):
    assert past_runs.find("squat", base=run.parent) == run
    with pytest.raises(ConfigError, match="there is no run ''"):
        past_runs.find("", base=run.parent)


def test_the_header_says_what_a_run_was_about(run):
    (run / "run.json").write_text('{"text": "wave", "seed": 7}')
    (one,) = past_runs.history(run.parent)
    assert (one.text, one.seed, one.ending) == ("wave", 7, "cut off")


def test_a_run_that_was_gone_on_with_says_in_which_and_is_not_gone_on_with_again(run):
    (one,) = past_runs.history(run.parent)
    assert one.gone_on_in == ""
    successor.refuse(run)
    successor.note(run, run.parent / "20261127-120000-squat")
    (one,) = past_runs.history(run.parent)
    assert (one.ending, one.gone_on_in) == ("cut off", "20261127-120000-squat")
    with pytest.raises(ConfigError, match="humanoid resume 20261127-120000-squat"):
        successor.refuse(run)
    assert "20261127-120000-squat" in str(told(run).lines)


@pytest.mark.parametrize("words", [b"\x1b[31mred\n", b"\xff" * 400, b"x" * 2_000, b"a\nb"])
def test_what_a_stranger_wrote_there_is_one_line_that_can_be_printed(run, words):
    (run / successor.FILE).write_bytes(words)
    assert successor.name_of(run).isprintable()


def test_a_folder_from_which_the_journal_is_gone_is_told_from_one_that_is_not_there(run):
    (run / "journal.jsonl").unlink()
    with pytest.raises(ConfigError, match=r"holds no journal\.jsonl"):
        past_runs.find(str(run), base=run.parent)
    with pytest.raises(ConfigError, match="there is no run"):
        past_runs.find(str(run) + "-other", base=run.parent)


def test_a_run_of_several_jobs_is_not_done_because_its_last_one_is(run):
    jobs = [(1, "running"), (1, "cancelled"), (2, "running"), (2, "done"), (3, "running")]
    jobs.append((3, "done"))
    with (run / "journal.jsonl").open("ab") as file:
        for number, (job, state) in enumerate(jobs, start=1):
            file.write(
                b'{"n":%d,"t_s":%d.0,"event":"job","job":%d,"state":"%s","text":"nod"}\n'
                % (number, number, job, state.encode())
            )
    found = past_runs.look(run)
    assert (found.jobs_done, found.jobs) == (2, 3)
    assert printing._how(found) == "2 of 3 done"


def another(run: Path, name: str, *, ended: str = "") -> Path:
    folder = run.with_name(name)
    folder.mkdir()
    (folder / "journal.jsonl").write_bytes(JOURNAL)
    if ended:
        (folder / "summary.json").write_text(f'{{"code": "{ended}"}}')
    return folder


def test_of_runs_with_a_part_in_their_names_the_one_that_was_cut_off_is_gone_on_with(run):
    another(run, "20260102-120000-wave", ended="done")
    last = another(run, "20260103-120000-squat", ended="done")
    assert past_runs.find_cut_off("2026", base=run.parent) == run
    assert past_runs.find_cut_off("wave", base=run.parent).name == "20260102-120000-wave"
    assert past_runs.find_cut_off(None, base=run.parent) == last


def test_of_several_that_were_cut_off_none_is_guessed(run):
    other = another(run, "20260102-120000-wave")
    with pytest.raises(ConfigError) as caught:
        past_runs.find_cut_off("2026", base=run.parent)
    told = str(caught.value)
    assert "2 runs that were cut off have '2026' in their names" in told
    assert told.index(other.name) < told.index(run.name)
    assert past_runs.find_cut_off("0102", base=run.parent) == other


def test_a_whole_name_means_its_run_though_it_is_a_part_of_another(run):
    other = another(run, f"{run.name}-2")
    assert past_runs.find(run.name, base=run.parent) == run
    assert past_runs.find_cut_off(run.name, base=run.parent) == run
    assert past_runs.find("squat", base=run.parent) == other
