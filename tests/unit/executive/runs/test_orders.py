"""What an executive was told holds for the one that takes over: pauses, emergency stops, breaks."""

from pathlib import Path

import pytest

from executive.journal.journal import Event
from executive.runs.again.continuation import left_in, return_to
from executive.runs.again.orders import Orders, orders_in
from tests.unit.executive.runs.test_left import session, understood  # noqa: F401


def told(*kinds: str | tuple[str, str]) -> list[Event]:
    """Events by name, or ("request", name)."""
    return [
        Event(n, 0.1 * n, "request", {"request": kind[1], "why": "so", "pattern": "pick*"})
        if isinstance(kind, tuple)
        else Event(n, 0.1 * n, kind, {"why": "so"})
        for n, kind in enumerate(kinds)
    ]


PRESS, RELEASE, RESET = (("request", f"{what}_estop") for what in ("press", "release", "reset"))
BREAK, CLEAR = ("request", "break_at"), ("request", "clear_breaks")


@pytest.mark.parametrize(
    ("kinds", "holds"),
    [
        ((), Orders()),
        (("pause",), Orders(paused="so")),
        (("pause", "resume"), Orders()),
        (("pause", "stop"), Orders()),
        (("pause", "resume", "pause"), Orders(paused="so")),
        ((PRESS,), Orders(estop="so", pressed=True)),
        ((PRESS, "stop"), Orders(estop="so", pressed=True)),
        ((PRESS, RELEASE), Orders(estop="so")),
        ((PRESS, RELEASE, RESET), Orders()),
        ((BREAK, BREAK, "stop"), Orders(breaks=("pick*",))),
        ((BREAK, CLEAR), Orders()),
    ],
)
def test_what_holds_is_what_nothing_has_ended(kinds, holds):
    assert orders_in(told(*kinds)) == holds


def taken_over(session):  # noqa: F811
    session.run(until=lambda: session.now_s > 0.4)
    left = left_in(session.setup.folder)
    session.replace_executive(jobs_before=left.jobs)
    return_to(session, left)
    begun_s = session.now_s
    session.run(until=lambda: session.now_s > begun_s + 1.0)
    return session.executive


def test_who_takes_over_a_paused_robot_moves_nothing_until_it_is_told_to(session):  # noqa: F811
    session.submit(understood("go to the table"))
    session.executive.pause("somebody came in")
    second = taken_over(session)
    assert second.state == "paused"
    assert second.pause_wanted
    assert [job.state for job in second.jobs] == ["waiting"]
    second.resume()
    session.run()
    assert [job.state for job in second.jobs] == ["done"]


@pytest.mark.parametrize("released", [True, False])
def test_an_emergency_stop_stays_latched_in_the_one_that_takes_over(session, released):  # noqa: F811
    session.executive.press_estop("somebody shouted")
    if released:
        session.executive.release_estop()
    second = taken_over(session)
    assert (second.estop.why, second.estop.pressed) == ("somebody shouted", not released)
    session.submit(understood("go to the table"))
    session.run()
    assert session.executive.jobs[-1].failure.code == "emergency_stop"


def test_breakpoints_hold_in_the_one_that_takes_over(session, tmp_path: Path):  # noqa: F811
    session.executive.break_at("say*")
    session.submit(understood("say hello, then go to the table"))
    second = taken_over(session)
    assert second.held
    assert not any(event.event == "said" for event in left_in(tmp_path).events)
