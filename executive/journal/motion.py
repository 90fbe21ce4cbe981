"""How everything moved in a run, as it was believed: one line for every tick in which it did.

`motion.jsonl` stands beside the journal, and is written and cut off in the same way. It is what the
console and films are drawn from; whoever watches a robot at work reads it as it grows, so that
nothing that becomes of a watcher can reach the robot.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import msgspec

from robot.files.ordinary_files import open_ordinary
from robot.se3 import SE3

FILE = "motion.jsonl"
MAX_LINE = 64_000
"""Bytes of a line; one in which all the things of a furnished flat are new has 5 kB."""
MOST_BYTES = 500_000_000
"""Of a file that is read at all: a robot that walks all day."""
MOST_MOMENTS = 200_000
"""Kept of a run: some three hours in which something moves all the time."""

Flat = tuple[float, float, float, float, float, float, float]
"""A pose: x, y, z [m], and the quaternion w, x, y, z."""


class Moment(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What is believed at one tick.

    Attributes:
        t_s: the runtime's time.
        base: X_WB.
        q: joint positions in the order of the robot's motors [rad], of fingers [m].
        objects: X_WO of those that are elsewhere than before, by id; None: nobody knows any more.
        people: the same of people.
        held: ids of what the hands hold, when that is new.
        charge: of the battery, as a part of the whole.
        late: share of the controller's periods that were late since it reported before.
    """

    t_s: float
    base: Flat
    q: tuple[float, ...]
    objects: dict[str, Flat | None] = {}
    people: dict[str, Flat | None] = {}
    held: tuple[str, ...] | None = None
    charge: float | None = None
    late: float | None = None


_DECODER = msgspec.json.Decoder(Moment)


def flat(X: SE3) -> Flat:
    """A pose to the millimetre and the tenth of a milliradian."""
    x, y, z = (round(float(one), 3) for one in X.p)
    a, b, c, d = (round(float(one), 4) for one in X.quat_wxyz)
    return (x, y, z, a, b, c, d)


def encode(moment: Moment) -> bytes:
    """A moment as its line, without the line's end."""
    return msgspec.json.encode(moment, order="deterministic")


def decode(line: bytes) -> Moment | None:
    """The moment of a line; None if it is none, such as a line that was cut."""
    try:
        return _DECODER.decode(line)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return None


def read(folder: Path) -> Iterator[Moment]:
    """The moments of a run in the order of time, as far as they make sense.

    Raises:
        OSError: if there is no such file; `strerror` says why.
    """
    last_s = -math.inf
    with open_ordinary(folder / FILE) as source:
        taken = 0
        while (line := source.readline(MAX_LINE)) and taken < MOST_BYTES:
            taken += len(line)
            moment = decode(line)
            if moment is not None and moment.t_s > last_s:
                last_s = moment.t_s
                yield moment


def last_s(folder: Path) -> float:
    """Time of the last moment that was written there, -inf if there is none."""
    with suppress(OSError), open_ordinary(folder / FILE) as source:
        source.seek(max(0, os.fstat(source.fileno()).st_size - 2 * MAX_LINE))
        for line in reversed(source.read(2 * MAX_LINE).split(b"\n")):
            moment = decode(line)
            if moment is not None:
                return moment.t_s
    return -math.inf
