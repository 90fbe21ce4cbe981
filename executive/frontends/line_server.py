"""A unix socket on which others send lines and are sent lines: bounded in all that they can want.

Each client has a thread that reads. One that is a megabyte behind with reading what it is sent,
that sends a line without an end, or that is another user's, is let go. Where there are as many as
there may be, the one that was silent longest makes room, so that forgotten connections keep nobody
from stopping a robot.
"""

from __future__ import annotations

import errno
import itertools
import os
import socket
import struct
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress

from robot.closing import Closing

AGAIN_S = 0.05
MOST_BEHIND = 1 << 20
"""Bytes that may wait for a client that reads slowly."""
_PASSING = (
    errno.EMFILE, errno.ENFILE, errno.ENOMEM, errno.ENOBUFS, errno.ECONNABORTED, errno.EINTR,
    errno.EAGAIN, errno.EPERM,
)  # fmt: skip
"""What accept(2) fails with and may not fail with the next time."""
_CREDENTIALS = struct.Struct("3i")
"""Process, user and group of a socket's other end (unix(7), SO_PEERCRED)."""


def is_own(connection: socket.socket) -> bool:
    """Whether the other end of a socket is a process of this user."""
    data = connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, _CREDENTIALS.size)
    return _CREDENTIALS.unpack(data)[1] == os.geteuid()


class Client:
    """Somebody who is connected.

    What it does not read at once waits for it, in a thread that is there only as long as it is
    behind; nobody else waits for that.
    """

    def __init__(self, connection: socket.socket) -> None:
        """Take a connection over."""
        self._connection = connection
        self._lock = threading.Lock()
        self._behind: deque[bytes] = deque()
        self._behind_bytes = 0
        self._latest = b""
        self._late = False
        self.last_heard = 0
        """Counts what all clients said; the least is of who was silent longest."""

    def send(self, line: bytes, *, supersedes: bool = False) -> bool:
        """Send a line, now or when the client has read what it was sent before; never waits.

        Args:
            line: what is sent.
            supersedes: whether it takes the place of the one of that kind that waits still.

        Returns:
            Whether it may arrive: one that is too far behind is let go.
        """
        with self._lock:
            if self._late:
                if supersedes:
                    self._latest = line
                else:
                    self._keep(line)
                within = self._behind_bytes <= MOST_BEHIND
            else:
                within = self._sent_or_late(line)
        if not within:
            self.drop()
        return within

    def _sent_or_late(self, line: bytes) -> bool:
        """Send what there is room for, and begin to wait for more room; whether that can be."""
        try:
            sent = self._connection.send(line, socket.MSG_DONTWAIT)
        except BlockingIOError:
            sent = 0
        except OSError:
            return False
        if sent == len(line):
            return True
        self._keep(line[sent:])
        self._late = True
        try:
            threading.Thread(target=self._catch_up, name="slow client", daemon=True).start()
        except RuntimeError:  # no room for a thread
            return False
        return True

    def _keep(self, line: bytes) -> None:
        self._behind.append(line)
        self._behind_bytes += len(line)

    def _catch_up(self) -> None:
        """Send what waits as fast as it is read."""
        with suppress(OSError):
            while line := self._next():
                self._connection.sendall(line)
            return
        self.drop()

    def _next(self) -> bytes:
        with self._lock:
            if self._behind:
                line = self._behind.popleft()
                self._behind_bytes -= len(line)
                return line
            line, self._latest = self._latest, b""
            self._late = bool(line)
            return line

    def drop(self) -> None:
        """Let it go; its thread notices."""
        with suppress(OSError):
            self._connection.shutdown(socket.SHUT_RDWR)


class LineServer(Closing):
    """A context manager: takes lines from clients inside."""

    def __init__(
        self,
        listening: socket.socket,
        *,
        heed: Callable[[Client, bytes], None],
        is_welcome: Callable[[socket.socket], bool],
        greet: Callable[[Client], object] = lambda _: None,
        gone: Callable[[Client], None] = lambda _: None,
        most_clients: int,
        longest: int,
    ) -> None:
        """Begin to listen.

        Args:
            listening: the socket, which is closed in the end.
            heed: takes a line, in a thread of that client's.
            is_welcome: whether a connection is let in.
            greet: is called with a new client before anything that it says.
            gone: is called with a client that left or was let go.
            most_clients: that are connected at a time.
            longest: bytes of a line.
        """
        self._listening = listening
        self._heed = heed
        self._is_welcome = is_welcome
        self._greet = greet
        self._gone = gone
        self._most_clients = most_clients
        self._longest = longest
        self._clients: list[Client] = []
        self._lock = threading.Lock()
        self._count = itertools.count(1)
        self._closing = False
        threading.Thread(target=self._accept, name="line server", daemon=True).start()

    def close(self) -> None:
        """Let everybody go."""
        self._closing = True
        with suppress(OSError):
            self._listening.shutdown(socket.SHUT_RDWR)
        self._listening.close()
        for client in self.clients:
            client.drop()

    @property
    def clients(self) -> tuple[Client, ...]:
        """Who is connected."""
        with self._lock:
            return tuple(self._clients)

    def tell(self, line: bytes) -> None:
        """Send a line to everybody."""
        for client in self.clients:
            client.send(line)

    def _accept(self) -> None:
        """Let in who comes; a shortage (of open files, threads, memory) ends nothing."""
        while not self._closing:
            try:
                connection, _ = self._listening.accept()
            except OSError as error:
                if error.errno not in _PASSING:
                    return
                self._make_room()
                time.sleep(AGAIN_S)
                continue
            try:
                if self._is_welcome(connection):
                    self._admit(connection)
                    continue
            except (OSError, RuntimeError):  # no room for a thread, or gone already
                self._make_room()
            connection.close()

    def _make_room(self) -> None:
        """Let the one go that was silent longest."""
        with self._lock:
            if self._clients:
                silent = min(self._clients, key=lambda one: one.last_heard)
                self._clients.remove(silent)
                silent.drop()

    def _admit(self, connection: socket.socket) -> None:
        client = Client(connection)
        client.last_heard = next(self._count)
        if len(self.clients) >= self._most_clients:
            self._make_room()
        thread = threading.Thread(
            target=self._serve, args=(client, connection), name="client", daemon=True
        )
        with self._lock:
            self._clients.append(client)
        try:
            thread.start()
        except RuntimeError:
            with self._lock, suppress(ValueError):
                self._clients.remove(client)
            raise

    def _serve(self, client: Client, connection: socket.socket) -> None:
        try:
            with suppress(OSError, ValueError), connection, connection.makefile("rb") as lines:
                self._greet(client)
                while line := lines.readline(self._longest):
                    if not line.endswith(b"\n"):  # longer than it may be, or left in the midst
                        return
                    client.last_heard = next(self._count)
                    self._heed(client, line)
        finally:
            with self._lock:
                if client in self._clients:
                    self._clients.remove(client)
            self._gone(client)
