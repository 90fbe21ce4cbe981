"""To whom something is said: "tell Ada, Leo and Emil that ...", "say good night to Emil"."""

from intents.english.clauses.markers import marker_end
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import NounPhrase
from intents.english.phrases.referents import Scope, is_person, to_person, to_place
from intents.english.trouble import NotUnderstood, Unclear
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, QUOTE
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Person

TO = lexicon.words("to for with")
"""What may stand before a listener."""
QUESTION_WORDS = lexicon.words("question questions quiz quizzes query queries")
"""What is answered: behind "her" one of these is a thing, and she no listener."""
_MESSAGE_BEGINS = lexicon.words("that to about if whether how what where when why who , .")
"""What stands between a listener and what is to be told."""
_SENDERS = (["for", "me"], ["for", "us"])
_TO_SOMEBODY = lexicon.words(
    "went go gone going gave give given spoke talk talked brought sent told"
)
"""What somebody does who tells of it: "I went to Leo" is not said to Leo."""
_WISHES = lexicon.phrases(
    "sorry,thanks,thank you,thank you very much,many thanks,a big thank you,well done,"
    "congratulations,hi,hello,hey,bye,goodbye,good bye,bye bye,good morning,good day,"
    "good afternoon,good evening,good night,welcome,happy birthday,merry christmas,"
    "good luck,get well,get well soon,cheers,please"
)
"""What is said to somebody, and not of them."""
_OF_THEM = lexicon.words("he she they it we i because since as cause so and")


def listeners(text: Text, at: int, scope: Scope) -> list[NounPhrase]:
    """The people that are named one after the other at a word: "Ada and Leo", "Ada, Leo and Emil".

    Behind a comma somebody is named as well only where the list ends with "and".
    """
    found: list[NounPhrase] = []
    ends, last = 0, ""
    while (phrase := listener_at(text, at, scope)) is not None:
        if found and not phrase.name("person"):
            break
        found.append(phrase)
        ends = len(found) if last != COMMA else ends
        last = text.word(phrase.end)
        if not phrase.name("person") or last not in ("and", COMMA):
            break
        at = phrase.end + 1
    return found[:ends]


def listener_at(text: Text, at: int, scope: Scope) -> NounPhrase | None:
    """The person at a word, if one is there."""
    if text.word(at) in ("his", "her") and text.word(at + 1) in QUESTION_WORDS:
        return None
    if text.word(at) == "where":
        return None
    phrase = noun_phrase(text, at)
    return phrase if phrase and is_person(phrase, scope) else None


def listening_place(text: Text, at: int, scope: Scope) -> tuple[Person, int] | None:
    """Announce to *the kitchen* that ...: whoever is there, where a message follows."""
    phrase = noun_phrase(text, at) if text.word(at) in lexicon.DETERMINERS else None
    if phrase is None or not phrase.name("room", "place") or phrase.name("object", "person"):
        return None
    know = text.words[phrase.end : phrase.end + 1] == ["know"]
    follows = text.word(phrase.end + know) in ("that", QUOTE) or know
    return (Person(at=to_place(phrase, scope)), phrase.end + know) if follows else None


def last_listener(text: Text, at: int, end: int, scope: Scope) -> tuple[Person | None, int]:
    """The person after the last "to", and where the words before it end."""
    for to in range(end - 2, at - 1, -1):
        if text.word(to) in TO:
            phrase = listener_at(text, to + 1, scope)
            if phrase and phrase.end >= end:
                return to_person(phrase, scope), to
    return None, end


def meant_listener(text: Text, first: NounPhrase, scope: Scope) -> NounPhrase:
    """Tell Ada, *no, Leo*, that ...: who is told in the end."""
    marked = marker_end(text, first.end + 1) if text.word(first.end) == COMMA else None
    other = listener_at(text, marked, scope) if marked else None
    if other is None or text.word(other.end) not in (COMMA, "that", QUOTE, FULL_STOP):
        return first
    other.end += text.word(other.end) == COMMA
    return other


def refuse_more(text: Text, at: int) -> None:
    """Tell Julia *and somebody*: no message begins so.

    Raises:
        Unclear: Nothing is said that is to be told.
        NotUnderstood: It is to be told to somebody as well whom nobody knows.
    """
    if verbs_at(text.words, at + 1):
        raise Unclear("What shall I tell?")
    end = next((n for n in range(at + 1, len(text)) if text.word(n) in _MESSAGE_BEGINS), at + 2)
    raise NotUnderstood(f"I do not know who “{text.raw(at + 1, end)}” is")


def refuse_unknown(text: Text, at: int, end: int) -> None:
    """Say sorry *to granny*, thanks *to the postman*: what is wished to somebody is said to them.

    Raises:
        NotUnderstood: Nobody knows who that is.
    """
    to = text.phrase_end(_WISHES, at)
    if to is not None and text.word(to) == "to" and to + 1 < end:
        raise NotUnderstood(f"I do not know who “{text.raw(to + 1, end)}” is")


def addressed_end(text: Text, at: int, end: int, scope: Scope) -> tuple[int, int] | None:
    """Happy birthday *to Grandma*, she is eighty; good night *to Leo from me*.

    Where the listener's name ends, and where what belongs to it ends; None if words follow that
    may well be part of what is to be said.
    """
    went = at
    while went < end and text.word(went) not in _TO_SOMEBODY:
        went += 1
    for to in range(at + 1, went if text.word(at) in _OF_THEM else end):
        phrase = listener_at(text, to + 1, scope) if text.word(to) == "to" else None
        if phrase is None or not phrase.name("person"):
            continue
        after = phrase.end + 2 * (text.words[phrase.end : phrase.end + 2] in _SENDERS)
        while text.word(phrase.end) == "from" and text.word(after) not in (COMMA, FULL_STOP):
            after += 1  # from all of us
        aside = text.word(after) == COMMA and text.word(after + 1) in _OF_THEM
        if after > phrase.end or aside:
            return phrase.end, after
    return None
