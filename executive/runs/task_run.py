"""Carries a task out on a runtime and sums it up: what `humanoid do` is made of."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Protocol

import msgspec
from msgspec.structs import replace

from executive.engine import loop
from executive.engine.executive import Executive, Outcome
from executive.engine.jobs import UNLIMITED, Limits
from executive.journal import failures
from executive.journal.journal import FILE, Event
from executive.meaning.request import Setting, Understood
from executive.missions.fault_plans import FaultPlan
from executive.runs import run_folder
from executive.runs.faults import Injector, SlowPlanner
from executive.runs.run_folder import Expected, Placed, Summary
from executive.runs.session import Session
from executive.skills.place import PlaceParams
from executive.trees.parts import errands
from robot.clock import Clock
from robot.closing import Closing
from robot.errors import Failure
from robot.messages import LoopTiming, WorldState
from robot.planning.worker import Planner


class Progress(Closing, Protocol):
    """Shows an executive at work; a context manager."""

    def update(self) -> None:
        """Called after every tick."""
        ...


Show = Callable[[Executive], Progress]
"""Makes the progress display of an executive."""


class Job(msgspec.Struct, frozen=True, kw_only=True):
    """What is to be done, where, and how it is kept.

    Attributes:
        understood: the task.
        where: robot and world.
        seed: of everything random.
        runtime_name: "fast" or "live".
        folder: of the run.
        limits: what it may take.
        origin: what the task is made from, for the journal (default: the goals).
        done: paths of steps that are left out.
        faults: what goes wrong on purpose.
    """

    understood: Understood
    where: Setting
    seed: int
    runtime_name: str
    folder: Path | None
    limits: Limits = UNLIMITED
    origin: dict[str, Any] | None = None
    done: frozenset[str] = frozenset()
    faults: tuple[FaultPlan, ...] = ()


def do(
    job: Job,
    runtime: loop.Runtime,
    planner: Planner,
    *,
    show: Show,
    wall: Clock,
    time_of_day: Callable[[], float],
    interrupts: loop.Interrupts,
) -> Summary:
    """Do a job to its end, whatever that is, and write its folder.

    Args:
        job: the task, its setting, and where its folder is.
        runtime: entered, at time 0.
        planner: answers the skills' requests.
        show: how people see what goes on.
        wall: measures how long it takes.
        time_of_day: for the journal's sibling file.
        interrupts: looked at every tick.
    """
    slow = SlowPlanner(planner) if job.faults else None
    session = Session(
        runtime,
        slow or planner,
        description=job.where.description,
        interrupts=interrupts,
        seed=job.seed,
        folder=job.folder,
        time_of_day=time_of_day,
    )

    def begin() -> None:
        header = run_folder.header(
            job.where,
            text=job.understood.text,
            seed=job.seed,
            runtime=job.runtime_name,
        )
        now_s = runtime.clock.now_s()
        run_folder.begin(session.journal, header, now_s=now_s, folder=job.folder)
        injector = Injector(
            job.faults, runtime, session.journal, begin_s=now_s, seed=job.seed, planner=slow
        )
        session.on_tick(lambda: injector.tick(runtime.clock.now_s()))
        stack.callback(injector.close)
        session.submit(job.understood, limits=job.limits, origin=job.origin, done=job.done)

    with ExitStack() as stack:
        return see_through(session, job, begin=begin, show=show, wall=wall)


def see_through(
    session: Session, job: Job, *, begin: Callable[[], None], show: Show, wall: Clock
) -> Summary:
    """Begin, or go on, and run a session until nothing is left to do; write its summary."""
    runtime = session.runtime
    begun_s, start_s = wall.now_s(), runtime.clock.now_s()
    expected: list[Expected] = []
    with session, show(session.executive) as progress:
        session.journal.listen(lambda event: _note(event, expected))
        session.on_tick(progress.update)
        begin()
        session.run()
        outcome = session.executive.outcome
        assert outcome is not None
        past_s = runtime.clock.now_s() - start_s
        summary = _summary(job, runtime, outcome, past_s, wall.now_s() - begun_s)
        summary = replace(summary, expected=tuple(expected))
    if job.folder is not None:
        run_folder.save(job.folder, "summary.json", summary)
    return summary


def _note(event: Event, expected: list[Expected]) -> None:
    """Keep what a mission expected, for the summary."""
    if event.event == "expect":
        found = {key: event.data[key] for key in ("check", "so", "found")}
        expected.append(msgspec.convert(found, Expected))


def _summary(
    job: Job, runtime: loop.Runtime, outcome: Outcome, past_s: float, wall_s: float
) -> Summary:
    body = runtime.link.body()
    reason = outcome.failure
    return Summary(
        status="failed" if reason else "done",
        code=reason.code if reason else "done",
        cause=reason.cause if reason else "",
        suggestion=_suggestion(reason) if reason else "",
        exit_status=run_folder.exit_status(outcome),
        simulated_s=round(past_s, 3),
        wall_s=round(wall_s, 3),
        recoveries=outcome.recoveries,
        clamped=body.clamped if body else 0,
        refused=body.refused if body else 0,
        placed=_placed(job, runtime.link.world()),
        late=late_periods(runtime),
        folder=str(job.folder) if job.folder and (job.folder / FILE).exists() else "",
    )


def _suggestion(reason: Failure) -> str:
    """What a person can do; there is always something."""
    return failures.suggestion(reason.code, reason.suggestion) or "say it again to begin anew"


def late_periods(runtime: loop.Runtime) -> tuple[str, ...]:
    """How well the loops of a live run kept their time, a line each; nothing in `fast`."""
    if not isinstance(runtime, loop.Timed):
        return ()
    return tuple(_timing_words(timing) for _, timing in sorted(runtime.timing.items()))


def _timing_words(timing: LoopTiming) -> str:
    share = 100.0 * timing.late / max(timing.count, 1)
    spans_ms = [1e3 * span_s for span_s in (timing.p50_s, timing.p99_s, timing.p999_s)]
    late = f"{timing.process}: {timing.late} of {timing.count} periods late ({share:.2f} %)"
    return f"{late}, by p50 {spans_ms[0]:.2f}, p99 {spans_ms[1]:.2f}, p99.9 {spans_ms[2]:.2f} ms"


def _placed(job: Job, world: WorldState | None) -> tuple[Placed, ...]:
    """Where the things that were to be put somewhere are believed to be."""
    found: list[Placed] = []
    knowledge = job.where.knowledge
    tracks = {track.id: track for track in world.tracks} if world else {}
    for errand in errands(job.understood.task):
        if not isinstance(errand.params, PlaceParams) or errand.params.object_id not in tracks:
            continue
        info = knowledge.object(errand.params.object_id)
        X_WO = tracks[errand.params.object_id].X_WO
        if info is None or X_WO is None:
            continue
        x, y, z = X_WO.p
        on = knowledge.surface_under(X_WO)
        where = f"on the {on.name}" if on else "on no known place"
        found.append(
            Placed(object=info.full_name, where=where, x_m=round(x, 3), y_m=round(y, 3),
                   z_m=round(z, 3))
        )  # fmt: skip
    return tuple({placed.object: placed for placed in found}.values())


def closing(summary: Summary) -> list[str]:
    """The last lines: what happened, and what to do about it."""
    lines = [failures.verdict(None if summary.status == "done" else summary)]
    lines += [
        f"  {item.object} is believed to be {item.where}, at "
        f"({item.x_m:.2f}, {item.y_m:.2f}, {item.z_m:.2f}) m"
        for item in summary.placed
    ]
    for item in summary.expected:
        instead = f": {item.found}" if item.found and not item.so else ""
        lines.append(f"  {'as expected' if item.so else 'NOT SO     '}  {item.check}{instead}")
    pace = f"{summary.simulated_s:.1f} s of robot time in {summary.wall_s:.1f} s of wall time"
    lines.append(f"  {pace} ({summary.real_time_factor:.1f} x)")
    recovered = "1 recovery" if summary.recoveries == 1 else f"{summary.recoveries} recoveries"
    lines.append(f"  {recovered}, {summary.clamped} commands clamped, {summary.refused} refused")
    lines += [f"  {late}" for late in summary.late]
    if summary.folder:
        lines.append(f"  journal: {summary.folder}/journal.jsonl")
    return lines + failures.advice(summary.suggestion)
