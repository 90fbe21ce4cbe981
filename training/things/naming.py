"""Learns the namer: what a crop shows, where the middle of it is, how large it is."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from robot.perception.things import crops
from robot.perception.things.inputs import Floats, Sight, sight, tensor
from robot.perception.things.instances import HALF, instances
from robot.perception.things.networks import Finder
from training.things import graphs, misfits, networks, resuming
from training.things.frames import Frame, load
from training.things.networks import Learnt
from training.things.splits import kinds
from training.things.working import each

UNKNOWN, NOTHING = "", "nothing"
CLASSES = (*kinds("train"), UNKNOWN, NOTHING)
GRAPH = graphs.namer(len(CLASSES))
MOST_RATE, AGAIN_RATE = 2e-3, 1e-3
"""From the start, and where it is gone on."""
PLACE_M, SIZE_M = 0.05, 0.1
"""Units of places and sizes in the answers."""
LEAST_PX = 25
LEAST_SHARE, LEAST_OVERLAP, PURE = 0.4, 0.3, 0.65
"""Of the pixels of what was found a thing has at least so much, overlaps it so much (intersection
over union), or it is none; and where it has less than PURE, it is several at once."""
UPRIGHT_COS = 0.7
SOME = 512
"""Crops that say what a namer does that is gone on from."""


class Manner(NamedTuple):
    """How the namer learns.

    Attributes:
        smooth: share of a crop's weight that goes to all classes alike (label smoothing). It blurs
            how sure the namer is, by which known things are told from those of no kind.
        misfits: share of known things that are shown at sizes that they never have, as of no kind.
    """

    smooth: float
    misfits: float


USUAL = Manner(smooth=0.03, misfits=0.0)
"""That of the namer that is shipped."""


class Learned(NamedTuple):
    """A crop with what should be said of it.

    Attributes:
        crop: the crop.
        name: number of its class.
        place: of its middle, along, across, up; size: long, short, high; both in their units.
        is_upright: whether its own axis is up.
        has_place: whether there is a thing whose place and size that is.
        thing: which of the picture's things it is; -1: none.
        pixels: how many show the thing.
    """

    crop: crops.Crop
    name: int
    place: np.ndarray
    size: np.ndarray
    is_upright: float
    has_place: float
    thing: int
    pixels: int


def matched(frame: Frame, pixels: np.ndarray) -> tuple[int, bool]:
    """Which thing of a picture some pixels show, -1 for none; and whether several at once."""
    who = frame.who[pixels]
    counts = np.bincount(who[who >= 0], minlength=len(frame.truth.kinds))
    thing = int(counts.argmax())
    total = int(pixels.sum())
    joined = total + frame.truth.pixels[thing] - counts[thing]
    if counts[thing] < LEAST_SHARE * total or counts[thing] < LEAST_OVERLAP * joined:
        return -1, False
    others = counts.sum() - counts[thing]
    return thing, bool(others > (1.0 - PURE) * total)


def learned(frame: Frame, seen: Sight, pixels: np.ndarray, score: float) -> Learned | None:
    """A crop of a picture's thing, or of none; None if it has no depth or is not worth it."""
    cut = crops.crop(seen, pixels, score)
    if cut is None:
        return None
    thing, is_several = matched(frame, pixels)
    truth = frame.truth
    if thing < 0:
        share = float((frame.who[pixels] >= 0).mean())
        if share > 0.15:
            return None  # a part of something: neither a thing nor none
        none = np.zeros(3, dtype=np.float32)
        return Learned(cut, CLASSES.index(NOTHING), none, none, 0.0, 0.0, -1, 0)
    kind = truth.kinds[thing]
    name = CLASSES.index(kind) if kind in CLASSES and not is_several else CLASSES.index(UNKNOWN)
    place = cut.R_WS.T @ (truth.p_W[thing] - cut.p_W) / PLACE_M
    x, y, z = truth.size_m[thing].tolist()
    size = np.array([max(x, y), min(x, y), z]) / SIZE_M
    upright = float(abs(truth.R_WO[thing][2, 2]) > UPRIGHT_COS)
    return Learned(cut, name, place.astype(np.float32), size.astype(np.float32), upright,
                   float(not is_several), thing, int(truth.pixels[thing]))  # fmt: skip


def lessons(
    frames: Iterable[Frame], finder: Callable[[Floats], Floats], rng: np.random.Generator
) -> Iterator[Learned]:
    """Crops of what the finder finds, and of things as they are, half a pixel more or less."""
    for frame in frames:
        seen = sight(frame.image, frame.X_WC)
        assert seen is not None
        for one in instances(finder(tensor(seen)), seen.depth_m.shape):
            if (made := learned(frame, seen, one.pixels, one.score)) is not None:
                yield made
        for thing in np.flatnonzero(frame.truth.pixels >= LEAST_PX).tolist():
            if rng.random() < 0.5:
                mask = _coarse(frame.who == thing)
                made = learned(frame, seen, mask, float(rng.uniform(0.7, 1.0)))
                if made is not None:
                    yield made


def _coarse(mask: np.ndarray) -> np.ndarray:
    """A mask as the finder could have it: of each four pixels all or none."""
    small = mask.reshape(mask.shape[0] // HALF, HALF, mask.shape[1] // HALF, HALF).any(axis=(1, 3))
    return small.repeat(HALF, axis=0).repeat(HALF, axis=1)


class Lessons(NamedTuple):
    """Many of them, in arrays."""

    planes: Any
    numbers: Any
    names: Any
    rest: Any
    """Place, size, upright, whether there is a place: shape (n, 8)."""


def taught(files: list[Path], finder: Path, *, seed: int, jobs: int = 1) -> Lessons:
    """What scenes have to teach to who finds things with a finder."""
    made = each(partial(_taught, finder, seed), files, name="cut things out", jobs=jobs)
    parts = zip(*(one for one in made if one is not None), strict=True)
    return Lessons(*(np.concatenate(part) for part in parts))


def _taught(finder: Path, seed: int, path: Path) -> Lessons | None:
    rng = np.random.default_rng([seed, int(path.stem)])
    made = list(lessons(load(path), _finder(finder), rng))
    return gathered(made) if made else None


@cache
def _finder(path: Path) -> Finder:
    return Finder(path)


def gathered(made: Iterable[Learned]) -> Lessons:
    """In arrays; planes at half precision."""
    planes, numbers, names, rest = [], [], [], []
    for one in made:
        planes.append(one.crop.planes.astype(np.float16))
        numbers.append(one.crop.numbers)
        names.append(one.name)
        rest.append(np.concatenate([one.place, one.size, [one.is_upright, one.has_place]]))
    return Lessons(np.stack(planes), np.stack(numbers), np.array(names, np.int32),
                   np.stack(rest).astype(np.float32))  # fmt: skip


def without(given: Lessons, left_out: tuple[str, ...]) -> Lessons:
    """Lessons without things of some kinds: who learns from them never sees one."""
    kept = ~np.isin(given.names, [CLASSES.index(kind) for kind in left_out])
    return Lessons(*(part[kept] for part in given))


def loss(smooth: float, weights: Any, even: Any, batch: Any) -> Any:
    """Of names (cross-entropy), places (as unlikely as they are), sizes and which way up."""
    said, even = networks.run(
        GRAPH, weights, even,
        {graphs.IMAGE: batch["planes"], graphs.NUMBERS: batch["numbers"]}, learns=True,
    )  # fmt: skip
    count = len(CLASSES)
    wanted = jax.nn.one_hot(batch["names"], count) * (1.0 - smooth) + smooth / count
    named = -(wanted * jax.nn.log_softmax(said[:, :count])).sum(axis=-1).mean()
    rest, there = batch["rest"], batch["rest"][:, 7]
    spread = jnp.clip(said[:, count + 3 : count + 6], -6.0, 4.0)
    off = (said[:, count : count + 3] - rest[:, :3]) ** 2
    placed = (0.5 * (off * jnp.exp(-spread) + spread)).sum(axis=-1)
    sized = jnp.abs(said[:, count + 6 : count + 9] - rest[:, 3:6]).sum(axis=-1)
    odds = said[:, count + 9]
    stands = jax.nn.softplus(odds) - rest[:, 6] * odds
    total = (there * (0.3 * jnp.minimum(placed, 20.0) + sized + 0.3 * stands)).mean()
    return named + total, even


def learn(
    given: Lessons,
    *,
    steps: int,
    batch: int,
    seed: int,
    minutes: float = math.inf,
    since: Path | None = None,
    manner: Manner = USUAL,
) -> Iterator[tuple[float, Learnt]]:
    """The loss of each step, and what was learnt until then; `since`: a namer to go on from."""
    rng = np.random.default_rng(seed)
    state = networks.first(GRAPH, graphs.NAMER_IN, seed)
    fits = jnp.asarray(misfits.fitting(CLASSES))
    one = networks.step(partial(loss, manner.smooth), partial(varied, fits, manner.misfits))
    if since is not None:
        some = rng.choice(len(given.names), min(SOME, len(given.names)), replace=False)
        shown = {graphs.IMAGE: given.planes[some].astype(np.float32),
                 graphs.NUMBERS: given.numbers[some]}  # fmt: skip
        state = resuming.read(since, GRAPH, shown)
    held, order, at = jax.device_put(given), rng.permutation(len(given.names)), 0
    most = MOST_RATE if since is None else AGAIN_RATE
    before: Any = None
    for number, rate in enumerate(networks.rates(steps, most, minutes)):
        if at + batch > len(order):
            order, at = rng.permutation(len(given.names)), 0
        chosen, at = order[at : at + batch], at + batch
        state, value = one(state, rate, held, chosen, jax.random.key(number))
        # Of the step before: to ask for this one's would have the accelerator wait.
        yield float(value if before is None else before), state
        before = value


def varied(fits: Any, share: float, given: Lessons, chosen: Any, key: Any) -> dict[str, Any]:
    """Some of them, mirrored or not, in other light, with other noise, a pixel aside.

    A share of what is of a kind is shown at a size that it never has, and is of none then
    (`misfits`).
    """
    count, keys = len(chosen), jax.random.split(key, 7)
    planes, rest = given.planes[chosen].astype(jnp.float32), given.rest[chosen]
    turned = jax.random.bernoulli(keys[0], 0.5, (count,))
    planes = jnp.where(turned[:, None, None, None], planes[:, :, ::-1], planes)
    rest = rest.at[:, 1].multiply(jnp.where(turned, -1.0, 1.0))
    gain = 0.12 * jax.random.normal(keys[1], (count, 1, 1, 3))
    gain += 0.15 * jax.random.normal(keys[2], (count, 1, 1, 1))
    colours = jnp.clip((planes[..., :3] + 0.5) * jnp.exp(gain), 0.0, 1.0) - 0.5
    depths = planes[..., 4] + planes[..., 6] * (0.04 * jax.random.normal(keys[3], planes.shape[:3]))
    planes = planes.at[..., :3].set(colours).at[..., 4].set(depths)
    aside = jax.random.randint(keys[4], (2,), -2, 3)
    planes = jnp.roll(planes, (aside[0], aside[1]), axis=(1, 2))
    numbers = given.numbers[chosen]
    numbers += 0.02 * jax.random.normal(keys[5], numbers.shape)
    log = misfits.drawn(fits, given.names[chosen], share, keys[6])
    batch = misfits.resized({"planes": planes, "numbers": numbers, "rest": rest}, log)
    names = jnp.where(log != 0.0, CLASSES.index(UNKNOWN), given.names[chosen])
    return {**batch, "names": names}
