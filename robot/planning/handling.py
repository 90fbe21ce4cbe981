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
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from robot.errors import Failure, failure
from robot.messages import Shape, Side
from robot.model.body import SIDES
from robot.planning import reach
from robot.planning.body import Body
from robot.planning.checks import Checker
from robot.planning.floor import Floor
from robot.planning.grasps import HandOption
from robot.planning.reach import Targets
from robot.planning.requests import Stance
from robot.planning.solids import Solid
from robot.planning.stances import Candidates, propose
from robot.se3 import Array

BATCH = 160
DEPTH = 8
"""How many candidates of a batch are looked at closely at a time."""
WOBBLE_COST = 1.0
GOOD = 0.25
"""A score that ends the search."""
ENOUGH = 4
"""So many that pass and bear every wobble end the search, too; or four times as many that pass."""
MAX_TURN_RAD = 1.2
"""Most a joint turns on the straight line to the object."""
END = "the end of its reach"


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
    steadiness: float


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
    tally = Tally()
    best: tuple[float, Choice] | None = None
    passed = steady = 0
    for first in range(0, len(candidates), BATCH):
        rows = np.arange(first, min(first + BATCH, len(candidates)))
        for score, choice in _passing(body, job, candidates.take(rows), tally):
            if best is None or score > best[0]:
                best = (score, choice)
            passed += 1
            steady += choice.steadiness == 1.0
            if best[0] >= GOOD or steady >= ENOUGH or passed >= 4 * ENOUGH:
                return best[1]
        if best is not None and steady:
            return best[1]
    if best is not None:
        return best[1]
    return _explain(job, floor, len(candidates), total, tally)


def _passing(
    body: Body, job: Job, batch: Candidates, tally: Tally
) -> Iterator[tuple[float, Choice]]:
    """Score and choice of those in a batch that pass everything, likeliest first (lazily)."""
    ranked: list[_Entry] = []
    for side in SIDES:
        some = batch.take(np.flatnonzero(batch.left == (side == "left")))
        if len(some):
            ranked += _reachable(body, job, side, some, tally)
    ranked.sort(key=lambda entry: -entry.score)
    checker = Checker(body, job)
    waiting: list[_Entry] = []
    for k, entry in enumerate(ranked):
        checker.prepare(entry.candidate, entry.side, entry.main)
        touch = checker.at_main(entry.q_main)
        if touch is None:
            waiting.append(entry)
        else:
            tally.touched[touch] += 1
        if len(waiting) == DEPTH or k == len(ranked) - 1:
            for side in SIDES:
                group = [entry for entry in waiting if entry.side == side]
                if group:
                    yield from _closely(body, job, checker, group, tally)
            waiting = []


@dataclass(frozen=True, slots=True)
class _Entry:
    """A candidate whose main pose is reached."""

    score: float
    side: Side
    candidate: Candidates
    main: Targets
    q_main: Array


def _reachable(body: Body, job: Job, side: Side, some: Candidates, tally: Tally) -> list[_Entry]:
    """Those of one hand whose main pose is reached."""
    arm = body.arms[side]
    main = reach.targets_of(some, job.options, job.references)
    reached = reach.first_reach(body, arm, reach.trunks_of(body, side, some), main)
    tally.short_m = min(tally.short_m, float(np.min(reached.short_m)))
    ok = np.flatnonzero(reached.ok)
    tally.reached += len(ok)
    q = arm.chain.relax(reached.q[ok])
    score = reach.margins(arm, q) - some.cost[ok]
    return [
        _Entry(float(score[k]), side, some.take(ok[k : k + 1]), _row(main, i), q[k])
        for k, i in enumerate(ok)
    ]


def _closely(
    body: Body, job: Job, checker: Checker, group: list[_Entry], tally: Tally
) -> Iterator[tuple[float, Choice]]:
    """Those of a group (of one hand) that also pass at all other poses."""
    side = group[0].side
    arm = body.arms[side]
    poses, q, ok, steady = _all_poses(body, job, side, group)
    lifts = range(len(job.lifts_m))
    for i, entry in enumerate(group):
        main, middle, back = (poses[k].take(np.array([i])) for k in range(3))
        if not (ok[1, i] and ok[2, i]) or np.max(np.abs(q[2, i] - entry.q_main)) > MAX_TURN_RAD:
            tally.touched[END] += 1
            continue
        checker.prepare(entry.candidate, side, main)
        touch = checker.on_line(q[1, i], q[2, i])
        q_ready: Array | None = None
        for k in (3 + lift for lift in lifts):
            if touch is not None or not ok[k, i]:
                continue
            touch = checker.lifted(q[k, i])
            if touch is not None:
                touch = None if k < 2 + len(lifts) else touch
                continue
            up = poses[k].take(np.array([i]))
            first, last = (2, k) if job.kind == "pick" else (k, 2)
            touch = checker.leaving(q[last, i])
            if touch is None:
                touch, q_ready = checker.ready(back if first == 2 else up, q[first, i])
            if q_ready is None:
                continue
            margin = float(np.min(reach.margins(arm, q[[0, 2, k], i])))
            score = margin - float(entry.candidate.cost[0]) - WOBBLE_COST * (1.0 - steady[i])
            yield (
                score,
                Choice(
                    side=side,
                    candidate=entry.candidate,
                    option=job.options[int(entry.candidate.option[0])],
                    main=main,
                    back=back,
                    up=up,
                    q_main=q[0, i],
                    q_back=q[2, i],
                    q_up=q[k, i],
                    q_ready=q_ready,
                    margin=margin * float(steady[i]),
                steadiness=float(steady[i]),
                ),
            )
            break
        if q_ready is None:
            tally.touched[touch or END] += 1
        del middle


def _all_poses(
    body: Body, job: Job, side: Side, group: list[_Entry]
) -> tuple[list[Targets], Array, np.ndarray, Array]:
    """Main, middle, back and the lifts of a group.

    Returns the targets, joints (poses, n, k), whether reached (poses, n), and the share of small
    errors of the stance under which main, back and the first lift are still reached (n,).
    """
    arm = body.arms[side]
    candidates = _join([entry.candidate for entry in group])
    trunks = reach.trunks_of(body, side, candidates)
    main = reach.targets_of(candidates, job.options, job.references)
    back_m = np.array([-job.options[option].back_m for option in candidates.option])
    back = main.moved(along_m=back_m)
    poses = [main, main.moved(along_m=0.5 * back_m), back]
    poses += [main.moved(up_m=lift) for lift in job.lifts_m]
    off = [trunks.wobbled(error) for error in reach.WOBBLE]
    probed = [main, back, poses[3]]
    everything = poses[1:] + probed * len(off)
    hanging = [trunks] * (len(poses) - 1) + [one for one in off for _ in probed]
    n, q_main = len(group), np.stack([entry.q_main for entry in group])
    reached = reach.reach(
        arm,
        reach.joined(hanging),
        Targets(
            np.concatenate([targets.R for targets in everything]),
            np.concatenate([targets.p for targets in everything]),
        ),
        np.tile(q_main, (len(everything), 1)),
    )
    count = len(poses) - 1
    q = np.concatenate([q_main[None], reached.q.reshape(len(everything), n, -1)[:count]])
    ok = reached.ok.reshape(len(everything), n)
    met = np.concatenate([np.ones((1, n), dtype=bool), ok[:count]])
    return poses, q, met, ok[count:].mean(axis=0)


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
