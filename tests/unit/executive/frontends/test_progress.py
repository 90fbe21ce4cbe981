"""The live tree keeps its shape, whatever the names and however narrow the terminal."""

import pytest
from rich.console import Group

from executive.frontends import progress
from executive.frontends.output import Screen
from executive.journal.journal import Event
from executive.journal.snapshot import Shown


def test_an_event_is_one_line():
    event = Event(0, 1.0, "said", {"text": "hello\n[   2.00 s] all is well\x1b[2J"})
    assert progress.sentence(event) == "says: hello [ 2.00 s] all is well\\x1b[2J"


@pytest.mark.parametrize("columns", [20, 60, 200])
def test_a_node_is_one_line(columns, capsys):
    name = "bring the red cup\nto the \x1b[2J\u202e counter " * 5
    node = Shown(id=0, kind="skill", name=name, state="running", note=name)
    Screen(width=columns).print(Group(progress.drawn(1, node)))
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 1
    assert len(lines[0]) <= columns
