"""Where runs are done: in a few processes of this machine, or on the machines of a Ray cluster."""

from __future__ import annotations

import importlib
import multiprocessing
import os
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from typing import Any

from executive.evaluation.campaign import Run
from executive.evaluation.record import Record
from executive.evaluation.single import perform
from robot.bus.lifeline import tie_to_parent
from robot.errors import ConfigError
from robot.reality.contract import Reality


def in_processes(runs: Sequence[Run], reality: Reality, *, processes: int) -> Iterator[Record]:
    """Records as they come, from worker processes of this machine.

    A worker that dies (out of memory, for example) costs the runs that were under way; they have
    no record, and are tried again when the campaign is resumed. Workers die with this process.
    """
    if not runs:
        return
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(
        min(processes, len(runs)),
        mp_context=context,
        initializer=tie_to_parent,
        initargs=(os.getpid(),),
    ) as pool:
        waiting: set[Future[Record]] = {pool.submit(perform, run, reality) for run in runs}
        try:
            while waiting:
                over, waiting = wait(waiting, return_when=FIRST_COMPLETED)
                for future in over:
                    yield future.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def on_ray(
    runs: Sequence[Run], reality: Reality, *, address: str | None = None
) -> Iterator[Record]:
    """Records as they come, from a Ray cluster, one run a CPU.

    Args:
        runs: what to do; every machine has this package installed.
        reality: to do it in.
        address: of the cluster; None starts or finds a local one.

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
        while waiting:
            over, waiting = ray.wait(waiting, num_returns=1)
            yield from ray.get(over)
    finally:
        if started_here:
            ray.shutdown()
