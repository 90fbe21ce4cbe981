"""A planner whose answers somebody hears of answers as before."""

from __future__ import annotations

import pytest

from executive.engine.told_planner import ToldPlanner


class Slow:
    """Answers the second time that it is asked."""

    def __init__(self):
        self.asked: dict[int, int] = {}
        self.cancelled: list[int] = []

    def submit(self, request, *, now_s):
        self.asked[len(self.asked)] = 0
        return len(self.asked) - 1

    def poll(self, ticket, *, now_s):
        self.asked[ticket] += 1
        return f"answer {ticket}" if self.asked[ticket] == 2 else None

    def cancel(self, ticket):
        self.cancelled.append(ticket)


def test_every_answer_is_heard_once_with_what_was_asked():
    heard = []
    planner = ToldPlanner(Slow(), lambda *both: heard.append(both))  # type: ignore[arg-type]
    first, second = (planner.submit(one, now_s=0.0) for one in ("way", "arm"))  # type: ignore[arg-type]
    assert planner.poll(second, now_s=0.0) is None and heard == []
    assert planner.poll(second, now_s=0.1) == "answer 1"
    assert heard == [("arm", "answer 1")]
    planner.cancel(first)
    with pytest.raises(KeyError):
        planner.poll(99, now_s=0.2)
    assert planner._planner.cancelled == [first]  # type: ignore[attr-defined]
    assert planner._asked == {}
