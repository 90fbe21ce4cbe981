"""A prompt before a robot of another process: quiet ones, slow ones, and stops that always go."""

from __future__ import annotations

import os
import random
import socket
import threading
from contextlib import contextmanager

import pytest

from executive.frontends.line_server import MOST_BEHIND, Client
from executive.frontends.prompt.plain import lines_until, work_off
from executive.frontends.service import messages as m
from executive.frontends.service.attach import RemoteShell
from executive.frontends.service.client import ANSWER_S, Connection, press
from executive.frontends.service.counter import ELSEWHERE, Counter
from executive.frontends.service.place import Running, claimed
from executive.frontends.service.pulse import QUIET_S, Pulse
from executive.frontends.service.remote_brake import AT_PROMPT
from executive.health import Level
from robot.clock import SimulatedClock
from robot.exit_status import ExitStatus
from tests.fakes.steered import Log, Told
from tests.fakes.waiting import HANG_S, eventually

RUNNING = Running(pid=1, run="r", private="", world="w", robot="juno", runtime="live")


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", "")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


class Prompt(RemoteShell):
    """One that notes what it says; its time passes when a test says so."""

    def __init__(self, place, *, waits=False):
        self.clock = SimulatedClock()
        self.said: list[str] = []
        self.warned: list[str] = []
        super().__init__(place, waits=waits, clock=self.clock)

    def out(self, text):
        self.said.append(text)

    def warn(self, text):
        self.warned.append(text)

    def be_quiet(self, for_s):
        """Let so much time pass, in looks as they are taken."""
        until_s = self.clock.now_s() + for_s
        while self.clock.now_s() < until_s:
            self.clock.set(min(until_s, self.clock.now_s() + 0.5))
            self.look(self.clock.now_s())


@contextmanager
def attached(place, *, waits=False):
    shell = Prompt(place, waits=waits)
    shell.connect()
    try:
        yield shell
    finally:
        shell.close()


@contextmanager
def robot():
    told = Told()
    with (
        claimed("kitchen") as place,
        Counter(told, place=place, running=RUNNING, log=Log()) as counter,
    ):
        yield told, place, counter


def test_how_long_a_request_may_take_says_nothing_of_how_long_nothing_may_come():
    with robot() as (_, place, _), Connection(place) as connection:
        connection.ask(m.Watch(), lambda _: None)
        assert connection._socket.gettimeout() is None


def test_a_quiet_connection_is_asked_for_a_word_and_lost_only_without_one():
    asked: list[float] = []
    pulse = Pulse(lambda: asked.append(1.0), now_s=0.0)
    assert not pulse.look(QUIET_S - 0.1) and not asked
    assert not pulse.look(QUIET_S) and len(asked) == 1
    assert not pulse.heard(QUIET_S + 0.1)
    begun_s = 2.0 * QUIET_S + 0.2
    assert not pulse.look(begun_s) and len(asked) == 2
    assert not pulse.look(begun_s + ANSWER_S - 0.1)
    assert pulse.look(begun_s + ANSWER_S + 0.1) and pulse.lost
    assert not pulse.look(begun_s + 2.0 * ANSWER_S)  # said once
    assert pulse.heard(100.0) and not pulse.lost


def test_a_robot_that_is_quiet_for_long_is_there_still():
    with robot() as (told, place, _), attached(place) as shell:
        shell.line("wave")
        for _ in range(5):
            shell.be_quiet(for_s=QUIET_S)
            assert eventually(lambda: shell._pulse._asked_s is None)  # it has answered
        assert not shell.warned
        shell.line("bow")
        assert told.did == ["wave (0)", "bow (0)"]


def test_one_that_does_not_answer_is_said_to_be_so_and_still_stopped(monkeypatch):
    with robot() as (told, place, counter), attached(place) as shell:
        monkeypatch.setattr(counter, "_wait", lambda *_: None)  # it answers no question any more
        shell.be_quiet(for_s=QUIET_S + ANSWER_S + 1.0)
        assert "does not answer" in shell.warned[0]
        assert shell.robot.view.level is Level.HOLD
        assert shell.at_work  # as far as is known
        shell.brake.stop("")
        shell.brake.settled()
        assert told.did == ["stop"]
        told.out("news")
        assert eventually(lambda: "kitchen answers again." in shell.said)


def test_a_stop_goes_by_a_connection_of_its_own_and_says_if_nobody_heard_it():
    with robot() as (told, place, _), attached(place) as shell:
        shell.send = lambda *_args, **_how: False  # the one that it has is of no use
        assert shell.stop_at_once("stop!")
        assert shell.stop_at_once("estop")
        shell.brake.settled()
        assert sorted(told.did) == ["estop", "stop"]
        assert not shell.brake.ask_no_more()  # Ctrl-C to a robot that seems to stand
        shell.brake.settled()
        assert told.did[-1] == "stop, unsaid"
        shell.place = place._replace(name="hall", folder=place.folder / "gone")
        shell.brake.stop("")
        shell.brake.settled()
        assert "Nobody has heard the stop" in shell.warned[-1]
        assert shell.status == ExitStatus.BROKEN


def test_a_job_is_told_where_the_stop_came_from():
    whys: list[str] = []
    with robot() as (told, place, _), attached(place) as shell:
        told.stop = whys.append
        for why in ("the operator pressed Ctrl-C", ""):
            shell.brake.stop(why)
            shell.brake.settled()
        press(place, "stop", lambda _: None)
    assert whys == ["the operator pressed Ctrl-C", AT_PROMPT, ELSEWHERE]


def test_a_line_that_waits_here_is_stopped_by_others_too():
    with robot() as (told, place, counter), attached(place) as shell:
        before = shell.brake.stops
        press(place, "stop", lambda _: None)
        assert eventually(lambda: shell.brake.stops != before)
        shell.line("typed before", stops=before)
        shell.line("typed after")
        assert told.did == ["stop", "typed after (1)"]
        with counter._telling:  # it was not told of this one yet
            press(place, "stop", lambda _: None)
            shell.line("typed before that")
    assert told.did[2:] == ["stop", "typed before that (1)"]  # a shell refuses it: 2 by then


def test_a_line_typed_after_a_stop_of_ones_own_is_done():
    with robot() as (told, place, _), attached(place) as shell:
        for n in range(20):
            shell.brake.stop("")
            shell.brake.stop("")
            shell.line(f"line {n}", stops=shell.brake.stops)
    lines = [one for one in told.did if one != "stop"]
    assert lines == [f"line {n} ({2 * n + 2})" for n in range(20)]


# --- lines from a pipe ---


class Ending(Told):
    """Its jobs are over at once."""

    def begin(self, text):
        super().begin(text)
        self.end(len(self.robot.jobs))


def piped(place, lines):
    """What comes of lines from a pipe: whether all were done, and the shell."""
    with attached(place, waits=True) as shell:
        return work_off(shell, lines), shell


def test_lines_from_a_pipe_are_dropped_after_a_stop_from_elsewhere_and_not_after_their_own():
    with robot() as (told, place, _):
        told.begin = Ending.begin.__get__(told)
        told.__class__ = Ending

        def lines():
            yield from ("walk", "stop", "estop", "wave")
            press(place, "stop", lambda _: None)
            yield "bow"
            yield "nod"
            yield "turn around"

        whole, shell = piped(place, lines())
    assert not whole
    assert [one.split(" (")[0] for one in told.did[:4]] == ["walk", "stop", "estop", "wave"]
    assert not any("nod" in one or "turn" in one for one in told.did)
    assert shell.said[-1].endswith("and what follows it: the robot was told to stop")
    assert "“bow”" in shell.said[-1] or "“nod”" in shell.said[-1]


def test_lines_from_a_pipe_are_dropped_by_a_stop_that_came_while_it_was_loaded():
    with robot() as (told, place, _):
        press(place, "stop", lambda _: None)  # after this process began
        with attached(place, waits=True) as shell:
            assert not work_off(shell, ["walk", "wave"], stops=0)
    assert told.did == ["stop"]
    assert shell.said[-1].startswith("Not done: “walk”")


def test_a_stop_during_a_line_drops_what_follows():
    with robot() as (told, place, _):
        done: list[bool] = []
        working = threading.Thread(target=lambda: done.append(piped(place, ["walk", "wave"])[0]))
        working.start()
        assert eventually(lambda: 1 in told.robot.jobs)
        press(place, "stop", lambda _: None)
        told.end(1, "cancelled", "cancelled")
        working.join()
    assert done == [False]
    assert told.did == ["walk (0)", "stop"]


def test_a_pipe_that_stays_open_ends_with_the_robot():
    reads, writes = os.pipe()
    with os.fdopen(reads, encoding="utf-8") as stream, claimed("kitchen") as place:
        made = Counter(Told(), place=place, running=RUNNING, log=Log())
        with attached(place, waits=True) as shell:
            shell.place = place._replace(folder=place.folder / "gone")
            made.close()
            assert work_off(shell, lines_until(stream, shell.is_over))
            assert shell.gone == "kitchen is up no more." and shell.leaving
    os.close(writes)


def test_a_line_from_a_pipe_outlives_a_connection_that_is_cut():
    with robot() as (told, place, counter), attached(place, waits=True) as shell:
        line = threading.Thread(target=lambda: shell.line("walk"))
        line.start()
        assert eventually(lambda: any(one.jobs for one in shell._pending.values()))
        for client in counter._server.clients:
            client.drop()
        assert eventually(lambda: any("listens again" in one for one in shell.said))
        assert line.is_alive()
        told.end(1, "failed", "no_path")
        line.join()
        assert shell.status == ExitStatus.FAILED


# --- who reads slowly ---


def test_who_reads_slowly_gets_every_line_and_the_newest_view_only():
    ours, theirs = socket.socketpair()
    with ours, theirs:
        ours.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4096)
        client = Client(ours)
        sent = [b"x" * 999 + b"%d\n" % n for n in range(500)]
        for line in sent:
            assert client.send(line)
            client.send(b"view %s\n" % line[-5:].strip(b"x\n"), supersedes=True)
        theirs.settimeout(HANG_S)
        reader = theirs.makefile("rb")
        read = []
        while not read or read[-1] != b"view 499\n":
            read.append(reader.readline())
        assert [one for one in read if not one.startswith(b"view")] == sent
        assert len(read) < 600
        assert eventually(lambda: not client._late)
        assert client.send(b"at once\n")
        assert reader.readline() == b"at once\n"


def test_who_never_reads_is_let_go_in_the_end():
    ours, theirs = socket.socketpair()
    with ours, theirs:
        client = Client(ours)
        while client.send(b"x" * (1 << 16)):
            assert client._behind_bytes <= MOST_BEHIND
        assert client._behind_bytes <= MOST_BEHIND + (1 << 16)


# --- tries ---

TRIES = 150


def test_whatever_goes_on_no_stop_typed_at_an_attached_prompt_is_lost():
    """Quiet times, cut connections, others who speak and stop: it acts all the same."""
    with claimed("kitchen") as place:
        for number in range(TRIES):
            _one_try(place, random.Random(number))


def _one_try(place, rng):
    told = Told()
    with (
        Counter(told, place=place, running=RUNNING, log=Log()) as counter,
        attached(place) as shell,
        Connection(place) as other,
    ):
        for _ in range(rng.randint(0, 6)):
            _something(rng, shell, other, counter, told)
        before = told.stops
        how = rng.choice((shell.brake.stop, shell.brake.stop_unsaid))
        if rng.random() < 0.3:
            shell.brake.ask_no_more()
        else:
            how("")
        shell.brake.settled()
        assert told.stops > before
        stops = told.stops
        shell.line("after it")
        assert told.did[-1] == f"after it ({stops})"
        assert not shell.gone and not shell.warned


def _something(rng, shell, other, counter, told):
    match rng.randrange(6):
        case 0:
            shell.be_quiet(for_s=rng.choice((1.0, QUIET_S, ANSWER_S)))
            assert eventually(lambda: shell._pulse._asked_s is None)
        case 1:
            shell.line("walk")
        case 2:
            told.out("said by somebody else " + "x" * rng.choice((10, 1000)))
        case 3:
            other.ask(m.Say(text="where are you?"), lambda _: None)
        case 4:
            other.ask(m.Press(button="stop"), lambda _: None)
        case _:
            for client in counter._server.clients:
                if rng.random() < 0.5 and client in counter._watching:
                    client.drop()
