"""What `humanoid remote` does: from its options to an exit status."""

from __future__ import annotations

import asyncio
import re
import signal
import socket
from collections.abc import Coroutine
from contextlib import closing, suppress
from pathlib import Path
from typing import Any, get_args

import msgspec

from executive.frontends.output import say, write_json
from executive.frontends.printer import Printer
from executive.frontends.remote import invitation as invitations
from executive.frontends.remote.authority import Authority
from executive.frontends.remote.gate import Gate
from executive.frontends.remote.relay import Relay
from executive.frontends.service import place as places
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.ordinary_files import write_ordinary

DEFAULT_PORT = 7450
BACKLOG = 64
_NAME = re.compile(r"[a-z0-9][a-z0-9_-]{0,31}")


def invite(name: str, role: invitations.Role, *, at: str, out: Path | None, days: int) -> int:
    """Make an invitation and write it into a file that only this user may read."""
    if not _NAME.fullmatch(name):
        cure = "take letters a-z, digits, - and _, at most 32: anna"
        raise ConfigError([Problem(f"{name!r} is no name for somebody", suggestion=cure)])
    host, port = address(at)
    path = out or Path(f"{name}.invitation")
    if path.exists() or path.is_symlink():
        cure = "name another file by --out"
        raise ConfigError([Problem("there is a file already", str(path), suggestion=cure)])
    try:
        made = Authority().invite(name, role, host=host, port=port, days=days)
    except ImportError:
        cure = "pip install 'humanoid-executive[remote]'"
        raise ConfigError([Problem("cryptography is not installed", suggestion=cure)]) from None
    try:
        path.touch(mode=0o600, exist_ok=False)
        write_ordinary(path, msgspec.json.format(msgspec.json.encode(made)) + b"\n")
    except OSError as error:
        Authority().revoke(name)
        text = f"cannot be written: {error.strerror}"
        raise ConfigError([Problem(text, str(path))]) from None
    say(f"{path}: for {name}, who {invitations.ROLES[role]}; until {made.until}.")
    say("It is a secret of theirs: send it by a way that only they can read. There:")
    say(f"  humanoid remote join {path.name}")
    return ExitStatus.DONE


def list_guests(*, as_json: bool) -> int:
    """Say who was invited."""
    authority = Authority()
    guests = authority.guests()
    if as_json:
        write_json([msgspec.to_builtins(one) | {"good": authority.is_good(one)} for one in guests])
        return ExitStatus.DONE
    for one in guests:
        standing = "revoked" if one.revoked else f"until {one.until[:10]}"
        over = "" if one.revoked or authority.is_good(one) else ", which is over"
        say(f"{one.name}: {one.role}, {standing}{over}")
    if not guests:
        say(f"Nobody is invited. Roles: {', '.join(get_args(invitations.Role))}.")
    return ExitStatus.DONE


def revoke(name: str) -> int:
    """Take an invitation back; who is in by it is let go within a second or so."""
    if not Authority().revoke(name):
        cure = "humanoid remote list says who is"
        raise ConfigError([Problem(f"nobody called {name} is invited", suggestion=cure)])
    say(f"The invitation of {name} is worth nothing any more.")
    return ExitStatus.DONE


def open_gate(name: str | None, *, listen: str) -> int:
    """Let in who was invited until Ctrl-C; returns the exit status.

    Raises:
        ConfigError: no robot is up, nobody is invited, or the address is not to be had.
    """
    place = places.find(name)
    host, port = address(listen)
    with _listening(host, port) as listening, closing(Printer(say)) as printer:
        gate = Gate(place, Authority(), listening, tell=printer)
        at = "{}:{}".format(*listening.getsockname()[:2])
        printer(f"{place.name} is reached at {at} by those who are invited; Ctrl-C closes the gate")
        return _until_told(gate.run())


def join(path: Path, name: str | None) -> int:
    """Have a robot of another machine here, until Ctrl-C; returns the exit status.

    Raises:
        RobotError: the invitation is none, nobody answers, or the name is taken here.
    """
    invitation = invitations.read(path)
    with places.claimed(name or invitation.name) as place, closing(Printer(say)) as printer:
        return _until_told(Relay(place, invitation, tell=printer).run())


def address(text: str) -> tuple[str, int]:
    """Host and port of "host", "host:port", "[::1]:port".

    Raises:
        ConfigError: that is none.
    """
    found = re.fullmatch(r"(\[[0-9a-fA-F:.]+\]|[\w.-]{1,253})(?::(\d{1,5}))?", text)
    host = "" if found is None else found[1].strip("[]")
    if found is None or not (
        invitations.is_host(host) and 0 < int(found[2] or DEFAULT_PORT) < 1 << 16
    ):
        cure = f"write robot.local:{DEFAULT_PORT}, or 192.168.1.7"
        raise ConfigError([Problem(f"{text!r} is no address", suggestion=cure)])
    return host, int(found[2] or DEFAULT_PORT)


def _listening(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        return socket.create_server((host, port), family=family, backlog=BACKLOG)
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        text, cure = f"{host}:{port} is not to be had: {reason}", "name another by --listen"
        raise ConfigError([Problem(text, suggestion=cure)]) from None


def _until_told(work: Coroutine[Any, Any, None]) -> int:
    """Work until it ends, or Ctrl-C or SIGTERM end it."""

    async def run() -> None:
        working = asyncio.ensure_future(work)
        loop = asyncio.get_running_loop()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            loop.add_signal_handler(number, working.cancel)
        with suppress(asyncio.CancelledError):
            await working

    asyncio.run(run())
    return ExitStatus.DONE
