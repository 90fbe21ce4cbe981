"""What is said of when, how long and beside what, and comes back in no goal.

Goals are done once each, at once, one after the other. What asks for another way (two things *at
the same time*, *keep waving*, *every minute*, *tomorrow*) is asked about, and never half done.
"""

from collections.abc import Sequence
from itertools import pairwise

from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.lexicon import words
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, verbs_at
from intents.goals import (
    Balance,
    Bring,
    Close,
    Find,
    Follow,
    Gesture,
    Give,
    Goal,
    GoTo,
    Guide,
    If,
    LookAt,
    Open,
    Pick,
    Place,
    Say,
    Switch,
    Wait,
    each,
)

_BODILY = (
    Balance, Bring, Close, Find, Follow, Gesture, Give, GoTo, Guide, LookAt, Open, Pick, Place, Wait
)  # fmt: skip
"""What the body is at for a while, so that two of them can be at once or one after the other."""
_LASTING = (Balance, Find, Follow, Guide, Wait)
"""What goes on until something comes about or a time is over."""
_HELD = words("holding carrying gripping")
"""What is held is kept, until it is to be put somewhere."""
_WHILE = words("while whilst as")
_BEING = words("you are is still also and")
_ADDED = words(
    "including starting beginning preferably going being having doing using please "
    "stopping halting freezing"
)
"""What follows a comma with -ing and is no second act."""
_NO_LINK = words("a soon long far much well")
"""*A* while; as *soon* as."""
_COMMENT = words("like wish want please see can know said say need")
"""As you *like*."""


def unkept(text: Text, goals: Sequence[Goal]) -> tuple[str, str]:
    """Why goals are not all that was asked for, and what is only to be remarked; often empty."""
    acts = [goal for goal in each(goals) if isinstance(goal, _BODILY)]
    for kind, said in text.manners:
        if kind == "endless" and acts and not isinstance(acts[-1], Wait | Follow):
            return f"I cannot go on without an end, “{said}”", ""
        if kind == "later" and (acts or any(isinstance(goal, Switch) for goal in each(goals))):
            return f"I begin at once, and cannot do it “{said.lower()}”", ""
    kept_up = _kept_up(text)
    if kept_up and not all(map(_has_end, acts)):
        return f"I cannot go on without an end, “{kept_up}”", ""
    watched = _while_so(text)
    brief = any(isinstance(goal, Balance | Follow | Gesture) for goal in acts)
    if watched and brief and not any(isinstance(goal, If) for goal in goals):
        return f"I cannot watch for “{watched}” meanwhile", ""
    beside = _beside(text)
    if beside and len(acts) > 1:
        return f"I do one thing after the other, and not “{beside}”", ""
    if beside and len(goals) > 1:
        return "", "I do one thing after the other"
    if beside and acts:
        return "", f"I begin as soon as I am free to: “{beside}” changes nothing"
    return "", _postured(text, goals)


def _has_end(goal: Goal) -> bool:
    """Whether what one keeps doing ends: keep walking *until you are at the bar*."""
    return isinstance(goal, _LASTING) or (isinstance(goal, GoTo) and goal.place is not None)


def _kept_up(text: Text) -> str:
    """*Keep waving*: without an end."""
    for at in range(len(text) - 1):
        doing = at + 1 + (text.word(at + 1) in ("on", "up"))
        if text.word(at) == "keep" and _doing(text, doing) and text.word(doing) not in _HELD:
            return text.raw(at, doing + 1)
    return ""


def _beside(text: Text) -> str:
    """What is said of two things that they are to be done at once."""
    said = next((said for kind, said in text.manners if kind == "together"), "")
    for at in range(len(text)):
        begin = at + 1
        while text.word(begin) in _BEING:
            begin += 1
        linked = text.word(at) in _WHILE and text.word(at - 1) not in _NO_LINK
        added = text.word(at) == COMMA and begin == at + 1 and at > 0
        goes = "you" in text.words[at:begin] and text.word(begin) not in _COMMENT
        does = _doing(text, begin) or (goes and bool(verbs_at(text.words, begin)))
        if said or not (linked or added) or not does:
            continue
        gerunds = any(_doing(text, n) for n in range(at))
        if linked or not (gerunds or text.word(begin) in _ADDED):
            said = text.raw(at if linked else begin, _end(text, begin))
    return said


def _while_so(text: Text) -> str:
    """Wave *while Ada is here*: for as long as that is so."""
    for at in range(1, len(text)):
        if (
            text.word(at) in ("while", "whilst")
            and text.word(at - 1) != "a"
            and text.word(at + 1) != "you"
        ):
            return "" if _doing(text, at + 1) else text.raw(at, _end(text, at))
    return ""


def _doing(text: Text, at: int) -> bool:
    """Whether the participle of an act stands at a word: *waving*."""
    word = text.word(at)
    return word.endswith("ing") and base_form(word) != word and bool(verbs_at(text.words, at))


def _end(text: Text, at: int) -> int:
    while at < len(text) and text.word(at) not in (COMMA, FULL_STOP):
        at += 1
    return at


def _postured(text: Text, goals: Sequence[Goal]) -> str:
    """Stand on one leg *and wave*: it may be meant at once, and is not done so."""
    linked = any(
        text.word(at) == "and" and text.word(at + 1) not in ("then", "after", "afterwards")
        for at in range(len(text))
    )
    for one, other in pairwise(goals):
        open_ended = isinstance(one, Balance) and one.duration_s is None and one.mode != "stand"
        if linked and open_ended and isinstance(other, Gesture | Say):
            return "I do one thing after the other"
    return ""
