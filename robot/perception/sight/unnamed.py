"""What stands somewhere and has no name: it is in the way, and may be what somebody asks for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from robot.messages import Shape, Unnamed
from robot.perception.sight.tracking import Seen
from robot.se3 import SE3

LEAST_LOOKS = 2
"""Before that it may be nothing."""
BESIDE_M = 0.02
"""What is so near to a thing that has a name, besides their half widths, is a part of it."""


def unnamed(
    tracks: Iterable[Seen], named: Mapping[int, str], may_be: Mapping[int, tuple[str, ...]]
) -> tuple[Unnamed, ...]:
    """Things without a name, as they were seen.

    Args:
        tracks: all that is believed to stand somewhere.
        named: names by number.
        may_be: ids of told things that those without a name may be, by number.
    """
    tracks = tuple(tracks)
    others = [one for one in tracks if one.number in named]
    return tuple(
        _told(one, may_be.get(one.number, ()))
        for one in tracks
        if one.number not in named
        and one.free_looks >= LEAST_LOOKS
        and not any(_is_part(one, other) for other in others)
    )


def _is_part(one: Seen, other: Seen) -> bool:
    apart_m = float(np.linalg.norm((one.p_W - other.p_W)[:2]))
    return apart_m < BESIDE_M + 0.5 * float(max(one.size_m[:2]) + max(other.size_m[:2]))


def _told(track: Seen, may_be: tuple[str, ...]) -> Unnamed:
    x, y, z, width_m = (max(0.005, float(value)) for value in track.size_m)
    colour = f"{track.colours[0]} " if track.colours else ""
    longest_cm = 100.0 * max(width_m, z)
    size_m = (width_m, width_m, z) if track.roundness > 0.0 else (x, y, z)
    x_m, y_m, _ = track.p_W.tolist()
    return Unnamed(
        id=f"unnamed_{track.number}",
        words=f"{colour}thing of {longest_cm:.0f} cm",
        X_WO=SE3.from_xy_yaw(x_m, y_m, track.last.yaw_rad)
        @ SE3((0.0, 0.0, track.last.foot_m + 0.5 * z)),
        shape=Shape(kind="cylinder" if track.roundness > 0.0 else "box", size_m=size_m),
        seen_s=track.seen_s,
        may_be=may_be,
        near=track.near_looks > 0,
    )
