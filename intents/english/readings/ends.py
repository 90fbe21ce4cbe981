"""What is to be so in the end, rather than what is to be done.

"Pull the drawer open"; "make sure the bottle is on the table"; "the cup goes in the box"; "the cup
should be brought to me"; "the lamp should be on"; "see that Ada gets the pencil".
"""

from intents.english.clauses.belonging import BELONGS
from intents.english.clauses.results import brought_about, made_so
from intents.english.clauses.verb_clauses import framed
from intents.english.clauses.wishes import WISHES
from intents.english.frames import FRAMES
from intents.english.frames.devices import is_device
from intents.english.phrases.complements import (
    Clause,
    Complement,
    read_complements,
    read_list,
)
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import NounPhrase
from intents.english.phrases.referents import is_person, to_object, to_person, to_place
from intents.english.reading import Found, SaidVerb, Sentence
from intents.english.trouble import ReadingError
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA
from intents.english.words.verbs import FIRST_WORDS, SENSES, base_form, participle_base, verbs_at
from intents.goals import Bring, Guide, Switch

_RESULT_VERBS = lexicon.words("pull push slide swing put set get turn make have leave keep want "
                              "need switch shut")  # fmt: skip
_KNOCKS = lexicon.words(
    "flick flip knock whack bang stick pop crack throw click snap prise pry ease yank tug wedge "
    "mash cut bung fling nudge tap slide roll wind draw"
)
"""What a thing is made to go on, off, open or shut with, by those who do not say "switch"."""
_MOVING = lexicon.words("put get pull push slide set keep leave have want need")
"""With these only a device goes on, off or out: "get the pears out", "keep it out" is no light."""
_ENSURES = lexicon.phrases(
    "make sure,make sure that,ensure,ensure that,see to it that,see that,take care that,check that,"
    "see to it,be sure that,arrange that,arrange for"
)
_ENDS = lexicon.phrases(
    "is,are,gets,get,stays,stay,ends,end,ends up,end up,lands,winds up,finds its way,is put,"
    "are put,goes,go,is placed"
)
_WISHED = lexicon.phrases(
    "to be,to go,to be put,to be moved,to be placed,to stand,to end up,put,moved,placed,back"
)
_GETS = lexicon.phrases("gets,get,has,have,receives,receive,is given,is brought,gets given")
_GETS_TO = lexicon.phrases(
    "gets to,get to,arrives at,arrives in,reaches,finds the way to,makes it to,comes to,"
    "gets safely to,gets into"
)
_PASSIVE = lexicon.phrases(
    "to be,needs to be,need to be,has to be,have to be,should be,must be,ought to be,is to be,"
    "are to be,"
    "can be,could be,needs,wants to be,shall be,will be,may be,would need to be,need,wants,want,"
    "is needing,are needing,is wanting,are wanting,requires,require,is in need of,could do with,"
    "it is to be,wants to get,needs to get,need to get,must get,should get,is to get"
)
_ALL_THINGS = lexicon.words("everything all thing things stuff")
_NARROWS = lexicon.words("that which who not no is are was but except")
"""With one of these it is not all of them."""
_SEVERAL = 2


def resultative(sentence: Sentence, at: int) -> Found | None:
    """Pull the drawer open; make sure the lamp is on; I want the cup on the table."""
    text, scope = sentence.text, sentence.scope
    ensured = text.phrase_end(_ENSURES, at)
    if ensured:
        thing = noun_phrase(text, ensured)
        return (
            brought_about(text, ensured, scope)
            or _placed_so(sentence, at, ensured, _ENDS)
            or (_passive(sentence, thing) if thing and not thing.is_person else None)
        )
    if text.word(at) in _KNOCKS:
        return _knocked(sentence, at)
    wish = text.phrase_end(WISHES, at)
    placed = _placed_so(sentence, at, wish, _WISHED) if wish else None
    if placed:
        return placed
    if wish is None and text.word(at) not in _RESULT_VERBS:
        return None
    found = brought_about(text, wish or at + 1, scope)
    moved = found and text.word(at) in _MOVING and isinstance(found[0][0], Switch)
    return None if found and moved and not is_device(found[0][0]) else found


def _knocked(sentence: Sentence, at: int) -> Found | None:
    """Flick *the lamp off*; crack *open the window*; "pop the cup on the shelf" is none of it."""
    text, scope = sentence.text, sentence.scope
    if text.word(at + 1) in ("open", "shut", "closed", "on", "off"):
        phrase = noun_phrase(text, at + 2)
        found = made_so(text, phrase, at + 1, scope, end=phrase.end) if phrase else None
    else:
        found = brought_about(text, at + 1, scope)
    switched = found is not None and isinstance(found[0][0], Switch)
    return None if found and switched and not is_device(found[0][0]) else found


def _placed_so(
    sentence: Sentence, at: int, start: int, how: frozenset[lexicon.Phrase]
) -> Found | None:
    """Make sure that the bottle is on the table."""
    text = sentence.text
    phrase = noun_phrase(text, start)
    if phrase is not None and is_person(phrase, sentence.scope):
        return _served(sentence, phrase)
    spoken_of = phrase is not None and phrase.said in ("it", "them") and how is _WISHED
    if phrase is None or not (phrase.name("object", "category") or spoken_of):
        return None
    ends = text.phrase_end(how, phrase.end)
    where = _where(sentence, ends) if ends is not None else None
    return where and _put(sentence, at, phrase, *where)


def _where(sentence: Sentence, at: int) -> tuple[Complement, int] | None:
    """Where something is to be, if nothing else is said."""
    complements, end = read_complements(sentence.text, at)
    if len(complements) != 1 or complements[0].role not in ("at", "to", "into"):
        return None
    return complements[0], end


def _put(
    sentence: Sentence,
    at: int,
    phrase: NounPhrase,
    where: Complement,
    end: int,
    *,
    things: list[NounPhrase] | None = None,
) -> Found:
    """A thing put somewhere, or several `things`, of which the `phrase` is the last."""
    verb = " ".join(sentence.text.words[at : phrase.end])
    thing = Complement(phrases=things or [phrase])
    return framed(sentence, "put", verb, [thing, where], first=phrase.end, end=end)


def _served(sentence: Sentence, phrase: NounPhrase) -> Found | None:
    """See that Ada gets the pencil; see that she gets to the lab."""
    text, scope = sentence.text, sentence.scope
    way = text.phrase_end(_GETS_TO, phrase.end)
    place = noun_phrase(text, way) if way else None
    if place is not None and place.name("place", "room"):
        to = to_place(place, scope)
        return [Guide(person=to_person(phrase, scope), to=to)], place.end
    start = text.phrase_end(_GETS, phrase.end)
    complements, end = read_complements(text, start) if start else ([], 0)
    thing = complements[0] if len(complements) == 1 else None
    if thing is None or thing.role or not thing.phrases or thing.phrase.is_person:
        return None
    person = to_person(phrase, scope)
    return [Bring(object=to_object(one, scope), to=person) for one in thing.phrases], end


def thing_first(sentence: Sentence, at: int) -> Found | None:
    """The vase goes on the sill; the cup should be brought to me; the lamp should be on."""
    text = sentence.text
    if verbs_at(text.words, at) and not text.name_at(at):
        return None
    there_is = text.words[at : at + 2] in (["there", "is"], ["there", "are"])
    phrase = noun_phrase(text, at + 2 * there_is)
    if phrase is None or phrase.noun in ("operator", "here", "there"):
        return None
    if there_is:  # there's a hat in the hall wants taking to Ada
        return _passive(sentence, phrase)
    if phrase.noun == "unknown":
        return _state(sentence, phrase)
    found = _belongs(sentence, at, phrase) or _passive(sentence, phrase)
    return found or _state(sentence, phrase) or _all_of_these(sentence, at)


def _all_of_these(sentence: Sentence, at: int) -> Found | None:
    """A cup and two saucers *are to be brought* to Olga; both *belong* on the bar."""
    things, end = read_list(sentence.text, at)
    if len(things) < _SEVERAL or not all(p.name("object", "category") for p in things):
        return None
    last = things[-1]
    last.end = end
    for one in things:
        one.places = one.places or list(last.places)
    found = _belongs(sentence, at, last, things)
    return found or _passive(sentence, last, [Complement(phrases=things)])


def _belongs(
    sentence: Sentence, at: int, phrase: NounPhrase, things: list[NounPhrase] | None = None
) -> Found | None:
    """The vase goes on the sill; all toys belong in the box; the mail goes to Ada.

    Of several `things`, the `phrase` is the last.
    """
    text, scope = sentence.text, sentence.scope
    start = text.phrase_end(BELONGS, phrase.end)
    everything = phrase.said in _ALL_THINGS and bool(phrase.places)  # everything on the bar
    everything = everything and _NARROWS.isdisjoint(text.words[phrase.start : phrase.end])
    if start is None or phrase.is_person:
        return None
    if not (everything or phrase.name("object", "category")):
        return None
    where = _where(sentence, start)
    if where is None:
        return None
    there = where[0].phrase
    if is_person(there, scope):
        person = to_person(there, scope) if text.word(start - 1).startswith("go") else None
        found = [to_object(one, scope) for one in things or [phrase]]
        return ([Bring(object=one, to=person) for one in found], where[1]) if person else None
    sentence.notes.verb = SaidVerb(at, at + 1, ("put",))
    found = _put(sentence, at, phrase, *where, things=things)
    sentence.notes.homes = tuple(found[0])
    return found


def _passive(
    sentence: Sentence, phrase: NounPhrase, things: list[Complement] | None = None
) -> Found | None:
    """The cup should be brought to me; the plates want taking to the bar."""
    text = sentence.text
    first = text.phrase_end(_PASSIVE, phrase.end + (text.word(phrase.end) == COMMA))
    base = _done_to(text.word(first)) if first else None
    if first is None or base is None or base == "cover":
        return None
    complements, end = read_complements(text, first + 1)
    thing = things[0] if things else Complement(phrases=[phrase])
    for sense in SENSES.get((base,), ()):
        if sense not in FRAMES:
            continue
        clause = Clause(text, sense, base, first + 1, end, [thing, *complements])
        try:
            return FRAMES[sense](clause, sentence.scope), end
        except ReadingError:
            continue
    return None


def _done_to(word: str) -> str | None:
    """The bare form of "taken", and of "taking" where that is wanted."""
    base = base_form(f"{word}g" if word.endswith("in") else word)
    doing = word.endswith(("ing", "in")) and base in FIRST_WORDS
    return base if doing and base != word else participle_base(word)


def _state(sentence: Sentence, phrase: NounPhrase) -> Found | None:
    """The lamp should be on."""
    start = sentence.text.phrase_end(_PASSIVE, phrase.end)
    return made_so(sentence.text, phrase, start, sentence.scope) if start else None
