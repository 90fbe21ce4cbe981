"""What one job has of the executive: its failure, its counts, its steps at work."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

from executive.skills.give import GiveParams
from executive.skills.parameters import SkillParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
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
        put_down: where it put things, place by object, as far as they were not taken again.
        taken: the things that it took and neither put down nor gave away.
        at_work: leaves whose skill acts.
    """

    number: int = 0
    failure: Failure | None = None
    recoveries: int = 0
    spent: int = 0
    worked_s: float = 0.0
    speed_m_s: float = math.inf
    put_down: dict[str, str] = field(default_factory=dict[str, str])
    taken: set[str] = field(default_factory=set[str])
    at_work: list[Suspendable] = field(default_factory=list[Suspendable])

    def did(self, params: SkillParams | None) -> None:
        """Remember what a step that is done has changed in the world."""
        match params:
            case PlaceParams(object_id=object_id):
                self.taken.discard(object_id)
                if params.place_id is not None:
                    self.put_down[object_id] = params.place_id
            case GiveParams(object_id=object_id):
                self.taken.discard(object_id)
            case PickParams(object_id=object_id):
                self.put_down.pop(object_id, None)
                self.taken.add(object_id)
            case _:
                pass

    def suspend(self) -> None:
        """Interrupt every leaf at work."""
        for leaf in list(self.at_work):
            leaf.suspend()
