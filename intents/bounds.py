"""Bounds: "no faster than 0.2 m/s", "whichever is blue", and how long: "a minute".

They limit an order as much as its own words do. One that comes back in no goal is asked about,
whichever reading passed it over and whoever made the goals, so that it holds for every front end.
"""

import re
from collections.abc import Iterable

from intents.english.faithfulness import numbers, strings
from intents.english.words import lexicon
from intents.english.words.lexer import singular, tokenize
from intents.english.words.measures import UNIT_WORDS, measure, number
from intents.goals import Answer, Ask, Count, Goal, GoTo, If, Report, Say, Tell, each
from intents.spans import unkept_span

_AMOUNTS = r"more|less|fewer|further|farther|longer|greater"
_DEGREES = (
    r"faster|quicker|slower|closer|nearer|higher|lower|louder|softer|quieter|earlier|later|harder|"
    r"tighter|wider|deeper|bigger|smaller|heavier|lighter|taller|shorter"
)
_DENIED = (
    r"(?:\b(?:not?|never|nothing|without)|n['’]?t)\b(?:\W+(?:any|much|it|(?:go|get|come|be|move|walk"
    r"|run|step|stand|stay|turn)(?:t?ing|n?ing)?|exceeding)\b)*"
)
_TAIL = r"[^,;:!?—–]*?(?=[,;:!?—–]|\.(?!\d)|\s(?:and|then|but)\s|$)"
_BOUNDS = re.compile(
    rf"(?P<degree>(?:{_DENIED}\W+)?\b(?:{_DEGREES})\s+than\b{_TAIL})"
    rf"|(?P<amount>(?:{_DENIED}\W+)?\b(?:{_AMOUNTS})\s+than\b{_TAIL})"
    rf"|(?P<most>\b(?:at (?:the )?(?:most|least|maximum|minimum)|up to|maximum|minimum|max|min"
    rf"|not (?:exceeding|above|over|below|under|beyond|past)|without exceeding)\s+{_TAIL})"
    rf"|(?P<choice>(?<=[,–—])\s*(?:whichever|whoever|whatever)\b{_TAIL}"
    rf"|\bwhichever\s+(?:one\s+)?(?:of\s+\w+\s+)?(?:is|are|has|looks|seems|weighs|comes)\b{_TAIL})",
    re.IGNORECASE,
)
_FREE = re.compile(
    r"\w+\s+(?:(?:one|of (?:them|these|those)|\w+)\s+)?"
    r"(?:you|suits|works|will do|does|it takes|happens)\b",
    re.IGNORECASE,
)
"""Whichever *you like* leaves the choice to the robot."""
_SPEED = re.compile(
    r"\b(?:m/s|km/?h|mph|(?:metres?|meters?|cm|m|km|kilomet(?:re|er)s?) (?:per|an?|/) "
    r"(?:s|sec|second|hour|minute)s?)\b",
    re.IGNORECASE,
)
_UNIT = "|".join(sorted(UNIT_WORDS | {"step", "second", "mph"}))
_AMOUNT = re.compile(
    rf".*?\bthan\b.*?(?<![a-z])(?:{_UNIT})\b(?:\s*(?:/|per|an?)\s*(?:{_UNIT})\b)?", re.IGNORECASE
)
"""A bound up to its amount."""
_OF_ONESELF = re.compile(
    r"\b(?:i|he|she|we|they)\s+(?:really\s+|just\s+)?(?:can(?:no|['’])?t|could(?:n['’]t| not)|"
    r"must(?:n['’]t| not)|may not|should(?:n['’]t| not)|am not (?:allowed|supposed) to)\s+"
    r"(?:carry|lift|eat|drink|walk|reach|bear|climb|wear|sit|stand|hold|pick up|manage|see|hear|go|"
    r"sleep|work|run)\b[^,;:!?—–.]*$",
    re.IGNORECASE,
)
"""I mustn't carry anything *heavier than a book*: what who speaks cannot do."""
_LINK = re.compile(r"[\s,;:–—-]*\b(?:but|and|though|only)?\s*$", re.IGNORECASE)
"""What leads on to a bound."""
_TELLING = (Answer, Ask, Count, If, Report, Say, Tell)
_SAME = 1e-3
_LINKS = lexicon.words(
    "whichever whoever whatever one is are of them these those the a an that looks seems comes was"
)


def unkept(text: str, goals: Iterable[Goal]) -> str:
    """The bound or span in a text that comes back in none of the goals; empty if there is none."""
    every = list(each(tuple(goals)))
    if not every or tells(every):
        return ""
    span = unkept_span(text, numbers(every))
    if span:
        return span
    for found in _BOUNDS.finditer(text):
        if _OF_ONESELF.search(text[: found.start()]):
            continue
        said = found.group().strip(" .\n\t")
        kind = found.lastgroup
        if kind == "choice":
            kept = _FREE.match(said) or _chosen(said, every)
        else:
            kept = kind != "degree" and not _SPEED.search(said) and _counted(said, every)
        if not kept:
            return said
    return ""


def tells(goals: Iterable[Goal]) -> bool:
    """Whether goals carry what is compared or quoted themselves."""
    return any(isinstance(goal, _TELLING) for goal in each(tuple(goals)))


def loosened(text: str) -> tuple[str, str]:
    """A text without its first "no closer than 1 m" or the like, and that; both empty without one.

    What comes behind the amount is left: "go no closer than 1 m *to the table*".
    """
    degrees = (one for one in _BOUNDS.finditer(text) if one.lastgroup == "degree")
    of_order = (one for one in degrees if not _OF_ONESELF.search(text[: one.start()]))
    found = next(of_order, None)
    if found is None:
        return "", ""
    said = found.group().strip(" .\n\t")
    amount = _AMOUNT.match(said)
    end = found.start() + (amount.end() if amount else len(found.group()))
    said = amount.group().strip() if amount else said
    begin = _LINK.sub("", text[: found.start()])
    return f"{begin}{text[end:]}".strip(" ,;.!?"), said


def _counted(said: str, goals: list[Goal]) -> bool:
    """Whether a bound is the amount that a goal carries."""
    words = _words(said)
    found = [measure(words, at) or number(words, at) for at in range(len(words))]
    amounts = [one.value for one in found if one is not None]
    if not amounts and said.casefold().startswith("up to"):
        return True  # her elbows
    carried = numbers(goal for goal in goals if not (isinstance(goal, GoTo) and goal.pose))
    return any(abs(one - abs(amount)) < _SAME for amount in amounts for one in carried)


def _chosen(said: str, goals: list[Goal]) -> bool:
    """Whether what a thing is chosen by comes back: "whichever is blue" as a blue one."""
    told = {word for value in strings(goals) for word in re.split(r"[\s_-]+", value)}
    told |= {singular(word) for word in told}
    asked = [word for word in _words(said) if word not in _LINKS]
    tables = (lexicon.COLORS, lexicon.SIZES, lexicon.COMPARATIVES)
    forms = [{word, singular(word), *(table.get(word, word) for table in tables)} for word in asked]
    return bool(asked) and all(told & form for form in forms)


def _words(said: str) -> list[str]:
    return [token.text for token in tokenize(said) if token.text[0].isalnum()]
