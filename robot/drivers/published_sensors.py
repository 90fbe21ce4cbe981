"""The sensors that one process opens, and publishes."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any, Self

from robot.bus import topics
from robot.bus.topics import Topic
from robot.closing import Closing
from robot.drivers.registry import SENSES
from robot.drivers.sensor_source import SensorSource
from robot.drivers.wiring import Wiring
from robot.messages import Message


class PublishedSensors(Closing):
    """Every sensor of this robot whose topic has this process as its source."""

    def __init__(self, wiring: Wiring, process: topics.Process) -> None:
        """Make their drivers, of the description's names; nothing is opened.

        Raises:
            ConfigError: if the description names a driver that there is not.
        """
        self._bus = wiring.bus
        self._sources: list[tuple[Topic[Any], SensorSource[Message, object]]] = [
            (sense.topic, sense.make(wiring))
            for sense in SENSES
            if sense.topic.source == process and sense.is_there(wiring.robot)
        ]
        self._opened = ExitStack()

    def __enter__(self) -> Self:
        """Open them. Raises DriverError if one is not there."""
        with ExitStack() as stack:
            for _, source in self._sources:
                stack.enter_context(source)
            self._opened = stack.pop_all()
        return self

    def relay(self) -> list[Message]:
        """Read them all, and publish what came. Raises DriverError if one went away."""
        came: list[Message] = []
        for topic, source in self._sources:
            for message in source.read():
                self._bus.publish(topic, message)
                came.append(message)
        return came

    def close(self) -> None:
        """Let go of them."""
        self._opened.close()
