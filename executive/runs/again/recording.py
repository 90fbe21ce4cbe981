"""A recorded run as something that can be done again: its setting, and what was asked when."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import msgspec

from executive.journal import journal
from executive.journal.journal import FILE, Event
from executive.journal.why import ANEW
from executive.meaning import request
from executive.meaning.request import Refused, Setting, Understood
from executive.meaning.whereabouts import Whereabouts, recalled
from executive.missions.fault_plans import FaultPlan
from executive.runs import mission_assignment, provenance
from executive.runs.again import requests
from executive.runs.again.requests import Submit
from executive.runs.run_folder import Header
from executive.runs.task_run import Assignment
from intents import goals
from robot.errors import ConfigError, Problem
from robot.files.misfits import misfits
from robot.files.ordinary_files import is_within, read_ordinary
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
    if journal.is_linked(folder):
        raise ConfigError(
            [Problem(f"{folder}: its journal is a link", suggestion=journal.PUT_BACK)]
        )
    try:
        data = read_ordinary(folder / FILE, limit=journal.MAX_BYTES, follow_links=False)
    except OSError as error:
        raise ConfigError(f"{folder} holds no journal: {error.strerror}") from error
    if not data.strip():
        raise ConfigError([Problem(f"{folder}: its journal is empty", suggestion=ANEW)])
    *lines, rest = data.split(b"\n")
    events = [journal.decode(line) for line in lines]
    whole = [event for event in events if event is not None]
    if not whole or len(whole) < len(lines) or [e.n for e in whole] != list(range(len(whole))):
        why = "the disk was full, or the file was changed"
        problem = f"{folder}: events are missing or cannot be read; {why}"
        raise ConfigError([Problem(problem, suggestion=ANEW)])
    header = _header(whole[0], folder)
    if whole[0].event != "run" or header.origin is None:
        cure = "do it again with this one"
        problem = f"{folder} was recorded by an older version"
        raise ConfigError([Problem(problem, suggestion=cure)])
    return Recording(folder=folder, header=header, lines=lines, events=whole, cut=len(rest))


def _header(event: Event, folder: Path) -> Header:
    begin = f"{folder}: the first event is no header"
    odd = list(misfits(event.data, Header))
    if odd:
        raise ConfigError([Problem(f"{begin}: {one.message}", suggestion=one.cure) for one in odd])
    try:
        return msgspec.convert(event.data, Header)
    except msgspec.ValidationError:
        raise ConfigError(begin) from None


def setting(recording: Recording, reality: Reality) -> tuple[Setting, list[str]]:
    """Robot and world of a recorded run, and what is not as it was.

    Raises:
        ConfigError: if a file is gone or wrong.
    """
    header = recording.header
    with discreet(recording.folder):
        where = _where(header, reality)
    assert header.origin is not None
    return where, provenance.differences(
        header.origin, provenance.of(where.world, where.description)
    )


def _where(header: Header, reality: Reality) -> Setting:
    vary_seed = header.seed if header.varied else None
    there = reality.under(header.reality, eyes=header.eyes, localisation=header.localisation)
    return request.setting(there, header.world, robot=header.robot, vary_seed=vary_seed)


@contextmanager
def discreet(folder: Path) -> Generator[None]:
    """Say of files outside a run's folder no more than that they are not what they were.

    A stranger's journal may name any file as its world, its robot or its mission; what is wrong
    with that one, as such, would show what is in it.

    Raises:
        ConfigError: as the block does, without what is in such files.
    """
    try:
        yield
    except ConfigError as error:
        told = dict.fromkeys(_without_content(problem, folder) for problem in error.problems)
        raise ConfigError(list(told)) from None


def _without_content(problem: Problem, folder: Path) -> Problem:
    if problem.file is None or is_within(folder, problem.file):
        return problem
    cure = "put it back as it was, or do it anew with this one"
    return Problem("this is not what the run was recorded with", problem.file, suggestion=cure)


def assigned(submitted: Event, folder: Path, where: Setting) -> Assignment:
    """What a recorded submission asked for, made again.

    Raises:
        ConfigError: if it cannot be made here and now.
    """
    asked = requests.read(submitted)
    if not isinstance(asked, Submit):
        raise ConfigError(f"{folder}: event {submitted.n} submits nothing")
    made_from = {key: value for key, value in asked.origin.items() if key != "done"}
    return Assignment(
        understood=restore(submitted, folder, where),
        limits=asked.limits,
        done=_made_from(asked.origin, folder).done,
        origin=made_from,
    )


class MadeFrom(msgspec.Struct, frozen=True, kw_only=True):
    """The plain parts of what a job was made from: of sentences, or of a mission."""

    done: frozenset[str] = frozenset()
    held: tuple[str, ...] = ()
    mission: str = ""
    kept: str = ""
    digest: str = ""
    params: dict[str, str] = {}


def _made_from(origin: object, folder: Path) -> MadeFrom:
    try:
        return msgspec.convert(origin, MadeFrom)
    except msgspec.ValidationError as error:
        raise ConfigError(f"{folder}: what a job was made from cannot be read: {error}") from None


def restore(submitted: Event, folder: Path, where: Setting) -> Understood:
    """The task of a job that was submitted, made again from what it was made from.

    Raises:
        ConfigError: if it cannot be made here and now.
    """
    made_from: dict[str, Any] = submitted.data.get("origin", {})
    plain = _made_from(made_from, folder)
    text = str(submitted.data.get("text", ""))
    if "goals" not in made_from:
        with discreet(folder):
            return mission_assignment.restore(made_from, folder, where)
    try:
        asked = goals.from_builtins(made_from["goals"])
        then = msgspec.convert(made_from.get("whereabouts"), Whereabouts | None)
    except (ValueError, RecursionError) as error:
        raise ConfigError(f"{folder}: the goals of {text!r} cannot be read: {error}") from None
    state = recalled(then, where.knowledge) if then is not None else None
    meant = request.meant(text, asked, where, held=plain.held, state=state)
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
    if not _made_from(made_from, recording.folder).mission:
        return ()
    with discreet(recording.folder):
        return mission_assignment.faults(made_from, recording.folder, where)
