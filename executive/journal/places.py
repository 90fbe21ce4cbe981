"""Where runs lie: in `runs/` of the current folder, or at home where others could exchange that."""

from __future__ import annotations

import hashlib
import os
import re
from pathlib import Path

HERE = Path("runs")
NAMED = 40
"""Characters of the current folder's path that its place at home is called by."""


def at_home() -> Path | None:
    """The place at home for the runs of the current folder; None without a home.

    Each folder has its own, so that `humanoid why` in one says nothing of a run in another.
    """
    said = Path(os.environ.get("XDG_STATE_HOME", ""))
    state = said if said.is_absolute() else Path(os.path.expanduser("~/.local/state"))  # noqa: PTH111
    try:
        here = str(Path.cwd())
    except FileNotFoundError:
        return None
    words = re.sub(r"[^A-Za-z0-9]+", "-", here).strip("-")[-NAMED:].strip("-")
    digest = hashlib.sha256(os.fsencode(here)).hexdigest()[:8]
    return state / "humanoid" / "runs" / f"{words}-{digest}" if state.is_absolute() else None


def all_places() -> tuple[Path, ...]:
    """Where runs of the current folder may lie."""
    home = at_home()
    return (HERE,) if home is None or not os.access(home, os.R_OK | os.X_OK) else (HERE, home)
