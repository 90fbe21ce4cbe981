"""Boards over UDP: a socket for each, and nothing here ever waits."""

from __future__ import annotations

import errno
import ipaddress
import select
import socket
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Protocol, Self

from robot.closing import Closing
from robot.drivers.motors.ethernet.joint_map import Board
from robot.errors import DriverError

MOST_A_CALL = 32
"""Datagrams of one board: whoever floods it must not hold up the others."""
MOST_BYTES = 2048
FULL = (errno.EAGAIN, errno.ENOBUFS)


class Ports(Closing, Protocol):
    """The ways to all boards, opened by entering and closed by leaving."""

    @property
    def gone(self) -> Mapping[str, str]:
        """Boards that there is no way to any more, and why."""
        ...

    @property
    def strangers(self) -> Mapping[str, int]:
        """Datagrams, by board, that came from somewhere else than the board's address."""
        ...

    def send(self, board: str, data: bytes) -> bool:
        """Hand a datagram over; False at once if there is no room. One for a lost board is dropped.

        Raises:
            DriverError: if there is no way to any board.
        """
        ...

    def receive(self) -> Sequence[tuple[str, bytes]]:
        """What has come in by now from the boards' own addresses. Raises DriverError as `send`."""
        ...


class UdpPorts(Closing):
    """Sockets of this machine."""

    def __init__(self, boards: Mapping[str, Board]) -> None:
        """Know them; nothing is opened."""
        self._boards = dict(boards)
        self._opened: dict[str, socket.socket] = {}
        self._by_fd: dict[int, str] = {}
        self._at: dict[str, tuple[str, int]] = {}
        self._poll = select.poll()
        self._gone: dict[str, str] = {}
        self._strangers = dict.fromkeys(self._boards, 0)

    def __enter__(self) -> Self:
        """Open all. Raises DriverError naming the one that there is no way to."""
        for name, board in self._boards.items():
            try:
                address = self._at[name] = where(board)
                family = socket.AF_INET6 if ":" in address[0] else socket.AF_INET
                opened = self._opened[name] = socket.socket(family, socket.SOCK_DGRAM)
                opened.settimeout(0.0)
                # A port of its own from the beginning; nothing is sent, so nobody has to answer.
                # On loopback where the board is: no other machine may speak to it.
                every = "::" if family == socket.AF_INET6 else "0.0.0.0"
                opened.bind(
                    (address[0] if ipaddress.ip_address(address[0]).is_loopback else every, 0)
                )
            except OSError as error:
                self.close()
                text = f"the board {name!r} ({board.channel}) cannot be reached: {error.strerror}"
                raise DriverError(f"{text} (is the network up? ip address show)") from None
            self._by_fd[opened.fileno()] = name
            self._poll.register(opened.fileno(), select.POLLIN)
        return self

    @property
    def gone(self) -> Mapping[str, str]:
        """Boards that there is no way to any more, and why."""
        return self._gone

    @property
    def strangers(self) -> Mapping[str, int]:
        """Datagrams that came from somewhere else than a board's address."""
        return self._strangers

    def send(self, board: str, data: bytes) -> bool:
        """Hand a datagram over."""
        if (opened := self._there(board)) is None:
            return True
        try:
            opened.sendto(data, self._at[board])
        except OSError as error:
            if error.errno in FULL:
                return False
            self._lose(board, f"there is no way to it any more: {error.strerror}")
        return True

    def receive(self) -> Sequence[tuple[str, bytes]]:
        """What has come in by now."""
        if not self._opened:
            raise DriverError("the boards are not open")
        came: list[tuple[str, bytes]] = []
        for fd, _ in self._poll.poll(0):
            board = self._by_fd[fd]
            opened, address = self._opened[board], self._at[board]
            with suppress(BlockingIOError, ConnectionError):
                for _ in range(MOST_A_CALL):
                    data, source = opened.recvfrom(MOST_BYTES)
                    if source[:2] == address:
                        came.append((board, data))
                    else:
                        self._strangers[board] += 1
        return came

    def _there(self, board: str) -> socket.socket | None:
        if not self._opened:
            raise DriverError("the boards are not open")
        return None if board in self._gone else self._opened[board]

    def _lose(self, board: str, why: str) -> None:
        self._gone[board] = why
        if len(self._gone) == len(self._opened):
            raise DriverError(f"there is no way to any board; {board}: {why}")

    def close(self) -> None:
        """Close all."""
        for fd in self._by_fd:
            self._poll.unregister(fd)
        for opened in self._opened.values():
            opened.close()
        self._opened.clear()
        self._by_fd.clear()


def where(board: Board) -> tuple[str, int]:
    """Address and port of a board; of an emulated one its file says them.

    Raises:
        DriverError: the file of an emulated one is not there, or says nothing of the kind.
    """
    if not board.is_emulated:
        return str(ipaddress.ip_address(board.address)), board.port
    try:
        address, port = Path(board.address).read_text().split()
        return address, int(port)
    except (OSError, ValueError):
        text = f"no emulated board is at {board.address}"
        raise DriverError(f"{text} (is the simulation running?)") from None
