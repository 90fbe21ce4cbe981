"""The mission files of a run, kept in its folder: it can be repeated when they were changed since.

They lie as they lay to one another, so that a mission still finds those that it calls::

    runs/20260101-120000-tidy/missions/1f0c.../tidy.yaml
                                              /parts/bring.yaml
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from pathlib import Path

from executive.missions.check import Checked
from executive.runs.run_folder import MISSIONS


def digest(checked: Checked) -> str:
    """Hash (SHA-256, the first 16 digits) of the mission's file and those that it calls."""
    found = hashlib.sha256()
    for path in checked.files:
        found.update(path.read_bytes() + b"\0")
    return found.hexdigest()[:16]


def kept(checked: Checked) -> str:
    """Where the mission's own file is kept, inside the folder of its run."""
    return (Path(MISSIONS) / digest(checked) / _below(checked.files)[0]).as_posix()


def keep(checked: Checked, folder: Path) -> Path:
    """Copy a mission's files into the folder of a run; returns where its own lies.

    That is the file itself where no copy can be written: a full disk stops no robot.
    """
    base = folder / MISSIONS / digest(checked)
    try:
        for path, below in zip(checked.files, _below(checked.files), strict=True):
            copy = base / below
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(path.read_bytes())
    except OSError:
        return checked.mission.path
    return folder / kept(checked)


def _below(files: Sequence[Path]) -> list[Path]:
    """Every file's path below the innermost folder that holds them all."""
    whole = [Path(os.path.abspath(path)) for path in files]  # noqa: PTH100 - links stay
    root = os.path.commonpath([path.parent for path in whole])
    return [path.relative_to(root) for path in whole]
