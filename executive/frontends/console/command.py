"""What `humanoid console` does, from its options to an exit status."""

from __future__ import annotations

import asyncio
import errno
import signal
import socket
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from executive.frontends.console.address import HOST
from executive.frontends.console.server import PageServer
from executive.frontends.output import say
from executive.frontends.recorded_place import scene_of
from executive.journal import journal, past_runs
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus


def console(run: str | None, *, port: int, opened: bool) -> int:
    """Serve the page until Ctrl-C; returns the exit status.

    Raises:
        ConfigError: there is no such run, or the port is taken.
    """
    if run is not None:
        folder = past_runs.find(run)
        asyncio.run(_serve(lambda: folder, port=port, opened=opened))
        return ExitStatus.DONE
    if newest() is None:
        say("No robot has been here yet: the page waits for one.")
    asyncio.run(_serve(newest, port=port, opened=opened))
    return ExitStatus.DONE


def newest() -> Path | None:
    """The run that is under way, or else the newest; None where there is none."""
    runs = past_runs.runs()
    under_way = [folder for folder in runs[-RECENT:] if journal.is_written(folder)]
    return (under_way or runs or [None])[-1]


RECENT = 20
"""Of the newest runs it is looked whether they are under way."""


async def _serve(find: Callable[[], Path | None], *, port: int, opened: bool) -> None:
    server = PageServer(find, scene_of)
    try:
        listening = await server.open(socket.create_server((HOST, port)))
    except OSError as error:
        raise taken(port, error) from None
    say(f"The console: {server.url}")
    say("It is for this machine alone. Ctrl-C ends it; a robot at work goes on.")
    if opened:
        import webbrowser

        webbrowser.open(server.url)
    over = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        loop.add_signal_handler(number, over.set)
    following = asyncio.create_task(server.follow())
    waiting = asyncio.create_task(over.wait())
    await asyncio.wait({following, waiting}, return_when=asyncio.FIRST_COMPLETED)
    listening.close()
    following.cancel()
    with suppress(asyncio.CancelledError):
        await following


def taken(port: int, error: OSError) -> ConfigError:
    """That a port cannot be listened on."""
    cure = "choose another --port, or none: a free one is found"
    if error.errno == errno.EADDRINUSE:
        return ConfigError([Problem(f"port {port} is taken by another program", suggestion=cure)])
    return ConfigError([Problem(f"port {port} cannot be used: {error.strerror}", suggestion=cure)])
