"""Motors as tables."""

from __future__ import annotations

from collections.abc import Sequence

from rich.table import Table

from robot.bringup.motor_reports import Load, Reading, Seen


def of_scan(found: Sequence[Seen]) -> Table:
    """Who answered."""
    table = _table("bus", "id", "answers as", "joint", "mode", "firmware", "±rad", "±rad/s", "±N m")
    for one in found:
        ranges = one.ranges or (None, None, None)
        table.add_row(
            one.bus, f"{one.id}", f"{one.reply_id}", one.joint or "-", _number(one.mode),
            _number(one.version), *(_number(value) for value in ranges),
        )  # fmt: skip
    return table


def of_readings(rows: Sequence[Reading]) -> Table:
    """What joints measure."""
    supplied = any(row.supply_v is not None for row in rows)
    last = "V" if supplied else "age ms"
    table = _table("joint", "bus", "id", "status", "rad", "rad/s", "N m", "winding °C", last)
    for row in rows:
        table.add_row(
            row.joint, row.bus, f"{row.id}", row.status.replace("_", " "), _number(row.q_rad, 3),
            _number(row.qd_rad_s, 2), _number(row.tau_nm, 2), _number(row.winding_c),
            _number(row.supply_v if supplied else row.age_ms, 1),
        )  # fmt: skip
    return table


def of_loads(loads: Sequence[Load]) -> Table:
    """How full buses are."""
    table = _table("bus", "channel", "joints", "load", "at most")
    for one in loads:
        table.add_row(one.bus, one.channel, f"{one.joints}", f"{one.share:.0%}", f"{one.most:.0%}")
    return table


def _table(*heads: str) -> Table:
    table = Table(box=None, pad_edge=False)
    words = {"bus", "joint", "status", "channel"}
    for head in heads:
        table.add_column(head, justify="left" if head in words else "right", no_wrap=True)
    return table


def _number(value: float | None, digits: int = 0) -> str:
    if value is None:
        return "-"
    return f"{value:.{digits}f}" if digits else f"{value:g}"
