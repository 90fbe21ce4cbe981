"""For whom a thing is, told behind the order: "fetch the pump, *Ada needs it*"."""

from msgspec.structs import replace

from intents.english.clauses.wishes import NEEDS
from intents.english.phrases.complements import ends_clause
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import ME, to_person
from intents.english.reading import Found, Sentence
from intents.english.words import lexicon
from intents.goals import Bring, ForEach, Give, Goal, Person, Pick, Place

_IT = lexicon.words("it them that those this these one some both")
_FOR = lexicon.phrases("it is for,they are for,that is for,those are for,this is for,these are for")


def meant_for(sentence: Sentence, at: int) -> Found | None:
    """Fetch the pump, *Ada wants it*; fetch the pump, *it is for Ada*: to bring it to her.

    Where it is said already to whom or where it is to come, that is only the reason.
    """
    found = _somebody(sentence, at)
    clause = sentence.notes.trace[-1:]
    if found is None or not clause or not sentence.before:
        return None
    (said, goals), (person, end) = clause[0], found
    last = sentence.before[-len(goals) :] if goals else []
    if not last or not all(
        isinstance(goal, Bring | ForEach | Give | Pick | Place) for goal in last
    ):
        return None
    told = lexicon.OPERATOR_WORDS.intersection(said.lower().split())
    changed = [None if told else _to(goal, person) for goal in last]
    if None in changed:
        return [], end
    del sentence.before[-len(last) :]
    return [goal for goal in changed if goal], end


def _somebody(sentence: Sentence, at: int) -> tuple[Person, int] | None:
    """Who is said to need what was spoken of, and where that ends."""
    text, scope = sentence.text, sentence.scope
    start = text.phrase_end(_FOR, at)
    phrase = noun_phrase(text, start or at)
    if phrase is None or not phrase.is_person or phrase.noun == "operator":
        return None
    end = phrase.end
    if start is None:
        needing = text.phrase_end(NEEDS, end)
        if needing is None or text.word(needing) not in _IT:
            return None
        end = needing + 1
    return (to_person(phrase, scope), end) if ends_clause(text, end) else None


def _to(goal: Goal, person: Person) -> Goal | None:
    """The goal with who is to have the thing; None if that is said already."""
    match goal:
        case Pick():
            return Bring(object=goal.object, to=person)
        case Bring() if goal.to == ME:
            return replace(goal, to=person)
        case ForEach(goals=(Bring() as inner,)) if inner.to == ME:
            return replace(goal, goals=(replace(inner, to=person),))
        case _:
            return None
