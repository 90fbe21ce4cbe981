"""Cries that hang on something: "walk 2 metres, *but stop after 1 metre*", "stop before the chair".

To a robot at work one is a cry like any other, for a stop too many is cheap, unless the sentence
orders something first, so that it limits what is ordered. To a robot at rest it is words of a task,
which the grammar reads (:mod:`intents.english.ending_early`).
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

from intents.english.words.verbs import verbs_at
from intents.halting import is_halt

_UNIT = (
    r"(?:m|cm|metres?|meters?|centimetres?|steps?|paces?|feet|foot|yards?|degrees?|turns?|s|secs?|"
    r"seconds?|min|mins|minutes?|hours?|times?)"
)
_SO_MUCH = rf"(?:[\w.]+\s+){{1,4}}{_UNIT}\b"
_HARM = r"(?:hit|fall|drop|break|spill|crash|bump|hurt|knock|trip|burn|crush|tip|kill|kick)"
_MANNERS = (
    r"(?:(?:it|that|there|here|now|again|please|just|only|right|shortly|immediately|at once|"
    r"straight away|\w+ing(?:\s+(?:her|him|it|them))?)\s+)*"
)
_LINK = (
    r"(?:after(?!\s+all\b)"
    rf"|before(?!\s+(?:it\W?s|it is|you|we|someone|somebody|something|he|she)\s+(?:\w+\s+){{0,2}}"
    rf"(?:late|{_HARM}))"
    r"|when(?:ever)?|once(?!\s+and\s+for\s+all)|as soon as(?!\s+(?:you can|possible))|unless"
    r"|if(?!\s+you\s+(?:can|please|could|hear|would))|until|till|while|half\s?way|midway"
    r"|at(?!\s+(?:once|last|all|that|this|least))|in\s+front|on\s+(?:my|the\s+count|\w+ing)|upon"
    rf"|(?:in|within|for)\s+(?={_SO_MUCH})|next\s+to|near|short\s+of|{_SO_MUCH})"
)
_AFTER = re.compile(rf"\s*{_MANNERS}{_LINK}\b")
"""What follows a cry that hangs on it."""
_BEFORE = re.compile(
    rf"^(?:\W*(?:and|but|then|so|please)\b)*\W*(?:if(?!\s+you\s+(?:can|could|hear))|when(?:ever)?|once|"
    rf"as soon as|after|before|unless|half\s?way)\b|\b(?:after|in|within)\s+{_SO_MUCH}\s*$"
)
"""What stands before one: a clause that says when."""
_STEP = re.compile(r"(?:and|then|and then)(?: please)?")
"""Go to the bar, *and* stop there: a step of a plan, to who is not under way."""
_OPENING = re.compile(
    r"^(?:\W*(?:please|robot|hey|okay|ok|now|just|then|and|but|so|could you|can you|"
    r"will you|would you)\b)*\W*"
)
_SEEN = frozenset(("look", "see", "listen", "watch", "hear", "come", "mind"))
"""What is called out, and no order by itself."""
_ENDING = frozenset(("stop", "pause", "cancel", "resume"))


class Surroundings(NamedTuple):
    """What a cry stands in.

    Attributes:
        ahead: The clauses before that of the cry, of the same sentence.
        at_rest: Whether it is said to a robot that has nothing to do.
        exclaimed: Whether something is called out there, with its sign.
    """

    ahead: Sequence[str]
    at_rest: bool
    exclaimed: bool

    def limit(self, before: str, after: str) -> bool:
        """Whether a cry between these words of a clause only limits something."""
        planned = _STEP.fullmatch(before.strip()) and any(map(_is_order, self.ahead))
        if planned and self.at_rest and not self.exclaimed:
            return True
        fronted = self.ahead[-1] if self.ahead and not _OPENING.sub("", before).strip() else ""
        if not (_AFTER.match(after) or _BEFORE.search(before) or _BEFORE.search(fronted)):
            return False
        ordered = any(map(_is_order, (*self.ahead, before)))
        return self.at_rest or (ordered and not self.exclaimed)


def _is_order(clause: str) -> bool:
    """Whether a clause orders something: "walk 2 metres", not "careful" or "no, stop"."""
    said = _OPENING.sub("", clause).split()
    senses = {sense for sense, _ in verbs_at(said, 0)}
    called = said[:1] and said[0] in _SEEN and len(said) < 3
    return bool(senses - _ENDING) and not called and not is_halt(" ".join(said))
