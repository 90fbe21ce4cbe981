from typing import get_args

import msgspec
import pytest

from robot.bus import topics
from robot.bus.zenoh_bus import PEERS
from robot.drivers.registry import SENSES
from robot.messages import Message


def test_names_are_unique():
    assert len(topics.BY_NAME) == len(topics.TOPICS)


@pytest.mark.parametrize("topic", topics.TOPICS, ids=lambda topic: topic.name)
def test_every_topic_carries_stamped_messages_from_a_process_of_the_bus(topic):
    for kind in get_args(topic.kind) or (topic.kind,):
        assert issubclass(kind, Message)
    msgspec.msgpack.Decoder(topic.kind)
    assert topic.source in PEERS
    assert topic.queue > 0
    assert topic.rate_hz is None or topic.rate_hz > 0.0


def test_what_is_not_sensed_says_so():
    """Whatever the simulation sends in a sensor's place names its source: oracle or emulated."""
    sensed = [sense.topic for sense in SENSES]
    for topic in topics.TOPICS:
        if topic in sensed or (topic.source == "plant" and topic is not topics.PLANT_TIMING):
            assert "source" in topic.kind.__struct_fields__
            assert topic.name.startswith(("sensors/", "power/") if topic in sensed else "oracle/")


def test_what_is_missed_has_a_rate():
    for topic in topics.TOPICS:
        assert topic.silence is None or topic.rate_hz
