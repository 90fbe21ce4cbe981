"""Many independent runs in a few processes, with a progress bar; an interrupted campaign goes on.

A job names a function by `module:name` and its arguments; its outcome is a dict of plain values.
Outcomes are appended to a file as they come; jobs found there, from the same code, are not run
again.
"""

from __future__ import annotations

import hashlib
import importlib
import json
import multiprocessing
import os
import time
import traceback
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from pathlib import Path
from typing import Any

import msgspec
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from robot.bus.lifeline import tie_to_parent

ROOT = Path(__file__).resolve().parent.parent
UNFINISHED = ROOT / "runs" / "benchmarks"
CODE = ("robot", "sim", "intents", "executive", "benchmarks")

Outcome = dict[str, Any]


class Trial(msgspec.Struct, frozen=True):
    """One run: `call` is `module:function`; `key` is unique in its campaign.

    `alone` keeps every other job away while it runs (for wall-clock measurements).
    """

    key: str
    call: str
    arguments: dict[str, Any] = {}
    alone: bool = False


def run(name: str, jobs: list[Trial], *, processes: int, fresh: bool = False) -> dict[str, Outcome]:
    """Run what is not done yet; returns all outcomes by key.

    A job that raises has the outcome `{"error": traceback}`; it counts as a failure of the robot,
    and is tried again by the next call.
    """
    path = UNFINISHED / f"{name}.jsonl"
    done = {} if fresh else _recall(path)
    wanted = {job.key for job in jobs}
    left = [job for job in jobs if job.key not in done]
    outcomes = {key: outcome for key, outcome in done.items() if key in wanted}
    path.parent.mkdir(parents=True, exist_ok=True)
    if not done:
        path.write_text(json.dumps({"code": fingerprint()}) + "\n", encoding="utf-8")
    with path.open("a", encoding="utf-8") as file, _progress() as bar:
        task = bar.add_task(name, total=len(jobs), completed=len(jobs) - len(left), last="")
        for job, outcome in _all(left, processes):
            outcomes[job.key] = outcome
            file.write(json.dumps({"key": job.key, "outcome": outcome}) + "\n")
            file.flush()
            bar.update(task, advance=1, last=_short(job, outcome))
    return {job.key: outcomes[job.key] for job in jobs}


def fingerprint() -> str:
    """Of all code and data that a run depends on."""
    digest = hashlib.sha256()
    for package in CODE:
        for path in sorted((ROOT / package).rglob("*")):
            if path.suffix in (".py", ".yaml", ".xml"):
                digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _recall(path: Path) -> dict[str, Outcome]:
    """Outcomes of an interrupted campaign with the same code."""
    if not path.exists():
        return {}
    header, *lines = path.read_text(encoding="utf-8").splitlines() or ["{}"]
    if json.loads(header).get("code") != fingerprint():
        return {}
    found = (json.loads(line) for line in lines)
    return {item["key"]: item["outcome"] for item in found if "error" not in item["outcome"]}


def _all(jobs: list[Trial], processes: int) -> Iterator[tuple[Trial, Outcome]]:
    """Outcomes as they come: the shared ones first, then those that want the machine alone."""
    shared = [job for job in jobs if not job.alone]
    yield from _pool(shared, processes)
    yield from _pool([job for job in jobs if job.alone], 1)


def _pool(jobs: list[Trial], processes: int) -> Iterator[tuple[Trial, Outcome]]:
    if not jobs:
        return
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(
        min(processes, len(jobs)), context, initializer=tie_to_parent, initargs=(os.getpid(),)
    ) as pool:
        waiting: dict[Future[Outcome], Trial] = {pool.submit(perform, job): job for job in jobs}
        try:
            while waiting:
                over, _ = wait(waiting, return_when=FIRST_COMPLETED)
                for future in over:
                    yield waiting.pop(future), future.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def perform(job: Trial) -> Outcome:
    """Run one job here; adds how long it took."""
    start_s = time.perf_counter()
    try:
        module, _, name = job.call.partition(":")
        outcome: Outcome = getattr(importlib.import_module(module), name)(**job.arguments)
    except Exception:
        outcome = {"ok": False, "error": traceback.format_exc()}
    return {**outcome, "wall_s": round(time.perf_counter() - start_s, 2)}


def _progress() -> Progress:
    return Progress(
        TextColumn("{task.description:8s}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.fields[last]}"),
        console=Console(stderr=True),
    )


def _short(job: Trial, outcome: Outcome) -> str:
    if "error" in outcome:
        return f"{job.key}: {str(outcome['error']).strip().splitlines()[-1]}"
    return f"{job.key}: {'ok' if outcome.get('ok', True) else 'failed'}"
