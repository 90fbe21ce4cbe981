"""A mission's task made again from what the journal says of it: for replays, and to go on."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from executive.meaning.request import Setting, Understood
from executive.missions.check import Checked, Options, check
from executive.missions.fault_plans import FaultPlan
from executive.runs.mission import understood
from executive.runs.mission_files import digest
from robot.errors import ConfigError, Problem


def restore(made_from: dict[str, Any], folder: Path, where: Setting) -> Understood:
    """The task of a mission that was submitted in a run.

    Args:
        made_from: its origin, see `executive.runs.mission.origin`.
        folder: of the run.
        where: robot and world of the run.

    Raises:
        ConfigError: the copies of its files are gone, and so are the files, changed or wrong.
    """
    return understood(_checked(made_from, folder, where))


def faults(made_from: dict[str, Any], folder: Path, where: Setting) -> tuple[FaultPlan, ...]:
    """What goes wrong on purpose in that mission; arguments and errors as for `restore`."""
    return _checked(made_from, folder, where).faults


def _checked(made_from: dict[str, Any], folder: Path, where: Setting) -> Checked:
    if "mission" not in made_from:
        raise ConfigError(f"{folder}: it is not known what the job was made from")
    path = folder / str(made_from.get("kept", ""))
    if not path.is_file():
        path = Path(str(made_from["mission"]))
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
