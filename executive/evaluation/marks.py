"""What came out of an exam (`executive.evaluation.exam`): marks by kind of task, and as a whole."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from statistics import median

import msgspec
from rich.table import Table

from executive.evaluation.campaign import Case
from executive.evaluation.record import Record

HEAD = ("kind", "done", "falsely done", "× a person's time", "touched", "too near", "what else")
WHOLE = "all of it"
_MOST_CODES = 4


class Mark(msgspec.Struct, frozen=True, kw_only=True):
    """How tasks of a kind went.

    Attributes:
        kind: of the tasks.
        runs: in all.
        done: that ended well, and are so in truth.
        false: that the robot calls done, and are not.
        fell: after which it does not stand.
        touched: in which it touched a wall, a person or furniture that it should not.
        too_near: in which it came too near to somebody while it walked.
        median_times: the time of a run that was done by what a person would need; 0: unknown.
        codes: how the others ended.
    """

    kind: str
    runs: int
    done: int
    false: int
    fell: int
    touched: int
    too_near: int
    median_times: float
    codes: dict[str, int]

    @property
    def share(self) -> float:
        """Of the runs that are done."""
        return self.done / self.runs if self.runs else 0.0


class Attempt(msgspec.Struct, frozen=True, kw_only=True):
    """One run of a task."""

    task: str
    kind: str
    seed: int
    done: bool
    code: str
    cause: str
    took_s: float
    person_s: float
    touched: tuple[str, ...]
    too_near: tuple[str, ...]
    journal: str = ""


class Marks(msgspec.Struct, frozen=True, kw_only=True):
    """A whole exam, by kind in the order of writing; `left` runs are not done yet."""

    whole: Mark
    kinds: tuple[Mark, ...]
    attempts: tuple[Attempt, ...]
    left: int = 0
    mixed: bool = False
    judged_by: str = "oracle"

    @property
    def runs(self) -> int:
        """In all."""
        return self.whole.runs


def marks(
    cases: Sequence[Case], records: Iterable[Record], *, left: int = 0, mixed: bool = False
) -> Marks:
    """Sum an exam up; arguments as of `executive.evaluation.report.report`."""
    by_name = {case.name: case for case in cases}
    ours = [(by_name[record.case], record) for record in records if record.case in by_name]
    kinds = dict.fromkeys(case.kind for case in cases)
    return Marks(
        whole=_mark(WHOLE, ours),
        kinds=tuple(_mark(kind, [one for one in ours if one[0].kind == kind]) for kind in kinds),
        attempts=tuple(_attempt(case, record) for case, record in ours),
        left=left,
        mixed=mixed,
    )


def table(found: Marks) -> Table:
    """For the terminal."""
    drawn = Table(box=None, caption=_caption(found), header_style="bold", pad_edge=False)
    for name in HEAD:
        drawn.add_column(name)
    for mark in (*found.kinds, found.whole):
        style = "bold" if mark is found.whole else "" if mark.share >= 0.85 else "red"
        drawn.add_row(*_cells(mark), style=style)
    return drawn


def narrow(found: Marks) -> str:
    """The same for a terminal that has no room for the table: a paragraph a kind."""
    lines: list[str] = []
    for mark in (*found.kinds, found.whole):
        kind, *cells = _cells(mark)
        told = zip(HEAD[1:], cells, strict=True)
        lines += [kind, *(f"  {name:18}  {cell}" for name, cell in told if cell not in ("", "-"))]
    return "\n".join([*lines, _caption(found)])


def markdown(found: Marks) -> str:
    """For a page: the marks, and every run that is not done."""
    rows = [HEAD, ["---"] * len(HEAD), *(_cells(mark) for mark in (*found.kinds, found.whole))]
    lines = ["| " + " | ".join(cells) + " |" for cells in rows]
    failed = [
        f"- {one.task} (seed {one.seed}): {one.code}, {one.cause}" + _where(one.journal)
        for one in found.attempts
        if not one.done
    ]
    return "\n".join([*lines, "", _caption(found), "", *failed]) + "\n"


def _where(journal: str) -> str:
    return f" ({journal})" if journal else ""


def _cells(mark: Mark) -> list[str]:
    codes = [f"{code} ×{count}" for code, count in mark.codes.items()]
    more = [f"{len(codes) - _MOST_CODES} more"] if len(codes) > _MOST_CODES else []
    fell = [f"fell ×{mark.fell}"] if mark.fell else []
    return [
        mark.kind,
        f"{mark.done}/{mark.runs}",
        str(mark.false or "-"),
        f"{mark.median_times:.1f}" if mark.median_times else "-",
        str(mark.touched or "-"),
        str(mark.too_near or "-"),
        ", ".join([*fell, *codes[:_MOST_CODES], *more]),
    ]


def _caption(found: Marks) -> str:
    left = f" ({found.left} are not done)" if found.left else ""
    mixed = "; some were made by other code" if found.mixed else ""
    return (
        f"{found.runs} runs{left}, {found.whole.share:.0%} done, judged by the simulator's truth "
        f"({found.judged_by}){mixed}"
    )


def _mark(kind: str, ours: Sequence[tuple[Case, Record]]) -> Mark:
    records = [record for _, record in ours]
    times = [record.took_s / case.person_s for case, record in ours if record.ok and case.person_s]
    codes = Counter(
        "done, but not in truth" if record.false else record.code
        for record in records
        if not record.ok
    )
    return Mark(
        kind=kind,
        runs=len(records),
        done=sum(record.ok for record in records),
        false=sum(record.false for record in records),
        fell=sum(record.unsafe for record in records),
        touched=sum(bool(record.touched) for record in records),
        too_near=sum(bool(record.too_near) for record in records),
        median_times=round(median(times), 2) if times else 0.0,
        codes=dict(codes.most_common()),
    )


def _attempt(case: Case, record: Record) -> Attempt:
    return Attempt(
        task=case.name, kind=case.kind, seed=record.seed, done=record.ok, code=record.code,
        cause=record.cause, took_s=record.took_s, person_s=case.person_s,
        touched=record.touched, too_near=record.too_near, journal=record.journal,
    )  # fmt: skip
