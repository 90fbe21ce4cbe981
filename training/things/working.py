"""Long work on many files, side by side in processes, with how far it has come."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import TypeVar

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

T = TypeVar("T")


def bar() -> Progress:
    """How far long work has come, on the terminal."""
    return Progress(
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
    )


def each(
    work: Callable[[Path], T], files: Sequence[Path], *, name: str, jobs: int = 1
) -> Iterator[T]:
    """What comes of each file, in their order.

    Args:
        work: what is done with one; with several jobs it is of a module, or a `partial` of such.
        files: what it is done with.
        name: of the work, for who waits.
        jobs: processes that do it.
    """
    with bar() as progress:
        task = progress.add_task(name, total=len(files))
        if jobs == 1:
            for path in files:
                yield work(path)
                progress.advance(task)
            return
        fresh = multiprocessing.get_context("spawn")  # JAX has threads: no fork is safe after it
        with ProcessPoolExecutor(jobs, mp_context=fresh) as pool:
            for made in pool.map(work, files, chunksize=4):
                progress.advance(task)
                yield made
