"""The command line end to end, with a puppet for a robot: words, exit statuses, last lines."""

from __future__ import annotations

import io
import json
import re
import resource
from contextlib import contextmanager

import pytest

from benchmarks.intents.endpoint import Reply, serving
from executive.engine.loop import Interrupts
from executive.frontends import carrying_out, do
from executive.meaning import request
from executive.runs import runtimes
from intents.outcomes import Question
from robot.exit_status import ExitStatus
from robot.failures import failure
from robot.messages import Damp, Stand
from robot.model import description
from robot.planning.requests import BasePathRequest, PickRequest
from tests.fakes.puppet_runtime import PuppetRuntime
from tests.fakes.synthesiser import Synthesiser
from tests.fakes.waiting import eventually
from tests.fakes.worlds import mapped, puppet


@pytest.fixture
def runtime(monkeypatch):
    """A puppet's runtime where the real one would be opened, in the test world."""
    made = PuppetRuntime(puppet())

    @contextmanager
    def opened(setup, **_):
        made.opened = setup.kind
        yield runtimes.Opened(made, made.planner)

    monkeypatch.setattr(runtimes, "opened", opened)
    monkeypatch.setattr(request, "setting", mapped)
    made.opened = None
    return made


@pytest.fixture
def small_files(monkeypatch):
    """Within it no file grows beyond so many bytes, as on a disk that is full."""

    @contextmanager
    def limited(most_bytes):
        # of whose bytecode the half is taken for the whole by whoever imports it next
        monkeypatch.setattr("sys.dont_write_bytecode", True)
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (most_bytes, before[1]))
        try:
            yield
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)

    return limited


def test_the_main_job_is_done_and_summed_up(runtime, humanoid, tmp_path):
    status, text = humanoid("do", "pick up the red cup and put it on the table", "--fast")
    assert status == 0, text
    assert "Done." in text
    assert "the red cup is believed to be on the table" in text
    assert re.search(r"pick up the red cup: done", text)
    (folder,) = (tmp_path / "runs").iterdir()
    assert folder.name.endswith("-pick-up-the-red-cup-and-put-it-on-the")
    events = [json.loads(line) for line in (folder / "journal.jsonl").read_text().splitlines()]
    assert [event["n"] for event in events] == list(range(len(events)))
    assert events[0]["event"] == "run"
    assert [event["code"] for event in events if event["event"] == "outcome"] == ["done"]
    assert (folder / "wall.jsonl").exists()
    assert json.loads((folder / "run.json").read_text())["origin"]["world"]
    assert json.loads((folder / "summary.json").read_text())["status"] == "done"


def test_as_json_there_is_one_object_and_nothing_else(runtime, humanoid):
    status, text = humanoid("do", "squat", "--fast", "--json", "--run-dir", "here")
    record = json.loads(text)
    assert status == 0
    assert record["status"] == "done"
    assert record["folder"] == "here"


def test_what_is_remarked_on_is_told_once_before_it_begins(runtime, humanoid):
    status, text = humanoid("do", "nod quickly", "--fast")
    assert status == 0
    assert text.splitlines()[0] == "  I move at my own pace: “quickly” changes nothing."
    assert text.count("I move at my own pace") == 1


@pytest.mark.parametrize(
    "sentence",
    [
        "",
        "asdf qwer",
        "pick up the unicorn",
        "put the red cup on the moon",
        "put the cup on the table",
        "x" * 100_000,
        "pick up the crate",
    ],
)
def test_bad_words_end_with_2_a_cure_and_nothing_started(runtime, humanoid, tmp_path, sentence):
    status, text = humanoid("do", sentence, "--fast")
    assert status == 2
    assert "What to do:" in text
    assert "Traceback" not in text
    assert runtime.opened is None
    assert not (tmp_path / "runs").exists()


def test_an_open_question_is_the_last_word(runtime, humanoid):
    status, text = humanoid("do", "put the cup on the table", "--fast")
    assert status == 2
    assert "Which cup, the red one or the blue one?" in text


def test_at_a_terminal_the_question_is_asked(runtime, humanoid, monkeypatch):
    monkeypatch.setattr(do, "at_terminal", lambda: True)
    monkeypatch.setattr(do, "ask", lambda question: "blue")
    status, text = humanoid("do", "pick up the cup", "--fast")
    assert status == 0, text
    assert "blue cup" in text


@pytest.mark.parametrize(("typed", "answer"), [("blue\n", "blue"), ("\n", None), ("", None)])
def test_a_question_is_asked_on_a_line_of_its_own(monkeypatch, capsys, typed, answer):
    monkeypatch.setattr("sys.stdin", io.StringIO(typed))
    question = Question(question="Which cup, the red one or the blue one?", choices=())
    assert do.ask(question) == answer
    out = capsys.readouterr().out
    assert out.startswith("Which cup, the red one or the blue one? ")
    assert out.endswith("\n") or typed  # who types ends the line, who leaves does not


def test_a_task_that_fails_ends_with_1_its_code_and_a_cure(runtime, humanoid):
    runtime.puppet.blind = True
    for thing in runtime.puppet.things.values():
        thing.known = False
    status, text = humanoid("do", "pick up the red cup", "--fast")
    assert status == 1
    assert "(object_not_seen)" in text
    assert "What to do:" in text
    assert runtime.puppet.mode == "stand"


def test_a_place_that_no_path_leads_to_ends_with_1_after_waiting(runtime, humanoid):
    blocked = failure("no_path", "no free path leads to the table")
    runtime.planner.failures[BasePathRequest] = [blocked] * 100
    status, text = humanoid("do", "go to the table", "--fast")
    assert status == 1
    assert "(no_path)" in text
    assert "wait, then try again (3 of 3)" in text
    assert runtime.puppet.mode == "stand"


def test_a_missed_grasp_is_tried_again_and_done(runtime, humanoid):
    missed = failure("grasp_missed", "the fingers closed on air")
    runtime.planner.failures[PickRequest] = [missed]
    status, text = humanoid("do", "pick up the red cup", "--fast")
    assert status == 0, text
    assert "look again, then retry (1 of 2)" in text
    assert "1 recovery" in text


def test_a_fall_ends_with_1(runtime, humanoid):
    runtime.at = [(1.0, lambda: setattr(runtime.puppet, "mode", "fallen"))]
    status, text = humanoid("do", "walk two metres forward", "--fast")
    assert status == 1
    assert "(fallen)" in text


def test_a_lost_plant_ends_with_3(runtime, humanoid):
    lost = failure("plant_lost", "the simulation died")
    runtime.at = [(1.0, lambda: setattr(runtime, "lost", lost))]
    status, text = humanoid("do", "walk two metres forward", "--fast")
    assert status == 3
    assert "the simulation died (plant_lost)" in text


def press(monkeypatch, runtime, *times_s):
    """Press Ctrl-C at some times."""
    pressed = []

    class Pressed(Interrupts):
        def __init__(self):
            super().__init__()
            runtime.at = [(t, self.press) for t in times_s]
            pressed.append(self)

    monkeypatch.setattr(carrying_out, "Interrupts", Pressed)


def test_ctrl_c_stands_then_leaves_with_1(runtime, humanoid, monkeypatch):
    press(monkeypatch, runtime, 2.0)
    status, text = humanoid("do", "walk two metres forward", "--fast")
    assert status == 1
    assert "stopped on request" in text
    assert isinstance(runtime.puppet.sent[-1], Stand)
    assert runtime.puppet.mode == "stand"


def test_a_second_ctrl_c_damps_at_once(runtime, humanoid, monkeypatch):
    press(monkeypatch, runtime, 2.0, 2.05)
    status, _ = humanoid("do", "walk two metres forward", "--fast")
    assert status == 1
    assert isinstance(runtime.puppet.sent[-1], Damp)
    assert runtime.puppet.time_s < 2.3


def test_a_folder_that_cannot_be_is_refused_before_anything_moves(runtime, humanoid, tmp_path):
    (tmp_path / "file").write_text("")
    status, text = humanoid("do", "squat", "--fast", "--run-dir", "file/run")
    assert status == 2, text
    assert "file/run" in text
    assert not runtime.puppet.sent


def test_a_folder_that_holds_a_run_is_not_written_over(runtime, humanoid):
    assert humanoid("do", "say hello", "--fast", "--run-dir", "here")[0] == 0
    status, text = humanoid("do", "say hello", "--fast", "--run-dir", "here")
    assert (status, "already holds a run" in text) == (2, True)


def test_the_same_run_twice_writes_the_same_journal(runtime, monkeypatch, humanoid, tmp_path):
    journals = []
    for name in ("a", "b"):
        made = PuppetRuntime(puppet())

        @contextmanager
        def opened(setup, made=made, **_):
            yield runtimes.Opened(made, made.planner)

        monkeypatch.setattr(runtimes, "opened", opened)
        status, _ = humanoid(
            "do", "bring the red cup to the table", "--fast", "--run-dir", f"run-{name}"
        )
        assert status == 0
        journals.append((tmp_path / f"run-{name}" / "journal.jsonl").read_bytes())
    assert journals[0] == journals[1]


# --- aloud ---------------------------------------------------------------------------------------


@pytest.fixture
def synthesiser(tmp_path, monkeypatch):
    """Something to speak with that takes a moment to say anything."""
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    return Synthesiser(tmp_path / "bin", first="/bin/sleep 0.05")


@pytest.mark.parametrize(
    ("sentence", "said"),
    [
        ("say welcome home", ["welcome home", "Done."]),
        ("put the cup on the table", ["Which cup, the red one or the blue one?"]),
    ],
)
def test_what_is_for_ears_is_said_to_its_end(runtime, humanoid, synthesiser, sentence, said):
    humanoid("do", sentence, "--fast", "--voice")
    assert synthesiser.said == said


def test_a_question_at_the_terminal_is_asked_aloud_and_ends_with_the_answer(
    runtime, humanoid, synthesiser, monkeypatch
):
    def ask(question):
        assert eventually(lambda: synthesiser.said == [question.question])
        return "blue"

    monkeypatch.setattr(do, "at_terminal", lambda: True)
    monkeypatch.setattr(do, "ask", ask)
    assert humanoid("do", "pick up the cup", "--fast", "--voice")[0] == 0
    assert synthesiser.said == ["Which cup, the red one or the blue one?", "Done."]


def test_a_failure_is_said_with_its_cause(runtime, humanoid, synthesiser):
    runtime.at = [(1.0, lambda: setattr(runtime.puppet, "mode", "fallen"))]
    assert humanoid("do", "walk two metres forward", "--fast", "--voice")[0] == 1
    assert synthesiser.said[-1].startswith("I could not do that: ")


def test_nothing_is_said_unless_asked_for(runtime, humanoid, synthesiser):
    assert humanoid("do", "say welcome home", "--fast")[0] == 0
    assert synthesiser.said == []


# --- files and options, with the real worlds ---------------------------------------------------


def test_a_typo_in_a_world_file_is_named_by_line(humanoid, tmp_path):
    path = tmp_path / "house.yaml"
    path.write_text("name: house\nrooms:\n  - {id: hall, at_m: [0, 0], sice_m: [4, 4]}\n")
    status, text = humanoid("do", "squat", "--world", str(path), "--fast")
    assert status == 2
    assert "house.yaml:3" in text
    assert "did you mean 'size_m'" in text


def test_an_unknown_world_or_robot_names_the_nearest(humanoid):
    status, text = humanoid("do", "squat", "--world", "kitchn", "--fast")
    assert (status, "did you mean 'kitchen'?" in text) == (2, True)
    status, text = humanoid("do", "squat", "--robot", "jun", "--fast")
    assert (status, "did you mean 'juno'?" in text) == (2, True)


def test_a_robot_file_with_a_missing_joint_is_refused(humanoid, tmp_path):
    whole = description.load("juno")
    source = (whole.mjcf_path().parent / "juno.yaml").read_text()
    (tmp_path / "juno.xml").write_text(whole.mjcf_path().read_text())
    broken = source.replace("{joint: left_knee,", "{joint: left_knie,")
    assert broken != source
    path = tmp_path / "robot.yaml"
    path.write_text(broken)
    status, text = humanoid("do", "squat", "--robot", str(path), "--fast")
    assert status == 2
    assert "left_knie" in text
    missing = "\n".join(line for line in source.splitlines() if not line.startswith("  left_knee:"))
    path.write_text(missing)
    status, text = humanoid("do", "squat", "--robot", str(path), "--fast", "--json")
    record = json.loads(text)
    assert status == record["exit_status"] == 2
    assert any("left_knee" in line for line in record["reason"])


@pytest.mark.parametrize(
    "options", [("--speed", "3"), ("--turn", "nan"), ("--for", "-1"), ("--left", "inf")]
)
def test_a_walk_that_the_robot_cannot_walk_is_refused(humanoid, options):
    status, text = humanoid("walk", *options, "--fast")
    assert status == 2
    assert options[0] in text


def test_walk_walks_and_stands(runtime, humanoid):
    status, text = humanoid("walk", "--speed", "0.3", "--for", "5", "--fast")
    assert status == 0
    assert "1.49 m forward" in text
    assert runtime.puppet.mode == "stand"


@pytest.mark.parametrize("words", [("parse",), ("do",), ("nonsense",), ("do", "x", "--sped")])
def test_wrong_use_is_2(humanoid, words):
    assert humanoid(*words)[0] == 2


def test_parse_prints_the_goals(humanoid, tmp_path):
    status, text = humanoid("parse", "--json", "pick up the red cup")
    record = json.loads(text)
    assert status == 0
    assert record["goals"] == [{"goal": "pick", "object": {"name": "cup", "color": "red"}}]
    (tmp_path / "lines.txt").write_text("stop\nblah blah\n")
    status, text = humanoid("parse", "--json", "--file", "lines.txt")
    assert [json.loads(line)["outcome"] for line in text.splitlines()] == ["goals", "refusal"]
    assert humanoid("parse", "--file", "none.txt")[0] == 2


def test_doctor_worlds_version_help(humanoid):
    assert "Python" in humanoid("doctor")[1]
    assert "kitchen" in humanoid("worlds")[1]
    assert humanoid("--version")[1].startswith("humanoid-executive ")
    for words in ((), ("do",), ("walk",), ("parse",), ("view",)):
        assert "humanoid" in humanoid(*words, "--help")[1]


def test_model_export_writes_a_urdf(humanoid, tmp_path):
    assert humanoid("model", "export", "--urdf", "juno.urdf")[0] == 0
    assert (tmp_path / "juno.urdf").read_text().startswith("<?xml")
    status, text = humanoid("model", "export", "--urdf", "nowhere/juno.urdf")
    assert (status, "cannot be written" in text) == (2, True)


def test_what_a_full_disk_did_not_take_is_said_at_the_end(runtime, humanoid, small_files):
    with small_files(2000):  # the journal of this takes more
        status, text = humanoid("do", "pick up the red cup and put it on the table", "--fast")
    assert status == 0, text
    assert re.search(r"NOT KEPT +journal.jsonl \(what happened\) is cut: File too large", text)
    assert "make room on the disk" in text
    assert "NOT KEPT" not in humanoid("do", "pick up the red cup", "--fast")[1]


def test_view_without_a_display_says_so(humanoid, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    status, text = humanoid("view")
    assert status == 2
    assert "--snapshot" in text


def test_why_a_language_model_was_of_no_help_is_told(humanoid, tmp_path):
    with serving(Reply(status=500)) as server:
        file = tmp_path / "model.toml"
        file.write_text(f'base_url = "{server.url}"\nmodel = "local"\n')
        status, text = humanoid("do", "brighten up the evening", "--fast", "--model", str(file))
    assert status == ExitStatus.INVALID, text
    assert "The language model was of no help: " in text


SAY = '{"goals": [{"goal": "say", "what": "one"}, {"goal": "say", "what": "two"}]}'


@pytest.mark.parametrize(
    ("agreed", "ends"), [(("--yes",), ExitStatus.DONE), ((), ExitStatus.INVALID)]
)
def test_a_plan_is_shown_and_done_through_a_pipe_where_it_is_agreed_to(
    humanoid, tmp_path, agreed, ends
):
    with serving(Reply(content=SAY)) as server:
        file = tmp_path / "model.toml"
        file.write_text(f'base_url = "{server.url}"\nmodel = "local"\n')
        words = ("do", "brighten up the evening", "--fast", "--model", str(file), *agreed)
        status, text = humanoid(*words)
    assert status == ends, text
    assert "  1. say “one”\n  2. say “two”\n" in text
    assert ("say it again with --yes" in text) == (not agreed)


@pytest.mark.parametrize(
    "words",
    [
        ("parse", "say hello"), ("mission", "check", "hello"), ("mission", "plan", "hello"),
        ("why",), ("history",), ("worlds",), ("doctor",),
    ],
    ids=" ".join,
)  # fmt: skip
def test_a_command_that_only_looks_writes_nothing(humanoid, tmp_path, words):
    humanoid(*words)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["../evening", "/tmp/evening", "a/b", "..", ".hidden"])
def test_a_new_mission_is_made_in_this_folder_and_nowhere_else(humanoid, tmp_path, name):
    status, text = humanoid("mission", "new", name)
    assert status == 2, text
    assert list(tmp_path.iterdir()) == []
    assert not list(tmp_path.parent.glob("evening*"))
