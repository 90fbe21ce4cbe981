"""What a stranger's text meets takes time that grows with its length alone.

Each text is as long as its reader lets in, and took from 6 s to hours where a pattern tried again
what it had tried: what is allowed here is some hundred times what is needed.
"""

from collections.abc import Callable
from pathlib import Path

import pytest

from executive.frontends import language_model as endpoints
from executive.frontends.settings import files
from executive.missions import values
from intents import letters
from intents.language_model import peeling
from robot.errors import ConfigError
from robot.files import yaml_nodes
from robot.model import mjcf_files
from robot.printable import printable_line
from tests.fakes.machine import in_paces

ROOT = Path(__file__).parents[2]
N = 64_000
MOST = 5000
"""Paces (tests/fakes/machine.py): 2 s of a core that has nothing else to do."""


def read_yaml(text: str) -> object:
    try:
        return yaml_nodes.parse(text, "a.yaml")
    except ConfigError as error:
        return error


TEXTS: dict[str, tuple[Callable[[str], object], str]] = {
    "an answer whose string ends nowhere": (peeling.values, '"' + '\\"' * (N // 2)),
    "an answer of apostrophes": (peeling.values, "{'" + "\\'" * (N // 2)),
    "an answer of brackets": (peeling.values, "[{" * (N // 2)),
    "an answer of commas": (peeling.values, "{" + ", " * (N // 2) + "}"),
    "an answer of blanks": (peeling.values, "{a" + " " * N + "}"),
    "an answer of marks": (peeling.values, "<|channel|> " * (N // 12)),
    "beginnings of titles": (letters.without_sequences, "\x9d" * N),
    "beginnings of links": (letters.without_sequences, "\x1b]" * (N // 2)),
    "beginnings of colours": (letters.without_sequences, "\x9b0;" * (N // 3)),
    "blanks in a placeholder": (values.PLACEHOLDER.search, "{{" + " " * N),
    "blanks between words": (values.PLACEHOLDER.search, "{{" + "a " * (N // 2)),
    "braces": (values.PLACEHOLDER.search, "{{" * (N // 2)),
    "one brace": (values.SINGLE.search, "{" + " " * (N // 2) + "a" * (N // 2)),
    "empty lines of settings": (lambda text: files._line_of("seed", text), "\n" * N),
    "empty lines of an endpoint": (endpoints._NAMES_A_KEY.search, "\n" * N),
    "blanks of an endpoint": (endpoints._NAMES_A_KEY.search, " \t" * (N // 2)),
    "directives": (read_yaml, "".join(f"%TAG !{n}! a\n" for n in range(100_000))),
    "names of files": (mjcf_files._BROKEN_NAME.search, "file" * N),
    "blanks on a line": (printable_line, "\u00ad " * N),
}


@pytest.mark.parametrize("kind", TEXTS)
def test_a_text_of_a_stranger_takes_linear_time(kind):
    reader, text = TEXTS[kind]
    assert in_paces(lambda: reader(text), tries=1, warm=True) < MOST


def test_no_pattern_of_what_is_typed_begins_a_line_with_any_blank():
    """`^\\s*` goes over lines, again from each of them."""
    found = [
        str(path)
        for package in ("executive", "intents", "robot", "sim")
        for path in (ROOT / package).rglob("*.py")
        for line in path.read_text().splitlines()
        if "re.compile(" in line and r'"^\s*' in line and "MULTILINE" in line
    ]
    assert not found
