"""Needs: the wish behind what is said of somebody.

"I cannot find my keys"; "Ada needs the stapler"; "Emil wants to go to the hall"; "Ada has a
question"; "I need you in the cellar".
"""

from intents.english.clauses.verb_clauses import framed
from intents.english.clauses.wishes import NEEDS, WISHES, asks_end
from intents.english.phrases.complements import (
    Complement,
    ends_clause,
    first_with,
    read_complements,
    read_list,
)
from intents.english.phrases.noun_phrases import noun_phrase, read_postmodifiers
from intents.english.phrases.phrase import SOMETHING
from intents.english.phrases.referents import ME, is_person, sought, to_object, to_person, to_place
from intents.english.reading import Found, Sentence
from intents.english.trouble import Unclear
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Answer, Bring, GoTo, Guide, Open

_LOST = lexicon.phrases(
    "i lost,i have lost,i misplaced,i have misplaced,i can not find,i could not find,"
    "can not find,could not find,i do not know where,i have no idea where,i do not find,"
    "i am missing,we can not find,i can not see,we can not see,can not see,i do not see"
)
_LOOKS_FOR = lexicon.phrases(
    "i am looking for,we are looking for,i am trying to find,we are trying to find,i am after,"
    "i have come to see,i came to see,i am here to see,i am here for,i want to see,i need to see,"
    "i would like to see,i should like to see,i want to find,i need to find,i would like to find,"
    "i want to speak to,i need to speak to,i would like to speak to,i am searching for"
)
"""How one says whom one is looking for."""
_GETS = lexicon.phrases("gets,gets to have,receives")
"""The same where it goes on from an order: "the pen to Ada, and Leo *gets* the cup"."""
_NEEDS_TO_GO = lexicon.phrases(
    "needs to get,needs to go,wants to go,wants to get,would like to go,would like to get,"
    "has to go,has to get,must go,must get,needs to be brought,needs to be taken,"
    "would like to be brought,would like to be taken,wishes to go,is looking for the way,"
    "wants to be taken,wants to be brought,needs to come,wants to come"
)
_HANDED_OVER = lexicon.words(
    "delivering delivered bringing brought fetching fetched handing handed taking"
)
"""What follows a thing that somebody needs: "Ada needs a torch *fetching*"."""
_REQUIRED = lexicon.phrases(
    "is wanted,are wanted,wanted,is required,are required,required,is needed,are needed,needed,"
    "'s wanted,'s needed,'s required,is requested,are requested,requested,is called for,"
    "are called for"
)
_WILL_DO = lexicon.phrases(
    "will do,would do,will have to do,will be fine,would be fine,would be nice,would be lovely,"
    "would be great,would be good,will be good,would be perfect,would be wonderful,"
    "would suit me,will suit me,would go down well,would hit the spot,would be ideal"
)
"""How it is said of a thing that one would like it."""
_AIRS = lexicon.phrases(
    "let some air in,let some fresh air in,let in some air,let in some fresh air,let the air in,"
    "let fresh air in,let in fresh air,let a bit of air in,let a little air in,air the room,"
    "get some air in,get some fresh air in,let in a bit of air"
)
_NICELY = lexicon.words("me us fine nicely just well too then perfectly also instead right now")


def lost(sentence: Sentence, at: int) -> Found | None:
    """I cannot find my keys: to look for them."""
    text = sentence.text
    start = text.phrase_end(_LOST, at)
    phrase = noun_phrase(text, start) if start else None
    if phrase is None or phrase.said in SOMETHING or _is_nothing(text, phrase.start):
        return None
    end = phrase.end
    end += text.word(end) in ("is", "are") and text.word(phrase.start - 1) == "where"
    end += text.word(end) in ("anywhere", "anymore")
    sentence.notes.wanted = True
    return [sought(phrase, sentence.scope)], end


def _is_nothing(text: Text, at: int) -> bool:
    """I can not see *a thing*: nothing at all."""
    thing = at + 1 + (text.word(at + 1) in ("single", "bloody", "damn"))
    closes = text.word(thing + 1) in (COMMA, FULL_STOP, "in", "here", "there")
    return text.word(at) in ("a", "one") and text.word(thing) == "thing" and closes


def looked_for(sentence: Sentence, at: int) -> Found | None:
    """I am looking for a gentleman called Ravi: to look for him."""
    text = sentence.text
    start = text.phrase_end(_LOOKS_FOR, at)
    phrase = noun_phrase(text, start) if start else None
    if phrase is None or not phrase.is_person or phrase.noun == "operator":
        return None
    sentence.notes.wanted = True
    return [sought(phrase, sentence.scope)], phrase.end


def needed(sentence: Sentence, at: int) -> Found | None:
    """Ada in the lab needs the stapler: to bring it to her; Emil wants to go to the hall."""
    text, scope = sentence.text, sentence.scope
    if verbs_at(text.words, at) and not text.name_at(at):
        return None
    phrase = noun_phrase(text, at)
    known = phrase is not None and phrase.said in ("he", "she") and scope.person is not None
    if phrase is None or not (phrase.is_person or known) or phrase.noun == "operator":
        return None
    going, needing = text.phrase_end(_NEEDS_TO_GO, phrase.end), None
    if going is None:
        needing = text.phrase_end(NEEDS, phrase.end)
        if needing is None and sentence.before:
            needing = text.phrase_end(_GETS, phrase.end)
    complements, end = read_complements(text, going or needing or phrase.end)
    if going:
        goal = first_with(complements, "to", "into")
        if goal is None or len(complements) > 1:
            return None
        sentence.notes.wanted = True
        there = to_place(goal.phrase, scope)
        return [Guide(person=to_person(phrase, scope), to=there)], end
    thing = complements[0] if needing and len(complements) == 1 else None
    if (
        needing is None
        or thing is None
        or thing.role
        or not thing.phrases
        or thing.phrase.is_person
    ):
        return None
    sentence.notes.wanted = True
    end += text.word(end) in _HANDED_OVER
    who, verb = Complement(role="to", phrases=[phrase]), text.raw(phrase.end, needing)
    return framed(sentence, "bring", verb, [thing, who], first=needing, end=end)


def required(sentence: Sentence, at: int) -> Found | None:
    """The torch is wanted; two saucers required in the spa; the scarf is needed by Olga."""
    text = sentence.text
    if verbs_at(text.words, at) and not text.name_at(at):
        return None
    things, end = read_list(text, at)
    start = text.phrase_end(_REQUIRED, end) if things else None
    if start is None or not all(p.name("object", "category") for p in things):
        return None
    verb, thing = " ".join(text.words[end:start]), Complement(phrases=things)
    by = noun_phrase(text, start + 1) if text.word(start) == "by" else None
    if by is not None:
        who = Complement(role="to", phrases=[by])
        return framed(sentence, "bring", verb, [thing, who], first=start, end=by.end)
    complements, end = read_complements(text, start)
    if not ends_clause(text, end) or len(complements) > 1:
        return None
    for one in complements:
        if not one.phrases or one.role not in ("at", "for", ""):
            return None
        one.role = "to"
    return framed(sentence, "bring", verb, [thing, *complements], first=start, end=end)


def will_do(sentence: Sentence, at: int) -> Found | None:
    """Just water *will do me fine*; a tea *would be lovely*: it is wanted."""
    text = sentence.text
    if verbs_at(text.words, at) and not text.name_at(at):
        return None
    phrase = noun_phrase(text, at)
    if phrase is None or not phrase.name("object", "category") or phrase.is_person:
        return None
    end = text.phrase_end(_WILL_DO, phrase.end)
    while end is not None and text.word(end) in _NICELY:
        end += 1
    if end is None or not ends_clause(text, end):
        return None
    return [Bring(object=to_object(phrase, sentence.scope), to=ME)], end


def aired(sentence: Sentence, at: int) -> Found | None:
    """Let some air in: to open a door or window, which may be named behind it.

    Raises:
        Unclear: It is not said which.
    """
    text = sentence.text
    start = text.phrase_end(_AIRS, at)
    if start is None:
        return None
    start += text.word(start) in ("through", "by", "at", "with", "from", COMMA, FULL_STOP)
    spot = noun_phrase(text, start) if start < len(text) else None
    said = spot.said.split()[-1:] if spot is not None else []
    if spot is None or said not in (["door"], ["window"], ["doors"], ["windows"]):
        raise Unclear("Which door or window shall I open?")
    end = text.phrase_end(_WILL_DO, spot.end) or spot.end
    while end > spot.end and text.word(end) in _NICELY:
        end += 1
    return [Open(what=to_place(spot, sentence.scope))], end


def has_a_question(sentence: Sentence, at: int) -> Found | None:
    """Ada has a question."""
    text, scope = sentence.text, sentence.scope
    phrase = None if verbs_at(text.words, at) else noun_phrase(text, at)
    if phrase is None or not is_person(phrase, scope):
        return None
    end = None if text.word(phrase.end) == "to" else asks_end(text, phrase.end)
    if end is None:
        return None
    phrase.end = end
    read_postmodifiers(text, phrase)
    return [Answer(what="question", person=to_person(phrase, scope))], phrase.end


def wanted_there(sentence: Sentence, at: int) -> Found | None:
    """I need you in the cellar."""
    text = sentence.text
    start = text.phrase_end(WISHES, at)
    if start is None or text.word(start) != "you":
        return None
    start += 3 if text.words[start + 1 : start + 3] == ["to", "be"] else 1
    complements, end = read_complements(text, start)
    if len(complements) != 1 or complements[0].role not in ("at", "to"):
        return None
    return [GoTo(place=to_place(complements[0].phrase, sentence.scope))], end
