"""What a skill is asked to do: grounded, typed, checked. Ids and numbers, never sentences.

The parameters of a skill stand in its own file; here is what they have in common.
"""

from __future__ import annotations

import math

import msgspec

MAX_DURATION_S = 600.0
MAX_TEXT = 1000
"""Characters of a text that is said aloud."""


class SkillParams(msgspec.Struct, frozen=True, kw_only=True, tag=True, forbid_unknown_fields=True):
    """Parameters of one skill. Building one checks it.

    Raises:
        ValueError: a number is out of range, or not exactly one of the alternatives is given.
    """


def exactly_one(parameters: SkillParams, *names: str) -> None:
    """Check that one of several fields is given.

    Raises:
        ValueError: none is, or more than one.
    """
    given = [name for name in names if getattr(parameters, name) is not None]
    if len(given) != 1:
        raise ValueError(f"give exactly one of {', '.join(names)} (given: {given or 'none'})")


def finite(*values: float) -> None:
    """Check that numbers are numbers.

    Raises:
        ValueError: one is infinite, or not a number.
    """
    if not all(math.isfinite(value) for value in values):
        raise ValueError(f"not a finite number among {values}")


def sayable(text: str) -> None:
    """Check that a text is short enough to be said.

    Raises:
        ValueError: it is longer than `MAX_TEXT`.
    """
    if len(text) > MAX_TEXT:
        raise ValueError(f"text of {len(text)} characters: at most {MAX_TEXT}")


def within(name: str, value: float, limit: float) -> None:
    """Check that a number is at most `limit` away from 0.

    Raises:
        ValueError: it is further away, or not a number.
    """
    if not -limit <= value <= limit:
        raise ValueError(f"{name} must be {-limit:g} to {limit:g}, not {value}")


def lasting(duration_s: float) -> None:
    """Check that a span is one that a person may ask for.

    Raises:
        ValueError: it is negative, longer than `MAX_DURATION_S`, or not a number.
    """
    if not 0.0 <= duration_s <= MAX_DURATION_S:
        raise ValueError(f"duration_s must be 0 to {MAX_DURATION_S:g}, not {duration_s}")
