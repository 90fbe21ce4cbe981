"""From a journal to its story: the newest job that is under way, else the last that ended.

Only what the journal says goes in; events of kinds that are not known here are passed over.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, cast

from executive.journal.journal import Event
from executive.journal.story import Attempt, Note, Reason, Recovery, Result, Story, same

OVER = frozenset({"done", "failed", "cancelled"})
REST = "come to a stand"
"""The step by which the robot as a whole comes to rest; it belongs to no task and has no id."""


def tell(events: Iterable[Event]) -> Story:
    """The newest job of a run: one that is under way, else the last that ended."""
    teller = _Teller()
    for event in events:
        teller.hear(event)
    return teller.story


class _Teller:
    """Builds the story event by event; a new job begins a new one."""

    def __init__(self) -> None:
        self.story = Story()
        self._number = -1
        self._job: int | None = None
        self._open: dict[tuple[str, str], Attempt] = {}
        self._failed: Attempt | None = None
        self._recovering: Attempt | None = None

    def hear(self, event: Event) -> None:
        """Take in one event."""
        if self._number >= 0 and event.n > self._number + 1:
            self.story.missing += event.n - self._number - 1
        self._number = event.n
        self.story.last_s = event.t_s
        name = event.event.replace(" ", "_")
        handler: Callable[[Event], None] | None = getattr(self, f"_on_{name}", None)
        if handler is not None:
            handler(event)
        elif event.event in _NOTES:
            self._note(event, _NOTES[event.event])

    # --- the run and its jobs ---

    def _on_run(self, event: Event) -> None:
        self.story.header = event.data
        self.story.text = str(event.data.get("text", ""))
        self.story.began_s = event.t_s

    def _on_job(self, event: Event) -> None:
        number, state = event.data.get("job"), str(event.data.get("state", ""))
        if state == "running" and number != self._job:
            self._begin(event)
            self._job = number
        if number != self._job:
            return
        self.story.state = "" if state == "waiting" else state
        if state in OVER and "code" in event.data:
            self.story.reason = _reason(event)

    def _begin(self, event: Event) -> None:
        """Another job begins: what came before is not part of its story."""
        before = self.story
        if before.attempts or before.state:
            self.story = Story(header=before.header, missing=before.missing)
            self.story.last_s = event.t_s
            self._open, self._failed, self._recovering = {}, None, None
        self.story.text = str(event.data.get("text", before.text))
        self.story.began_s = event.t_s

    def _on_outcome(self, event: Event) -> None:
        code = str(event.data.get("code", ""))
        story = self.story
        story.took_s = event.data.get("took_s")
        if code == "done":
            story.state = "done"
            return
        story.state = "cancelled" if code == "cancelled" else "failed"
        story.reason = _reason(event)

    # --- steps ---

    def _on_step(self, event: Event) -> None:
        attempt = Attempt(str(event.data.get("step", "")), str(event.data.get("id", "")), event.t_s)
        attempt.phase_s = event.t_s
        if attempt.step == REST and not attempt.id:
            return
        self._open[_key(event)] = attempt
        before = self._recovering
        if before is not None and not same(attempt, before):
            before.remedies.append(attempt)
            return
        self._recovering = None
        self.story.attempts.append(attempt)

    def _on_phase(self, event: Event) -> None:
        attempt = self._open.get(_key(event))
        if attempt is not None:
            attempt.phase, attempt.phase_s = str(event.data.get("phase", "")), event.t_s

    def _on_done(self, event: Event) -> None:
        self._end(event, "done")

    def _on_failure(self, event: Event) -> None:
        attempt = self._end(event, "failed")
        if attempt is None and _key(event) == (REST, ""):
            return
        if attempt is None:  # it failed before it began
            attempt = Attempt(
                str(event.data.get("step", "")), str(event.data.get("id", "")), event.t_s,
                ended_s=event.t_s, result="failed",
            )  # fmt: skip
            self.story.attempts.append(attempt)
        attempt.reason = _reason(event)
        self._failed = attempt

    def _on_stopping(self, event: Event) -> None:
        self._end(event, "stopped")

    def _end(self, event: Event, result: Result) -> Attempt | None:
        attempt = self._open.pop(_key(event), None)
        if attempt is None and "id" not in event.data:
            names = [key for key in self._open if key[0] == event.data.get("step")]
            attempt = self._open.pop(names[-1]) if names else None
        if attempt is not None:
            attempt.ended_s, attempt.result = event.t_s, result
        return attempt

    # --- recoveries ---

    def _on_recovery(self, event: Event) -> None:
        data = event.data
        words = f"{data.get('remedy', '')} ({data.get('count', '')})"
        self._recover(event, str(data.get("remedy", "")), words)

    def _on_no_recovery(self, event: Event) -> None:
        self._recover(event, "", f"no recovery: {event.data.get('why', '')}")

    def _recover(self, event: Event, remedy: str, words: str) -> None:
        step = event.data.get("step")
        failed = [one for one in self.story.attempts if one.step == step and one.reason is not None]
        if not failed:
            return
        recovery = Recovery(event.t_s, str(event.data.get("code", "")), remedy, words)
        failed[-1].recoveries.append(recovery)
        self._recovering = failed[-1] if remedy else None

    # --- everything else ---

    def _on_health(self, event: Event) -> None:
        level, name = event.data.get("level"), event.data.get("name", "")
        if level == "OK":
            words = f"{name} is well again"
        else:
            words = f"{str(level).lower()}: {event.data.get('cause', name)}"
        self.story.notes.append(Note(event.t_s, "health", words))

    def _on_fault(self, event: Event) -> None:
        fault = {**event.data, **_table(event.data.get("fault"))}
        kind = fault.pop("fault", "")
        particulars = ", ".join(f"{key} {value}" for key, value in fault.items())
        words = f"fault injected: {kind if isinstance(kind, str) else ''}"
        words += f" ({particulars})" if particulars else ""
        self.story.notes.append(Note(event.t_s, "fault", words))

    def _note(self, event: Event, pattern: str) -> None:
        try:
            words = pattern.format_map(event.data)
        except (KeyError, IndexError):
            words = event.event
        self.story.notes.append(Note(event.t_s, event.event, words.rstrip(": ")))


_NOTES: dict[str, str] = {
    "hold": "it stood still: {why}",
    "pause": "a person wanted it to pause: {why}",
    "paused": "it stood, paused",
    "resume": "a person let it go on",
    "stop": "a person wanted it to stop: {why}",
    "cancel": "a person cancelled it: {why}",
    "abort": "the task was ended: {cause}",
    "help": "it asked for help: {question}",
    "answer": "it was answered: {answer}",
    "resumed": "gone on with after a break: {why}",
}
"""Kinds of events that are notes, and their words."""


def _key(event: Event) -> tuple[str, str]:
    return str(event.data.get("step", "")), str(event.data.get("id", ""))


def _reason(event: Event) -> Reason:
    data = event.data
    cause = str(data.get("cause", ""))
    return Reason(str(data.get("code", "internal")), cause, _table(data.get("evidence")))


def _table(value: object) -> dict[str, Any]:
    """A table of the journal; an empty one if it is none."""
    return cast(dict[str, Any], value) if isinstance(value, dict) else {}
