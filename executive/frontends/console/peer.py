"""Whose program is at the other end of a connection within this machine, as the kernel knows it."""

from __future__ import annotations

import socket
import struct

NETLINK_SOCK_DIAG, SOCK_DIAG_BY_FAMILY, REQUEST = 4, 20, 1
ANY = 0xFFFFFFFF
HEADER = struct.Struct("=IHHII")
QUERY = struct.Struct("=BBBBI")
ENDS = struct.Struct("!HH4s12x4s12x")
COOKIE = struct.Struct("=III")
UID_INODE = struct.Struct("=II")
UID_AT = HEADER.size + 4 + 48 + 12
"""Of the answer, `struct inet_diag_msg` (linux/inet_diag.h): behind states, ends and queues."""
ANSWER = UID_AT + UID_INODE.size

Address = tuple[str, int]


class Peers:
    """Asks the kernel (sock_diag(7)): 50 us a question, however many sockets there are."""

    def __init__(self) -> None:
        """Open the way to the kernel, where there is one."""
        try:
            self._kernel = socket.socket(socket.AF_NETLINK, socket.SOCK_RAW, NETLINK_SOCK_DIAG)
            self._kernel.settimeout(0.1)  # it answers at once
        except (OSError, AttributeError):
            self._kernel = None

    def user(self, here: Address, there: Address) -> int | None:
        """The user whose socket is connected from `there` to `here`; None if nobody can tell.

        Whoever has closed a socket already is nobody: the kernel says it was root's.
        """
        if self._kernel is None:
            return None
        ends = ENDS.pack(there[1], here[1], socket.inet_aton(there[0]), socket.inet_aton(here[0]))
        query = QUERY.pack(socket.AF_INET, socket.IPPROTO_TCP, 0, 0, ANY)
        body = query + ends + COOKIE.pack(0, ANY, ANY)
        header = HEADER.pack(HEADER.size + len(body), SOCK_DIAG_BY_FAMILY, REQUEST, 0, 0)
        try:
            self._kernel.send(header + body)
            answer = self._kernel.recv(4096)
        except OSError:
            return None
        if len(answer) < ANSWER or HEADER.unpack_from(answer)[1] != SOCK_DIAG_BY_FAMILY:
            return None
        user, inode = UID_INODE.unpack_from(answer, UID_AT)
        return user if inode else None

    def close(self) -> None:
        """Ask no more."""
        if self._kernel is not None:
            self._kernel.close()
            self._kernel = None
