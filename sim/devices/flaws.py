"""What is asked to be wrong with emulated motors, and whether that can be."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from robot.errors import Problem
from robot.files.misfits import nearest


def unknown(
    flaws: Mapping[str, str], *, joints: Collection[str], known: Sequence[str]
) -> list[Problem]:
    """Joints and flaws that there are not, each with the nearest.

    Args:
        flaws: what is wrong with whom, by joint.
        joints: of the map.
        known: flaws of their family.
    """
    problems: list[Problem] = []
    for name, flaw in flaws.items():
        if name not in joints:
            cure = nearest(name, list(joints))
            problems.append(Problem(f"there is no joint {name!r}", suggestion=cure))
        if flaw not in known:
            cure = nearest(flaw, list(known)) or f"one of {', '.join(known)}"
            problems.append(Problem(f"unknown flaw {flaw!r}", suggestion=cure))
    return problems
