"""A report can be read on any terminal: no word of it is broken."""

import pytest

from executive.evaluation.report import Report, Row, Score
from executive.frontends import evaluation_report, output

SCORE = Score(
    runs=20, ok=18, done=3, unsafe=0, median_s=63.2, recoveries=1.1,
    wrong={"object_not_seen": 3, "grasp_missed": 2},
)  # fmt: skip
FOUND = Report(
    rows=(
        Row(case="missed grasp", expect="recovered", with_recovery=SCORE, without=SCORE),
        Row(case="camera silent", expect="object_not_seen or path_blocked", with_recovery=SCORE),
    ),
    runs=40, worst=0.9, unsafe=0, without_code=0,
)  # fmt: skip


@pytest.mark.parametrize("columns", [40, 60, 80, 120, 200])
def test_no_word_is_broken(columns, monkeypatch, capsys):
    monkeypatch.setattr(evaluation_report, "table_screen", lambda: output.Screen(width=columns))
    evaluation_report.show(FOUND)
    words = capsys.readouterr().out.split()
    for word in ("missed", "grasp", "object_not_seen", "path_blocked", "grasp_missed", "expected"):
        assert word in words
