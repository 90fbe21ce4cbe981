"""Planning off the tick: submit a request, poll for its answer, cancel it."""

from __future__ import annotations

from typing import Protocol

from robot.planning.requests import PlanRequest, PlanResult


class Planner(Protocol):
    """Answers requests some time later. Tickets grow and are never reused."""

    def submit(self, request: PlanRequest, *, now_s: float) -> int:
        """Take a request; returns its ticket at once."""
        ...

    def poll(self, ticket: int, *, now_s: float) -> PlanResult | None:
        """The answer, or None while there is none yet. An answer is handed out once.

        Raises:
            KeyError: if the ticket was never given, was cancelled, or was answered before.
        """
        ...

    def cancel(self, ticket: int) -> None:
        """Forget a request; a ticket that is not known is ignored."""
        ...
