"""Results on disk, and the page made of them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import msgspec

from benchmarks.machine import Machine

ROOT = Path(__file__).resolve().parent.parent
RESULTS = Path(__file__).resolve().parent / "results"
PAGE = ROOT / "docs" / "benchmarks.md"


class Results(msgspec.Struct, frozen=True, kw_only=True):
    """What one benchmark gave, where and when."""

    machine: Machine
    quick: bool
    took_s: float
    outcomes: dict[str, dict[str, Any]]


def save(name: str, results: Results) -> Path:
    """Write results; a quick run's lie beside the full one's."""
    path = _path(name, quick=results.quick)
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(msgspec.json.format(msgspec.json.encode(results), indent=1) + b"\n")
    return path


def newest(name: str) -> Results | None:
    """The full results if there are any, else the quick ones."""
    for quick in (False, True):
        path = _path(name, quick=quick)
        if path.exists():
            return msgspec.json.decode(path.read_bytes(), type=Results)
    return None


def _path(name: str, *, quick: bool) -> Path:
    return RESULTS / (f"{name}.quick.json" if quick else f"{name}.json")


def write(name: str, tables: str, results: Results) -> None:
    """Put a benchmark's tables between its marks in the page."""
    note = "Quick run: fewer and shorter than the full one. " if results.quick else ""
    origin = f"*{note}{results.machine}; took {results.took_s / 60.0:.0f} min.*"
    begin, end = f"<!-- {name}: generated -->", f"<!-- {name}: end -->"
    text = PAGE.read_text(encoding="utf-8")
    block = f"{begin}\n\n{origin}\n\n{tables}\n\n{end}"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(text):
        raise ValueError(f"{PAGE} has no marks for {name!r}")
    PAGE.write_text(pattern.sub(lambda _: block, text), encoding="utf-8")
