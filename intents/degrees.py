"""How far, how much of it and with whom something is to be done, where no goal says that.

A door is opened or closed, a device on or off, and what is carried the robot carries by itself:
"open it *halfway*", "turn the heater *up*", "carry it *with me*", "*what is left of* the cheese"
are asked about, whatever reading passed that over.
"""

import re
from collections.abc import Iterable, Sequence

from intents.english.words.lexer import words_in
from intents.english.words.names import NameIndex
from intents.goals import (
    Bring,
    Close,
    Give,
    Goal,
    Open,
    Pick,
    Place,
    Say,
    Switch,
    each,
)

_PARTLY = re.compile(
    r"\b(?:open|close|shut|pull|push|draw|leave|crack|prop)\b[^,.;:!?]*?"
    r"\b(half ?way|half (?:open|closed|shut|down|up)|a (?:crack|touch|fraction|tiny bit|little bit|"
    r"bit)|slightly|ajar|partly|partially|an? \w+ (?:cm|inch(?:es)?|centimetres?)|an inch)\b"
)
_MORE_OR_LESS = re.compile(
    r"\b(?:turn|crank|put|switch|whack|ramp|push|bring)\b(?: (?!on\b|off\b)\w+){1,4}? "
    r"(up|down)\b(?! (?:on|onto|to the|in)\b)"
    r"|\b(?:turn|crank|ramp) (up|down)\b"
    r"|\b(louder|quieter|hotter|cooler|warmer|brighter|dimmer)\b"
    r"|\b((?:to|at|on) (?:low|high|medium|maximum|minimum|max|full|half|mark \w+|number \w+|"
    r"gas mark \w+|\d+(?: degrees| percent|%|°)?))(?=\W*(?:$|[,.;:!?]|and\b|please\b))"
)
_REST = re.compile(r"\b(what(?:ever)?(?:['’]s| is| was| are)(?: still)? left of)\b")
_MOMENT = re.compile(
    r"\b((?:at|towards?|by|before) the (?:end|start|beginning|close) of (?:the |my |our |his )?\w+)"
)
"""At the end of *the sermon*: a time, where the thing is read as what something lies beside."""
_CARRIES = r"(?:carry|lift|move|take|haul|drag|bring|get|fetch|lug|shift|heave|push|hoist)"
_TOGETHER = re.compile(
    rf"\b{_CARRIES}\b[^,.;:!?]*\b((?:together )?with (?:me|us|him|her|them))\b"
    r"|\b(you (?:take |grab |hold |have )?(?:the|one) (?:other )?(?:\w+ )?(?:end|side|feet|head|"
    r"front|back|top|bottom)[, ]+(?:and )?(?:i|me|he|she|we)\b)"
    rf"|\b(help (?!me\b|us\b)\w+(?: \w+)?) (?:to )?{_CARRIES}\b"
    rf"|\b{_CARRIES}\b[^,.;:!?]*\b(between us|together with)\b"
)
_WITH = re.compile(rf"\b{_CARRIES}\b[^,.;:!?]*?\bwith (?=\w)")
_MOVED = (Bring, Place)
_HANDLED = (Bring, Give, Pick, Place)


def lost_degree(text: str, goals: Iterable[Goal], index: NameIndex) -> str:
    """How far, how much or with whom, as it was said, that no goal carries; empty if none is."""
    every = list(each(tuple(goals)))
    if any(isinstance(goal, Say) for goal in every):
        return ""
    plain = " ".join(text.lower().replace("’", "'").split())
    found: list[re.Match[str] | None] = []
    if any(isinstance(goal, Open | Close) for goal in every):
        found.append(_PARTLY.search(plain))
    if any(isinstance(goal, Switch) and goal.on for goal in every):
        found.append(_MORE_OR_LESS.search(plain))
    if any(isinstance(goal, _HANDLED) for goal in every):
        found.append(_REST.search(plain))
        found.append(_MOMENT.search(plain) if _beside_a_thing(every) else None)
    moved = [goal for goal in every if isinstance(goal, _MOVED)]
    if moved:
        found.append(_TOGETHER.search(plain))
    said = next((one for match in found if match for one in match.groups() if one), "")
    return said or (_with_somebody(plain, index) if _is_taken_somewhere(moved) else "")


def _beside_a_thing(goals: Sequence[Goal]) -> bool:
    things = (goal.object for goal in goals if isinstance(goal, _HANDLED))
    return any(thing.relation is not None for thing in things)


def _is_taken_somewhere(goals: Sequence[Bring | Place]) -> bool:
    return any(isinstance(goal, Place) or isinstance(goal.to, str) for goal in goals)


def _with_somebody(plain: str, index: NameIndex) -> str:
    """Carry it to the hall *with Ada*."""
    for found in _WITH.finditer(plain):
        words = words_in(plain[found.end() :])
        match = index.match(words, 0) if words else None
        if match is not None and match.of("person"):
            return f"with {' '.join(words[: match.end])}"
    return ""
