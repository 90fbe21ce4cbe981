"""A question that was told ("if she needs anything") as it is put to whom it is for."""

from __future__ import annotations

import re

_SUBJECT = re.compile(r"\b(he|she|they)\b", re.IGNORECASE)
_OWN = re.compile(r"\b(his|her|their)\b(?=\s+\w)", re.IGNORECASE)
_WHOM = re.compile(r"\b(him|her|them)\b", re.IGNORECASE)
_VERB = re.compile(r"\byou(\s+(?:\w+ly|also|still|ever|already|just)\b)?\s+(\w+)")
_PLAIN = {"is": "are", "was": "were", "has": "have", "does": "do", "goes": "go", "isn't": "are not"}
_NO_ENDING = ("ss", "us", "is")
"""Words like "miss" and "discuss", whose s is no ending."""


def spoken(what: str) -> str:
    """The words after "ask somebody" as a question to them: "Can you tell me if you need ...?".

    Who is spoken of by a pronoun is who is asked; whoever asks stays "I" and "my", as in messages.
    """
    said = what.strip().rstrip("?.! ")
    one = re.search(r"\b(he|she)\b", said, re.IGNORECASE) is not None
    said = _SUBJECT.sub("you", said)
    said = _WHOM.sub("you", _OWN.sub("your", said))
    if one:
        said = _VERB.sub(lambda found: f"you{found[1] or ''} {_base(found[2])}", said)
    return f"Can you tell me {said}?"


def _base(verb: str) -> str:
    """A verb as it stands after "you": "needs" is "need", "has" is "have"."""
    plain = _PLAIN.get(verb)
    if plain is not None:
        return plain
    if verb.endswith("ies") and len(verb) > 4:
        return f"{verb[:-3]}y"
    if verb.endswith(("shes", "ches", "sses", "xes", "zzes")):
        return verb[:-2]
    return verb[:-1] if verb.endswith("s") and not verb.endswith(_NO_ENDING) else verb
