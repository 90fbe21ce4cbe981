"""Who opens which device, as a table for `docs/drivers.md`, made of the registry of drivers."""

from __future__ import annotations

from robot.drivers import registry

_UNPUBLISHED = {
    registry.MOTORS.device: ("controller", "`body/state`, as the controller believes it"),
    registry.IMU.device: ("controller", ""),
    registry.FORCE.device: ("controller", ""),
    registry.RGBD.device: (
        "perception, where there is a real one, or with `--camera`",
        "`sensors/rgbd`, `sensors/camera_state`",
    ),
}
"""Of a family without a topic of its own: who opens it, and where one sees what came of it."""


def opened() -> list[list[str]]:
    """A row a device: its name, its drivers, the process that opens it, what is published."""
    topics = {sense.device: sense.topic for sense in registry.SENSES}
    rows: list[list[str]] = []
    for family in registry.FAMILIES:
        drivers = ", ".join(f"`{name}`" for name in family.drivers)
        if (topic := topics.get(family.device)) is not None:
            opener, seen = topic.source, f"`{topic.name}`"
        else:
            opener, seen = _UNPUBLISHED[family.device]
        rows.append([f"`{family.device}`", drivers, opener, seen])
    return rows
