"""Steps of a run: every go at them, how they failed, what was tried, and how that ended."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from typing import Any, Literal

import msgspec

from executive.journal.failures import suggestion
from executive.journal.keeping import clipped, keep_ends
from executive.journal.run import Attempt, Finding, Result, Run, Trouble
from executive.journal.words import sentence

FAULT_MEMORY_S = 30.0
"""How long before a failure an injected fault is worth telling with it."""
MOST_ATTEMPTS, MOST_TRIED, MOST_AT_WORK = 2000, 50, 200
MOST_TROUBLES, MOST_OPEN, MOST_AROUND = 2000, 200, 20
"""What is held of each; a task of an hour has a hundred attempts."""
REST = "come to a stand"
"""The step by which the robot as a whole comes to rest; it belongs to no task and has no id."""

Data = Mapping[str, Any]

_FAILURE = ("step", "id", "code", "cause", "evidence", "suggestion")


class _Step(msgspec.Struct):
    step: str
    id: str | None = None

    @property
    def key(self) -> tuple[str, str]:
        return self.step, self.id or ""


class _Phase(_Step):
    phase: str = ""


class _Choice(msgspec.Struct):
    step: str
    code: str = ""


class StepReader:
    """Takes the events that steps are made of; raises ValueError, KeyError for broken ones."""

    def __init__(self, run: Run) -> None:
        """Tell of the steps of `run`."""
        self._run = run
        self._troubles: list[Trouble] = []  # those that have not ended
        self._faults: deque[tuple[float, str]] = deque(maxlen=MOST_AROUND)
        self._wrong: dict[str, Finding] = {}
        self.begin_task()

    def begin_task(self) -> None:
        """Another task begins: what is open of the last one is no part of it."""
        self._at_work: dict[tuple[str, str], Attempt] = {}
        self._recovering: Attempt | None = None

    # --- goes at a step ---

    def step(self, t_s: float, data: Data) -> None:
        """A go begins: at a step of the task, or at one of a remedy."""
        told = msgspec.convert(data, _Step)
        go = Attempt(step=told.step, id=told.id or "", began_s=t_s, phase_s=t_s)
        if told.key == (REST, ""):
            return
        self._at_work[told.key] = go
        if len(self._at_work) > MOST_AT_WORK:
            del self._at_work[next(iter(self._at_work))]
        if self._recovering is not None and not go.same_step(self._recovering):
            self._run.left_out += keep_ends(self._recovering.remedies, go, MOST_TRIED)
            return
        self._recovering = None
        self._run.left_out += keep_ends(self._run.task.attempts, go, MOST_ATTEMPTS)

    def phase(self, t_s: float, data: Data) -> None:
        """It does something else."""
        told = msgspec.convert(data, _Phase)
        if told.key in self._at_work:
            go = self._at_work[told.key]
            go.phase, go.phase_s = told.phase, t_s

    def done(self, t_s: float, data: Data) -> None:
        """A step that succeeds ends its own troubles, and those of the remedies in between."""
        told = msgspec.convert(data, _Step)
        self._end(t_s, told, "done")
        steps = [trouble.step for trouble in self._troubles]
        if told.step in steps:
            first = steps.index(told.step)
            _close(self._troubles[first:], t_s, "recovered")
            del self._troubles[first:]

    def stopping(self, t_s: float, data: Data) -> None:
        """It was interrupted from above."""
        self._end(t_s, msgspec.convert(data, _Step), "stopped")

    def failure(self, t_s: float, data: Data) -> None:
        """It failed, maybe before it began."""
        trouble = self._trouble(t_s, data)
        self._run.left_out += keep_ends(self._run.troubles, trouble, MOST_TROUBLES)
        keep_ends(self._troubles, trouble, MOST_OPEN)
        told = msgspec.convert(data, _Step)
        go = self._end(t_s, told, "failed")
        if go is None and told.key != (REST, ""):
            go = Attempt(
                step=told.step, id=told.id or "", began_s=t_s, ended_s=t_s, result="failed"
            )
            self._run.left_out += keep_ends(self._run.task.attempts, go, MOST_ATTEMPTS)
        if go is not None:
            go.trouble = trouble

    def _end(self, t_s: float, told: _Step, result: Result) -> Attempt | None:
        go = self._at_work.pop(told.key, None)
        if go is None and told.id is None:  # an old journal's
            keys = [key for key in self._at_work if key[0] == told.step]
            go = self._at_work.pop(keys[-1]) if keys else None
        if go is not None:
            go.ended_s, go.result = t_s, result
        return go

    # --- failures, and what was tried ---

    def _trouble(self, t_s: float, data: Data) -> Trouble:
        told = {key: data[key] for key in _FAILURE if key in data}
        trouble = msgspec.convert({"t_s": t_s, **told}, Trouble)
        trouble.suggestion = suggestion(trouble.code, trouble.suggestion)
        wrong = self._wrong.values()
        trouble.around = [f"{found.level.lower()}: {clipped(found.cause)}" for found in wrong]
        while self._faults and t_s - self._faults[0][0] > FAULT_MEMORY_S:
            self._faults.popleft()
        trouble.around += [f"{text}, at {when_s:.2f} s" for when_s, text in self._faults]
        return trouble

    def health(self, finding: Finding) -> None:
        """Something came up, or went away."""
        if finding.level == "OK":
            self._wrong.pop(finding.name, None)
        elif finding.name in self._wrong or len(self._wrong) < MOST_AROUND:
            self._wrong[finding.name] = finding

    def node_failed(self, t_s: float, number: int) -> None:
        """A node failed: it may be the one whose step failed in the same tick."""
        node = self._run.nodes[number]
        for trouble in reversed(self._troubles):
            if trouble.t_s != t_s:
                return
            if trouble.node < 0 and trouble.step == node.name:
                trouble.node = number
                return

    def recovery(self, t_s: float, data: Data) -> None:
        """A remedy was chosen: what comes next, up to another go at the step, are its steps."""
        what = f"{data['remedy']} ({data['count']})"
        self._recovering = self._tried(t_s, data, what) or self._recovering

    def no_recovery(self, t_s: float, data: Data) -> None:
        """There is no further remedy."""
        if self._tried(t_s, data, f"no recovery: {data['why']}"):
            self._recovering = None

    def again(self, t_s: float, data: Data) -> None:
        """An attempt of a mission failed, and there is another one."""
        self._tried(t_s, data, f"try again ({data['count']})")

    def _tried(self, t_s: float, data: Data, what: str) -> Attempt | None:
        """A choice goes by the code of the newest failure, maybe of a remedy's own step.

        Returns:
            The go that the choice is about, None where it is about more than a step.
        """
        told = msgspec.convert(data, _Choice)
        alike = [trouble for trouble in self._troubles if told.code in ("", trouble.code)]
        own = [trouble for trouble in alike if trouble.step == told.step]
        for trouble in (own or alike)[-1:]:
            self._run.left_out += keep_ends(trouble.tried, (t_s, clipped(what)), MOST_TRIED)
        goes = reversed(self._run.task.attempts)
        return next((go for go in goes if go.step == told.step and go.trouble is not None), None)

    def outcome(self, t_s: float, *, done: bool) -> None:
        """A task ended."""
        _close(self._troubles, t_s, "recovered" if done else "not recovered")
        self._troubles.clear()

    def fault(self, t_s: float, data: Data) -> None:
        """Somebody injected a fault."""
        self._faults.append((t_s, clipped(sentence("fault", data))))


def _close(
    troubles: list[Trouble], t_s: float, verdict: Literal["recovered", "not recovered"]
) -> None:
    for trouble in troubles:
        trouble.ended, trouble.ended_s = verdict, t_s
