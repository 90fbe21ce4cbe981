"""Keeps C libraries quiet that write to standard error by themselves, past Python's streams."""

from __future__ import annotations

import os
from collections.abc import Generator
from contextlib import contextmanager

STDERR = 2


@contextmanager
def muted() -> Generator[None]:
    """Whatever this process writes to standard error inside the block is lost."""
    kept, nowhere = os.dup(STDERR), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, STDERR)
        yield
    finally:
        os.dup2(kept, STDERR)
        os.close(kept)
        os.close(nowhere)
