"""What `humanoid motors simulate-failsafe` and `rearm` do."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from executive.frontends.composition_root import REALITY
from executive.frontends.driving import chosen
from executive.frontends.motors.options import Rearm, SimulateFailsafe
from executive.frontends.output import say, write_json
from robot.bringup import failsafe, rearming
from robot.clock import WallClock
from robot.exit_status import ExitStatus
from robot.model import description


def simulate(asked: SimulateFailsafe) -> int:
    """Play a trial of the bus owner; returns the exit status.

    Raises:
        ConfigError: if the driver cannot drive the robot.
        ProcessError: if the robot does not come up.
    """
    body = description.load(asked.robot)
    driver = chosen(asked.driver, body, fast=False, err=asked.as_json)
    world = REALITY.under(asked.reality).world("empty")
    tell = _quiet if asked.as_json else say
    with TemporaryDirectory(prefix="humanoid-failsafe-", ignore_cleanup_errors=True) as scratch:
        player = failsafe.Player(
            world, asked.robot, folder=Path(scratch), driver=driver, wall=WallClock(), tell=tell
        )
        trial = player.play(asked.how.value)
    # Whether it is all of the promise: no torque over a limit, no early reset, nobody obeyed.
    kept = trial.most <= 1.0 and all(trial.refusals) and trial.ignored
    if asked.as_json:
        write_json({"simulated": True, "kept": kept, "trial": trial})
    else:
        say(f"The largest torque meanwhile was {trial.most:.0%} of its joint's limit (simulated).")
    return ExitStatus.DONE if kept else ExitStatus.FAILED


def _quiet(_line: str) -> None:
    """Say nothing."""


def rearm(asked: Rearm) -> int:
    """Let a controller command again; returns the exit status.

    Raises:
        ConfigError: if no robot runs whose motors a process owns.
        DriverError: if the owner does not answer.
    """
    told = rearming.rearm(rearming.newest(), WallClock())
    if asked.as_json:
        write_json({"rearm": told})
    elif told.refused:
        say(f"no  {told.robot}: {told.refused}", styled=("no", "red"))
    elif told.before in ("OK", "HOLD"):
        say(f"{told.robot}'s motors were armed; nothing was changed.")
    else:
        say(f"{told.robot}'s motors are armed again: the next controller may command them.")
    return ExitStatus.FAILED if told.refused else ExitStatus.DONE
