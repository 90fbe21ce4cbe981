"""What came out of a campaign in homes that it was not written for: by fault, and by kind of home.

`report` is the same for the campaign at home.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import msgspec
from rich.table import Table

from executive.evaluation.campaign import Case
from executive.evaluation.elsewhere import Skipped
from executive.evaluation.record import Record
from executive.evaluation.report import Score, expected, score

WHOLE = "all of them"
_NONE = "-"


class Line(msgspec.Struct, frozen=True, kw_only=True):
    """A fault: in all homes, and by kind of home; `without` is without recovery."""

    fault: str
    expect: str
    whole: Score
    kinds: dict[str, Score]
    without: Score | None = None


class Failed(msgspec.Struct, frozen=True, kw_only=True):
    """A run with recovery that did not end as expected."""

    fault: str
    home: str
    seed: int
    code: str
    cause: str
    journal: str = ""


class HomesReport(msgspec.Struct, frozen=True, kw_only=True):
    """A campaign in other homes; counts are of runs with recovery if nothing else is said.

    `left`, `mixed`, `worst`, `unsafe` and `without_code` are as of `report.Report`.
    """

    lines: tuple[Line, ...]
    whole: Line
    failed: tuple[Failed, ...]
    skipped: tuple[Skipped, ...]
    runs: int
    left: int = 0
    mixed: bool = False
    worst: float
    unsafe: int
    without_code: int
    judged_by: str = "oracle"


def homes_report(
    cases: Sequence[Case],
    records: Iterable[Record],
    *,
    skipped: Sequence[Skipped] = (),
    left: int = 0,
    mixed: bool = False,
) -> HomesReport:
    """Sum it up; arguments as of `executive.evaluation.report.report`."""
    by_name = {case.name: case for case in cases}
    ours = [(by_name[record.case], record) for record in records if record.case in by_name]
    kinds = tuple(dict.fromkeys(_kind(case) for case in cases))
    faults = dict.fromkeys(case.origin for case in cases)
    lines = tuple(
        _line(fault, kinds, [one for one in ours if one[0].origin == fault], cases)
        for fault in faults
    )
    with_recovery = [(case, record) for case, record in ours if record.recovery]
    return HomesReport(
        lines=lines,
        whole=_line(WHOLE, kinds, ours, ()),
        failed=tuple(
            Failed(fault=case.origin, home=case.world, seed=record.seed, code=record.code,
                   cause=record.cause, journal=record.journal)
            for case, record in with_recovery
            if not record.ok
        ),
        skipped=tuple(skipped),
        runs=len(ours),
        left=left,
        mixed=mixed,
        worst=min((line.whole.share for line in lines), default=0.0),
        unsafe=sum(record.unsafe for _, record in with_recovery),
        without_code=sum(record.code in ("", "exception") for _, record in ours),
    )  # fmt: skip


def table(found: HomesReport) -> Table:
    """For the terminal."""
    drawn = Table(box=None, caption=_caption(found), header_style="bold", pad_edge=False)
    for name in _head(found):
        drawn.add_column(name)
    for line in (*found.lines, found.whole):
        style = "bold" if line is found.whole else "" if line.whole.share >= 0.95 else "red"
        drawn.add_row(*_cells(line), style=style)
    return drawn


def narrow(found: HomesReport) -> str:
    """The same for a terminal that has no room for the table: a paragraph a fault."""
    head, lines = _head(found), list[str]()
    for line in (*found.lines, found.whole):
        fault, *cells = _cells(line)
        told = zip(head[1:], cells, strict=True)
        lines += [
            fault,
            *(f"  {name:15}  {cell}" for name, cell in told if cell not in ("", _NONE)),
        ]
    return "\n".join([*lines, _caption(found)])


def markdown(found: HomesReport) -> str:
    """For a page: the table, every run that is not as expected, and what was skipped."""
    head = _head(found)
    rows = [head, ["---"] * len(head), *(_cells(line) for line in (*found.lines, found.whole))]
    lines = ["| " + " | ".join(cells) + " |" for cells in rows]
    return (
        "\n".join([*lines, "", _caption(found), "", *(f"- {note}" for note in notes(found))]) + "\n"
    )


def notes(found: HomesReport) -> list[str]:
    """Every run that is not as expected, and every case that was skipped, a line each."""
    failed = [
        f"{one.fault} in {one.home} (seed {one.seed}): {one.code}, {one.cause}"
        for one in found.failed
    ]
    return [*failed, *(f"skipped: {one.fault} in {one.home}: {one.why}" for one in found.skipped)]


def _head(found: HomesReport) -> list[str]:
    return [
        "fault",
        "expected",
        *found.whole.kinds,
        "together",
        "without",
        "robot time",
        "what else",
    ]


def _cells(line: Line) -> list[str]:
    wrong = [f"{code} ×{count}" for code, count in line.whole.wrong.items()]
    return [
        line.fault,
        line.expect,
        *(_share(one) for one in line.kinds.values()),
        _share(line.whole),
        _share(line.without) if line.without else _NONE,
        f"{line.whole.median_s:.0f} s" if line.whole.runs else _NONE,
        ", ".join(wrong),
    ]


def _share(of: Score) -> str:
    return f"{of.ok}/{of.runs}" if of.runs else _NONE


def _caption(found: HomesReport) -> str:
    left = f" ({found.left} are not done)" if found.left else ""
    mixed = "; some were made by other code" if found.mixed else ""
    skipped = f"; {len(found.skipped)} cases skipped as senseless" if found.skipped else ""
    return (
        f"{found.runs} runs{left}, judged by the simulator's truth ({found.judged_by}); "
        f"{found.unsafe} unsafe ends, {found.without_code} ends without a code{skipped}{mixed}"
    )


def _line(
    fault: str, kinds: Sequence[str], ours: Sequence[tuple[Case, Record]], cases: Sequence[Case]
) -> Line:
    on = [(case, record) for case, record in ours if record.recovery]
    off = [record for _, record in ours if not record.recovery]
    return Line(
        fault=fault,
        expect=next((expected(case) for case in cases if case.origin == fault), ""),
        whole=score([record for _, record in on]),
        kinds={
            kind: score([record for case, record in on if _kind(case) == kind]) for kind in kinds
        },
        without=score(off) if off else None,
    )


def _kind(case: Case) -> str:
    """Of the home that a case is done in: `flat` of `flat:7`."""
    return case.world.partition(":")[0]
