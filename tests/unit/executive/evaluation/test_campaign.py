"""Campaigns are checked before they run, resumed after a kill, and summed up by the truth."""

import json
import os
import signal
import tracemalloc

import pytest

from executive.evaluation import campaign, pool, report
from executive.evaluation.campaign import Case, Run
from executive.evaluation.record import FILE, Record, Results, fingerprint, folder_to_resume
from executive.frontends import end_signals, evaluation
from executive.frontends.options import Eval
from robot.errors import ConfigError
from sim.simulation import Simulation

FAULTS = (
    "missed grasp", "object knocked over", "object dropped while carrying",
    "object moved after it was seen", "object gone", "place occupied", "path blocked for a while",
    "path blocked for good", "chair pushed into the way", "push of 10 N·s while walking",
    "knocked down while walking", "knocked down and allowed to get up",
    "push of 10 N·s while reaching", "camera silent", "lidar silent", "localisation jump",
    "controller killed", "executive killed", "planner over budget", "a person steps in front",
    "hot motor", "low battery", "disk full",
)  # fmt: skip


def record(case="a", seed=0, *, ok=True, recovery=True, code="done", **more):
    key = f"{case}/{seed}" + ("" if recovery else "/no-recovery")
    return Record(key=key, case=case, seed=seed, recovery=recovery, ok=ok, code=code, **more)


def test_the_shipped_campaign_is_sound_and_has_every_fault():
    cases = campaign.load(campaign.SHIPPED, Simulation())
    assert set(FAULTS) <= {case.name for case in cases}
    for case in cases:
        assert case.why, case.name
        assert bool(case.codes) != case.recovers
        assert case.truth or not case.recovers


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("expect: [no_grip]", "did you mean 'no_grasp'"),
        ("expect: fine", "'recovered' or a list"),
        ("world: bensh", "did you mean 'bench'"),
        ("faults: [{fault: remov, target: red_cup}]", "did you mean 'remove'"),
        ("faults: [{fault: remove, target: red_cop}]", "did you mean 'red_cup'"),
        ("truth: [{object: red_cap, held: true}]", "did you mean 'red_cup'"),
        ("truth: [{object: red_cup}]", "a check is"),
        ("fault: []", "did you mean 'faults'"),
        ("limit_s: -3", "above 0"),
    ],
)
def test_mistakes_are_found_before_anything_runs(tmp_path, change, message):
    path = tmp_path / "mine.yaml"
    path.write_text(f"cases:\n  - name: x\n    mission: pick up the red cup\n    {change}\n")
    with pytest.raises(ConfigError, match=message) as error:
        campaign.load(path, Simulation())
    assert all(problem.line for problem in error.value.problems)


def test_runs_take_every_seed_of_all_cases_before_the_next():
    cases = (Case(name="a", mission="stand"), Case(name="b", mission="stand"))
    keys = [run.key for run in campaign.runs(cases, seeds=2, without_too=True, robot="juno")]
    assert keys[:4] == ["a/0", "a/0/no-recovery", "b/0", "b/0/no-recovery"]
    assert len(set(keys)) == 8


def test_results_survive_a_kill_in_the_middle_of_a_line(tmp_path):
    cases = (Case(name="a", mission="stand"),)
    runs = campaign.runs(cases, seeds=3, without_too=False, robot="juno")
    first = Results(tmp_path, fingerprint="x")
    first.add(record(seed=0))
    first.add(record(seed=1))
    first.close()
    data = first.path.read_bytes()
    first.path.write_bytes(data[:-20])
    second = Results(tmp_path, fingerprint="x")
    assert [run.key for run in second.left(runs)] == ["a/1", "a/2"]
    second.add(record(seed=1))
    second.close()
    third = Results(tmp_path, fingerprint="y")
    assert [run.key for run in third.left(runs)] == ["a/2"]
    assert (first.stale, third.stale) == (False, True)


def test_the_table_tells_what_recovery_brings_and_what_went_wrong():
    cases = (Case(name="a", mission="stand"), Case(name="b", mission="x", expect=("no_grasp",)))
    records = [
        *(record("a", seed) for seed in range(19)),
        record("a", 19, ok=False, code="fallen", unsafe=True),
        *(record("a", seed, recovery=False, ok=seed < 5, code="timeout") for seed in range(20)),
        record("b", 0, code="no_grasp"),
        record("b", 1, ok=False, code="exception", unsafe=True),
    ]
    found = report.report(cases, records)
    a, b = found.rows
    assert (a.with_recovery.ok, a.with_recovery.runs) == (19, 20)
    assert a.without.ok == 5
    assert a.with_recovery.wrong == {"fallen, unsafe": 1}
    assert a.seeds_wrong == (19,)
    assert b.expect == "no_grasp"
    assert (found.worst, found.unsafe, found.without_code) == (0.5, 2, 1)
    text = report.markdown(found)
    assert "| a | recovered | 19/20 | 5/20 |" in text
    assert "oracle" in text


def test_the_fingerprint_follows_the_code(tmp_path):
    (tmp_path / "sim").mkdir()
    code = tmp_path / "sim" / "a.py"
    code.write_text("1")
    before = fingerprint(tmp_path)
    code.write_text("2")
    assert fingerprint(tmp_path) != before
    assert json.dumps(before)


# --- going on, and ending early -----------------------------------------------------------------


def test_results_that_are_not_there_are_no_results_to_go_on_with(tmp_path):
    Results(tmp_path / "20260101-eval", fingerprint="x").close()
    assert folder_to_resume(tmp_path / "20260101-eval")
    with pytest.raises(ConfigError, match=r"did you mean '.*20260101-eval'"):
        folder_to_resume(tmp_path / "20260101-evl")
    assert not (tmp_path / "20260101-evl").exists()


def test_two_evaluations_do_not_write_into_one_file(tmp_path):
    first = Results(tmp_path, fingerprint="x")
    with pytest.raises(ConfigError, match="another evaluation writes into it"):
        Results(tmp_path, fingerprint="x")
    first.close()
    Results(tmp_path, fingerprint="x").close()


def test_a_file_of_something_else_is_left_alone(tmp_path):
    (tmp_path / FILE).write_text("dear diary\n")
    with pytest.raises(ConfigError, match="no file of `humanoid eval`"):
        Results(tmp_path, fingerprint="x")
    (tmp_path / FILE).unlink()
    os.mkfifo(tmp_path / FILE)
    with pytest.raises(ConfigError, match="no ordinary file"):
        Results(tmp_path, fingerprint="x")
    assert (tmp_path / FILE).is_fifo()


@pytest.mark.parametrize(
    "wrong",
    [
        {"key": "a/00"}, {"key": "b/0"}, {"recovery": False}, {"seed": -1, "key": "a/-1"},
        {"took_s": 1e308}, {"took_s": -1.0}, {"wall_s": 1e300}, {"recoveries": 2**62},
        {"struck": -3},
    ],
)  # fmt: skip
def test_what_no_run_can_have_come_to_is_not_believed(tmp_path, wrong):
    lines = [{"code": "x"}, {**_plain(record()), **wrong}, _plain(record(seed=1))]
    (tmp_path / FILE).write_text("".join(f"{json.dumps(line)}\n" for line in lines))
    with Results(tmp_path, fingerprint="x") as results:
        assert list(results.records) == ["a/1"]


def test_a_large_file_is_read_line_by_line(tmp_path):
    lines = [
        b'{"code":"x"}\n',
        *[b"y" * 999_999 + b"\n"] * 40,
        json.dumps(_plain(record())).encode(),
    ]
    (tmp_path / FILE).write_bytes(b"".join(lines))
    tracemalloc.start()
    with Results(tmp_path, fingerprint="x") as results:
        assert list(results.records) == ["a/0"]
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 5_000_000
    (tmp_path / FILE).write_bytes(b'{"code":"x"}\n' + b"\n" * 300_000)
    with pytest.raises(ConfigError, match="more than 200000 lines"):
        Results(tmp_path, fingerprint="x")


def test_a_line_that_is_nested_without_end_is_none(tmp_path):
    deep = b'{"key":"a","x":' + b"[" * 40_000 + b"]" * 40_000 + b"}\n"
    whole = json.dumps(_plain(record())).encode() + b"\n"
    (tmp_path / FILE).write_bytes(b'{"code":"x"}\n' + deep + whole)
    with Results(tmp_path, fingerprint="x") as results:
        assert list(results.records) == ["a/0"]


def test_results_of_another_mission_are_not_taken_for_those_of_this_one(tmp_path):
    here, there = (Run(case=Case(name="a", mission=m), seed=0) for m in ("stand", "squat"))
    with Results(tmp_path, fingerprint="x") as results:
        results.add(Record(**{**_plain(record()), "digest": here.digest}))
        assert results.left([here]) == []
        with pytest.raises(ConfigError, match="'a/0' are of another mission, world or robot"):
            results.left([there])


def _plain(made):
    return {name: getattr(made, name) for name in made.__struct_fields__}


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"faults": "missed_grasp, objct gone"}, ["'missed grasp'", "'object gone'"]),
        ({"faults": " , "}, ["no case is named"]),
        ({"faults": "disk full,disk full"}, ["2 cases are called 'disk full'"]),
        ({"world": "kitchen"}, ["each case names its own world"]),
        ({"world": "kichen", "missions": ["stand"]}, ["did you mean 'kitchen'"]),
        ({"robot": "junno", "faults": "disk full"}, ["did you mean 'juno'"]),
        ({"robot": "junno", "missions": ["stand"]}, ["did you mean 'juno'"]),
        ({"missions": ["stand", "stand"]}, ["2 cases are called 'stand'"]),
    ],
)
def test_options_that_mean_nothing_are_refused(options, words):
    with pytest.raises(ConfigError) as error:
        evaluation.chosen(Eval(**options))
    assert all(word in str(error.value) for word in words)
    assert len(error.value.problems) == len(words)


def test_world_and_robot_stand_for_those_of_a_mission_file(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("name: mine\nsteps: [stand]\n")
    for world in ("bench", "kitchen"):
        (case,) = evaluation.chosen(Eval(missions=[str(path)], world=world))
        found = campaign.meant(case, campaign.Settings(Simulation()))
        assert found.where.world.name == world
    with pytest.raises(ConfigError, match="did you mean 'juno'"):
        campaign.meant(case, campaign.Settings(Simulation(), "junno"))


def test_a_fault_brings_the_help_it_takes():
    asked = Eval(missions=["stand"], faults="knocked down and allowed to get up")
    (case,) = evaluation.chosen(asked)
    assert case.helped
    assert case.damped


def test_a_wish_to_end_is_heard_and_a_late_second_one_ends_it_at_once(monkeypatch):
    clock, left = Hands(), []
    monkeypatch.setattr(end_signals.Ending, "_leave", lambda _: left.append(clock.s))
    with end_signals.Ending(clock) as heard:
        for number, at_s in ((signal.SIGINT, 0.0), (signal.SIGTERM, 0.1), (signal.SIGHUP, 9.0)):
            assert not left
            clock.s = at_s
            signal.raise_signal(number)
            assert heard.asked
    assert left == [9.0]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


class Hands:
    """A clock that is set by hand."""

    s = 0.0

    def now_s(self):
        return self.s


def test_runs_that_nobody_wants_any_more_are_not_begun():
    run = Run(case=Case(name="a", mission="stand"), seed=0)
    assert list(pool.in_processes([run], Simulation(), processes=1, stop=lambda: True)) == []


@pytest.mark.parametrize(
    ("mission", "remark"),
    [("go to the tabel", "I took “tabel” for “table”."), ("go to the table", "")],
)
def test_words_that_were_taken_for_others_are_noted(mission, remark):
    settings = campaign.Settings(Simulation())
    case = Case(name="go", mission=mission, expect="recovered", world="kitchen")
    given = campaign.meant(case, settings)
    assert isinstance(given, campaign.Meant)
    assert given.remark == remark


def test_words_that_were_taken_for_others_are_told_once_for_each_case(capsys):
    records = [record(seed=seed, remark="I took “teh” for “the”") for seed in range(3)]
    many = [record(case=f"case {number}", remark="so it was") for number in range(30)]
    evaluation.say_remarks([*records, record("b"), *many])
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "a: I took “teh” for “the”"
    assert len(lines) == 1 + evaluation.MOST_REMARKS
    assert lines[-1] == f"and 11 more in {FILE}"
