"""On what, with which code and when something was measured."""

from __future__ import annotations

import datetime
import os
import platform
import subprocess
from importlib import metadata
from pathlib import Path

import msgspec

ROOT = Path(__file__).resolve().parent.parent


class Machine(msgspec.Struct, frozen=True, kw_only=True):
    """Enough to judge a figure; `load` is the load average of a minute, other work included."""

    cpu: str
    cores: int
    python: str
    mujoco: str
    commit: str
    date: str
    load: float = 0.0

    def __str__(self) -> str:
        """One line for the tables."""
        return (
            f"{self.cpu}, {self.cores} cores, Python {self.python}, MuJoCo {self.mujoco}; "
            f"commit {self.commit}, {self.date}, load average {self.load:.1f} at the end"
        )


def describe() -> Machine:
    """This machine, this working tree, today (UTC)."""
    return Machine(
        cpu=_cpu(),
        cores=os.cpu_count() or 1,
        python=platform.python_version(),
        mujoco=metadata.version("mujoco"),
        commit=_commit(),
        date=f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}",
        load=round(os.getloadavg()[0], 2),
    )


def _cpu() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()


def _commit() -> str:
    """Short hash, with `+` where tracked code differs from it; `unknown` outside of git."""
    try:
        head = _git("rev-parse", "--short", "HEAD")
        changed = _git(
            "status", "--porcelain", "-uno", "--", "robot", "sim", "executive", "intents"
        )
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return head + ("+" if changed else "")


def _git(*arguments: str) -> str:
    return subprocess.run(
        ["git", *arguments], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout.strip()
