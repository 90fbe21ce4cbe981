"""A robot is said to be up when it takes orders, and not when it can only be reached."""

import pytest
from msgspec.structs import replace

from executive.frontends.prompt.view import View
from executive.frontends.service.readiness import PATIENCE_S, Announcement, is_ready
from executive.health import Level

STANDS = View(mode="stand")
WAITS = replace(STANDS, level=Level.HOLD, unwell="waiting for world/state")


class Start:
    """A robot that starts, and what is said of it."""

    def __init__(self, *, fast: bool = False) -> None:
        self.view, self.now_s = View(), 5.0
        self.said, self.ready = list[str](), 0
        self.announcement = Announcement(
            "kitchen", "kitchen is up", fast=fast, view=lambda: self.view,
            now_s=lambda: self.now_s, out=self.said.append, ready=self.count,
        )  # fmt: skip

    def count(self) -> None:
        self.ready += 1

    def at(self, after_s: float, view: View) -> list[str]:
        self.now_s, self.view = 5.0 + after_s, view
        self.announcement.look()
        told, self.said[:] = self.said[:], []
        return told


STARTING = "kitchen is starting: it takes orders when it stands."


def test_it_is_starting_until_it_stands_and_nothing_holds_it():
    start = Start()
    assert start.at(0.1, View()) == [STARTING]
    assert start.at(1.0, WAITS) == []
    assert (start.ready, start.announcement.made) == (0, False)
    assert start.at(2.0, STANDS) == ["kitchen is up"]
    assert start.at(3.0, WAITS) == start.at(4.0, STANDS) == []
    assert start.ready == 1


def test_a_fast_robot_is_up_at_once_as_its_time_passes_with_its_orders():
    start = Start(fast=True)
    assert start.said == ["kitchen is up"]
    assert start.ready == 1


def test_whoever_waits_is_told_why_it_takes_no_orders_and_again_when_it_does():
    start = Start()
    start.at(1.0, WAITS)
    assert start.at(PATIENCE_S, WAITS) == [
        "kitchen can be reached, but takes no orders: waiting for world/state."
    ]
    assert start.at(PATIENCE_S + 1.0, WAITS) == []
    assert start.at(PATIENCE_S + 2.0, STANDS) == ["kitchen is up"]
    assert start.ready == 1  # a service manager is not kept waiting for ever


def test_one_that_lies_is_not_waited_for():
    start = Start()
    told = start.at(1.0, View(mode="fallen"))
    assert told[1:] == [
        "kitchen can be reached, but takes no orders: it lies on the floor (“get up” has it try)."
    ]
    assert start.ready == 1


@pytest.mark.parametrize(
    ("view", "ready"),
    [
        (STANDS, True), (replace(STANDS, mode="walk"), True),
        (replace(STANDS, level=Level.DERATE), True), (WAITS, False), (View(), False),
        (View(mode="fallen"), False), (View(mode="gone"), False),
    ],
)  # fmt: skip
def test_it_takes_orders_where_it_would_begin_them(view: View, ready: bool):
    assert is_ready(view, fast=False) is ready
