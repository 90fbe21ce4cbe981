"""Things that are looked at on the way to them: what several looks together make of their names."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from robot.perception.things.eyes import Eyes
from robot.perception.things.naming import Classes, Sure
from robot.perception.things.votes import Sighted, Votes
from training.things.frames import Frame
from training.things.judging import KNOWN, UNKNOWN, sort
from training.things.naming import matched
from training.things.splits import family


class Walk(NamedTuple):
    """What came of one.

    Attributes:
        kind: of the thing.
        track: what was made of it; None: it was not found.
        off_m: how far that is from where it is.
    """

    kind: str
    track: Sighted | None
    off_m: float


def walks(eyes: Eyes, pictures: Iterable[list[Frame]]) -> list[Walk]:
    """Look on the way to things, picture by picture."""
    return [_walk(eyes, frames) for frames in pictures if frames]


def _walk(eyes: Eyes, frames: list[Frame]) -> Walk:
    votes, target, track = Votes(), frames[0].target, None
    for frame in frames:
        seen = eyes.look(frame.image, frame.X_WC)
        for one, its in zip(seen, votes.add(seen), strict=True):
            if matched(frame, one.pixels)[0] == target:
                track = its
    truth = frames[-1].truth
    off_m = 0.0 if track is None else float(np.linalg.norm(track.p_W - truth.p_W[target]))
    return Walk(truth.kinds[target], track, off_m)


def sure_voted(some: list[Walk], classes: Classes, sure: Sure, *, most_wrong: float) -> float:
    """From which probability on at most such a share of the things gets a wrong kind.

    Not less than one look needs: eight that are wrong in the same way are surer than each of them.
    """
    names = [(one, one.track.name(classes, Sure(sure.kind, 2.0))) for one in some if one.track]
    told = [
        (name.score, sort(one.kind) == KNOWN and name.kind == one.kind)
        for one, name in names
        if name.kind
    ]
    bad = 0
    for score, is_right in sorted(told, reverse=True):
        bad += not is_right
        if bad > most_wrong * len(some):
            return float(np.nextafter(score, 2.0))
    return sure.kind


def told(some: list[Walk], classes: Classes, sure: Sure) -> str:
    """A line of figures."""
    found = [(one, one.track.name(classes, sure)) for one in some if one.track is not None]
    known = [(one, name) for one, name in found if sort(one.kind) == KNOWN]
    there = max(1, sum(sort(one.kind) == KNOWN for one in some))
    right = sum(name.kind == one.kind for one, name in known)
    wrong = sum(bool(name.kind) and name.kind != one.kind for one, name in known)
    kin = sum(not name.kind and name.family == family(one.kind) for one, name in known)
    others = ", ".join(
        f"{of} {sum(bool(name.kind) for one, name in found if sort(one.kind) == of)} of "
        f"{sum(sort(one.kind) == of for one in some)}"
        for of in UNKNOWN
    )
    off_mm = [1e3 * one.off_m for one, _ in found] or [0.0]
    median, high = np.percentile(off_mm, (50, 95)).tolist()
    return (
        f"walks, sure {sure.kind:.5f}: {there} known, right {right / there:.3f}, wrong "
        f"{wrong / there:.4f}, family only {kin / there:.3f}; named: {others}; found {len(found)}; "
        f"place median {median:.1f} mm, 95 % {high:.1f} mm"
    )
