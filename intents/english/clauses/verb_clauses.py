"""A verb with its complements, in the first of its senses that fits."""

from collections.abc import Iterable

from intents.english.clauses.pieces import behind_commas
from intents.english.clauses.questions import counted
from intents.english.clauses.saying import answer, describe, inform, say, tell
from intents.english.ending_early import untold
from intents.english.frames import FRAMES
from intents.english.frames.mission import is_stopover
from intents.english.phrases.complements import (
    Clause,
    Complement,
    ends_clause,
    first_with,
    read_complements,
)
from intents.english.phrases.referents import Scope, to_place
from intents.english.reading import Found, SaidVerb, Sentence, not_understood
from intents.english.repeating import repeated
from intents.english.trouble import Misfit, ReadingError
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import GoTo, Person

SPEECH = {"say": say, "tell": tell, "inform": inform, "describe": describe, "answer": answer}
"""Senses whose complement is words."""
_FOLLOWERS = lexicon.PRONOUNS | lexicon.words("to if unless you how what after before")
"""Words that may begin what comes after a clause."""
_DONE_FOR = ("open", "close", "switch", "find", "count", "look")
"""What is done for somebody, and not to them."""
_HANDLES = ("bring", "put", "drop", "take", "give", "pick")
_HANDED = ("bring", "take", "give", "pick", "collect", "want")


def read_verb(sentence: Sentence, at: int, fronted: Iterable[Complement] = ()) -> Found:
    """A verb and its complements, in the first sense that fits.

    Raises:
        ReadingError: None fits.
    """
    senses = [(s, first) for s, first in verbs_at(sentence.text.words, at) if s != "repeat"]
    found = first_that_fits(sentence, senses, at, list(fronted))
    if found is None:
        raise not_understood(sentence.text, at)
    sentence.notes.verb = SaidVerb(at, senses[0][1], tuple(sense for sense, _ in senses))
    return found


def first_that_fits(
    sentence: Sentence,
    senses: list[tuple[str, int]],
    at: int,
    fronted: list[Complement],
    *,
    resumed: int | None = None,
) -> Found | None:
    """The verb at a word in the first sense that fits its complements and the whole clause.

    Args:
        sentence: The sentence.
        senses: The senses, each with where the verb ends.
        at: Where the verb begins.
        fronted: Complements that stand elsewhere.
        resumed: Where the complements begin, if not after the verb: it is left out there.

    Raises:
        ReadingError: None fits.
    """
    errors: list[ReadingError] = []
    loose: Found | None = None
    for sense, first in senses:
        try:
            found = _in_sense(sentence, sense, at, first, fronted=fronted, resumed=resumed)
        except ReadingError as error:
            errors.append(error)
            continue
        if goes_on(sentence.text, found[1]):
            return found
        loose = loose or found
    if errors and loose is None:
        raise max(errors, key=lambda e: e.weight)
    return loose


def _in_sense(
    sentence: Sentence,
    sense: str,
    at: int,
    first: int,
    *,
    fronted: list[Complement],
    resumed: int | None,
) -> Found:
    text, scope = sentence.text, sentence.scope
    start = first if resumed is None else resumed
    if sense in SPEECH:
        goals, end = SPEECH[sense](text, start, scope)
        places = [to_place(c.phrase, scope) for c in fronted if c.role == "at"]
        return [*(GoTo(place=p) for p in places), *goals], end
    if sense == "count":
        return counted(text, first, scope)
    complements, end = read_complements(text, start)
    if sense == "stop" and text.word(first - 1) == "move" and first_with(complements, ""):
        raise Misfit("that is not to move something")
    if sense in _HANDLES:
        putting = sense in ("put", "drop")
        complements, end = behind_commas(text, complements, end, put=putting)
    complements = without_favours(sense, complements)
    _mention_owners(text, complements, scope)
    given_up = sense == "cancel" and text.word(first).endswith("ing")
    if sense == "stop" and text.word(first - 1) == "move" and first_with(complements, ""):
        raise Misfit("that is not to be moved")
    if (sense == "stop" and not is_stopover(complements, scope)) or given_up:
        late = None if given_up else untold(text, at)
        if late is not None:
            raise late
        complements = []  # what is to be stopped or given up is all that is going on
        while end < len(text) and text.word(end) not in (FULL_STOP, COMMA):
            end += 1
    verb = " ".join(text.words[at:first])
    clause = Clause(text, sense, verb, first, end, complements + fronted)
    owners = [phrase.owner for c in complements for phrase in c.phrases if phrase.owner]
    if owners and scope.person is None:
        scope.person = Person(name=owners[0])  # take Leo's ball back to him
    goals = FRAMES[sense](clause, scope)
    sentence.notes.wanted = sense == "want"
    sentence.notes.particles = [c for c in complements if c.particle in ("on", "off", "out")]
    times = clause.measure("times")
    return repeated(goals, 1 if times is None else times), end


def _mention_owners(text: Text, complements: list[Complement], scope: Scope) -> None:
    """Take *Ada's* pen back to *her*; find Emil's cap and bring it to *him*."""
    back = any(c.direction == "backward" for c in complements) or "return" in text.words
    for owner in (phrase.owner for c in complements for phrase in c.phrases if phrase.owner):
        if back or scope.person is None:
            scope.person = Person(name=owner)


def framed(
    sentence: Sentence,
    sense: str,
    verb: str,
    complements: list[Complement],
    *,
    first: int,
    end: int,
) -> Found:
    """What a sense of a verb makes of complements that were read elsewhere.

    ``first`` is the word after the verb, or where it would end; the clause goes up to ``end``.
    """
    clause = Clause(sentence.text, sense, verb, first, end, complements)
    return FRAMES[sense](clause, sentence.scope), end


def without_favours(sense: str, complements: list[Complement]) -> list[Complement]:
    """Put the cup on the table *for me*: it goes there, and not to whom it is done a favour."""
    if sense in _DONE_FOR:
        complements = [c for c in complements if not _is_operator(c, "to", "")]
    if sense in _HANDED and not any(c.role in ("to", "into") for c in complements):
        return complements
    kept: list[Complement] = []
    for one in complements:
        favour = _is_operator(one, "for")
        places = one.phrase.places if favour else []
        kept += [Complement(role="at", how=p.how, phrases=[p.of]) for p in places] or (
            [] if favour else [one]
        )
    return kept


def _is_operator(said: Complement, *roles: str) -> bool:
    """Whether it is for the one who speaks: "open *to me* the door", "search *me* the cup"."""
    return bool(said.phrases) and said.role in roles and said.phrase.noun == "operator"


def goes_on(text: Text, at: int) -> bool:
    """Whether a clause may well end here."""
    if ends_clause(text, at) or verbs_at(text.words, at):
        return True
    return text.word(at) in _FOLLOWERS or bool(text.phrase_end(lexicon.OPENERS, at))
