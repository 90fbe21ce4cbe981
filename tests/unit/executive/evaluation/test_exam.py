"""An exam is checked before it runs; what is not understood is a result; marks are by kind."""

from pathlib import Path

import msgspec
import pytest

from executive.evaluation import campaign, exam, marks
from executive.evaluation.campaign import Case, Settings
from executive.evaluation.record import Record
from executive.evaluation.single import perform
from executive.frontends import evaluation, evaluation_report, output
from executive.frontends.options import Eval
from robot.errors import ConfigError
from sim.simulation import Simulation

TASK = 'kind: fetch, say: "pick up the red cup", truth: [{object: red_cup, held: true}]'


def read(folder, *tasks, world="kitchen"):
    path = folder / "mine.tasks.yaml"
    lines = "".join(f"  - {{{task}}}\n" for task in tasks)
    path.write_text(f"world: {world}\ntasks:\n{lines}")
    return exam.load(path, Settings(Simulation()))


@pytest.mark.parametrize(
    ("task", "message"),
    [
        (f"{TASK}, or_code: no_grip", "did you mean 'no_grasp'"),
        (TASK.replace("red_cup, held", "red_cap, held"), "did you mean 'red_cup'"),
        (TASK.replace("held: true", "on: shelv"), "did you mean 'shelf'"),
        ("kind: x, say: hello, truth: []", "length >= 1"),
        ("kind: x, say: hello, truth: [{said: '('}]", "no regular expression"),
        ("kind: x, say: hello, truth: [{robot_in: kitchn}]", "did you mean"),
        ("kind: x, say: hello, truth: [{said: a, within_m: 1}]", "within_m means nothing"),
        ("kind: x, say: hello, truth: [{any: [{object: red_cap, held: true}]}]", "red_cup"),
        (f"{TASK}, person: 3", "person_s"),
    ],
)
def test_mistakes_are_found_before_anything_runs(tmp_path, task, message):
    with pytest.raises(ConfigError, match=message) as error:
        read(tmp_path, task)
    assert all(problem.line for problem in error.value.problems)


def test_a_world_lies_beside_its_exam(tmp_path):
    (tmp_path / "home.yaml").write_text(
        "name: home\nrooms: [{id: hall, at_m: [0, 0], size_m: [4, 4]}]\n"
    )
    task = "kind: route, say: go to the hall, truth: [{robot_in: hall}]"
    (case,) = read(tmp_path, task, world="home.yaml")
    assert case.world == str(tmp_path / "home.yaml")


def test_a_sentence_that_is_not_understood_is_a_result(tmp_path):
    task = 'kind: odd, say: "frobnicate the cup", truth: [{object: red_cup, held: true}]'
    (case,) = read(tmp_path, task)
    (run,) = campaign.runs((case,), seeds=1, without_too=False, robot="")
    record = perform(run, Simulation())
    assert (record.ok, record.done, record.code) == (False, False, "refusal")


@pytest.mark.parametrize(
    ("say", "refused"),
    [("frobnicate the cup", True), ("bring me the unicorn", True), ("wait one second", False)],
)
def test_a_wish_that_is_to_be_refused_is_done_by_refusing_it(tmp_path, say, refused):
    task = f'kind: refuse, say: "{say}", or_code: refused, truth: [{{not_moved: red_cup}}]'
    (case,) = read(tmp_path, task)
    (run,) = campaign.runs((case,), seeds=1, without_too=False, robot="")
    record = perform(run, Simulation())
    assert record.ok == refused
    assert record.false != refused


def test_kinds_of_several_errands_have_more_time(tmp_path):
    short, long, own = read(
        tmp_path, TASK, TASK.replace("fetch", "all"), f"{TASK}, limit_s: 60, person_s: 20"
    )
    assert short.limit_s < long.limit_s
    assert (own.limit_s, own.person_s) == (60, 20)


def test_an_exam_says_itself_where_and_what():
    with pytest.raises(ConfigError, match="leave it out") as error:
        evaluation.chosen(
            Eval(tasks=[Path("x")], missions=["stand"], world="bench", faults="disk full")
        )
    assert len(error.value.problems) == 3


def found():
    case = Case(name="a", mission="stand", kind="fetch", person_s=20.0)
    cases = (case, msgspec.structs.replace(case, name="b", kind="count"))

    def record(name, seed, **more):
        return Record(key=f"{name}/{seed}", case=name, seed=seed, recovery=True, **more)

    return marks.marks(
        cases,
        [
            record("a", 0, ok=True, code="done", done=True, took_s=40.0),
            record("a", 1, ok=False, code="done", false=True, touched=("arm touched wall/x",)),
            record("b", 0, ok=False, code="timeout", unsafe=True),
        ],
        left=1,
    )


def test_marks_count_by_kind_what_is_so_in_truth():
    fetch, count = found().kinds
    assert (fetch.kind, fetch.runs, fetch.done, fetch.false, fetch.touched) == ("fetch", 2, 1, 1, 1)
    assert fetch.median_times == 2.0
    assert (count.share, count.fell, count.codes) == (0.0, 1, {"timeout": 1})
    assert (found().whole.runs, found().whole.done) == (3, 1)


@pytest.mark.parametrize("columns", [40, 80, 200])
def test_marks_can_be_read_on_any_terminal(columns, monkeypatch, capsys):
    monkeypatch.setattr(evaluation_report, "table_screen", lambda: output.Screen(width=columns))
    evaluation_report.show(found())
    words = capsys.readouterr().out
    assert all(word in words for word in ("fetch", "count", "timeout", "1/2", "33%"))


@pytest.mark.parametrize("kind", Simulation().home_kinds())
def test_an_exam_of_a_made_home_is_sound(tmp_path, kind):
    made = Simulation().home(kind, seed=11, file="home.yaml")
    (tmp_path / "home.yaml").write_text(made.world)
    (tmp_path / "home.tasks.yaml").write_text(made.tasks)
    cases = exam.load(tmp_path / "home.tasks.yaml", Settings(Simulation()))
    assert len(cases) == 10
    assert all(case.kind and case.person_s and case.truth for case in cases)
