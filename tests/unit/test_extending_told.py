"""What the page on extending says that something takes is what its tables name, and is there."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "extending.md").read_text()
MOST = {
    "a skill": 2, "a goal": 8, "a reading": 2, "sensor's driver": 2, "new kind of sensor": 2,
    "a motor driver": 2, "a robot": 2, "a failure code": 2,
}  # fmt: skip
"""Files of each kind that there may be: what it takes to add something is kept small."""


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip().strip("|").split(" | ")]


def _summed_up() -> dict[str, tuple[int, str]]:
    """What the first table says: kind to its files, and how many of them are rows."""
    first = PAGE.split("\n## ")[0]
    rows = [_cells(line) for line in first.splitlines() if "](#" in line and line.startswith("|")]
    found = {re.sub(r".*\[|\]\(.*", "", row[0]): row for row in rows}
    return {kind: (int(row[1].split(",")[0]), row[2]) for kind, row in found.items()}


def _tables(kind: str) -> list[list[list[str]]]:
    """The tables of files in a kind's section, without the tests and what only some need."""
    heading = "A sensor" if "sensor" in kind else kind.capitalize()
    section = re.split(r"\n##+ ", PAGE.split(f"\n## {heading}\n")[1])[0]
    tables = section.split("| file | what to write | held by |\n|---|---|---|\n")[1:]
    return [
        [
            row
            for row in map(_cells, table.split("\n\n")[0].splitlines())
            if not row[0].startswith("`tests/") and ", if" not in row[0]
        ]
        for table in tables
    ]


def _of(kind: str) -> list[list[str]]:
    return _tables(kind)[1 if kind.startswith("new") else 0]


def test_every_kind_is_summed_up():
    assert set(_summed_up()) == set(MOST)


@pytest.mark.parametrize("kind", MOST)
def test_it_takes_as_many_files_as_is_said_and_no_more_than_may_be(kind: str):
    files, rows = _summed_up()[kind]
    told = _of(kind)
    assert len(told) == files <= MOST[kind]
    assert rows == "all" or int(rows) <= files


@pytest.mark.parametrize("kind", MOST)
def test_the_files_that_get_a_row_are_there(kind: str):
    for row in _of(kind):
        for path in re.findall(r"`((?:robot|executive|intents|sim)/[^`]+)`", row[0]):
            folder = ROOT / path
            while re.search(r"[A-Z]{3}", folder.name):  # NAME.py: what is to be written
                folder = folder.parent
            assert folder.exists(), path


@pytest.mark.parametrize("kind", MOST)
def test_an_example_of_it_is_tried(kind: str):
    line = next(line for line in PAGE.splitlines() if f"[{kind}](#" in line)
    (example,) = re.findall(r"\]\(\.\./(examples/[^)]+)\)", line)
    assert (ROOT / example).exists()
    tests = (ROOT / "tests" / "unit" / "examples").glob("test_*.py")
    assert any(Path(example).stem in test.read_text() for test in tests), example
