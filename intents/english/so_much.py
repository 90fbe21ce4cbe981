"""A goal cut short: after so much of it, or half of it."""

from math import hypot, pi

from msgspec.structs import replace

from intents.english.words.measures import Measure
from intents.goals import Balance, Goal, GoTo, Repeat, Wait


def ended_after(goal: Goal, amount: Measure, *, said: bool) -> Goal | None:
    """A goal that ends after so much of it, or as it was to end if that is less.

    Args:
        goal: The goal.
        amount: So much is enough.
        said: Whether it was said how much was asked for; else the amount is all that was.
    """
    if amount.value <= 0:
        return None
    if isinstance(goal, GoTo) and goal.by is not None:
        whole = _size(goal, amount.kind)
        share = amount.value / whole if whole else 0.0
        turned_around = amount.kind == "angle" and whole > pi / 2 + 1e-3
        share = min(share, 1.0) if said or turned_around else share
        return _by_share(goal, share) if whole else None
    if isinstance(goal, Balance | Wait) and amount.kind == "time":
        longest = goal.duration_s if said and goal.duration_s is not None else amount.value
        return replace(goal, duration_s=min(longest, amount.value))
    if isinstance(goal, Repeat) and amount.kind == "times":
        return replace(goal, times=min(goal.times, round(amount.value)))
    return None


def _size(goal: GoTo, kind: str) -> float:
    """How far a walk leads [m] or a turn turns [rad]; 0 for what is neither or both."""
    by = goal.by
    if by is None:
        return 0.0
    walk_m = hypot(by.forward_m or 0.0, by.left_m or 0.0)
    turn_rad = abs(by.turn_rad or 0.0)
    if kind == "length":
        return walk_m
    return turn_rad if kind == "angle" and not walk_m else 0.0


def _by_share(goal: GoTo, share: float) -> GoTo | None:
    by = goal.by
    if by is None:
        return None
    walks = bool(by.forward_m or by.left_m)
    part = replace(
        by,
        forward_m=by.forward_m and round(by.forward_m * share, 6),
        left_m=by.left_m and round(by.left_m * share, 6),
        turn_rad=by.turn_rad if walks else by.turn_rad and round(by.turn_rad * share, 6),
    )
    return replace(goal, by=part)


def halved(goal: Goal) -> Goal | None:
    """Half of a walk, a turn, or of the time of a posture."""
    if isinstance(goal, GoTo) and goal.by is not None:
        return _by_share(goal, 0.5)
    if isinstance(goal, Balance | Wait) and goal.duration_s is not None:
        return replace(goal, duration_s=goal.duration_s / 2)
    return None
