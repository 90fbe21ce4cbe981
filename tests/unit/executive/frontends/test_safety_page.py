"""The table of faults in `docs/safety.md`: what it names is there, and nothing is left out."""

import re
from pathlib import Path

from executive.evaluation.campaign import SHIPPED, Campaign, read
from robot.files import config
from tests.unit.robot.drivers.test_motor_faults import FAULTS

ROOT = Path(__file__).parents[4]
PAGE = (ROOT / "docs" / "safety.md").read_text(encoding="utf-8")
TABLE = PAGE.split("<!-- faults -->")[1].split("<!-- end faults -->")[0]
ROWS = [re.split(r" ?\| ?", line)[1:-1] for line in TABLE.splitlines() if re.match(r"\| \d", line)]
NONE = "**none**"


def test_the_rows_are_numbered_and_each_says_what_shows_it_or_that_nothing_does():
    assert [int(row[0]) for row in ROWS] == list(range(1, len(ROWS) + 1))
    assert len(ROWS) >= 61
    for number, _, does, shown in ROWS:
        assert does, number
        assert shown == NONE or "`" in shown, number


def test_every_test_that_is_named_is_there():
    named = re.findall(r"`(tests/[\w/]+\.py)::(\w+)`", TABLE)
    assert len(named) > 60
    for path, name in named:
        assert f"def {name}(" in (ROOT / path).read_text(encoding="utf-8"), (path, name)


def test_every_fault_of_motors_that_is_played_stands_in_the_table_and_no_other():
    cells = [part for row in ROWS for part in re.findall(r"faults (`\w+`(?:, `\w+`)*)", row[3])]
    assert set(re.findall(r"\w+", " ".join(cells))) == {fault.name for fault in FAULTS}


def test_every_case_of_the_campaign_that_is_named_is_there():
    known = {case.name for case in config.convert(read(SHIPPED), Campaign).cases}
    assert set(re.findall(r"campaign `([^`]+)`", TABLE)) <= known
