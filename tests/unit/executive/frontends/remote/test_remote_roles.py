"""Everybody may stop; nobody undoes an emergency stop from afar; a role may what it says."""

from __future__ import annotations

from typing import get_args

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.frontends.remote import wire
from executive.frontends.remote.invitation import ROLES, Role
from executive.frontends.service import messages as m

STOPS = (
    m.Press(button="stop"), m.Press(button="estop"), m.Press(button="pause"), m.Halt(text="wait"),
    m.Say(text="stop"), m.Say(text="STOP!!"), m.Say(text="estop"), m.Say(text="freeze"),
)  # fmt: skip
FOR_NOBODY = (
    m.Press(button="release"), m.Press(button="reset"), m.Down(), m.Say(text="estop reset"),
    m.Say(text=" eStop   RELEASE"), m.Say(text="e-stop\treset"), m.Say(text="es\u200btop reset"),
    m.Say(text="estop\x1b[31m reset"), m.Say(text="\x1b[31mestop reset"), m.Say(text="éstop reset"),
    m.Say(text="ｅｓｔｏｐ release"), m.Say(text="estop réset"), m.Say(text="\u0435stop reset"),
)  # fmt: skip
ORDERS = (
    m.Say(text="go to the table"), m.Say(text="resume"), m.Press(button="resume"),
    m.Press(button="cancel"), m.Drive(forward_m_s=0.1),
)  # fmt: skip
LOOKS = (m.Queue(), m.Watch(views=True), m.Await(jobs=(1,)))


def may(role: Role) -> set[m.Request]:
    asked = (*STOPS, *FOR_NOBODY, *ORDERS, *LOOKS, m.Status())
    return {one for one in asked if not wire.refusal(role, wire.asked_by(role, one))}


def test_roles_may_what_they_say_and_no_more():
    assert set(get_args(Role)) == set(ROLES)
    assert may("stop") == {*STOPS, m.Status()}
    assert may("watch") == {*STOPS, *LOOKS, m.Status()}
    assert may("command") == {*STOPS, *LOOKS, *ORDERS, m.Status()}


@pytest.mark.parametrize("role", ["watch", "stop"])
@pytest.mark.parametrize(
    "text",
    [*(one.text for one in STOPS if isinstance(one, m.Say)), "walk to the table and stop",
     "stop after two seconds", "estop, and walk to the table", "e stop walk to the table"],
)  # fmt: skip
def test_who_may_only_stop_presses_a_button_whatever_else_is_in_the_line(role, text):
    """What is a cry to a robot at work may be an errand to one at rest."""
    asked = wire.asked_by(role, m.Say(text=text, number=3))
    assert isinstance(asked, m.Press)
    assert asked.button in ("stop", "estop")
    assert asked.number == 3
    assert wire.asked_by("command", m.Say(text=text)) == m.Say(text=text)


@pytest.mark.parametrize("role", ["watch", "stop"])
@pytest.mark.parametrize("text", ["es, topple: walk to the table", "yes", "release", "resume"])
def test_who_may_only_stop_says_nothing_else(role, text):
    assert wire.refusal(role, wire.asked_by(role, m.Say(text=text)))


def test_every_request_is_thought_of():
    kinds = {type(one) for one in (*STOPS, *FOR_NOBODY, *ORDERS, *LOOKS, m.Status())}
    assert kinds == set(get_args(m.Request))


@pytest.mark.parametrize("asked", [wire.Beat(), wire.Bye(), m.Status(number=3), *STOPS])
def test_lines_over_the_link_are_what_they_were(asked):
    assert wire.line(msgspec.json.encode(asked)) == asked


ways_s = st.lists(st.floats(0.0, 5.0), min_size=1, max_size=20)


@given(ahead_s=st.floats(-1e6, 1e6), ways_s=ways_s, before_s=st.floats(0.0, 3.0))
def test_the_robots_clock_is_never_ahead_and_right_from_when_it_was_told(ahead_s, ways_s, before_s):
    clock, here_s = wire.RobotClock(), 2e6
    assert clock.at(here_s) == 0.0
    for way_s in ways_s:
        there_s = here_s + ahead_s
        here_s += way_s
        clock.hear(there_s, here_s)
        # Whatever comes after word of `there_s`, is after that; what was before, before.
        assert clock.at(here_s) >= there_s - 1e-6
        for then_s in (here_s, here_s - before_s):
            assert clock.at(then_s) <= then_s + ahead_s + 1e-6
        asked = m.Say(text="wave", begun_s=here_s - before_s)
        came = wire.line(wire.sent(m.line_of(asked), clock))
        assert came.begun_s == clock.at(asked.begun_s)
        assert wire.arrived(came, here_s + ahead_s + 1.0).begun_s == came.begun_s


def test_a_clock_that_runs_slower_is_followed():
    clock = wire.RobotClock()
    for k in range(1000):
        clock.hear(5e6 + 0.1 * k * 0.9995, 0.1 * k)
    assert clock.at(100.0) <= 5e6 + 100.0 * 0.9995 + 1e-3


@pytest.mark.parametrize("data", [b'{"tell":"words","text":"x"}\n', b'{"tell":"beat"}\n', b"[\n"])
def test_what_tells_no_time_is_no_echo(data):
    assert wire.echoed_s(data) is None
    assert wire.echoed_s(wire.echo(7.5)) == 7.5


def test_a_clock_that_comes_over_the_link_is_none_of_this_machine():
    assert wire.arrived(m.Say(text="wave", begun_s=1e9), 50.0).begun_s == 50.0
    assert wire.arrived(m.Say(text="wave"), 50.0).afar
    assert wire.arrived(m.Status(number=1), 50.0) == m.Status(number=1)
    assert wire.sent(b"nonsense\n", wire.RobotClock()) == b"nonsense\n"


@pytest.mark.parametrize("data", [b"", b"{}", b'{"ask":"beat","x":1}', b"[" * 5000, b'"\xff"'])
def test_other_lines_are_none(data):
    with pytest.raises((msgspec.DecodeError, RecursionError)):
        wire.line(data)


def test_a_terminal_passes_over_what_answers_a_beat():
    with pytest.raises(msgspec.DecodeError):
        m.told(wire.echo(1.0))
