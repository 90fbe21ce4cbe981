"""A reading of English: "about face", and "face about", is to turn round on the spot.

The function would stand in `intents/english/readings/movements.py`, its row in
`intents/english/order.py` beside `movements.out_of_the_way`: both are set phrases that no verb
begins, so nothing that stands after them would be read otherwise.
"""

from __future__ import annotations

from math import pi

from intents.english.phrases.complements import ends_clause
from intents.english.reading import Found, Sentence
from intents.english.words import lexicon
from intents.goals import Displacement, GoTo

_ABOUT_FACE = lexicon.phrases("about face,face about")


def about_face(sentence: Sentence, at: int) -> Found | None:
    """About face."""
    end = sentence.text.phrase_end(_ABOUT_FACE, at)
    if end is None or not ends_clause(sentence.text, end):
        return None
    return [GoTo(by=Displacement(turn_rad=pi))], end
