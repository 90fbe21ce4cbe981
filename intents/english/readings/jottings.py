"""Jottings: things, with where from, where to or for whom, in any order and without a verb.

"One cola, for Olga, from the minibar"; "scarf, wardrobe, now"; "the suite: two pillows"; "saucers,
blue, onto the counter". What comes from somewhere and is for nobody is for who speaks.
"""

from dataclasses import replace

from intents.english.clauses.pieces import Pieces, all_of_them, read_pieces
from intents.english.clauses.verb_clauses import framed
from intents.english.phrases.complements import Complement, connector_end
from intents.english.phrases.phrase import Locative
from intents.english.phrases.referents import is_person
from intents.english.reading import Found, SaidVerb, Sentence
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at

_GOALS = ("to", "into")


def jotted(sentence: Sentence, at: int) -> Found | None:
    """One cola, for Olga, from the minibar: to bring it to her from there."""
    text = sentence.text
    if sentence.before and text.word(at - 1) not in (FULL_STOP, "and", "then"):
        return None
    pieces = read_pieces(text, at)
    if pieces is None or pieces.things is None or pieces.told or not _closes(text, pieces.end):
        return None
    bare = not any(c.role in ("to", "into", "for", "from") for c in pieces.said)
    who = _receiver(sentence, pieces)
    where = None if who else _destination(pieces)
    sources = [c for c in pieces.said if c not in (who, where)]
    if who:
        sources = _standing(pieces, who, sources)
    going_on = pieces.end < len(text) and text.word(pieces.end) != FULL_STOP
    if not _fits(pieces, who, where, sources, bare=bare) or (going_on and bare):
        return None
    for one in sources:
        one.role = "from"
    things = pieces.things
    headed = things.phrases[0].name("category") and len(things.phrases) > 1
    if headed and text.tokens[things.phrases[0].end].raw == ":":
        del things.phrases[0]  # linen: two pillows
    if len(things.phrases) > 1 and not sources:
        _share_places(things)
    verb = "put" if where and where.phrase.noun != "here" else "bring"
    if verb == "put":
        all_of_them(things)
    target = [one for one in (who, where) if one]
    sentence.notes.verb = SaidVerb(at, at, (verb,))
    return framed(sentence, verb, verb, [things, *sources, *target], first=at, end=pieces.end)


def juxtaposed(sentence: Sentence, at: int) -> Found | None:
    """Two colas minibar: names side by side, as they are typed in haste."""
    text = sentence.text
    if sentence.before or sentence.depth or (verbs_at(text.words, at) and not text.name_at(at)):
        return None
    seams = [n for n in range(at + 1, len(text)) if _is_seam(text, at, n)]
    if not seams:
        return None
    apart = replace(sentence, text=text.set_apart(seams))
    found = jotted(apart, at)
    return (found[0], len(text)) if found and found[1] == len(apart.text) else None


def _is_seam(text: Text, first: int, at: int) -> bool:
    """Whether a thing ends before a word, and a place, a person or "me" begins there."""
    named = text.name_at(at)
    spot = named and named.of("place", "room", "person") and not named.of("object", "category")
    if not (spot or text.word(at) in ("me", "us")):
        return False
    for begin in range(first, at):
        thing = text.name_at(begin)
        if thing and thing.end == at and thing.of("object", "category"):
            return text.word(begin - 1) != "the"
    return False


def _closes(text: Text, at: int) -> bool:
    end = at >= len(text) or text.word(at) in (COMMA, FULL_STOP)
    return end or connector_end(text, at) is not None


def _receiver(sentence: Sentence, pieces: Pieces) -> Complement | None:
    """For whom it is: *for Ada*; *to Ada*; *Ada*; *me*."""
    people = [
        c for c in pieces.with_role("to", "for", "") if is_person(c.phrase, sentence.scope)
    ]  # fmt: skip
    things = pieces.things.phrase if pieces.things else None
    if len(people) != 1 or len(people[0].phrases) > 1 or things is None:
        return None
    if people[0].role == "" and people[0].phrase.start < things.start:
        return None  # Ada, the cup: she is spoken to
    people[0].role = "to"
    return people[0]


def _destination(pieces: Pieces) -> Complement | None:
    """Where it is to be: *to the bar*; *the bar*; *on the bar*, set apart by a sign."""
    said = [c for c in pieces.with_role(*_GOALS) if len(c.phrases) == 1]
    said = said or [c for c in pieces.with_role("") if len(c.phrases) == 1]
    said = said or [c for c in pieces.apart if c.role == "at" and c.how in ("on", "in", None)]
    if not said:
        return None
    where = said[-1]
    where.role = "to" if where.role == "" and where.phrase.noun != "here" else where.role
    return where


def _standing(
    pieces: Pieces, who: Complement, sources: list[Complement]
) -> list[Complement]:  # fmt: skip
    """For Ada, *in the suite*: where she is; the rest is where the thing is."""
    after = pieces.said[pieces.said.index(who) + 1 :]
    there = [c for c in after if c.role in ("", "at") and c.phrase.is_spot]
    who.phrase.places += [Locative(c.how, c.phrase) for c in there]
    return [c for c in sources if c not in there]


def _fits(
    pieces: Pieces,
    who: Complement | None,
    where: Complement | None,
    sources: list[Complement],
    *,
    bare: bool,
) -> bool:
    """Whether each piece has its part, and something is asked for."""
    if any(c.role not in ("from", "at", "") or not c.phrase.is_spot for c in sources):
        return False
    inside = where and where.phrase.name("room") and where not in pieces.with_role("into")
    standing = pieces.things is not None and any(p.places for p in pieces.things.phrases)
    if len(sources) > 1 or (bare and inside and standing):
        return False  # the cup on the rack, cellar: that is where the rack stands
    if where:
        return where.phrase.is_spot or (where.role == "into" and where.phrase.name("object") != "")
    if who:
        return who in pieces.apart or len(pieces.said) > 1 or _is_some(pieces)
    things = pieces.things.phrases if pieces.things else []
    return any(c.role == "from" for c in sources) and not any(p.owner for p in things)


def _is_some(pieces: Pieces) -> bool:
    """Whether no particular thing is spoken of: "the letter for Ada" is one."""
    things = pieces.things.phrases if pieces.things else []
    return all(p.determiner != "the" for p in things)


def _share_places(things: Complement) -> None:
    """The cups and plates *on the table*: both are there."""
    places = things.phrases[-1].places
    for phrase in things.phrases[:-1]:
        phrase.places += [] if phrase.places else places
