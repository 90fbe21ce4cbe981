"""Emulated lines behind pseudo terminals: every program that opens a serial port can open one."""

from __future__ import annotations

import contextlib
import os
import pty
import select
import termios
import tty
from collections.abc import Sequence
from pathlib import Path

from robot.clock import Clock
from robot.closing import Closing
from sim.devices.serial_line import Line

MOST_A_READ = 4096
LONGEST_WAIT_S = 0.005
SHORTEST_WAIT_S = 0.0001
LIVE_EVERY_S = 0.000999

_SPEEDS = {
    getattr(termios, f"B{baud}"): baud
    for baud in (9600, 57_600, 115_200, 1_000_000, 2_000_000, 3_000_000, 4_000_000)
    if hasattr(termios, f"B{baud}")
}


class _Port:
    """A pseudo terminal; our end of its slave stays open, so that programs may come and go."""

    def __init__(self, path: Path, line: Line) -> None:
        self.line, self.path = line, path
        self.master, self._slave = pty.openpty()
        tty.setraw(self._slave)
        os.set_blocking(self.master, False)
        path.symlink_to(os.ttyname(self._slave))

    def read(self) -> bytes:
        """What a program wrote."""
        try:
            return os.read(self.master, MOST_A_READ)
        except OSError:
            return b""

    def is_as_fast(self) -> bool:
        """Whether the program has set the bit rate of the line: at another one nobody hears it.

        Of rates that the system has no constant for, nothing can be told.
        """
        told = _SPEEDS.get(termios.tcgetattr(self._slave)[5])
        return told is None or told == self.line.baud_hz

    def write(self, data: bytes) -> None:
        """Answers for the program; where nobody reads they are lost."""
        with contextlib.suppress(OSError):
            os.write(self.master, data)

    def close(self) -> None:
        """Pull the plug: who has it open sees it hang up."""
        self.path.unlink(missing_ok=True)
        os.close(self.master)
        os.close(self._slave)


class SerialServer(Closing):
    """Lines on pseudo terminals, played in time with a clock."""

    def __init__(self, lines: Sequence[tuple[Path, Line]], clock: Clock) -> None:
        """Put a link to a terminal at each path. Raises OSError if that cannot be."""
        self._clock, self._live_s = clock, 0.0
        self._ports: dict[int, _Port] = {}
        for path, line in lines:
            port = _Port(path, line)
            self._ports[port.master] = port

    def serve(self, until_s: float) -> None:
        """Play the lines until a time."""
        while (now_s := self._clock.now_s()) < until_s:
            self.step(min(until_s, now_s + LONGEST_WAIT_S))

    def step(self, until_s: float) -> None:
        """Wait for a program, or for the next thing on a line, and play up to now."""
        next_s = min((port.line.next_s for port in self._ports.values()), default=until_s)
        self.listen(max(SHORTEST_WAIT_S, min(next_s, until_s) - self._clock.now_s()))
        self.play(self._clock.now_s())

    def listen(self, wait_s: float) -> set[int]:
        """Take what programs wrote, waiting for it no longer than so; the lines, by number."""
        readable, _, _ = select.select([*self._ports], [], [], wait_s)
        now_s, wrote = self._clock.now_s(), set[int]()
        for number, (master, port) in enumerate(self._ports.items()):
            if master not in readable:
                continue
            if (data := port.read()) and port.is_as_fast():
                port.line.write(data, now_s)
                wrote.add(number)
        return wrote

    def play(self, now_s: float) -> None:
        """Let lines carry what they were given, and servos live, up to a time."""
        for port in self._ports.values():
            if heard := port.line.advance(now_s):
                port.write(heard)
            if now_s >= self._live_s:
                port.line.live(now_s)
        if now_s >= self._live_s:
            self._live_s = now_s + LIVE_EVERY_S

    def unplug(self, number: int) -> None:
        """Pull the plug of a port, counted from 0."""
        master = list(self._ports)[number]
        self._ports.pop(master).close()

    def close(self) -> None:
        """Close all, and remove the links."""
        for port in self._ports.values():
            port.close()
        self._ports.clear()
