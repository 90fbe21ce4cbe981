"""A checked mission as an assignment; its files, kept in the run's folder, make it again.

A run can so be repeated when they were changed since. They lie as they lay to one another, so that
a mission still finds those that it calls::

    runs/20260101-120000-tidy/missions/1f0c.../tidy.yaml
                                              /parts/bring.yaml
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from executive.engine.jobs import Limits
from executive.meaning.request import Setting, Understood
from executive.missions.check import Checked, Options, check
from executive.missions.fault_plans import FaultPlan
from executive.runs.run_folder import MISSIONS
from executive.runs.task_run import Assignment
from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import is_within, make_below, read_ordinary, write_ordinary
from robot.files.yaml_nodes import MAX_BYTES


def assignment(checked: Checked, options: Options, *, path: str) -> Assignment:
    """A mission as what can be done in a session.

    Args:
        checked: the mission.
        options: with which it was checked.
        path: of its file, for the journal.
    """
    return Assignment(
        understood=understood(checked),
        limits=limits(checked),
        origin=origin(checked, options, path=path),
        done=checked.done,
        faults=checked.faults,
    )


def understood(checked: Checked) -> Understood:
    """A mission as what can be submitted to an executive."""
    return Understood(text=checked.mission.record.name, goals=(), task=checked.task)


def limits(checked: Checked) -> Limits:
    """What the whole job may take; the duration is in the task, so that `always` follows it."""
    speed_m_s = checked.mission.record.limits.speed_m_s
    return Limits() if speed_m_s is None else Limits(speed_m_s=speed_m_s)


def origin(checked: Checked, options: Options, *, path: str) -> dict[str, Any]:
    """What a mission's task is made from, for the journal: enough to make it again."""
    return {
        "mission": path,
        "kept": kept(checked),
        "params": dict(options.params),
        "digest": digest(checked),
        "from": options.first,
    }


# --- its files ------------------------------------------------------------------------------------


def digest(checked: Checked) -> str:
    """Hash (SHA-256, the first 16 digits) of the mission's file and those that it calls."""
    found = hashlib.sha256()
    for path in checked.files:
        found.update(read_ordinary(path, limit=MAX_BYTES) + b"\0")
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
            make_below(folder, copy.parent)
            write_ordinary(copy, read_ordinary(path, limit=MAX_BYTES))
    except OSError:
        return checked.mission.path
    return folder / kept(checked)


def _below(files: Sequence[Path]) -> list[Path]:
    """Every file's path below the innermost folder that holds them all."""
    whole = [Path(os.path.abspath(path)) for path in files]  # noqa: PTH100 - links stay
    root = os.path.commonpath([path.parent for path in whole])
    return [path.relative_to(root) for path in whole]


# --- again ----------------------------------------------------------------------------------------


def restore(made_from: dict[str, Any], folder: Path, where: Setting) -> Understood:
    """The task of a mission that was submitted in a run.

    Args:
        made_from: its origin, see `origin`.
        folder: of the run.
        where: robot and world of the run.

    Raises:
        ConfigError: the copies of its files are gone, and so are the files, changed or wrong.
    """
    return understood(_checked(made_from, folder, where))


def faults(made_from: dict[str, Any], folder: Path, where: Setting) -> tuple[FaultPlan, ...]:
    """What goes wrong on purpose in that mission; arguments and errors as for `restore`."""
    return _checked(made_from, folder, where).faults


def _copy_in(folder: Path, kept: str) -> Path | None:
    """The copy that a run keeps of its mission, if it is there; a journal may name any path."""
    path = folder / kept
    return path if path.is_file() and is_within(folder / MISSIONS, path) else None


def _checked(made_from: dict[str, Any], folder: Path, where: Setting) -> Checked:
    if "mission" not in made_from:
        raise ConfigError(f"{folder}: it is not known what the job was made from")
    path = _copy_in(folder, str(made_from.get("kept", ""))) or Path(str(made_from["mission"]))
    options = Options(
        params=made_from.get("params", {}),
        world=where.world.name,
        robot=where.robot_name,
        vary_seed=where.world.vary_seed,
    )
    checked = check(path, where.reality, options)
    if digest(checked) != made_from.get("digest"):
        cure = "put the file back as it was, or run the mission anew"
        raise ConfigError([Problem("the mission was changed since", str(path), suggestion=cure)])
    return checked
