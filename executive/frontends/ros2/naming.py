"""What things are called on the wire, as rmw_zenoh has it: keys, liveliness tokens, attachments.

Source: docs/design.md of github.com/ros2/rmw_zenoh, branch jazzy, and what its code makes of it.

    0/chatter/std_msgs::msg::dds_::String_/RIHS01_...                   where a topic's samples go
    @ros2_lv/0/ZID/0/0/NN/%/%/talker                                    there is a node
    @ros2_lv/0/ZID/0/1/MP/%/%/talker/%chatter/TYPE/RIHS01_.../::,7:,:,:,,   that publishes a topic
"""

from __future__ import annotations

import struct
from typing import Literal, NamedTuple

import xxhash

from executive.frontends.ros2.type_hash import type_hash

SPACE = "@ros2_lv"
Role = Literal["MP", "MS", "SS"]
"""Of an endpoint: it publishes messages, subscribes to them, or serves a service."""
DEFAULT_DEPTH = 42
"""rmw_zenoh's own; a quality of service tells only what differs from its defaults."""
_ATTACHED = struct.Struct("<qqB16s")
GID_BYTES = 16


class Qos(NamedTuple):
    """Quality of service: whether all is delivered, also what was said before; how many kept."""

    reliable: bool = True
    transient_local: bool = False
    depth: int = 10

    @property
    def text(self) -> str:
        """RELIABILITY:DURABILITY:HISTORY,DEPTH:DEADLINE:LIFESPAN:LIVELINESS; defaults are empty."""
        reliability = "" if self.reliable else "2"
        durability = "1" if self.transient_local else ""
        depth = "" if self.depth == DEFAULT_DEPTH else str(self.depth)
        return f"{reliability}:{durability}:,{depth}:,:,:,,"


class Node(NamedTuple):
    """A node: its domain, the hexadecimal id of its zenoh session, its namespace, its name."""

    domain: int
    session: str
    namespace: str
    name: str

    @property
    def token(self) -> str:
        """Its liveliness token."""
        head = f"{SPACE}/{self.domain}/{self.session}/0/0/NN"
        return f"{head}/%/{_mangled(self.namespace or '/')}/{self.name}"

    def topic(self, name: str) -> str:
        """A topic's full name: in this node's namespace."""
        return f"{self.namespace}/{name}"


class Endpoint(NamedTuple):
    """A publisher, a subscription or a service of a node; `number` is its own, from 1."""

    node: Node
    number: int
    role: Role
    topic: str
    interface: str
    qos: Qos

    @property
    def key(self) -> str:
        """Where its samples or requests go."""
        name = self.topic.strip("/")
        return f"{self.node.domain}/{name}/{dds_name(self.interface)}/{type_hash(self.interface)}"

    @property
    def token(self) -> str:
        """Its liveliness token."""
        node = self.node
        head = f"{SPACE}/{node.domain}/{node.session}/0/{self.number}/{self.role}"
        whose = f"%/{_mangled(node.namespace or '/')}/{node.name}"
        kind = f"{dds_name(self.interface)}/{type_hash(self.interface)}"
        return f"{head}/{whose}/{_mangled(self.topic)}/{kind}/{self.qos.text}"

    @property
    def gid(self) -> bytes:
        """Its id for others: XXH3-128 of the token, the low half first."""
        return xxhash.xxh3_128_digest(self.token.encode())[::-1]


class Attachment(NamedTuple):
    """What goes with a sample: its number from 1, when it was sent [ns since 1970], by whom.

    An answer has the number and the sender of what it answers.
    """

    sequence: int
    stamp_ns: int
    gid: bytes

    @property
    def data(self) -> bytes:
        """As bytes: two 64-bit numbers, and the id behind its length."""
        return _ATTACHED.pack(self.sequence, self.stamp_ns, GID_BYTES, self.gid)

    @staticmethod
    def read(data: bytes) -> Attachment | None:
        """What bytes say; None where they are none."""
        if len(data) != _ATTACHED.size:
            return None
        sequence, stamp_ns, length, gid = _ATTACHED.unpack(data)
        return Attachment(sequence, stamp_ns, gid) if length == GID_BYTES else None


def dds_name(interface: str) -> str:
    """What DDS calls "std_msgs/msg/String": std_msgs::msg::dds_::String_."""
    package, kind, name = interface.split("/")
    return f"{package}::{kind}::dds_::{name}_"


def _mangled(name: str) -> str:
    """A name that is one part of a key."""
    return name.replace("/", "%")
