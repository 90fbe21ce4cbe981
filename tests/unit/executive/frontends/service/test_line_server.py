"""A server of lines: whoever is connected, and whatever they send, it goes on."""

from __future__ import annotations

import errno
import socket
import threading

import pytest

from executive.frontends.line_server import LineServer
from tests.fakes.waiting import HANG_S, eventually

LONGEST = 1000


class Served:
    """A server that notes what it hears."""

    def __init__(self, path, *, most_clients=3):
        self.heard: list[bytes] = []
        self.gone = 0
        self.welcome = True
        self.blocked = threading.Event()
        listening = socket.socket(socket.AF_UNIX)
        listening.bind(str(path))
        listening.listen(8)
        self.path = path
        self.server = LineServer(
            listening,
            heed=self._heed,
            is_welcome=lambda _: self.welcome,
            gone=self._left,
            most_clients=most_clients,
            longest=LONGEST,
        )

    def _heed(self, client, line):
        if line == b"hang\n":
            self.blocked.wait(HANG_S)
        self.heard.append(line)
        client.send(b"heard " + line)

    def _left(self, client):
        self.gone += 1

    def client(self):
        made = socket.socket(socket.AF_UNIX)
        made.settimeout(HANG_S)
        made.connect(str(self.path))
        return made


@pytest.fixture
def served(tmp_path):
    made = Served(tmp_path / "s")
    with made.server:
        yield made


def test_a_line_is_heard_however_it_is_cut(served):
    client = served.client()
    for piece in (b"a li", b"ne\nand an", b"other\n"):
        client.sendall(piece)
    assert eventually(lambda: len(served.heard) == 2)
    assert served.heard == [b"a line\n", b"and another\n"]


def test_half_a_line_is_none(served):
    client = served.client()
    client.sendall(b"sto")
    client.close()
    assert eventually(lambda: served.gone == 1)
    assert served.heard == []


def test_a_line_without_an_end_ends_the_connection(served):
    client = served.client()
    client.sendall(b"x" * (LONGEST + 1))
    assert client.recv(1) == b""
    assert served.heard == []


def test_one_that_hangs_keeps_no_other(served):
    hanging, other = served.client(), served.client()
    hanging.sendall(b"hang\n")
    other.sendall(b"stop\n")
    assert eventually(lambda: served.heard == [b"stop\n"])
    served.blocked.set()


def test_who_was_silent_longest_makes_room(served):
    first, second, third = served.client(), served.client(), served.client()
    assert eventually(lambda: len(served.server.clients) == 3)
    first.sendall(b"I am here\n")
    assert eventually(lambda: len(served.heard) == 1)
    fourth = served.client()
    fourth.sendall(b"stop\n")
    assert eventually(lambda: b"stop\n" in served.heard)
    assert second.recv(100) == b""
    third.sendall(b"so am I\n")
    first.sendall(b"still\n")
    assert eventually(lambda: {b"so am I\n", b"still\n"} <= set(served.heard))


def test_who_is_not_welcome_is_not_heard(served):
    served.welcome = False
    client = served.client()
    with pytest.raises((ConnectionError, BrokenPipeError)):
        client.sendall(b"stop\n")
        if client.recv(1) == b"":
            raise ConnectionError
    assert served.heard == []


def test_who_does_not_read_is_let_go_and_others_are_told(served):
    slow, other = served.client(), served.client()
    assert eventually(lambda: len(served.server.clients) == 2)
    got = 0
    reader = other.makefile("rb")
    for _ in range(2000):
        served.server.tell(b"x" * 999 + b"\n")
        got += len(reader.readline())
    assert got == 2_000_000
    assert eventually(lambda: len(served.server.clients) == 1)
    slow.close()


def test_a_server_that_is_closed_lets_everybody_go(tmp_path):
    made = Served(tmp_path / "s")
    client = made.client()
    assert eventually(lambda: made.server.clients)
    made.server.close()
    assert client.recv(1) == b""
    with pytest.raises(OSError):
        made.client()


class Short:
    """A socket that is short of something each other time."""

    def __init__(self, listening, number):
        self._listening, self._number, self._tries = listening, number, 0

    def accept(self):
        self._tries += 1
        if self._tries % 2:
            raise OSError(self._number, "no room")
        return self._listening.accept()

    def __getattr__(self, name):
        return getattr(self._listening, name)


@pytest.mark.parametrize(
    "number", [errno.EMFILE, errno.ENFILE, errno.ENOMEM, errno.ECONNABORTED, errno.ENOBUFS]
)
def test_a_shortage_ends_nothing(tmp_path, monkeypatch, number):
    make = socket.socket
    monkeypatch.setattr(socket, "socket", lambda *args: Short(make(*args), number))
    made = Served(tmp_path / "s")
    monkeypatch.setattr(socket, "socket", make)
    with made.server:
        for n in (1, 2):
            made.client().sendall(b"stop\n")
            assert eventually(lambda n=n: len(made.heard) == n)


def test_no_room_for_a_thread_costs_one_connection_only(served, monkeypatch):
    start = threading.Thread.start

    def refuse(thread):
        monkeypatch.setattr(threading.Thread, "start", start)
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(threading.Thread, "start", refuse)
    assert served.client().recv(1) == b""
    served.client().sendall(b"stop\n")
    assert eventually(lambda: served.heard == [b"stop\n"])
