"""Emulated boards on UDP sockets of this machine, where every program can reach them."""

from __future__ import annotations

import contextlib
import select
import socket
from collections.abc import Sequence
from pathlib import Path
from typing import Any, cast

from robot.clock import Clock
from robot.closing import Closing
from sim.devices.ethernet_cable import Cable

LOOPBACK = "127.0.0.1"
MOST_BYTES, MOST_A_CALL = 2048, 64
LONGEST_WAIT_S, SHORTEST_WAIT_S = 0.005, 0.0001
LIVE_EVERY_S = 0.000999


class _Port:
    """A socket of a board; a file says where it is."""

    def __init__(self, path: Path, cable: Cable) -> None:
        self.cable, self._path = cable, path
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.settimeout(0.0)
        self.socket.bind((LOOPBACK, 0))
        address, port = self.socket.getsockname()
        path.write_text(f"{address} {port}\n")

    def read(self, now_s: float) -> int:
        """Give its cable what came in; how many datagrams."""
        came = 0
        with contextlib.suppress(BlockingIOError):
            while came < MOST_A_CALL:
                data, source = self.socket.recvfrom(MOST_BYTES)
                self.cable.write(data, source, now_s)
                came += 1
        return came

    def play(self, now_s: float) -> None:
        """Send back what is due; where nobody listens it is lost."""
        for data, source in self.cable.advance(now_s):
            with contextlib.suppress(OSError):
                self.socket.sendto(data, cast("Any", source))

    def close(self) -> None:
        """Pull the plug."""
        self._path.unlink(missing_ok=True)
        self.socket.close()


class UdpServer(Closing):
    """Cables on sockets, played in time with a clock."""

    def __init__(self, cables: Sequence[tuple[Path, Cable]], clock: Clock) -> None:
        """Listen, and write the address of each into its file. Raises OSError if that cannot be."""
        self._clock, self._live_s = clock, 0.0
        self._ports: dict[int, _Port] = {}
        for path, cable in cables:
            port = _Port(path, cable)
            self._ports[port.socket.fileno()] = port

    def serve(self, until_s: float) -> None:
        """Play the cables until a time."""
        while (now_s := self._clock.now_s()) < until_s:
            due_s = min((port.cable.next_s for port in self._ports.values()), default=until_s)
            due_s = min(due_s, until_s, now_s + LONGEST_WAIT_S)
            self.listen(max(SHORTEST_WAIT_S, due_s - self._clock.now_s()))
            self.play(self._clock.now_s())

    def listen(self, wait_s: float) -> int:
        """Take what programs sent, waiting for it no longer than so; how many datagrams."""
        if not self._ports:
            return 0
        readable, _, _ = select.select([*self._ports], [], [], wait_s)
        now_s = self._clock.now_s()
        return sum(self._ports[fd].read(now_s) for fd in readable)

    def play(self, now_s: float) -> None:
        """Let cables carry what they were given, and boards live, up to a time."""
        for port in self._ports.values():
            port.play(now_s)
            if now_s >= self._live_s:
                port.cable.board.live(now_s)
        if now_s >= self._live_s:
            self._live_s = now_s + LIVE_EVERY_S

    def unplug(self, number: int) -> None:
        """Pull the plug of a board, counted from 0."""
        fd = list(self._ports)[number]
        self._ports.pop(fd).close()

    def close(self) -> None:
        """Close all, and remove their files."""
        for port in self._ports.values():
            port.close()
        self._ports.clear()
