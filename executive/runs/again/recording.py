"""A recorded run as something that can be done again: its setting, and what was asked when."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec

from executive.engine.jobs import Limits
from executive.journal import journal
from executive.journal.journal import FILE, Event
from executive.meaning import request
from executive.meaning.request import Refused, Setting, Understood
from executive.meaning.whereabouts import Whereabouts, recalled
from executive.missions.fault_plans import FaultPlan
from executive.runs import mission_task, provenance
from executive.runs.run_folder import Header
from executive.runs.task_run import Assignment
from intents import goals
from robot.errors import ConfigError, Problem
from robot.ordinary_files import read_ordinary
from robot.reality.contract import Reality


class Recording(msgspec.Struct, frozen=True, kw_only=True):
    """A run that was recorded.

    Attributes:
        folder: where.
        header: what it was started with.
        lines: of the journal, whole ones only, without their ends.
        events: the same, read.
        cut: bytes of a last line that was not finished.
    """

    folder: Path
    header: Header
    lines: list[bytes]
    events: list[Event]
    cut: int = 0

    @property
    def last_s(self) -> float:
        """Time of the last event."""
        return self.events[-1].t_s

    @property
    def ended(self) -> bool:
        """Whether it came to an end by itself."""
        for event in reversed(self.events):
            if event.event in ("outcome", "request"):
                return event.event == "outcome"
        return False

    @property
    def submitted(self) -> Event | None:
        """The newest submission of a job; None before the first."""
        asked = (event for event in reversed(self.events) if event.event == "request")
        return next((event for event in asked if event.data.get("request") == "submit"), None)

    @property
    def inputs(self) -> list[Event]:
        """What came from outside: requests and faults, whoever or whatever plan injected them."""
        return [event for event in self.events if event.event in ("request", "fault")]


def load(folder: Path) -> Recording:
    """Read a run.

    Raises:
        ConfigError: if it has no whole journal of this version.
    """
    journal.check_size(folder)
    try:
        data = read_ordinary(folder / FILE, limit=journal.MAX_BYTES)
    except OSError as error:
        raise ConfigError(f"{folder} holds no journal: {error.strerror}") from error
    *lines, rest = data.split(b"\n")
    events = [journal.decode(line) for line in lines]
    whole = [event for event in events if event is not None]
    if not whole or len(whole) < len(lines) or [e.n for e in whole] != list(range(len(whole))):
        cure = "the disk was full, or the file was changed: only a whole journal can be done again"
        raise ConfigError([Problem(f"{folder}: events are missing", suggestion=cure)])
    try:
        header = msgspec.convert(whole[0].data, Header)
    except msgspec.ValidationError as error:
        raise ConfigError(f"{folder}: the first event is no header: {error}") from None
    if whole[0].event != "run" or header.origin is None:
        cure = "do it again with this one"
        problem = f"{folder} was recorded by an older version"
        raise ConfigError([Problem(problem, suggestion=cure)])
    return Recording(folder=folder, header=header, lines=lines, events=whole, cut=len(rest))


def setting(recording: Recording, reality: Reality) -> tuple[Setting, list[str]]:
    """Robot and world of a recorded run, and what is not as it was.

    Raises:
        ConfigError: if a file is gone or wrong.
    """
    header = recording.header
    vary_seed = header.seed if header.varied else None
    where = request.setting(reality, header.world, robot=header.robot, vary_seed=vary_seed)
    assert header.origin is not None
    return where, provenance.differences(
        header.origin, provenance.of(where.world, where.description)
    )


def assigned(submitted: Event, folder: Path, where: Setting) -> Assignment:
    """What a recorded submission asked for, made again.

    Raises:
        ConfigError: if it cannot be made here and now.
    """
    made_from: dict[str, Any] = dict(submitted.data["origin"])
    return Assignment(
        understood=restore(submitted, folder, where),
        limits=Limits(**submitted.data["limits"]),
        done=frozenset(made_from.pop("done", ())),
        origin=made_from,
    )


def restore(submitted: Event, folder: Path, where: Setting) -> Understood:
    """The task of a job that was submitted, made again from what it was made from.

    Raises:
        ConfigError: if it cannot be made here and now.
    """
    made_from: dict[str, Any] = submitted.data.get("origin", {})
    text = str(submitted.data.get("text", ""))
    if "goals" not in made_from:
        return mission_task.restore(made_from, folder, where)
    try:
        asked = goals.from_builtins(made_from["goals"])
        then = msgspec.convert(made_from.get("whereabouts"), Whereabouts | None)
    except (msgspec.ValidationError, ValueError) as error:
        raise ConfigError(f"{folder}: the goals of {text!r} cannot be read: {error}") from None
    state = recalled(then, where.knowledge) if then is not None else None
    held = tuple(made_from.get("held", ()))
    meant = request.meant(text, asked, where, held=held, state=state)
    if isinstance(meant, Refused):
        raise ConfigError([Problem(f"{text!r}: {meant.reason}", suggestion=meant.suggestion)])
    return meant


def planned_faults(recording: Recording, where: Setting) -> tuple[FaultPlan, ...]:
    """What was to go wrong on purpose: the plan of the mission, if it was one.

    Raises:
        ConfigError: if the mission's file is gone or was changed.
    """
    submitted = recording.submitted
    made_from: dict[str, Any] = submitted.data.get("origin", {}) if submitted is not None else {}
    if "mission" not in made_from:
        return ()
    return mission_task.faults(made_from, recording.folder, where)
