"""A ROS 2 machine of tests: plain zenoh and rosbags, which share no line with what they look at.

It finds topics by their liveliness tokens alone, subscribes to the keys that these tell of, and
reads and writes with rosbags' own definitions. It stands for rmw_zenoh; it is not rmw_zenoh.
"""

from __future__ import annotations

import json
import socket
import struct
import threading
import time
from collections import deque
from contextlib import contextmanager

import zenoh
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from zenoh.ext import HistoryConfig, RecoveryConfig, declare_advanced_subscriber

from tests.fakes.waiting import HANG_S

STORE = get_typestore(Stores.ROS2_JAZZY)
EMPTY = "std_msgs/msg/Empty"
ASK, ANSWER = "nav_msgs/msg/GetPlan_Request", "nav_msgs/msg/GetPlan_Response"
"""As nav_msgs/srv/GetPlan.srv has them."""
STORE.register(
    get_types_from_msg(
        "geometry_msgs/PoseStamped start\ngeometry_msgs/PoseStamped goal\nfloat32 tolerance", ASK
    )
)
STORE.register(get_types_from_msg("nav_msgs/Path plan", ANSWER))


def _config(mode, *, listen=(), connect=()):
    """As DEFAULT_RMW_ZENOH_SESSION_CONFIG and ROUTER_CONFIG have it, on a port of the test's."""
    config = zenoh.Config()
    for key, value in {
        "mode": mode,
        "listen/endpoints": list(listen),
        "connect/endpoints": list(connect),
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": True,
        "timestamping/enabled": True,
    }.items():
        config.insert_json5(key, json.dumps(value))
    return config


def free_endpoint():
    with socket.create_server(("127.0.0.1", 0)) as listening:
        return f"tcp/127.0.0.1:{listening.getsockname()[1]}"


def router(endpoint):
    """A zenoh router, as `rmw_zenohd` is one."""
    return zenoh.open(_config("router", listen=[endpoint]))


class Token:
    """What a liveliness token of an endpoint tells; the grammar is written anew here."""

    def __init__(self, text):
        parts = text.split("/")
        assert parts[0] == "@ros2_lv", text
        self.text = text
        self.domain, self.session, self.role = parts[1], parts[2], parts[5]
        self.node = parts[8]
        if self.role != "NN":
            assert len(parts) == 13 and all(parts), text
            self.topic = parts[9].replace("%", "/")
            self.kind, self.hash, self.qos = parts[10:]
            package, what, _, name = self.kind.split("::")
            self.interface = f"{package}/{what}/{name.removesuffix('_')}"
            self.key = f"{self.domain}{self.topic}/{self.kind}/{self.hash}"
            reliability, durability, *_ = self.qos.split(":")
            self.transient_local = durability == "1"
            self.reliable = reliability == ""


class Peer:
    """A session on the other machine."""

    def __init__(self, endpoint, domain):
        self._session = zenoh.open(_config("peer", listen=["tcp/127.0.0.1:0"], connect=[endpoint]))
        self.domain = domain
        self._kept = []

    def close(self):
        self._session.close()

    def tokens(self):
        """Everything that there is, as a new node asks for it."""
        replies = self._session.liveliness().get(f"@ros2_lv/{self.domain}/**", timeout=5.0)
        found = [Token(str(reply.ok.key_expr)) for reply in replies if reply.ok]
        return {one.node if one.role == "NN" else f"{one.role} {one.topic}": one for one in found}

    def subscribe(self, token, most=500):
        """The messages of a publisher from now on; of one that keeps some, those as well."""
        inbox = Inbox(token, most)
        if token.transient_local:
            reader = declare_advanced_subscriber(
                self._session, token.key, inbox.take,
                history=HistoryConfig(detect_late_publishers=True, max_samples=1),
                recovery=RecoveryConfig(heartbeat=True), subscriber_detection=True,
            )  # fmt: skip
        else:
            reader = self._session.declare_subscriber(token.key, inbox.take)
        self._kept.append(reader)
        return inbox

    def send(self, topic, interface, message, *, hash_=None, count=1):
        """Publish as a node of rmw_zenoh does; bytes are sent as they are."""
        package, _, name = interface.split("/")
        kind = f"{package}::msg::dds_::{name}_"
        key = f"{self.domain}/{topic}/{kind}/{hash_ or STORE.hash_rihs01(interface)}"
        data = message if isinstance(message, bytes) else written(interface, message)
        for number in range(count):
            attachment = struct.pack("<qqB", number + 1, time.time_ns(), 16) + bytes(16)
            self._session.put(key, data, attachment=attachment)

    def ask(self, token, request, *, number=1, attached=True, within_s=HANG_S):
        """Ask a service as a node of rmw_zenoh does; the channel of what is answered."""
        data = request if isinstance(request, bytes) else written(ASK, request)
        attachment = struct.pack("<qqB", number, time.time_ns(), 16) + bytes(range(16))
        return self._session.get(
            token.key, payload=data, attachment=attachment if attached else None,
            target=zenoh.QueryTarget.ALL_COMPLETE, consolidation=zenoh.ConsolidationMode.NONE,
            timeout=within_s,
        )  # fmt: skip

    def twist(self, forward=0.0, left=0.0, turn=0.0):
        vector, twist = STORE.types["geometry_msgs/msg/Vector3"], "geometry_msgs/msg/Twist"
        self.send(
            "cmd_vel", twist,
            STORE.types[twist](vector(forward, left, 0.0), vector(0.0, 0.0, turn)),
        )  # fmt: skip

    def say(self, text):
        self.send("task/goal", "std_msgs/msg/String", STORE.types["std_msgs/msg/String"](text))


def written(interface, message):
    return bytes(STORE.serialize_cdr(message, interface))


class Inbox:
    """What came of a topic, read by rosbags, the newest last."""

    def __init__(self, token, most):
        self.token = token
        self.messages = deque(maxlen=most)
        self.attachments = deque(maxlen=most)
        self.count = 0
        self._came = threading.Condition()

    def take(self, sample):
        message = STORE.deserialize_cdr(sample.payload.to_bytes(), self.token.interface)
        with self._came:
            self.count += 1
            self.messages.append(message)
            self.attachments.append(sample.attachment.to_bytes())
            self._came.notify_all()

    def wait(self, is_it=lambda _: True, *, within_s):
        """The first message from now on, the newest included, that is what is waited for."""
        until_s = time.monotonic() + within_s
        with self._came:
            while True:
                for message in reversed(self.messages):
                    if is_it(message):
                        return message
                    break
                assert self._came.wait(until_s - time.monotonic()), f"{self.token.topic}: nothing"


@contextmanager
def machines(endpoint, *, domain):
    """A router, and a peer that found it."""
    routing = router(endpoint)
    peer = Peer(endpoint, domain)
    try:
        yield peer
    finally:
        peer.close()
        routing.close()
