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
from robot.planning.numerics import Mask
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
LIFT_GAIN = 0.05
"""A lower lift must score better by this."""
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
        _Entry(float(score[k]), side, some.take(ok[k : k + 1]), _row(main, int(i)), q[k])
        for k, i in enumerate(ok)
    ]


def _closely(
    body: Body, job: Job, checker: Checker, group: list[_Entry], tally: Tally
) -> Iterator[tuple[float, Choice]]:
    """Those of a group (of one hand) that also pass at all other poses, each with its best lift."""
    arm = body.arms[group[0].side]
    poses = _all_poses(body, job, group)
    for i, entry in enumerate(group):
        q_main, q_middle, q_back = (poses.q[k, i] for k in range(3))
        turned = float(np.max(np.abs(q_back - q_main)))
        if not (poses.met[1, i] and poses.met[2, i]) or turned > MAX_TURN_RAD:
            tally.touched[END] += 1
            continue
        checker.prepare(entry.candidate, entry.side, entry.main)
        touch = checker.on_line(q_middle, q_back)
        best: tuple[float, Choice] | None = None
        lifts = [k for k in range(3, len(poses.targets)) if poses.met[k, i]]
        for k in lifts if touch is None else ():
            steady = float(poses.steady[k, i])
            margin = float(np.min(reach.margins(arm, poses.q[[0, 2, k], i])))
            score = margin - float(entry.candidate.cost[0]) - WOBBLE_COST * (1.0 - steady)
            if best is not None and score < best[0] + LIFT_GAIN:
                continue
            back, up = (poses.targets[n].take(np.array([i])) for n in (2, k))
            touch, q_ready = _there_and_away(
                checker, (back, q_back), (up, poses.q[k, i]), picking=job.kind == "pick"
            )
            if q_ready is not None:
                choice = Choice(
                    side=entry.side,
                    candidate=entry.candidate,
                    option=job.options[int(entry.candidate.option[0])],
                    main=entry.main,
                    back=back,
                    up=up,
                    q_main=q_main,
                    q_back=q_back,
                    q_up=poses.q[k, i],
                    q_ready=q_ready,
                    margin=margin * steady,
                    steadiness=steady,
                )
                best = (score, choice)
        if best is None:
            tally.touched[touch or END] += 1
        else:
            yield best


def _there_and_away(
    checker: Checker, back: tuple[Targets, Array], up: tuple[Targets, Array], *, picking: bool
) -> tuple[str | None, Array | None]:
    """What is touched with the object raised, leaving, or arriving; and the ready joints."""
    first, last = (back, up) if picking else (up, back)
    touch = checker.lifted(up[1]) or checker.leaving(last[1])
    return (touch, None) if touch is not None else checker.ready(*first)


@dataclass(frozen=True, slots=True)
class _Poses:
    """Of a group of n: main, middle, back, then the lifts.

    Attributes:
        targets: a pose of the hand for each of the group.
        q: joints, shape (poses, n, k).
        met: whether it is reached, shape (poses, n).
        steady: share of small errors of the stance under which main, back and this pose are all
            reached, shape (poses, n).
    """

    targets: list[Targets]
    q: Array
    met: Mask
    steady: Array


def _all_poses(body: Body, job: Job, group: list[_Entry]) -> _Poses:
    """Joints for every pose of a group (of one hand), in one batch."""
    side = group[0].side
    candidates = _join([entry.candidate for entry in group])
    trunks = reach.trunks_of(body, side, candidates)
    main = reach.targets_of(candidates, job.options, job.references)
    chosen: list[int] = candidates.option.tolist()
    back_m = np.array([-job.options[option].back_m for option in chosen])
    targets = [main, main.moved(along_m=0.5 * back_m), main.moved(along_m=back_m)]
    targets += [main.moved(up_m=lift) for lift in job.lifts_m]
    probed = [0, 2, *range(3, len(targets))]
    off = [trunks.wobbled(error) for error in reach.WOBBLE]
    everything = targets + [targets[k] for k in probed] * len(off)
    hanging = [trunks] * len(targets) + [one for one in off for _ in probed]
    n, q_main = len(group), np.stack([entry.q_main for entry in group])
    reached = reach.reach(
        body.arms[side],
        reach.joined(hanging),
        Targets(
            np.concatenate([each.R for each in everything]),
            np.concatenate([each.p for each in everything]),
        ),
        np.tile(q_main, (len(everything), 1)),
        iterations=18,
    )
    count = len(targets)
    q = reached.q.reshape(len(everything), n, -1)[:count]
    ok = reached.ok.reshape(len(everything), n)
    probes = ok[count:].reshape(len(off), len(probed), n)
    steady = np.zeros((count, n))
    for row, k in enumerate(probed):
        steady[k] = (probes[:, 0] & probes[:, 1] & probes[:, row]).mean(axis=0)
    return _Poses(targets, q, ok[:count], steady)


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
    common = tally.touched.most_common(2) or [("itself", 0)]
    blockers = [name for name, _ in common]
    return failure(
        "goal_in_collision",
        f"every way for the hand to {job.what} found touches {' or '.join(blockers)}",
        blocked_by=", ".join(blockers),
        tried=float(tally.reached),
        blocked=float(sum(count for _, count in common)),
    )
