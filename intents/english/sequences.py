"""Clauses one after the other, and what each does to those before it."""

import re
from contextlib import suppress

from intents.english.clauses.openings import other_case, otherwise_end, skip_openings
from intents.english.clauses.statements import mention_phrase
from intents.english.corrections import correction, taken_back
from intents.english.joining import as_wished, instead, joined, or_else, same_object, sought_there
from intents.english.phrases.complements import connector_end
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.picked_out import picked_out
from intents.english.reading import Found, Sentence, clause, not_understood
from intents.english.substitution import substitute
from intents.english.trouble import (
    Misfit,
    NotUnderstood,
    Partly,
    ReadingError,
    Unfinished,
    Unread,
)
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.english.words.verbs import base_form
from intents.goals import (
    Bring,
    Cancel,
    Close,
    Find,
    Give,
    Goal,
    Open,
    Pause,
    Pick,
    Place,
    Resume,
    Stop,
    Switch,
    each,
)

_LOOKS = lexicon.words("look check search have take peek try")
"""How one is told where to look for what cannot be found."""
_NAMED_HAND = re.compile(
    r"\b(with|using|use|in) (of |your |the )*(left|right|both|two|one) (of )?(your |the )?"
    r"(hand|arm|gripper)s?\b"
)


def sequence(sentence: Sentence, at: int) -> Found:
    """Clauses one after the other; an inner sentence only up to a full stop or "otherwise".

    Raises:
        ReadingError: One of them makes no sense.
    """
    text, notes = sentence.text, sentence.notes
    goals: list[Goal] = []
    here = sentence.after(goals)
    last, clause_at = 0, 0
    while True:
        if sentence.depth and goals and _ends_inner(text, at):
            return goals, at
        begun, at = at, skip_openings(text, at)
        notes.passed.append((begun, at))
        recent = goals[last:] if begun else list(sentence.history)
        back = picked_out(here, begun, recent) or taken_back(here, begun, recent)
        if back:
            notes.passed.append((clause_at, begun))
            goals[last:], at = back
            continue
        if at >= len(text) or (sentence.depth and otherwise_end(text, at)):
            return goals, at
        changed = _changed(here, at, goals[last:], since=clause_at) if goals else None
        if changed:
            goals[last:], at = changed
            continue
        wish, notes.wanted = goals[-1:] if notes.wanted else [], False
        found, end = _one_more(here, at)
        notes.one_hand |= names_hand(text.raw(begun, end), found)
        if not sentence.depth:
            notes.trace.append((text.raw(at, end), tuple(found)))
        if found:
            clause_at = begun
            last = _append(here, found, wish, text.words[begun : at + 1], text.words[at:end])
        else:  # what is only told stands between a clause and what corrects it
            notes.passed.append((begun, end))
            notes.wanted = bool(wish)
            if here.scope.object is None:
                _mention_first(here, begun, end)
        at = max(end, at + 1)


def _mention_first(sentence: Sentence, at: int, end: int) -> None:
    """My torch was clipped to the rack, bring *it*: the first thing that was told of."""
    text = sentence.text
    for start in range(at, end):
        if not (text.name_at(start) or text.index.partial(text.word(start))):
            continue
        phrase = noun_phrase(text, start)
        if phrase is not None and phrase.name("object"):
            with suppress(ReadingError):
                mention_phrase(phrase, sentence.scope)
            return


def _append(
    sentence: Sentence, found: list[Goal], wish: list[Goal], opening: list[str], said: list[str]
) -> int:
    """Add what was found to the goals before, in their light; where it begins among them.

    Args:
        sentence: The sentence after the goals before.
        found: The goals of a clause.
        wish: The goal before, if it was a wish that the clause may spell out.
        opening: The words that link the clause to those before, and its first.
        said: The words of the clause.
    """
    goals, scope = sentence.before, sentence.scope
    if wish and opening[-1] in _LOOKS and (seen := sought_there(wish[0], found)):
        found[:] = [seen]
        goals.pop()
    elif wish and same_object(wish[0], found[:1]):
        found[0] = as_wished(found[0], goals.pop())
    failing = opening[-1] == "if" and not isinstance(goals[-1] if goals else None, Find)
    if goals and found and (failing or "or" in opening[:-1]):
        found[0] = or_else(goals, found[0])
    if goals and found:
        found[0] = instead(goals, found[0], said="instead" in said, but="but" in opening)
    if goals and found:
        found[0] = joined(goals, found[0], first=opening[-1])
    last = len(goals)
    goals += found if found != goals[-1:] or not _once(found) else []
    if scope.parted:
        goals[:] = [substitute(goal, *scope.parted) for goal in goals]
        scope.parted = None
    for goal in found:
        scope.mention_goal(goal)
    return last


def _changed(sentence: Sentence, at: int, last: list[Goal], *, since: int) -> Found | None:
    """The goals of the clause before, as the first afterthought that is one changes them.

    What is corrected counts as not said, from word ``since`` on.
    """
    for thought in sentence.rules.afterthoughts:
        changed = thought(sentence, at, last)
        if changed:
            if thought is correction or not changed[0]:
                sentence.notes.passed.append((since, at))
            return changed
    return None


def _one_more(sentence: Sentence, at: int) -> Found:
    """The next clause.

    Raises:
        Partly: It makes no sense, but what stands before it does.
    """
    known = tuple(sentence.before)
    try:
        if known and _hangs_on(sentence.text, at):
            raise not_understood(sentence.text, at)
        return clause(sentence, at)
    except (NotUnderstood, Misfit) as error:
        if not known or sentence.depth:
            raise
        unread = isinstance(error, Unread | Misfit)
        raise (Unfinished if unread else Partly)(str(error), known) from None


def _hangs_on(text: Text, at: int) -> bool:
    """Put it down *facing me*: with no link before it, a participle is no new clause."""
    word, before = text.word(at), text.word(at - 1)
    linked = before in (COMMA, FULL_STOP) or connector_end(text, at - 1)
    return word.endswith("ing") and base_form(word) != word and not linked


def _ends_inner(text: Text, at: int) -> bool:
    if text.word(at) == FULL_STOP:
        return True
    link = at + (text.word(at) == COMMA)
    return bool(otherwise_end(text, link)) or other_case(text, at) is not None


def _once(goals: list[Goal]) -> bool:
    """Whether goals say no more when they are said twice: never mind, forget it."""
    return all(
        isinstance(goal, Cancel | Stop | Pause | Resume | Place | Open | Close | Switch)
        or (isinstance(goal, Bring | Give | Pick | Find) and _is_that_one(goal))
        for goal in goals
    )


def _is_that_one(goal: Bring | Give | Pick | Find) -> bool:
    """Whether it is of one thing in particular, which cannot be fetched twice."""
    return goal.object is not None and goal.object.count is None


def names_hand(said: str, goals: list[Goal]) -> bool:
    """Whether it is said with which hands a thing is to be handled."""
    handles = any(isinstance(goal, (Pick, Place, Bring, Give)) for goal in each(goals))
    return handles and _NAMED_HAND.search(said.lower()) is not None
