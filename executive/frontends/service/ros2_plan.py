"""What the bridge's process is told; loads nothing, as every robot that is up does."""

from __future__ import annotations

import msgspec


class Plan(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the process is told on its standard input.

    Attributes:
        router: endpoint of zenoh, "tcp/HOST:PORT".
        domain: ROS_DOMAIN_ID.
        namespace: of the topics, "" for none.
        sockets: folder of the robot's own bus.
        name, place: of the robot that is up, by which orders reach it.
        robot: its description.
        pictures: whether its camera is looked through.
    """

    router: str
    domain: int
    namespace: str
    sockets: str
    name: str
    place: str
    robot: str
    pictures: bool


def namespace_of(name: str) -> str:
    """A robot's name as a namespace of ROS: letters, digits and underscores, no digit first."""
    plain = name.replace("-", "_")
    return f"/{plain}" if not plain[:1].isdigit() else f"/_{plain}"
