"""A run as tables, for whoever analyses: CSV by the standard library, Parquet by PyArrow."""

# pyright: basic

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import msgspec

from executive.journal.journal import Event
from executive.journal.motion import Moment
from executive.journal.run import Run
from robot.printable import printable, printable_json

FORMULAS = frozenset("=+-@＝＋－＠")
"""A cell that begins with one is worked out by spreadsheets; the wide ones by some."""
_SPLIT_AT = re.compile(rf"([;\t|]['\"\s]*)([{re.escape(''.join(sorted(FORMULAS)))}])")
"""Where a cell ends, and another one begins, to a spreadsheet of a country where lists are split at
semicolons, whatever is quoted here."""
POSE = ("x_m", "y_m", "z_m", "qw", "qx", "qy", "qz")


class Table(msgspec.Struct, frozen=True, kw_only=True):
    """Columns by name, and the rows one after the other; None: not known."""

    name: str
    columns: tuple[str, ...]
    rows: Iterable[Sequence[Any]]


def tables(
    run: Run,
    events: Iterable[Event],
    moments: Callable[[], Iterable[Moment]],
    *,
    motors: tuple[str, ...],
) -> Iterator[Table]:
    """All of a run: how the robot and things moved, the tree, what was said, the journal.

    Args:
        run: for the tree and what is told in words.
        events: of the journal, as they are.
        moments: how everything moved; read more than once.
        motors: names of joint positions, in the order of the moments'.
    """
    base = tuple(f"base_{name}" for name in POSE)
    joints = tuple(f"q_{name}" for name in motors)
    columns = ("t_s", *base, *joints, "charge", "late")
    yield Table(name="motion", columns=columns, rows=_stood(moments(), len(motors)))
    columns = ("t_s", "kind", "id", *POSE)
    yield Table(name="things", columns=columns, rows=_seen(moments()))
    columns = ("t_s", "id", "parent", "kind", "name", "step", "state", "note")
    yield Table(name="tree", columns=columns, rows=sorted(_changes(run)))
    said = ((line.t_s, line.kind, line.text) for line in run.log)
    yield Table(name="log", columns=("t_s", "kind", "text"), rows=said)
    told = ((one.n, one.t_s, one.event, _json(one.data)) for one in events)
    yield Table(name="events", columns=("n", "t_s", "event", "data"), rows=told)


def _json(data: object) -> str:
    text = printable_json(msgspec.json.encode(data).decode())
    return _SPLIT_AT.sub(lambda found: f"{found[1]}\\u{ord(found[2]):04x}", text)  # the same JSON


def _stood(moments: Iterable[Moment], motors: int) -> Iterator[Sequence[Any]]:
    for one in moments:
        q = one.q if len(one.q) == motors else (None,) * motors
        yield one.t_s, *one.base, *q, one.charge, one.late


def _seen(moments: Iterable[Moment]) -> Iterator[Sequence[Any]]:
    for one in moments:
        for kind, places in (("object", one.objects), ("person", one.people)):
            for name, flat in places.items():
                yield one.t_s, kind, name, *(flat or (None,) * len(POSE))


def _changes(run: Run) -> Iterator[tuple[Any, ...]]:
    for _, node in run.walk():
        for one in node.changes:
            about = (node.id, node.parent, node.kind, node.name, node.step)
            yield one.t_s, *about, one.state, one.note


def as_csv(table: Table) -> bytes:
    """A table with a line of its columns' names; what is not known is empty.

    Texts may be a stranger's, and are fit for a terminal and for a spreadsheet.
    """
    file = io.StringIO(newline="")
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(map(_cell, table.columns))
    writer.writerows(map(_cell, row) for row in table.rows)
    return file.getvalue().encode()


def _cell(value: Any) -> Any:
    """Numbers as they are; before what a spreadsheet would work out stands an apostrophe.

    See https://owasp.org/www-community/attacks/CSV_Injection.
    """
    if not isinstance(value, str):
        return value
    text = printable(value)
    first = text.lstrip()[:1]
    text = _SPLIT_AT.sub(r"\1'\2", text)
    return f"'{text}" if first in FORMULAS or text[:1] in ("\t", "\n") else text


def as_parquet(table: Table) -> bytes:
    """A table with its types."""
    import pyarrow
    import pyarrow.parquet

    columns: list[list[Any]] = [[] for _ in table.columns]
    for row in table.rows:
        for column, value in zip(columns, row, strict=True):
            column.append(value)
    file = io.BytesIO()
    made = pyarrow.table(
        {name: _typed(column) for name, column in zip(table.columns, columns, strict=True)}
    )
    pyarrow.parquet.write_table(made, file)
    return file.getvalue()


def _typed(column: list[Any]) -> Any:
    """A column as pyarrow takes it; one of several types, as a journal may not be, is text."""
    import pyarrow

    try:
        return pyarrow.array(column)
    except (pyarrow.ArrowException, OverflowError, ValueError, TypeError):
        return pyarrow.array([None if value is None else str(value) for value in column])
