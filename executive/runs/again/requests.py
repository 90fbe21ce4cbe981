"""Asks for what was asked for in a recorded run, each thing at the tick at which it was.

A journal may be a stranger's. What it can ask for is the closed set of `Request`: plain values,
each handed to the one method of the executive that it stands for.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

import msgspec

from executive.behaviours.ask import Answer
from executive.engine.executive import Executive
from executive.engine.jobs import Limits
from executive.engine.loop import PERIOD_S
from executive.journal.journal import Event
from executive.missions import fault_plans
from executive.runs.session import Session
from executive.runs.task_run import Assignment
from robot.errors import ConfigError

EPSILON_S = 1e-3

Restore = Callable[[Event], Assignment]


class Submit(msgspec.Struct, frozen=True, tag_field="request", tag="submit"):
    """A job; what it is made of, `Restore` reads out of the same event."""

    text: str
    urgent: bool
    limits: Limits
    origin: dict[str, Any]


class Abandon(msgspec.Struct, frozen=True, tag_field="request", tag="abandon"):
    """Everything is to end at once."""


class _Simple(msgspec.Struct, frozen=True, tag_field="request", forbid_unknown_fields=True):
    """One call of one method of the executive."""


class Pause(_Simple, frozen=True, tag="pause"):
    """`Executive.pause`."""

    why: str


class Resume(_Simple, frozen=True, tag="resume"):
    """`Executive.resume`."""


class Stop(_Simple, frozen=True, tag="stop"):
    """`Executive.stop`."""

    why: str


class Cancel(_Simple, frozen=True, tag="cancel"):
    """`Executive.cancel`, and what `Executive.drop` makes of it."""

    number: int
    why: str


class Move(_Simple, frozen=True, tag="move"):
    """`Executive.move`."""

    number: int
    place: int


class BreakAt(_Simple, frozen=True, tag="break_at"):
    """`Executive.break_at`."""

    pattern: str


class ClearBreaks(_Simple, frozen=True, tag="clear_breaks"):
    """`Executive.clear_breaks`."""

    pattern: str | None = None


class StepOnce(_Simple, frozen=True, tag="step_once"):
    """`Executive.step_once`."""


class GoOn(_Simple, frozen=True, tag="go_on"):
    """`Executive.go_on`."""


class PressEstop(_Simple, frozen=True, tag="press_estop"):
    """`Executive.press_estop`."""

    why: str


class ReleaseEstop(_Simple, frozen=True, tag="release_estop"):
    """`Executive.release_estop`."""


class ResetEstop(_Simple, frozen=True, tag="reset_estop"):
    """`Executive.reset_estop`."""


class GiveAnswer(_Simple, frozen=True, tag="answer"):
    """`Executive.answer`."""

    text: Answer


Simple = (
    Pause | Resume | Stop | Cancel | Move | BreakAt | ClearBreaks | StepOnce | GoOn | GiveAnswer
    | PressEstop | ReleaseEstop | ResetEstop
)  # fmt: skip
Request = Submit | Abandon | Simple


def read(event: Event) -> Request:
    """What a recorded event asked for. Raises ConfigError if that is none of the set."""
    try:
        return msgspec.convert(event.data, Request)  # pyright: ignore[reportArgumentType, reportReturnType]
    except msgspec.ValidationError as error:
        raise ConfigError(f"event {event.n} of the journal is no request: {error}") from None


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

        Raises:
            ConfigError: if one of them is none that a person can ask for, or no fault.
        """
        self._session = session
        self._left = deque((event, _checked(event)) for event in inputs)
        self._restore = restore

    @property
    def done(self) -> bool:
        """Whether everything was asked for."""
        return not self._left

    def feed(self) -> None:
        """Ask for what the next tick carries out; inject what came after this one."""
        now_s = self._session.now_s
        while self._left:
            event, request = self._left[0]
            ahead_s = 0.0 if request is None else PERIOD_S
            if event.t_s > now_s + ahead_s + EPSILON_S:
                return
            self._left.popleft()
            if request is None:
                self._session.faults.strike(dict(event.data), now_s)
            else:
                self._ask(request, event)

    def _ask(self, request: Request, event: Event) -> None:
        match request:
            case Submit():
                assigned = self._restore(event)
                self._session.submit(
                    assigned.understood,
                    urgent=request.urgent,
                    limits=assigned.limits,
                    origin=assigned.origin,
                    done=assigned.done,
                )
            case Abandon():
                self._session.interrupts.count = 2
            case _:
                _pass_on(request, self._session.executive)


def _checked(event: Event) -> Request | None:
    """The request of an event; None for a fault."""
    if event.event == "fault":
        fault_plans.plan(event.data)
        return None
    return read(event)


def _pass_on(request: Simple, executive: Executive) -> None:
    """Call the method that the kind of request is tagged by, which takes what it holds."""
    method: Callable[..., None] = getattr(executive, str(type(request).__struct_config__.tag))
    method(**msgspec.structs.asdict(request))
