"""Reported speech put back as it is to be said: "tell Leo to put *his* shoes on" is "put your ...".

Whoever is told is "he" or "she" in the sentence, and "you" in what they hear. Somebody else who is
spoken of before stays who they are: "tell Leo that *Ada* thinks she is late".
"""

import re
from collections.abc import Callable

from intents.english.words import lexicon
from intents.english.words.lexer import singular
from intents.english.words.verbs import base_form

_ORDER = re.compile(
    r"^(?P<denied>(?:not|never) )?to (?P<rest>(?P<verb>[a-z]+)\b.*)$", re.IGNORECASE
)
_NO_VERB = lexicon.DETERMINERS | lexicon.words("me you him her them us everyone everybody")
"""To *the* hall: no order."""
_GENDERS = {
    "he": "male", "him": "male", "his": "male", "himself": "male", "hes": "male",
    "she": "female", "her": "female", "hers": "female", "herself": "female", "shes": "female",
}  # fmt: skip
_SUBJECTS, _SHORT = ("he", "she"), ("hes", "shes")
_WORD = re.compile(r"[A-Za-z]+(?:['’][a-z]+)?|[^\sA-Za-z]+")
_SOMEBODY = (
    lexicon.PERSON_NOUNS
    | lexicon.GENDERS.keys()
    | lexicon.words(
        "mum mom mummy dad daddy mother father sister brother aunt auntie uncle gran granny "
        "nan grandma grandpa grandad son daughter cousin friend nurse doctor teacher boss "
        "colleague neighbour"
    )
)
_YOU = {"am": "are", "is": "are", "was": "were", "has": "have", "does": "do", "isn't": "aren't",
        "wasn't": "weren't", "hasn't": "haven't", "doesn't": "don't"}  # fmt: skip
_BETWEEN = lexicon.words("always never really still just also only often already probably")
_DONE = re.compile(r"(?:\w+ed|been|got|done|gone|had|left|made|won|forgotten|broken|taken)$")
_THINGS = lexicon.DETERMINERS | lexicon.words("it them this that him her me us")


def as_said(
    what: str, gender: str | None, is_name: Callable[[str], bool], *, others: bool = False
) -> str:
    """What is told somebody, as they are to hear it.

    Args:
        what: The words behind "tell Leo", as they stand.
        gender: Of who is told, if that is known.
        is_name: Whether a word is somebody's name.
        others: Whether somebody else was spoken of before: "he" may be them then.
    """
    order = _ORDER.match(what)
    ordered = order is not None and order["verb"].lower() not in _NO_VERB
    if order and ordered:
        denied = (order["denied"] or "").strip().lower()
        what = f"{ {'not': 'do not ', 'never': 'never '}.get(denied, '') }{order['rest']}"
    found = list(_WORD.finditer(what))
    words = [m.group().lower().replace("’", "'") for m in found]
    spoken = None if others else _first(words, is_name, ordered=ordered)
    if spoken is None or gender not in (None, spoken):
        return what
    told, end, other = "", 0, False
    changed = dict[int, str]()
    for at, word in enumerate(words):
        other = other or word.removesuffix("'s") in _SOMEBODY or is_name(word)
        changed |= _put(words, at, spoken, other=other)
    for at, match in enumerate(found):
        said = changed.get(at, match.group())
        said = said[:1].upper() + said[1:] if match.group()[:1].isupper() and at == 0 else said
        told, end = told + what[end : match.start()] + said, match.end()
    return told + what[end:]


def _first(words: list[str], is_name: Callable[[str], bool], *, ordered: bool) -> str | None:
    """The gender of who is told, if it is them that is spoken of.

    That is so where the message begins with "he" or "her mum", or bids them do something to what
    is theirs; further on "she" may well be the boat.
    """
    for word in words if ordered else words[:1]:
        head = word.split("'")[0]
        if head in _GENDERS:
            return _GENDERS[head]
        if head in _SOMEBODY or is_name(word):
            return None
    return None


def _put(words: list[str], at: int, spoken: str, *, other: bool) -> dict[int, str]:
    """What a word becomes, and the verb behind it, by their places."""
    word = words[at]
    head, _, tail = word.partition("'")
    if _GENDERS.get(head) != spoken:
        return {}
    after = words[at + 1] if at + 1 < len(words) else ""
    if head in ("his", "her") and after[:1].isalpha() and after not in _AFTER_OBJECT:
        return {at: "your"}
    if head in ("him", "her"):
        return {at: "you"}
    if head in ("his", "hers", "himself", "herself"):
        return {at: "yourself" if head.endswith("self") else "yours"}
    if other:
        return {}
    if head in _SHORT or tail == "s":
        behind = words[at + 2] if at + 2 < len(words) else ""
        has = after in ("got", "been", "had") or (_DONE.match(after) and behind in _THINGS)
        return {at: "you've" if has else "you're"}
    if tail:
        return {at: f"you'{tail}"}
    verb = at + 1 + (after in _BETWEEN)
    said = words[verb] if verb < len(words) else ""
    return {at: "you"} | ({verb: _agreeing(said)} if said.endswith(("s", "n't")) else {})


_AFTER_OBJECT = lexicon.FUNCTION_WORDS | lexicon.ADVERBS
"""Behind "her" one of these makes it no possessive: "look for *her* in the hall"."""


def _agreeing(verb: str) -> str:
    if verb in _YOU:
        return _YOU[verb]
    if verb.endswith(("n't", "ss")):
        return verb
    form = base_form(verb)
    return form if form != verb else singular(verb)
