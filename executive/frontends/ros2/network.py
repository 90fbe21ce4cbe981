"""A node among ROS 2 machines: topics and services over zenoh, as rmw_zenoh has them.

It is a client of one router and listens nowhere. What is published for a peer that does not take it
is dropped, newest last; what comes is kept, so many of each, the newest; nothing of it waits.
"""

# pyright: basic

from __future__ import annotations

import json
import time
from collections.abc import Callable
from typing import Any

import zenoh
from zenoh.ext import CacheConfig, MissDetectionConfig, declare_advanced_publisher

from executive.frontends.ros2.cdr import encode
from executive.frontends.ros2.naming import Attachment, Endpoint, Node, Qos
from robot.bus.zenoh_bus import leave
from robot.closing import Closing
from robot.errors import BusError

HEARTBEAT_S = 0.5
"""As rmw_zenoh has it, of what late subscribers are to have."""
RETRY = {"period_init_ms": 500, "period_max_ms": 4000, "period_increase_factor": 2.0}
MOST_BYTES = 1 << 20
"""Of a sample that comes; a sentence or a velocity is far less."""


class Publisher:
    """One topic; made by `Network.publisher`, used by one thread."""

    def __init__(self, endpoint: Endpoint, writer: Any, token: Any, *, kept: bool) -> None:
        self.endpoint = endpoint
        self._writer = writer
        self._token = token  # it is told of as long as this lives
        self._kept = kept
        self._count = 0
        self._gid = endpoint.gid

    @property
    def wanted(self) -> bool:
        """Whether anybody has subscribed, or may later to what is kept for them."""
        return self._kept or bool(self._writer.matching_status.matching)

    def publish(self, message: dict[str, Any]) -> None:
        """Send to everyone who has subscribed; never waits for them."""
        self._count += 1
        attachment = Attachment(self._count, time.time_ns(), self._gid).data
        self._writer.put(encode(self.endpoint.interface, message), attachment=attachment)


class Request:
    """What somebody asks of a service; it ends without an answer when it is forgotten."""

    def __init__(self, query: Any, endpoint: Endpoint, asked: Attachment) -> None:
        self._query, self._endpoint, self._asked = query, endpoint, asked

    @property
    def data(self) -> bytes:
        """What is asked, as CDR; of one that is far too large nothing."""
        payload = self._query.payload
        return b"" if payload is None or len(payload) > MOST_BYTES else payload.to_bytes()

    def answer(self, response: dict[str, Any]) -> None:
        """Say so, once."""
        endpoint = self._endpoint
        data = encode(f"{endpoint.interface}_Response", response)
        attachment = self._asked._replace(stamp_ns=time.time_ns()).data
        self._query.reply(endpoint.key, data, attachment=attachment)
        self._query.drop()


class Network(Closing):
    """A context manager: a node as long as it is open."""

    def __init__(
        self, router: str, *, domain: int, namespace: str = "", name: str = "humanoid"
    ) -> None:
        """Become a node; the router is looked for as long as it takes, also after it was gone.

        Args:
            router: endpoint of zenoh, "tcp/HOST:PORT".
            domain: ROS_DOMAIN_ID of those who are to see it.
            namespace: of its topics, "" or "/kitchen".
            name: of the node.

        Raises:
            BusError: if zenoh does not open.
        """
        try:
            self._session = zenoh.open(_config(router))
        except zenoh.ZError as error:
            raise BusError(f"zenoh did not open for {router}: {error}") from error
        self.node = Node(domain, str(self._session.zid()), namespace, name)
        self._token = self._session.liveliness().declare_token(self.node.token)
        self._number = 0
        self._subscriptions: list[Any] = []

    @property
    def connected(self) -> bool:
        """Whether there is a router."""
        return bool(list(self._session.info.routers_zid()))

    def publisher(self, topic: str, interface: str, qos: Qos) -> Publisher:
        """Publish a topic of this node's namespace from now on."""
        endpoint = self._endpoint("MP", topic, interface, qos)
        reliability = zenoh.Reliability.RELIABLE if qos.reliable else zenoh.Reliability.BEST_EFFORT
        how: dict[str, Any] = {
            "congestion_control": zenoh.CongestionControl.DROP,
            "reliability": reliability,
        }
        if qos.transient_local:
            writer: Any = declare_advanced_publisher(
                self._session,
                endpoint.key,
                cache=CacheConfig(max_samples=qos.depth),
                sample_miss_detection=MissDetectionConfig(
                    heartbeat=None, sporadic_heartbeat=HEARTBEAT_S
                ),
                publisher_detection=True,
                **how,
            )
        else:
            writer = self._session.declare_publisher(endpoint.key, **how)
        return Publisher(endpoint, writer, self._tell_of(endpoint), kept=qos.transient_local)

    def subscription(self, topic: str, interface: str, qos: Qos) -> Callable[[], bytes | None]:
        """Read a topic of this node's namespace from now on; `qos` says how many are kept.

        Returns:
            What gives the oldest sample that has not been given, None where there is none; one
            that is far too large is empty.
        """
        endpoint = self._endpoint("MS", topic, interface, qos)
        reader = self._read(endpoint, endpoint.key)

        def take() -> bytes | None:
            sample = reader.try_recv()
            if sample is None:
                return None
            payload = sample.payload
            return b"" if len(payload) > MOST_BYTES else payload.to_bytes()

        return take

    def waiting(self, topic: str, interface: str, qos: Qos) -> Callable[[], bool]:
        """Wait for samples of a topic, of whatever kind and whatever they hold.

        Returns:
            What waits for the next one: True when it came, False when the network is closed.
        """
        endpoint = self._endpoint("MS", topic, interface, qos)
        name = f"{self.node.domain}/{endpoint.topic.strip('/')}"
        reader = self._read(endpoint, f"{name}/*/*")

        def wait() -> bool:
            try:
                reader.recv()
            except zenoh.ZError:
                return False
            return True

        return wait

    def service(self, name: str, interface: str, qos: Qos) -> Callable[[], Request | None]:
        """Serve in this node's namespace from now on; of those who ask so many wait, the newest.

        Returns:
            What gives the oldest request that has not been given, None where there is none. One
            that does not say who asks is no request.
        """
        endpoint = self._endpoint("SS", name, interface, qos)
        waiting = zenoh.handlers.RingChannel(endpoint.qos.depth)
        # rmw_zenoh asks those alone that say they are complete.
        reader = self._session.declare_queryable(endpoint.key, waiting, complete=True)
        self._subscriptions.append((reader, self._tell_of(endpoint)))

        def take() -> Request | None:
            while (query := reader.try_recv()) is not None:
                attached = query.attachment
                asked = None if attached is None else Attachment.read(attached.to_bytes())
                if asked is not None:
                    return Request(query, endpoint, asked)
            return None

        return take

    def _read(self, endpoint: Endpoint, key: str) -> Any:
        kept = zenoh.handlers.RingChannel(endpoint.qos.depth)
        reader = self._session.declare_subscriber(key, kept)
        self._subscriptions.append((reader, self._tell_of(endpoint)))
        return reader

    def close(self) -> None:
        """Be gone."""
        if not self._session.is_closed():
            leave(self._session)

    def _endpoint(self, role: Any, topic: str, interface: str, qos: Qos) -> Endpoint:
        self._number += 1
        return Endpoint(self.node, self._number, role, self.node.topic(topic), interface, qos)

    def _tell_of(self, endpoint: Endpoint) -> Any:
        return self._session.liveliness().declare_token(endpoint.token)


def _config(router: str) -> zenoh.Config:
    """A client of that router alone: no listening, no scouting."""
    settings: dict[str, Any] = {
        "mode": "client",
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "connect/endpoints": [router],
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "connect/retry": RETRY,
        "listen/endpoints": [],
        "timestamping/enabled": True,  # what is kept for late subscribers needs it
        "transport/shared_memory/enabled": False,
    }
    config = zenoh.Config()
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))
    return config
