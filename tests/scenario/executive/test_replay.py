"""Runs of a puppet are done again and are the same; what differs is found and shown."""

import json
import re
import threading
from pathlib import Path

import pytest

from executive.meaning import request
from executive.runs.runtimes import Opened, Setup
from executive.runs.session import Session
from robot.failures import failure
from robot.planning.requests import PickRequest
from tests.fakes.puppet_runtime import PuppetRuntime
from tests.fakes.worlds import mapped, puppet
from tests.scenario.test_cli import press, runtime  # noqa: F401 - a fixture


@pytest.fixture
def anew(runtime):  # noqa: F811
    """Puts a fresh puppet in the place of the last one, as every run has one."""

    def make(**planner_failures) -> PuppetRuntime:
        fresh = PuppetRuntime(puppet())
        runtime.__dict__.update(fresh.__dict__)
        return runtime

    return make


def test_a_run_is_identical_when_it_is_done_again(runtime, humanoid, anew):  # noqa: F811
    assert humanoid("do", "bring the red cup to the table", "--fast", "--run-dir", "a")[0] == 0
    anew()
    status, text = humanoid("replay", "a")
    assert status == 0, text
    assert "Identical: it repeats byte for byte" in text
    assert "note:" not in text
    events = len(Path("a/journal.jsonl").read_text().splitlines())
    anew()
    record = json.loads(humanoid("replay", "a", "--json")[1])
    assert (record["events"], record["difference"]) == (events, None)


def test_what_differs_first_is_shown_with_what_led_up_to_it(runtime, humanoid, anew):  # noqa: F811
    assert humanoid("do", "pick up the red cup", "--fast", "--run-dir", "a")[0] == 0
    anew()
    missed = failure("grasp_missed", "the fingers closed on air")
    runtime.planner.failures[PickRequest] = [missed]
    status, text = humanoid("replay", "a")
    assert status == 1
    assert "Not the same: event" in text
    assert re.search(r"recorded '.*', now '.*'", text)
    assert "report it with the run folder" in text


@pytest.mark.parametrize("at_s", [0.4, 2.0])
def test_a_stop_is_made_again_at_its_tick(runtime, humanoid, monkeypatch, anew, at_s):  # noqa: F811
    press(monkeypatch, runtime, at_s)
    assert humanoid("do", "walk two metres forward", "--fast", "--run-dir", "a")[0] == 1
    anew()
    status, text = humanoid("replay", "a")
    assert status == 0, text


def test_a_second_ctrl_c_is_made_again_at_its_tick(runtime, humanoid, monkeypatch, anew):  # noqa: F811
    press(monkeypatch, runtime, 2.0, 2.05)
    assert humanoid("do", "walk two metres forward", "--fast", "--run-dir", "a")[0] == 1
    anew()
    status, text = humanoid("replay", "a")
    assert status == 0, text


def test_a_run_that_was_cut_off_is_identical_as_far_as_it_goes(runtime, humanoid, anew):  # noqa: F811
    assert humanoid("do", "bring the red cup to the table", "--fast", "--run-dir", "a")[0] == 0
    whole = Path("a/journal.jsonl").read_bytes()
    Path("b").mkdir()
    Path("b/journal.jsonl").write_bytes(whole[: 2 * len(whole) // 3])
    anew()
    status, text = humanoid("replay", "b")
    assert status == 0, text
    assert "what there is of it (it was cut off)" in text


def test_what_cannot_repeat_is_refused(runtime, humanoid, anew):  # noqa: F811
    humanoid("do", "squat", "--run-dir", "fast", "--fast")
    live = Path("fast/journal.jsonl").read_text().replace('"runtime":"fast"', '"runtime":"live"')
    Path("live").mkdir()
    Path("live/journal.jsonl").write_text(live)
    status, text = humanoid("replay", "live")
    assert status == 2
    assert "it ran live" in text
    Path("gaps").mkdir()
    Path("gaps/journal.jsonl").write_text("\n".join(live.splitlines()[:3] + live.splitlines()[5:]))
    assert "events are missing" in humanoid("replay", "gaps")[1]
    Path("old").mkdir()
    Path("old/journal.jsonl").write_text(
        '{"event":"run","n":0,"t_s":0.0,"robot":"juno","runtime":"fast","seed":0,"text":"squat",'
        '"world":"kitchen"}\n'
    )
    assert "older version" in humanoid("replay", "old")[1]


def test_another_world_or_software_is_told(runtime, humanoid, anew):  # noqa: F811
    humanoid("do", "squat", "--run-dir", "a", "--fast")
    path = Path("a/journal.jsonl")
    first, *rest = path.read_text().splitlines()
    header = json.loads(first)
    header["origin"]["world"] = "0" * 16
    header["origin"]["versions"]["mujoco"] = "3.9"
    text = json.dumps(header, separators=(",", ":"), sort_keys=True)
    path.write_text("\n".join([text, *rest]) + "\n")
    anew()
    status, text = humanoid("replay", "a")
    assert status == 0, text
    assert "note: the world is another one" in text
    assert "note: mujoco was 3.9, is " in text


def operate(session: Session, where, script) -> None:
    """Run a session in which somebody asks for things from another thread at some ticks."""
    done = threading.Event()
    todo = list(script)

    def on_tick() -> None:
        now_s = session.runtime.clock.now_s()
        while todo and todo[0][0] <= now_s:
            _, ask = todo.pop(0)
            thread = threading.Thread(target=ask, args=(session,))
            thread.start()
            thread.join()

    session.on_tick(on_tick)
    session.run(until=lambda: not todo and session.executive.outcome is not None)
    done.set()


def test_what_a_person_asked_for_in_between_is_asked_for_again(runtime, humanoid, anew):  # noqa: F811
    where = mapped(None, "test")

    def understood(text: str) -> request.Understood:
        meant = request.request(text, where)
        assert isinstance(meant, request.Understood), meant
        return meant

    script = [
        (1.0, lambda s: s.executive.pause("a break")),
        (4.0, lambda s: s.executive.resume()),
        (5.0, lambda s: s.submit(understood("say hello"), urgent=True)),
        (6.0, lambda s: s.submit(understood("squat for two seconds"))),
        (6.0, lambda s: s.submit(understood("walk half a metre forward"))),
        (6.5, lambda s: s.executive.move(4, 0)),
        (7.0, lambda s: s.executive.cancel(3, "not that")),
        (8.0, lambda s: s.executive.break_at("walk*")),
        (30.0, lambda s: s.executive.go_on()),
        (31.0, lambda s: s.executive.stop("enough")),
    ]
    runtime = anew()
    with Session(Setup(where=where, folder=Path("a")), Opened(runtime, runtime.planner)) as session:
        session.begin("a morning")
        session.submit(understood("walk two metres forward"))
        operate(session, where, script)
    kinds = [json.loads(line) for line in Path("a/journal.jsonl").read_text().splitlines()]
    asked = [one["request"] for one in kinds if one["event"] == "request"]
    assert asked == [
        "submit", "pause", "resume", "submit", "submit", "submit", "move", "cancel", "break_at",
        "go_on", "stop",
    ]  # fmt: skip
    anew()
    status, text = humanoid("replay", "a")
    assert status == 0, text
