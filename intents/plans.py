"""A plan of several steps that is asked about: shown by numbers, and changed by a few words.

"Skip three", "without the plate", "only one and two", "first the cups", "the cups last", "two
before one", "swap one and three", "but don't touch the plate".
"""

import re
from collections.abc import Callable, Iterable
from typing import Literal, NamedTuple

from msgspec.structs import replace

from intents.english.words.lexer import tokenize
from intents.goals import Goal
from intents.outcomes import Question
from intents.plan_steps import (
    NoSuchNumber,
    NoSuchStep,
    Pointing,
    Steps,
    kept,
    moved,
    swapped,
    without,
)
from intents.prohibitions import broken, prohibitions
from intents.risks import risk
from intents.vocabulary import Vocabulary
from intents.wording import in_words

HOW_I_READ_IT = "that is how I understand it"
"""Why what a language model has made of a sentence is asked about."""


def numbered(goals: Iterable[Goal]) -> str:
    """Each step on a line of its own, by its number."""
    return "\n".join(f"  {n}. {in_words((goal,))}" for n, goal in enumerate(goals, 1))


def proposal(goals: Steps, why: str) -> str:
    """The question whether to do some goals; several are shown by their numbers."""
    if len(goals) < 2:
        return f"I shall {in_words(goals)}{why and f'; {why}'}. Shall I?"
    return f"I shall do this{why and f'; {why}'}:\n{numbered(goals)}\nShall I?"


def changed(
    text: str, question: Question, vocabulary: Vocabulary, *, risk: Callable[[Steps], str] = risk
) -> Question | None:
    """The question after a text has changed the plan that it asks about; None if it does not.

    Args:
        text: What was said.
        question: What is asked; any question may be given.
        vocabulary: The names of this world.
        risk: Why goals are asked about, in words; empty where that is plain.
    """
    asks = question.kind == "confirmation" and len(question.goals) > 1
    if not asks or len(text) > _LONGEST:
        return None
    plan = question.goals
    changes = [_change(piece) for piece in _pieces(_said(text))]
    if all(changes):
        goals, told = _made([change for change in changes if change], plan, vocabulary)
    else:
        against = set[int]()
        if prohibitions(text, vocabulary):
            against = {n for n, goal in enumerate(plan) if broken((goal,), (text,), vocabulary)}
        goals, told = without(plan, against) if against else None, ""
    if goals is None:
        return None
    if not goals:
        goals, told = plan, "Nothing is left of it then: say “no”. "
    elif goals == plan and not told:
        told = "That is so already. "
    return replace(question, question=f"{told}{proposal(goals, risk(goals))}", goals=goals)


def _made(
    changes: "list[_Change]", plan: Steps, vocabulary: Vocabulary
) -> tuple[Steps | None, str]:
    """A plan after changes, and what could not be done of them; None if they are none of a plan."""
    goals, told = plan, ""
    for change in changes:
        try:
            goals = change.made(goals, Pointing(goals, vocabulary, shown=plan))
        except NoSuchStep as why:
            if not change.certain and not isinstance(why, NoSuchNumber):
                return None, ""
            told += f"{why} "
    return goals, told


_LONGEST = 200
"""Characters of what changes a plan; longer texts ask for something else."""
_OPENING = re.compile(
    r"^(?:no|nope|yes|yeah|ok|okay|well|but|and|then|please|good|fine|wait|actually|hm+|now|"
    r"let us|can you|could you|would you|you can|you may|i would|rather|better|,)\s+"
)
_EDITS = (
    r"(?:skip|leave|drop|omit|delete|remove|without|first|only|swap|start|begin|end|finish|not)"
)
_JOINT = re.compile(rf"\s*(?:,|\band\b|\bthen\b|\bbut\b)\s*(?=(?:and |then |but )?{_EDITS}\b)")
_SKIP = re.compile(
    r"(?:(?:do )?(?:all(?: of (?:it|them))?|everything) )?"
    r"(?:skip|but|apart from|leave out|leave off|drop|omit|delete|remove|without|not|forget|cut|"
    r"ignore|strike|except|do not do|get rid of|scratch|never mind) (?P<which>.+)"
    r"|leave (?P<out>.+) out"
)
_ONLY = re.compile(r"(?:only|just|do only|do just|nothing but) (?P<which>.+)|(?P<alone>.+) only")
_FIRST = re.compile(
    r"(?:first(?: do)?|start with|begin with|(?:do|move|put) (?=.+ first)) ?(?P<which>.+?)"
    r"(?: first)?"
    r"|(?P<those>.+) (?:first|at the beginning|to the (?:front|beginning|top))"
)
_LAST = re.compile(
    r"(?:finish with|end with|(?:do|move|put) (?=.+ (?:last|end)))(?P<which>.+?)"
    r"(?: last| (?:at|to) the end)?"
    r"|(?P<those>.+) (?:last|at the end|to the end|at last|in the end)"
)
_SWAP = re.compile(r"(?:swap|switch|exchange) (?P<one>.+) (?:and|with) (?P<other>.+)")
_ORDER = re.compile(r"(?:do |move |put )?(?P<one>.+) (?P<where>before|after) (?P<other>.+)")


def _said(text: str) -> str:
    """What was said in plain words, with commas."""
    words = [t.text for t in tokenize(text) if t.text[0].isalnum() or t.text == ","]
    said = " ".join(words).strip(" ,")
    while (shorter := _OPENING.sub("", said)) != said:
        said = shorter
    return re.sub(r"[ ,]*\b(?:please|instead|then|though)$", "", said)


def _pieces(said: str) -> list[str]:
    """Each change that is said: "skip two and first the cups"."""
    pieces = (re.sub(r"^(?:and|then|but) ", "", piece) for piece in _JOINT.split(said))
    return [piece for piece in pieces if piece] or [said]


class _Change(NamedTuple):
    """What is said to be done to a plan.

    Attributes:
        one: Words for the steps that it is done to.
        other: Words for those before or after which they go, or with which they change places.
        certain: It changes a plan and means nothing else.
    """

    how: Literal["swap", "skip", "only", "first", "last", "before", "after"]
    one: str
    other: str = ""

    @property
    def certain(self) -> bool:
        return self.how in ("swap", "skip")

    def made(self, goals: Steps, steps: Pointing) -> Steps:
        """The plan after it; raises NoSuchStep where one is not there."""
        one = steps(self.one)
        match self.how:
            case "swap":
                return swapped(goals, one, steps(self.other))
            case "skip":
                return without(goals, one)
            case "only":
                return kept(goals, one)
            case "first":
                return moved(goals, one, 0)
            case "last":
                return moved(goals, one, len(goals))
            case "before":
                return moved(goals, one, min(steps(self.other)))
            case "after":
                return moved(goals, one, max(steps(self.other)) + 1)


def _change(said: str) -> _Change | None:
    """The change that a text stands for; None if it is none."""
    if found := _SWAP.fullmatch(said):
        return _Change("swap", found["one"], found["other"])
    if found := _SKIP.fullmatch(said):
        return _Change("skip", found["which"] or found["out"])
    if found := _ONLY.fullmatch(said):
        return _Change("only", found["which"] or found["alone"])
    if found := _FIRST.fullmatch(said):
        return _Change("first", found["which"] or found["those"])
    if found := _LAST.fullmatch(said):
        return _Change("last", found["which"] or found["those"])
    if found := _ORDER.fullmatch(said):
        how = "before" if found["where"] == "before" else "after"
        return _Change(how, found["one"], found["other"])
    return None
