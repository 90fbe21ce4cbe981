"""Goals that are read back and confirmed before anything is done: one table."""

from collections.abc import Callable

from intents import goals as g
from intents.english.words.lexer import singular
from intents.english.words.lexicon import words
from intents.goals import Goal, ObjectQuery, each

FAR_M = 3.0
"""Walks over a distance, without a place to go to, are confirmed beyond this [m]."""
MANY = 10
_RUBBISH = words("trash garbage rubbish waste dustbin wastebasket recycling bin trashcan")
_HOT = words("oven stove cooker hob heater iron kettle toaster boiler grill fryer burner heating")
_SHARP = words("knife scissors blade saw razor axe cutter scalpel needle")
_WAYS_OUT = words("exit entrance gate")


def risk(goals: tuple[Goal, ...]) -> str:
    """Why goals should be confirmed, in words; empty if they need not be."""
    for goal in each(goals):
        for risky in _TABLE:
            reason = risky(goal)
            if reason:
                return reason
    return ""


def _words_of(name: str | None) -> set[str]:
    return {singular(word) for word in (name or "").lower().split()}


def _thrown_away(goal: Goal) -> str:
    where = [goal.on, goal.in_] if isinstance(goal, g.Place) else []
    if isinstance(goal, g.Bring) and isinstance(goal.to, str):
        where = [goal.to]
    thrown = any(_words_of(name) & _RUBBISH for name in where)
    return "what is thrown away may be lost" if thrown else ""


def _heated(goal: Goal) -> str:
    hot = isinstance(goal, g.Switch) and goal.on and _words_of(goal.what) & _HOT
    return "it gets hot" if hot else ""


def _way_out(goal: Goal) -> str:
    what = _words_of(goal.what) if isinstance(goal, g.Open) else set[str]()
    outside = what & _WAYS_OUT or {"front", "door"} <= what
    return "it lets people in and out" if outside else ""


def _sharp(goal: Goal) -> str:
    if not isinstance(goal, g.Bring | g.Give | g.Pick):
        return ""
    return "it is sharp" if _words_of(goal.object.name) & _SHARP else ""


def _everything(goal: Goal) -> str:
    if isinstance(goal, g.Repeat) and goal.times > MANY:
        return "that is many times"
    if not isinstance(goal, g.ForEach):
        return ""
    said = goal.object
    vague = said == ObjectQuery(count=said.count, at=said.at)
    moves = any(isinstance(inner, g.Pick | g.Place | g.Bring | g.Give) for inner in goal.goals)
    return "that moves everything there is" if vague and moves else ""


def _far(goal: Goal) -> str:
    if not isinstance(goal, g.GoTo) or goal.by is None:
        return ""
    length_m = abs(goal.by.forward_m or 0.0) + abs(goal.by.left_m or 0.0)
    return "that is far" if length_m > FAR_M else ""


_TABLE: tuple[Callable[[Goal], str], ...] = (
    _thrown_away, _heated, _way_out, _sharp, _everything, _far,
)  # fmt: skip
