"""A verb that nobody knows, of a thing that is to be somewhere: "yeet the cup onto the shelf".

Whatever it means, the cup is likely to be on the shelf in the end: the robot asks, with the goal
named, and does nothing before the answer.
"""

from intents.english.clauses.verb_clauses import framed
from intents.english.phrases.complements import ends_clause, first_with, read_complements
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import is_content
from intents.english.phrases.referents import is_person
from intents.english.reading import Found, Sentence
from intents.english.words import lexicon
from intents.english.words.verbs import verbs_at

_OTHER_ACTS = lexicon.words(
    "wash clean wipe dry iron paint draw write read drink eat cook boil fry bake cut chop slice "
    "break smash crush burn heat warm cool fold peel feed fill mix stir sharpen repair fix mend "
    "charge print copy type play scrub rinse dust polish vacuum sew knit wear use test weigh "
    "measure photograph film kiss hug pet stroke kick hit punch taste smell touch spill compare "
    "sell explain connect attach tie nail glue prefer add assemble build destroy shred melt freeze "
    "steal eat lick bite squeeze water milk video scan like love hate know mean wrap knock plug"
)
"""What is done to a thing where it is, or with it, and moves it nowhere."""


def moved_somehow(sentence: Sentence, at: int) -> Found | None:
    """Yeet the cup onto the shelf: to put it there; what is made of it is asked about."""
    text, scope = sentence.text, sentence.scope
    word = text.word(at)
    known = verbs_at(text.words, at) or text.name_at(at) or word in _OTHER_ACTS
    if known or not is_content(text, at) or word.endswith(("ed", "ing")):
        return None
    complements, end = read_complements(text, at + 1)
    bare, goal = first_with(complements, ""), first_with(complements, "to", "into")
    thing = bare.phrase if bare and len(bare.phrases) == 1 else None
    if thing is None or thing.start != at + 1 or not ends_clause(text, end):
        return None
    if not thing.name("object", "category") or not (thing.determiner or thing.count):
        return None
    there = goal.phrase if goal else thing.places[-1].of if thing.places else None
    where = noun_phrase(text, there.start) if there else None
    if where is None or len(complements) > (2 if goal else 1):
        return None
    if not (where.is_spot or is_person(where, scope)):
        return None
    sense = "bring" if is_person(where, scope) else "put"
    found = framed(sentence, sense, sense, complements, first=at + 1, end=end)
    sentence.notes.guessed.append(word)
    return found
