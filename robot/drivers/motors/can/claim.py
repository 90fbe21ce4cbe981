"""One program at a time commands a bus: the system lets go of the claim of one that dies."""

from __future__ import annotations

import hashlib
import socket
from collections.abc import Iterable


class Claim:
    """Of several channels, all of them or none.

    A name in the abstract namespace of UNIX sockets is bound by one socket at a time, in the same
    network namespace that CAN interfaces are in, and is free when its process ends.
    """

    def __init__(self, channels: Iterable[str]) -> None:
        """Nothing is claimed yet."""
        self._names = [f"\0humanoid-can/{_short(channel)}" for channel in sorted(set(channels))]
        self._held: list[socket.socket] = []

    @property
    def is_held(self) -> bool:
        """Whether it is ours."""
        return bool(self._held)

    def take(self) -> bool:
        """Claim them; False while somebody else has any of them."""
        if self._held:
            return True
        for name in self._names:
            one = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
            self._held.append(one)
            try:
                one.bind(name)
            except OSError:
                self.release()
                return False
        return True

    def is_free(self) -> bool:
        """Whether nobody else has any of them."""
        if self._held:
            return True
        taken = self.take()
        self.release()
        return taken

    def release(self) -> None:
        """Let go of them."""
        for one in self._held:
            one.close()
        self._held.clear()


def _short(channel: str) -> str:
    """A name has 107 bytes, and a channel may be a path."""
    return hashlib.blake2b(channel.encode(), digest_size=16).hexdigest()
