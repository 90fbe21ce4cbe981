"""A connection to the gate that is ready before anybody asks: a stop need not wait for handshakes.

TCP and TLS take two ways there and back before the first line goes: a quarter of a second across a
continent.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import suppress

from executive.frontends.remote.wire import BYE, beat

Streams = tuple[asyncio.StreamReader, asyncio.StreamWriter]
AGAIN_S = 0.5


class Spare:
    """One connection that beats and is read until somebody takes it; then there is another."""

    def __init__(
        self,
        connect: Callable[[], Awaitable[Streams]],
        told: Callable[[asyncio.StreamReader], AsyncIterator[bytes]],
    ) -> None:
        """Begin to connect.

        Args:
            connect: makes a connection; may raise OSError.
            told: reads one until it ends or falls silent; nothing was asked by it.
        """
        self._connect, self._told = connect, told
        self._ready: Streams | None = None
        self._keeping = asyncio.create_task(self._keep())

    async def take(self) -> Streams:
        """The connection that is ready, or else a new one, made now. Raises OSError."""
        ready = await self._taken()
        if self._keeping.done():  # two may ask at once
            self._keeping = asyncio.create_task(self._keep())
        return ready or await self._connect()

    async def close(self) -> None:
        """Say goodbye."""
        if (ready := await self._taken()) is not None:
            ready[1].write(BYE)
            ready[1].close()

    async def _taken(self) -> Streams | None:
        ready, self._ready = self._ready, None
        self._keeping.cancel()
        await asyncio.wait({self._keeping})
        return ready

    async def _keep(self) -> None:
        while True:
            with suppress(OSError, TimeoutError):
                self._ready = reader, writer = await self._connect()
                beating = asyncio.create_task(beat(writer))
                try:
                    async for _ in self._told(reader):
                        pass
                finally:
                    beating.cancel()
                self._ready = None
                writer.transport.abort()
            await asyncio.sleep(AGAIN_S)
