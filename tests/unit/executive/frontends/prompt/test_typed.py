"""Lines as they are typed, byte by byte, with what terminals put between the letters."""

import pytest

from executive.frontends.prompt.typed import KEPT, Typed
from intents.letters import without_sequences
from intents.stopping import is_stop


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
