"""Where to stand so that a hand can be somewhere: many candidates, the likeliest first.

A candidate puts the hand at a distance ahead and to the side of the feet that suits the arm, from
every heading; the floor decides which are free to stand on and to step in to.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

import numpy as np

from robot.messages import Side
from robot.model.handling import Lean, Reaching
from robot.person_distances import CLEAR_M
from robot.planning import numerics
from robot.planning.floor import Floor
from robot.planning.grasps import HandOption
from robot.planning.numerics import Indices, Mask
from robot.planning.requests import BodyPosture, Stance
from robot.se3 import Array

HEADINGS = 24
NARROW_COST_PER_M = 2.0
"""Of a metre nearer to an outline than is roomy."""
TIGHT_COST = 0.25
"""Of a standoff that has only room for the body."""
FAR_COST_PER_M, ASIDE_COST_PER_M = 1.5, 0.8
"""Of a metre that the arm is stretched ahead, or off its best distance to the side."""
TURNS_RAD, TURN_COST_PER_RAD = (-0.4, 0.0, 0.4), 0.12
"""Of the hand, from how it points by itself."""
LAST_TURNS_RAD = (-0.9, -0.4, 0.0, 0.4, 0.9)
"""The same in postures that are tried last: a box that turns its long side to the edge is taken
with the hand along the edge."""
CHUNK = 6000
"""So many stances are looked at together: numpy's overhead is small, few are looked at in vain."""
OPTION_SHARE = 0.5
"""Of the candidates of a posture: so many are kept for every grasp alike, whatever it costs."""
NEAR_PEOPLE_COST = 1.0
"""Of a hand that is raised, or at work, or hangs, within `CLEAR_M` of somebody's outline: within
their zone it stops. Hands hang at the body's sides, and sway up to who stands beside its stance."""
RAISED_AHEAD_M, RAISED_ASIDE_M = 0.30, 0.25
"""About where a raised hand is, from the standoff."""
JITTER = 0.12
"""Random cost that spreads the first candidates."""


def posture_of(lean: Lean, side: Side) -> BodyPosture:
    """How to stand in a lean, with the shoulder of `side` turned forward."""
    sign = -1.0 if side == "left" else 1.0
    return BodyPosture(
        height_m=lean.base_height_m, pitch_rad=lean.pitch_rad, yaw_rad=sign * lean.yaw_rad
    )


class Stage(NamedTuple):
    """Leans that are tried together, each stage where those before it lead nowhere.

    Attributes:
        last: whether they reach over an edge.
        arm: the posture that the inverse kinematics begin in; empty: the robot's own.
    """

    last: bool
    arm: str

    @classmethod
    def of(cls, lean: Lean) -> Stage:
        """Of a lean."""
        return cls(lean.last, lean.arm)


@dataclass(frozen=True, slots=True)
class Candidates:
    """n ways to stand and to have the hand, best first; arrays of shape (n,) or (n, ...).

    Attributes:
        stance: x, y, yaw of S, shape (n, 3).
        standoff_m: how far back the standoff is.
        heading: of the hand in W.
        option, reference, lean: indices.
        left: whether it is the left hand.
        cost: what they cost.
    """

    stance: Array
    standoff_m: Array
    heading: Array
    option: Indices
    reference: Indices
    lean: Indices
    left: Mask
    cost: Array

    def __len__(self) -> int:
        return len(self.cost)

    def side(self, i: int) -> Side:
        """The hand of a candidate."""
        return "left" if self.left[i] else "right"

    def take(self, rows: Indices | Mask) -> Candidates:
        """Some of them."""
        return Candidates(
            *(
                getattr(self, name)[rows]
                for name in (
                    "stance", "standoff_m", "heading", "option", "reference", "lean", "left", "cost"
                )
            )
        )  # fmt: skip

    def stance_of(self, i: int) -> Stance:
        """(x, y, yaw) of the stance."""
        x, y, yaw = (float(value) for value in self.stance[i])
        return (x, y, math.remainder(yaw, 2 * math.pi))

    def standoff_of(self, i: int) -> Stance:
        """(x, y, yaw) of the standoff: straight behind the stance."""
        x, y, yaw = self.stance_of(i)
        back = float(self.standoff_m[i])
        return (x - back * math.cos(yaw), y - back * math.sin(yaw), yaw)


def propose(
    options: list[HandOption],
    references: Array,
    floor: Floor,
    *,
    reaching: Reaching,
    sides: tuple[Side, ...],
    start: Stance,
    radius_m: float,
    reference_cost: Array,
    walk_cost_per_m: float,
    people: Array,
    seed: int,
    stage: Stage,
) -> tuple[Candidates, int]:
    """Candidates that can be stood on and stepped in to, and how many there were before.

    Args:
        options: grasps.
        references: where the object's origin may be, shape (m, 3).
        floor: free space.
        reaching: of the robot.
        sides: hands to use.
        start: where the robot is now.
        radius_m: of the body with its arms, where it turns and walks.
        reference_cost: cost of each reference, shape (m,).
        walk_cost_per_m: cost of walking a metre to the stance.
        people: circles (x, y, radius) that hands keep away from where they can, shape (n, 3).
        seed: of the spread.
        stage: of the search: which leans.
    """
    every = _gathered(options, references, reaching=reaching, sides=sides, stage=stage)
    walk = np.hypot(every.stance[:, 0] - start[0], every.stance[:, 1] - start[1])
    cost = every.cost + reference_cost[every.reference] + walk_cost_per_m * walk
    cost = cost + NEAR_PEOPLE_COST * _is_near(people, references[:, :2])[every.reference]
    cost = cost + NEAR_PEOPLE_COST * _is_near(people, every.stance[:, :2])
    every = replace(every, cost=cost + JITTER * np.random.default_rng(seed).random(len(every)))
    quotas = _Quotas(reaching, stage, options=len(options))
    standoffs = _Standoffs(floor, start, radius_m, reaching)
    return _sieved(every, floor, standoffs, quotas, reaching=reaching, people=people), len(every)


def _gathered(
    options: list[HandOption],
    references: Array,
    *,
    reaching: Reaching,
    sides: tuple[Side, ...],
    stage: Stage,
) -> Candidates:
    """Every way that the leans of a stage have for it, on free floor or not, without standoffs."""
    stances: list[Array] = []
    headings: list[Array] = []
    costs: list[Array] = []
    kinds: list[Indices] = []
    for side, (i, lean), (j, option), (k, reference) in product(
        sides, enumerate(reaching.leans), enumerate(options), enumerate(references)
    ):
        if Stage.of(lean) != stage or reference[2] < lean.from_m:
            continue
        _around(option, reference, side, lean, reaching, into=(stances, headings, costs))
        kinds.append(np.tile([j, k, i, int(side == "left")], (len(costs[-1]), 1)))
    stance, heading, cost = (np.concatenate(part) for part in (stances, headings, costs))
    option_of, reference_of, lean_of, left = np.concatenate(kinds).T
    return Candidates(
        stance=stance,
        standoff_m=np.zeros(len(cost)),
        heading=heading,
        option=option_of,
        reference=reference_of,
        lean=lean_of,
        left=left.astype(bool),
        cost=cost,
    )


def _sieved(
    every: Candidates,
    floor: Floor,
    standoffs: _Standoffs,
    quotas: _Quotas,
    *,
    reaching: Reaching,
    people: Array,
) -> Candidates:
    """Those that can be stood on and stepped in to, as many of each kind as there is a quota for.

    They are gone through from the cheapest, and what the floor costs comes on top.
    """
    order, cost = np.argsort(every.cost, kind="stable"), every.cost.copy()
    beside = np.array([bool(lean.hand_rad) for lean in reaching.leans])
    kept: list[Indices] = []
    backs: list[Array] = []
    for first in range(0, len(every), CHUNK):
        rows = order[first : first + CHUNK]
        rows = rows[quotas.open_to(every.lean[rows], every.option[rows])]
        clearance = floor.clearances_m(every.stance[rows, :2])
        cost[rows] += NARROW_COST_PER_M * np.maximum(0.0, reaching.roomy_m - clearance)
        rows = rows[clearance >= reaching.narrow_m]
        back, tight = standoffs.lengths(every.stance[rows], beside=beside[every.lean[rows]])
        cost[rows[tight]] += TIGHT_COST
        rows, back = rows[back > 0.0], back[back > 0.0]
        sign = np.where(every.left[rows], 1.0, -1.0)
        raised = _raised(every.stance[rows], back, sign)
        cost[rows] += NEAR_PEOPLE_COST * _is_near(people, raised)
        inside = quotas.take(every.lean[rows], every.option[rows])
        kept.append(rows[inside])
        backs.append(back[inside])
        if quotas.are_used_up:
            break
    rows, standoff_m = np.concatenate(kept), np.concatenate(backs)
    again = np.argsort(cost[rows], kind="stable")
    rows, standoff_m = rows[again], standoff_m[again]
    return replace(every.take(rows), standoff_m=standoff_m, cost=cost[rows])


class _Quotas:
    """How many candidates are still wanted: of each lean, a share of them of every grasp alike."""

    def __init__(self, reaching: Reaching, stage: Stage, *, options: int) -> None:
        quotas = [lean.quota if Stage.of(lean) == stage else 0 for lean in reaching.leans]
        self._left, self._options = np.array(quotas), options
        each = (OPTION_SHARE * self._left / options).astype(int)
        self._shares = np.repeat(each, options)
        self._left -= self._shares.reshape(len(quotas), -1).sum(axis=1)

    @property
    def are_used_up(self) -> bool:
        """Whether no more are wanted."""
        return not self._left.any() and not self._shares.any()

    def open_to(self, lean: Indices, option: Indices) -> Mask:
        """Of which candidates some are wanted still, shape (n,)."""
        return (self._left[lean] > 0) | (self._shares[lean * self._options + option] > 0)

    def take(self, lean: Indices, option: Indices) -> Mask:
        """Which of these are taken, first come first; they count from now on."""
        inside = _within(lean * self._options + option, self._shares)
        others = np.flatnonzero(~inside)
        inside[others] = _within(lean[others], self._left)
        return inside


def _within(kinds: Indices, left: Indices) -> Mask:
    """Which rows are among the first `left` of their kind, shape (n,), bool; counts `left` down."""
    result = np.zeros(len(kinds), dtype=bool)
    for kind in range(len(left)):
        rows = np.flatnonzero(kinds == kind)[: left[kind]]
        result[rows] = True
        left[kind] -= len(rows)
    return result


def _around(
    option: HandOption,
    reference: Array,
    side: Side,
    lean: Lean,
    reaching: Reaching,
    *,
    into: tuple[list[Array], list[Array], list[Array]],
) -> None:
    """Stances (n, 3), hand headings (n,) and costs (n,) of one combination, appended to lists."""
    sign = 1.0 if side == "left" else -1.0
    turns_rad = LAST_TURNS_RAD if lean.last else TURNS_RAD
    asides_m = lean.aside_m or reaching.aside_m
    grid = np.array(list(product(lean.ahead_m, asides_m, lean.hand_rad or turns_rad)))
    if lean.hand_rad:
        best_aside_m = float(np.mean(asides_m))
        beta = sign * grid[:, 2]
        grid[:, 2] -= np.mean(lean.hand_rad)
    else:
        best_aside_m = reaching.best_aside_m
        inward = reaching.inward_rad - reaching.inward_rad_m * grid[:, 1]
        beta = -sign * inward * (0.5 if lean.pitch_rad else 1.0) + grid[:, 2]
    if option.headings is None:
        repeats = HEADINGS
        yaw = np.repeat(numerics.even(0.0, 2 * math.pi, HEADINGS + 1)[:-1], len(beta))
        heading = yaw + np.tile(beta, repeats)
    else:
        repeats = len(option.headings)
        heading = np.repeat(np.array(option.headings), len(beta))
        yaw = heading - np.tile(beta, repeats)
    ahead, aside, turn = np.tile(grid, (repeats, 1)).T
    ch, sh, c, s = np.cos(heading), np.sin(heading), np.cos(yaw), np.sin(yaw)
    px = reference[0] + ch * option.offset[0] - sh * option.offset[1]
    py = reference[1] + sh * option.offset[0] + ch * option.offset[1]
    y = sign * aside
    upright = lean.pitch_rad == 0.0 and not lean.hand_rad
    far = np.maximum(0.0, ahead - reaching.far_m) if upright else 0.0
    into[0].append(np.stack([px - c * ahead + s * y, py - s * ahead - c * y, yaw], axis=1))
    into[1].append(heading)
    into[2].append(
        option.cost
        + lean.cost
        + FAR_COST_PER_M * far
        + ASIDE_COST_PER_M * np.abs(aside - best_aside_m)
        + TURN_COST_PER_RAD * np.abs(turn)
    )


def _raised(stance: Array, back_m: Array, sign: Array) -> Array:
    """About where the raised hand is over the floor at the standoffs, shape (n, 2)."""
    c, s = np.cos(stance[:, 2]), np.sin(stance[:, 2])
    ahead, aside = RAISED_AHEAD_M - back_m, RAISED_ASIDE_M * sign
    return stance[:, :2] + np.stack([c * ahead - s * aside, s * ahead + c * aside], axis=1)


def _is_near(people: Array, points: Array) -> Mask:
    """Which points of the floor are too near to somebody for a hand, shape (n,)."""
    far_m = np.hypot(*(points[:, None, :] - people[None, :, :2]).transpose(2, 0, 1))
    return (far_m < people[None, :, 2] + CLEAR_M).any(axis=1)


class _Standoffs:
    """Lengths of the last straight steps, from places that can be walked to.

    A place with room for the arm is preferred to one that only has room for the body; beside an
    edge, one with room for an arm that goes up and over it.
    """

    def __init__(self, floor: Floor, start: Stance, radius_m: float, reaching: Reaching) -> None:
        self._floor = floor
        self._reaching = reaching
        self._radius = radius_m
        self._labels = floor.regions(radius_m)
        self._home = floor.home(self._labels, start[0], start[1])

    def lengths(self, stance: Array, *, beside: Mask) -> tuple[Array, Mask]:
        """The first length that leads to such a place (0: none), and if it is tight, shape (n,)."""
        result = np.zeros(len(stance))
        tight = np.zeros(len(stance), dtype=bool)
        back = -np.stack([np.cos(stance[:, 2]), np.sin(stance[:, 2])], axis=1)
        for room in (self._reaching.over_room_m, self._reaching.arm_room_m, self._radius):
            over = room == self._reaching.over_room_m
            for length in self._reaching.step_in_m:
                rows = np.flatnonzero((result == 0.0) & (beside | (not over)))
                at = stance[rows, :2] + length * back[rows]
                label = self._floor.label_at(self._labels, at)
                free = (label > 0) & ((label == self._home) if self._home else True)
                free &= self._floor.clearances_m(at) >= room
                result[rows[free]] = length
                tight[rows[free]] = room == self._radius
        return result, tight
