"""How a run ended: the summary in its folder, and the last lines that people see."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from executive.engine import loop
from executive.journal import failures
from executive.journal.journal import FILE
from executive.meaning.knowledge import Knowledge
from executive.runs.session import Session
from executive.skills.place import PlaceParams
from executive.trees.parts import Errand, Part, Settle, children
from robot.exit_status import exit_status
from robot.failures import Failure
from robot.messages import EyesBy, LocalisedBy, LoopTiming, WorldState


class Summary(msgspec.Struct, frozen=True, kw_only=True):
    """How a run ended (`summary.json`); wall times stand only here and in `wall.jsonl`.

    `placed` says where things are believed to be; nothing here is the simulator's truth.
    `unwritten` says what the disk did not take, a line a file.
    """

    status: str
    code: str
    cause: str
    suggestion: str
    exit_status: int
    simulated_s: float
    wall_s: float
    recoveries: int
    clamped: int
    refused: int
    most_clamped: str = ""
    placed: tuple[Placed, ...] = ()
    expected: tuple[Expected, ...] = ()
    late: tuple[str, ...] = ()
    folder: str = ""
    unwritten: tuple[str, ...] = ()
    eyes: EyesBy = "oracle"
    localisation: LocalisedBy = "oracle"

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds a second of wall time."""
        return self.simulated_s / self.wall_s if self.wall_s > 0.0 else 0.0


class Expected(msgspec.Struct, frozen=True, kw_only=True):
    """Something that a mission expected at its end, whether it was so, and what was found."""

    check: str
    so: bool
    found: str = ""


class Placed(msgspec.Struct, frozen=True, kw_only=True):
    """Where an object is believed to be at the end."""

    object: str
    where: str
    x_m: float
    y_m: float
    z_m: float


def summary(session: Session, task: Part, *, since_s: float, wall_s: float) -> Summary:
    """How a session ended.

    Args:
        session: nothing is left to do in it.
        task: that it was about.
        since_s: when it began, by the runtime's clock.
        wall_s: how long it took.
    """
    outcome, runtime = session.executive.outcome, session.runtime
    assert outcome is not None
    body, folder, reason = runtime.link.body(), session.setup.folder, outcome.failure
    return Summary(
        status="failed" if reason else "done",
        code=reason.code if reason else "done",
        cause=reason.cause if reason else "",
        suggestion=_suggestion(reason) if reason else "",
        exit_status=exit_status(reason),
        simulated_s=round(session.now_s - since_s, 3),
        wall_s=round(wall_s, 3),
        recoveries=outcome.recoveries,
        clamped=body.clamped if body else 0,
        refused=body.refused if body else 0,
        most_clamped=body.most_clamped if body else "",
        placed=_placed(
            [*_to_be_put(task), *session.executive.stage.own.put_down],
            session.setup.where.knowledge,
            runtime.link.world(),
        ),
        late=late_periods(runtime),
        folder=str(folder) if folder and (folder / FILE).exists() else "",
        eyes=session.setup.where.world.eyes,
        localisation=session.setup.where.world.localisation,
    )


def _suggestion(reason: Failure) -> str:
    """What a person can do; there is always something."""
    return failures.suggestion(reason.code, reason.suggestion) or "say it again to begin anew"


def clamped_words(count: int, most: str) -> str:
    """How many values of commands the last clamp changed, and what was in the way of most."""
    return f"{count} commands clamped" + (f" (most: {most})" if most else "")


def late_periods(runtime: loop.Runtime) -> tuple[str, ...]:
    """How well the loops of a live run kept their time, a line each; nothing in `fast`."""
    if not isinstance(runtime, loop.Timed):
        return ()
    return tuple(_timing_words(timing) for _, timing in sorted(runtime.timing.items()))


def _timing_words(timing: LoopTiming) -> str:
    share = 100.0 * timing.late / max(timing.count, 1)
    spans_ms = [1e3 * span_s for span_s in (timing.p50_s, timing.p99_s, timing.p999_s)]
    late = f"{timing.process}: {timing.late} of {timing.count} periods late ({share:.2f} %)"
    but = f" but {timing.missed}" if timing.missed else " of them"
    waited = f"; simulated time waited for all{but}" if timing.waited_for else ""
    by = f"by p50 {spans_ms[0]:.2f}, p99 {spans_ms[1]:.2f}, p99.9 {spans_ms[2]:.2f} ms"
    return f"{late}, {by}{waited}"


def _to_be_put(part: Part) -> list[str]:
    """Ids of what was to be put somewhere, as far as that was settled before."""
    match part:
        case Errand(params=PlaceParams(object_id=object_id)):
            return [object_id]
        case Settle():
            return []
        case _:
            return [one for _, child in children(part) for one in _to_be_put(child)]


def _placed(
    ids: Iterable[str], knowledge: Knowledge, world: WorldState | None
) -> tuple[Placed, ...]:
    """Where the things that were put somewhere, or were to be, are believed to be."""
    found: list[Placed] = []
    tracks = {track.id: track for track in world.tracks} if world else {}
    for object_id in ids:
        info = knowledge.object(object_id)
        X_WO = tracks[object_id].X_WO if object_id in tracks else None
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


SEEN = "things were seen by its own camera, people by its lidar and depth camera"
FOUND = "it found its place by its own lidar"


def last_lines(summary: Summary) -> list[str]:
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
    lines += _own_senses(summary)
    pace = f"{summary.simulated_s:.1f} s of robot time in {summary.wall_s:.1f} s of wall time"
    lines.append(f"  {pace} ({summary.real_time_factor:.1f} x)")
    recovered = "1 recovery" if summary.recoveries == 1 else f"{summary.recoveries} recoveries"
    clamped = clamped_words(summary.clamped, summary.most_clamped)
    lines.append(f"  {recovered}, {clamped}, {summary.refused} refused")
    lines += [f"  {late}" for late in summary.late]
    if summary.folder:
        lines.append(f"  journal: {summary.folder}/journal.jsonl")
    if summary.unwritten:
        lines += [f"  NOT KEPT     {what}" for what in summary.unwritten]
        lines.append("  make room on the disk before the next run, or choose another --run-dir")
    return lines + failures.advice(summary.suggestion)


def _own_senses(summary: Summary) -> list[str]:
    """What it did with its own senses, and what was told still; none by default."""
    own = {SEEN: summary.eyes == "camera", FOUND: summary.localisation == "lidar"}
    still = [
        *(["where things are", "where people are"] if summary.eyes == "oracle" else []),
        *(["its place"] if summary.localisation == "oracle" else []),
        "what people say",
        "the map of the room",
    ]
    said = "; ".join(text for text, is_so in own.items() if is_so)
    return [f"  {said}; oracle still: {', '.join(still)}"] if said else []
