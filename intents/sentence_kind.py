"""What kind of sentence it is: an order, a question, somebody else's words, or only something told.

All that weighs a reading asks here, so that no two of them judge a sentence differently. The form
of a statement through and through is the grammar's to see (:mod:`intents.english.clauses.telling`);
the words by which something is asked for stand in :mod:`intents.english.words.requests`.
"""

import re
from collections.abc import Iterator, Sequence
from enum import StrEnum

from intents.english.learnt.plainness import plainness
from intents.english.words import lexicon
from intents.english.words.lexer import words_in
from intents.english.words.reporting import is_reported
from intents.english.words.requests import ASKS_IN_QUESTIONS, ASKS_IN_STATEMENTS
from intents.english.words.verbs import base_form, verbs_at
from intents.goals import Answer, Ask, Count, Find, Goal, LookAt, Report, Say, Stop, Tell, each

LOOKING = (Find, Count, Tell, Report, Answer, LookAt)
"""What answers a question."""
_CLAUSES = re.compile(r"[,.;:!?…—–]+|\b(?:so|and|then|but)\b")
_WONDERS = lexicon.words("how why when who")
_ONLY_SAID = re.compile(
    r"(?:(?:and|but|so|well|oh|hm+|maybe|then|i think|i guess|i suppose)\W+)*(?:"
    r"(?:perhaps|maybe|i wonder (?:if|whether)|wouldn't|don't you think|do you think|i'd say|"
    r"i bet) [^,.;:!?]* (?:would|might|could|wouldn't)? ?(?:look|looks|be|go|fit|suit) (?:\w+ )?"
    r"(?:better|nicer|nice|good|lovely|prettier|well|best)\b[^.!?]*"
    r"|[^,.;:!?]* (?:would|might|could) (?:look|go|fit|suit) (?:\w+ )?(?:better|nicer|nice|good|"
    r"lovely|prettier|well|best)\b[^.!?]*"
    r"|you (?:should|could|might|ought to)(?:n't| not)? have (?!the|a|an|some|my|this|that|it|one|"
    r"any|your|his|her|to|another|more)\w+[^,.;:!?]*"
    r"|(?:shall|must|do) i (?!have (?:a|the|some|my)|get (?:a|the|some|my)|ask|trouble)"
    r"[^,.;:!?]*\?"
    r"|(?:what|who|why|when|which \w+|how(?: \w+)?) (?!would you (?:say|like|feel|mind)|about|not)"
    r"(?:would|will|did|do|does|is|are|was|were|should|has|have|had|happens) "
    r"(?!you say\b|\w+ get to\b)[^.!?]*\?"
    r"|(?:that's |that is )?enough (?!of)\w+ for [^,.;:!?]*"
    r")[.!?]*"
)
"""What asks for nothing from the first word to the last."""
_CALLED = re.compile(r"\bcall(?:ed|s)?\b", re.IGNORECASE)
"""The, how is it *called*, the ladle: nobody is quoted."""
_NO_ORDER = {"begins=article", "begins=name", "begins=about"}
"""How a sentence begins that has no form of an order."""


class SentenceKind(StrEnum):
    """What is done with words."""

    ORDER = "order"
    """Something is asked for."""
    UNASKED = "unasked"
    """It begins as a statement does, and has no word that asks: "the scarf is for the party"."""
    TOLD = "told"
    """It is a statement, or a cry, through and through: "oh no, the bell came off"."""
    QUESTION = "question"
    """It wants to know something, and nothing done: "how would you pick it up?"."""
    QUOTED = "quoted"
    """It is what somebody else said: "the king cries, bring me the cup"."""


def kind_of(
    text: str, goals: Sequence[Goal], *, tells: bool, names: Sequence[str] = ()
) -> SentenceKind:
    """What kind of sentence a text is, in the light of what it is taken to ask for.

    Args:
        text: What was said.
        goals: What some reading makes of it: a question that is answered is one all the same.
        tells: Whether the grammar sees a statement through and through.
        names: The names in it, as they were said.
    """
    if is_reported(text):
        return SentenceKind.QUOTED
    if _wonders(text, goals) or (only_asks(text, goals) and not any(_you_do(text))):
        return SentenceKind.QUESTION
    if tells:
        return SentenceKind.TOLD
    begun = not _NO_ORDER.isdisjoint(plainness(text, names, 1, ""))
    unasked = begun and ASKS_IN_STATEMENTS.isdisjoint(words_in(text)) and not any(_ordered(text))
    return SentenceKind.UNASKED if unasked else SentenceKind.ORDER


def only_asks(text: str, goals: Sequence[Goal]) -> bool:
    """Whether a question that asks for nothing to be done was taken for an order."""
    words = words_in(text)
    asks = text.rstrip(" \"'”)").endswith("?") and ASKS_IN_QUESTIONS.isdisjoint(words)
    return asks and not all(isinstance(goal, LOOKING) for goal in each(goals))


def only_told(text: str, goals: Sequence[Goal]) -> bool:
    """Whether what was only said, wondered or asked about oneself was taken for an order.

    "Perhaps it would look better there", "you should have put it there", "shall I close it?", "then
    he goes: bring me the cup", "enough tea for Leo".
    """
    looks = all(isinstance(goal, (*LOOKING, Stop, Say, Ask)) for goal in each(goals))
    plain = " ".join(text.lower().replace("’", "'").split())
    return not looks and (bool(_ONLY_SAID.fullmatch(plain)) or is_reported(_CALLED.sub("", text)))


def _wonders(text: str, goals: Sequence[Goal]) -> bool:
    looks = all(isinstance(goal, LOOKING) for goal in each(goals))
    first = words_in(text)[:1]
    return not looks and text.rstrip().endswith("?") and not _WONDERS.isdisjoint(first)


def _ordered(text: str) -> Iterator[bool]:
    """For each clause behind the first, whether it begins with an order: "..., *close it*"."""
    _, *others = (words_in(clause) for clause in _CLAUSES.split(text.lower()))
    for words in filter(None, others):
        follows = words[1:2] != [] and words[1] in lexicon.DETERMINERS | lexicon.PRONOUNS
        yield follows and base_form(words[0]) == words[0] and bool(verbs_at(words, 0))


def _you_do(text: str) -> Iterator[bool]:
    """For each clause, whether it begins as learners ask: "my hands are wet, *you open* it?"."""
    for words in map(words_in, _CLAUSES.split(text.lower())):
        verb = words[1] if words[:1] == ["you"] and words[1:] else ""
        yield bool(verb) and base_form(verb) == verb and bool(verbs_at(words, 1))
