"""An amount or a side that takes the place of the one asked for: "no, three times", "sorry, right".

It names nothing, so it is about the last thing that was asked with such an amount.
"""

from __future__ import annotations

import re
from math import copysign

from msgspec.structs import replace

from intents.allowed import MAX_TIMES
from intents.english.words.lexer import tokenize
from intents.english.words.measures import Measure, measure
from intents.goals import Balance, Displacement, Gesture, Goal, GoTo, Repeat, Wait

_BEFORE = (
    r"(?:(?:oh|no|nope|not|actually|rather|i mean|i meant|i said|make (?:it|that)|sorry|oops|wait|"
    r"pardon|whoops|correction|better|on second thoughts?)\b[\s,;:.!–—-]*)+"
    r"(?:(?:only|just|for|to the)\s+)*"
)
_AFTER = r"[\s,]+(?:instead|rather|i mean|i meant|please)"
_SAID = re.compile(
    rf"\W*(?:(?P<before>{_BEFORE})(?P<what>.+?)(?:{_AFTER})*|(?P<alone>.+?)(?:{_AFTER})+)\W*",
    re.IGNORECASE,
)
_SIDE = re.compile(r"(?:to |on )?(?:the |your )?(left|right)(?: (?:one|side|hand|arm|leg))?")
_LONGEST = 60


def amended(text: str, goals: tuple[Goal, ...]) -> tuple[Goal, ...] | None:
    """The goals with another amount, or to the other side; None if nothing of the kind is said."""
    found = _SAID.fullmatch(text) if len(text) <= _LONGEST and goals else None
    if found is None:
        return None
    said = (found["what"] or found["alone"]).lower().strip()
    side = _SIDE.fullmatch(said)
    words = [token.text for token in tokenize(said)]
    amount = measure(words, 0) if words else None
    whole = amount if amount is not None and amount.end == len(words) else None
    for at in reversed(range(len(goals))):
        other = _other_side(goals[at], side[1]) if side else whole and _other(goals[at], whole)
        if other is not None:
            return (*goals[:at], other, *goals[at + 1 :])
    return None


def _other(goal: Goal, amount: Measure) -> Goal | None:
    """The goal with another amount of the same kind."""
    match goal, amount.kind:
        case Repeat(), "times" if _is_often(amount):
            return replace(goal, times=int(amount.value))
        case Gesture() | Balance(), "times" if _is_often(amount):
            return Repeat(times=int(amount.value), goals=(goal,))
        case Wait() | Balance(), "time":
            return replace(goal, duration_s=amount.value)
        case GoTo(by=Displacement() as by), "length" | "angle":
            changed = _as_far(by, amount)
            return None if changed is None else replace(goal, by=changed)
        case _:
            return None


def _is_often(amount: Measure) -> bool:
    return amount.value == int(amount.value) and 1 <= amount.value <= MAX_TIMES


def _as_far(by: Displacement, amount: Measure) -> Displacement | None:
    """The same way, as far as is said."""
    names = ("turn_rad",) if amount.kind == "angle" else ("forward_m", "left_m")
    for name in names:
        was = getattr(by, name)
        if was:
            return replace(by, **{name: copysign(abs(amount.value), was)})
    return None


def _other_side(goal: Goal, side: str) -> Goal | None:
    """The same to the left, or to the right."""
    sign = 1.0 if side == "left" else -1.0
    match goal:
        case GoTo(by=Displacement(turn_rad=float() as turn_rad) as by):
            return replace(goal, by=replace(by, turn_rad=copysign(turn_rad, sign)))
        case GoTo(by=Displacement(left_m=float() as left_m) as by):
            return replace(goal, by=replace(by, left_m=copysign(left_m, sign)))
        case Gesture(kind=kind) if kind.startswith(("raise_", "lower_")):
            changed = re.sub(r"_(?:(?:left|right)_)?arm$", f"_{side}_arm", kind)
            return replace(goal, kind=changed) if kind.endswith("_arm") else None
        case Gesture(side="left" | "right") | Balance(side="left" | "right"):
            return replace(goal, side=side)
        case _:
            return None
