"""From the start of the process: `humanoid do` until its first tick, and a whole job in one go."""

from __future__ import annotations

import json
import math
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from benchmarks import machine

LOOK = "look at the red cup"
JOB = "pick up the red cup and put it on the shelf"
COMMAND = (sys.executable, "-c", "from executive.frontends.cli import main; main()", "do")

Outcome = dict[str, Any]


def first_tick(*, live: bool, times: int) -> Outcome:
    """Wall time [s] until the executive's first tick has shown its first line; the median."""
    taken = [_until_first_line(live=live) for _ in range(times)]
    seconds = [taken_s for taken_s, _ in taken]
    here = machine.describe()
    return {
        "ok": all(ok for _, ok in taken),
        "first_tick_s": round(statistics.median(seconds), 2),
        "slowest_s": round(max(seconds), 2),
        "load": here.load,
        "commit": here.commit,
    }


def _until_first_line(*, live: bool) -> tuple[float, bool]:
    """Until the first line that begins with a time, and whether the job went well."""
    with tempfile.TemporaryDirectory() as folder:
        begin_s = time.perf_counter()
        with subprocess.Popen(
            [*COMMAND, *([] if live else ["--fast"]), LOOK],
            cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        ) as process:  # fmt: skip
            assert process.stdout is not None
            first_s = math.nan
            for line in process.stdout:
                if math.isnan(first_s) and line.startswith("["):
                    first_s = time.perf_counter() - begin_s
        return first_s, process.returncode == 0


def whole_job(*, times: int) -> Outcome:
    """Simulated seconds a second of the whole main job in `fast`, medians of some runs.

    `factor` is a wall second of the whole process, from its start to its end; `mission_factor` one
    between the first tick and the last; `cpu_factor` a second of CPU time, its start included.
    """
    runs = [_job() for _ in range(times)]
    here = machine.describe()
    return {
        "ok": all(run is not None for run in runs),
        **{
            name: round(statistics.median(run[name] for run in runs if run is not None), 2)
            for name in next((run for run in runs if run is not None), {})
        },
        "load": here.load,
        "commit": here.commit,
    }


def _job() -> dict[str, float] | None:
    """One run; None if it failed."""
    with tempfile.TemporaryDirectory() as folder:
        begin_s, begin_cpu_s = time.perf_counter(), _children_s()
        done = subprocess.run(
            [*COMMAND, "--fast", "--seed", "0", "--run-dir", folder, JOB],
            cwd=folder, capture_output=True, check=False,
        )  # fmt: skip
        wall_s, cpu_s = time.perf_counter() - begin_s, _children_s() - begin_cpu_s
        if done.returncode != 0:
            return None
        summary = json.loads(next(Path(folder).rglob("summary.json")).read_text())
    simulated_s = summary["simulated_s"]
    return {
        "factor": simulated_s / wall_s,
        "mission_factor": simulated_s / summary["wall_s"],
        "cpu_factor": simulated_s / cpu_s,
    }


def _children_s() -> float:
    """CPU time of the child processes that have ended [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
