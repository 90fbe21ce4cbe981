"""What is said after a clause and changes it: a condition, how often, in which order, who asks.

"... if it is there"; "..., four times"; "... after picking it up". What takes a clause back is in
:mod:`intents.english.corrections`.
"""

from typing import Literal

from msgspec.structs import replace

from intents.english.clauses.conditions import IF, as_soon_as, condition, mention
from intents.english.clauses.openings import begins_clause, otherwise_end, skip_openings
from intents.english.clauses.wishes import asks_end
from intents.english.corrections import retraction_end
from intents.english.phrases.times import tells_when
from intents.english.reading import Found, Sentence, clause_by_itself
from intents.english.sequences import sequence
from intents.english.substitution import substitute
from intents.english.trouble import Partly, ReadingError
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.measures import measure, number
from intents.goals import Answer, Condition, Find, ForEach, Goal, If, ObjectQuery, Present, Repeat


def left_undone(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Pick up the cup, no, *leave it*: what was asked last is not to be done."""
    text = sentence.text
    end = retraction_end(text, at)
    apart = text.word(at - 1) in (COMMA, FULL_STOP, "no")
    return ([], end) if end and apart and last else None


def on_condition(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Bring the mug *if the cup is not there*."""
    text = sentence.text
    start = text.phrase_end(IF, at)
    if start is None or text.word(at - 1) == FULL_STOP:
        return None
    try:
        holds, end = condition(text, start, sentence.scope)
    except ReadingError:
        return None
    soon = as_soon_as(text, at, holds)
    if soon and (end >= len(text) or text.word(end) == FULL_STOP):
        return [soon, *last], end
    unless = text.word(at) == "unless"
    if not unless and lexicon.ONES.intersection(text.words[start:end]):
        holds, last = _one_of_those(holds, last)
    comma = text.word(end) == COMMA and end < len(text)
    otherwise = otherwise_end(text, end + comma)
    if otherwise and not unless:
        if not any(getattr(goal, "object", None) for goal in last):
            mention(
                holds, sentence.scope, met=False
            )  # go out if the cup is not there, otherwise fetch it
        other, end = sequence(sentence.inner(), otherwise)
        return [If(condition=holds, then=tuple(last), else_=tuple(other))], end
    if end < len(text) and text.word(end) != FULL_STOP:
        return None
    if unless:
        return [If(condition=holds, else_=tuple(last))], end
    return [If(condition=holds, then=tuple(last))], end


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
    """Go to the shelf *after picking up the cup*; follow her *before coming back*."""
    word = sentence.text.word(at)
    if word not in ("after", "before") or not begins_clause(sentence.text, at + 1):
        return None
    other, end = clause_by_itself(sentence, skip_openings(sentence.text, at + 1))
    return ([*other, *last] if word == "after" else [*last, *other]), end


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


def so_often(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Stand on one leg for three seconds, *four times*."""
    text = sentence.text
    amount = measure(text.words, at)
    if amount is None or amount.kind != "times" or not last:
        return None
    end = text.phrase_end(lexicon.IN_ALL, amount.end) or amount.end
    if end < len(text) and text.word(end) != FULL_STOP:
        return None
    return [Repeat(times=int(amount.value), goals=tuple(last))], end


_OF_ALL = lexicon.phrases(
    "all of them,the whole lot,the lot,them all,every one,every one of them,"
    "every last one,every single one,every last one of them,every single one of them,each one,"
    "each of them,them,each and every one,the whole bunch,the whole bunch of them,"
    "the lot of them,all those"
)
_BOTH = lexicon.phrases("both of them,both,the pair of them,the pair,the two of them,them both")


def so_many(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Bring the cups here, *both of them*; ..., *all three of them*; ..., *every last one*."""
    text = sentence.text
    if text.word(at - 1) != COMMA or not last:
        return None
    all_end, both_end = text.phrase_end(_OF_ALL, at), text.phrase_end(_BOTH, at)
    begin = at + (text.word(at) in ("all", "the"))
    amount = None if all_end or both_end else number(text.words, begin)
    end = all_end or both_end or (amount.end if amount else at)
    end += 2 if amount and text.words[end : end + 2] == ["of", "them"] else 0
    if end == at or (end < len(text) and text.word(end) not in (COMMA, FULL_STOP)):
        return None
    count = 2 if both_end else int(amount.value) if amount else "all"
    counted = [_counted(goal, count) for goal in last]
    sentence.notes.passed.append((at, end))
    return (counted, end) if counted != last or all_end else None


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
