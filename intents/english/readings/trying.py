"""Where to look next: "try the cabinet for the iron"; "try the bathroom"."""

from msgspec.structs import replace

from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import sought, to_place
from intents.english.reading import Found, Sentence
from intents.goals import Find, LookAt, ObjectQuery, Person


def tried(sentence: Sentence, at: int) -> Found | None:
    """Try the cabinet *for the iron*: what is sought there, else what was spoken of last."""
    text, scope = sentence.text, sentence.scope
    spot = noun_phrase(text, at + 1) if text.word(at) == "try" else None
    if spot is None or not spot.is_spot:
        return None
    place = to_place(spot, scope)
    thing = noun_phrase(text, spot.end + 1) if text.word(spot.end) == "for" else None
    if thing is not None:
        found = sought(thing, scope)
        return [_there(found, place)], thing.end
    if scope.object is not None:
        return [Find(object=replace(scope.object, at=place))], spot.end
    return [LookAt(place=place)], spot.end


def _there(found: Find, place: str) -> Find:
    thing: ObjectQuery | None = found.object and replace(found.object, at=place)
    person: Person | None = found.person and replace(found.person, at=place)
    return Find(object=thing, person=person)
