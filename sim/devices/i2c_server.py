"""Emulated buses of I2C on UNIX sockets: a packet is a transfer, and its answer.

A question is address, register, how many bytes to read (0: the rest is written); an answer is errno
in two bytes, little endian, and what was read.
"""

from __future__ import annotations

import contextlib
import select
import socket
from collections.abc import Sequence
from pathlib import Path

from robot.clock import Clock
from robot.closing import Closing
from sim.devices.i2c_bus import I2cBus
from sim.devices.pwm_bench import PwmBench

MOST_BYTES = 64
LONGEST_WAIT_S = 0.005


class I2cServer(Closing):
    """Buses on sockets, served in time with a clock."""

    def __init__(self, buses: Sequence[tuple[Path, I2cBus]], bench: PwmBench, clock: Clock) -> None:
        """Listen at a path for each. Raises OSError if a path cannot be bound."""
        self._clock, self._bench = clock, bench
        self._paths = [path for path, _ in buses]
        self._listening: dict[int, tuple[socket.socket, I2cBus]] = {}
        self._clients: dict[int, tuple[socket.socket, I2cBus]] = {}
        for path, bus in buses:
            listening = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            listening.bind(str(path))
            path.chmod(0o600)
            listening.listen(8)
            listening.settimeout(0.0)
            self._listening[listening.fileno()] = listening, bus

    def serve(self, until_s: float) -> None:
        """Serve until a time."""
        while (now_s := self._clock.now_s()) < until_s:
            self.listen(min(LONGEST_WAIT_S, until_s - now_s))
            self.play(self._clock.now_s())

    def listen(self, wait_s: float) -> None:
        """Do what programs ask, waiting for it no longer than so."""
        while True:
            waiting = [*self._listening, *self._clients]
            if not waiting:
                return
            readable, _, _ = select.select(waiting, [], [], wait_s)
            if not readable:
                return
            for fd in readable:
                self._take(fd)
            wait_s = 0.0

    def _take(self, fd: int) -> None:
        if fd in self._listening:
            listening, bus = self._listening[fd]
            with contextlib.suppress(OSError):
                client, _ = listening.accept()
                client.settimeout(0.0)
                self._clients[client.fileno()] = client, bus
            return
        client, bus = self._clients[fd]
        try:
            asked = client.recv(MOST_BYTES)
            if asked:
                client.send(_answer(bus, asked))
                return
        except BlockingIOError:
            return
        except OSError:
            pass  # it went away
        del self._clients[fd]
        client.close()

    def play(self, now_s: float) -> None:
        """Let servos live up to a time."""
        self._bench.live(now_s)

    def close(self) -> None:
        """Close all."""
        for one, _ in (*self._listening.values(), *self._clients.values()):
            one.close()
        self._listening.clear()
        self._clients.clear()
        for path in self._paths:
            path.unlink(missing_ok=True)


def _answer(bus: I2cBus, asked: bytes) -> bytes:
    if len(asked) < 3:
        return (22).to_bytes(2, "little")
    address, register, length = asked[0], asked[1], asked[2]
    try:
        if length:
            return b"\0\0" + bus.read(address, register, length)
        bus.write(address, register, asked[3:])
    except OSError as error:
        return (error.errno or 5).to_bytes(2, "little")
    return b"\0\0"
