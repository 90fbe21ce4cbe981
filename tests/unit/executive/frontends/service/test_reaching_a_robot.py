"""The other terminal's end: a stop is not lost to whatever becomes of the executive."""

from __future__ import annotations

import threading
from contextlib import contextmanager

import pytest

from executive.frontends import cli
from executive.frontends.service import attach as attaching
from executive.frontends.service import client as clients
from executive.frontends.service import commands, quick, stopping
from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service.attach import RemoteShell
from executive.frontends.service.counter import Counter
from executive.frontends.service.place import Running, claimed
from robot.bringup import flags, mailbox
from robot.errors import ConfigError
from robot.exit_status import ExitStatus
from tests.fakes.steered import Log, Told
from tests.fakes.waiting import HANG_S, eventually


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", "")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setattr(attaching, "say", lambda text, err=False, styled=None: None)
    return tmp_path


def running(private=""):
    return Running(pid=1, run="r", private=str(private), world="w", robot="juno", runtime="live")


def died_once(home):
    """The private folder of a robot whose first executive is gone."""
    private = home / "private"
    private.mkdir()
    flags.make(private)
    front = mailbox.Front(entry="service", options={}, deaths=1)
    mailbox.save(private / mailbox.FRONT_FILE, front)
    return private


@contextmanager
def counter(told, place, private=""):
    with Counter(told, place=place, running=running(private), log=Log()) as made:
        yield made


def test_a_stop_is_left_for_an_executive_that_takes_over_and_said_to_it(home, monkeypatch):
    private = died_once(home)
    looking, leave = threading.Lock(), mailbox.leave_stop_for_next

    def leave_whole(folder):
        with looking:  # who left it as the next one began to hear would need a launcher
            leave(folder)

    monkeypatch.setattr(mailbox, "leave_stop_for_next", leave_whole)
    with claimed("kitchen") as place:
        places.listen(place, running(private), backlog=1).close()  # that one has died
        done: list[int] = []
        pressing = threading.Thread(
            target=lambda: done.append(clients.press(place, "stop", lambda _: None).status)
        )
        pressing.start()
        assert eventually(lambda: flags.find(private).take_stop())
        with looking:
            flags.find(private).say_it_hears(1)  # the next one hears people itself
            flags.find(private).take_stop()
        told = Told()
        with counter(told, place, private):
            pressing.join()
        assert (done, told.did) == ([ExitStatus.DONE], ["stop"])
        assert not flags.find(private).take_stop()  # nothing is left that would stop a later one


def test_other_buttons_are_not_left_for_anybody(home):
    private = died_once(home)
    with claimed("kitchen") as place:
        places.listen(place, running(private), backlog=1).close()
        pressing = threading.Thread(target=lambda: clients.press(place, "resume", lambda _: None))
        pressing.start()
        told = Told()
        with counter(told, place, private):
            pressing.join()
        assert told.did == ["resume"]
        assert not flags.find(private).take_stop()


def test_a_stop_without_a_name_stops_all(capsys):
    first, second = Told(), Told()
    with (
        claimed("hall") as hall, claimed("kitchen") as kitchen,
        counter(first, hall), counter(second, kitchen),
    ):  # fmt: skip
        assert quick.run(["stop"]) == ExitStatus.DONE
        assert (first.did, second.did) == (["stop"], ["stop"])
        assert quick.run(["estop", "--name", "hall"]) == ExitStatus.DONE
        assert (first.did, second.did) == (["stop", "estop"], ["stop"])
    assert capsys.readouterr().out.splitlines()[:2] == ["hall: Stopping.", "kitchen: Stopping."]


def test_one_that_does_not_answer_keeps_no_other_from_being_stopped(monkeypatch, capsys):
    ask = clients.Connection.ask

    def impatient(self, request, hear):
        return ask(self, request, hear, wait_s=0.05 if self.place.name == "hall" else HANG_S)

    monkeypatch.setattr(clients.Connection, "ask", impatient)
    told = Told()
    with (
        claimed("hall") as hall, claimed("kitchen") as kitchen, counter(told, kitchen),
        places.listen(hall, running(), backlog=4),  # accepts nobody
    ):  # fmt: skip
        done = {one.name: one.status for one in stopping.stop_all(None, "stop")}
    assert done == {"hall": ExitStatus.BROKEN, "kitchen": ExitStatus.DONE}
    assert told.did == ["stop"]


def test_where_nobody_is_up_a_stop_says_so(capsys):
    assert quick.run(["stop"]) == ExitStatus.INVALID
    told = capsys.readouterr().err
    assert "no robot is up" in told
    assert told.endswith("Nothing was stopped.\n")
    with pytest.raises(ConfigError):
        commands.status(None, as_json=False)


@pytest.mark.parametrize(
    ("line", "meant"),
    [
        ("stop", True),
        ("estop", True),
        ("stop --name kitchen", True),
        ("stop --help", False),
        ("estop release", False),
        ("estop reset --name kitchen", False),
        ("do stop", False),
        ("", False),
        ("stop now", True),
        ("stop please", True),
        ("stop robot", True),
        ("stop --all", True),
        ("stop --nmae kitchen", True),
        ("STOP", True),
        ("Stop!", True),
        ("halt", True),
        ("estop now", True),
        ("e-stop", True),
        ("estop press", True),
        ("stopover", False),
    ],
)
def test_what_is_no_more_than_a_stop_takes_the_short_way(line, meant):
    assert quick.is_meant(line.split()) == meant


@pytest.mark.parametrize(
    ("line", "did"),
    [("stop now", "stop"), ("stop --all", "stop"), ("HALT", "stop"), ("stop --name", "stop"),
     ("estop now", "estop"), ("E-STOP the arm", "estop")],
)  # fmt: skip
def test_whatever_is_said_along_with_a_stop_it_stops_and_then_complains(line, did, capsys):
    first, second = Told(), Told()
    words = line.split()
    with (
        claimed("hall") as hall, claimed("robot") as robot,
        counter(first, hall), counter(second, robot),
    ):  # fmt: skip
        assert quick.run(words) == ExitStatus.DONE
    assert (first.did, second.did) == ([did], [did])
    told = capsys.readouterr().err
    assert not words[1:] or f"“{' '.join(words[1:])}” means nothing here" in told


def test_a_robot_of_a_name_that_is_not_up_is_said_and_that_nothing_was_stopped(capsys):
    told = Told()
    with claimed("hall") as hall, counter(told, hall):
        assert quick.run(["stop", "--name", "hell"]) == ExitStatus.INVALID
    assert told.did == []
    assert capsys.readouterr().err.endswith("Nothing was stopped.\n")


def test_a_cry_that_is_no_command_stops(monkeypatch, capsys):
    told = Told()
    monkeypatch.setattr("sys.argv", ["humanoid", "freeze!"])
    with claimed("hall") as hall, counter(told, hall), pytest.raises(SystemExit) as ended:
        cli.main()
    assert (ended.value.code, told.did) == (ExitStatus.DONE, ["stop"])
    assert not quick.is_cried(["do", "stop"], ["do"])
    assert not quick.is_cried(["dump"], ["do"])


# --- a prompt from elsewhere ---


@contextmanager
def attached(place, *, waits=False):
    shell = RemoteShell(place, waits=waits)
    said: list[str] = []
    shell.out = said.append  # type: ignore[method-assign]
    shell.connect()
    try:
        yield shell, said
    finally:
        shell.close()


def test_an_attached_prompt_speaks_and_stops_and_leaves_the_robot_as_it_is():
    told = Told()
    with claimed("kitchen") as place, counter(told, place) as made:
        with attached(place) as (shell, said):
            shell.line("go to the table")
            assert told.did == ["go to the table (0)"]
            assert eventually(lambda: shell.robot.busy)
            assert shell.stop_at_once("stop!") and shell.brake.stops == 1
            assert eventually(lambda: told.did[1:] == ["stop"])
            shell.line("typed before", stops=0)
            assert said[-1] == "Not done: “typed before” was there when you said stop"
            assert shell.halt_at_once("wait", busy=True)
            assert eventually(lambda: told.did[2:] == ["halt"])
            assert shell.stop_at_once("estop")
            assert eventually(lambda: told.did[3:] == ["estop"])
            told.asked = ("Which cup?", ("the red one",))
            assert eventually(lambda: shell.asks.question == "Which cup?")
            shell.leave()
        assert not made.left.is_set()
        assert told.robot.busy


def test_an_attached_prompt_stays_when_another_executive_takes_over():
    first, second = Told(), Told()
    with claimed("kitchen") as place:
        one = Counter(first, place=place, running=running(), log=Log())
        with attached(place) as (shell, said):
            one._server.close()  # as it is when the process is killed
            assert eventually(lambda: shell._connection is None)
            shell.brake.stop_unsaid("")
            with counter(second, place):
                assert eventually(lambda: second.did == ["stop"])
                shell.line("go on")
                assert second.did[1] == "go on (1)"
            assert any("listens again" in line for line in said)
        one.close()


def test_an_attached_prompt_is_told_when_the_robot_is_down():
    with claimed("kitchen") as place:
        made = Counter(Told(), place=place, running=running(), log=Log())
        with attached(place) as (shell, _):
            shell.place = place._replace(folder=place.folder / "gone")
            made.close()
            assert eventually(lambda: shell.gone)
            shell.line("hello?")
            assert shell.status == ExitStatus.BROKEN


def test_lines_from_a_pipe_wait_for_what_comes_of_them_and_keep_the_worst_end():
    told = Told()
    with claimed("kitchen") as place, counter(told, place), attached(place, waits=True) as one:
        shell, _ = one
        line = threading.Thread(target=lambda: shell.line("bow"))
        line.start()
        assert eventually(lambda: 1 in told.robot.jobs)
        assert line.is_alive()
        told.end(1, "failed", "no_path")
        line.join()
        assert shell.status == ExitStatus.FAILED
        shell.line("where are you?")
        assert shell.status == ExitStatus.FAILED
        shell.line("quit")
        assert shell.leaving
        assert told.did == ["bow (0)", "where are you? (0)"]


def test_what_cannot_be_decoded_is_passed_over():
    assert m.told(b'{"tell":"words","text":"x"}').text == "x"


def test_a_cry_that_is_said_is_left_for_an_executive_that_takes_over(home):
    private = died_once(home)
    with claimed("kitchen") as place:
        places.listen(place, running(private), backlog=1).close()  # that one has died
        saying = threading.Thread(
            target=lambda: commands.say_line("kitchen", "Stop!", wait=False, as_json=True)
        )
        saying.start()
        assert eventually(lambda: flags.find(private).take_stop())
        flags.find(private).say_it_hears(1)
        with counter(Told(), place, private):
            saying.join()


def test_a_cry_in_a_text_that_is_too_long_is_heard(home):
    told = Told()
    with claimed("kitchen") as place, counter(told, place):
        commands.say_line("kitchen", f"Stop! {'a ' * m.MAX_TEXT}", wait=False, as_json=True)
    assert told.did == ["stop"]


def test_one_that_hangs_with_a_full_backlog_keeps_nobody_waiting(home, monkeypatch):
    monkeypatch.setattr(clients, "ANSWER_S", 0.2)
    with claimed("kitchen") as place, places.listen(place, running(), backlog=0):
        waiting = [places.connect(place, wait_s=1.0)]
        with pytest.raises(clients.Silent, match="kitchen"):
            for _ in range(3):
                waiting.append(clients.Connection(place))
        for one in waiting:
            one.close()


def test_robots_of_one_name_in_two_folders_are_both_stopped(home, monkeypatch):
    first, second = Told(), Told()
    with claimed("kitchen") as place, counter(first, place):
        monkeypatch.setenv("XDG_RUNTIME_DIR", str(home))
        with claimed("hall") as other, counter(second, other):
            both = [place, other._replace(name="kitchen")]
            monkeypatch.setattr(places, "places_up", lambda: both)
            done = stopping.stop_all("kitchen", "stop")
    assert [one.status for one in done] == [ExitStatus.DONE, ExitStatus.DONE]
    assert (first.did, second.did) == (["stop"], ["stop"])


@pytest.mark.parametrize("text", ["", " ", "\t\n"])
def test_a_line_of_nothing_is_refused_with_a_word(text):
    with pytest.raises(ConfigError, match="nothing was said"):
        commands.say_line(None, text, wait=False, as_json=False)
