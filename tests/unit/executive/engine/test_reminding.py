"""A controller that takes over is told what the hands carry; it cannot know."""

import pytest

from executive.engine.reminder import Reminder
from executive.skills.holding import Held, Holdings
from robot.messages import Payload
from robot.se3 import SE3
from tests.fakes.stage import Stage

CUP = Held(object_id="cup", side="right", X_GO=SE3(), gap_m=0.07, mass_kg=0.2, carry_rad=(0.0,) * 7)


@pytest.fixture
def puppet():
    return Stage().puppet


@pytest.fixture
def look(puppet):
    """Looks at the body as it is now; what was sent."""
    holdings = Holdings()
    reminder = Reminder(puppet, holdings)

    def look(*, since_s: float = 0.0, held: Held | None = None) -> list[tuple[str, float]]:
        puppet.since_s = since_s
        if held is not None:
            holdings.take(held)
        puppet.sent.clear()
        reminder.look(puppet.body(), puppet.time_s)
        assert all(isinstance(one, Payload) for one in puppet.sent)
        return [(one.side, one.mass_kg) for one in puppet.sent]

    return look


def test_nothing_is_said_while_the_same_controller_reports(look):
    assert look() == []
    assert look(held=CUP) == []


def test_the_next_controller_is_told_once(look):
    look(held=CUP)
    assert look(since_s=4.0) == [("right", 0.2)]
    assert look(since_s=4.0) == []


def test_empty_hands_are_not_spoken_of(look):
    look()
    assert look(since_s=4.0) == []


def test_an_executive_that_goes_on_tells_it_too(look):
    """Its holdings come from the journal; the controller may have been replaced meanwhile."""
    assert look(since_s=4.0, held=CUP) == [("right", 0.2)]


def test_a_body_that_does_not_report_is_waited_for(puppet):
    Reminder(puppet, Holdings()).look(None, 0.0)
    assert puppet.sent == []
