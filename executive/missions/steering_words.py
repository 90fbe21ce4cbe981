"""Words that steer a robot at work, which a mission has no use for as a step: nobody says them."""

from __future__ import annotations

from collections.abc import Iterable

from intents import goals

CURES: dict[type[goals.Stop | goals.Cancel | goals.Pause | goals.Resume], str] = {
    goals.Stop: "`fail: WHY` ends a mission early, `stand for 3 seconds` stands still",
    goals.Cancel: "`fail: WHY` ends a mission early",
    goals.Pause: "`wait: 10` waits; a person says `pause` while it runs",
    goals.Resume: "a person says `resume` while it runs",
}
"""What a mission says instead of a word to a robot at work."""
ASKED = {"why", "remaining"}
"""Topics that only somebody beside the robot asks about: `report: why` lets it speak of them."""


def problem(found: Iterable[goals.Goal]) -> tuple[str, str] | None:
    """What is wrong with what a sentence says as a step, and the cure; None if it is one.

    "Walk to the table and stop there" is one: its stop is the end of what was done before.
    """
    found = tuple(found)
    ends = found[1:]
    for goal in goals.each(found):
        if isinstance(goal, goals.Stop) and any(goal is end for end in ends):
            continue
        if cure := CURES.get(type(goal)):  # pyright: ignore[reportArgumentType]
            return "this steers a robot at work: it is no step of a mission", cure
        if isinstance(goal, goals.Report) and goal.topic in ASKED:
            cure = f"`report: {goal.topic}` has the robot say it"
            return "this is a question to a robot at work: it is no step of a mission", cure
    return None
