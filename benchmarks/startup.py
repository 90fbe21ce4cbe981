"""From the start of the process: `humanoid do` until its first tick, and a whole job in one go."""

from __future__ import annotations

import json
import math
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
COMMAND = (sys.executable, "-c", "from executive.cli import main; main()", "do")

Outcome = dict[str, Any]


def first_tick(*, live: bool, times: int) -> Outcome:
    """Wall time [s] until the executive's first tick has shown its first line; the median."""
    taken = [_until_first_line(live=live) for _ in range(times)]
    seconds = [taken_s for taken_s, _ in taken]
    return {
        "ok": all(ok for _, ok in taken),
        "first_tick_s": round(statistics.median(seconds), 2),
        "slowest_s": round(max(seconds), 2),
        "load": machine.describe().load,
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


def whole_job(*, seed: int = 0) -> Outcome:
    """Simulated seconds a wall second of a whole `humanoid do --fast`, its start included."""
    with tempfile.TemporaryDirectory() as folder:
        begin_s = time.perf_counter()
        done = subprocess.run(
            [*COMMAND, "--fast", "--seed", str(seed), "--run-dir", folder, JOB],
            cwd=folder, capture_output=True, check=False,
        )  # fmt: skip
        wall_s = time.perf_counter() - begin_s
        summaries = list(Path(folder).rglob("summary.json"))
        simulated_s = json.loads(summaries[0].read_text())["simulated_s"] if summaries else 0.0
    return {
        "ok": done.returncode == 0,
        "simulated_s": simulated_s,
        "factor": round(simulated_s / wall_s, 2),
        "load": machine.describe().load,
    }
