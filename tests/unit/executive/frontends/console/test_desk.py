"""Orders from pages: a stop first, whatever else comes, and no client holds anybody up."""

from __future__ import annotations

import json
import socket
import threading
import time
from pathlib import Path

import pytest

from executive.frontends.console import desk as desks
from executive.frontends.console.desk import FILE, Desk
from executive.frontends.emergency import AT_THE_ROBOT
from executive.frontends.reading_back import heard_risk
from executive.frontends.since_boot import now_s
from intents.goals import GoTo, Wait
from tests.fakes.steered import Told
from tests.fakes.waiting import HANG_S

POLL_S = 0.005


class Quiet(Told):
    """It does what buttons say without a word."""

    def command(self, name):
        self.did.append(name)


def until(so, what=""):
    limit_s = time.monotonic() + HANG_S
    while not so():
        assert time.monotonic() < limit_s, what
        time.sleep(POLL_S)


class Client:
    """A console's end."""

    def __init__(self, folder: Path):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(HANG_S)
        self.socket.connect(json.loads((folder / FILE).read_text())["socket"])
        self.reader = self.socket.makefile("rb")
        assert "asks" in self.next()

    def next(self) -> dict:
        line = self.reader.readline()
        if not line:
            raise EOFError
        return json.loads(line)

    def order(self, **order):
        self.socket.sendall(json.dumps(order).encode() + b"\n")


@pytest.fixture
def folder(tmp_path):
    return tmp_path


@pytest.fixture
def told():
    return Quiet()


@pytest.fixture
def desk(told, folder):
    private = folder / "private"
    private.mkdir()
    with Desk(told, folder=folder, private=private) as made:
        yield made


def test_buttons_and_lines_do_what_they_say(desk, told, folder):
    client = Client(folder)
    for button in ("pause", "resume", "cancel", "estop", "release", "stop"):
        client.order(do=button)
    client.order(line="go to the table")
    until(lambda: "go to the table (1)" in told.did)
    assert told.did[:6] == ["pause", "resume", "cancel", "estop", "estop release", "stop"]
    assert client.next() == {"out": "Stopping."}
    assert client.next() == {"you": "go to the table"}


def test_a_stop_does_not_wait_for_a_line_that_is_worked_off(desk, told, folder):
    client = Client(folder)
    told.go_on.clear()
    client.order(line="something long")
    client.order(line="something after it")
    client.order(line="stop")
    until(lambda: told.did == ["stop"])
    client.order(line="wait")
    until(lambda: told.did == ["stop", "halt"])
    told.go_on.set()
    until(lambda: len(told.did) == 5)
    assert told.did[2:4] == ["something long (0)", "something after it (0)"]  # before the stop


def test_what_makes_no_sense_ends_nothing(desk, told, folder):
    client = Client(folder)
    junk = (
        b"",
        b"{",
        b"[]",
        b'{"do": 5}',
        b'{"run": "rm"}',
        b"\xff\x00",
        b"[" * 5000,
    )
    client.socket.sendall(b"\n".join(junk) + b"\n")
    client.order(do="dance")
    client.order(do="reset")
    client.order(line="a mistake")
    client.order(line="quit")
    client.order(do="stop")
    until(lambda: "stop" in told.did)
    until(lambda: any("a mistake of this software" in one for one in told.said))
    assert "Not done: it is pressed" in told.said
    assert any("terminal" in one for one in told.said)  # a page does not end the prompt
    assert [one for one in told.did if one.startswith(("quit", "dance"))] == []


def test_a_line_without_an_end_ends_a_connection_and_no_other(desk, told, folder):
    endless, other = Client(folder), Client(folder)
    endless.socket.sendall(b"x" * desks.MAX_ORDER)
    with pytest.raises((EOFError, OSError)):
        endless.next()
    other.order(do="stop")
    until(lambda: told.stops == 1)


def test_more_lines_than_anybody_types_are_refused_and_a_stop_is_not(desk, told, folder):
    client = Client(folder)
    told.go_on.clear()
    for number in range(desks.MOST_LINES + 20):
        client.order(line=f"line {number}")
    client.order(do="stop")
    until(lambda: told.stops == 1)
    refused = lambda: sum("Too many lines" in one for one in told.said)  # noqa: E731
    until(lambda: refused() >= 20)  # what is said goes by a thread of its own
    assert refused() == 20
    told.go_on.set()


def test_who_does_not_read_is_let_go_and_others_are_told(desk, told, folder):
    slow, other = Client(folder), Client(folder)
    heard: list[str] = []

    def read():
        while True:
            try:
                heard.append(other.next().get("out", ""))
            except (EOFError, OSError):
                return

    threading.Thread(target=read, daemon=True).start()
    for number in range(3000):  # more than a socket holds
        told.out(f"{number} " + "x" * 1000)
        while len(heard) < number - 50:
            time.sleep(POLL_S)
    until(lambda: len(heard) == 3000)
    with pytest.raises(EOFError):
        while True:
            slow.next()
    Client(folder).order(do="stop")
    until(lambda: told.stops == 1)


def test_what_is_asked_is_told_when_it_changes(desk, told, folder):
    client = Client(folder)
    told.asked = ("Which cup?", ("the red one", "the blue one"))
    assert client.next() == {
        "asks": {"question": "Which cup?", "choices": ["the red one", "the blue one"]}
    }
    told.asked = None
    assert client.next() == {"asks": None}


def test_a_desk_that_is_closed_leaves_nothing(told, folder):
    private = folder / "private"
    private.mkdir()
    out = told.out
    with Desk(told, folder=folder, private=private):
        found = (folder / FILE).stat()
        assert found.st_mode & 0o077 == 0
        Client(folder)
    assert told.out == out
    assert not (folder / FILE).exists() and not [*private.iterdir()]


def test_a_line_that_comes_as_the_run_ends_is_no_mistake(told, folder):
    private = folder / "private"
    private.mkdir()
    with Desk(told, folder=folder, private=private) as desk:
        pass
    desk._heed(desks.Order(line="wave"))
    assert not any("mistake" in line for line in told.said)


def test_the_desk_of_an_executive_that_died_is_taken_over(told, folder):
    private = folder / "private"
    private.mkdir()
    first = Desk(told, folder=folder, private=private)
    first._server.close()  # as a killed process leaves it
    with Desk(told, folder=folder, private=private):
        Client(folder).order(do="stop")
        until(lambda: told.stops == 1)


def test_a_terminal_that_shows_nothing_any_more_keeps_no_stop_back(told, folder):
    shown = threading.Event()
    told.out = lambda _: shown.wait(HANG_S)
    private = folder / "private"
    private.mkdir()
    with Desk(told, folder=folder, private=private):
        client = Client(folder)
        client.order(line="go to the table")
        client.order(line="stop")
        until(lambda: "stop" in told.did)
        client.order(do="stop")
        until(lambda: told.did.count("stop") == 2)
        shown.set()


def test_a_stop_is_heard_in_a_line_that_is_too_long(desk, told, folder, monkeypatch):
    monkeypatch.setattr(told, "stop_at_once", lambda text: told.did.append(text[-4:]) or True)
    Client(folder).order(line=f"{'and ' * desks.MAX_LINE}"[: desks.MAX_ORDER // 2] + "stop")
    until(lambda: told.did == ["stop"])


def test_a_stop_overtakes_what_was_said_before_it(desk, told, folder):
    """Stops have a connection of their own; what a page said before them arrives after them."""
    lines, stops = Client(folder), Client(folder)
    before_s = now_s()
    stops.order(do="stop", begun_s=now_s())
    until(lambda: told.stops == 1)
    lines.order(line="go to the table", begun_s=before_s)
    lines.order(line="go to the shelf", begun_s=now_s())
    until(lambda: "go to the shelf (1)" in told.did)
    assert told.did == ["stop", "go to the table (0)", "go to the shelf (1)"]  # (0): not read


@pytest.mark.parametrize("button", ["release", "reset", "resume"])
def test_a_stop_has_the_last_word_over_a_button_that_lets_the_robot_go_on(
    desk, told, folder, button
):
    lines, stops = Client(folder), Client(folder)
    before_s = now_s()
    stops.order(do="stop", begun_s=now_s())
    until(lambda: told.stops == 1)
    lines.order(do=button, begun_s=before_s)
    if button != "resume":
        lines.order(line=f"estop {button}", begun_s=before_s)
    lines.order(do="pause")
    until(lambda: "pause" in told.did)
    assert not any(button in one for one in told.did if not one.endswith("(0)"))
    assert any(f"{button} was pressed before" in one for one in told.said)


def test_what_is_said_into_a_page_is_a_sentence_and_read_back(desk, told, folder):
    client = Client(folder)
    client.order(heard="go to the table", sure=True)
    until(lambda: "go to the table (0)" in told.did)
    assert told.read_back == [heard_risk]
    client.order(heard="go to the shelf", sure=False, doubtful=["shelf"])
    until(lambda: "go to the shelf (0)" in told.did)
    risk = told.read_back[1]
    assert "“shelf”" in risk((GoTo(place="shelf"),))
    assert not risk((Wait(duration_s=1.0),))


def test_a_cry_into_a_page_stops_and_no_emergency_stop_is_undone_by_one(desk, told, folder):
    client = Client(folder)
    client.order(heard="stop")
    until(lambda: told.did == ["stop"])
    client.order(heard="estop reset")
    client.order(heard="wait")
    until(lambda: "halt" in told.did)
    assert "estop reset" not in told.did
    assert AT_THE_ROBOT in told.said


def test_what_was_not_heard_well_answers_no_question(desk, told, folder):
    told.asked = ("Which cup?", ("the red one", "the blue one"))
    client = Client(folder)
    client.order(heard="the blue one", sure=False)
    until(lambda: any("say it again" in text for text in told.said))
    assert told.did == []
    client.order(heard="the blue one")
    until(lambda: told.did == ["the blue one (0)"])


def test_what_was_said_before_a_stop_comes_to_nothing(desk, told, folder):
    begun_s = now_s()
    client = Client(folder)
    client.order(do="stop")
    until(lambda: told.stops == 1)
    client.order(heard="go to the table", begun_s=begun_s)
    until(lambda: "go to the table (0)" in told.did)  # said when there had been no stop
