"""`--view`: a console beside the run of this process, as a process of its own.

It reads the run's files and nothing else, so a page can be as slow as it likes. Its address is kept
in the run's folder: an executive that takes the place of a dead one serves the same page again,
where its port is still free. On another port it has another token.
"""

from __future__ import annotations

import os
import secrets
import socket
import subprocess
import sys
from collections.abc import Generator
from contextlib import contextmanager, suppress
from pathlib import Path

import msgspec

import robot
from executive.frontends.console.address import HOST, Address, url
from executive.frontends.output import say
from robot.files.ordinary_files import make_below, open_to_append, read_secret

FILE = "console.json"
MAX_BYTES = 4096
END_S = 3.0
MODULE = "executive.frontends.console.main"


@contextmanager
def shown(folder: Path | None, *, wanted: bool, err: bool = False) -> Generator[None]:
    """Serve a page of the run in a folder inside the block, and say where; or just go on.

    Args:
        folder: of the run.
        wanted: whether anybody wants to see it.
        err: whether standard output is for something else.
    """
    if not wanted or folder is None:
        yield
        return
    try:
        process, address = _started(folder)
    except OSError as error:
        say(f"There is no page to look at: {error.strerror or error}", err=True)
        yield
        return
    say(f"Watch it here: {url(address)}", err=err)
    try:
        yield
    finally:
        _end(process)


def _started(folder: Path) -> tuple[subprocess.Popen[bytes], Address]:
    """The process, listening: a browser that comes early is kept waiting, not sent away.

    Raises:
        OSError: if there is no port, or it cannot be started.
    """
    before = _kept(folder)
    listening = _listening(before.port if before else 0)
    with listening:
        port = int(listening.getsockname()[1])
        same = before is not None and before.port == port
        address = before if before and same else Address(port=port, token=secrets.token_urlsafe(18))
        _keep(folder, address)
        logs = folder / "logs"
        make_below(folder, logs)
        log = open_to_append(logs / "console.log")
        number = listening.fileno()
        command = [sys.executable, "-P", "-m", MODULE, str(folder), str(os.getpid()), str(number)]
        here = str(Path(robot.__file__).parent.parent)
        try:
            process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=log,
                stderr=log,
                pass_fds=(number,),
                process_group=0,  # Ctrl-C is for the robot
                env={**os.environ, "PYTHONPATH": here},
            )
        finally:
            os.close(log)
    if process.stdin is not None:
        with suppress(OSError), process.stdin as told:
            told.write(address.token.encode() + b"\n")
    return process, address


def _listening(port: int) -> socket.socket:
    """A socket on this machine alone; on another port where the wanted one is taken."""
    try:
        return socket.create_server((HOST, port))
    except OSError:
        return socket.create_server((HOST, 0))


def _kept(folder: Path) -> Address | None:
    """The address of a console of this run before."""
    with suppress(OSError, msgspec.DecodeError, RecursionError):
        return msgspec.json.decode(read_secret(folder / FILE, limit=MAX_BYTES), type=Address)
    return None


def _keep(folder: Path, address: Address) -> None:
    """Write it down, for nobody but this user; without, a page does not come back by itself."""
    with suppress(OSError):
        (folder / FILE).unlink(missing_ok=True)
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC
        with os.fdopen(os.open(folder / FILE, flags, 0o600), "wb") as file:
            file.write(msgspec.json.encode(address))


def _end(process: subprocess.Popen[bytes]) -> None:
    """Let it tell how the run ended, and end."""
    process.terminate()
    try:
        process.wait(END_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
