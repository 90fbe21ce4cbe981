"""Times told by a clause of their own: "before Anna gets home"."""

from intents.english.phrases.bare_phrases import bare_phrase
from intents.english.words import lexicon
from intents.english.words.lexicon import GOALWARDS
from intents.english.words.text import Text
from intents.english.words.verbs import base_form, verbs_at

_TIMES = lexicon.words("dinner lunch breakfast supper tea noon midnight bedtime tonight tomorrow")
_SUBJECTS = lexicon.words("i we he she they")
ARRIVED = lexicon.phrases(
    "when you are,once you are,when you get to,once you get to,when you reach,once you reach,"
    "as soon as you are,as soon as you reach,as soon as you get to,when you arrive,once you arrive,"
    "when you have reached,once you have reached,when you come to,when you enter,once you enter,"
    "after you get to,after you reach,as soon as you arrive,after you arrive,as soon as you enter,"
    "on reaching,upon reaching,on arriving,upon arriving,on arrival,upon arrival,"
    "as soon as you come to"
)
"""What a place stands behind that is to be gone to first."""


def tells_when(text: Text, at: int) -> bool:
    """Whether "before" or "until" stands before a clause: "before *Anna gets home*"."""
    if text.word(at) == "once":
        return text.word(at + 1) in _SUBJECTS and text.word(at + 2)[0].isalpha()
    if text.word(at) not in ("before", "after", "until"):
        return False
    if text.word(at + 1) in _TIMES:
        return True
    if (text.phrase_end(GOALWARDS, at) or 0) > at + 1:
        return False  # until he reaches the door: that is where to
    if text.word(at + 1) in ("i", "we", "they") and text.word(at + 2)[0].isalpha():
        return True
    subject = bare_phrase(text, at + 1)
    if subject is None or subject.end >= len(text):
        return False
    word = text.word(subject.end)
    third = base_form(word) != word or word in ("is", "are", "has", "have", "'s")
    third = third or (word.endswith("s") and word.isalpha() and not text.name_at(subject.end))
    return third or (bool(verbs_at(text.words, subject.end)) and not text.name_at(subject.end))
