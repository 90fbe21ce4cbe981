"""The console of `--view` as a process: serves the page of one run until it is told to end."""

from __future__ import annotations

import asyncio
import os
import signal
import socket
import sys
from pathlib import Path

from executive.frontends.console.server import PageServer
from executive.frontends.recorded_place import scene_of
from robot.bus.lifeline import Turn, ask_for_turn, tie_to_parent

LAST_WORDS_S = 0.4
"""Time to tell the pages how it ended."""


def main(folder: str, parent_pid: str, descriptor: str) -> None:
    """Load, build, run, close; the token comes from standard input, where nobody else reads it."""
    tie_to_parent(int(parent_pid))
    ask_for_turn(Turn.OTHERS)
    token = sys.stdin.readline().strip()
    console = PageServer(lambda: Path(folder), scene_of, token=token)
    asyncio.run(_serve(console, socket.socket(fileno=int(descriptor))))


async def _serve(console: PageServer, listening: socket.socket) -> None:
    over = asyncio.Event()
    asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, over.set)
    async with await console.open(listening):
        following = asyncio.create_task(console.follow())
        waiting = asyncio.create_task(over.wait())
        await asyncio.wait({following, waiting}, return_when=asyncio.FIRST_COMPLETED)
        if not following.done():
            following.cancel()
            await console.follow_to_the_end()
        await asyncio.sleep(LAST_WORDS_S)
        if following.done() and not following.cancelled():
            following.result()  # a mistake, told by the log
    os._exit(0)  # a scene that is still being made is not waited for


if __name__ == "__main__":
    main(*sys.argv[1:])
