"""A run is read as it grows, whatever stands in its files."""

from __future__ import annotations

import os
import tracemalloc

import msgspec

from executive.frontends.console import kept
from executive.frontends.console.following import Following
from executive.frontends.console.tail import CHUNK, Tail
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


def shown(following: Following) -> list[bytes]:
    lines, end = following.moments.batch(0, most=1000)
    assert end == len(following.moments)
    return lines


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
    assert [msgspec.json.decode(one)["t_s"] for one in shown(following)] == [0.05, 0.1, 0.2]
    following.close()


def test_a_long_run_is_read_piece_by_piece(tmp_path):
    count = 2 * CHUNK // len(moment(1.0))
    (tmp_path / motion.FILE).write_bytes(b"".join(moment(0.05 * k) for k in range(1, count)))
    following = Following(tmp_path)
    assert following.read() and 0 < len(following.moments) < count
    assert len(everything(following).moments) == count - 1


def large(t_s: float, kilobytes: int) -> bytes:
    things = {f"{k:03}": None for k in range(100 * kilobytes)}
    return motion.encode(Moment(t_s=t_s, base=BASE, q=(0.1,), objects=things)) + b"\n"


def test_a_strangers_long_lines_stay_in_their_file_and_a_page_is_told_what_it_is_not_given(
    tmp_path, monkeypatch
):
    monkeypatch.setattr(kept, "MOST_BYTES", 200_000)
    line = large(1.0, 50)
    with (tmp_path / motion.FILE).open("wb") as file:
        for k in range(100):
            file.write(large(0.1 * k, 50))
    tracemalloc.start()
    following = everything(Following(tmp_path))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 6 * CHUNK
    count = 200_000 // len(line)
    assert len(following.moments) == count
    assert following.left_out == f"{100 - count} movements"


def test_a_message_to_a_page_is_bounded_by_its_bytes(tmp_path, monkeypatch):
    monkeypatch.setattr(kept, "BATCH_BYTES", 120_000)
    (tmp_path / motion.FILE).write_bytes(b"".join(large(1.0 + k, 50) for k in range(5)))
    moments = everything(Following(tmp_path)).moments
    sizes, number = [], 0
    while number < len(moments):
        lines, number = moments.batch(number, most=1000)
        sizes.append(len(lines))
    assert sizes == [2, 2, 1]
    monkeypatch.setattr(kept, "BATCH_BYTES", 10)
    assert len(moments.batch(0, most=1000)[0]) == 1


def test_lines_that_are_no_more_what_they_were_are_not_given_to_a_page(tmp_path):
    path = tmp_path / motion.FILE
    path.write_bytes(moment(1.0) + moment(2.0) + moment(3.0))
    following = everything(Following(tmp_path))
    with path.open("r+b") as file:
        file.seek(len(moment(1.0)))
        file.write(b"]" * 10)
        file.truncate(2 * len(moment(1.0)) + 5)
    assert shown(following) == [moment(1.0).strip()]


def test_a_file_that_is_not_read_to_its_end_is_said(tmp_path, monkeypatch):
    monkeypatch.setattr(motion, "MOST_BYTES", 10)
    (tmp_path / motion.FILE).write_bytes(moment(1.0))
    assert everything(Following(tmp_path)).left_out == "0 movements and all later ones"
