"""Events of the journal in words, for logs that people read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

SENTENCES: Mapping[str, str] = {
    "run": "asked: {text}",
    "job": "job {job} {state}: {text}",
    "step": "{step}",
    "done": "{step}: done",
    "failure": "{step}: failed ({code}): {cause}",
    "recovery": "{step}: {remedy} ({count})",
    "no recovery": "{step}: no recovery, {why}",
    "hold": "standing still: {why}",
    "pause": "pausing: {why}",
    "paused": "paused: the robot stands",
    "break": "{step}: held at a breakpoint, it has not begun",
    "resume": "going on",
    "resumed": "going on: {why}",
    "request": "requested: {request}",
    "again": "{step}: tried again ({count})",
    "branch": "{name}: {took}",
    "held": "in the hands: {hands}",
    "warning": "warning: {text}",
    "slip": "the {side} hand is pulled at and grips harder",
    "stop": "stop: {why}",
    "cancel": "cancelling: {why}",
    "abort": "ending the task: {cause}",
    "stopping": "{step}: stopping",
    "stopped": "{step}: stopped",
    "said": "says: {text}",
    "help": "asks for help: {question}",
    "answer": "is answered: {answer}",
    "outcome": "ended: {code}",
}
"""Kind of event to a pattern over its data; kinds that are not here are told by their data."""

DRAWN = frozenset({"tree", "node", "board", "map", "pose", "phase"})
"""Kinds that are shown otherwise than in words."""


def sentence(kind: str, data: Mapping[str, Any]) -> str:
    """An event in words; empty for those that are drawn."""
    if kind in DRAWN:
        return ""
    if kind == "health":
        level = str(data.get("level", ""))
        well = f"{data.get('name', '')} is well again"
        return well if level == "OK" else f"{level.lower()}: {data.get('cause', '')}"
    if kind == "expect":
        found = f" ({data['found']})" if data.get("found") else ""
        return f"{'' if data.get('so') else 'not '}as expected: {data.get('check', '')}{found}"
    if kind == "fault":
        keys = [f"{key} {value}" for key, value in data.items() if key != "fault"]
        return ", ".join([f"fault injected: {data.get('fault', '')}", *keys])
    pattern = SENTENCES.get(kind)
    if pattern is not None:
        try:
            return pattern.format_map(data)
        except (KeyError, IndexError):  # another version wrote it
            pass
    return ", ".join([kind, *(f"{key} {value}" for key, value in data.items())])
