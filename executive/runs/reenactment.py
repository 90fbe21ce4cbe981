"""Asks for what was asked for in a recorded run, each thing at the tick at which it was."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

from executive.engine.jobs import Limits
from executive.engine.loop import PERIOD_S
from executive.journal.journal import Event
from executive.meaning.request import Understood
from executive.runs.faults import Injector
from executive.runs.session import Session

EPSILON_S = 1e-3

Restore = Callable[[Event], Understood]


class Feeder:
    """Feeds a session; call `feed` before the first tick and after every one."""

    def __init__(
        self,
        session: Session,
        inputs: Iterable[Event],
        *,
        restore: Restore,
        injector: Injector,
    ) -> None:
        """Feed nothing yet.

        Args:
            session: that begins anew.
            inputs: events of what came from outside, in order.
            restore: makes the task of a submission again.
            injector: of the faults.
        """
        self._session = session
        self._left = deque(inputs)
        self._restore = restore
        self._injector = injector

    @property
    def done(self) -> bool:
        """Whether everything was asked for."""
        return not self._left

    def feed(self) -> None:
        """Ask for what the next tick carries out; inject what came after this one."""
        now_s = self._session.runtime.clock.now_s()
        self._injector.tick(now_s)
        while self._left:
            event = self._left[0]
            ahead_s = 0.0 if event.event == "fault" else PERIOD_S
            if event.t_s > now_s + ahead_s + EPSILON_S:
                return
            self._left.popleft()
            if event.event == "fault":
                self._injector.strike(dict(event.data), now_s)
            else:
                self._ask(dict(event.data), event)

    def _ask(self, asked: dict[str, Any], event: Event) -> None:
        executive = self._session.executive
        name = asked.pop("request")
        match name:
            case "submit":
                made_from = asked["origin"]
                self._session.submit(
                    self._restore(event),
                    urgent=bool(asked["urgent"]),
                    limits=Limits(**asked["limits"]),
                    origin={key: made_from[key] for key in made_from if key != "done"},
                    done=frozenset(made_from.get("done", ())),
                )
            case "abandon":
                self._session.interrupts.count = 2
            case "cancel":
                executive.cancel(int(asked["number"]), str(asked["why"]))
            case "move":
                executive.move(int(asked["number"]), int(asked["place"]))
            case _:
                getattr(executive, name)(**asked)
