"""Goals in the plainest words that the grammar reads back as the same goals: what is to be learnt.

Nearly all are said as the robot reads them back itself; only what is said of the robot and of who
speaks is said from the other side: "bring the cup to me".
"""

import re
from collections.abc import Iterable

from msgspec.structs import replace

from intents import goals as g
from intents.goals import OPERATOR, Goal
from intents.wording import condition, in_words, thing

_REPORTS = {
    "holding": "what are you holding", "seeing": "what do you see", "location": "where are you",
    "status": "what are you doing", "remaining": "how much longer do you need",
    "operator": "where am I", "health": "how are you", "why": "why did you stop",
    "capabilities": "what can you do",
}  # fmt: skip
_MINE = re.compile(r"\bmy (head|arms|(?:left|right) (?:arm|leg|hand))\b")
_NOT_HERE = re.compile(r" is( not)? there\b")


def plainly(goals: Iterable[Goal]) -> str:
    """Orders in plain words, one after the other."""
    return " ; ".join(map(_order, goals))


def _order(goal: Goal) -> str:
    match goal:
        case g.Report():
            return _REPORTS[goal.topic]
        case g.Cancel():
            return "cancel"
        case g.Resume():
            return "resume"
        case g.GoTo(place=place) if place == OPERATOR:
            return "come here"
        case g.Repeat():
            return f"{goal.times} times : {plainly(goal.goals)}"
        case g.ForEach():
            each = thing(replace(goal.object, count="all", held=False))
            return f"for {each} : {plainly(goal.goals)}"
        case g.If():
            other = f" otherwise {plainly(goal.else_)}" if goal.else_ else ""
            return f"if {condition(goal.condition)} , {plainly(goal.then)}{other}"
        case g.Follow() | g.Guide() | g.Bring() | g.Give() | g.Greet() | g.Tell() | g.Say():
            return re.sub(r"\byou\b(?![^“]*”)", "me", in_words([goal]))
        case _:
            said = in_words([goal])
            return re.sub(r"\byou\b", "me", _MINE.sub(r"your \1", said))
