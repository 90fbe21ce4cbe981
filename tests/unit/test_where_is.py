"""The table that tells where things are: its files are there, and say what one is to look for."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TABLE = (ROOT / "docs" / "index.md").read_text().split("## Where is ...?\n")[1]
ROWS = [
    line.strip("|\n").split("|") for line in TABLE.splitlines() if "](../" in line and "|" in line
]


def test_there_are_rows():
    assert len(ROWS) >= 20


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0].strip())
def test_its_files_exist_and_hold_the_word(row: list[str]):
    shown = re.findall(r"\[`([^`]+)`\]\(\.\./([^)]+)\)", row[1])
    assert shown
    assert all(name == path for name, path in shown)
    texts = [(ROOT / path).read_text() for _, path in shown]
    if word := row[2].strip().strip("`"):
        assert any(re.search(rf"\b{re.escape(word)}\b", text) for text in texts)
