"""Asks for what was asked for in a recorded run, each thing at the tick at which it was."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

from executive.engine.loop import PERIOD_S
from executive.journal.journal import Event
from executive.runs.session import Session
from executive.runs.task_run import Assignment

EPSILON_S = 1e-3

Restore = Callable[[Event], Assignment]


class Feeder:
    """Feeds a session; call `feed` before the first tick and after every one."""

    def __init__(
        self,
        session: Session,
        inputs: Iterable[Event],
        *,
        restore: Restore,
    ) -> None:
        """Feed nothing yet.

        Args:
            session: that begins anew.
            inputs: events of what came from outside, in order.
            restore: makes what was submitted again.
        """
        self._session = session
        self._left = deque(inputs)
        self._restore = restore

    @property
    def done(self) -> bool:
        """Whether everything was asked for."""
        return not self._left

    def feed(self) -> None:
        """Ask for what the next tick carries out; inject what came after this one."""
        now_s = self._session.now_s
        while self._left:
            event = self._left[0]
            ahead_s = 0.0 if event.event == "fault" else PERIOD_S
            if event.t_s > now_s + ahead_s + EPSILON_S:
                return
            self._left.popleft()
            if event.event == "fault":
                self._session.faults.strike(dict(event.data), now_s)
            else:
                self._ask(dict(event.data), event)

    def _ask(self, asked: dict[str, Any], event: Event) -> None:
        executive = self._session.executive
        name = asked.pop("request")
        match name:
            case "submit":
                assigned = self._restore(event)
                self._session.submit(
                    assigned.understood,
                    urgent=bool(asked["urgent"]),
                    limits=assigned.limits,
                    origin=assigned.origin,
                    done=assigned.done,
                )
            case "abandon":
                self._session.interrupts.count = 2
            case "cancel":
                executive.cancel(int(asked["number"]), str(asked["why"]))
            case "move":
                executive.move(int(asked["number"]), int(asked["place"]))
            case _:
                getattr(executive, name)(**asked)
