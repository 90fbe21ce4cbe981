"""Emulated buses on UNIX sockets: every program that connects is a controller on the wire."""

from __future__ import annotations

import contextlib
import select
import socket
from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

from robot.clock import Clock
from robot.closing import Closing
from sim.devices.socket_frames import FD_SIZE, OFF_FRAME, packed, unpacked
from sim.devices.wire import NEVER, CanFrame, Node, Wire

QUEUE_FRAMES = 10
"""Of a program's transmit queue: socketcan's `txqueuelen`."""
LONGEST_WAIT_S = 0.01
SHORTEST_WAIT_S = 0.0001
"""A frame is told so much late at most: to wake up for each of six buses' would take a core."""
DEAF_FRAMES = 100
"""What a program that does not read misses: so many are not even tried, as that takes time."""
LIVE_EVERY_S = 0.000999
"""Devices live up to every frame that they hear; in between now and then, too: every millisecond
(a hair less, as sums of them are not exact)."""


class Living(Protocol):
    """A device whose time goes by."""

    def live(self, until_s: float) -> None:
        """Let time go by up to a moment."""
        ...


class _Program:
    """A client: what it sends goes into its controller's queue while that has room.

    Attributes:
        taken: frames of the last time that it was looked at.
    """

    def __init__(self, wire: Wire, client: socket.socket) -> None:
        self.client = client
        self.taken = self._deaf = 0
        self.node: Node = wire.attach(self._hear, room=QUEUE_FRAMES, on_off=self._off)
        self.wire = wire

    def _hear(self, frame: CanFrame, _at_s: float) -> None:
        if self._deaf > 0:
            self._deaf -= 1
            return
        try:
            self.client.send(packed(frame))
        except OSError:  # it reads too slowly, or not at all, or is gone: socketcan drops, too
            self._deaf = DEAF_FRAMES

    def _off(self) -> None:
        with contextlib.suppress(OSError):
            self.client.send(OFF_FRAME)

    def take(self, now_s: float) -> bool:
        """Move frames from its socket into its queue; False if it went away."""
        self.taken = 0
        while self.node.has_room:
            try:
                data = self.client.recv(FD_SIZE)
            except BlockingIOError:
                return True
            except ConnectionResetError:
                continue  # it left without having read all; what it sent is still to come
            except OSError:
                return False
            if not data:
                return False
            if (frame := unpacked(data)) is not None:
                self.node.send(frame, now_s)
                self.taken += 1
                self._deaf = 0  # who speaks again listens
        return True


class CanServer(Closing):
    """Wires on sockets, played in time with a clock."""

    def __init__(
        self, wires: Sequence[tuple[Path, Wire]], devices: Sequence[Living], clock: Clock
    ) -> None:
        """Listen at a path for each wire. Raises OSError if a path cannot be bound."""
        self._clock, self._devices = clock, devices
        self._live_s = 0.0
        self._wires = [wire for _, wire in wires]
        self._paths = [path for path, _ in wires]
        self._listening: dict[int, tuple[socket.socket, Wire]] = {}
        self._programs: dict[int, _Program] = {}
        self._gone: list[_Program] = []
        for path, wire in wires:
            listening = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            listening.bind(str(path))
            path.chmod(0o600)
            listening.listen(8)
            listening.settimeout(0)
            self._listening[listening.fileno()] = listening, wire

    def serve(self, until_s: float) -> None:
        """Play the wires until a time."""
        while (now_s := self._clock.now_s()) < until_s:
            self.step(min(until_s, now_s + LONGEST_WAIT_S))

    def step(self, until_s: float) -> None:
        """Wait for a program or for the next thing on a wire, and play up to now."""
        next_s = min((wire.next_s for wire in self._wires), default=until_s)
        wait_s = max(SHORTEST_WAIT_S, min(next_s, until_s) - self._clock.now_s())
        self.listen(wait_s)
        self.play(self._clock.now_s())

    def listen(self, wait_s: float) -> int:
        """Take what programs send, waiting for it no longer than so; how many frames came."""
        waiting = [fd for fd, program in self._programs.items() if program.node.has_room]
        readable, _, _ = select.select([*self._listening, *waiting], [], [], wait_s)
        now_s, taken = self._clock.now_s(), 0
        for fd in readable:
            if fd in self._listening:
                self._welcome(fd)
                continue
            program = self._programs[fd]
            if not program.take(now_s):
                self._forget(fd)
            taken += program.taken
        return taken

    def play(self, now_s: float) -> None:
        """Let the wires carry what they were given, and the devices live, up to a time."""
        for wire in self._wires:
            wire.advance(now_s)
        for program in [gone for gone in self._gone if gone.node.ready_s == NEVER]:
            self._gone.remove(program)
            program.wire.detach(program.node)
        if now_s >= self._live_s:
            self._live_s = now_s + LIVE_EVERY_S
            for device in self._devices:
                device.live(now_s)

    def _welcome(self, fd: int) -> None:
        listening, wire = self._listening[fd]
        client, _ = listening.accept()
        client.settimeout(0)
        self._programs[client.fileno()] = _Program(wire, client)

    def _forget(self, fd: int) -> None:
        """A program left: what it has queued still goes out, as from a kernel's queue."""
        program = self._programs.pop(fd)
        program.client.close()
        self._gone.append(program)

    def close(self) -> None:
        """Close every socket, and remove the paths."""
        for fd in list(self._programs):
            self._forget(fd)
        for listening, _ in self._listening.values():
            listening.close()
        self._listening.clear()
        for path in self._paths:
            path.unlink(missing_ok=True)
