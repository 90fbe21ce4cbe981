"""Why a run ended as it did: the chain from the symptom to its cause, from the journal alone.

No model and no guess: every line is an event, or what the table of failures says about a code.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

import msgspec

from executive.journal import wording
from executive.journal.journal import Event
from executive.journal.story import Attempt, Note, Reason, Story, base
from executive.journal.telling import tell

LEAD_UP_S = 20.0
"""How long before a failure what happened to the robot is told with it."""
MOST_NOTES, MOST_ATTEMPTS = 8, 6

IDLE = "Nothing was asked for."

Status = Literal["done", "failed", "stopped", "going on", "cut off", "idle"]


class Explanation(msgspec.Struct, frozen=True, kw_only=True):
    """An answer: `status`, the verdict in one sentence, and all of it as lines for people."""

    status: Status
    verdict: str
    lines: tuple[str, ...]

    @property
    def text(self) -> str:
        """All of it."""
        return "\n".join(self.lines)


def why(events: Iterable[Event], *, live: bool = False) -> Explanation:
    """Explain the newest job of a run.

    Args:
        events: of the journal, from its beginning.
        live: the run is still under way, so that a journal without an end is nothing special.
    """
    story = tell(events)
    if story.state == "done":
        return _done(story)
    if story.state == "cancelled":
        return _stopped(story)
    if story.state == "failed":
        return _failed(story)
    if story.idle:
        return Explanation(status="idle", verdict=IDLE, lines=(IDLE,))
    return _going_on(story) if live else _cut_off(story)


# --- how it ended ------------------------------------------------------------------------------


def _done(story: Story) -> Explanation:
    verdict = f"Done{_after(story)}."
    troubled = [one for one in story.attempts if one.reason is not None]
    lines: list[str] = []
    if troubled:
        lines.append("On the way:")
        for first in _firsts(troubled):
            lines += _tries(story, first)
    else:
        lines.append("Every step worked the first time.")
    lines += _happened(story.notes, "Besides:")
    return _explained("done", verdict, story, lines)


def _failed(story: Story) -> Explanation:
    reason = story.reason or Reason("internal", "it failed without a reason")
    verdict = f"Failed{_after(story)}: {reason.cause} ({reason.code})."
    last = _to_blame(story, reason)
    lines: list[str] = []
    if last is None:
        lines += _doing(story)
        if reason.evidence:
            lines.append(f"Measured: {wording.evidence(reason.evidence)}.")
    else:
        lines += _because(story, last)
    lines += _lead_up(story, last)
    lines += _before(story, last)
    if reason.suggestion:
        lines.append(f"What to do: {reason.suggestion}.")
    return _explained("failed", verdict, story, lines)


def _stopped(story: Story) -> Explanation:
    cause = story.reason.cause if story.reason else "stopped on request"
    verdict = f"Stopped{_after(story)}: {cause}."
    lines = _doing(story)
    asked = [note for note in story.notes if note.kind in ("stop", "cancel", "abort")]
    if asked and story.last_s > asked[0].t_s:
        lines.append(f"It came to rest in {story.last_s - asked[0].t_s:.1f} s.")
    lines += _happened(story.notes, "What happened:")
    lines += _before(story, None)
    return _explained("stopped", verdict, story, lines)


def _going_on(story: Story) -> Explanation:
    verdict = f"It is still going on, {story.last_s - story.began_s:.1f} s after it began."
    lines = _doing(story, "It is doing") + _trouble_so_far(story)
    return _explained("going on", verdict, story, lines)


def _cut_off(story: Story) -> Explanation:
    verdict = f"The journal ends at {story.last_s:.1f} s without an outcome: it was cut off."
    lines = _doing(story) + _trouble_so_far(story)
    lines.append(
        "What to do: go on where it was with `humanoid resume`, or see logs/ in its folder."
    )
    return _explained("cut off", verdict, story, lines)


def _explained(status: Status, verdict: str, story: Story, lines: list[str]) -> Explanation:
    head = [verdict]
    if story.text:
        head.append(f"Asked for: {story.text}{_setting(story)}")
    if story.missing:
        lines.append(f"({story.missing} events are missing from the journal: the disk was full.)")
    return Explanation(status=status, verdict=verdict, lines=(*head, *lines))


# --- the chain ---------------------------------------------------------------------------------


def _to_blame(story: Story, reason: Reason) -> Attempt | None:
    """The go at a step whose failure became that of the whole; none if it came from above."""
    failed = [one for one in story.attempts if one.reason is not None]
    exact = [one for one in failed if one.reason == reason]
    same = [one for one in failed if one.reason is not None and one.reason.code == reason.code]
    found = exact or same
    if found:
        return found[-1]
    remedies = [one for go in failed for one in go.remedies if one.reason == reason]
    if remedies:
        return next(go for go in reversed(failed) if remedies[-1] in go.remedies)
    return None


def _because(story: Story, last: Attempt) -> list[str]:
    """Every go at the step that was given up, the last one first: from symptom to cause."""
    failed = [one for one in story.of(last) if one.reason is not None and one.ended_s is not None]
    heading = f'Because "{last.step}" failed'
    heading += f" {wording.times(len(failed))}, the last time first:" if len(failed) > 1 else ":"
    lines = [heading]
    for one in list(reversed(failed))[:MOST_ATTEMPTS]:
        lines += _go(one)
    if len(failed) > MOST_ATTEMPTS:
        lines.append(f"  and {len(failed) - MOST_ATTEMPTS} times before that")
    return lines


def _tries(story: Story, first: Attempt) -> list[str]:
    """Every go at a step that was done in the end, in order."""
    lines = [f'  "{first.step}"']
    for one in story.of(first):
        if one.reason is not None:
            lines += _go(one)
        elif one.result == "done" and one.ended_s is not None:
            lines.append(f"  {wording.at(one.ended_s)}  done")
    return lines


def _go(one: Attempt) -> list[str]:
    """One go that failed: where it was, what was measured, what was done about it."""
    reason = one.reason or Reason("internal", "")
    lines = [f"  {wording.at(one.ended_s or one.began_s)}  {_measured(reason)}"]
    if one.phase:
        lines.append(f"{_INDENT}while {_phase(one)}")
    lines += [f"{_INDENT}then: {recovery.words}" for recovery in one.recoveries]
    lines += [f"{_INDENT}  {_remedy(remedy)}" for remedy in one.remedies]
    return lines


def _remedy(one: Attempt) -> str:
    if one.reason is not None:
        return f"{one.step}: failed, {_measured(one.reason)}"
    if one.ended_s is None:
        return f"{one.step}: {one.phase or 'begun'}"
    return f"{one.step}: {one.result} in {one.ended_s - one.began_s:.1f} s"


def _lead_up(story: Story, last: Attempt | None) -> list[str]:
    """What happened to the robot shortly before the first failure, and since."""
    ends_s = [one.ended_s for one in story.of(last) if one.ended_s is not None] if last else []
    since_s = ends_s[0] - LEAD_UP_S if ends_s else 0.0
    notes = [note for note in story.notes if note.t_s >= since_s]
    return _happened(notes, "What happened around it:")


def _happened(notes: list[Note], heading: str) -> list[str]:
    if not notes:
        return []
    shown = notes if len(notes) <= MOST_NOTES else [*notes[:4], *notes[-4:]]
    lines = [f"  {wording.at(note.t_s)}  {note.words}" for note in shown]
    if len(shown) < len(notes):
        lines.insert(4, f"{_INDENT}... {len(notes) - len(shown)} more ...")
    return [heading, *lines]


def _trouble_so_far(story: Story) -> list[str]:
    lines: list[str] = []
    troubled = [one for one in story.attempts if one.reason is not None]
    if troubled:
        lines.append("Trouble so far:")
        for first in _firsts(troubled):
            lines += _tries(story, first)
    return [*lines, *_happened(story.notes, "What happened:"), *_before(story, story.current)]


def _before(story: Story, last: Attempt | None) -> list[str]:
    """What had been done before."""
    done = [one.step for one in story.attempts if one.result == "done"]
    if last is not None:
        done = [step for step in done if step != last.step]
    return [f"Done before: {wording.listed(dict.fromkeys(done))}."] if done else []


def _doing(story: Story, opening: str = "It was doing") -> list[str]:
    """What it was doing at the end of the journal."""
    going = story.current
    if going is None and story.attempts and story.attempts[-1].result == "stopped":
        going = story.attempts[-1]
    if going is None:
        return ["Nothing was being done at that moment."]
    since_s = story.last_s - going.began_s
    text = f'{opening} "{going.step}" since {going.began_s:.1f} s ({since_s:.1f} s)'
    return [f"{text}, {_phase(going)}." if going.phase else f"{text}."]


# --- words -------------------------------------------------------------------------------------

_INDENT = " " * 13


def _measured(reason: Reason) -> str:
    """A failure with its evidence."""
    measured = wording.evidence(reason.evidence)
    return f"{reason.cause} ({reason.code}{f': {measured}' if measured else ''})"


def _phase(one: Attempt) -> str:
    end_s = one.ended_s
    span = f", for {end_s - one.phase_s:.1f} s" if end_s is not None else ""
    return f"{one.phase}{span}"


def _after(story: Story) -> str:
    took_s = story.took_s if story.took_s is not None else story.last_s - story.began_s
    return f" after {took_s:.1f} s"


def _setting(story: Story) -> str:
    header = story.header
    parts = [str(header[key]) for key in ("runtime", "world") if header.get(key)]
    if header.get("seed") is not None:
        parts.append(f"seed {header['seed']}{', varied' if header.get('varied') else ''}")
    return f"  ({', '.join(parts)})" if parts else ""


def _firsts(attempts: list[Attempt]) -> list[Attempt]:
    """One go of each step."""
    return list({(one.step, base(one.id)): one for one in reversed(attempts)}.values())[::-1]
