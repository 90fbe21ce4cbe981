"""Lines that are nearly a command are asked about, not walked on."""

from types import SimpleNamespace

import pytest

from executive.frontends.prompt.commands import table
from executive.frontends.prompt.mistyped import meant, polite

SHELL = SimpleNamespace(commands={})
TABLE = {one.name: one for one in table.commands(SHELL)}  # type: ignore[arg-type]
SHELL.commands = TABLE


@pytest.mark.parametrize(
    ("line", "command"),
    [("move 3 1", "goals move 3 1"), ("drop 2", "goals drop 2"), ("cancle 2", "cancel 2"),
     ("reset", "estop reset"), ("gols move 3 1", "goals move 3 1"), ("wyh 3", "why 3"),
     ("gols", "goals"), ("tre", "tree"), ("histroy", "history"), ("quti", "quit"),
     ("hlep", "help")],
)  # fmt: skip
def test_a_slip_is_taken_for_what_it_was_meant_to_be(line: str, command: str):
    assert meant(line, TABLE) == command


@pytest.mark.parametrize(
    "line",
    ["walk to 3, 1", "move 2 metres forward", "drop the cup", "place the cup on the table",
     "step back", "go to the table", "move to the shelf", "stand on one leg", "add milk",
     "three", "quiet", "stand", "wave", "sit", "yes", "red"],
)  # fmt: skip
def test_sentences_are_no_slips(line: str):
    assert meant(line, TABLE) == ""


def test_politeness_after_a_command_makes_no_sentence_of_it():
    assert polite("please")
    assert polite("now, please!")
    assert not polite("to the table")
