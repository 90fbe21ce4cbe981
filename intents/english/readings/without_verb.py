"""Commands without a verb that says it: "lights off", "three steps forward", "make a fist"."""

from intents.english.clauses.results import RESULTS, brought_about, made_so
from intents.english.clauses.verb_clauses import framed
from intents.english.frames.devices import is_device
from intents.english.phrases.complements import read_complements
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import to_object
from intents.english.reading import Found, Sentence
from intents.english.trouble import Misfit, Unclear
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Close, LookAt, Switch

_LIFTS = ("raise", "lift", "lower")


def fist(sentence: Sentence, at: int) -> Found | None:
    """Make a fist: to close the hand."""
    made = sentence.text.words[at : at + 3] in (["make", "a", "fist"], ["form", "a", "fist"])
    return ([Close(what="hand")], at + 3) if made else None


def head(sentence: Sentence, at: int) -> Found | None:
    """Lift your head up: to look up."""
    text = sentence.text
    if text.words[at + 1 : at + 3] != ["your", "head"] or text.word(at) not in _LIFTS:
        return None
    where = "down" if text.word(at) == "lower" else "up"
    return [LookAt(place=where)], at + 3 + (text.word(at + 3) == "up")


def lights(sentence: Sentence, at: int) -> Found | None:
    """Lights off."""
    text = sentence.text
    if text.word(at) in ("light", "lights") and text.word(at + 1) in ("on", "off", "out"):
        return [Switch(what="light", on=text.word(at + 1) == "on")], at + 2
    return None


def moved(sentence: Sentence, at: int) -> Found | None:
    """Three steps forward; left 90 degrees."""
    text = sentence.text
    if verbs_at(text.words, at) or text.name_at(at):
        return None
    complements, end = read_complements(text, at)
    kinds = [c.measure.kind for c in complements if c.measure]
    moves = all(c.direction or c.measure for c in complements) and len(complements) > 1
    if not moves or kinds not in (["length"], ["angle"]):
        return None
    return framed(
        sentence, "go" if kinds == ["length"] else "turn", "", complements, first=at, end=end
    )


def switched(sentence: Sentence, at: int) -> Found | None:
    """The kettle on; on the kettle, as it is said in Singapore."""
    text = sentence.text
    phrase = noun_phrase(text, at + 1) if text.word(at) in ("on", "off") else None
    if phrase is not None:
        made = made_so(text, phrase, at, sentence.scope, end=phrase.end)
        closed = text.word(phrase.end) == FULL_STOP  # on the stove, which is the largest?
        return made if made and closed and is_device(made[0][0]) else None
    if verbs_at(text.words, at) and not text.name_at(at):
        return None
    thing = noun_phrase(text, at)
    if thing is None or text.word(thing.end) in ("is", "are"):
        return None  # the lamp is on: so it is
    apart = text.word(thing.end) == COMMA
    scope = sentence.scope
    found = made_so(text, thing, thing.end + 1, scope) if apart else None
    found = found or brought_about(text, at, scope)
    if (
        found
        and not isinstance(found[0][0], Switch)
        and (apart or not _is_listed(text, at, found[1]))
    ):
        return None
    return found


def _is_listed(text: Text, at: int, end: int) -> bool:
    """Door closed, *lamp off*: whether another thing beside it is to be so, too."""
    linked = (COMMA, "and", "then")
    if text.word(at - 1) in linked and text.word(at - 2) in RESULTS:
        return True
    after = end
    while text.word(after) in linked:
        after += 1
    thing = noun_phrase(text, after) if after > end and not verbs_at(text.words, after) else None
    return thing is not None and text.word(thing.end) in RESULTS


def only_named(sentence: Sentence, at: int) -> None:
    """A thing is named and nothing is said of it.

    Raises:
        Unclear: That is so.
        Misfit: It is a person.
    """
    text = sentence.text
    phrase = noun_phrase(text, at)
    if phrase is None or phrase.end < len(text) or phrase.noun != "name":
        return
    nothing_before = all(text.word(before) in ("and", "then") for before in range(at))
    if phrase.name("object", "category") and nothing_before:
        unclear = Unclear(f"What shall I do with “{text.raw(at, phrase.end)}”?")
        unclear.about = to_object(phrase, sentence.scope)
        raise unclear
    if phrase.is_person:
        raise Misfit("what about them?")
