"""What comes again and again is told once, and once more when it is over."""

from executive.frontends.progress import sentence
from executive.frontends.recurring import AGAIN_S, Recurring
from executive.journal.journal import Event

LATE = {"name": "camera", "level": "WARN", "code": "camera_late", "cause": "no picture for 0.5 s"}
WELL = {"name": "camera", "level": "OK"}


def told(*events: tuple[float, str, dict]) -> list[tuple[float, str]]:
    """What people are told of a run, and when."""
    recurring, lines = Recurring(), list[tuple[float, str]]()
    for n, (t_s, kind, data) in enumerate(events):
        event = Event(n, t_s, kind, data)
        lines += [(t_s, text) for text in recurring.news(event, sentence(event))]
    return lines + [(events[-1][0], text) for text in recurring.rest()]


def pose(t_s: float) -> tuple[float, str, dict]:
    return t_s, "pose", {}


def flicker(since_s: float, times: int) -> list[tuple[float, str, dict]]:
    """A camera that is late every second, for half a second."""
    return [
        (since_s + k + part, "health", data)
        for k in range(times)
        for part, data in ((0.0, LATE), (0.5, WELL))
    ]


def test_a_camera_that_is_late_again_and_again_is_told_twice():
    events = [*flicker(1.0, 30), *(pose(31.0 + 0.5 * k) for k in range(20))]
    (first_s, first), (last_s, last) = told(*events)
    assert (first_s, first) == (1.0, "warn: no picture for 0.5 s")
    assert last == "over, after 30 times in 29.5 s: warn: no picture for 0.5 s"
    assert 30.5 + AGAIN_S <= last_s <= 31.0 + AGAIN_S


def test_what_came_once_for_a_moment_is_not_said_to_be_over():
    events = [*flicker(1.0, 1), *(pose(2.0 + k) for k in range(20))]
    assert told(*events) == [(1.0, "warn: no picture for 0.5 s")]


def test_what_lasted_is_said_to_be_over():
    events = [(1.0, "health", LATE), (31.0, "health", WELL), pose(40.0)]
    assert [text for _, text in told(*events)][1:] == [
        "over, after 30.0 s: warn: no picture for 0.5 s"
    ]


def test_what_comes_again_much_later_or_is_worse_or_of_another_is_news():
    worse = LATE | {"level": "HOLD"}
    other = LATE | {"name": "lidar", "cause": "no scan for 0.5 s"}
    events = [
        *flicker(1.0, 1), *flicker(20.0, 1), (21.0, "health", worse), (21.2, "health", other),
    ]  # fmt: skip
    assert [text for _, text in told(*events)] == [
        "warn: no picture for 0.5 s",
        "warn: no picture for 0.5 s",
        "hold: no picture for 0.5 s",
        "warn: no scan for 0.5 s",
    ]


def test_what_changes_while_it_is_there_is_news():
    warmer = LATE | {"cause": "no picture for 3.0 s"}
    assert len(told((1.0, "health", LATE), (4.0, "health", warmer))) == 2


def test_pulls_at_a_hand_are_told_by_hand():
    pulls = [(1.0 + 0.1 * k, "slip", {"side": "left"}) for k in range(12)]
    right = (1.55, "slip", {"side": "right"})
    lines = told(*sorted([*pulls, right], key=lambda one: one[0]), pose(9.0))
    assert [text for _, text in lines] == [
        "the left hand is pulled at and grips harder",
        "the right hand is pulled at and grips harder",
        "over, after 12 times in 1.1 s: the left hand is pulled at and grips harder",
    ]


def test_what_is_not_over_when_nothing_comes_any_more_is_told_then():
    assert [text for _, text in told(*flicker(1.0, 3))][1:] == [
        "over, after 3 times in 2.5 s: warn: no picture for 0.5 s"
    ]
