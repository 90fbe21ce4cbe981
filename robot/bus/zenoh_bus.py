"""A bus between processes of one machine: zenoh over unix sockets in a private folder.

Nothing listens on a network. Every process listens on a socket of its own name and connects to the
names before it in `LISTENING` (retrying, so that any order of starts and restarts will do): a full
mesh, because zenoh peers do not forward for one another when gossip is off. The last two of
`PEERS` listen nowhere: of the controller there may be two, one of them a spare, and the camera that
is simulated has nothing to say to it.
"""

# pyright: basic

from __future__ import annotations

import contextlib
import json
from collections import deque
from pathlib import Path
from typing import Any, Generic, TypeVar

import msgspec
import zenoh

from robot.bus.topics import Topic
from robot.closing import Closing
from robot.errors import BusError

M = TypeVar("M")
PEERS = ("executive", "plant", "perception", "observer", "controller", "camera")
LISTENING = PEERS[:4]
MAX_PATH_BYTES = 100
RETRY = {"period_init_ms": 20, "period_max_ms": 100, "period_increase_factor": 1.5}


class ZenohSubscription(Generic[M]):
    """A reader of a topic; zenoh's threads fill a ring, the caller's thread decodes."""

    def __init__(
        self, samples: zenoh.Subscriber[zenoh.Handler[zenoh.Sample]], topic: Topic[M]
    ) -> None:
        self.refused = 0
        self._samples = samples
        self._decoder: msgspec.msgpack.Decoder[M] = msgspec.msgpack.Decoder(topic.kind)
        self._latest: M | None = None
        self._queue: deque[M] = deque(maxlen=topic.queue)
        self._open = True

    @property
    def latest(self) -> M | None:
        """The newest message, None before the first."""
        self._poll()
        return self._latest

    def take(self) -> list[M]:
        """What came since the last `take`, oldest first."""
        self._poll()
        if not self._queue:
            return []
        messages = list(self._queue)
        self._queue.clear()
        return messages

    def close(self) -> None:
        """Take what there is, then listen no more."""
        self._poll()
        self._open = False

    def _poll(self) -> None:
        """Decode what came; what is not a message of this topic is counted and dropped."""
        while self._open and (sample := self._samples.try_recv()) is not None:
            try:
                message = self._decoder.decode(sample.payload.to_bytes())
            except (msgspec.DecodeError, UnicodeDecodeError):
                self.refused += 1
                continue
            self._latest = message
            self._queue.append(message)


def leave(session: zenoh.Session) -> None:
    """Close a session of zenoh, which now and then gives up on that after 10 s (its issue 2675).

    Whoever leaves has more to put down than this; the sockets go with the process.
    """
    with contextlib.suppress(zenoh.ZError):
        session.close()


class ZenohBus(Closing):
    """One process's end of the bus."""

    def __init__(self, name: str, folder: Path | str) -> None:
        """Join as `name`, one of `PEERS`.

        Args:
            name: of this process.
            folder: private to the run (mode 0700), with a short path; all processes use the same.

        Raises:
            BusError: if name or folder cannot be used, or zenoh does not open.
        """
        self._readers: list[ZenohSubscription[Any]] = []
        self._writers: dict[str, zenoh.Publisher] = {}
        self._encoder = msgspec.msgpack.Encoder()
        self._session: zenoh.Session | None = None
        socket = socket_path(name, folder)
        if name in LISTENING:
            socket.unlink(missing_ok=True)  # what a killed process of this name left
        try:
            self._session = zenoh.open(_config(name, Path(folder)))
        except zenoh.ZError as error:
            raise BusError(f"the bus did not open at {socket}: {error}") from error

    def publish(self, topic: Topic[M], message: M) -> None:
        """Send to everyone who has subscribed.

        Under congestion a stream's message is dropped, since a newer one follows; an event, which
        comes once (a command), waits for room in the socket.
        """
        writer = self._writers.get(topic.name) or self._declare(topic)
        writer.put(self._encoder.encode(message))

    def subscribe(self, topic: Topic[M]) -> ZenohSubscription[M]:
        """Read a topic from now on."""
        channel: zenoh.handlers.RingChannel[zenoh.Sample] = zenoh.handlers.RingChannel(topic.queue)
        samples = self._opened().declare_subscriber(topic.name, channel)
        reader: ZenohSubscription[M] = ZenohSubscription(samples, topic)
        self._readers.append(reader)
        return reader

    def close(self) -> None:
        """Leave the bus; subscriptions keep what they have. What zenoh makes of it stops nobody."""
        if self._session is None:
            return
        for reader in self._readers:
            reader.close()
        session, self._session = self._session, None
        self._writers.clear()
        leave(session)

    def _declare(self, topic: Topic[Any]) -> zenoh.Publisher:
        """A publisher: commands and states go before images."""
        urgent = topic.rate_hz is None or topic.rate_hz > 20.0
        writer = self._opened().declare_publisher(
            topic.name,
            congestion_control=(
                zenoh.CongestionControl.BLOCK
                if topic.rate_hz is None
                else zenoh.CongestionControl.DROP
            ),
            priority=zenoh.Priority.INTERACTIVE_HIGH if urgent else zenoh.Priority.DATA,
            express=urgent,
        )
        self._writers[topic.name] = writer
        return writer

    def _opened(self) -> zenoh.Session:
        if self._session is None:
            raise BusError("the bus is closed")
        return self._session


def socket_path(name: str, folder: Path | str) -> Path:
    """Where a process listens.

    Raises:
        BusError: for an unknown name, or a path longer than a unix socket may have.
    """
    if name not in PEERS:
        raise BusError(f"no process {name!r} on the bus; there are {', '.join(PEERS)}")
    path = Path(folder) / f"{name}.sock"
    if len(str(path).encode()) > MAX_PATH_BYTES:
        raise BusError(f"the path {path} is too long for a socket; choose a shorter folder")
    return path


def _config(name: str, folder: Path) -> zenoh.Config:
    """Peer mode, unix sockets only, no scouting of any kind, join without waiting for anyone."""
    earlier = [one for one in PEERS[: PEERS.index(name)] if one in LISTENING]
    own = [f"unixsock-stream/{socket_path(name, folder)}"] if name in LISTENING else []
    settings: dict[str, Any] = {
        "mode": "peer",
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "scouting/delay": 0,
        "open/return_conditions": {"connect_scouted": False, "declares": False},
        "listen/endpoints": own,
        "connect/endpoints": [f"unixsock-stream/{socket_path(one, folder)}" for one in earlier],
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "connect/retry": RETRY,
        # Its segments would lie beside the private folder, 16 MB a process, left behind by a kill;
        # where /dev/shm cannot be written it would not open at all. It saves no time here:
        # a depth image took 448 µs with it (`benchmarks.transport`, median) and 430 µs without.
        "transport/shared_memory/enabled": False,
    }
    config = zenoh.Config()
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))
    return config
