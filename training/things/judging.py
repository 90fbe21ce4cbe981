"""How well things are found, named and placed: figures by the size of a thing in pixels."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from robot.perception.things.eyes import Eyes, SeenThing
from robot.perception.things.naming import Classes, Sure
from training.things.frames import Frame
from training.things.invented import INVENTED
from training.things.naming import UPRIGHT_COS, matched
from training.things.splits import STRANGERS, family

SIZES_PX = (25, 40, 100, 300, 1_000_000)
NEAR_M, FAR_M = 1.2, 2.5
COLOURS = {
    "steel": "gray", "cream": "white", "charcoal": "black", "oak": "brown", "walnut": "brown",
    "worktop": "gray",
}  # fmt: skip
"""Words of the catalogue that a picture does not tell apart from others."""


KNOWN, PUT_TOGETHER, NEVER_LEARNT, MADE_UP = "known", "no kind", "kinds never learnt", "invented"
UNKNOWN = (PUT_TOGETHER, NEVER_LEARNT, MADE_UP)


class Look(NamedTuple):
    """A thing of a picture with what was made of it, or something that was seen where none is.

    Attributes:
        kind: of the catalogue; empty: it has none; "nothing": there is no thing.
        pixels: that show it.
        range_m: from the camera.
        seen: what was made of it; None: nothing.
        error_m: of its place, along x, y, z.
        colour: its word.
        is_upright: whether it stands.
        is_whole: whether all that could be seen of it is in the picture.
        is_double: whether it was seen once already in this picture.
    """

    kind: str
    pixels: int
    range_m: float
    seen: SeenThing | None
    error_m: np.ndarray | None = None
    colour: str = ""
    is_upright: bool = True
    is_whole: bool = True
    is_double: bool = False


def looks(frame: Frame, found: list[SeenThing]) -> list[Look]:
    """What came of one picture."""
    truth, eye = frame.truth, np.array(frame.X_WC.p)
    best: dict[int, SeenThing] = {}
    told: list[Look] = []
    for seen in found:
        thing, _ = matched(frame, seen.pixels)
        if thing < 0 and (frame.who[seen.pixels] >= 0).mean() < 0.15:
            told.append(Look("nothing", 0, seen.range_m, seen))
        elif thing in best or thing < 0:  # a part of a thing
            told.append(Look("nothing", 0, seen.range_m, seen, is_double=True))
        else:
            best[thing] = seen
    for thing in np.flatnonzero(truth.pixels >= SIZES_PX[0]).tolist():
        mask = frame.who == thing
        whole = not (mask[0].any() or mask[-1].any() or mask[:, [0, -1]].any())
        seen = best.get(thing)
        error_m = None if seen is None else seen.p_W - truth.p_W[thing]
        colour = COLOURS.get(truth.colors[thing], truth.colors[thing])
        upright = abs(float(truth.R_WO[thing][2, 2])) > UPRIGHT_COS
        away_m = float(np.linalg.norm(truth.p_W[thing] - eye))
        told.append(Look(truth.kinds[thing], int(truth.pixels[thing]), away_m, seen, error_m,
                         colour, upright, whole))  # fmt: skip
    return told


def looked(eyes: Eyes, frames: Iterable[Frame]) -> list[Look]:
    """What came of many pictures."""
    return [one for frame in frames for one in looks(frame, eyes.look(frame.image, frame.X_WC))]


class Counts(NamedTuple):
    """Shares of some things at one threshold, of those that were there."""

    there: int
    found: float
    right: float
    wrong: float
    family: float
    wrong_family: float
    f1: float


def counts(some: list[Look], eyes: Eyes, sure: Sure) -> Counts:
    """What became of the names; F1 is of kinds, what is named where nothing is counts as wrong."""
    known = _known(some)
    right = wrong = right_family = wrong_family = false = 0
    for one in some:
        if one.seen is None:
            continue
        name = eyes.namer.classes.name(one.seen.chances, sure, one.seen.size_m)
        if name.kind and name.kind == one.kind:
            right += 1
        elif name.kind:
            wrong, false = wrong + (one.kind != "nothing"), false + 1
        elif name.family and family(one.kind) == name.family:
            right_family += 1
        elif name.family:
            wrong_family += one.kind != "nothing"
    there = [one for one in some if one.kind != "nothing"]
    count = max(1, len(there))
    return Counts(
        len(there), sum(one.seen is not None for one in there) / count, right / count,
        wrong / count, right_family / count, wrong_family / count,
        2 * right / max(1, right + false + len(known)),
    )  # fmt: skip


def best_f1(some: list[Look], eyes: Eyes) -> float:
    """The threshold of kinds with the greatest F1."""
    steps = np.linspace(0.2, 0.95, 16).tolist()
    return max(steps, key=lambda one: counts(some, eyes, Sure(one, 2.0)).f1)


def within(some: list[Look], most_m: float, least_px: int = 100) -> list[Look]:
    """Whole things up to a range, of so many pixels; with what was seen where none is."""
    return [one for one in some if one.range_m <= most_m and one.is_whole
            and (one.kind == "nothing" or one.pixels >= least_px)]  # fmt: skip


def calibrated(some: list[Look], classes: Classes, *, most_wrong: float) -> Sure:
    """From which probabilities on at most such a share of the things gets a wrong name."""
    kinds: list[tuple[float, bool]] = []
    kin: list[tuple[float, bool]] = []
    for one in some:
        if one.seen is None:
            continue
        has_name = one.kind != "nothing" and sort(one.kind) == KNOWN
        kind = classes.name(one.seen.chances, Sure(0.0, 2.0), one.seen.size_m)
        kinds.append((kind.score, has_name and kind.kind == one.kind))
        of = classes.name(one.seen.chances, Sure(2.0, 0.0), one.seen.size_m)
        kin.append((of.score, has_name and of.family == family(one.kind)))
    most = most_wrong * max(1, len(some))
    return Sure(_least(kinds, most), _least(kin, most))


def _least(told: list[tuple[float, bool]], most: float) -> float:
    """From which score on at most so many of what was told, each right or not, is wrong."""
    bad, least = 0, 1.0
    for score, is_right in sorted(told, reverse=True):
        bad += not is_right
        if bad > most:
            break
        least = score
    return min(max(least, 0.5), 0.995)


def report(some: list[Look], eyes: Eyes, f1_at: float) -> str:
    """Tables for a page."""
    sure = eyes.namer.sure
    lines = [f"sure: kind {sure.kind:.3f}, family {sure.family:.3f}; F1 at {f1_at:.2f}", ""]
    head = ("pixels", "things", "found", "right", "wrong", "family", "wrong family")
    lines += ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for most_m in (NEAR_M, FAR_M):
        for low, high in itertools.pairwise(SIZES_PX):
            part = [one for one in _known(within(some, most_m, low)) if one.pixels < high]
            lines.append(_row(f"from {low}, up to {most_m} m", counts(part, eyes, sure)))
        every = within(some, most_m)
        lines.append(_row(f"all from 100, up to {most_m} m", counts(_known(every), eyes, sure)))
        f1 = counts(every, eyes, Sure(f1_at, 2.0)), counts(every, eyes, sure)
        lines.append(f"F1 up to {most_m} m: {f1[0].f1:.3f}; as sure as it ships {f1[1].f1:.3f}")
    for name in UNKNOWN:
        part = [one for one in within(some, FAR_M) if sort(one.kind) == name]
        at = counts(part, eyes, sure)
        text = f"{name}: {at.there}, found {at.found:.3f}, named a kind {at.wrong:.4f}, "
        lines.append(f"{text}a family, right {at.family:.3f}, wrong {at.wrong_family:.4f}")
    lines += _places(some)
    named = [one for one in within(some, FAR_M) if one.seen is not None]
    alarms = [one for one in some if one.kind == "nothing" and not one.is_double]
    hits = [one.colour in one.seen.colours for one in named if one.seen and one.colour]
    first = [one.colour == one.seen.colours[0] for one in named if one.seen and one.colour]
    up = [(one.seen.upright > 0.5) == one.is_upright for one in named if one.seen]
    text = f"colour among words {np.mean(hits):.3f}, the first {np.mean(first):.3f}; "
    lines.append(f"{text}upright right {np.mean(up):.3f}; seen where nothing is {len(alarms)}")
    return "\n".join(lines)


def sort(kind: str) -> str:
    """Of which sort a thing is: of a known kind, or why it should get no name."""
    if kind.startswith(INVENTED):
        return MADE_UP
    if kind in STRANGERS:
        return NEVER_LEARNT
    return KNOWN if kind else PUT_TOGETHER


def _known(some: list[Look]) -> list[Look]:
    """Things of kinds that were learnt."""
    return [one for one in some if one.kind != "nothing" and sort(one.kind) == KNOWN]


def _row(name: str, at: Counts) -> str:
    return f"| {name} | {at.there} | " + " | ".join(f"{100 * v:.1f} %" for v in at[1:6]) + " |"


def _places(some: list[Look]) -> list[str]:
    """Errors of places, and how they fit what was said of them."""
    lines: list[str] = []
    for most_m in (NEAR_M, FAR_M):
        part = [one for one in within(some, most_m) if one.seen is not None]
        off = [1e3 * float(np.linalg.norm(one.error_m)) for one in part if one.error_m is not None]
        sigmas = np.array(mahalanobis(part))
        if off:
            median, high = np.percentile(off, (50, 95)).tolist()
            lines.append(f"place up to {most_m} m: median {median:.1f} mm, 95 % {high:.1f} mm; "
                         f"within 2.8 sigma (95 % due) {np.mean(sigmas < 2.8):.3f}")  # fmt: skip
    return lines


def mahalanobis(some: list[Look]) -> list[float]:
    """Errors of places over what was said of them."""
    return [
        float(np.sqrt(one.error_m @ np.linalg.solve(one.seen.covariance_W, one.error_m)))
        for one in some
        if one.seen is not None and one.error_m is not None
    ]
