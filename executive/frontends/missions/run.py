"""Runs a checked mission: the same work as a sentence, with steps left out, limits and faults."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Any

import msgspec
from msgspec.structs import replace

from executive.frontends import do
from executive.frontends.reality import REALITY
from executive.frontends.supervised import FrontEnd, oversee
from executive.missions.check import Checked, Options, check
from executive.runs import mission, run_folder, task_run
from executive.runs.mission_files import keep
from robot.bringup.mailbox import Handle


class Run(msgspec.Struct, frozen=True, kw_only=True):
    """What `humanoid mission run` is asked: the mission, and how it is run.

    Attributes:
        path: of the file.
        said: beside it.
        kept: path of its copy in the run's folder.
        how: as for a sentence; world and robot are the mission's.
    """

    path: str
    said: Options
    how: do.Do
    kept: str = ""


def run(wanted: Run) -> int:
    """Check a mission whole, then run it; returns the exit status.

    Raises:
        RobotError: something in the file is wrong (ConfigError), or a part does not start.
    """
    checked = check(Path(wanted.path), REALITY, wanted.said)
    folder = wanted.how.folder or _folder(checked)
    run_folder.check_free(folder)
    copy = str(keep(checked, folder))
    wanted = replace(wanted, how=replace(wanted.how, folder=folder), kept=copy)
    if wanted.how.fast:
        return do.work_off(_job(checked, wanted), wanted.how)
    where = checked.where  # found beside the file, maybe, and not beside its copy
    said = replace(wanted.said, world=where.world.name, robot=where.robot_name)
    plain = msgspec.to_builtins(replace(wanted, said=said), enc_hook=str)
    task = {"as_json": wanted.how.as_json, "run": plain}
    return oversee(FrontEnd.MISSION, task, as_json=wanted.how.as_json)


def overseen(handle: Handle, task: dict[str, Any]) -> int:
    """Run a mission in an executive of its own, or go on with it; returns the exit status.

    It is read from its copy: an executive that is started again goes on with what was begun.

    Raises:
        RobotError: as `run` does.
    """
    wanted = msgspec.convert(task["run"], Run, dec_hook=lambda kind, value: kind(value))
    checked = check(Path(wanted.kept), REALITY, wanted.said)
    return do.work_off(_job(checked, wanted), wanted.how, handle=handle)


def _folder(checked: Checked) -> Path:
    stamp = f"{datetime.now().astimezone():%Y%m%d-%H%M%S}"
    return run_folder.folder_for(checked.mission.record.name, stamp=stamp)


def _job(checked: Checked, wanted: Run) -> task_run.Job:
    return task_run.Job(
        understood=mission.understood(checked),
        where=checked.where,
        seed=wanted.how.seed,
        runtime_name="fast" if wanted.how.fast else "live",
        folder=wanted.how.folder,
        limits=mission.limits(checked),
        origin=mission.origin(checked, wanted.said, path=wanted.path),
        done=checked.done,
        faults=checked.faults,
    )
