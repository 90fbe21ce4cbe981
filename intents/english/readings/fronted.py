"""What stands before the verb: "at the desk, find the cup", "of all the cups, bring me ..."."""

from msgspec.structs import replace

from intents.english.clauses.openings import skip_openings
from intents.english.clauses.pieces import read_pieces
from intents.english.clauses.questions import question
from intents.english.clauses.statements import IS, mention_phrase, stated
from intents.english.clauses.verb_clauses import read_verb
from intents.english.phrases.complements import read_complements
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import Locative
from intents.english.phrases.referents import to_object, to_place
from intents.english.reading import Found, Sentence
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, verbs_at
from intents.goals import Bring, Find, Goal, GoTo, ObjectQuery, Pick, Place

_HANDLES = ("bring", "put", "take", "give", "pick", "drop", "collect")
"""Senses of what is done to a thing that has to be said."""


def fronted(sentence: Sentence, at: int) -> Found | None:
    """At the desk, find the cup; the red cup, bring it to me; on the table is a cup."""
    text, scope = sentence.text, sentence.scope
    if text.word(at) in ("i", "we"):
        return None  # I walk behind you: that is what who speaks does
    complements, end = read_complements(text, at)
    after = skip_openings(text, end)
    usable = bool(complements) and all(
        c.phrases and c.role in ("", "at", "from", "into", "to") for c in complements
    )
    if not usable or complements[0].phrase.noun == "pronoun":
        return None
    if "but" in text.words[end:after]:
        return None  # all the toys into the box, but leave the ball
    whole = text.word(end) == FULL_STOP and any(c.role in ("to", "into") for c in complements)
    if whole and complements[0].role == "":
        return None  # one bun to Ada. Then wave
    first = complements[0]
    if first.role == "at" and _is_where(text, after):
        where = to_place(first.phrase, scope)
        found = stated(text, after + (text.word(after) in ("is", "are")), scope, where)
        return ([], found[1]) if found else None
    asked = question(text, after, scope)
    if asked and first.role == "at":
        return [GoTo(place=to_place(first.phrase, scope)), *asked[0]], asked[1]
    if not verbs_at(text.words, after):
        return None
    inflected = text.word(after) != base_form(text.word(after))
    if inflected and text.word(end) != COMMA:
        return None
    for complement in complements:
        if complement.role == "":
            for phrase in complement.phrases:
                mention_phrase(phrase, scope)
    apart = text.word(end) in (COMMA, FULL_STOP)
    things = [first] if first.role == "" and _leaves_out(text, after, apart=apart) else []
    if things and first.phrase.is_person and not apart and _is_all(text, after):
        return None  # the children take: what they do
    return read_verb(sentence, after, [*things, *(c for c in complements if c.role)])


def _is_all(text: Text, at: int) -> bool:
    """Whether a verb is the last that is said."""
    return any(text.word(end) in (COMMA, FULL_STOP) for _, end in verbs_at(text.words, at))


def in_pieces(sentence: Sentence, at: int) -> Found | None:
    """Scarf, luggage rack, bring it here; the saucers, blue, put them on the bar."""
    text, pieces = sentence.text, read_pieces(sentence.text, at)
    if pieces is None or pieces.things is None or len(pieces.things.phrases) > 1:
        return None
    after = skip_openings(text, pieces.end)
    if text.word(pieces.end) not in (COMMA, FULL_STOP) or not verbs_at(text.words, after):
        return None
    if any(c.role not in ("", "at", "from") or not c.phrase.is_spot for c in pieces.said):
        return None
    thing = pieces.things.phrase
    thing.places += [Locative(c.how, c.phrase) for c in pieces.said]
    mention_phrase(thing, sentence.scope)
    left_out = _leaves_out(text, after, apart=True)
    return read_verb(sentence, after, [pieces.things] if left_out else [])


def _leaves_out(text: Text, at: int, *, apart: bool) -> bool:
    """Whether a verb says nothing of what is handled: the scarf *take to Olga*.

    ``apart`` tells that a sign stands before it: the scarf, rack: *move to the bar*.
    """
    senses = verbs_at(text.words, at)
    handled = [end for sense, end in senses if sense in _HANDLES]
    if not handled or (senses[0][0] not in _HANDLES and not apart):
        return False
    first = handled[0]
    bare = [c for c in read_complements(text, first)[0] if c.phrases and c.role == ""]
    return all(c.phrase.is_person or c.phrase.noun in ("here", "there") for c in bare)


def out_of(sentence: Sentence, at: int) -> Found | None:
    """Of *all the cups on the table, bring me the largest one*."""
    text = sentence.text
    first = text.phrase_end(_AMONG, at)
    phrase = noun_phrase(text, _within(text, first)) if first else None
    grouped = phrase is not None and first is not None and phrase.start > first
    if phrase is None or not (grouped or text.word(phrase.end) == COMMA):
        return None
    start = skip_openings(text, phrase.end)
    if phrase.is_person or not verbs_at(text.words, start):
        return None
    among = replace(to_object(phrase, sentence.scope), count=None)
    sentence.scope.mention(among)
    goals, end = read_verb(sentence, start)
    return [_one_of(goal, among) for goal in goals], end


_AMONG = lexicon.phrases("of,among,out of,from,from among")
_GROUPS = lexicon.words("row pile stack set bunch group collection heap line lot")


def _within(text: Text, at: int) -> int:
    """Of *the row of* cups: where what it is a row of begins."""
    group = at + (text.word(at) in lexicon.DETERMINERS)
    return group + 2 if text.word(group) in _GROUPS and text.word(group + 1) == "of" else at


def _one_of(goal: Goal, among: ObjectQuery) -> Goal:
    """A goal whose thing is one of those."""
    if not isinstance(goal, Bring | Find | Pick | Place):
        return goal
    one = goal.object or among
    name = one.name or (None if one.category else among.name)
    category = one.category or (None if one.name else among.category)
    return replace(goal, object=replace(one, name=name, category=category, at=one.at or among.at))


def _is_where(text: Text, at: int) -> bool:
    """On the table *is a cup*; ... *there is a cup*; ... *a person is standing*."""
    if text.word(at) in ("is", "are"):
        return True
    if text.word(at) == "there":
        return text.phrase_end(IS, at + 1) is not None
    phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
    return phrase is not None and text.word(phrase.end) in ("is", "are")
