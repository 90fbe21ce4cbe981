"""A CAN bus: bit times, arbitration, transmit queues that fill, error counters, bus-off.

It has no clock of its own: `advance` plays what happens up to a time. Every frame takes as long as
with the most stuffing bits that it can have, so that a bus here is never faster than a real one.
A robot's buses carry 33 000 frames a second: while nobody on a wire has trouble, a frame goes to
those who want its identifier, and nobody else is looked at.
Source: ISO 11898-1 (arbitration, fault confinement); CAN specification 2.0, part B.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import NamedTuple

PASSIVE_AT, OFF_AT = 128, 256
TRANSMIT_ERROR, RECEIVE_ERROR = 8, 1
ROUTES_KEPT = 4096
"""Identifiers whose listeners are remembered: more than the short ones that there are."""
ERROR_BITS = 23
"""An error flag, its echo, the delimiter and the pause."""
NEVER = float("inf")


class CanFrame(NamedTuple):
    """A data frame: identifier of 11 bits, or of 29; up to 8 bytes, or up to 64 of CAN FD."""

    id: int
    data: bytes
    extended: bool = False
    fd: bool = False

    def rank(self) -> int:
        """The lower wins: the first 11 bits, then a short identifier over a long one."""
        if self.extended:
            return (self.id >> 18) << 19 | 1 + (self.id & 0x3FFFF)
        return self.id << 19

    def bits(self) -> int:
        """On the wire at worst, with the pause behind it, of a classic frame."""
        return (_EXTENDED_BITS if self.extended else _BITS)[len(self.data)]

    def fd_bits(self) -> tuple[int, int]:
        """The same of an FD frame: before and behind its data, and of them, at another rate."""
        count = 8 * len(self.data)
        begins, crc = (36 if self.extended else 17), (21 if len(self.data) > 16 else 17)
        stuffed, early = (begins + 5 + count - 1) // 4, (begins - 1) // 4
        fixed = (4 + crc + 3) // 4
        return begins + early + 13, 5 + count + stuffed - early + 4 + crc + fixed


_BITS, _EXTENDED_BITS = (
    [fixed + 8 * count + (exposed + 8 * count - 1) // 4 + 3 for count in range(9)]
    for fixed, exposed in ((44, 34), (64, 54))
)


class Node:
    """A CAN controller on a wire.

    Attributes:
        knows_fd: whether it takes FD frames for frames, and not for errors.
        transmit_errors, receive_errors: its counters.
        is_off: it took itself off the bus, until `restart`.
        garbles: how many of its next frames nobody can read.
        dropped: frames that its full queue did not take.
        ready_s: when its first frame wants the wire; `NEVER` if there is none.
        rank: of that frame, in arbitration.
    """

    def __init__(
        self,
        hears: Callable[[CanFrame, float], None],
        *,
        room: int,
        on_off: Callable[[], None],
        on_wants: Callable[[], None],
        knows_fd: bool = True,
    ) -> None:
        """A controller whose queue has room for so many frames; `on_wants`: it wants others."""
        self.hears, self.on_off, self.knows_fd = hears, on_off, knows_fd
        self._wants: frozenset[int] | None = None
        self._on_wants = on_wants
        self.transmit_errors = self.receive_errors = 0
        self.is_off = False
        self.garbles = 0
        self.dropped = 0
        self.ready_s, self.rank = NEVER, 0
        self._room = room
        self._queue: deque[tuple[float, CanFrame]] = deque()

    @property
    def wants(self) -> frozenset[int] | None:
        """Identifiers that it hears, as an acceptance filter does; None: all."""
        return self._wants

    @wants.setter
    def wants(self, wants: frozenset[int]) -> None:
        self._wants = wants
        self._on_wants()

    @property
    def has_room(self) -> bool:
        """Whether its queue takes another frame."""
        return len(self._queue) < self._room

    def send(self, frame: CanFrame, at_s: float) -> bool:
        """Queue a frame, to go out at a time or later; False if there is no room."""
        queue = self._queue
        if self.is_off or len(queue) >= self._room:
            self.dropped += 1
            return False
        if not queue:
            self.ready_s, self.rank = at_s, frame.rank()
        queue.append((at_s, frame))
        return True

    def restart(self) -> None:
        """Come back onto the bus, as after 128 idle times of 11 bits."""
        self.is_off = False
        self.transmit_errors = self.receive_errors = 0

    def first(self) -> CanFrame:
        """The frame that wants the wire."""
        return self._queue[0][1]

    def sent(self) -> None:
        """It went through."""
        queue = self._queue
        queue.popleft()
        if queue:
            self.ready_s, first = queue[0]
            self.rank = first.rank()
        else:
            self.ready_s = NEVER
        if self.transmit_errors:
            self.transmit_errors -= 1

    def failed(self, *, unheard: bool = False) -> None:
        """It did not, and is tried again; one whom nobody hears at all gets passive and no more."""
        if unheard and self.transmit_errors >= PASSIVE_AT:
            return
        self.transmit_errors += TRANSMIT_ERROR
        if self.transmit_errors >= OFF_AT:
            self.is_off = True
            self._queue.clear()
            self.ready_s = NEVER
            self.on_off()


class Wire:
    """The wire between nodes.

    Attributes:
        now_s: up to when it was played.
        busy_s: for how long of that it carried something.
    """

    def __init__(
        self, *, bitrate_hz: float = 1e6, data_bitrate_hz: float = 0.0, now_s: float = 0.0
    ) -> None:
        """An idle wire, from a time on; FD frames are frames where there is a rate for data."""
        self.now_s, self.busy_s = now_s, 0.0
        self.nodes: list[Node] = []
        self._bit_s = 1.0 / bitrate_hz
        self._data_bit_s = 1.0 / data_bitrate_hz if data_bitrate_hz else 0.0
        self._senders: list[Node] = []
        self._ends_s = NEVER
        self._routes: dict[int, list[Node]] = {}
        self._routed: list[Node] = []
        self._is_calm = False

    def attach(
        self,
        hears: Callable[[CanFrame, float], None],
        *,
        room: int = 64,
        on_off: Callable[[], None] = lambda: None,
        knows_fd: bool = True,
    ) -> Node:
        """Connect a controller.

        Args:
            hears: is told every frame of the others, and when it was complete.
            room: of its transmit queue, in frames.
            on_off: is told when it goes off the bus.
            knows_fd: whether it takes FD frames for frames; one of CAN 2.0 destroys them.
        """
        node = Node(hears, room=room, on_off=on_off, on_wants=self._routes.clear, knows_fd=knows_fd)
        self.nodes.append(node)
        return node

    def detach(self, node: Node) -> None:
        """Pull its plug."""
        self.nodes.remove(node)
        if node in self._senders:
            self._senders.remove(node)

    @property
    def next_s(self) -> float:
        """When the next thing happens; `NEVER` if nobody wants to send."""
        if self._ends_s < NEVER:
            return self._ends_s
        first_s = NEVER
        for node in self.nodes:
            if node.ready_s < first_s:  # noqa: PLR1730 (min is a call, 20 000 times a second)
                first_s = node.ready_s
        return first_s if first_s > self.now_s else self.now_s

    def advance(self, until_s: float) -> None:
        """Play what happens up to a time."""
        while True:
            if self._ends_s < NEVER:
                if self._ends_s > until_s:
                    break
                self.now_s = self._ends_s
                self._finish()
            elif not self._begin(until_s):
                break
        self.now_s = max(self.now_s, until_s)

    def _begin(self, until_s: float) -> bool:
        """Arbitration, if anybody is ready by then: the lowest identifier goes on."""
        first_s = NEVER
        for node in self.nodes:
            if node.ready_s < first_s:  # noqa: PLR1730 (min is a call, 20 000 times a second)
                first_s = node.ready_s
        now_s = max(self.now_s, first_s)
        if now_s > until_s or first_s == NEVER:
            return False
        self.now_s, best = now_s, NEVER
        ready: list[Node] = []
        for node in self.nodes:
            if node.ready_s > now_s:
                continue
            if node.rank < best:
                best, ready = node.rank, [node]
            elif node.rank == best:
                ready.append(node)
        self._senders = ready
        frame = ready[0].first()
        if frame.fd:
            bits, fast_bits = frame.fd_bits()
            took_s = self._bit_s * bits + self._data_bit_s * fast_bits
        else:
            took_s = self._bit_s * frame.bits()
        if self._spoilt(ready):
            took_s += self._bit_s * ERROR_BITS
        self._ends_s = now_s + took_s
        self.busy_s += took_s
        return True

    def _spoilt(self, senders: list[Node]) -> bool:
        """Whether nobody can read it.

        Two say different things at once, one is broken, or not everybody knows FD frames.
        """
        if senders[0].first().fd and not self.carries_fd:
            return True
        if len(senders) == 1:
            return senders[0].garbles > 0
        frames = {node.first() for node in senders}
        return len(frames) > 1 or any(node.garbles for node in senders)

    @property
    def carries_fd(self) -> bool:
        """Whether FD frames get through: there is a rate for their data, and all know them."""
        if self._data_bit_s == 0.0:
            return False
        for node in self.nodes:  # noqa: SIM110 (twice as fast as all(), 20 000 times a second)
            if not node.knows_fd:
                return False
        return True

    def _finish(self) -> None:
        self._ends_s = NEVER
        senders, self._senders = self._senders, []
        if not senders:  # unplugged in the middle of it
            return
        if self.nodes != self._routed:
            self._routes.clear()
            self._routed, self._is_calm = self.nodes.copy(), False
        sender = senders[0]
        if self._is_calm and len(senders) == 1 and self._routable(sender):
            frame = sender.first()
            sender.sent()
            route = self._routes.get(frame.id)
            for node in self._route(frame.id) if route is None else route:
                if node is not sender:
                    node.hears(frame, self.now_s)
        else:
            self._finish_in_trouble(senders)
            self._is_calm = not any(node.is_off or node.receive_errors for node in self.nodes)

    def _routable(self, sender: Node) -> bool:
        """Whether its frame arrives as it is sent, and somebody is there who hears it."""
        if sender.garbles or len(self._routed) < 2:
            return False
        return not sender.first().fd or self.carries_fd

    def _route(self, number: int) -> list[Node]:
        """Who wants this identifier."""
        if len(self._routes) > ROUTES_KEPT:
            self._routes.clear()
        wanted = [node for node in self.nodes if node.wants is None or number in node.wants]
        self._routes[number] = wanted
        return wanted

    def _finish_in_trouble(self, senders: list[Node]) -> None:
        """The same where anybody's counters are in it: of those who send, or who hear."""
        spoilt = self._spoilt(senders)
        frame = senders[0].first()
        others = [node for node in self.nodes if node not in senders and not node.is_off]
        if spoilt or not others:
            for node in senders:
                node.garbles = max(0, node.garbles - 1)
                node.failed(unheard=not spoilt)
            for node in others:
                node.receive_errors = min(PASSIVE_AT, node.receive_errors + RECEIVE_ERROR)
            return
        for node in senders:
            node.sent()
        for node in others:
            if node.receive_errors:
                node.receive_errors -= 1
            if node.wants is None or frame.id in node.wants:
                node.hears(frame, self.now_s)
