"""Who may wait at the door of the page: bounded before anybody has shown that he knows the token.

A connection costs a file and some memory from its first moment, whoever made it. So those that have
not shown the token are few, the oldest goes when there are too many, and none stays for long. Other
users' are counted by themselves: they never push out one of this user's.
"""

from __future__ import annotations

import asyncio
import os
from dataclasses import dataclass

from executive.frontends.console.peer import Address, Peers

TOKEN_S = 5.0
"""How long a connection may last without the token, also one that asks for the page alone."""
MOST_OWN = 32
"""Of this user's, and root's: a browser opens six to one address."""
MOST_OTHERS = 8


@dataclass
class _Waiting:
    transport: asyncio.Transport
    over: asyncio.TimerHandle


class Door:
    """The connections without a token."""

    def __init__(self, peers: Peers, *, most_own: int = MOST_OWN, most_others: int = MOST_OTHERS):
        """Nobody waits yet.

        Args:
            peers: knows whose a connection is.
            most_own: connections of this user and of root.
            most_others: connections of other users, and of who knows whom.
        """
        self._peers = peers
        self._own: dict[object, _Waiting] = {}
        self._others: dict[object, _Waiting] = {}
        self._most_own, self._most_others = most_own, most_others

    def __len__(self) -> int:
        """How many wait."""
        return len(self._own) + len(self._others)

    def come(self, who: object, transport: asyncio.Transport) -> None:
        """A connection was made; where too many wait, the oldest of its kind is let go."""
        own = self._is_own(transport)
        waiting, most = (self._own, self._most_own) if own else (self._others, self._most_others)
        while len(waiting) >= most:
            oldest = next(iter(waiting))
            waiting[oldest].transport.abort()
            self.leave(oldest)
        loop = asyncio.get_running_loop()
        waiting[who] = _Waiting(transport, loop.call_later(TOKEN_S, transport.abort))

    def leave(self, who: object) -> None:
        """A connection has shown the token, or is gone."""
        left = self._own.pop(who, None) or self._others.pop(who, None)
        if left is not None:
            left.over.cancel()

    def _is_own(self, transport: asyncio.Transport) -> bool:
        here: Address | None = transport.get_extra_info("sockname")
        there: Address | None = transport.get_extra_info("peername")
        if here is None or there is None:
            return False
        return self._peers.user(here, there) in (os.geteuid(), 0)
