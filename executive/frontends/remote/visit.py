"""One connection that was let in: what it asks is looked at and passed on, what is told comes back.

The robot is reached by a connection of its own for each, which is made when it is first asked
something. Buttons that stop go as they go from any terminal (`service.client.press`).
"""

from __future__ import annotations

import asyncio
from contextlib import suppress
from typing import TYPE_CHECKING, Protocol

import msgspec

from executive.frontends.remote.wire import (
    ANYBODYS,
    Beat,
    Bye,
    arrived,
    asked_by,
    echo,
    line,
    refusal,
)
from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.since_boot import now_s
from robot.errors import RobotError
from robot.exit_status import ExitStatus
from robot.printable import printable_line

if TYPE_CHECKING:
    from executive.frontends.remote.authority import Guest
    from executive.frontends.remote.tie import Tie
    from executive.frontends.service.place import Place

IDLE_S = 10.0
"""Who neither beats nor asks for so long is let go."""
OPEN_S = 60.0
"""How long what was said is followed until it has come to jobs, when who said it is gone."""
MOST_BEHIND = 1 << 20
"""Bytes that may wait for somebody who reads slowly."""
MOST_A_SECOND = 100
"""Lines of one connection; who sends more waits, so that others are heard."""
NO_LINK = "Nobody would notice if this link broke: join the robot by `humanoid remote join`."


class Around(Protocol):
    """What a visit has around it: the gate."""

    place: Place

    def make_room(self) -> None:
        """See to it that one more may ask the robot something."""
        ...

    async def lose(self, tie: Tie) -> None:
        """A link is lost: the robot stands, if it does something that came by it."""
        ...

    async def pressed(
        self, button: m.Button, *, why: str, quiet: bool
    ) -> tuple[m.Ended, list[str]]:
        """Press a button of the robot's; how that ended, and what was said. Raises RobotError."""
        ...


class Visit:
    """A connection.

    Attributes:
        guest: who came.
        heard_s: when something else than a beat came last, by the loop's clock.
    """

    def __init__(self, gate: Around, guest: Guest, tie: Tie, reader: asyncio.StreamReader,
                 writer: asyncio.StreamWriter) -> None:  # fmt: skip
        """Take one over; it is closed by whoever made it."""
        self.heard_s = asyncio.get_running_loop().time()
        self._gate = gate
        self.guest = guest
        self._tie = tie
        self._reader = reader
        self._writer = writer
        self._robot: asyncio.StreamWriter | None = None
        self._hearing: asyncio.Task[None] | None = None
        self._heeding: asyncio.Task[None] | None = None
        self._pressing: set[asyncio.Task[None]] = set()
        self._beats = self._bye = self._is_gone = False
        self._second_s = self.heard_s
        self._lines = 0

    @property
    def asks(self) -> bool:
        """Whether it takes a connection of the robot's."""
        return self._robot is not None

    def end(self) -> None:
        """Let it go."""
        if self._heeding is not None:
            self._heeding.cancel()

    async def last(self) -> None:
        """Pass on what is asked and told, until either end has had enough."""
        self._heeding = asyncio.create_task(self._heed())
        try:
            await asyncio.wait({self._heeding})
            self._is_gone = True
            await self._leave()
            if self._hearing is not None and self._open:
                await asyncio.wait({self._hearing}, timeout=OPEN_S)
        finally:
            for task in (self._heeding, self._hearing, *self._pressing):
                if task is not None:
                    task.cancel()
            if self._robot is not None:
                self._robot.close()

    @property
    def _open(self) -> bool:
        """Whether something that was said here has come to nothing yet."""
        return any(visit is self for visit, _ in self._tie.lines)

    async def _leave(self) -> None:
        if not self._beats:
            return
        self._tie.end(left=self._bye)
        if self._tie.is_lost:
            await self._gate.lose(self._tie)
        elif not self._tie.holds:
            self._tie.jobs.clear()  # they go on, as those of a terminal that is left

    async def _heed(self) -> None:
        """What is asked, line by line."""
        with suppress(OSError, ValueError, TimeoutError, msgspec.DecodeError, RecursionError):
            while not self._bye:
                async with asyncio.timeout(IDLE_S):
                    data = await self._reader.readline()
                if not data.endswith(b"\n"):
                    return
                await self._keep_pace()
                asked = line(data)  # whoever speaks otherwise is none of ours
                match asked:
                    case Beat():
                        self._beat()
                        self._write(b"")
                    case Bye():
                        self._bye = True
                    case _:
                        self.heard_s = asyncio.get_running_loop().time()
                        await self._take(asked)

    async def _keep_pace(self) -> None:
        now_s = asyncio.get_running_loop().time()
        if now_s - self._second_s > 1.0:
            self._second_s, self._lines = now_s, 0
        self._lines += 1
        if self._lines > MOST_A_SECOND:
            await asyncio.sleep(self._second_s + 1.0 - now_s)

    def _beat(self) -> None:
        now_s = asyncio.get_running_loop().time()
        if self._beats:
            self._tie.beat(now_s)
        else:
            self._beats = True
            self._tie.begin(now_s)

    async def _take(self, asked: m.Request) -> None:
        asked = arrived(asked_by(self.guest.role, asked), now_s())
        why = refusal(self.guest.role, asked)
        if not why and _moves(asked) and not self._tie.holds:
            why = NO_LINK
        if why:
            self._answer(asked.number, ExitStatus.INVALID, [why])
        elif isinstance(asked, m.Press) and asked.button in ANYBODYS:
            task = asyncio.create_task(self._press(asked))
            self._pressing.add(task)
            task.add_done_callback(self._pressing.discard)
        else:
            await self._pass_on(asked)

    def _answer(self, number: int, status: int, words: list[str]) -> None:
        for text in words:
            self._write(m.line_of(m.Words(number=number, text=text)))
        self._write(m.line_of(m.Ended(number=number, status=status)))

    async def _press(self, asked: m.Press) -> None:
        why = printable_line(asked.why) or f"{printable_line(self.guest.name)} said stop from afar"
        try:
            ended, words = await self._gate.pressed(
                asked.button, why=why[: m.MAX_REASON], quiet=asked.quiet
            )
            self._answer(asked.number, ended.status, words)
        except RobotError as error:
            self._answer(asked.number, ExitStatus.BROKEN, [str(error)])

    async def _pass_on(self, asked: m.Request) -> None:
        if self._robot is None:
            self._gate.make_room()
            connection = await asyncio.to_thread(places.connect, self._gate.place, wait_s=1.0)
            told, self._robot = await asyncio.open_unix_connection(
                sock=connection, limit=m.MAX_TOLD
            )
            self._hearing = asyncio.create_task(self._hear(told))
        if isinstance(asked, m.Say):
            self._tie.lines.add((self, asked.number))
        self._robot.write(m.line_of(asked))
        await self._robot.drain()

    async def _hear(self, robot: asyncio.StreamReader) -> None:
        """What the robot tells; when it has ended the connection, this one ends as well."""
        with suppress(OSError, ValueError):
            while not (self._is_gone and not self._open) and (data := await robot.readline()):
                if self._open:
                    with suppress(msgspec.DecodeError, RecursionError):
                        self._note(m.told(data))
                self._write(data)
        self.end()

    def _write(self, data: bytes) -> None:
        """Tell something; whoever beats is told the time first."""
        if self._is_gone or self._writer.is_closing():
            return
        self._writer.write(echo(now_s()) + data if self._beats else data)
        if self._writer.transport.get_write_buffer_size() > MOST_BEHIND:
            self.end()  # too far behind

    def _note(self, told: m.Told) -> None:
        """What came of what was said here."""
        if (self, told.number) not in self._tie.lines:
            return
        if isinstance(told, m.Queued):
            self._tie.jobs.update(told.jobs)
        if isinstance(told, m.Queued | m.Ended):
            self._tie.lines.discard((self, told.number))


def _moves(asked: m.Request) -> bool:
    """Whether the robot may move by it: somebody has to notice when the link breaks."""
    match asked:
        case m.Say() | m.Drive():
            return True
        case m.Press(button=button):
            return button not in ANYBODYS
        case _:
            return False
