"""Where things belong, told with the thing first: "the mugs *go* on the rack"."""

from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.words import lexicon
from intents.english.words.text import Text

BELONGS = lexicon.phrases(
    "goes,go,belongs,belong,should go,has to go,have to go,needs to go,need to go,"
    "must go,"
    "should be,has to be,must be,needs to be,ought to go,is supposed to go,is to go,are to go,"
    "are supposed to go,is meant to go,are meant to go,can go,could go,is going,are going,gotta go"
)
"""How it is said where a thing is to be."""


def belongs_somewhere(text: Text, at: int) -> bool:
    """Whether it is told from a word on where a thing belongs: *the mugs go on the rack*."""
    phrase = noun_phrase(text, at)
    return (
        phrase is not None
        and bool(phrase.name("object", "category"))
        and text.phrase_end(BELONGS, phrase.end) is not None
    )
