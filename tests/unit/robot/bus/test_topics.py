from typing import get_args

import msgspec
import pytest

from robot.bus import topics
from robot.bus.zenoh_bus import PEERS
from robot.errors import BusError
from robot.messages import Message


def test_names_are_unique_and_found():
    assert len(topics.BY_NAME) == len(topics.TOPICS)
    for topic in topics.TOPICS:
        assert topics.named(topic.name) is topic


def test_an_unknown_name_is_an_error_that_lists_the_table():
    with pytest.raises(BusError, match="body/state"):
        topics.named("body/stat")


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
    for topic in topics.TOPICS:
        if topic.source == "plant" and topic is not topics.PLANT_TIMING:
            assert "source" in topic.kind.__struct_fields__
            assert topic.name.startswith(("sensors/", "oracle/", "power/"))
