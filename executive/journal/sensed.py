"""What was sensed and planned in a run, as far as people look at it: a line when there is news.

`sensed.jsonl` stands beside `motion.jsonl` and is written, cut off and read in the same way: the
lidar's scans, torques and temperatures of the motors, what the camera recognises, the way that is
planned, the landings of the feet, and what arms and hands are about to do.
"""

from __future__ import annotations

from typing import Literal

import msgspec

from executive.journal.motion import Flat
from robot.messages import Side

FILE = "sensed.jsonl"
MAX_LINE = 128_000
"""Bytes of a line; a plan of an arm has 3 kB."""
MOST_BYTES = 500_000_000
"""Of a file that is read at all."""
MOST_LINES = 200_000
"""Kept of a run: some nine hours."""

Planar = tuple[float, float, float]
"""x, y [m] and heading [rad] in the world."""


class Scan(msgspec.Struct, frozen=True, kw_only=True):
    """A scan of the lidar: `ranges_mm` uint16, little-endian, counter-clockwise; 0: no hit."""

    from_rad: float
    step_rad: float
    ranges_mm: bytes


class Reach(msgspec.Struct, frozen=True, kw_only=True):
    """A grasp that was chosen, or where something is to be put.

    Attributes:
        kind: to take something, or to put it down.
        side: of the hand.
        thing: id of the object.
        hand: X_WG before, at, and after it.
        stance: where to stand for it.
    """

    kind: Literal["pick", "place"]
    side: Side
    thing: str
    hand: tuple[Flat, Flat, Flat]
    stance: Planar


class ArmMotion(msgspec.Struct, frozen=True, kw_only=True):
    """A motion of an arm that was planned: positions of some motors over time from now.

    Attributes:
        side: of the arm.
        motors: their places in the order of the robot's motors.
        times_s: of the positions.
        positions: of each of the motors at these times [rad].
        clear_m: what the path keeps from things that are not nearer at its ends, 0 if not known.
    """

    side: Side
    motors: tuple[int, ...]
    times_s: tuple[float, ...]
    positions: tuple[tuple[float, ...], ...]
    clear_m: float = 0.0


class Sensed(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What is new at one tick; what is left out is as it was.

    Attributes:
        t_s: the runtime's time.
        torque: of the motors, in their order [N m], of fingers [N].
        heat: of their windings [°C].
        scan: of the lidar, as the robot stood at `t_s`.
        sees: ids of what the camera recognises now.
        source: who says so: "oracle" where it is the simulation.
        way: stances to pass, as planned; empty: there is no way any more.
        steps: landings that are planned: 0 (left) or 1, x, y, heading.
        reach: what a hand is to do; `no_reach`: nothing any more.
        arm: what an arm is about to do.
    """

    t_s: float
    torque: tuple[float, ...] = ()
    heat: tuple[float, ...] = ()
    scan: Scan | None = None
    sees: tuple[str, ...] | None = None
    source: str = ""
    way: tuple[Planar, ...] | None = None
    steps: tuple[tuple[int, float, float, float], ...] | None = None
    reach: Reach | None = None
    no_reach: bool = False
    arm: ArmMotion | None = None


_DECODER = msgspec.json.Decoder(Sensed)


def encode(sensed: Sensed) -> bytes:
    """It as its line, without the line's end."""
    return msgspec.json.encode(sensed, order="deterministic")


def decode(line: bytes) -> Sensed | None:
    """What a line says; None if it is none, such as a line that was cut."""
    try:
        return _DECODER.decode(line)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return None
