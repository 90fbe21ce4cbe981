"""What a run wrote is kept where it went wrong, so that people can look; else it is gone."""

import pytest

from executive.evaluation import exam, keeping
from executive.evaluation.campaign import Case, Run, Settings
from executive.evaluation.record import Record
from executive.evaluation.single import perform
from executive.journal import past_runs, why
from sim.simulation import Simulation


def record_of(run, **more):
    return Record(
        key=run.key, case=run.case.name, seed=run.seed, recovery=True,
        **{"ok": True, "code": "done", "done": True, **more},
    )  # fmt: skip


def run_of(name, seed=0):
    return Run(case=Case(name=name, mission="stand"), seed=seed)


@pytest.mark.parametrize(
    ("more", "worth"),
    [
        ({}, False),
        ({"ok": False, "code": "no_path"}, True),
        ({"false": True}, True),
        ({"unsafe": True}, True),
        ({"touched": ("hand touched wall/x",)}, True),
        ({"too_near": ("Ann",)}, True),
    ],
)
def test_what_went_wrong_is_worth_a_look(more, worth):
    assert keeping.worth_a_look(record_of(run_of("a"), **more)) == worth


@pytest.mark.parametrize("said", ["wait one second", "frobnicate the cup"])
def test_a_run_that_went_wrong_can_be_asked_why(tmp_path, said):
    (tmp_path / "mine.tasks.yaml").write_text(
        "world: kitchen\n"
        f"tasks: [{{kind: odd, say: {said}, truth: [{{object: red_cup, held: true}}]}}]\n"
    )
    (case,) = exam.load(tmp_path / "mine.tasks.yaml", Settings(Simulation()))
    record = perform(Run(case=case, seed=0), Simulation(), tmp_path / "journals")
    assert not record.ok
    if record.code == "refusal":  # nothing ran, so there is nothing to look at
        assert record.journal == ""
        return
    folder = tmp_path / record.journal
    assert past_runs.look(folder).text == said
    assert any(said in line for line in why.told(folder).lines)
    assert b'"false": true' in (folder / keeping.RECORD).read_bytes()


def left_behind(tmp_path, run, **more):
    """What is kept of a run that wrote a journal."""
    left_by = tmp_path / "left"
    left_by.mkdir(exist_ok=True)
    (left_by / "journal.jsonl").write_text("{}\n")
    return keeping.keep(run, record_of(run, **more), left_by, tmp_path / "journals")


def test_what_went_well_is_not_kept(tmp_path):
    assert left_behind(tmp_path, run_of("a")).journal == ""
    assert not (tmp_path / "journals").exists()


def test_every_run_has_a_folder_of_its_own(tmp_path):
    """Cases may have names that differ in what no folder is called by."""
    names = [
        left_behind(tmp_path, run_of(name, seed), ok=False).journal
        for name, seed in [("a: b", 0), ("a - b", 0), ("a: b", 1), ("../..", 0), ("x" * 900, 0)]
    ]
    assert len(set(names)) == 5
    assert all((tmp_path / name / "journal.jsonl").is_file() for name in names)


def test_a_campaign_in_which_everything_fails_does_not_fill_the_disk(tmp_path, monkeypatch):
    monkeypatch.setattr(keeping, "MOST_KEPT", 2)
    kept = [left_behind(tmp_path, run_of("a", seed), ok=False).journal for seed in range(4)]
    assert [bool(one) for one in kept] == [True, True, False, False]


def test_a_place_that_takes_nothing_ends_no_evaluation(tmp_path):
    (tmp_path / "journals").write_text("a file")
    assert left_behind(tmp_path, run_of("a"), ok=False).journal == ""


def test_nothing_is_kept_through_a_link(tmp_path):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "journals").symlink_to(tmp_path / "elsewhere")
    assert left_behind(tmp_path, run_of("a"), ok=False).journal == ""
    assert not list((tmp_path / "elsewhere").iterdir())
