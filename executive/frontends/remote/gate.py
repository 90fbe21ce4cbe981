"""The robot's end: lets in who was invited, passes on what their role may ask, watches their link.

A process of its own beside the robot, which it reaches as any terminal of the user does: whatever
happens here, floods included, the robot's own loops do not notice. All of it is bounded: who has
not shown a certificate yet, who is in, how long a line is, how far behind somebody may read.
"""

from __future__ import annotations

import asyncio
import socket
import ssl
from collections import Counter
from collections.abc import Callable
from contextlib import suppress

from executive.frontends.remote.authority import Authority, Guest
from executive.frontends.remote.tie import Tie
from executive.frontends.remote.visit import Visit
from executive.frontends.remote.wire import BEAT_S, hasten
from executive.frontends.service import messages as m
from executive.frontends.service.client import Connection, press
from executive.frontends.service.place import Place
from robot.errors import ConfigError, RobotError
from robot.printable import printable_line

MOST_IN, MOST_IN_EACH = 64, 20
"""Connections at a time that were let in: in all, and by one invitation."""
MOST_ASKING = 8
"""Of these, that ask the robot something: it takes 16, and people at it come first."""
MOST_SHAKING, MOST_SHAKING_EACH = 16, 4
"""Who has not shown a certificate yet: in all, and from one address."""
SHAKE_S = 3.0
AGAIN_S = 0.1
LOOK_ANEW_S = 1.0
"""How often it is looked up whether the invitations of who is in are worth something still."""

Tell = Callable[[str], None]


class Gate:
    """Takes connections until `run` is cancelled."""

    def __init__(self, place: Place, authority: Authority, listening: socket.socket, *,
                 tell: Tell) -> None:  # fmt: skip
        """Prepare it.

        Args:
            place: of the robot.
            authority: whose invitations count.
            listening: where they come in; it is not closed here.
            tell: is called with a line for people now and then.

        Raises:
            ConfigError: nobody was ever invited.
        """
        self.place = place
        self.tell = tell
        self._authority = authority
        self._context = authority.gate_context()
        self._listening = listening
        self._shaking: Counter[str] = Counter()
        self._tasks: set[asyncio.Task[None]] = set()
        self._visits: list[Visit] = []
        self._ties: dict[str, Tie] = {}

    async def run(self) -> None:
        """Let people in, until this is cancelled."""
        self._listening.settimeout(0.0)
        loop = asyncio.get_running_loop()
        watching = asyncio.create_task(self._watch_links())
        try:
            while True:
                try:
                    connection, address = await loop.sock_accept(self._listening)
                except OSError:  # no more open files, or gone already
                    await asyncio.sleep(AGAIN_S)
                    continue
                self._take_in(connection, str(address[0]))
        finally:
            watching.cancel()
            for task in tuple(self._tasks):
                task.cancel()
            await asyncio.gather(*self._tasks, watching, return_exceptions=True)
            await asyncio.gather(*(self.lose(tie) for tie in self._ties.values()))

    def _take_in(self, connection: socket.socket, address: str) -> None:
        """Begin with somebody, if there is room: a crowd at the door keeps out nobody who is in."""
        crowd = self._shaking.total() >= MOST_SHAKING
        if crowd or self._shaking[address] >= MOST_SHAKING_EACH or len(self._visits) >= MOST_IN:
            connection.close()
            return
        self._shaking[address] += 1
        task = asyncio.create_task(self._attend(connection, address))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _attend(self, connection: socket.socket, address: str) -> None:
        """Somebody, from the handshake to the end."""
        try:
            shaken = await self._shaken(connection)
        finally:
            self._shaking[address] -= 1
            if not self._shaking[address]:
                del self._shaking[address]
        if shaken is None:
            return
        reader, writer, certificate = shaken
        guest: Guest | None = None
        try:
            with suppress(ConfigError):
                guest = self._authority.guest(certificate)
            if guest is None:
                self.tell(f"{address} came with an invitation that is worth nothing any more")
                return
            if sum(visit.guest == guest for visit in self._visits) >= MOST_IN_EACH:
                return
            tie = self._ties.setdefault(guest.fingerprint, Tie(name=guest.name))
            visit = Visit(self, guest, tie, reader, writer)
            self._visits.append(visit)
            try:
                await visit.last()
            finally:
                self._visits.remove(visit)
        finally:
            writer.transport.abort()

    async def _shaken(
        self, connection: socket.socket
    ) -> tuple[asyncio.StreamReader, asyncio.StreamWriter, bytes] | None:
        """The streams of somebody who has shown a certificate of ours, and that (DER)."""
        loop = asyncio.get_running_loop()
        reader = asyncio.StreamReader(limit=m.MAX_REQUEST)
        protocol = asyncio.StreamReaderProtocol(reader)
        try:
            hasten(connection)
            transport, _ = await loop.connect_accepted_socket(
                lambda: protocol, connection, ssl=self._context, ssl_handshake_timeout=SHAKE_S
            )
        except (OSError, ssl.SSLError, TimeoutError, ValueError):
            connection.close()
            return None
        tls: ssl.SSLObject = transport.get_extra_info("ssl_object")
        certificate = tls.getpeercert(binary_form=True) or b""
        return reader, asyncio.StreamWriter(transport, protocol, reader, loop), certificate

    def _is_good(self, guest: Guest) -> bool:
        """Whether somebody who is in would be let in still."""
        with suppress(ConfigError):
            return guest in self._authority.guests() and self._authority.is_good(guest)
        return False

    def make_room(self) -> None:
        """Let a visit go before one more asks the robot something.

        Of whoever has most of them it is the one that asked least lately: a guest with many
        connections takes nothing from others.
        """
        asking = [visit for visit in self._visits if visit.asks]
        if len(asking) >= MOST_ASKING:
            each = Counter(visit.guest.fingerprint for visit in asking)
            _, most = each.most_common(1)[0]
            greedy = [visit for visit in asking if each[visit.guest.fingerprint] == most]
            min(greedy, key=lambda visit: visit.heard_s).end()

    # --- links ---

    async def _watch_links(self) -> None:
        """Stop what somebody set going whose link is silent; let go who is invited no more."""
        loop = asyncio.get_running_loop()
        looked_s = loop.time()
        while True:
            await asyncio.sleep(BEAT_S / 2)
            if loop.time() - looked_s > LOOK_ANEW_S:
                looked_s = loop.time()
                bad = {one for one in self._guests() if not self._is_good(one)}
                for visit in self._visits:
                    if visit.guest in bad:
                        visit.end()
            silent = [tie for tie in self._ties.values() if tie.is_silent(loop.time())]
            await asyncio.gather(*(self.lose(tie) for tie in silent if tie.may_move))

    async def lose(self, tie: Tie) -> None:
        """A link is lost: the robot stands, if it does something that came by it."""
        jobs, lines = tie.take()
        if not jobs and not lines:
            return
        name = printable_line(tie.name)
        try:
            open_jobs = set[int]() if lines else await asyncio.to_thread(self._open_jobs)
            if lines or jobs & open_jobs:
                await self.pressed("stop", why=f"the link to {name} was lost", quiet=True)
                self.tell(f"The link to {name} was lost: the robot was told to stop.")
        except RobotError as error:
            self.tell(f"The link to {name} was lost, and the robot cannot be told: {error}")

    def _guests(self) -> set[Guest]:
        return {visit.guest for visit in self._visits}

    def _open_jobs(self) -> set[int]:
        with Connection(self.place, patience_s=0.0) as connection:
            ended = connection.ask(m.Queue(), lambda _: None)
        return {job.number for job in ended.standing.jobs} if ended.standing else set()

    async def pressed(
        self, button: m.Button, *, why: str, quiet: bool
    ) -> tuple[m.Ended, list[str]]:
        """Press a button of the robot's as any terminal does, so that a stop is not lost.

        Returns:
            How that ended, and what was said of it.

        Raises:
            RobotError: the robot does not answer.
        """
        words: list[str] = []

        def hear(told: m.Told) -> None:
            if isinstance(told, m.Words):
                words.append(told.text)

        ended = await asyncio.to_thread(press, self.place, button, hear, why=why, quiet=quiet)
        return ended, words
