"""What is said after a clause and changes it: a condition, how often, in which order, who asks.

"... if it is there"; "..., four times"; "... after picking it up". What takes a clause back is in
:mod:`intents.english.corrections`.
"""

from typing import Literal

from msgspec.structs import replace

from intents.english.clauses.compounds import acts_at, condition
from intents.english.clauses.conditions import IF, as_soon_as, mention
from intents.english.clauses.messages import content_end
from intents.english.clauses.openings import (
    begins_clause,
    nothing_end,
    otherwise_end,
    skip_openings,
)
from intents.english.clauses.wishes import asks_end
from intents.english.corrections import named_retraction_end, retraction_end
from intents.english.phrases.complements import connector_end, told_later
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import to_place
from intents.english.phrases.times import ARRIVED, tells_when
from intents.english.reading import Found, Sentence, clause_by_itself
from intents.english.repeating import repeated
from intents.english.sequences import sequence
from intents.english.substitution import substitute
from intents.english.trouble import Partly, ReadingError, Unclear
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.measures import measure, number
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import (
    Answer,
    Balance,
    Bring,
    Condition,
    Find,
    ForEach,
    Goal,
    GoTo,
    If,
    ObjectQuery,
    Present,
    Wait,
)


def left_undone(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Pick up the cup, no, *leave it*: what was asked last is not to be done."""
    text = sentence.text
    end = retraction_end(text, at) or named_retraction_end(text, at, last)
    apart = text.word(at - 1) in (COMMA, FULL_STOP, "no")
    if not (end and apart and last):
        return None
    sentence.notes.passed.append((at, end))
    return [], end


_NOT_NOW = lexicon.phrases(
    "not yet,not just yet,not quite yet,not now,not right now,not right away,not immediately,not,"
    "later,later on,a bit later,some other time,another time,tomorrow,tonight,this evening,"
    "this afternoon,next time,some day,in a bit,when i say so,when i tell you,when i tell you to,"
    "only when i say so,only when i tell you,once i say so,once i tell you,on my signal,"
    "on my command,not before i say so,not until i say so,not before i tell you,"
    "not until i tell you,when i ask you to,when i say go"
)
"""That what was asked is for some other time."""


def not_now(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Pick up the cup, *but not yet*.

    Raises:
        Partly: The robot cannot tell when then.
    """
    text = sentence.text
    end = text.phrase_end(_NOT_NOW, at)
    if end is None or not (end >= len(text) or text.word(end) == FULL_STOP) or not last:
        return None
    said = text.raw(at, end)
    said = "not now" if said == "not" else said
    raise Partly(f"I cannot tell when, “{said}”", tuple(sentence.before))


def on_condition(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Bring the mug *if the cup is not there*.

    Raises:
        Partly: Some of the condition cannot be checked, or it is not clear how far it goes.
    """
    text = sentence.text
    start = text.phrase_end(IF, at)
    if start is None or text.word(at - 1) == FULL_STOP:
        return None
    hangs_on = text.word(at) in _CONDITIONAL and not (
        text.word(at - 1) == COMMA or connector_end(text, at - 1)
    )
    instead = _instead(sentence, at, start, last)
    if instead:
        return instead
    try:
        holds, end = condition(text, start, sentence.scope)
    except ReadingError as error:
        if hangs_on:
            raise Partly(_without_stop(error), tuple(sentence.before)) from error
        return None
    found = _conditioned(sentence, (at, end), holds, last)
    if found is None and hangs_on:
        more = acts_at(text, end) or skip_openings(text, end)
        what = text.raw(more, content_end(text, more))
        raise Unclear(f"“{what}” in any case, or only then? Please say it in two sentences.")
    return found


def _without_stop(error: ReadingError) -> str:
    return str(error).rstrip(".")


def _conditioned(
    sentence: Sentence, clause: tuple[int, int], holds: Condition, last: list[Goal]
) -> Found | None:
    """The goals before as they hang on a condition; None if more is said of it."""
    (at, end), text = clause, sentence.text
    soon = as_soon_as(text, at, holds)
    if soon and (end >= len(text) or text.word(end) == FULL_STOP):
        return [*soon, *last], end
    unless = text.word(at) == "unless"
    start = text.phrase_end(IF, at) or at
    if not unless and lexicon.ONES.intersection(text.words[start:end]):
        holds, last = _one_of_those(holds, last)
    comma = text.word(end) == COMMA and end < len(text)
    otherwise = otherwise_end(text, end + comma)
    if otherwise and not unless:
        if not any(getattr(goal, "object", None) for goal in last):
            mention(
                holds, sentence.scope, met=False
            )  # go out if the cup is not there, otherwise fetch it
        nothing = nothing_end(text, otherwise)
        other, end = ([], nothing) if nothing else sequence(sentence.inner(), otherwise)
        return [If(condition=holds, then=tuple(last), else_=tuple(other))], end
    if end < len(text) and text.word(end) != FULL_STOP:
        return None
    if unless:
        return [If(condition=holds, else_=tuple(last))], end
    return [If(condition=holds, then=tuple(last))], end


def _instead(sentence: Sentence, at: int, start: int, last: list[Goal]) -> Found | None:
    """Bring the mug, or the cup *if it is not there*: the cup where the mug is not."""
    text, before = sentence.text, sentence.before
    end = text.phrase_end(_NOT_THERE, start)
    linked = "or" in text.words[max(0, at - _REACH) : at] and text.word(at) == "if"
    closed = end is not None and (end >= len(text) or text.word(end) == FULL_STOP)
    if not (linked and end and closed and len(before) > 1):
        return None
    wanted, other = before[-2:]
    query = getattr(wanted, "object", None)
    if not isinstance(query, ObjectQuery) or getattr(other, "object", None) is None:
        return None
    either = If(
        condition=Present(object=replace(query, count=None)), then=(wanted,), else_=(other,)
    )
    if len(last) < 2:
        del before[-2:]
        return [either], end
    return [*last[:-2], either], end


_CONDITIONAL = lexicon.words("if unless only provided")
"""Links that make what stands before them hang on what follows."""
_REACH = 8
"""So many words the second of two things may have: "or the small blue cup"."""
_NOT_THERE = lexicon.phrases(
    "it is not there,it is not,there is none,there is not one,they are not there,"
    "you can not find it,you do not find it,you can not see it,you do not see it,it is gone,"
    "it is missing,"
    "that is not there,you do not see one,you can not find one,that one is not there,not"
)
"""Of the first of two things, that it cannot be had."""


def _one_of_those(holds: Condition, last: list[Goal]) -> tuple[Condition, list[Goal]]:
    """Put a cup on the shelf if there is *one* on the table: a cup, and it is that one then."""
    one = holds.object if isinstance(holds, Present) and not holds.negated else None
    spoken_of = [q for goal in last if isinstance(q := getattr(goal, "object", None), ObjectQuery)]
    meant = next((q for q in spoken_of if one and _kind(q) == _kind(one)), None)
    if one is None or meant is None:
        return holds, last
    that = replace(meant, at=one.at or meant.at, relation=one.relation or meant.relation)
    return Present(object=that), [substitute(goal, meant, that) for goal in last]


def _kind(query: ObjectQuery) -> tuple[str | None, str | None]:
    return query.name, query.category


def before_or_after(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Go to the shelf *after picking up the cup*; follow her *before coming back*.

    "Only once you have ...", "not before you have ..." are after; "but before that ..." is before.
    """
    text = sentence.text
    there = _arrival(sentence, at) if last else None
    if there is not None:
        way = [goal for goal in there[0] if goal not in sentence.before]
        return [*way, *last], there[1]
    earlier = _earlier(text, at)
    if earlier is not None:
        other, end = clause_by_itself(sentence, earlier)
        return [*other, *last], end
    found = text.lookup(_AFTER, at)
    after, start = found or (text.word(at) == "after", at + 1)
    if (found is None and text.word(at) not in ("after", "before")) or not (
        begins_clause(text, start) and last
    ):
        return None
    other, end = clause_by_itself(sentence, skip_openings(text, start))
    return ([*other, *last] if after else [*last, *other]), end


def _arrival(sentence: Sentence, at: int) -> Found | None:
    """Wave *when you arrive at the counter*: the way there."""
    if not sentence.text.phrase_end(ARRIVED, at):
        return None
    try:
        goals, end = clause_by_itself(sentence, at)
    except ReadingError:
        return None
    return (goals, end) if len(goals) == 1 and isinstance(goals[0], GoTo) else None


_AFTER = dict.fromkeys(
    lexicon.phrases(
        "once,when,as soon as,only after,only once,only when,only as soon as,not until,not before,"
        "no sooner than,not earlier than"
    ),
    True,
)
"""Links between two clauses of which the second is done first."""
_BEFORE_THAT = lexicon.phrases(
    "before that,before this,before you do,before you do that,beforehand,before anything else,"
    "before you do anything else,before doing anything else,before all else"
)


def _earlier(text: Text, at: int) -> int | None:
    """Where the clause begins that is to be done before the one before it: "but first wave"."""
    if text.words[at - 2 : at] == ["but", "first"]:
        return at
    end = text.phrase_end(_BEFORE_THAT, at)
    start = skip_openings(text, end) if end else at
    return start if end and verbs_at(text.words, start) else None


def in_time(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Lay the table *before the guests come*: now; wave *until Ada comes*: that is asked about.

    Raises:
        Partly: The robot cannot tell when that is.
    """
    text = sentence.text
    if not (tells_when(text, at) and last):
        return None
    end = at
    while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
        end += 1
    if text.word(at) != "before":
        raise Partly(f"I cannot tell when that is, “{text.raw(at, end)}”", tuple(sentence.before))
    sentence.notes.passed.append((at, end))
    return last, end


def later(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Switch the lamp off *in ten minutes*: to wait, and then do it.

    Raises:
        Partly: "Walk two metres in four seconds" says how fast, which nobody can promise.
    """
    amount = told_later(sentence.text, at)
    if amount is None or not last:
        return None
    if isinstance(last[-1], GoTo) and last[-1].by is not None:
        said = sentence.text.raw(at, amount.end)  # two metres in four seconds: how fast, or when?
        raise Partly(f"I go at my own pace, and cannot promise “{said}”", tuple(sentence.before))
    return [Wait(duration_s=amount.value), *last], amount.end


def so_often(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Stand on one leg for three seconds, *four times*."""
    text = sentence.text
    amount = measure(text.words, at)
    if amount is None or amount.kind != "times" or not last:
        return None
    end = text.phrase_end(lexicon.IN_ALL, amount.end) or amount.end
    if end < len(text) and text.word(end) != FULL_STOP:
        return None
    return repeated(list(last), amount.value), end


def so_long(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Squat, *five seconds*; lean forward: *3 s*."""
    amount = measure(sentence.text.words, at)
    posed = last[-1] if last else None
    if amount is None or amount.kind != "time" or not isinstance(posed, Balance):
        return None
    apart = sentence.text.word(at - 1) == COMMA and posed.duration_s is None
    ends = amount.end >= len(sentence.text) or sentence.text.word(amount.end) in (COMMA, FULL_STOP)
    return (
        ([*last[:-1], replace(posed, duration_s=amount.value)], amount.end)
        if apart and ends
        else None
    )


_OF_ALL = lexicon.phrases(
    "all of them,the whole lot,the lot,them all,every one,every one of them,"
    "every last one,every single one,every last one of them,every single one of them,each one,"
    "each of them,them,each and every one,the whole bunch,the whole bunch of them,"
    "the lot of them,all those,all of those"
)
_ALL = lexicon.phrases("all,everything")
_BOTH = lexicon.phrases(
    "both of them,both,the pair of them,the pair,the two of them,them both,both of those"
)


def so_many(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Bring the cups here, *both of them*; ..., *all three of them*; ..., *every last one*."""
    text = sentence.text
    if not last:
        return None
    all_end, both_end = text.phrase_end(_OF_ALL, at), text.phrase_end(_BOTH, at)
    begin = at + (text.word(at) in ("all", "the"))
    amount = None if all_end or both_end else number(text.words, begin)
    end = all_end or both_end or (amount.end if amount else at)
    end += 2 if amount and text.words[end : end + 2] == ["of", "them"] else 0
    told = any(start < at - 3 and end in (at, at - 1) for start, end in sentence.notes.passed)
    apart = text.word(at - 1) == COMMA or (not amount and end > at + 1)
    if told and amount:
        return None  # where is the pear? We bought three, three!
    if end == at or not apart or (end < len(text) and text.word(end) not in (COMMA, FULL_STOP)):
        return None
    count = 2 if both_end else int(amount.value) if amount else "all"
    counted = [_counted(goal, count) for goal in last]
    sentence.notes.passed.append((at, end))
    return (counted, end) if counted != last or all_end or both_end else None


def from_there(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """A bun for Ada and a plum for me, *both from the bar*: there all of them are."""
    text, before = sentence.text, sentence.before
    both_end = text.phrase_end(_BOTH, at)
    listed = text.word(at - 1) == COMMA and len(before) > 1 and all(map(_is_fetched, before))
    end = both_end or text.phrase_end(_OF_ALL | _ALL, at) or (at if listed else None)
    start = text.phrase_end(lexicon.SOURCEWARDS, end) if end else None
    phrase = noun_phrase(text, start) if start else None
    if phrase is None or not phrase.is_spot or not last:
        return None
    some = max(2, len(last)) if both_end else len(before)
    at_ = to_place(phrase, sentence.scope)
    found = [_found_at(goal, at_) for goal in before[-some:]]
    del before[-some:]
    return found, phrase.end


def _is_fetched(goal: Goal) -> bool:
    return isinstance(goal, Bring) and goal.object.at is None


def _found_at(goal: Goal, place: str) -> Goal:
    """The goal with its thing at a place, unless it is said where that is."""
    thing = getattr(goal, "object", None)
    if not isinstance(thing, ObjectQuery) or thing.held or thing.at:
        return goal
    return substitute(goal, thing, replace(thing, at=place))


def _counted(goal: Goal, count: int | Literal["all"]) -> Goal:
    """The goal with so many of the things that it is about."""
    if isinstance(goal, ForEach) and len(goal.goals) == 1:
        held = ObjectQuery(held=True)
        some = replace(goal.object, count=count)
        return goal if count == "all" else substitute(goal.goals[0], held, some)
    thing = getattr(goal, "object", None)
    if not isinstance(thing, ObjectQuery) or thing.held or isinstance(goal, ForEach):
        return goal
    return substitute(goal, thing, replace(thing, count=count))


def who_asks(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Find someone *who has got a question*."""
    relative = sentence.text.word(at) in ("who", "that", "whose", "with")
    end = asks_end(sentence.text, at) if relative else None
    found = last[-1] if last else None
    if end is None or not isinstance(found, Find) or found.person is None:
        return None
    return [*last[:-1], Answer(what="question", person=found.person)], end
