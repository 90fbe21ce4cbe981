"""A run is read as it grows, whatever stands in its files."""

from __future__ import annotations

import os

import msgspec

from executive.frontends.console.following import CHUNK, Following, Tail
from executive.journal import journal, motion
from executive.journal.motion import Moment

BASE = (0.0, 0.0, 0.6, 1.0, 0.0, 0.0, 0.0)


def moment(t_s: float) -> bytes:
    return motion.encode(Moment(t_s=t_s, base=BASE, q=(0.1,))) + b"\n"


def event(n: int, kind: str, **data) -> bytes:
    return msgspec.json.encode({"n": n, "t_s": 0.1 * n, "event": kind, **data}) + b"\n"


def everything(following: Following) -> Following:
    while following.read():
        pass
    return following


def test_lines_come_when_they_are_whole(tmp_path):
    path = tmp_path / "file"
    tail = Tail(path, longest=100, most=10_000)
    assert tail.lines() == []  # nobody has written it yet
    path.write_bytes(b"one\ntw")
    assert tail.lines() == [b"one"]
    with path.open("ab") as file:
        file.write(b"o\n\nthree\n")
    assert tail.lines() == [b"two", b"three"]
    assert tail.lines() == []


def test_a_line_without_an_end_does_not_fill_the_memory(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"x" * 50_000 + b"\nshort\n")
    tail = Tail(path, longest=100, most=100_000)
    assert tail.lines() == [b"short"]
    path.write_bytes(b"a\n" * 60_000)
    bounded = Tail(path, longest=100, most=1000)
    assert bounded.lines() and not bounded.lines()


def test_a_pipe_in_the_place_of_a_file_holds_nobody_up(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    assert Tail(tmp_path / "pipe", longest=100, most=100).lines() == []


def test_a_run_is_followed_as_it_grows(tmp_path):
    following = Following(tmp_path)
    assert not following.read()
    (tmp_path / journal.FILE).write_bytes(event(0, "run", text="go to the table"))
    (tmp_path / motion.FILE).write_bytes(moment(0.05))
    everything(following)
    assert following.run.text == "go to the table" and len(following.moments) == 1
    with (tmp_path / motion.FILE).open("ab") as file:
        file.write(moment(0.1) + moment(0.05) + b"nonsense\n" + moment(0.2))
    everything(following)
    assert [msgspec.json.decode(one)["t_s"] for one in following.moments] == [0.05, 0.1, 0.2]
    following.close()


def test_a_long_run_is_read_piece_by_piece(tmp_path):
    count = 2 * CHUNK // len(moment(1.0))
    (tmp_path / motion.FILE).write_bytes(b"".join(moment(0.05 * k) for k in range(1, count)))
    following = Following(tmp_path)
    assert following.read() and 0 < len(following.moments) < count
    assert len(everything(following).moments) == count - 1
