"""The grammar: a sentence becomes goals, deterministically and offline.

A sentence is a sequence of clauses (:mod:`intents.english.sequences`). Each is read by the first of
a list of readings that makes sense of it (:mod:`intents.english.order`).
"""

import re
from copy import copy
from dataclasses import fields
from typing import NamedTuple

from intents.english.aspects import unkept
from intents.english.clauses.parentheses import parentheses, said_to_others
from intents.english.faithfulness import left_out, strings
from intents.english.joining import carried, said_once
from intents.english.offers import in_distress, would_help
from intents.english.order import RULES
from intents.english.phrases.referents import ME, Scope
from intents.english.reading import Sentence, not_understood
from intents.english.readings.asides import is_about_pace, leaves_out_step, somebody_else
from intents.english.sequences import names_hand, sequence
from intents.english.trouble import (
    NotUnderstood,
    Offered,
    Partly,
    ReadingError,
    Unasked,
    Unclear,
    Unpromised,
    listing,
)
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import (
    OPERATOR,
    Answer,
    Ask,
    Balance,
    Bring,
    Count,
    Find,
    Follow,
    Gesture,
    Give,
    Goal,
    GoTo,
    Greet,
    Guide,
    If,
    LookAt,
    Meet,
    Pause,
    Pick,
    Place,
    Report,
    Say,
    Stop,
    Tell,
    each,
)
from intents.job_words import Jobs, jobs_to_end

_HELLO = lexicon.phrases(
    "hello,hi,hey,good morning,good evening,good afternoon,hello there,hi there"
)
_LOOKING = (Find, Count, Tell, LookAt, If)
"""Goals that leave things as they are."""
_MOVING = (Balance, Bring, Find, Follow, Gesture, Give, GoTo, Guide, Meet, Pick, Place)
_DANGLING = lexicon.words("to into onto from with towards the a an of")
"""Words that no command ends with."""


_LEAVES_IT_OUT = re.compile(r"\W*(?:please )?leave (?:it|that|this) out\W*", re.IGNORECASE)
SHALL_NOT = "All right, I shall not"
"""What is answered to who only says what is not to be done."""
_OWN_HAND = "I choose the hand myself"
_KEPT = re.compile(r"\b(let(ting)? go|releas(e|ing)|put(ting)? (it|them|that) down)\b")
"""What is to stay in the hand, and cannot where it is handed on or put somewhere."""


_NO_MORE = re.compile(r"\b(further|farther|longer|more|beyond|past) (than )?\S")
"""What limits how much is to be done: "do not go *further than one metre*"."""


class Understood(NamedTuple):
    """What a sentence asks for.

    Attributes:
        clauses: Each clause as it was said, with what it was read as by itself.
        remarks: What the speaker is told about words that were heard and change nothing.
    """

    goals: tuple[Goal, ...]
    clauses: tuple[tuple[str, tuple[Goal, ...]], ...] = ()
    remarks: tuple[str, ...] = ()


def read(text: Text, scope: Scope, history: tuple[Goal, ...] = ()) -> Understood:
    """The goals of a whole sentence; ``history`` are those of the sentence before.

    What is set off from the rest and cannot change what is asked is left out where the sentence
    makes no sense with it, and that is remarked.

    Raises:
        ReadingError: Some of it makes no sense; the error says which part and why.
    """
    theirs = said_to_others(text)
    remarks = [f"I take “{_quoted(text, span)}” as said to {who}" for span, who in theirs]
    text = text.without([span for span, _ in theirs]) if theirs else text
    begun = copy(scope)
    try:
        return _remarked(_read(text, scope, history), remarks)
    except ReadingError as error:
        _restore(scope, begun)
        spans = parentheses(text)
        if not spans:
            raise
        asides = listing([f"“{_quoted(text, span)}”" for span in spans], "and")
        passed = _without(text, spans, scope, history, error)
        return _remarked(passed, [*remarks, f"I pass over {asides}"])


def _quoted(text: Text, span: tuple[int, int]) -> str:
    return text.raw(*span).strip(" ,.;!?—–")


def _without(
    text: Text,
    spans: list[tuple[int, int]],
    scope: Scope,
    history: tuple[Goal, ...],
    error: ReadingError,
) -> Understood:
    """What a sentence asks for that makes no sense with its parentheses.

    Raises:
        ReadingError: It makes no sense without them either.
    """
    begun = copy(scope)
    told = error
    for joined in (False, True):
        try:
            understood = _read(text.without(spans, joined=joined), scope, history)
            if understood.goals:
                return understood
        except ReadingError as other:
            told = told if isinstance(told, Unclear) or joined else other
        _restore(scope, begun)
    raise told


def _restore(scope: Scope, begun: Scope) -> None:
    """Forget what was spoken of in an attempt that failed."""
    for slot in fields(scope):
        setattr(scope, slot.name, getattr(begun, slot.name))


def _remarked(understood: Understood, remarks: list[str]) -> Understood:
    return understood._replace(remarks=(*understood.remarks, *remarks))


def _read(text: Text, scope: Scope, history: tuple[Goal, ...]) -> Understood:
    """The goals of a sentence as it stands.

    Raises:
        ReadingError: Some of it makes no sense.
    """
    if text.phrase_end(_HELLO, 0) == len(text):
        return Understood((Greet(person=ME),))
    for at in range(1, len(text)):
        mine = text.word(at) == "myself" and text.word(at - 1) not in ("for", "to")
        if mine and not (_ordered_after(text, at + 1) or _cannot(text, at)):
            raise Unasked("That is for you to do, as I hear it")
    _refuse_unasked(text)
    sentence = Sentence(text, scope, RULES, history)
    goals, end = sequence(sentence, 0)
    goals = said_once(carried(goals), text.words)
    help_ = None if goals or sentence.notes.forbidden else would_help(sentence)
    if in_distress(text) and all(isinstance(goal, Report) for goal in goals):
        raise Offered(text.raw(0, len(text)), (GoTo(place=OPERATOR),))
    if help_:
        raise Offered(text.raw(0, len(text)), (help_,))
    if text.word(len(text) - 1) in _DANGLING and _acts(goals[-1:]):
        raise Unclear(f"“... {text.word(len(text) - 1)}” what?")
    if end < len(text):
        raise not_understood(text, end)
    _never_onto_itself(goals)
    if sentence.notes.one_hand:
        raise Partly(_OWN_HAND, tuple(goals))
    if sentence.notes.guessed:
        said = listing([f"“{verb}”" for verb in sentence.notes.guessed], "and")
        raise Offered(f"I do not know how to {said}", tuple(goals))
    verb = sentence.notes.verb
    if verb is not None and verb.at == verb.first and text.asks and not text.polite:
        raise Offered("I am not sure whether you ask that", tuple(goals))  # the cup to the table?
    remarks = (*_forbidden(sentence, goals), *_unkept(sentence, goals), *_at_a_pace(text, goals))
    if any(names_hand(text.raw(*span), goals) for span in sentence.notes.passed):
        raise Partly(_OWN_HAND, tuple(goals))
    differs, remark = unkept(text, goals)
    if differs:
        raise Partly(differs, tuple(goals))
    remarks += (remark,) if remark else ()
    return Understood(tuple(goals), tuple(sentence.notes.trace), remarks)


def _cannot(text: Text, at: int) -> bool:
    """Turn it off, I *can't* hear myself think: what one cannot do is a reason to ask for more."""
    begin = max((n + 1 for n in range(at) if text.word(n) in (COMMA, FULL_STOP)), default=0)
    said = text.words[begin:at]
    return said[:1] in (["i"], ["we"]) and said[1:3] in (["can", "not"], ["could", "not"])


def _ordered_after(text: Text, at: int) -> bool:
    """I was going to do it myself, *but* take it to Ada: whether an order follows."""
    links = [n for n in range(at, len(text)) if text.word(n) in ("but", "so", FULL_STOP)]
    return any(
        verbs_at(text.words, n) and {"i", "we"}.isdisjoint(text.words[link + 1 : n])
        for link in links
        for n in (link + 1, link + 2)
    )


def _refuse_unasked(text: Text) -> None:
    """Refuse what is no order to the robot, or is about how it does what it is at.

    Raises:
        Unasked: It is that.
    """
    if is_about_pace(text.raw(0, len(text))):
        raise Unasked("I move at my own pace, and cannot be told another one")
    spoken_to = somebody_else(text)
    if spoken_to:
        raise Unasked(f"I take that as said to {spoken_to}, not to me")
    if text.word(0) == "whose" and not _goes_on(text):
        raise Unasked("I am not told whose things are")
    wanted = jobs_to_end(text.raw(0, len(text)))
    if wanted is not None and wanted not in (Jobs(every=True), Jobs(current=True)):
        raise Unasked("I know of no other jobs here than what I am at; the prompt has a queue")
    if leaves_out_step(text) or _LEAVES_IT_OUT.fullmatch(text.raw(0, len(text))):
        raise Unasked(
            "I do what I am at step by step, and leave none out: “cancel” ends it, and then say "
            "what is left to do"
        )


def _goes_on(text: Text) -> bool:
    """Whose cup is that? *Bring it to me*: whether another clause follows the first."""
    signs = (at for at, word in enumerate(text.words) if word in (COMMA, FULL_STOP))
    return next(signs, len(text)) < len(text) - 1


def _forbidden(sentence: Sentence, goals: list[Goal]) -> list[str]:
    """What is remarked on what is not to be done.

    Raises:
        Partly: It is asked for as well, or nobody can promise it: on the way to a place the robot
            goes where it has to.
    """
    if sentence.notes.forbidden and not goals:
        raise Unasked(SHALL_NOT)
    handled = [goal for goal in each(goals) if not isinstance(goal, _LOOKING)]
    known = " ".join(strings(handled))
    moves = any(isinstance(goal, _MOVING) for goal in each(goals))
    for said, names, away, how in sentence.notes.forbidden:
        kept = _KEPT.search(said.lower()) and _acts(goals) and not isinstance(goals[-1], Pick)
        spots = away and any(n.kind in ("place", "room", "person") for n in names)
        asked = any(n.name.lower() in known for n in names if n.kind != "person")
        limit = moves and _NO_MORE.search(said.lower())
        if kept or spots or (asked and not away) or (how and moves) or limit:
            raise Unpromised(f"I cannot promise “{said}”", tuple(goals))
    heard = [f"“{one.said}”" for one in sentence.notes.forbidden]
    return [f"I do only what I am asked for, and heard {listing(heard, 'and')}"] if heard else []


def _unkept(sentence: Sentence, goals: list[Goal]) -> list[str]:
    """What is remarked on words that no goal carries.

    Raises:
        Partly: One of them may change what is to be done.
    """
    if any(isinstance(goal, Stop | Pause) for goal in goals):
        return []
    _must_choose(sentence.text, goals)
    dropped = left_out(sentence.text, goals, sentence.notes.passed)
    grave = [one.said for one in dropped if not one.slight]
    if grave and goals:
        said = listing([f"“{word}”" for word in grave], "and")
        raise Partly(f"I cannot take account of {said}", tuple(goals))
    return [f"I pay no attention to “{one.said}”" for one in dropped]


def _at_a_pace(text: Text, goals: list[Goal]) -> list[str]:
    """What is remarked on how fast something is to be done: the robot moves at its own pace."""
    every = list(each(goals))
    moves = any(isinstance(goal, _MOVING) for goal in every)
    speaks = any(isinstance(goal, Say | Ask | Answer) for goal in every)
    told = text.pace and (moves or any(isinstance(goal, Greet) for goal in every)) and not speaks
    return [f"I move at my own pace: “{text.pace}” changes nothing"] if told else []


def _never_onto_itself(goals: list[Goal]) -> None:
    """Refuse to put a thing on, into or to itself, or on another of its kind.

    Raises:
        NotUnderstood: That is asked for.
    """
    for goal in each(goals):
        name = goal.object.name if isinstance(goal, (Place, Bring)) else None
        spots = (goal.on, goal.in_) if isinstance(goal, Place) else (getattr(goal, "to", None),)
        if name and name in spots:
            raise NotUnderstood(f"I cannot put one {name} on, into or to another, or itself")


def _must_choose(text: Text, goals: list[Goal]) -> None:
    """Refuse to do both where one or the other was asked for: "an apple or a banana".

    Raises:
        Unclear: That is so.
    """
    either = "or" in text.words[1:] and len(goals) > 1
    decided = any(isinstance(goal, If | Say | Ask | Answer | Tell) for goal in each(goals))
    if either and not decided:
        raise Unclear("The one or the other: which shall it be?")


def _acts(goals: list[Goal]) -> bool:
    """Whether something is to be taken or put."""
    return any(isinstance(goal, Bring | Give | GoTo | Pick | Place) for goal in goals)
