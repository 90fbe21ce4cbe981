"""Who says "emergency stop" aloud presses it, as who types it does."""

from types import SimpleNamespace

import pytest

from executive.frontends.listening.obeying import Conversation
from tests.fakes.steered import Told


@pytest.mark.parametrize(
    ("text", "did"),
    [("emergency stop", ["estop"]), ("e stop", ["estop"]), ("stop", ["stop"])],
)
def test_an_emergency_stop_that_is_heard_latches(text, did):
    told = Told()
    shell = SimpleNamespace(
        brake=SimpleNamespace(is_cry=lambda _: True, stop=told.stop, stops=0),
        asks=False,
        stop_at_once=lambda _: told.stop_at_once("estop"),
    )
    heard = Conversation.__new__(Conversation)  # no microphone is opened
    heard._shell, heard._stops = shell, 0
    heard._ear = SimpleNamespace(replying=False)
    heard.take(SimpleNamespace(kind="stop", text=text))
    assert told.did == did
