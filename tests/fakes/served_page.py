"""A console of a run's folder, for tests and benchmarks that look at its page."""

from __future__ import annotations

import asyncio
import socket
import threading
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from executive.frontends.console.address import HOST
from executive.frontends.console.server import PageServer
from executive.frontends.recorded_place import scene_of


@contextmanager
def served(folder: Path) -> Generator[PageServer]:
    """A console of a run's folder in a thread of its own."""
    ready, over = threading.Event(), threading.Event()
    console = PageServer(lambda: folder, scene_of)

    async def serve() -> None:
        async with await console.open(socket.create_server((HOST, 0))):
            following = asyncio.create_task(console.follow())
            ready.set()
            while not over.is_set():
                await asyncio.sleep(0.02)
            following.cancel()

    thread = threading.Thread(target=lambda: asyncio.run(serve()))
    thread.start()
    ready.wait()
    try:
        yield console
    finally:
        over.set()
        thread.join()
