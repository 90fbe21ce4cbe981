"""Remarks: what only tells something is noted, and passed over.

"There is a cup on the table, ..."; "I left my comb on the bench, ..."; "I am thirsty, ...".
"""

from contextlib import suppress

from intents.english.clauses.openings import purpose_end, sits_oneself_end
from intents.english.clauses.statements import IS, mention_phrase, stated
from intents.english.phrases.noun_phrases import noun_phrase, read_postmodifiers
from intents.english.phrases.phrase import NounPhrase
from intents.english.reading import Found, Sentence
from intents.english.substitution import substitute
from intents.english.trouble import ReadingError
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, singular
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Person

_KNOWN = lexicon.phrases(
    "i left,i put,i placed,i forgot,i saw,i dropped,i have left,i have put,i have forgotten,"
    "i have seen,i just saw,i just put,we left,we put,we have left,you left,you put,i keep,we keep,"
    "we have,i have,i must have left,i might have left,i may have left,i think i left,"
    "i have dropped,i set,i laid,i stuck,i parked,i popped,i stowed,i stashed,i tucked,i hung,"
    "she left,he left,they left,he forgot,she forgot,somebody left,someone left"
)
_LEFT = lexicon.phrases(
    "left,forgot,dropped,lost,has left,has forgotten,has dropped,has lost,have left,have forgotten,"
    "have dropped,have lost,must have left,must have forgotten,must have dropped,had left"
)
_PRONOUNS = lexicon.words("he she they who")
_TAKEN_UP = lexicon.words("it them one ones that those")
_SOMEWHERE = lexicon.words(
    "somewhere here there yesterday earlier today just now around again lying about"
)
_ABOUT = lexicon.words("down back away up out off behind")
_SHORT = 4
"""What is said of somebody in so many words is a remark."""


def aimed_at(sentence: Sentence, at: int) -> Found | None:
    """*To make the bed*, take the pillow off it; *I want to sit down*: passed over."""
    text = sentence.text
    end = purpose_end(text, at) or sits_oneself_end(text, at)
    if end is None:
        return None
    for n in range(at, end):
        phrase = noun_phrase(text, n) if text.name_at(n) else None
        if phrase is not None and not phrase.is_person:
            with suppress(ReadingError):
                mention_phrase(phrase, sentence.scope)
    return [], end


def left_somewhere(sentence: Sentence, at: int) -> Found | None:
    """I left my comb on the bench: it is noted; I need my comb, *I left it on the bench*."""
    start = sentence.text.phrase_end(_KNOWN, at) or _left_by_somebody(sentence.text, at)
    phrase = noun_phrase(sentence.text, start) if start else None
    if phrase is None:
        return None
    if sentence.text.word(phrase.end) in _ABOUT and not phrase.places:
        phrase.end += 1  # I set it down on the bench
        read_postmodifiers(sentence.text, phrase)
    if phrase.said in ("it", "them") and phrase.places:
        _told_of_last(sentence, phrase)
    elif phrase.name("object", "category"):
        mention_phrase(phrase, sentence.scope)
    else:
        return None
    end, text = phrase.end, sentence.text
    while text.word(end) in _SOMEWHERE:
        end += 1
    return [], end


def _left_by_somebody(text: Text, at: int) -> int | None:
    """Past *a guest left*, *one of the guests has forgotten*: of somebody who has no name."""
    one_of = 2 * (text.words[at : at + 2] in (["one", "of"], ["some", "of"]))
    who = None if verbs_at(text.words, at) else noun_phrase(text, at + one_of)
    if who is None or who.noun != "person" or who.said in _PRONOUNS:
        return None
    return text.phrase_end(_LEFT, who.end)


def found_there(sentence: Sentence, at: int) -> Found | None:
    """*You will find my comb on the bench*; *see my comb on the bench?* Bring it to me."""
    text = sentence.text
    told = text.word(at) in ("find", "see") and text.word(at - 2) in ("you", "should")
    told = told or (text.word(at) == "see" and text.word(at - 1) in (COMMA, FULL_STOP))
    phrase = noun_phrase(text, at + 1) if told else None
    if phrase is None or not phrase.name("object", "category") or not phrase.places:
        return None
    rest = text.words[phrase.end :]
    goes_on = text.word(phrase.end) in (COMMA, FULL_STOP) and not _TAKEN_UP.isdisjoint(rest)
    if not goes_on:
        return None
    mention_phrase(phrase, sentence.scope)
    return [], phrase.end


def feeling(sentence: Sentence, at: int) -> Found | None:
    """I am thirsty after all that work, ...: it is passed over, if a command follows."""
    text = sentence.text
    if text.words[at : at + 2] not in (["i", "am"], ["we", "are"], ["i", "feel"]):
        return None
    end = at + 2
    while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
        phrase = noun_phrase(text, end)
        if phrase and phrase.name("object", "category") and not phrase.is_person:
            mention_phrase(phrase, sentence.scope)
        end = max(end + 1, phrase.end if phrase else end)
    return ([], end) if at + 2 < end < len(text) else None


def _told_of_last(sentence: Sentence, phrase: NounPhrase) -> None:
    """What is told of "it" is true of it in what was asked before."""
    scope, was = sentence.scope, sentence.scope.object
    mention_phrase(phrase, scope)
    if was is not None and scope.object is not None:
        now = scope.object
        sentence.before[:] = [substitute(goal, was, now) for goal in sentence.before]


def statement(sentence: Sentence, at: int) -> Found | None:
    """She is in the kitchen: what was said of her is true of her there."""
    scope, before = sentence.scope, sentence.before
    old = (scope.object, scope.person)
    found = stated(sentence.text, at, scope)
    if found is None:
        return None
    phrase, end = found
    for was, now in zip(old, (scope.object, scope.person), strict=True):
        if phrase.noun == "pronoun" and was is not None and now is not None:
            before[:] = [substitute(goal, was, now) for goal in before]
    return [], end


def told_of(sentence: Sentence, at: int) -> Found | None:
    """Ada is thirsty, ...; the door is open, ...: passed over, but they are spoken of now."""
    text = sentence.text
    phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
    predicate = text.phrase_end(IS, phrase.end) if phrase else None
    if phrase is None or predicate is None or phrase.noun in ("operator", "here", "there"):
        return None
    end = predicate
    while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
        end += 1
    if end >= len(text) or end - predicate > _SHORT:
        return None
    who = text.name_at(predicate)
    if phrase.noun == "pronoun" and who and who.of("person"):
        sentence.scope.mention(Person(name=who.of("person")))  # that was Leo
    if phrase.noun == "unknown":
        sentence.scope.device = singular(phrase.said)
    elif phrase.noun == "name":
        mention_phrase(phrase, sentence.scope)
    return [], end
