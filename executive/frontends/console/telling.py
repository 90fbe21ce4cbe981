"""What the page tells of a run at a time, as plain data: a few parts, each sent when it is new."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import msgspec

from executive.journal import words
from executive.journal.run import Run, Trouble
from executive.journal.snapshot import Shown, in_order, snapshot, window

T = TypeVar("T")

MOST_SAID = 200
"""Lines of what happened, the newest."""
MOST_NODES = 1500
"""Of the tree; of a larger one those around what is at work."""
MOST_TROUBLES = 20
UNSAID = frozenset({"request", "held", "stopping", "stopped", "run"})
"""Kinds of events that only machines read."""
VOICES = {"said": "robot", "heard": "person", "help": "robot"}
"""Kinds of events that somebody says, and who."""


def told(run: Run, t_s: float | None = None) -> dict[str, Any]:
    """How a run stood at a time, in parts; None: as it stands now.

    `head` is the whole in a line; `tree` the rows of the tree as ``[depth, kind, name, state, note,
    seconds]``; `said` what happened as ``[t_s, kind, text, who]``; `health` what is not well;
    `jobs` and `troubles` what was asked for and what failed.
    """
    when_s = run.end_s if t_s is None else t_s
    tree = [_row(depth, shown) for depth, shown in _tree(run, t_s)]
    return {
        "head": _head(run, when_s),
        "tree": tree,
        "said": _said(run, when_s),
        "health": _health(run, when_s),
        "jobs": _jobs(run, when_s),
        "troubles": [_trouble(one, when_s) for one in run.troubles if one.t_s <= when_s][
            -MOST_TROUBLES:
        ],
    }


def _head(run: Run, when_s: float) -> dict[str, Any]:
    board: dict[str, Any] = {}
    for change in _until(run.board, when_s, lambda change: change.t_s):
        board[change.key] = change.value
    modes = _until(run.modes, when_s, lambda one: one[0])
    endings = [one for one in run.endings if one.t_s <= when_s]
    return {
        "text": run.text,
        "about": {key: run.about.get(key, "") for key in ("world", "robot", "runtime", "seed")},
        "mode": modes[-1][1] if modes else "",
        "goal": board.get("goal") or "",
        "phase": board.get("phase") or "",
        "stop": board.get("stop") or "",
        "pause": board.get("pause") or "",
        "paused": bool(board.get("paused")),
        "help": board.get("help") or "",
        "held": board.get("held") or {},
        "ending": msgspec.to_builtins(endings[-1]) if endings else None,
        "attended": bool(run.about.get("attended")),
        "left_out": run.left_out,
    }


def _tree(run: Run, t_s: float | None) -> Sequence[tuple[int, Shown]]:
    return window(in_order(snapshot(run, t_s)), MOST_NODES)


def _row(depth: int, shown: Shown) -> list[object]:
    return [depth, shown.kind, shown.name, shown.state, shown.note, shown.took_s, shown.id]


def _said(run: Run, when_s: float) -> list[list[object]]:
    lines = _until(run.log, when_s, lambda line: line.t_s)
    kept = [line for line in lines if line.kind not in UNSAID and not _is_queueing(line.text)]
    return [
        [line.t_s, line.kind, line.text, VOICES.get(line.kind, "")] for line in kept[-MOST_SAID:]
    ]


def _is_queueing(text: str) -> bool:
    """Whether a line tells of a job that waits, which it does for an instant at least."""
    return text.startswith("job ") and " waiting: " in text[:40]


def _health(run: Run, when_s: float) -> list[list[str]]:
    found: dict[str, list[str]] = {}
    for finding in _until(run.health, when_s, lambda finding: finding.t_s):
        if finding.level == "OK":
            found.pop(finding.name, None)
        else:
            found[finding.name] = [finding.level, finding.name, finding.cause]
    return list(found.values())


def _jobs(run: Run, when_s: float) -> list[list[object]]:
    jobs: list[list[object]] = []
    for job in run.jobs:
        states = [state for t_s, state in job.states if t_s <= when_s]
        if states:
            jobs.append([job.number, job.text, states[-1]])
    return jobs


def _trouble(trouble: Trouble, when_s: float) -> dict[str, Any]:
    over = trouble.ended_s is not None and trouble.ended_s <= when_s
    return {
        "t_s": trouble.t_s,
        "step": trouble.step,
        "cause": trouble.cause,
        "code": trouble.code,
        "suggestion": trouble.suggestion,
        "measured": words.evidence(trouble.evidence),
        "tried": [remedy for t_s, remedy in trouble.tried if t_s <= when_s],
        "ended": trouble.ended if over else "",
    }


def _until(items: Sequence[T], when_s: float, time_of: Callable[[T], float]) -> Sequence[T]:
    """Those of a list in the order of time that had happened by then."""
    return items[: bisect_right(items, when_s, key=time_of)]
