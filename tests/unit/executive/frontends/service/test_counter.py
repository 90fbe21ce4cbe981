"""What other terminals ask for: a closed table, a stop first, and an end to every request."""

from __future__ import annotations

import json
import threading
from contextlib import suppress
from itertools import takewhile
from typing import get_args

import msgspec
import pytest

from executive.frontends.prompt.command import Command
from executive.frontends.service import counter as counters
from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service import views
from executive.frontends.service.client import Connection, Cut
from executive.frontends.service.counter import Counter
from executive.frontends.service.place import Running, claimed
from executive.frontends.since_boot import now_s
from robot.errors import RobotError
from robot.exit_status import ExitStatus
from robot.failures import Failure
from tests.fakes.steered import Log, Told
from tests.fakes.waiting import HANG_S, eventually


@pytest.fixture
def told():
    return Told()


@pytest.fixture
def log():
    return Log()


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", "")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    with claimed("kitchen") as made:
        yield made


@pytest.fixture
def counter(told, place, log):
    running = Running(pid=7, run="r", private="", world="w", robot="juno", runtime="live")
    with Counter(told, place=place, running=running, log=log) as made:
        yield made


def ask(place, request, *, heard=None):
    """What comes of a request: its end, and the words before it."""
    words: list[str] = []

    def hear(told):
        words.append(told.text if isinstance(told, m.Words) else told)

    with Connection(place) as connection:
        ended = connection.ask(request, heard.append if heard is not None else hear, wait_s=HANG_S)
    return ended, words


@pytest.mark.parametrize("asked", [{"afar": True}, {"spoken": True}])
@pytest.mark.parametrize("text", ["estop reset", "éstop reset", "\x1b[31mestop release"])
def test_who_may_not_see_the_robot_undoes_no_emergency_stop(counter, told, place, asked, text):
    ended, words = ask(place, m.Say(text=text, **asked))
    assert (ended.status, told.did) == (ExitStatus.INVALID, [])
    assert "at the robot" in words[0]


@pytest.mark.parametrize(
    ("button", "did"),
    [
        ("stop", "stop"),
        ("estop", "estop"),
        ("release", "estop release"),
        ("pause", "pause"),
        ("resume", "resume"),
        ("cancel", "cancel"),
    ],
)
def test_a_button_does_what_it_says(counter, told, place, button, did):
    ended, _ = ask(place, m.Press(button=button))
    assert (ended.status, told.did) == (ExitStatus.DONE, [did])


def test_every_button_is_known_and_what_cannot_be_is_said(counter, told, place):
    assert set(m.BUTTONS) == {"stop", "estop", "release", "reset", "pause", "resume", "cancel"}
    ended, words = ask(place, m.Press(button="reset"))
    assert (ended.status, words) == (ExitStatus.INVALID, ["Not done: it is pressed"])


def test_every_request_has_one_end(counter, told, place):
    told.go_on.set()
    for kind in get_args(m.Request):
        fields = {m.Press: {"button": "stop"}, m.Say: {"text": "go"}, m.Halt: {"text": "wait"}}
        request = kind(**fields.get(kind, {"jobs": ()} if kind is m.Await else {}))
        assert ask(place, request)[0].number == 1, kind


def test_a_velocity_is_walked_or_it_is_said_why_not(counter, told, place):
    teleoperation = told.robot.session.teleoperation
    asked = m.Drive(forward_m_s=0.2, turn_rad_s=-0.1)
    assert ask(place, asked)[0].status == ExitStatus.DONE
    assert teleoperation.told == [(0.2, 0.0, -0.1)]
    teleoperation.answer = "a task is under way: pause it first"
    ended, words = ask(place, asked)
    assert (ended.status, words) == (ExitStatus.FAILED, [f"Not driven: {teleoperation.answer}."])
    with pytest.raises(Cut), Connection(place) as connection:  # more than any robot does
        connection.ask(msgspec.structs.replace(asked, left_m_s=1e9), lambda _: None)
    assert len(teleoperation.told) == 2


def test_what_is_spoken_is_a_sentence_or_an_answer_and_no_command(counter, told, place):
    heard: list[str] = []
    told.hear = lambda text, stops: heard.append(text)
    told.help = lambda text: text == "continue"
    told.line = None
    for text in ("dump /tmp/x", "continue", "wave"):
        ask(place, m.Say(text=text, spoken=True))
    assert heard == ["dump /tmp/x", "wave"]
    ask(place, m.Say(text="stop", spoken=True))  # which is a stop however it is said
    assert told.did == ["stop"]


def test_a_stop_does_not_wait_for_a_line_that_is_worked_off(counter, told, place):
    told.go_on.clear()
    with Connection(place) as busy, Connection(place) as other:
        busy.send(m.Say(text="something long"))
        busy.send(m.Say(text="something after it"))
        assert eventually(lambda: counter._open_lines == 2)
        assert other.ask(m.Press(button="stop"), lambda _: None).status == ExitStatus.DONE
        assert told.did == ["stop"]
        other.ask(m.Say(text="stop"), lambda _: None)
        other.ask(m.Halt(text="wait"), lambda _: None)
        assert told.did == ["stop", "stop", "halt"]
        told.go_on.set()
        assert eventually(lambda: len(told.did) == 5)
    assert told.did[3:] == ["something long (0)", "something after it (0)"]  # from before the stop


@pytest.mark.parametrize(
    "junk",
    [
        b"\n",
        b"{\n",
        b"[]\n",
        b'{"ask":"dance"}\n',
        b'{"ask":"press","button":"rm"}\n',
        b'{"ask":"press","button":"stop","more":1}\n',
        b'{"ask":"say","text":5}\n',
        b'{"ask":"say","text":"' + b"x" * (m.MAX_TEXT + 1) + b'"}\n',
        b'{"ask":"await","jobs":"all"}\n',
        b"\xff\x00\n",
        b"[" * 5000 + b"\n",
        b"x" * (m.MAX_REQUEST + 1),
    ],
)
def test_who_speaks_otherwise_is_let_go_and_nothing_comes_of_it(counter, told, place, junk):
    with places.connect(place) as client:
        client.settimeout(HANG_S)
        client.sendall(junk)
        with suppress(ConnectionResetError):  # what it did not read is told so
            assert client.recv(1) == b""
    ask(place, m.Press(button="stop"))
    assert told.did == ["stop"]


def test_a_sentence_ends_at_once_or_when_its_job_is_over(counter, told, place):
    heard: list[m.Told] = []
    ended, _ = ask(place, m.Say(text="go to the table"), heard=heard)
    assert ended.status == ExitStatus.DONE
    assert heard == [m.Queued(number=1, jobs=(1,))]
    over: list[m.Ended] = []
    waiting = threading.Thread(
        target=lambda: over.append(ask(place, m.Say(text="bow", wait=True))[0])
    )
    waiting.start()
    assert eventually(lambda: 2 in told.robot.jobs)
    told.end(1)
    assert not over
    told.end(2)
    waiting.join()
    assert over[0].status == ExitStatus.DONE


@pytest.mark.parametrize(
    ("state", "code", "status"),
    [
        ("done", "", ExitStatus.DONE),
        ("failed", "no_path", ExitStatus.FAILED),
        ("cancelled", "cancelled", ExitStatus.FAILED),
        ("failed", "plant_lost", ExitStatus.BROKEN),
    ],
)
def test_who_waits_is_told_how_it_ended(counter, told, place, state, code, status):
    told.begin("something")
    told.end(1, state, code)
    assert ask(place, m.Await(jobs=(1,)))[0].status == status


def test_who_waited_for_an_executive_that_died_hears_it_of_the_next(counter, told, place):
    told.robot.ended_before = ((3, "done", "bow"), (4, "failed", "nod"))
    assert ask(place, m.Await(jobs=(3,)))[0].status == ExitStatus.DONE
    assert ask(place, m.Await(jobs=(3, 4)))[0].status == ExitStatus.FAILED
    assert ask(place, m.Await(jobs=(99,)))[0].status == ExitStatus.FAILED


def test_a_robot_that_is_lost_ends_all_waiting(counter, told, place):
    told.begin("something")
    told.robot.lost = Failure(code="plant_lost", cause="it is gone")
    assert ask(place, m.Await(jobs=(1,)))[0].status == ExitStatus.BROKEN


@pytest.mark.parametrize(
    ("text", "status", "answer"),
    [
        ("nonsense", ExitStatus.INVALID, "Not understood: nonsense"),
        ("the cup", ExitStatus.INVALID, "Which cup?"),
        ("where are you?", ExitStatus.DONE, "Here."),
        ("quit", ExitStatus.INVALID, counters.NOT_LEFT),
        ("stop", ExitStatus.DONE, "Stopping."),
    ],
)
def test_what_comes_of_a_line_is_its_status(counter, told, place, text, status, answer):
    ended, words = ask(place, m.Say(text=text, wait=True))
    assert (ended.status, words) == (status, [answer])


def test_who_is_asked_back_in_the_same_words_is_not_told_that_it_was_taken(counter, told, place):
    for _ in range(3):
        assert ask(place, m.Say(text="the cup"))[0].status == ExitStatus.INVALID
    assert ask(place, m.Say(text="where are you?"))[0].status == ExitStatus.DONE  # and it is open


def test_who_asks_what_quit_does_is_told_that_it_leaves_the_robot_at_work(told, place, log):
    quits = []
    told.commands = {
        name: Command(name=name, usage=name, summary="stop, and leave", run=quits.append)
        for name in counters.LEAVING
    }
    running = Running(pid=7, run="r", private="", world="w", robot="juno", runtime="live")
    with Counter(told, place=place, running=running, log=log), Connection(place) as connection:
        connection.send(m.Watch())
        hello = next(
            one for one in map(views.told, connection.lines()) if isinstance(one, views.Hello)
        )
        for command in told.commands.values():
            command.run("")
    assert {row.name: row.summary for row in hello.commands} == dict.fromkeys(
        counters.LEAVING, counters.LEAVES
    )
    assert (quits, told.said) == ([], [counters.NOT_LEFT] * 2)


def test_an_open_question_makes_no_failure_of_what_is_asked_beside_it(counter, told, place):
    ask(place, m.Say(text="the cup"))
    assert ask(place, m.Say(text="where are you?"))[0].status == ExitStatus.DONE


def test_a_mistake_in_this_software_ends_no_robot(counter, told, place):
    ended, words = ask(place, m.Say(text="a mistake"))
    assert ended.status == ExitStatus.BROKEN
    assert "a mistake of this software" in words[0]
    assert ask(place, m.Press(button="stop"))[0].status == ExitStatus.DONE


def test_more_lines_than_anybody_types_are_refused_and_a_stop_is_not(counter, told, place):
    told.go_on.clear()
    refused: list[int] = []
    with Connection(place) as connection:
        for number in range(counters.MOST_LINES + 20):
            connection.send(m.Say(text=f"line {number}"))
        ended = connection.ask(
            m.Press(button="stop"),
            lambda told: refused.append(told.status) if isinstance(told, m.Ended) else None,
        )
        assert ended.status == ExitStatus.DONE
    assert refused == [ExitStatus.INVALID] * 20
    told.go_on.set()


def test_words_go_to_who_asked_and_to_who_watches_once_each(counter, told, place, log):
    with Connection(place) as watcher, Connection(place) as other:
        first = watcher.ask(m.Watch(), lambda _: None)
        assert first.status == ExitStatus.DONE
        other.ask(m.Status(), lambda _: None)  # aside: nobody else wants to read it
        other.ask(m.Say(text="where are you?"), lambda _: None)
        watcher.send(m.Say(text="where are you?"))
        until_over = takewhile(lambda one: not isinstance(one, m.Ended), watcher.told())
        heard = [told.text for told in until_over if isinstance(told, m.Words)]
    assert heard == ["(shell) > where are you?", "Here.", "Here."]
    assert log.lines.count("Here.") == 2
    assert "of status" not in log.lines


def test_a_prompt_is_told_what_it_needs_before_anything_else(counter, told, place):
    told.out("said before")
    told.asked = ("Which cup?", ("the red one",))
    assert eventually(lambda: counter._asks.question)
    with Connection(place) as connection:
        connection.send(m.Watch(views=True))
        lines = (views.told(line) for line in connection.lines(wait_s=HANG_S))
        found = [next(lines) for _ in range(6)]
    kinds = [type(one).__name__ for one in found]
    assert kinds == ["Hello", "Words", "Seen", "Asks", "Stopped", "Ended"]
    assert found[0].world == "w"
    assert found[1].text == "said before"
    assert found[3].choices == ("the red one",)


def test_status_for_programs_is_all_there(counter, told, place):
    told.begin("bow")
    told.asked = ("Which cup?", ())
    ended, words = ask(place, m.Status())
    assert words == ["of status"]
    found = json.loads(msgspec.json.encode(ended.standing))
    assert found["name"] == "kitchen" and found["pid"] == 7 and found["asks"] == "Which cup?"
    assert found["jobs"] == [{"number": 1, "state": "running", "text": "bow", "urgent": False}]


def test_down_comes_to_a_stand_first(counter, told, place):
    ask(place, m.Down())
    assert told.did == ["stop"]
    assert counter.left.is_set()


def test_a_counter_that_is_closed_lets_nobody_wait(told, place, log):
    running = Running(pid=7, run="r", private="", world="w", robot="juno", runtime="live")
    out = told.out
    told.begin("something")
    made = Counter(told, place=place, running=running, log=log)
    with made, Connection(place) as connection:
        number = connection.send(m.Await(jobs=(1,)))
        connection.ask(m.Status(), lambda _: None)
        made.close()
        ended = [one for one in connection.told() if isinstance(one, m.Ended)]
    assert [(one.number, one.status) for one in ended] == [(number, ExitStatus.FAILED)]
    assert told.out == out


def test_the_counter_of_an_executive_that_died_is_taken_over(counter, told, place, log):
    running = Running(pid=7, run="r", private="", world="w", robot="juno", runtime="live")
    other = Told()
    with Connection(place) as before:
        with Counter(other, place=place, running=running, log=log):
            ask(place, m.Press(button="stop"))
        before.ask(m.Status(), lambda _: None)  # the first one is not dead here
    assert (told.did, other.did) == (["status"], ["stop"])
    with pytest.raises((Cut, RobotError)):
        Connection(place, patience_s=0.05)


def test_a_stop_is_about_what_was_asked_for_before_it_and_arrived_after_it(counter, told, place):
    before_s = now_s()
    ask(place, m.Press(button="stop"))
    after_s = now_s()
    ask(place, m.Say(text="turn", begun_s=before_s))  # by a process that was still loaded then
    ask(place, m.Say(text="wave", begun_s=after_s))
    ask(place, m.Say(text="bow"))
    assert told.did == ["stop", "turn (0)", "wave (1)", "bow (1)"]


def test_what_a_stop_has_dropped_has_failed_and_was_understood(counter, told, place):
    def dropped(text, *, stops, afar):
        told.refused += 1

    told.line = dropped
    before_s = now_s()
    ask(place, m.Press(button="stop"))
    ended, _ = ask(place, m.Say(text="turn", begun_s=before_s))
    assert ended.status == ExitStatus.FAILED


def test_a_prompt_is_told_of_stops_while_it_was_loaded(counter, told, place):
    before_s = now_s()
    ask(place, m.Press(button="stop"))
    with Connection(place) as connection:
        connection.send(m.Watch(views=True, begun_s=before_s))
        hello = next(iter(connection.lines(wait_s=HANG_S)))
    known = views.told(hello)
    assert isinstance(known, views.Hello)
    assert (known.stops, known.stops_begun) == (1, 0)


def test_who_waits_for_too_much_is_refused_and_costs_nothing(counter, told, place):
    told.begin("something")
    with Connection(place) as connection:
        numbers = [connection.send(m.Await(jobs=(1,))) for _ in range(counters.MOST_WAITS + 1)]
        ended = next(one for one in connection.told() if isinstance(one, m.Ended))
    assert (ended.number, ended.status) == (numbers[-1], ExitStatus.INVALID)
    with pytest.raises(Cut), Connection(place) as connection:
        connection.ask(m.Await(jobs=(1,) * (m.MOST_JOBS + 1)), lambda _: None)


def test_who_waited_and_went_is_forgotten(counter, told, place):
    told.begin("something")
    for _ in range(3):
        with Connection(place) as connection:
            connection.send(m.Await(jobs=(1,)))
            connection.ask(m.Status(), lambda _: None)
    assert eventually(lambda: not counter._waits)
