"""What an executive was told that holds until it is told otherwise, for the one that follows it.

A pause, a latched emergency stop and breakpoints are wishes of people about the robot, not about
one process: whoever takes over keeps to them.
"""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from executive.engine.executive import Executive
from executive.journal.journal import Event


class Orders(msgspec.Struct, frozen=True, kw_only=True):
    """What holds.

    Attributes:
        paused: why the robot is paused; empty if it is not.
        estop: why the emergency stop is latched; empty if it is not.
        pressed: whether that is held down still.
        breaks: the patterns of the breakpoints, in the order they were set.
    """

    paused: str = ""
    estop: str = ""
    pressed: bool = False
    breaks: tuple[str, ...] = ()

    def repeat(self, executive: Executive) -> None:
        """Tell them to an executive that knows of none."""
        if self.estop:
            executive.press_estop(self.estop)
            if not self.pressed:
                executive.release_estop()
        if self.paused:
            executive.pause(self.paused)
        for pattern in self.breaks:
            executive.break_at(pattern)


def orders_in(events: Iterable[Event]) -> Orders:
    """What holds at the end of a journal; what a stop ended is not in it any more."""
    paused = estop = ""
    pressed = False
    breaks: dict[str, None] = {}
    for event in events:
        why = str(event.data.get("why") or "")
        match event.event, event.data.get("request"):
            case "pause", _:
                paused = why
            case (("resume" | "stop"), _):
                paused = ""
            case "request", "press_estop":
                estop, pressed = estop or why, True
            case "request", "release_estop":
                pressed = False
            case "request", "reset_estop":
                estop = ""
            case "request", "break_at":
                breaks[str(event.data.get("pattern"))] = None
            case "request", "clear_breaks":
                pattern = event.data.get("pattern")
                breaks = {} if pattern is None else {k: None for k in breaks if k != pattern}
            case _:
                pass
    return Orders(paused=paused, estop=estop, pressed=pressed, breaks=tuple(breaks))
