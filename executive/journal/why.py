"""Why a run ended as it did: the chain from the symptom to its cause, from the journal alone.

No model and no guess: every line is an event, or what the table of failures says about a code.
"""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import msgspec

from executive.journal import failures, journal, reader, successor, words
from executive.journal.run import Attempt, LogLine, Reason, Run, Task, Trouble
from robot.errors import ConfigError

LEAD_UP_S = 20.0
"""How long before a failure what happened to the robot is told with it."""
MOST_NOTES, MOST_ATTEMPTS = 8, 6

IDLE = "Nothing was asked for."

Status = Literal["done", "failed", "stopped", "going on", "cut off", "idle", "unreadable"]

ANEW = "ask for it anew with `humanoid do`"


class Explanation(msgspec.Struct, frozen=True, kw_only=True):
    """An answer: `status`, the verdict in one sentence, and all of it as lines for people."""

    status: Status
    verdict: str
    lines: tuple[str, ...]

    @property
    def text(self) -> str:
        """All of it."""
        return "\n".join(self.lines)


def told(folder: Path, *, job: int | None = None, live: bool = False) -> Explanation:
    """Explain one job of a run that had several side by side; see `why`.

    Args:
        folder: of the run, with its journal.
        job: which (None: the one that people mean without naming it).
        live: as for `why`.

    Raises:
        ConfigError: there is no journal, or no such job in it.
    """
    run = reader.read(folder)
    linked, gone_on_in = journal.is_linked(folder), successor.name_of(folder)
    known = [one.number for one in run.jobs]
    if job is None:
        if len(known) < 2:
            return why(run, live=live, linked=linked, gone_on_in=gone_on_in)
        job = max(run.jobs, key=lambda one: one.weight).number
    elif job not in known:
        raise ConfigError(f"there is no job {job}; there is: {words.listed(map(str, known))}")
    asked = next(one for one in run.jobs if one.number == job)
    if {state for _, state in asked.states} <= {"waiting"}:
        verdict = f"It has not begun: it waits for its turn. Asked for: {asked.text}"
        return Explanation(status="idle", verdict=verdict, lines=(verdict,))
    one = reader.read(folder, job=job)
    return why(one, live=live, linked=linked, gone_on_in=gone_on_in)


def why(run: Run, *, live: bool = False, linked: bool = False, gone_on_in: str = "") -> Explanation:
    """Explain the newest task of a run.

    Args:
        run: what happened.
        live: the run is still under way, so that a journal without an end is nothing special.
        linked: its journal is a link, which may be read but not gone on with.
        gone_on_in: the run that went on with it, by the name of its folder; "": none.
    """
    state = run.task.state
    if state == "done":
        return _done(run)
    if state == "cancelled":
        return _stopped(run)
    if state == "failed":
        return _failed(run)
    if run.idle:
        return Explanation(status="idle", verdict=IDLE, lines=(IDLE,))
    if live:
        return _going_on(run)
    if not run.events:
        return _unreadable(run)
    return _cut_off(run, linked=linked, gone_on_in=gone_on_in)


# --- how it ended ------------------------------------------------------------------------------


def _done(run: Run) -> Explanation:
    lines = _troubles("On the way:", run.task) or ["Every step worked the first time."]
    lines += _happened(run.task.notes, "Besides:")
    return _explained("done", f"Done{_after(run)}.", run, lines)


def _failed(run: Run) -> Explanation:
    reason = run.task.reason or Reason(cause="it failed without a reason")
    verdict = f"Failed{_after(run)}: {failures.named(reason)}."
    last = _to_blame(run.task, reason)
    if last is not None:
        lines = _because(run.task, last)
    else:
        lines = _doing(run)
        if reason.evidence:
            lines.append(f"Measured: {words.evidence(reason.evidence)}.")
    lines += _lead_up(run.task, last)
    lines += _before(run.task, last)
    lines += failures.advice(failures.suggestion(reason.code), end=".")
    return _explained("failed", verdict, run, lines)


def _stopped(run: Run) -> Explanation:
    task = run.task
    cause = task.reason.cause if task.reason else "stopped on request"
    lines = _doing(run) + _troubles("What had gone wrong:", task)
    asked = [note for note in task.notes if note.kind in ("stop", "cancel", "abort")]
    if asked and run.end_s > asked[-1].t_s:
        lines.append(f"It came to rest in {run.end_s - asked[-1].t_s:.1f} s.")
    lines += _happened(task.notes, "What happened:")
    lines += _before(task, None)
    return _explained("stopped", f"Stopped{_after(run)}: {cause}.", run, lines)


def _going_on(run: Run) -> Explanation:
    verdict = f"It is still going on, {run.end_s - run.task.began_s:.1f} s after it began."
    lines = _doing(run, "It is doing") + _trouble_so_far(run.task)
    return _explained("going on", verdict, run, lines)


def _unreadable(run: Run) -> Explanation:
    """Of a journal without a single event, as a cut or an edit may leave it."""
    holds = "nothing that can be read" if run.unreadable or run.cut else "nothing: it is empty"
    lines = failures.advice(ANEW, end=".")
    return _explained("unreadable", f"The journal holds {holds}.", run, lines)


def _cut_off(run: Run, *, linked: bool, gone_on_in: str) -> Explanation:
    verdict = f"The journal ends at {run.end_s:.1f} s without an outcome: it was cut off."
    cure = "go on where it was with `humanoid resume`"
    if run.about.get("runtime") != "fast":  # that one has no processes of its own
        cure += ", or see logs/ in its folder"
    if gone_on_in:
        cure = f"it was gone on with: `humanoid why {gone_on_in}` says how that went"
    elif run.unreadable or run.missing or not run.asked:  # as `humanoid resume` refuses
        cure = ANEW
    elif linked:
        cure = f"{journal.PUT_BACK}, then go on with `humanoid resume`"
    lines = _doing(run) + _trouble_so_far(run.task) + failures.advice(cure, end=".")
    return _explained("cut off", verdict, run, lines)


def _explained(status: Status, verdict: str, run: Run, lines: list[str]) -> Explanation:
    head = [verdict]
    if run.task.text:
        head.append(f"Asked for: {run.task.text}{_setting(run)}")
    done, count = run.of_jobs
    if count > 1:
        head.append(f"That is of one job; {done} of {count} jobs are done.")
    if run.missing:
        lines.append(
            f"({run.missing} events are missing from the journal: the disk was full, "
            "or the file was changed.)"
        )
    if run.unreadable:
        count = f"{run.unreadable} line{'' if run.unreadable == 1 else 's'}"
        lines.append(f"({count} of the journal cannot be read, from line {run.unreadable_line}.)")
    return Explanation(status=status, verdict=verdict, lines=(*head, *lines))


# --- the chain ---------------------------------------------------------------------------------


def _to_blame(task: Task, reason: Reason) -> Attempt | None:
    """The go at a step whose failure became that of the whole; none if it came from above."""
    failed = _troubled(task)
    exact = [go for go in failed if _became(go, reason)]
    found = exact or [go for go in failed if go.trouble and go.trouble.code == reason.code]
    if found:
        return found[-1]
    with_it = [go for go in failed if any(_became(remedy, reason) for remedy in go.remedies)]
    return with_it[-1] if with_it else None


def _became(go: Attempt, reason: Reason) -> bool:
    trouble = go.trouble
    wanted = (reason.code, reason.cause, reason.evidence)
    return trouble is not None and (trouble.code, trouble.cause, trouble.evidence) == wanted


def _because(task: Task, last: Attempt) -> list[str]:
    """Every go at the step that was given up, the last one first: from symptom to cause."""
    failed = [go for go in task.of(last) if go.trouble is not None]
    heading = f'Because "{last.step}" failed'
    heading += f" {words.times(len(failed))}, the last time first:" if len(failed) > 1 else ":"
    lines = [heading]
    for go in list(reversed(failed))[:MOST_ATTEMPTS]:
        lines += _go(go)
    if len(failed) > MOST_ATTEMPTS:
        lines.append(f"  and {len(failed) - MOST_ATTEMPTS} times before that")
    return lines


def _troubles(heading: str, task: Task) -> list[str]:
    """Every go at each step that did not work at once, in order."""
    steps = {go.of_step: go for go in reversed(_troubled(task))}
    lines = [heading] if steps else []
    for first in reversed(steps.values()):
        lines.append(f'  "{first.step}"')
        for go in task.of(first):
            if go.trouble is not None:
                lines += _go(go)
            elif go.result == "done" and go.ended_s is not None:
                lines.append(f"  {words.at(go.ended_s)}  done")
    return lines


def _go(go: Attempt) -> list[str]:
    """One go that failed: where it was, what was measured, what was done about it."""
    assert go.trouble is not None
    lines = [f"  {words.at(go.trouble.t_s)}  {_measured(go.trouble)}"]
    if go.phase:
        lines.append(f"{_INDENT}while {_phase(go)}")
    troubles = [one.trouble for one in (go, *go.remedies) if one.trouble is not None]
    tried = sorted((one for trouble in troubles for one in trouble.tried), key=lambda one: one[0])
    lines += [f"{_INDENT}then: {what}" for _, what in tried]
    lines += [f"{_INDENT}  {_remedy(remedy)}" for remedy in go.remedies]
    return lines


def _remedy(go: Attempt) -> str:
    if go.trouble is not None:
        return f"{go.step}: failed, {_measured(go.trouble)}"
    if go.ended_s is None:
        return f"{go.step}: {go.phase or 'begun'}"
    return f"{go.step}: {go.result} in {go.ended_s - go.began_s:.1f} s"


def _lead_up(task: Task, last: Attempt | None) -> list[str]:
    """What happened to the robot shortly before the first failure, and since."""
    ends_s = [go.ended_s for go in task.of(last) if go.ended_s is not None] if last else []
    since_s = ends_s[0] - LEAD_UP_S if ends_s else 0.0
    notes = [note for note in task.notes if note.t_s >= since_s]
    return _happened(notes, "What happened around it:")


def _happened(notes: list[LogLine], heading: str) -> list[str]:
    if not notes:
        return []
    shown = notes if len(notes) <= MOST_NOTES else [*notes[:4], *notes[-4:]]
    lines = [f"  {words.at(note.t_s)}  {note.text}" for note in shown]
    if len(shown) < len(notes):
        lines.insert(4, f"{_INDENT}... {len(notes) - len(shown)} more ...")
    return [heading, *lines]


def _trouble_so_far(task: Task) -> list[str]:
    lines = _troubles("Trouble so far:", task)
    return [*lines, *_happened(task.notes, "What happened:"), *_before(task, task.current)]


def _troubled(task: Task) -> list[Attempt]:
    return [go for go in task.attempts if go.trouble is not None]


def _before(task: Task, last: Attempt | None) -> list[str]:
    """What had been done before."""
    done = [go.step for go in task.attempts if go.result == "done"]
    if last is not None:
        done = [step for step in done if step != last.step]
    return [f"Done before: {words.listed(dict.fromkeys(done))}."] if done else []


def _doing(run: Run, opening: str = "It was doing") -> list[str]:
    """What it was doing at the end of the journal."""
    task = run.task
    going = task.current
    if going is None and task.attempts and task.attempts[-1].result == "stopped":
        going = task.attempts[-1]
    if going is None:
        return [_waiting_for_help(task) or "Nothing was being done at that moment."]
    since_s = run.end_s - going.began_s
    text = f'{opening} "{going.step}" since {going.began_s:.1f} s ({since_s:.1f} s)'
    return [f"{text}, {_phase(going)}." if going.phase else f"{text}."]


def _waiting_for_help(task: Task) -> str:
    """What a person had been asked for and had not done by the end; empty if nothing."""
    asked = [note for note in task.notes if note.kind in ("help", "answer")]
    if not asked or asked[-1].kind == "answer":
        return ""
    return f"It was waiting for a person since {asked[-1].t_s:.1f} s: {asked[-1].text}."


# --- words -------------------------------------------------------------------------------------

_INDENT = " " * 13


def _measured(trouble: Trouble) -> str:
    """A failure with its evidence."""
    return failures.named(trouble, measured=words.evidence(trouble.evidence))


def _phase(go: Attempt) -> str:
    end_s = go.ended_s
    span = f", for {end_s - go.phase_s:.1f} s" if end_s is not None else ""
    return f"{go.phase}{span}"


def _after(run: Run) -> str:
    took_s = run.task.took_s
    return f" after {run.end_s - run.task.began_s if took_s is None else took_s:.1f} s"


def _setting(run: Run) -> str:
    about = run.about
    parts = [str(about[key]) for key in ("runtime", "world") if about.get(key)]
    if about.get("seed") is not None:
        parts.append(f"seed {about['seed']}{', varied' if about.get('varied') else ''}")
    return f"  ({', '.join(parts)})" if parts else ""
