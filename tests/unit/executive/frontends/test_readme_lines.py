"""Every `humanoid` line of README and tutorial is one that there is, with options that it takes."""

import re
import shlex
from pathlib import Path

import pytest
from typer.main import get_command

from executive.frontends.cli import app

ROOT = Path(__file__).parents[4]
TEXT = (ROOT / "README.md").read_text() + (ROOT / "docs" / "tutorial.md").read_text()
LINES = [
    shlex.split(line, comments=True)[1:]
    for block in re.findall(r"```\w*\n(.*?)```", TEXT, flags=re.DOTALL)
    for line in block.splitlines()
    if line.startswith("humanoid ")
]


def test_there_are_lines():
    assert len(LINES) > 20


@pytest.mark.parametrize("words", LINES, ids=" ".join)
def test_a_line_that_is_shown_is_parsed(words: list[str]):
    command, words, context = get_command(app), list(words), None
    while hasattr(command, "commands") and words and words[0] in command.commands:
        context = command.make_context(command.name, [], parent=context, resilient_parsing=True)
        command = command.commands[words.pop(0)]
    assert not (hasattr(command, "commands") and words), f"no such command: {words}"
    if "--help" not in words:
        command.make_context(command.name, words, parent=context)
