"""Times, measurements and counts in words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

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


def evidence(measured: Mapping[str, object]) -> str:
    """Measurements in words: `{"gap_m": 0.1234}` is "gap 0.123 m"."""
    return ", ".join(_measurement(name, value) for name, value in measured.items())


def _measurement(name: str, value: object) -> str:
    words, _, unit = name.rpartition("_")
    known = UNITS.get(unit) if words else None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return f"{name.replace('_', ' ')} {value}"
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
