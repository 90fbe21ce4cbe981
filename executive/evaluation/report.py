"""What came out of a campaign: a table for people, JSON for machines, and whether it is enough."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from statistics import median

import msgspec
from rich.table import Table

from executive.evaluation.campaign import RECOVERED, Case
from executive.evaluation.record import Record
from robot.files.misfits import listed

HEAD = ("case", "expected", "with recovery", "without", "robot time", "what else happened")


class Score(msgspec.Struct, frozen=True, kw_only=True):
    """One way of running a case: with recovery, or without."""

    runs: int
    ok: int
    done: int
    """Runs that were done in truth, also where a failure was expected."""
    unsafe: int
    median_s: float
    recoveries: float
    wrong: dict[str, int]
    """Code (or "done, but" what the truth objects to) of the runs that are not as expected."""

    @property
    def share(self) -> float:
        """Of the runs that ended as expected."""
        return self.ok / self.runs if self.runs else 0.0


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """One case: what is expected of it, and how it went."""

    case: str
    expect: str
    with_recovery: Score
    without: Score | None = None
    seeds_wrong: tuple[int, ...] = ()


class Report(msgspec.Struct, frozen=True, kw_only=True):
    """A whole campaign. `worst` is the lowest share of any case, with recovery.

    `left` runs were asked for and are not done; of the others some were made by other code than
    this one where `mixed` says so.
    """

    rows: tuple[Row, ...]
    runs: int
    left: int = 0
    mixed: bool = False
    worst: float
    unsafe: int
    without_code: int
    judged_by: str = "oracle"


def report(
    cases: Sequence[Case], records: Iterable[Record], *, left: int = 0, mixed: bool = False
) -> Report:
    """Sum a campaign up.

    Args:
        cases: what was run.
        records: how each run ended.
        left: how many runs are not done.
        mixed: whether other code made some of the records.
    """
    all_records = list(records)
    rows: list[Row] = []
    for case in cases:
        ours = [record for record in all_records if record.case == case.name]
        on = [record for record in ours if record.recovery]
        off = [record for record in ours if not record.recovery]
        wrong = tuple(sorted(record.seed for record in on if not record.ok))
        without = score(off) if off else None
        rows.append(
            Row(
                case=case.name,
                expect=expected(case),
                with_recovery=score(on),
                without=without,
                seeds_wrong=wrong,
            )
        )
    known = {case.name for case in cases}
    counted = [record for record in all_records if record.case in known]
    return Report(
        rows=tuple(rows),
        runs=len(counted),
        left=left,
        mixed=mixed,
        worst=min((row.with_recovery.share for row in rows), default=0.0),
        unsafe=sum(record.unsafe for record in counted if record.recovery),
        without_code=sum(record.code in ("", "exception") for record in counted),
    )


def table(found: Report) -> Table:
    """For the terminal."""
    drawn = Table(box=None, caption=_caption(found), header_style="bold", pad_edge=False)
    for name in HEAD:
        drawn.add_column(name)
    for row in found.rows:
        style = "" if row.with_recovery.share >= 0.95 else "red"
        drawn.add_row(*_cells(row), style=style)
    return drawn


def narrow(found: Report) -> str:
    """The same for a terminal that has no room for the table: a paragraph a case."""
    lines: list[str] = []
    for row in found.rows:
        case, *cells = _cells(row)
        told = zip(HEAD[1:], cells, strict=True)
        lines += [case, *(f"  {name:18}  {cell}" for name, cell in told if cell not in ("", "-"))]
    return "\n".join([*lines, _caption(found)])


def markdown(found: Report) -> str:
    """For a page."""
    lines = [HEAD, ["---"] * len(HEAD), *(_cells(row) for row in found.rows)]
    rows = "\n".join("| " + " | ".join(cells) + " |" for cells in lines)
    return f"{rows}\n\n{_caption(found)}\n"


def _caption(found: Report) -> str:
    left = f" ({found.left} are not done)" if found.left else ""
    mixed = "; some were made by other code" if found.mixed else ""
    return (
        f"{found.runs} runs{left}, judged by the simulator's truth ({found.judged_by}); "
        f"{found.unsafe} unsafe ends, {found.without_code} ends without a code{mixed}"
    )


def _cells(row: Row) -> list[str]:
    on, off = row.with_recovery, row.without
    wrong = ", ".join(f"{code} ×{count}" for code, count in on.wrong.items())
    seeds = f" (seeds {listed([str(seed) for seed in row.seeds_wrong])})" if wrong else ""
    return [
        row.case,
        row.expect,
        _share(row, on),
        _share(row, off) if off else "-",
        f"{on.median_s:.0f} s" if on.runs else "-",
        wrong + seeds,
    ]


def _share(row: Row, score: Score) -> str:
    """How many of how many; where a failure is expected, also how many were done all the same."""
    if not score.runs:
        return "-"
    done = f" ({score.done} done)" if score.done and row.expect != RECOVERED else ""
    return f"{score.ok}/{score.runs}{done}"


def expected(case: Case) -> str:
    """What is expected of a case, in words."""
    return case.expect if isinstance(case.expect, str) else " or ".join(case.expect)


def score(records: list[Record]) -> Score:
    """Sum up the runs of one way of doing something."""
    wrong = Counter(_wrong(record) for record in records if not record.ok)
    return Score(
        runs=len(records),
        ok=sum(record.ok for record in records),
        done=sum(record.ok and record.code == "done" for record in records),
        unsafe=sum(record.unsafe for record in records),
        median_s=median([record.took_s for record in records]) if records else 0.0,
        recoveries=sum(r.recoveries for r in records) / len(records) if records else 0.0,
        wrong=dict(wrong.most_common()),
    )


def _wrong(record: Record) -> str:
    unsafe = ", unsafe" if record.unsafe else ""
    if record.code == "done":
        return f"done, but {record.cause or 'it was to fail'}{unsafe}"
    return record.code + unsafe
