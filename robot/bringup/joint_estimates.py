"""What a joint's motion says of its friction, its delay and its backlash: numbers in, numbers out.

Friction: swept there and back at a steady speed, a joint takes half of what the torques of both
ways differ by, at the same angles; what its weight takes is the same both ways. Coulomb's is what
is left of that at no speed.

Delay and backlash: under a torque that is turned round at once, a joint goes along one parabola
before and along another after (but for what its friction, its weight and its springs bend them).
Where both have the same slope is when the torque was turned at the joint; by how much one lies
beside the other there is what the encoder went with no motion of the joint: the play of the gear,
from flank to flank.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from robot.errors import DriverError
from robot.se3 import Array

BINS = 12
"""Parts of a sweep whose torques are compared with those of the way back."""
LEAST_SAMPLES, LEAST_REVERSALS = 5, 8
BEFORE_SHARE, AFTER_SHARES = 0.35, (0.15, 0.45)
"""Of half a period of the torque: what is looked at before it is turned, and after. Between these
it comes into force; in the middle of a half the joint turns round, and friction with it."""


class Sweep(NamedTuple):
    """A way at a steady speed (rad/s, signed): angles and torques, shape (k,) each."""

    speed: float
    q: Array
    tau: Array


class Reversal(NamedTuple):
    """A torque that was turned: to which side, and angles q at times after it was told, (k,)."""

    side: float
    after_s: Array
    q: Array


class Estimate(NamedTuple):
    """A value, and one standard error of it."""

    value: float
    error: float


class Friction(NamedTuple):
    """Coulomb's (N m), the viscous one (N m s/rad), and what weight and springs take there.

    `pull_nm_rad` is how fast the torque that holds it grows along the way.
    """

    coulomb: Estimate
    viscous: Estimate
    weight_nm: float
    pull_nm_rad: float

    def at(self, away_rad: float, speed: float) -> float:
        """The torque that keeps a speed, so far from the middle."""
        rubs_nm = self.coulomb.value * np.sign(speed) + self.viscous.value * speed
        return float(self.weight_nm + self.pull_nm_rad * away_rad + rubs_nm)


def friction(sweeps: Sequence[Sweep]) -> Friction:
    """Out of sweeps both ways at two speeds or more.

    Raises:
        DriverError: too little came in.
    """
    speeds = sorted({abs(sweep.speed) for sweep in sweeps})
    found = {speed: _halves(sweeps, speed) for speed in speeds}
    if len(speeds) < 2 or any(len(one) < LEAST_SAMPLES for one in found.values()):
        raise DriverError("too few angles were swept both ways (is the bus losing replies?)")
    x = np.concatenate([np.full(len(found[speed]), speed) for speed in speeds])
    y = np.concatenate([found[speed] for speed in speeds])
    rows = np.stack([np.ones_like(x), x], axis=1)
    (coulomb, viscous), *_ = np.linalg.lstsq(rows, y, rcond=None)
    spread = float(np.std(y - rows @ [coulomb, viscous]))
    errors = spread * np.sqrt(np.diag(np.linalg.inv(rows.T @ rows)))
    q, tau = (np.concatenate([getattr(one, name) for one in sweeps]) for name in ("q", "tau"))
    sides = np.concatenate([np.full(len(one.q), one.speed) for one in sweeps])
    rows = np.stack([np.ones_like(q), q - q.mean(), np.sign(sides), sides], axis=1)
    (weight_nm, pull_nm_rad, *_), *_ = np.linalg.lstsq(rows, tau, rcond=None)
    return Friction(
        Estimate(float(coulomb), float(errors[0])),
        Estimate(float(viscous), float(errors[1])),
        float(weight_nm),
        float(pull_nm_rad),
    )


def _halves(sweeps: Sequence[Sweep], speed: float) -> Array:
    """Half of what the torques of both ways differ by, by part of the way."""
    ways = [
        (np.concatenate(q), np.concatenate(tau))
        for side in (1.0, -1.0)
        for q, tau in [_of(sweeps, side * speed)]
        if q
    ]
    if len(ways) != 2:
        return np.empty(0)
    low, high = max(q.min() for q, _ in ways), min(q.max() for q, _ in ways)
    edges: Array = low + (high - low) / BINS * np.arange(BINS + 1)
    means: list[Array] = []
    for q, tau in ways:
        which = np.digitize(q, edges) - 1
        means.append(
            np.array(
                [tau[which == k].mean() if (which == k).any() else np.nan for k in range(BINS)]
            )
        )
    halves = 0.5 * (means[0] - means[1])
    return halves[np.isfinite(halves)]


def _of(sweeps: Sequence[Sweep], speed: float) -> tuple[list[Array], list[Array]]:
    mine = [sweep for sweep in sweeps if sweep.speed == speed]
    return [sweep.q for sweep in mine], [sweep.tau for sweep in mine]


class Turned(NamedTuple):
    """Delay (s), play (rad), the acceleration (rad/s^2) that the torque led to."""

    delay_s: Estimate
    play_rad: Estimate
    acceleration: float


class _Window(NamedTuple):
    """A stretch under a steady torque: times, angles, their integral and the integral of that."""

    t: Array
    parts: Array


def turned(
    reversals: Sequence[Reversal], half_s: float, *, push_nm: float, rubs: Friction
) -> Turned:
    """Out of many reversals of a torque.

    Under a steady torque, v' = a - (viscous v + pull q) / inertia; so q, with as much of its
    integrals added, is a parabola.

    Args:
        reversals: of it.
        half_s: half its period.
        push_nm: it, to each side.
        rubs: what sweeps said.

    Raises:
        DriverError: too little came in, or the joint hardly moved.
    """
    found = [(one.side, pair) for one in reversals if (pair := _windows(one, half_s)) is not None]
    if len(found) < LEAST_REVERSALS:
        raise DriverError("too few replies came (look at the bus for lost frames)")
    nm = np.array([max(0.0, rubs.viscous.value), rubs.pull_nm_rad])
    seen = _seen(found, np.zeros(2), half_s)
    for _ in range(3):  # inertia and what is added depend on one another, a little
        seen = _seen(found, nm * seen.acceleration / push_nm, half_s)
    return seen


def is_whole(reversal: Reversal, half_s: float) -> bool:
    """Whether enough replies came around it for `turned`."""
    return _windows(reversal, half_s) is not None


def _seen(
    found: Sequence[tuple[float, tuple[_Window, _Window]]], shares: Array, half_s: float
) -> Turned:
    """By how much is added of each integral."""
    kinks = [
        kink
        for side, (before, after) in found
        if (kink := _kink(side, before, after, shares, half_s)) is not None
    ]
    if len(kinks) < LEAST_REVERSALS:
        raise DriverError("the joint hardly moved (give it more --torque)")
    delays, plays, gains = np.array(kinks).T
    return Turned(_middle(delays), _middle(plays), float(np.median(gains)))


def _windows(reversal: Reversal, half_s: float) -> tuple[_Window, _Window] | None:
    """Before the torque is turned, and after; None where too few replies came."""
    _, t, q = reversal
    if len(t) < 2:
        return None
    once = _integral(t, q - q.mean())
    parts = np.stack([q, once, _integral(t, once)], axis=1)
    before = (t > -BEFORE_SHARE * half_s) & (t <= 0.0)
    after = (t > AFTER_SHARES[0] * half_s) & (t < AFTER_SHARES[1] * half_s)
    if min(int(before.sum()), int(after.sum())) < LEAST_SAMPLES:
        return None
    return _Window(t[before], parts[before]), _Window(t[after], parts[after])


def _integral(t: Array, values: Array) -> Array:
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(t)
    return np.concatenate(([0.0], np.cumsum(steps)))


def _kink(
    side: float, before: _Window, after: _Window, shares: Array, half_s: float
) -> tuple[float, float, float] | None:
    """When the torque was turned at the joint, how far the encoder jumped, the acceleration."""
    weights = np.array([1.0, *shares])
    old, new = (np.polyfit(one.t, one.parts @ weights, 2) for one in (before, after))
    more = 2.0 * (new[0] - old[0])
    if side * more <= 0.0:
        return None
    jump = at_s = 0.0
    for _ in range(3):  # the jump is no motion, but its part in the sum above has a slope, too
        at_s = float((old[1] - new[1] + shares[0] * jump) / more)
        jump = float(np.polyval(new, at_s) - np.polyval(old, at_s))
    if not -AFTER_SHARES[0] * half_s <= at_s <= 2 * AFTER_SHARES[0] * half_s:
        return None
    return at_s, side * jump, abs(more) / 2.0


def _middle(values: Array) -> Estimate:
    """The mean of the middle half, which a few bad ones do not move; and its standard error."""
    low, high = np.percentile(values, (10, 90))
    kept = values[(values >= low) & (values <= high)]
    return Estimate(float(kept.mean()), float(kept.std() / np.sqrt(len(kept))))
