"""Lines from a pipe that may never end."""

from __future__ import annotations

import os
from collections.abc import Generator
from typing import TextIO

import pytest

from executive.frontends.prompt.plain import lines_until


@pytest.fixture
def pipe() -> Generator[tuple[TextIO, int]]:
    """What is read from, and what is written to."""
    reads, writes = os.pipe()
    with os.fdopen(reads, encoding="utf-8", errors="replace") as stream:
        yield stream, writes


def test_every_line_comes_whole_and_the_last_needs_no_end(pipe):
    stream, writes = pipe
    os.write(writes, "wave\ngo to the cafe\u0301 ".encode() + b"\xff\n\nno")
    os.write(writes, b"d")
    os.close(writes)
    lines = list(lines_until(stream, lambda: False))
    assert lines == ["wave", "go to the cafe\u0301 \ufffd", "", "nod"]


def test_a_letter_cut_in_two_is_one_letter(pipe):
    stream, writes = pipe
    first, second = "é".encode()[:1], "é".encode()[1:]
    os.write(writes, b"caf" + first)
    parts = lines_until(stream, lambda: _tell(writes, second + b"\n"))
    assert next(parts) == "café"
    os.close(writes)


def _tell(writes: int, data: bytes) -> bool:
    """Never over; the rest comes when the second look is taken."""
    looks.append(data)
    if len(looks) == 2:
        os.write(writes, data)
    return False


looks: list[bytes] = []


def test_while_no_line_comes_it_ends_when_it_is_over(pipe):
    stream, writes = pipe
    os.write(writes, b"wave\nhalf a li")
    asked = iter([False, False, False, True])
    assert list(lines_until(stream, lambda: next(asked))) == ["wave"]
    os.close(writes)
