"""A checked mission as a job: the same work as a sentence, with limits of its own."""

from __future__ import annotations

from typing import Any

from executive.engine.jobs import Limits
from executive.meaning.request import Understood
from executive.missions.check import Checked, Options
from executive.runs.mission_files import digest, kept


def understood(checked: Checked) -> Understood:
    """A mission as what can be submitted to an executive."""
    return Understood(text=checked.mission.record.name, goals=(), task=checked.task)


def limits(checked: Checked) -> Limits:
    """What the whole job may take; the duration is in the task, so that `always` follows it."""
    speed_m_s = checked.mission.record.limits.speed_m_s
    return Limits() if speed_m_s is None else Limits(speed_m_s=speed_m_s)


def origin(checked: Checked, options: Options, *, path: str) -> dict[str, Any]:
    """What a mission's task is made from, for the journal: enough to make it again."""
    return {
        "mission": path,
        "kept": kept(checked),
        "params": dict(options.params),
        "digest": digest(checked),
        "from": options.first,
    }
