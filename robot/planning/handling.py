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

from collections import Counter
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from robot.errors import Failure, failure
from robot.messages import Shape, Side
from robot.planning import reach
from robot.planning.body import Body
from robot.planning.checks import Checker
from robot.planning.floor import Floor
from robot.planning.grasps import HandOption
from robot.planning.reach import Bases, Reached, Targets
from robot.planning.requests import Stance
from robot.planning.solids import Solid
from robot.planning.stances import LEANS, Candidates, propose
from robot.se3 import Array

BATCH = 160
ROUNDS = 7
DEPTH = 8
"""How many candidates of a batch are looked at closely at a time."""
WOBBLE_COST = 0.4
GOOD = 0.25
"""A score that ends the search."""


@dataclass(frozen=True, slots=True)
class Job:
    """What is wanted.

    Attributes:
        kind: see the module.
        object_id, shape: what is handled.
        options, references, reference_cost: see `stances.propose`.
        others: all solids without the object.
        lifts_m: heights of *up* over *main*, liked best first.
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
    what: str


@dataclass(frozen=True, slots=True)
class Choice:
    """A candidate that passed: row 0 of every array is it."""

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


@dataclass(slots=True)
class Tally:
    """Why candidates failed."""

    short_m: float = np.inf
    reached: int = 0
    touched: Counter[str] = field(default_factory=Counter)


def search(
    body: Body, job: Job, floor: Floor, *, sides: tuple[Side, ...], start: Stance, seed: int
) -> Choice | Failure:
    """The best of the first good candidates, or why there is none."""
    candidates, total = propose(
        job.options,
        job.references,
        floor,
        sides=sides,
        start=start,
        radius_m=body.description.body_radius_m + 0.02,
        reference_cost=job.reference_cost,
        seed=seed,
    )
    tally, checker = Tally(), Checker(body, job.others)
    best: tuple[float, Choice] | None = None
    for first in range(0, min(len(candidates), BATCH * ROUNDS), BATCH):
        rows = np.arange(first, min(first + BATCH, len(candidates)))
        for score, choice in _passing(body, job, checker, candidates.take(rows), tally):
            if best is None or score > best[0]:
                best = (score, choice)
            if best[0] >= GOOD:
                return best[1]
        if best is not None:
            return best[1]
    return _explain(job, floor, len(candidates), total, tally)


def _passing(body: Body, job: Job, checker: Checker, batch: Candidates, tally: Tally):
    """Score and choice of those in a batch that pass everything, likeliest first (lazily)."""
    ranked: list[tuple[float, Side, Candidates, Array]] = []
    for side in ("left", "right"):
        some = batch.take(np.flatnonzero(batch.left == (side == "left")))
        if not len(some):
            continue
        arm = body.arms[side]
        bases = reach.bases_of(body, side, some)
        main = reach.targets_of(some, job.options, job.references)
        reached = reach.first_reach(body, arm, bases, main)
        tally.short_m = min(tally.short_m, float(np.min(reached.short_m)))
        ok = np.flatnonzero(reached.ok)
        tally.reached += len(ok)
        score = reach.margins(arm, reached.q[ok]) - some.cost[ok]
        ranked += [
            (float(score[k]), side, some.take(ok[k : k + 1]), reached.q[ok[k] : ok[k] + 1])
            for k in range(len(ok))
        ]
    ranked.sort(key=lambda entry: -entry[0])
    for first in range(0, len(ranked), DEPTH):
        for side in ("left", "right"):
            group = [entry for entry in ranked[first : first + DEPTH] if entry[1] == side]
            if group:
                yield from _closely(body, job, checker, group, tally)


def _closely(body: Body, job: Job, checker: Checker, group: list, tally: Tally):
    """The rest of the poses, the wobble, and what touches."""
    side: Side = group[0][1]
    arm = body.arms[side]
    some = _join([entry[2] for entry in group])
    q_main = np.concatenate([entry[3] for entry in group])
    bases = reach.bases_of(body, side, some)
    main = reach.targets_of(some, job.options, job.references)
    back_m = np.array([-job.options[option].back_m for option in some.option])
    back = main.moved(along_m=back_m)
    back_reached = reach.reach(arm, bases, back, q_main)
    middle = reach.reach(arm, bases, main.moved(along_m=0.5 * back_m), q_main)
    ups = [(lift, main.moved(up_m=lift)) for lift in job.lifts_m]
    ups_reached = [reach.reach(arm, bases, up, q_main) for _, up in ups]
    steady = _steadiness(arm, bases, main, back, q_main)
    for i, (score, _, candidate, _) in enumerate(group):
        if not (back_reached.ok[i] and middle.ok[i]):
            tally.touched["the end of its reach"] += 1
            continue
        q_back = back_reached.q[i]
        if np.max(np.abs(q_back - q_main[i])) > 1.2:
            continue
        option = job.options[int(candidate.option[0])]
        for (_, up), up_reached in zip(ups, ups_reached, strict=True):
            if not up_reached.ok[i]:
                continue
            touch, q_ready = checker.passes(
                job, option, candidate, side,
                main=_row(main, i), back=_row(back, i), up=_row(up, i),
                q=(q_main[i], middle.q[i], q_back, up_reached.q[i]),
            )  # fmt: skip
            if touch is not None:
                tally.touched[touch] += 1
                continue
            assert q_ready is not None
            q_all = np.stack([q_main[i], q_back, up_reached.q[i]])
            margin = float(np.min(reach.margins(arm, q_all)))
            total = margin - float(candidate.cost[0]) - WOBBLE_COST * (1.0 - steady[i])
            yield total, Choice(
                side, candidate, option, _row(main, i), _row(back, i), _row(up, i),
                q_main[i], q_back, up_reached.q[i], q_ready, margin * steady[i],
            )  # fmt: skip
            break


def _steadiness(arm, bases: Bases, main: Targets, back: Targets, q: Array) -> Array:
    """Share of small errors of the stance at which the poses are still reached, shape (n,)."""
    n = len(q)
    off = [reach.wobbled(bases, error) for error in reach.WOBBLE] * 2
    stacked = Bases(
        np.concatenate([b.p for b in off]),
        np.concatenate([b.yaw for b in off]),
        np.concatenate([b.q_chain for b in off]),
    )
    half = len(reach.WOBBLE)
    targets = Targets(
        np.concatenate([main.R] * half + [back.R] * half),
        np.concatenate([main.p] * half + [back.p] * half),
    )
    reached: Reached = reach.reach(arm, stacked, targets, np.tile(q, (2 * half, 1)), iterations=10)
    return reached.ok.reshape(2 * half, n).mean(axis=0)


def _row(targets: Targets, i: int) -> Targets:
    return Targets(targets.R[i : i + 1], targets.p[i : i + 1])


def _join(parts: list[Candidates]) -> Candidates:
    names = Candidates.__dataclass_fields__
    return Candidates(**{n: np.concatenate([getattr(p, n) for p in parts]) for n in names})


def _explain(job: Job, floor: Floor, candidates: int, total: int, tally: Tally) -> Failure:
    """Which stage nothing passed."""
    x, y, z = (float(value) for value in job.references[0])
    if candidates == 0:
        name, distance = floor.nearest(x, y)
        return failure(
            "no_stance",
            f"none of {total} places to stand for {job.what} is free and can be walked to",
            x_m=x,
            y_m=y,
            nearest=name,
            nearest_m=distance,
        )
    if tally.reached == 0:
        return failure(
            "out_of_reach",
            f"from every place to stand, the hand stays at least {100 * tally.short_m:.0f} cm "
            f"short of {job.what}",
            short_m=tally.short_m,
            x_m=x,
            y_m=y,
            height_m=z,
        )
    blocker, count = (tally.touched.most_common(1) or [("itself", 0)])[0]
    return failure(
        "goal_in_collision",
        f"every way for the hand to {job.what} found touches {blocker}",
        blocked_by=blocker,
        tried=float(tally.reached),
        blocked=float(count),
    )


def leans_of(choice: Choice) -> int:
    """Index of the choice's lean in `LEANS`."""
    return int(choice.candidate.lean[0]) % len(LEANS)
