"""Opens a desk beside a robot at work, where pages of this user's can steer it."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from executive.frontends.console.desk import Desk, Steered
from robot.bringup import private_folder
from robot.bringup.mailbox import Handle
from robot.errors import ProcessError


@contextmanager
def attended(shell: Steered, folder: Path, handle: Handle | None) -> Generator[None]:
    """Take orders from pages inside the block; where there is no place for that, do without.

    Args:
        shell: does what is ordered.
        folder: of the run, where pages look for whom to tell.
        handle: of a live run, which has a private folder.
    """
    with ExitStack() as stack:
        try:
            private = handle.folder if handle is not None else _own(stack)
            stack.enter_context(Desk(shell, folder=folder, private=private))
        except (OSError, ProcessError) as error:
            why = f"{folder}: {error.strerror}" if isinstance(error, OSError) else str(error)
            shell.out(f"Pages can look on only: {why}")
        yield


def _own(stack: ExitStack) -> Path:
    """A private folder for the socket alone."""
    made = private_folder.create()
    stack.callback(private_folder.remove, made)
    return made.path
