"""The search behind picking and placing: a grasp, a stance and a posture that go together.

Candidates come likeliest first; whole batches go through inverse kinematics, the best of them
through collision checks of every pose they will take, until one passes.

Picking and placing are one motion read in two directions. At the *main* pose the hand is on the
object where it stands; the hand without it comes (or goes) along the approach, to *back*; the hand
with it goes (or comes) straight up, to *up*::

    pick:   ready -> back -> main, close, -> up -> away
    place:  ready -> up -> main, open, -> back -> away
"""

from __future__ import annotations

import re

import numpy as np

from robot.failures import Failure, failure
from robot.messages import Side
from robot.planning.checks import END
from robot.planning.depth import too_deep
from robot.planning.floor import Floor
from robot.planning.handling_problem import Choice, HandlingProblem, Tally
from robot.planning.requests import Stance
from robot.planning.robot_body import Body
from robot.planning.solids import PIECE
from robot.planning.stances import Candidates, Stage, propose
from robot.planning.trials import passing

BATCH, LAST_BATCH = 160, 1600
"""Candidates together: few, as the first are the likeliest; many where one in a hundred is free."""
GOOD = 0.25
"""A score that ends the search."""
PATIENCE = 4
"""So many groups are looked at, at most, from the first that has a good candidate."""
SWAYING = 0.25
"""Of such a group, where the best so far sways into something: beside a wall the likeliest four
groups all have the hand on that side."""
SWAYING_BATCHES = 3
"""So many batches more, at most, for one that does not."""


def search(
    body: Body,
    problem: HandlingProblem,
    floor: Floor,
    *,
    sides: tuple[Side, ...],
    start: Stance,
    seed: int,
) -> Choice | Failure:
    """The best of the first good candidates, or why there is none."""
    tally, tried, total = Tally(), 0, 0
    highest_m = float(np.max(problem.references[:, 2]))
    leans = [one for one in body.description.handy.reaching.leans if one.from_m <= highest_m]
    for stage in sorted(dict.fromkeys(map(Stage.of, leans)), key=lambda stage: stage.last):
        candidates, proposed = propose(
            problem.options,
            problem.references,
            floor,
            reaching=body.description.handy.reaching,
            sides=sides,
            start=start,
            radius_m=body.description.body_radius_m + 0.02,
            reference_cost=problem.reference_cost,
            walk_cost_per_m=problem.walk_cost_per_m,
            people=problem.people,
            seed=seed,
            stage=stage,
        )
        tried, total = tried + len(candidates), total + proposed
        choice = _first_good(body, problem, candidates, tally, last=stage.last)
        if choice is not None and not choice.strained:
            return choice
    return tally.best or _explain(body, problem, floor, (tried, total), tally)


def _first_good(
    body: Body, problem: HandlingProblem, candidates: Candidates, tally: Tally, *, last: bool
) -> Choice | None:
    """The best of the first batch with a good one, else the best of all."""
    size = LAST_BATCH if last else BATCH
    for first in range(0, len(candidates), size):
        rows = np.arange(first, min(first + size, len(candidates)))
        patience = float(PATIENCE)
        for choice in passing(body, problem, candidates.take(rows), tally, last=last):
            if choice is not None and choice.score > tally.score:
                tally.best = choice
            best = tally.best
            if best is not None and best.steadiness == 1.0 and not best.strained:
                patience -= SWAYING if best.sways else 1.0
                if best.score >= GOOD or patience <= 0.0:
                    return best
        best = tally.best
        if best is None or best.steadiness < 1.0 or (best.strained and not last):
            continue
        if not best.sways or first >= SWAYING_BATCHES * size:
            return best
    return tally.best


def _explain(
    body: Body, problem: HandlingProblem, floor: Floor, counts: tuple[int, int], tally: Tally
) -> Failure:
    """Which stage nothing passed."""
    x, y, z = (float(value) for value in problem.references[0])
    candidates, total = counts
    if candidates == 0:
        name, distance = floor.nearest(x, y)
        return failure(
            "no_stance",
            f"none of {total} places to stand for {problem.what} is free and can be walked to",
            x_m=x,
            y_m=y,
            nearest=name,
            nearest_m=distance,
        )
    if tally.reached == 0:
        return failure(
            "out_of_reach",
            f"from every place to stand, the hand stays at least {100 * tally.short_m:.0f} cm "
            f"short of {problem.what}",
            short_m=tally.short_m,
            x_m=x,
            y_m=y,
            height_m=z,
        )
    common = tally.touched.most_common(2) or [("itself", 0)]
    blockers = [name for name, _ in common]
    reaching = body.description.handy.reaching
    return too_deep(problem, floor, reaching, blockers=blockers) or failure(
        "goal_in_collision",
        f"every way for the hand to {problem.what} that was found {_fails_by(blockers)}",
        blocked_by=", ".join(blockers),
        tried=float(tally.reached),
        blocked=float(sum(count for _, count in common)),
    )


UNMAPPED = re.compile(r"(in_view|unmapped)_[0-9]+")
"""Ids of what perception saw and the map does not explain (`robot.perception.node`)."""


def _fails_by(blockers: list[str]) -> str:
    """What ways of a hand that are none have in common, the more frequent first."""
    touched = [
        "something in the way"
        if UNMAPPED.fullmatch(one)
        else one.partition(PIECE)[0].replace("_", " ")
        for one in blockers
        if one != END
    ]
    ends = [f"is at {END}"] if END in blockers else []
    touches = [f"touches {' or '.join(dict.fromkeys(touched))}"] if touched else []
    return " or ".join([*touches, *ends])
