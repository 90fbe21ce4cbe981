"""Known things at sizes that they never have: each looks as a kind does, and is none of it.

A crop tells of lengths in metres beside the picture. All of them times one factor is what a camera
would see of the same thing larger or smaller, that much further away or nearer; so a crop of a
known thing gives as many things of no kind as there are factors, with the forms, prints and colours
of real ones. Only sizes tell them apart from it: they have to be learnt to count.
"""

from __future__ import annotations

import math
from typing import Any

import jax
import jax.numpy as jnp
import msgspec
import numpy as np

from robot.perception.things.crops import DEPTHS, HEIGHTS, UNIT_M
from sim.things import catalogue
from sim.things.making import sized
from training.things.likes import are_alike
from training.things.splits import STRANGERS

LEAST, MOST, STEPS = 0.13, 0.45, 8
"""Logarithm of the factor; things of a kind differ by up to 0.06. Steps of it, for `fitting`."""
WINDOW, AWAY, FOOT, WIDE, HIGH, TILT = 0, 1, 2, 3, 4, 6
"""Which of a crop's numbers (`crops.crop`) are of lengths, and which is how far down it looks."""
AWAY_M = 1.0
"""What is taken off the distance in a crop's numbers."""
DEPTH, HEIGHT = 4, 5
"""Which of a crop's planes are lengths."""


def fitting(names: tuple[str, ...]) -> np.ndarray:
    """Where a kind that is so much smaller or larger is like none of the names.

    Args:
        names: of classes; what is of no kind fits nowhere.

    Returns:
        Whether it may be shown so, shape (names, 2 STEPS): factors from 1 / e^MOST to 1 / e^LEAST,
        then from e^LEAST to e^MOST.
    """
    known = {name: kind for name, kind in catalogue.kinds().items() if name not in STRANGERS}
    logs = np.linspace(LEAST, MOST, STEPS)
    found = np.zeros((len(names), 2 * STEPS), dtype=bool)
    for row, name in enumerate(names):
        if name not in known:
            continue
        for column, log in enumerate((*-logs[::-1], *logs)):
            form = sized(known[name].of, math.exp(log), math.exp(log))
            other = msgspec.structs.replace(known[name], of=form)
            # A tin as high and wide as a mug is no mug: prints and openings stay what they are.
            same = (kind for kind in known.values() if type(kind.of) is type(other.of))
            found[row, column] = not any(are_alike(other, kind) for kind in same)
    return found


def drawn(fits: Any, names: Any, share: float, key: Any) -> Any:
    """Logarithms of factors, 0 for those that stay as they are, shape (n,).

    Args:
        fits: of every class (`fitting`).
        names: of the crops, as numbers, shape (n,).
        share: of those that may be of another size, how many are.
        key: of chance.
    """
    which, how = jax.random.split(key)
    column = jax.random.randint(how, names.shape, 0, 2 * STEPS)
    logs = jnp.linspace(LEAST, MOST, STEPS)
    log = jnp.concatenate([-logs[::-1], logs])[column]
    is_one = jax.random.bernoulli(which, share, names.shape) & fits[names, column]
    return jnp.where(is_one, log, 0.0)


def resized(batch: dict[str, Any], log: Any) -> dict[str, Any]:
    """Crops with all lengths times e^log, their names left as they are.

    Args:
        batch: planes, numbers and rest, as `naming.varied` has them.
        log: of the factors, shape (n,).
    """
    factor = jnp.exp(log)[:, None]
    planes, numbers, rest = batch["planes"], batch["numbers"], batch["rest"]
    for plane, limits in ((DEPTH, DEPTHS), (HEIGHT, HEIGHTS)):
        was = planes[..., plane]
        now = jnp.clip(was * factor[..., None], *limits)
        # What was beyond the limits stays there: else a background would tell that it is smaller.
        is_inside = (was > limits[0]) & (was < limits[1])
        planes = planes.at[..., plane].set(jnp.where(is_inside, now, was))
    away = numbers[:, AWAY] + AWAY_M
    below = 0.5 * UNIT_M * numbers[:, HIGH] * jnp.cos(numbers[:, TILT])  # of the middle: its foot
    lower = (factor[:, 0] - 1.0) * (away * jnp.sin(numbers[:, TILT]) + below)
    numbers = numbers.at[:, WINDOW].add(log)
    numbers = numbers.at[:, AWAY].set(away * factor[:, 0] - AWAY_M).at[:, FOOT].add(-lower)
    numbers = numbers.at[:, WIDE : HIGH + 1].multiply(factor)
    return {**batch, "planes": planes, "numbers": numbers, "rest": rest.at[:, :6].multiply(factor)}
