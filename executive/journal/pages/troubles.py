"""Failures of a run, with what was tried and how they ended."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

import msgspec

from executive.journal.pages.model import Ending, Run, Trouble, findings
from executive.journal.pages.words import sentence
from robot.errors import CATALOGUE

FAULT_MEMORY_S = 30.0
"""How long before a failure an injected fault is worth telling with it."""

_FAILURE = ("step", "id", "code", "cause", "evidence", "suggestion")


class Troubles:
    """Takes the events that failures are made of; raises ValueError, KeyError for broken ones."""

    def __init__(self, run: Run) -> None:
        """Tell of the failures of `run`."""
        self._run = run
        self._open: list[Trouble] = []
        self._faults: list[tuple[float, str]] = []

    def failure(self, t_s: float, data: Mapping[str, Any]) -> None:
        """A step failed."""
        told = {key: data[key] for key in _FAILURE if key in data}
        trouble = msgspec.convert({"t_s": t_s, **told}, Trouble)
        trouble.suggestion = trouble.suggestion or suggestion(trouble.code)
        active = findings(self._run.health).values()
        trouble.around = [f"{found.level.lower()}: {found.cause}" for found in active]
        for when_s, text in self._faults:
            if t_s - when_s <= FAULT_MEMORY_S:
                trouble.around.append(f"{text}, at {when_s:.2f} s")
        self._run.troubles.append(trouble)
        self._open.append(trouble)

    def node_failed(self, t_s: float, number: int) -> None:
        """A node failed: it may be the one whose step failed in the same tick."""
        node = self._run.nodes[number]
        for trouble in reversed(self._open):
            if trouble.t_s != t_s:
                return
            if trouble.node < 0 and trouble.step == node.name:
                trouble.node = number
                return

    def recovery(self, t_s: float, data: Mapping[str, Any]) -> None:
        """A remedy was chosen."""
        self._tried(t_s, data, f"{data['remedy']} ({data['count']})")

    def again(self, t_s: float, data: Mapping[str, Any]) -> None:
        """An attempt of a mission failed, and there is another one."""
        self._tried(t_s, data, f"try again ({data['count']})")

    def no_recovery(self, t_s: float, data: Mapping[str, Any]) -> None:
        """There is no further remedy."""
        self._tried(t_s, data, f"no further recovery: {data['why']}")

    def _tried(self, t_s: float, data: Mapping[str, Any], what: str) -> None:
        """A remedy is chosen by the code of the newest failure, maybe of a remedy's own step."""
        step, code = data["step"], data["code"]
        alike = [trouble for trouble in self._open if trouble.code == code]
        own = [trouble for trouble in alike if trouble.step == step]
        for trouble in (own or alike)[-1:]:
            trouble.tried.append((t_s, what))

    def done(self, t_s: float, data: Mapping[str, Any]) -> None:
        """A step that succeeds ends its own troubles, and those of the remedies in between."""
        step = data["step"]
        first = next((i for i, t in enumerate(self._open) if t.step == step), len(self._open))
        for trouble in self._open[first:]:
            trouble.ended, trouble.ended_s = "recovered", t_s
        del self._open[first:]

    def outcome(self, t_s: float, data: Mapping[str, Any]) -> None:
        """A task ended."""
        ending = msgspec.convert({"t_s": t_s, **data}, Ending)
        if not ending.suggestion:
            ending = msgspec.structs.replace(ending, suggestion=suggestion(ending.code))
        self._run.endings.append(ending)
        verdict: Literal["recovered", "not recovered"] = (
            "recovered" if ending.code == "done" else "not recovered"
        )
        for trouble in self._open:
            trouble.ended, trouble.ended_s = verdict, t_s
        self._open.clear()

    def fault(self, t_s: float, data: Mapping[str, Any]) -> None:
        """Somebody injected a fault."""
        self._faults.append((t_s, sentence("fault", data)))


def suggestion(code: str) -> str:
    """What a person can do about a failure, as the catalogue has it."""
    kind = CATALOGUE.get(code)
    return kind.suggestion if kind else ""
