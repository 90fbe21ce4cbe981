"""Taking back what was just said: "the red cup, no wait, the blue one"."""

from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import Locative, NounPhrase
from intents.english.phrases.referents import is_person, to_object, to_person, to_place
from intents.english.reading import Found, Sentence, clause_by_itself
from intents.english.substitution import substitute
from intents.english.trouble import Misfit
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.lexicon import GOALWARDS, LOCATIVES, SOURCEWARDS, phrases
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Goal, ObjectQuery

_MARKERS = phrases(
    "no wait,wait no,no,i mean,i meant,or rather,rather,scratch that,correction,make that,sorry,"
    "oh sorry,not that,no sorry,wait,oh no,oops,my mistake,i mean to say,sorry i meant,"
    "sorry i mean,no i mean,no i meant,no not that,not that one,not this one,"
    "no not that one,no not this one,wrong one,no make that,or better,better,on second thought,"
    "on second thoughts,strike that,change that,not there"
)
_BEHIND = phrases("i mean,i meant,rather,instead,i mean to say,sorry,that is")
"""What stands behind a correction rather than before it."""
_OPENINGS = ("sorry", "oh", "wait")
"""Markers that open a new sentence as often as they take back the one before."""


def _marker_end(text: Text, at: int) -> int | None:
    """Where the marker of a correction ends, if one begins at a word."""
    end = text.phrase_end(_MARKERS, at)
    if end is None or (text.word(at) == "wait" and text.word(end) != COMMA):
        return None
    while text.word(end) == COMMA or text.phrase_end(_MARKERS, end):
        end = text.phrase_end(_MARKERS, end) or end + 1
    return end if end < len(text) else None


_RETRACTS = phrases("leave it,leave that,leave them,leave it be,leave it alone,let it be")


def retraction_end(text: Text, at: int) -> int | None:
    """Where a clause ends that leaves what was asked undone: "leave it"."""
    end = text.phrase_end(_RETRACTS, at)
    return end if end and (end >= len(text) or text.word(end) in (COMMA, FULL_STOP)) else None


def taken_back(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """The red cup, *no the blue one*: looked for before "no" is passed over as an opening."""
    text = sentence.text
    while text.word(at) in (COMMA, FULL_STOP) and at < len(text):
        at += 1
    end = _marker_end(text, at)
    if end is None or not last:
        return None
    begins = at == 0  # it takes back what was said before, if it is no command of its own
    plain = text.word(end - 1) != COMMA and end < at + 2  # no cup there?
    if begins and (verbs_at(text.words, end) or (plain and text.word(end) != "the")):
        return None
    new_sentence = text.word(at - 1) == FULL_STOP and text.word(at) in _OPENINGS
    if new_sentence and verbs_at(text.words, end):
        return None
    return correction(sentence, at, last)


def correction(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """No wait, the blue one; I mean go to the kitchen."""
    text, scope = sentence.text, sentence.scope
    end = _marker_end(text, at) or _told_apart(text, at, scope.object) or _meant(text, at)
    if end is None:
        return None
    undone = retraction_end(text, end)
    if undone:
        return [], undone
    if verbs_at(text.words, end):
        return clause_by_itself(sentence, end)
    phrase = noun_phrase(text, end) or _spot_after_preposition(text, end)
    if phrase is None:
        return None
    source = text.phrase_end(SOURCEWARDS, phrase.end + 1)
    spot = noun_phrase(text, source) if source and text.word(phrase.end) == COMMA else None
    source = source if spot else text.phrase_end(SOURCEWARDS, phrase.end)
    spot = spot or (noun_phrase(text, source) if source else None)
    if spot is not None and spot.is_spot and not phrase.is_spot:
        phrase.places.append(Locative(None, spot))  # two gloves, from the cabinet
        phrase.end = spot.end
    old = scope.person if is_person(phrase, scope) else scope.object
    if phrase.is_spot:
        old, new = scope.place, to_place(phrase, scope)
    elif is_person(phrase, scope):
        new = to_person(phrase, scope)
    else:
        new = to_object(phrase, scope)
    if old is None:
        raise Misfit("I do not know what to correct")
    scope.mention(new)
    return [substitute(g, old, new) for g in last], _past_marker(text, phrase.end)


def _spot_after_preposition(text: Text, at: int) -> NounPhrase | None:
    """No, *on the table*: the place, if it is one."""
    located = text.lookup(LOCATIVES, at)
    start = located[1] if located else text.phrase_end(GOALWARDS, at)
    phrase = noun_phrase(text, start) if start else None
    return phrase if phrase and phrase.is_spot else None


def _meant(text: Text, at: int) -> int | None:
    """Put it on the table, *on the counter I mean*: the marker stands behind."""
    if verbs_at(text.words, at) or text.word(at - 1) not in (COMMA, FULL_STOP):
        return None
    phrase = noun_phrase(text, at) or _spot_after_preposition(text, at)
    return at if phrase and _past_marker(text, phrase.end) > phrase.end else None


def _past_marker(text: Text, at: int) -> int:
    """Past "I mean" at the end of a correction."""
    start = at + (text.word(at) == COMMA)
    end = text.phrase_end(_BEHIND, start)
    return end if end and (end >= len(text) or text.word(end) in (COMMA, FULL_STOP)) else at


def _told_apart(text: Text, at: int, old: ObjectQuery | None) -> int | None:
    """Where *the blue one* begins that tells which cup was meant a sentence before."""
    if old is None or text.word(at - 1) not in (COMMA, FULL_STOP) or old.count not in (None, 1):
        return None
    phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
    if phrase is None or phrase.noun != "one":
        return None
    closed = phrase.end >= len(text) or text.word(phrase.end) == FULL_STOP
    told = (phrase.color and not old.color) or (phrase.size and not old.size)
    most = phrase.superlative and (
        not old.superlative or (phrase.superlative == old.superlative and phrase.places)
    )
    return at if closed and (told or most) else None
