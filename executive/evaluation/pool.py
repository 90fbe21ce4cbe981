"""Where runs are done: in a few processes of this machine, or on the machines of a Ray cluster."""

from __future__ import annotations

import importlib
import multiprocessing
import os
import signal
import tempfile
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from executive.evaluation.campaign import Run
from executive.evaluation.record import Record
from executive.evaluation.single import perform
from robot.bus.lifeline import tie_to_parent
from robot.errors import ConfigError, ProcessError
from robot.reality.contract import Reality

Stop = Callable[[], bool]
"""Whether somebody wants it to end."""
POLL_S = 0.1
DIED = "a worker process died, perhaps for want of memory: use fewer --processes, and --resume"


def _never() -> bool:
    return False


def in_processes(
    runs: Sequence[Run],
    reality: Reality,
    *,
    processes: int,
    stop: Stop = _never,
    keep: Path | None = None,
) -> Iterator[Record]:
    """Records as they come, from worker processes of this machine.

    What a run wrote that went wrong is kept under `keep`.

    Ends early when `stop` says so: runs that are under way are lost with their workers. Workers die
    with this process, and whatever they left on the disk goes with it.

    Raises:
        ProcessError: a worker died. The runs that were under way have no record, and are tried
            again when the campaign is resumed.
    """
    if not runs:
        return
    others = set(multiprocessing.active_children())
    with TemporaryDirectory(prefix="humanoid-eval-", ignore_cleanup_errors=True) as scratch:
        with _held_back():
            pool = ProcessPoolExecutor(
                min(processes, len(runs)),
                mp_context=multiprocessing.get_context("spawn"),
                initializer=_begin,
                initargs=(os.getpid(), scratch),
            )
        with _held_back():  # again: Python's resource tracker, begun above, let Ctrl-C through
            waiting: set[Future[Record]] = {
                pool.submit(perform, run, reality, keep) for run in runs
            }
        try:
            while waiting and not stop():
                over, waiting = wait(waiting, timeout=POLL_S, return_when=FIRST_COMPLETED)
                for future in over:
                    yield future.result()
        except BrokenProcessPool:
            if not stop():  # else the signal that asked for the end went to all of the group
                raise ProcessError(DIED) from None
        finally:
            if waiting:
                for worker in set(multiprocessing.active_children()) - others:
                    worker.kill()
            pool.shutdown(cancel_futures=True)


def _begin(parent_pid: int, scratch: str) -> None:
    """A worker begins: it dies with its parent, and keeps its files where the parent clears up."""
    tie_to_parent(parent_pid)
    tempfile.tempdir = scratch


@contextmanager
def _held_back() -> Generator[None]:
    """Processes begun inside the block never hear Ctrl-C or a closed terminal: the parent does."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGHUP})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def on_ray(
    runs: Sequence[Run],
    reality: Reality,
    *,
    address: str | None = None,
    stop: Stop = _never,
) -> Iterator[Record]:
    """Records as they come, from a Ray cluster, one run a CPU.

    Args:
        runs: what to do; every machine has this package installed.
        reality: to do it in.
        address: of the cluster; None starts or finds a local one.
        stop: asked all the time; the runs under way are given up when it says so.

    Raises:
        ConfigError: if Ray is not installed.
    """
    try:
        ray: Any = importlib.import_module("ray")
    except ImportError:
        cure = "pip install 'humanoid-executive[ray]'"
        raise ConfigError(f"Ray is not installed: {cure}") from None
    started_here = not ray.is_initialized()
    if started_here:
        ray.init(address=address, include_dashboard=False, log_to_driver=False)
    try:
        remote = ray.remote(num_cpus=1, max_retries=2)(perform)
        waiting = [remote.remote(run, reality) for run in runs]
        while waiting and not stop():
            over, waiting = ray.wait(waiting, num_returns=1, timeout=POLL_S)
            yield from ray.get(over)
        for run in waiting:
            ray.cancel(run, force=True)
    finally:
        if started_here:
            ray.shutdown()
