"""What the search behind picking and placing is given, keeps, and finds."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from robot.messages import Shape, Side
from robot.planning.grasps import HandOption
from robot.planning.reach import Targets
from robot.planning.requests import Joints, OverEdge
from robot.planning.robot_body import Body
from robot.planning.solids import Solid
from robot.planning.stances import Candidates
from robot.se3 import Array

LEAST_MARGIN = 0.02
"""With less the arm is at a joint's limit or stretched out: it does not follow the object up, and
put a mug down beside its place at 1.10 m."""


@dataclass(frozen=True, slots=True)
class HandlingProblem:
    """What is wanted.

    Attributes:
        kind: see `handling`.
        object_id, shape: what is handled.
        below_m: how far it goes down from its origin, as it stands or lies there.
        options, references, reference_cost: see `stances.propose`.
        others: all solids without the object.
        lifts_m: heights of *up* over *main*, liked best first.
        walk_cost_per_m: of walking to the stance.
        people: circles (x, y, radius) that somebody stands in, shape (n, 3).
        what: for messages, such as "the red cup".
    """

    kind: Literal["pick", "place"]
    object_id: str
    shape: Shape
    options: list[HandOption]
    references: Array
    reference_cost: Array
    others: tuple[Solid, ...]
    lifts_m: tuple[float, ...]
    walk_cost_per_m: float
    people: Array
    what: str
    below_m: float = 0.0


@dataclass(frozen=True, slots=True)
class Choice:
    """A candidate that passed: row 0 of every array is it.

    Attributes:
        q_main, q_back, q_up: joints of the arm at those poses.
        q_ready: with the hand raised, for stepping in.
        q_away: the same for stepping back; None: the arm may stay as it is.
        margin: 0 to 1, of reach and joint limits at all poses.
        steadiness: share of small errors of the stance under which all are still reached.
        score: margin and steadiness less all costs.
        sways: whether the arm or the body touches something as the steps in and out sway it.
    """

    side: Side
    candidate: Candidates
    option: HandOption
    main: Targets
    back: Targets
    up: Targets
    q_main: Array
    q_back: Array
    q_up: Array
    q_ready: Array
    margin: float
    steadiness: float
    score: float
    q_away: Array | None = None
    sways: bool = False

    @property
    def strained(self) -> bool:
        """Whether the arm has nothing left at one of the poses: for where nothing else leads."""
        return self.margin < LEAST_MARGIN

    def over(self, body: Body) -> OverEdge | None:
        """How the arm comes over an edge; None in the postures that are not for that."""
        if not body.description.handy.reaching.leans[int(self.candidate.lean[0])].last:
            return None
        return OverEdge(
            at_rad=_joints(self.q_main),
            back_rad=_joints(self.q_back),
            up_rad=_joints(self.q_up),
            away_rad=None if self.q_away is None else _joints(self.q_away),
        )


@dataclass(slots=True)
class Tally:
    """The best so far, and why other candidates failed."""

    best: Choice | None = None
    short_m: float = np.inf
    reached: int = 0
    touched: Counter[str] = field(default_factory=Counter)

    @property
    def score(self) -> float:
        """Of the best so far."""
        return -np.inf if self.best is None else self.best.score


def _joints(q: Array) -> Joints:
    return tuple(q.tolist())
