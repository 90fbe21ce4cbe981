"""Candidates for picking and placing put to the test: reach, collisions, and every pose between."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass, replace

import numpy as np

from robot.messages import Side
from robot.model.body import SIDES
from robot.planning import reach
from robot.planning.checks import END, ROOMS_M, Checker
from robot.planning.handling_problem import LEAST_MARGIN, Choice, HandlingProblem, Tally
from robot.planning.numerics import Mask
from robot.planning.reach import Targets
from robot.planning.robot_body import Body
from robot.planning.stances import Candidates
from robot.se3 import Array

DEPTH = 8
"""How many candidates of a batch are looked at closely at a time."""
SWINGS = (0, 5, 4)
"""How far the elbow is swung up where the arm touches something, and how much further then."""
LAST_SWINGS = (0, 5)
"""The same in postures that are tried last: there the whole arm comes over an edge from the side.
At a counter of 0.9 m, a mug 0.35 m from the edge, 4 in 100 get there without, 1 in 3 with them."""
LINE_SWINGS, LINE_SWING = 2, 2
"""How often, and how far, the elbow is swung up on the line to the object, over an edge."""
LAST_GROUPS = 24
"""So many groups of a batch are looked at closely in those postures: a second, if all fail late."""
OUTWARDS = 0.4
"""How far out it swings for a metre up."""
WOBBLE_COST = 1.0
SWAY_COST = 0.6
TIGHT_COST_PER_M = 10.0
"""Of each metre of room that is lacking: 0.18 where the arm passes things by 12 mm and no more."""
STRAIN_COST = 2.0
"""Of a pose that leaves the arm nothing: more than all costs of one that does."""
MAX_TURN_RAD = 1.2
"""Most a joint turns on the straight line to the object."""
LIFT_GAIN = 0.05
"""A lower lift must score better by this."""


def passing(
    body: Body, problem: HandlingProblem, batch: Candidates, tally: Tally, *, last: bool = False
) -> Iterator[Choice | None]:
    """Those of a batch that pass everything and are better than the best so far, likeliest first.

    Lazily; None for each group of candidates in which there is none.
    """
    ranked: list[_Entry] = []
    for side in SIDES:
        some = batch.take(np.flatnonzero(batch.left == (side == "left")))
        if len(some):
            ranked += _reachable(body, problem, side, some, tally=tally, last=last)
    checker = Checker(body, problem)
    for steps in LAST_SWINGS if last else SWINGS:
        raised = _swung(body, ranked, steps) if steps else ranked
        ranked = yield from _tested(body, problem, checker, raised, tally=tally, last=last)


def _tested(
    body: Body,
    problem: HandlingProblem,
    checker: Checker,
    entries: list[_Entry],
    *,
    tally: Tally,
    last: bool,
) -> Generator[Choice | None, None, list[_Entry]]:
    """Yields what `passing` does; returns the entries that touch something at their main pose."""
    ranked = sorted(entries, key=lambda entry: -entry.score)
    waiting: list[_Entry] = []
    blocked: list[_Entry] = []
    groups = 0
    for k, entry in enumerate(ranked):
        if last and groups >= LAST_GROUPS:
            return []
        checker.prepare(entry.candidate, entry.side, entry.main)
        touch = checker.at_main(entry.q_main)
        if touch is None:
            waiting.append(entry)
        else:
            blocked.append(entry)
            tally.touched[touch] += 1
        if len(waiting) == DEPTH or k == len(ranked) - 1:
            for side in SIDES:
                group = [entry for entry in waiting if entry.side == side]
                if group:
                    groups += 1
                    yield _closely(body, problem, checker, group, tally=tally, last=last)
            waiting = []
    return blocked


@dataclass(frozen=True, slots=True)
class _Entry:
    """A candidate whose main pose is reached."""

    score: float
    side: Side
    candidate: Candidates
    main: Targets
    q_main: Array


def _reachable(
    body: Body,
    problem: HandlingProblem,
    side: Side,
    some: Candidates,
    *,
    tally: Tally,
    last: bool,
) -> list[_Entry]:
    """Those of one hand whose main pose and back are reached."""
    arm = body.arms[side]
    main = reach.targets_of(some, problem.options, problem.references)
    trunks = reach.trunks_of(body, side, some)
    lean = body.description.handy.reaching.leans[int(some.lean[0])]  # of one stage, as all are
    reached = reach.first_reach(body, arm, trunks, main, posture=lean.arm)
    tally.short_m = min(tally.short_m, float(np.min(reached.short_m)))
    ok = np.flatnonzero(reached.ok)
    tally.reached += len(ok)
    q = reached.q[ok] if last else arm.chain.relax(reached.q[ok])  # the elbow stays up
    back = _backs(problem, some, main).take(ok)
    there = reach.reach(arm, trunks.take(ok), back, q, iterations=12).ok
    tally.touched[END] += int(np.sum(~there))
    ok, q = ok[there], q[there]
    score = reach.margins(arm, q) - some.cost[ok]
    return [
        _Entry(float(score[k]), side, some.take(ok[k : k + 1]), _row(main, int(i)), q[k])
        for k, i in enumerate(ok)
    ]


def _swung(body: Body, entries: list[_Entry], steps: int) -> list[_Entry]:
    """The same with the elbow further up and out, where the first touched a table or a board."""
    result: list[_Entry] = []
    for side in SIDES:
        some = [entry for entry in entries if entry.side == side]
        if not some:
            continue
        arm = body.arms[side]
        q = _elbow_up(body, some, np.stack([entry.q_main for entry in some]), steps)
        score = reach.margins(arm, q) - np.array([entry.candidate.cost[0] for entry in some])
        result += [
            replace(entry, q_main=q[k], score=float(score[k])) for k, entry in enumerate(some)
        ]
    return result


def _elbow_up(body: Body, entries: list[_Entry], q: Array, steps: int) -> Array:
    """Joints of one arm, shape (n, k), with the elbow swung up and out at the entries' stances."""
    side = entries[0].side
    trunks = reach.trunks_of(body, side, _join([entry.candidate for entry in entries]))
    aside = OUTWARDS if side == "left" else -OUTWARDS
    along = trunks.R_ST.transpose(0, 2, 1) @ np.array([0.0, aside, 1.0])
    return body.arms[side].chain.swing(q, along, steps=steps)


def _backs(problem: HandlingProblem, candidates: Candidates, main: Targets) -> Targets:
    """Where the hand comes from, or goes to, without the object."""
    chosen: list[int] = candidates.option.tolist()
    return main.moved(along_m=np.array([-problem.options[option].back_m for option in chosen]))


def _closely(
    body: Body,
    problem: HandlingProblem,
    checker: Checker,
    group: list[_Entry],
    *,
    tally: Tally,
    last: bool,
) -> Choice | None:
    """The best of a group (of one hand) that passes at all poses and beats the best so far."""
    poses = _all_poses(body, problem, group)
    lines = _lines(body, group, poses, last=last)
    picking = problem.kind == "pick"
    best: Choice | None = None
    for i, entry in enumerate(group):
        turned = float(np.max(np.abs(poses.q[2, i] - poses.q[0, i])))
        if not (poses.met[1, i] and poses.met[2, i]) or turned > MAX_TURN_RAD:
            tally.touched[END] += 1
            continue
        checker.prepare(entry.candidate, entry.side, entry.main)
        touch: str | None = END
        for line in lines:
            touch = checker.on_line(line[0, i], line[1, i])
            if touch is None:
                poses.q[1:3, i] = line[:, i]
                break
        empty: _Way | None = None
        for k in range(3, len(poses.targets)) if touch is None else ():
            if not poses.met[k, i]:
                continue
            # The dear checks only for what beats the best so far.
            draft = _draft(body, problem, entry, poses, (i, k))
            worst = max(tally.score, best.score if best else -np.inf)
            if draft.score <= worst + (
                LIFT_GAIN if best and best.candidate is draft.candidate else 0
            ):
                continue
            empty = empty or _way(checker, draft.back, draft.q_back, coming=picking, last=last)
            touch = empty.touch or checker.lifted(draft.q_up)
            if empty.touch is not None:
                break
            if touch is not None:
                continue
            laden = _way(checker, draft.up, draft.q_up, coming=not picking, last=last)
            touch = laden.touch
            if touch is None:
                come, go = (empty, laden) if picking else (laden, empty)
                whole = replace(draft, q_ready=come.q, q_away=go.q)
                best = _better(best, _swaying(checker, _tight(checker, whole), problem))
        if touch is not None:
            tally.touched[touch] += 1
    return best


def _swaying(checker: Checker, choice: Choice, problem: HandlingProblem) -> Choice:
    """The same, worth less where the arm or the body touches something as the steps sway it."""
    leaving = choice.q_away
    if leaving is None:
        leaving = choice.q_up if problem.kind == "pick" else choice.q_back
    if checker.swaying(choice.q_ready, leaving) is None:
        return choice
    return replace(choice, score=choice.score - SWAY_COST, sways=True)


def _tight(checker: Checker, choice: Choice) -> Choice:
    """The same, worth less where the arm passes things more closely than it is liked to.

    Over an edge it has clearances of its own, and the search there is the longest.
    """
    if checker.lean.last:
        return choice
    lacking_m = ROOMS_M[0] - checker.room_m(choice.q_back, choice.q_up)
    return replace(choice, score=choice.score - TIGHT_COST_PER_M * lacking_m)


def _better(best: Choice | None, other: Choice) -> Choice:
    return other if best is None or other.score > best.score else best


def _lines(body: Body, group: list[_Entry], poses: _Poses, *, last: bool) -> list[Array]:
    """Joints in the middle of the line and at its back, shape (2, n, k): one way, or several.

    Over an edge also with the elbow further up.
    """
    found = [poses.q[1:3]]
    if last:
        n, k = len(group), poses.q.shape[2]
        for _ in range(LINE_SWINGS):
            q = _elbow_up(body, group * 2, found[-1].reshape(2 * n, k), LINE_SWING)
            found.append(q.reshape(2, n, k))
    return found


def _draft(
    body: Body, problem: HandlingProblem, entry: _Entry, poses: _Poses, at: tuple[int, int]
) -> Choice:
    """The choice of a candidate (its index in the group, the lift's in the poses) if it passes."""
    i, k = at
    steady = float(poses.steady[k, i])
    margin = float(np.min(reach.margins(body.arms[entry.side], poses.q[[0, 2, k], i])))
    strain = STRAIN_COST if margin * steady < LEAST_MARGIN else 0.0
    return Choice(
        side=entry.side,
        candidate=entry.candidate,
        option=problem.options[int(entry.candidate.option[0])],
        main=entry.main,
        back=_row(poses.targets[2], i),
        up=_row(poses.targets[k], i),
        q_main=poses.q[0, i],
        q_back=poses.q[2, i],
        q_up=poses.q[k, i],
        q_ready=poses.q[k, i],
        margin=margin * steady,
        steadiness=steady,
        score=margin - float(entry.candidate.cost[0]) - WOBBLE_COST * (1.0 - steady) - strain,
    )


@dataclass(frozen=True, slots=True)
class _Way:
    """Between the standoff and a pose at the stance: what is touched, or joints for it.

    `q` None: the arm may stay as it is at the pose.
    """

    touch: str | None
    q: Array | None


def _way(checker: Checker, target: Targets, q_near: Array, *, coming: bool, last: bool) -> _Way:
    """Stepping in with the hand raised before `target` (`coming`), or straightening up and back.

    Where the arm may not stay as it is while the trunk straightens up, as over an edge, the hand is
    raised first (`last`).
    """
    if coming:
        return _Way(*checker.ready(target, q_near))
    touch = checker.leaving(q_near)
    return _Way(*checker.away(target, q_near)) if touch is not None and last else _Way(touch, None)


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


def _all_poses(body: Body, problem: HandlingProblem, group: list[_Entry]) -> _Poses:
    """Joints for every pose of a group (of one hand), in one batch."""
    side = group[0].side
    candidates = _join([entry.candidate for entry in group])
    trunks = reach.trunks_of(body, side, candidates)
    main = reach.targets_of(candidates, problem.options, problem.references)
    back = _backs(problem, candidates, main)
    targets = [main, Targets(main.R, 0.5 * (main.p + back.p)), back]
    targets += [main.moved(up_m=lift) for lift in problem.lifts_m]
    probed = [0, 2, *range(3, len(targets))]
    exact = body.description.walking.exact_steps
    box = (exact.bears_m, exact.bears_m, exact.bears_rad)
    off = [trunks.wobbled((x * box[0], y * box[1], turn * box[2])) for x, y, turn in reach.WOBBLE]
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
