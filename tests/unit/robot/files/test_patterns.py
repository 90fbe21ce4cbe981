"""Patterns of strangers: what they mean, what is refused, and that none takes for ever."""

import pytest

from robot.files import patterns
from tests.fakes.machine import in_paces


@pytest.mark.parametrize(
    ("pattern", "text", "found"),
    [
        (r"(?i)\b(2|two)\b", "I see Two plates.", True),
        (r"(?i)\b(2|two)\b", "I see 12 plates.", False),
        ("caf.$", "the café", True),
        (r"^\w+ \w+$", "zwei Wörter", False),  # as `\w` means ASCII
        ("x", "\ud800x", True),
        (r"\\p", r"\p", True),
        ("", "", True),
    ],
)
def test_what_a_pattern_finds(pattern: str, text: str, found: bool) -> None:
    assert patterns.is_in(pattern, text) is found


@pytest.mark.parametrize(
    ("pattern", "why"),
    [
        ("((", "missing"),
        ("(?=x)", "invalid perl operator"),
        (r"(a)\1", "escape"),
        ("a{1,65535}", "repetition"),
        ("(?:a{1000}b{1000}){9}", "repetition|too large"),
        (r"[\pL]", r"\\p is not taken"),
        (r"x\\\PL", r"\\p is not taken"),
        ("(" * 5000 + ")" * 5000, "10000 letters"),
    ],
)
def test_what_is_refused_with_the_reason(pattern: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        patterns.check(pattern)


@pytest.mark.parametrize(
    "pattern",
    [
        "(a|a)+$",
        "(a+)+$",
        "(a|aa)+$",
        "(.*a){25}$",
        "(a?){30}a{30}$",
        "(" * 90 + "a" + ")+" * 90 + "$",
    ],
)
def test_none_takes_longer_than_the_text_is_long(pattern: str) -> None:
    text = "a" * 5000 + "b"
    found = []
    assert in_paces(lambda: found.append(patterns.is_in(pattern, text)), tries=1) < 10_000
    assert not any(found)  # backtracking would take years
