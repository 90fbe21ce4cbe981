"""People who are to get somewhere: "help Ada find the door", "have her follow you"."""

from msgspec.structs import replace

from intents.english.clauses.openings import goes_oneself_end, skip_openings
from intents.english.phrases.complements import first_with, read_complements
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import ME, is_person, to_person, to_place
from intents.english.reading import Found, Sentence
from intents.english.trouble import Offered
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import OPERATOR, Guide

_HELPS = lexicon.words("help assist let")
_FINDS_WAY = lexicon.phrases(
    "get,go,find,reach,navigate,find his way,find her way,find their way,find the way,walk,move,"
    "make his way,make her way,make their way,come,travel,find way,get back,return"
)
_CAUSES = lexicon.words("have let make ask get tell")
_LEADING = lexicon.words("there way lead guide escort accompany usher help show along")
"""One of these is in an order to take along who has said where to."""
_WAY_ASKED = lexicon.phrases(
    "which way is,which way 's,which way to,which is the way to,what is the way to,how do i get to,"
    "how can i get to,how do we get to,how can we get to,what is the quickest way to,"
    "which way do i go to,how do i find,how do i go to,where do i go for,tell me the way to"
)
"""How one asks for the way."""
_TAKE_ME = (
    ["take", "me"], ["take", "us"], ["lead", "me"], ["guide", "me"], ["show", "me"],
    ["bring", "me"], ["walk", "me"], ["lead", "us"], ["show", "us"],
)  # fmt: skip
_LINKS = (COMMA, FULL_STOP, "and", "so", "but", "to")


def helped_there(sentence: Sentence, at: int) -> Found | None:
    """Help Ada find her way from the gate to the lab; how does Ada get to the lab?"""
    text, scope = sentence.text, sentence.scope
    if text.word(at) not in _HELPS | {"how"}:
        return None
    start = at + 1
    if text.word(at) == "how":
        start += text.word(start) in ("does", "can", "do", "could", "should")
    phrase = noun_phrase(text, start)
    if phrase is None or not is_person(phrase, scope) or phrase.noun == "operator":
        return None
    person = to_person(phrase, scope)
    way = text.phrase_end(_FINDS_WAY, phrase.end + (text.word(phrase.end) == "to"))
    if way is None:
        return None
    complements, stop = read_complements(text, way)
    source = first_with(complements, "from")
    goal = first_with(complements, "to", "into", "")
    if goal is None:
        return None
    if source:
        person = replace(person, at=to_place(source.phrase, scope, objects=True))
    to = OPERATOR if goal.phrase.noun in ("operator", "here") else to_place(goal.phrase, scope)
    return [Guide(person=person, to=to)], stop


def shown_where(sentence: Sentence, at: int) -> Found | None:
    """Show Ada where the lab is."""
    text, scope = sentence.text, sentence.scope
    phrase = noun_phrase(text, at + 1) if text.word(at) == "show" else None
    if phrase is None or not is_person(phrase, scope):
        return None
    person = to_person(phrase, scope)
    if text.word(phrase.end) != "where":
        return None
    start = phrase.end + 1 + (text.word(phrase.end + 1) in ("is", "are"))
    place = noun_phrase(text, start)
    if place is None or (phrase.noun == "operator" and not place.is_spot):
        return None  # show me where the cup is: find it
    end = place.end + (text.word(place.end) in ("is", "are"))
    return [Guide(person=person, to=to_place(place, scope, objects=True))], end


def goes_oneself(sentence: Sentence, at: int) -> Found | None:
    """I would like to go through to the lounge; we have to get to the lab: to be taken there."""
    text = sentence.text
    going = goes_oneself_end(text, at)
    complements, end = read_complements(text, going) if going else ([], at)
    spots = [c for c in complements if c.phrases]
    goal = spots[0] if len(spots) == 1 else None
    into_room = goal is not None and goal.role == "at" and goal.phrase.name("room")
    if goal is None or not (goal.role in ("to", "into") or into_room) or goal.phrase.is_person:
        return None
    place = to_place(goal.phrase, sentence.scope)
    if text.word(end) == "to" and verbs_at(text.words, end + 1):
        while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
            end += 1  # ... to fetch the towels: who speaks does that
        return [], end
    if not _LEADING.intersection(text.words[end:]) and _orders(text, end):
        sentence.scope.mention(place)
        return [], end  # that is why something else is asked for
    sentence.notes.wanted = True
    return [Guide(person=ME, to=place)], end


def way_asked(sentence: Sentence, at: int) -> Found | None:
    """Which way is the spa? How do I get to the spa? Take me: to be taken there, or offered.

    Raises:
        Offered: Nothing more is said.
    """
    text = sentence.text
    start = text.phrase_end(_WAY_ASKED, at)
    place = noun_phrase(text, start) if start else None
    if place is None or not place.name("place", "room") or place.name("object", "person"):
        return None
    guide = Guide(person=ME, to=to_place(place, sentence.scope))
    rest = text.words[place.end :]
    if any(rest[n : n + 2] in _TAKE_ME for n in range(len(rest))):
        sentence.notes.wanted = True
        return [guide], place.end
    raise Offered("I know the way", (guide,))


def _orders(text: Text, at: int) -> bool:
    """Whether an order follows: "I have to go to the lab, *bring me my coat*"."""
    links = (n for n in range(at, len(text)) if text.word(n) in _LINKS)
    return any(verbs_at(text.words, skip_openings(text, n)) for n in links)


def made_to_follow(sentence: Sentence, at: int) -> Found | None:
    """Have her follow you to the office: to guide her."""
    text, scope = sentence.text, sentence.scope
    phrase = noun_phrase(text, at + 1) if text.word(at) in _CAUSES else None
    if phrase is None or not is_person(phrase, scope):
        return None
    end = phrase.end + (text.word(phrase.end) == "to")
    if text.words[end : end + 2] not in (["follow", "you"], ["come", "with"]):
        return None
    complements, stop = read_complements(text, end + 2)
    goal = first_with(complements, "to", "into")
    to = to_place(goal.phrase, scope) if goal else None
    return [Guide(person=to_person(phrase, scope), to=to)], stop
