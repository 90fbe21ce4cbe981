"""Messages from one part of the robot to another: the interface, and the bus inside one process."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from typing import Any, Generic, Protocol, TypeVar

from robot.bus.topics import Topic
from robot.closing import Closing
from robot.errors import BusError

M = TypeVar("M")
M_co = TypeVar("M_co", covariant=True)


class Subscription(Protocol[M_co]):
    """One reader of one topic; made by `Bus.subscribe`, used by one thread."""

    @property
    def latest(self) -> M_co | None:
        """The newest message, None before the first."""
        ...

    def take(self) -> Sequence[M_co]:
        """What came since the last `take`, oldest first; the oldest are lost beyond the queue."""
        ...

    @property
    def refused(self) -> int:
        """How many messages could not be decoded and were dropped."""
        ...


class Bus(Closing, Protocol):
    """Carries messages by topic. A context manager; closing it twice is fine."""

    def publish(self, topic: Topic[M], message: M) -> None:
        """Send to everyone who has subscribed; never blocks.

        Raises:
            BusError: if the bus is closed.
        """
        ...

    def subscribe(self, topic: Topic[M]) -> Subscription[M]:
        """Read a topic from now on. Raises BusError if the bus is closed."""
        ...

    def close(self) -> None:
        """Let go of the transport; subscriptions keep what they have."""
        ...


class LocalSubscription(Generic[M]):
    """A reader inside the process: messages are handed over as they are (they are frozen)."""

    def __init__(self, queue: int) -> None:
        self.latest: M | None = None
        self.refused = 0
        self._queue: deque[M] = deque(maxlen=queue)

    def put(self, message: M) -> None:
        """Called by the bus."""
        self.latest = message
        self._queue.append(message)

    def take(self) -> list[M]:
        """What came since the last `take`, oldest first."""
        if not self._queue:
            return []
        messages = list(self._queue)
        self._queue.clear()
        return messages


class LocalBus(Closing):
    """A bus inside one process: delivered before `publish` returns, so runs repeat exactly."""

    def __init__(self) -> None:
        self._readers: dict[str, list[LocalSubscription[Any]]] = {}
        self._open = True

    def publish(self, topic: Topic[M], message: M) -> None:
        """Hand the message to every subscription of the topic."""
        self._check_open()
        for reader in self._readers.get(topic.name, ()):
            reader.put(message)

    def subscribe(self, topic: Topic[M]) -> LocalSubscription[M]:
        """Read a topic from now on."""
        self._check_open()
        reader: LocalSubscription[M] = LocalSubscription(topic.queue)
        self._readers.setdefault(topic.name, []).append(reader)
        return reader

    def close(self) -> None:
        """Refuse what comes after."""
        self._open = False

    def _check_open(self) -> None:
        if not self._open:
            raise BusError("the bus is closed")
