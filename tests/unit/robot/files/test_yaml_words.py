"""What is no YAML is told in words of ours, where it begins."""

import pytest

from robot.errors import ConfigError
from robot.files import yaml_nodes


@pytest.mark.parametrize(
    ("text", "place", "words"),
    [
        ("a: @x", "1:4", "nothing can begin with @"),
        ("a: `x`", "1:4", "nothing can begin with `"),
        ("a: b: c", "1:5", "a colon where no key can be"),
        ('a: 1\nb: "open\nc: 2\n', "2:4", "this quote is never closed"),
        ("a: 1\nb: 'open\nc: 2\n", "2:4", "this quote is never closed"),
        ("a: 1\nb: [1, 2\nc: 3\n", "2:4", "this [ is never closed"),
        ("a: 1\nb: {c: 3\n", "2:4", "this { is never closed"),
        ("a:\n\t- x", "2:1", "indent with spaces, not with a tab"),
        ("- a\nb: 1\n", "2:1", "begin it with -"),
        ('a: "\\q"', "1:5", "two backslashes"),
        ("a: |x\n b", "1:5", "begin it in the next line"),
        ("!!q{ a", "1:4", "look at the indentation"),
    ],
)
def test_what_is_no_yaml_is_told_where_it_begins(text, place, words):
    with pytest.raises(ConfigError) as error:
        yaml_nodes.parse(text, "f")
    said = str(error.value)
    assert said.startswith(f"f:{place}: not valid YAML: ")
    assert words in said
    assert "scanning" not in said
    assert "token" not in said


def test_a_control_character_is_told_by_its_line():
    with pytest.raises(ConfigError, match=r"f:2: not a text file: a control character .*0x07"):
        yaml_nodes.parse('a: 1\nb: "\x07"\n', "f")
