"""What a journal says, in words: events, times, measurements, counts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, cast

AS_IT_HAPPENS: Mapping[str, str] = {
    "run": "asked: {text}",
    "job": "job {job} {state}: {text}",
    "step": "{step}",
    "done": "{step}: done",
    "failure": "{step}: failed ({code}): {cause}",
    "recovery": "{step}: {remedy} ({count})",
    "no recovery": "{step}: no recovery, {why}",
    "hold": "standing still: {why}",
    "pause": "pausing: {why}",
    "paused": "paused: nothing moves",
    "break": "{step}: held at a breakpoint, it has not begun",
    "request": "requested: {request}",
    "again": "{step}: tried again ({count})",
    "settled": "{step}: {means}",
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

IN_HINDSIGHT: Mapping[str, str] = {
    "hold": "it stood still: {why}",
    "pause": "a person wanted it to pause: {why}",
    "paused": "it was paused",
    "resume": "a person let it go on",
    "stop": "a person wanted it to stop: {why}",
    "cancel": "a person cancelled it: {why}",
    "abort": "the task was ended: {cause}",
    "help": "it asked for help: {question}",
    "answer": "it was answered: {answer}",
    "resumed": "gone on with after a break: {why}",
}
"""What happened to the robot, or what a person did: kind of event to a pattern over its data."""

DRAWN = frozenset({"tree", "node", "board", "map", "pose", "phase"})
"""Kinds that are shown otherwise than in words."""

UNITS: Mapping[str, str] = {
    "m": "m",
    "s": "s",
    "rad": "rad",
    "c": "°C",
    "hz": "Hz",
    "n": "N",
    "nm": "N m",
    "kg": "kg",
    "w": "W",
    "v": "V",
}
"""Ending of a measurement's name to its unit."""


def sentence(kind: str, data: Mapping[str, Any]) -> str:
    """An event as it happens; empty for those that are drawn."""
    if kind in DRAWN:
        return ""
    if kind in _OF_KIND:
        return _OF_KIND[kind](data)
    filled = _filled(AS_IT_HAPPENS, kind, data)
    return filled or ", ".join([kind, *(f"{key} {told(value)}" for key, value in data.items())])


def in_hindsight(kind: str, data: Mapping[str, Any]) -> str:
    """An event as it is told afterwards; empty for what did not happen to the robot as a whole.

    Empty as well for what every run waits for at its start.
    """
    if data.get("beginning"):
        return ""
    if kind in ("health", "fault"):
        return _OF_KIND[kind](data)
    if kind not in IN_HINDSIGHT:
        return ""
    return _filled(IN_HINDSIGHT, kind, data).rstrip(": ") or kind


def _filled(patterns: Mapping[str, str], kind: str, data: Mapping[str, Any]) -> str:
    try:
        return patterns[kind].format_map(data)
    except (KeyError, IndexError):  # another version wrote it
        return ""


def _health(data: Mapping[str, Any]) -> str:
    level, name = str(data.get("level", "")), data.get("name", "")
    return (
        f"{name} is well again" if level == "OK" else f"{level.lower()}: {data.get('cause', name)}"
    )


def _expect(data: Mapping[str, Any]) -> str:
    found = f" ({data['found']})" if data.get("found") else ""
    return f"{'' if data.get('so') else 'not '}as expected: {data.get('check', '')}{found}"


def _fault(data: Mapping[str, Any]) -> str:
    nested = data.get("fault")
    every = {**data, **(cast(dict[str, Any], nested) if isinstance(nested, dict) else {})}
    kind = every.pop("fault", "")
    particulars = ", ".join(f"{key} {told(value)}" for key, value in every.items())
    head = f"fault injected: {kind if isinstance(kind, str) else ''}"
    return f"{head} ({particulars})" if particulars else head


def _heard(data: Mapping[str, Any]) -> str:
    whose = ", who is simulated," if data.get("simulated") else ""
    return f"{data.get('who', 'somebody')}{whose} says: {data.get('text', '')}"


def _branch(data: Mapping[str, Any]) -> str:
    answer = "yes" if data.get("took") == "then" else "no"
    return f"{data.get('step', 'a condition')}: {answer}"


def _resumed(data: Mapping[str, Any]) -> str:
    what = f" with “{data['text']}”" if data.get("text") else ""
    return f"going on{what}: {data.get('why', '')}"


def _let_go_on(data: Mapping[str, Any]) -> str:
    return "nothing is left to go on with" if data.get("over") else "going on"


_OF_KIND = {
    "health": _health, "heard": _heard, "expect": _expect, "fault": _fault, "resume": _let_go_on,
    "resumed": _resumed, "branch": _branch,
}  # fmt: skip


def told(value: object) -> str:
    """A value of a journal; numbers are as fine as anything that is measured: a millimetre."""
    if isinstance(value, float):
        return f"{round(value, 3 if abs(value) < 1000.0 else 0) + 0.0:.15g}"
    if isinstance(value, Mapping):
        entries = cast("Mapping[object, object]", value).items()
        return ", ".join(f"{key}: {told(item)}" for key, item in entries) or "nothing"
    if isinstance(value, list | tuple):
        return ", ".join(map(told, cast("list[object]", value)))
    return str(value)


def evidence(measured: Mapping[str, object]) -> str:
    """Measurements in words: `{"gap_m": 0.1234}` is "gap 0.123 m"."""
    return ", ".join(_measurement(name, value) for name, value in measured.items())


def _measurement(name: str, value: object) -> str:
    words, _, unit = name.rpartition("_")
    known = UNITS.get(unit) if words else None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return f"{name.replace('_', ' ')} {told(value)}"
    if known is None:
        return f"{name.replace('_', ' ')} {value:.4g}"
    return f"{words.replace('_', ' ')} {value:.3g} {known}"


def at(time_s: float) -> str:
    """A time of the run, as wide as its neighbours above and below."""
    return f"{time_s:7.1f} s"


def times(count: int) -> str:
    """How often, in words."""
    return {1: "once", 2: "twice"}.get(count, f"{count} times")


def listed(names: Iterable[str], *, most: int = 8) -> str:
    """Names after one another, the first of them only when there are too many."""
    names = list(names)
    rest = len(names) - most
    return "; ".join(names[:most]) + (f"; and {rest} more" if rest > 0 else "")
