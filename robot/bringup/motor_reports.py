"""What people and programs are told of motors, of whatever family, from a workbench."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TypeAlias

import msgspec


class Seen(msgspec.Struct, frozen=True, kw_only=True):
    """A motor that answered a scan.

    Attributes:
        bus: where.
        id: it listens for this.
        reply_id: it answers under this.
        replies: how many answered to that identifier.
        joint: whose motor the map says it is; "" if nobody's.
        mode, version: registers; None if it did not tell.
        ranges: what its largest numbers stand for: rad, rad/s, N m.
    """

    bus: str
    id: int
    reply_id: int
    replies: int
    joint: str
    mode: int | None
    version: int | None
    ranges: tuple[float, float, float] | None


def unless_nan(value: float) -> float | None:
    """A value as a report has it: None for NaN."""
    return None if math.isnan(value) else value


class Reading(msgspec.Struct, frozen=True, kw_only=True):
    """What one joint's motor says, at the joint; None where it did not tell."""

    joint: str
    bus: str
    id: int
    model: str
    status: str
    q_rad: float | None = None
    qd_rad_s: float | None = None
    tau_nm: float | None = None
    winding_c: float | None = None
    driver_c: float | None = None
    supply_v: float | None = None
    age_ms: float | None = None


class Load(msgspec.Struct, frozen=True, kw_only=True):
    """How full a bus is at the map's rate, with the most stuffing; at most `most` is safe."""

    bus: str
    channel: str
    joints: int
    share: float
    most: float


class Line(msgspec.Struct, frozen=True, kw_only=True):
    """One finding of a check; `is_grave`: nothing may be enabled."""

    joint: str
    code: str
    text: str
    cure: str
    is_grave: bool


class Check(msgspec.Struct, frozen=True, kw_only=True):
    """What came of a check.

    Attributes:
        loads: of the buses.
        joints: how many were asked.
        findings: all that disagrees or could not be told.
        answered: share of the periods' questions that were answered in their period; None: nobody
            was asked that often, as something grave was found before.
        late: periods that began late by more than one.
    """

    loads: tuple[Load, ...]
    joints: int
    findings: tuple[Line, ...]
    answered: float | None = None
    late: int = 0

    @property
    def is_grave(self) -> bool:
        """Whether nothing may be enabled."""
        return any(finding.is_grave for finding in self.findings)


Watched: TypeAlias = Iterator[tuple[list[Reading], tuple[str, ...]]]
"""What joints say, and what is wrong."""
