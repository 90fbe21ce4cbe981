"""What one job has of the executive: its failure, its counts, its steps at work."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

from robot.failures import Failure


class Suspendable(Protocol):
    """A leaf at work that can be interrupted and go on later."""

    def suspend(self) -> None:
        """Bring it to rest, and remember where it was."""
        ...


@dataclass(eq=False, kw_only=True)
class Scope:
    """One job's own; `Stage.scope` is that of the job whose turn it is.

    Attributes:
        number: of the job; 0 is the executive's own business (coming to a stand).
        failure: the newest failure of a step.
        recoveries: begun so far.
        spent: of the recoveries a job may have; a step done at the first try gives one back.
        worked_s: time in which the job had its turn.
        speed_m_s: the fastest it may walk.
        at_work: leaves whose skill acts.
    """

    number: int = 0
    failure: Failure | None = None
    recoveries: int = 0
    spent: int = 0
    worked_s: float = 0.0
    speed_m_s: float = math.inf
    at_work: list[Suspendable] = field(default_factory=list[Suspendable])

    def suspend(self) -> None:
        """Interrupt every leaf at work."""
        for leaf in list(self.at_work):
            leaf.suspend()
