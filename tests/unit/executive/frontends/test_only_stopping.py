"""A robot that only walks takes a stop from its page, however it is said, and nothing else."""

from __future__ import annotations

import pytest

from executive.engine.loop import Interrupts
from executive.frontends.only_stopping import NO_ORDERS, OnlyStopping
from executive.frontends.since_boot import now_s


@pytest.fixture
def said():
    return []


@pytest.fixture
def robot(said):
    return OnlyStopping(Interrupts(), said.append)


@pytest.mark.parametrize("text", ["stop", "STOP!", "freeze", "estop", "please stop now"])
def test_every_cry_stops_it(robot, text):
    assert robot.stop_at_once(text)
    assert robot.stops == 1 and robot._interrupts.count == 1


@pytest.mark.parametrize("text", ["wait", "hold on", "careful"])
def test_a_cry_to_halt_stops_it_as_well(robot, text):
    assert not robot.stop_at_once(text)
    assert robot.halt_at_once(text)
    assert robot._interrupts.count == 1


@pytest.mark.parametrize("text", ["go to the table", "why", "estop reset", "inject shove"])
def test_nothing_else_is_done(robot, said, text):
    if not robot.stop_at_once(text) and not robot.halt_at_once(text):
        robot.line(text)
    assert said == [NO_ORDERS]
    assert robot.stops == robot._interrupts.count == 0


def test_the_buttons(robot, said):
    robot.command("resume")
    assert said == [NO_ORDERS]
    robot.command("pause")
    robot.command("cancel")
    assert robot.stops == 2


def test_a_line_from_before_a_stop_is_known(robot):
    before_s = now_s()
    robot.stop("of a test")
    assert robot.stops_by(before_s) == 0
    assert robot.stops_by(None) == robot.stops_by(now_s()) == 1
