"""The other machine's end: a robot far away, reached here like one of this machine.

It holds a place (`executive.frontends.service.place`) of the invitation's name, so that `humanoid
say`, `stop`, `attach` and the like find the robot there. Each of their connections becomes one to
the gate, which beats; two more are there always: a link, so that the gate knows whether it holds,
and a spare for whoever asks next, so that a stop need not wait for handshakes.
"""

from __future__ import annotations

import asyncio
import os
import socket
import ssl
from collections.abc import AsyncIterator, Callable
from contextlib import suppress

import msgspec

from executive.frontends.line_server import is_own
from executive.frontends.remote.invitation import SERVER_NAME, Invitation, client_context
from executive.frontends.remote.spare import AGAIN_S, Spare, Streams
from executive.frontends.remote.wire import BEAT, BYE, RobotClock, beat, echoed_s, hasten, sent
from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service.place import Place, Running
from executive.frontends.since_boot import now_s
from robot.errors import ConfigError, Problem, ProcessError
from robot.exit_status import ExitStatus

CONNECT_S = 3.0
MOST_CLIENTS = 16
MOST_BEHIND = 1 << 20
"""Bytes that may wait for somebody who reads slowly."""
SILENT_S = 1.0
"""So long the gate's beats may fail to come: the network is gone, though no end of it has come."""

Tell = Callable[[str], None]


class Relay:
    """A robot far away, at a place of this machine, until `run` is cancelled."""

    def __init__(self, place: Place, invitation: Invitation, *, tell: Tell) -> None:
        """Prepare it.

        Args:
            place: a name of this machine that is claimed for it.
            invitation: where it is, and who comes.
            tell: is called with a line for people now and then.

        Raises:
            ConfigError: the invitation's certificates are none.
        """
        self._place = place
        self._invitation = invitation
        self._context = client_context(invitation)
        self._tell = tell
        self._clock = RobotClock()
        self._serving: set[asyncio.Task[None]] = set()

    async def run(self) -> None:
        """Join the robot, and pass on what is asked of it.

        Raises:
            ConfigError: the gate takes this invitation no more, or is another one.
            ProcessError: it cannot be reached at the first try.
        """
        link = await self._joined()
        standing = await self._standing(link)
        self._tell(
            f"{self._place.name} is {standing.robot} in {standing.world}, at "
            f"{self._invitation.host}. From any terminal here: humanoid say, stop, attach, status"
        )
        running = Running(
            pid=os.getpid(), run=str(self._place.folder), private="", world=standing.world,
            robot=standing.robot, runtime=standing.runtime,
        )  # fmt: skip
        listening = places.listen(self._place, running, backlog=MOST_CLIENTS)
        listening.settimeout(0.0)
        loop = asyncio.get_running_loop()
        linking = asyncio.create_task(self._keep_link(link))
        spare = Spare(self._connected, self._told)
        try:
            while True:
                connection, _ = await loop.sock_accept(listening)
                if not is_own(connection) or len(self._serving) >= MOST_CLIENTS:
                    connection.close()
                    continue
                task = asyncio.create_task(self._serve(connection, spare))
                self._serving.add(task)
                task.add_done_callback(self._serving.discard)
        finally:
            listening.close()
            linking.cancel()
            for task in tuple(self._serving):
                task.cancel()
            await asyncio.gather(linking, spare.close(), *self._serving, return_exceptions=True)

    # --- the link ---

    async def _joined(self) -> Streams:
        """The first connection to the gate."""
        at = f"{self._invitation.host}:{self._invitation.port}"
        try:
            return await self._connected()
        except ssl.SSLCertVerificationError as error:
            text = f"who answers at {at} is not whom the invitation is from: {error.verify_message}"
        except (OSError, TimeoutError) as error:
            raise ProcessError(f"nobody answers at {at}: {_reason(error)}") from None
        cure = "have a new one made by `humanoid remote invite`"
        raise ConfigError([Problem(text, suggestion=cure)])

    async def _connected(self) -> Streams:
        """A connection to the gate, which beats from the beginning. Raises OSError."""
        async with asyncio.timeout(CONNECT_S):
            reader, writer = await asyncio.open_connection(
                self._invitation.host, self._invitation.port, ssl=self._context,
                server_hostname=SERVER_NAME, limit=m.MAX_TOLD,
            )  # fmt: skip
        hasten(writer.get_extra_info("socket"))
        writer.write(BEAT)
        return reader, writer

    async def _standing(self, link: Streams) -> m.Standing:
        """What robot it is. TLS 1.3 says only now whether the gate takes the certificate."""
        reader, writer = link
        writer.write(m.line_of(m.Status(number=1)))
        with suppress(OSError, ValueError, TimeoutError):
            async with asyncio.timeout(CONNECT_S):
                async for data in self._told(reader):
                    with suppress(msgspec.DecodeError, RecursionError):
                        told = m.told(data)
                        if isinstance(told, m.Ended) and told.standing is not None:
                            return told.standing
        writer.transport.abort()
        text = "the gate takes this invitation no more, or no robot is up behind it"
        cure = "ask whoever made it: `humanoid remote list` says"
        raise ConfigError([Problem(text, suggestion=cure)])

    async def _keep_link(self, link: Streams | None) -> None:
        """Beat, and join again when the link broke, until cancelled, which is said goodbye."""
        name = self._place.name
        while True:
            if link is None:
                await asyncio.sleep(AGAIN_S)
                with suppress(OSError, TimeoutError):
                    link = await self._connected()
                    self._clock = RobotClock()  # its machine may have been booted
                continue
            reader, writer = link
            beating = asyncio.create_task(beat(writer))
            try:
                async for _ in self._told(reader):  # nothing was asked
                    pass
            except asyncio.CancelledError:
                writer.write(BYE)
                with suppress(OSError, TimeoutError):
                    async with asyncio.timeout(1.0):
                        await writer.drain()
                        writer.close()
                        await writer.wait_closed()
                raise
            finally:
                beating.cancel()
            writer.transport.abort()
            self._tell(f"The link to {name} is lost: it stands, if it did what was said from here.")
            link = None

    # --- those of this machine ---

    async def _serve(self, connection: socket.socket, spare: Spare) -> None:
        """A terminal of this machine: each line goes on, and what is told comes back as it is."""
        reader, writer = await asyncio.open_unix_connection(sock=connection, limit=m.MAX_REQUEST)
        gate: asyncio.StreamWriter | None = None
        try:
            there, gate = await spare.take()
            asking = asyncio.create_task(self._pass_on(reader, gate))
            both = {asking, asyncio.create_task(self._pass_back(there, writer)),
                    asyncio.create_task(beat(gate))}  # fmt: skip
            try:
                await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
            finally:
                if asking.done() or not any(task.done() for task in both):
                    gate.write(BYE)  # left on purpose, by this terminal or all of this machine
                for task in both:
                    task.cancel()
        except (OSError, TimeoutError) as error:
            await _refuse(reader, writer, f"The robot is not reached: {_reason(error)}")
        finally:
            writer.close()
            if gate is not None:
                gate.close()

    async def _told(self, reader: asyncio.StreamReader) -> AsyncIterator[bytes]:
        """The lines that come from the gate, but for its beats, until it ends or falls silent."""
        with suppress(OSError, ValueError, TimeoutError):
            while True:
                async with asyncio.timeout(SILENT_S):
                    data = await reader.readline()
                if not data.endswith(b"\n"):
                    return
                if (there_s := echoed_s(data)) is None:
                    yield data
                else:
                    self._clock.hear(there_s, now_s())

    async def _pass_back(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Tell what the gate tells, until that ends or this terminal is too far behind."""
        async for data in self._told(reader):
            if not _written(writer, data):
                return

    async def _pass_on(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Ask the gate what a terminal asks, until that ends or the gate is too far behind."""
        with suppress(OSError, ValueError):
            while (data := await reader.readline()).endswith(b"\n"):
                if not _written(writer, sent(data, self._clock)):
                    return


def _reason(error: Exception) -> str:
    """What an error of a connection says, also one that says nothing."""
    if isinstance(error, ssl.SSLError):
        return f"no TLS that is known here ({error.reason or error})"
    return getattr(error, "strerror", None) or str(error) or "no answer in time"


def _written(writer: asyncio.StreamWriter, data: bytes) -> bool:
    writer.write(data)
    return writer.transport.get_write_buffer_size() <= MOST_BEHIND


async def _refuse(reader: asyncio.StreamReader, writer: asyncio.StreamWriter, why: str) -> None:
    """Answer what is asked first: that nothing can come of it."""
    with suppress(OSError, ValueError, TimeoutError, msgspec.DecodeError, RecursionError):
        async with asyncio.timeout(CONNECT_S):
            asked = m.request(await reader.readline())
        writer.write(m.line_of(m.Words(number=asked.number, text=why)))
        writer.write(m.line_of(m.Ended(number=asked.number, status=ExitStatus.BROKEN)))
        await writer.drain()
