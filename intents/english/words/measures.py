"""Numbers, and numbers with units: "two and a half metres" is 2.5 m."""

from math import isfinite, pi
from typing import Literal, NamedTuple

_ONES = {
    word: value
    for value, word in enumerate(
        ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
         "eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen",
         "nineteen"]
    )
}  # fmt: skip
_TENS = {
    "twenty": 20, "thirty": 30, "forty": 40, "fourty": 40, "fifty": 50, "sixty": 60,
    "seventy": 70, "eighty": 80, "ninety": 90,
}  # fmt: skip
_GROUPS: dict[tuple[str, ...], float] = {
    ("a", "couple", "of"): 2, ("couple", "of"): 2, ("couple",): 2,
    ("a", "pair", "of"): 2, ("a", "dozen"): 12,
    ("half", "a", "dozen"): 6, ("a", "few"): 3, ("dozen",): 12,
    ("three", "quarters", "of", "a"): 0.75, ("a", "quarter", "of", "a"): 0.25,
    ("three", "quarters", "of", "an"): 0.75, ("a", "quarter", "of", "an"): 0.25,
    ("half", "of", "a"): 0.5, ("half", "a"): 0.5, ("half", "an"): 0.5, ("half",): 0.5,
    ("a", "half"): 0.5, ("one", "half"): 0.5, ("a", "quarter"): 0.25, ("quarter",): 0.25,
    ("a", "single"): 1,
}  # fmt: skip
MeasureKind = Literal["length", "angle", "time", "times", "plain"]
STEP_M = 0.3
"""Length of "a step" of the robot."""
_UNITS: dict[str, tuple[MeasureKind, float]] = {}
_TABLE: tuple[tuple[MeasureKind, float, str], ...] = (
    ("length", 1.0, "m metre metres meter meters"),
    ("length", 0.01, "cm centimetre centimetres centimeter centimeters centi"),
    ("length", 0.001, "mm millimetre millimetres millimeter millimeters"),
    ("length", 1000.0, "km kilometre kilometres kilometer kilometers"),
    ("length", 0.3048, "ft foot feet"), ("length", 0.0254, "inch inches"),
    ("length", 0.9144, "yard yards"), ("length", STEP_M, "step steps pace paces"),
    ("angle", pi / 180, "degree degrees deg degs"), ("angle", 1.0, "rad radian radians rads"),
    ("angle", 2 * pi, "turn turns revolution revolutions rotation rotations circle circles"),
    ("time", 1.0, "s sec secs second seconds"), ("time", 60.0, "min mins minute minutes"),
    ("time", 3600.0, "h hour hours"), ("time", 0.001, "ms millisecond milliseconds"),
    ("times", 1.0, "time times x"),
)  # fmt: skip
for _kind, _factor, _spellings in _TABLE:
    for _spelling in _spellings.split():
        _UNITS[_spelling] = (_kind, _factor)
NUMBER_WORDS = frozenset(_ONES) | frozenset(_TENS) | {"hundred", "thousand", "half", "dozen"}
UNIT_WORDS = frozenset(_UNITS) - {"time", "times", "second", "x", "turn", "step", "circle", "min"}
TIME_WORDS = frozenset(word for word, (kind, _) in _UNITS.items() if kind == "time")


class Number(NamedTuple):
    """A number that ends before word ``end``."""

    value: float
    end: int


class Measure(NamedTuple):
    """A quantity in SI (m, rad, s; times and plain are numbers) that ends before word ``end``."""

    kind: MeasureKind
    value: float
    end: int


_SIZED = frozenset(
    ("full", "whole", "complete", "more", "single", "small", "big", "large", "little", "long",
     "short", "giant", "tiny", "good", "baby", "careful", "slow", "quick")
)  # fmt: skip


def number(words: list[str], start: int) -> Number | None:
    """The number that begins at a word: "7", "2.5", "twenty one", "two and a half", "half a"."""
    for size in (4, 3, 2, 1):
        phrase = tuple(words[start : start + size])
        if phrase in _GROUPS:
            return Number(_GROUPS[phrase], start + len(phrase))
    whole = _whole(words, start)
    if whole and words[whole.end : whole.end + 1] == ["point"]:
        digits, end = _decimals(words, whole.end + 1)
        if digits:
            return Number(float(f"{whole.value:.0f}.{digits}"), end)
    if whole and tuple(words[whole.end : whole.end + 3]) == ("and", "a", "half"):
        return Number(whole.value + 0.5, whole.end + 3)
    return whole


def _decimals(words: list[str], start: int) -> tuple[str, int]:
    """The digits behind a decimal point, and where they end: "seven five", "twenty five", "05"."""
    digits, end = "", start
    while end < len(words):
        word = "zero" if words[end] in ("oh", "o", "nought") else words[end]
        if word in _TENS and words[end + 1 : end + 2] and 0 < _ONES.get(words[end + 1], 0) < 10:
            digits += f"{_TENS[word] + _ONES[words[end + 1]]:.0f}"
            end += 1
        elif word in _ONES or word in _TENS:
            digits += f"{_ONES.get(word, 0) + _TENS.get(word, 0):.0f}"
        elif word.isascii() and word.isdecimal():
            digits += word
        else:
            break
        end += 1
    return digits, end


def _whole(words: list[str], start: int) -> Number | None:
    """Digits, or number words up to thousands."""
    if start >= len(words):
        return None
    if words[start][-1].isdecimal() and words[start].isascii():
        try:
            value = float(words[start])
        except ValueError:
            return None
        return Number(value, start + 1) if isfinite(value) else None  # 1e999 is no figure
    total, value, end = 0.0, 0.0, start
    if words[start] == "a" and words[start + 1 : start + 2] in (["hundred"], ["thousand"]):
        value, end = 1.0, start + 1
    while end < len(words):
        word = words[end]
        if word in _ONES or word in _TENS:
            more = _ONES.get(word, 0) + _TENS.get(word, 0)
            if 0 < value < 10 and 10 <= more < 100:
                value *= 100  # one eighty
            elif value % 100 and not (value % 10 == 0 and more < 10):
                break  # seven five is two numbers
            value += more
        elif word == "hundred" and end > start:
            value = max(value, 1) * 100
        elif word == "thousand" and end > start:
            total, value = total + max(value, 1) * 1000, 0
        elif not (word == "and" and words[end - 1] in ("hundred", "thousand") and end > start
                  and end + 1 < len(words) and words[end + 1] in NUMBER_WORDS):  # fmt: skip
            break
        end += 1
    return Number(total + value, end) if end > start else None


def measure(words: list[str], start: int) -> Measure | None:
    """The quantity that begins at a word: "90 degrees", "a metre and a half", "twice"."""
    if start >= len(words):
        return None
    plain = {"once": 1.0, "twice": 2.0, "thrice": 3.0}.get(words[start])
    if plain:
        return Measure("times", plain, start + 1)
    amount = number(words, start)
    if amount is None and words[start] in ("a", "an", "one"):
        amount = Number(1.0, start + 1)
    if amount is None or amount.end >= len(words):
        return None
    end = amount.end
    if words[end] in _SIZED:
        end += 1
    if end >= len(words) or words[end] not in _UNITS:
        return None
    kind, factor = _UNITS[words[end]]
    value, end = amount.value, end + 1
    if words[end : end + 3] == ["and", "a", "half"]:
        value, end = value + 0.5, end + 3
    return Measure(kind, value * factor, end)
