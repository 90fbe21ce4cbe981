"""Telegrams: things and where they go, without a verb.

"Red cup to the table"; "both cups off the table, onto the counter"; "the socks on the floor,
laundry basket, please"; "two bowls on the table, please"; "clipboard to Ada".
"""

from intents.english.clauses.pieces import all_of_them
from intents.english.clauses.verb_clauses import framed
from intents.english.phrases.complements import Complement, read_complements
from intents.english.phrases.phrase import Locative, NounPhrase
from intents.english.reading import Found, SaidVerb, Sentence
from intents.english.words.lexer import COMMA, FULL_STOP, singular
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at

_GOALS = ("to", "into", "at", "for")
_ON_OR_IN = ("on", "in", None)


def telegram(sentence: Sentence, at: int) -> Found | None:
    """Red cup to the table; both cups off the table, onto the counter."""
    text = sentence.text
    if sentence.before or not _begins(sentence, at) or verbs_at(text.words, at):
        return None
    complements, end = read_complements(text, at)
    if not complements or complements[0].role or not _are_things(complements[0]):
        return None
    things, *rest = complements
    where = rest.pop() if rest and rest[-1].phrases and rest[-1].role in _GOALS else None
    if any(c.role != "from" for c in rest) or not _closes(text, end):
        return None
    source = bool(rest) or bool(things.phrases[-1].places)
    if where is None and source:
        where, end = _in_next_segment(text, end) or (None, end)
    if where is None and not rest:
        where = _set_apart(sentence, things, at)
    if where is None or not (where.phrase.is_spot or _is_receiver(where) or where.role == "into"):
        return None
    if where.role == "for" and not (
        text.polite or all(map(_is_some, things.phrases)) or _is_bare(things)
    ):
        return None
    verb = "bring" if _is_receiver(where) else "put"
    if verb == "put":
        all_of_them(things)
    sentence.notes.verb = SaidVerb(at, at, ("bring" if _is_receiver(where) else "put",))
    return framed(sentence, verb, verb, [things, *rest, where], first=at, end=end)


def _begins(sentence: Sentence, at: int) -> bool:
    """Whether nothing was said yet that asks for something."""
    passed = {n for start, end in sentence.notes.passed for n in range(start, end)}
    return all(n in passed or not sentence.text.word(n)[0].isalnum() for n in range(at))


def _are_things(complement: Complement) -> bool:
    things = [p.name("object", "category") or p.noun == "object" for p in complement.phrases]
    return bool(things) and all(things)


def _is_receiver(complement: Complement) -> bool:
    return complement.role in ("to", "for") and complement.phrase.is_person


def _is_bare(things: Complement) -> bool:
    """Bottle for Ada: a telegram, whatever is asked politely or not."""
    return not any(phrase.determiner for phrase in things.phrases)


def _closes(text: Text, at: int) -> bool:
    return at >= len(text) or text.word(at) in (COMMA, FULL_STOP, "but")


def _in_next_segment(text: Text, at: int) -> tuple[Complement, int] | None:
    """Off the table, *onto the counter*; on the floor, *laundry basket*."""
    if text.word(at) != COMMA:
        return None
    complements, end = read_complements(text, at + 1)
    where = complements[0] if len(complements) == 1 and complements[0].phrases else None
    if where is None or not _closes(text, end) or where.role not in (*_GOALS, ""):
        return None
    container = where.role == "into" and where.phrase.name("object")
    if len(where.phrases) > 1 or not (where.phrase.name("place", "room") or container):
        return None
    if where.role == "":
        if not where.phrase.name("place"):
            return None  # the cup on the table, kitchen: where that table is
        where.role = "to"
    return where, end


def _set_apart(sentence: Sentence, things: Complement, at: int) -> Complement | None:
    """Two bowls *on the table*, please: where they go, and not which ones; also after "first"."""
    text = sentence.text
    last = things.phrases[-1]
    first = text.word(at - 1) in ("first", "firstly")
    wanted = text.polite and all(_is_some(phrase) for phrase in things.phrases)
    where: Locative | None = last.places[-1] if last.places and (first or wanted) else None
    if where is None or where.how not in _ON_OR_IN or not where.of.name("place"):
        return None
    last.places.pop()
    return Complement(role="at", how=where.how, phrases=[where.of])


def _is_some(phrase: NounPhrase) -> bool:
    """Whether it is no particular thing: "two bowls", "a bowl"."""
    some = isinstance(phrase.count, int) or phrase.determiner in ("a", "an", "some")
    plural = phrase.said.split()[-1] != singular(phrase.said.split()[-1])
    return some or phrase.count == "all" or (plural and not phrase.determiner)
