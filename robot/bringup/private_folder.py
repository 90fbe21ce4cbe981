"""A run's private folder, in memory where that can be: sockets, and the motors' shared memory.

Its path is short (a unix socket's may have 108 bytes) and its mode 0700, so nobody else reaches the
motors. What a killed run left is taken away by the next one.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

PREFIX = "humanoid-run-"
OWNER = "owner"
IN_MEMORY = Path("/dev/shm")


def create() -> Path:
    """Make a fresh folder of this process, and remove those whose owners are gone."""
    parent = IN_MEMORY if os.access(IN_MEMORY, os.W_OK) else Path(tempfile.gettempdir())
    sweep(parent)
    folder = Path(tempfile.mkdtemp(prefix=PREFIX, dir=parent))
    (folder / OWNER).write_text(str(os.getpid()))
    return folder


def remove(folder: Path) -> None:
    """Take a folder away; one that is gone already is fine."""
    shutil.rmtree(folder, ignore_errors=True)


def sweep(parent: Path) -> None:
    """Remove the folders of processes that are gone; folders of others cannot be, and are left."""
    for folder in parent.glob(f"{PREFIX}*"):
        try:
            owner = int((folder / OWNER).read_text())
            os.kill(owner, 0)
        except ProcessLookupError:
            remove(folder)
        except (OSError, ValueError):
            continue
