"""Lines as they are typed, byte by byte, with what terminals put between the letters."""

import os
import threading
import tty

import pytest

from executive.frontends.prompt.typed import KEPT, Ahead, Typed
from intents.letters import without_sequences
from intents.stopping import is_stop
from tests.fakes.waiting import HANG_S, eventually


@pytest.mark.parametrize(
    "data",
    [
        b"stop\r", b"stop\n", b"walk to the table\rstop\r", b"stopp\x7f\r", b"walk\x15stop\r",
        b"\x1b[31mstop\x1b[0m\r", b"\x1b[200~stop\r", b"\x1b[3stop\r", b"\x1b[M##stop\r",
        b"\x1b]8;;stop\r", b"\xd2stop\r", b"go to a\x1fhalt\r", b"\x12stop\r", b"\x1bstop\r",
        b"walk to kitstop\r",
        "st\u200bop\r".encode(), b"x" * 2 * KEPT + b" stop\r",
    ],
)  # fmt: skip
def test_a_cry_that_is_entered_is_heard_whatever_is_around_it(data: bytes):
    for size in (1, 3, len(data)):
        typed, lines = Typed(), []
        for at in range(0, len(data), size):
            lines += typed.take(data[at : at + size])
        assert any(is_stop(line) for line in lines), size


def test_what_was_not_entered_or_was_taken_back_is_none():
    typed = Typed()
    assert typed.take(b"stop") == []
    typed.clear()
    assert typed.take(b"\r") == [""]


def test_colours_and_titles_are_no_part_of_a_text():
    assert without_sequences("\x1b[1;31mpause\x1b[0m \x1b]0;title\x07now\x1b[m") == "pause now"


@pytest.fixture
def raw():
    """A terminal that hands keys on as they are pressed, and who presses them."""
    keys, shown = os.openpty()
    tty.setraw(shown)
    with os.fdopen(shown, "r", closefd=False) as terminal:
        yield terminal, lambda data: os.write(keys, data)
    os.close(shown)
    os.close(keys)


def test_a_stop_is_heard_before_the_prompt_reads_and_nothing_typed_is_lost(raw):
    terminal, press = raw
    press(b"wave\r")
    stopped = threading.Event()
    ahead = Ahead(terminal)
    ahead.hear(stopped.set)
    press(b"st")
    press(b"op\r")
    assert stopped.wait(HANG_S)
    press(b"no")
    assert eventually(lambda: ahead._data.endswith(b"no"))
    assert ahead.take() == b"wave\rstop\rno"


def test_a_stop_that_was_typed_already_is_heard_at_once_and_told_once(raw):
    terminal, press = raw
    press(b"\x03")
    told: list[int] = []
    ahead = Ahead(terminal)
    ahead.hear(lambda: told.append(1))
    assert told == [1]
    press(b"stop\r")
    assert eventually(lambda: ahead._data.endswith(b"stop\r"))
    ahead.take()
    assert told == [1]
