"""Occasions in a sentence: "every evening", "daily at six", "later", "when I get back".

Those in the clause of an order, or in one of their own, say when it is to be done. What is only
told of ("we dine at six", "he comes tomorrow", "it is for tonight") is none of an order.
"""

import re
from collections.abc import Iterator

from intents.english.words import lexicon
from intents.english.words.lexer import words_in
from intents.english.words.verbs import FIRST_WORDS, base_form

_DAY = r"(?:mon|tues|wednes|thurs|fri|satur|sun)day"
_NUMBER = r"(?:one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|\d{1,2})"
_UNIT = r"(?:minute|hour|day|week|month|year|night|morning|evening)"
_END = r"(?=\W*(?:$|[,;:.!?—–)]|(?:and|but|or|please|then|for|in the|on the|sharp|every|each)\b))"
_OCCASION = re.compile(
    rf"\b(?:every|each)\s+(?:single\s+|other\s+|second\s+|{_NUMBER}\s+)?"
    rf"(?:{_UNIT}s?|{_DAY}|noon|afternoon|weekday|weekend|dawn|dusk|lunchtime|mealtime)\b"
    r"|\b(?:daily|nightly|hourly|weekly|fortnightly|monthly|yearly|annually)\b"
    rf"|\b(?:once|twice|thrice|{_NUMBER}\s+times)\s+(?:an?|per|every|each)\s+{_UNIT}\b"
    rf"|\b(?:on|from|until|next|this)\s+{_DAY}s?\b(?:\s+(?:morning|afternoon|evening|night)s?)?"
    rf"|\b{_DAY}s?(?:\s+(?:morning|afternoon|evening|night)s?)?{_END}"
    r"|\b(?:first thing\s+)?(?:tomorrow|tonight)\b(?!['’]s)"
    r"(?:\s+(?:morning|afternoon|evening|night))?"
    r"|\bat the (?:end|close) of (?:the |my |our )?(?:day|week|month|year|shift|meeting|lesson|"
    r"party|game|film|show|session|class|service|evening|night|morning|afternoon)\b"
    r"|\bthis (?:evening|afternoon)\b|\bnext (?:week|month|year|time)\b"
    r"|\bin the (?:morning|afternoon|evening)s?\b|\bfirst thing\b(?!\s+(?:you|i|we|is|to|about))"
    r"|\bat (?:noon|midnight|midday|dawn|dusk|sunset|sunrise|nightfall|lunchtime|bedtime|teatime|"
    r"dinnertime|night|breakfast|lunch|supper)\b"
    rf"|\bat (?:half(?: past)? {_NUMBER}|(?:a )?quarter (?:past|to) {_NUMBER}|{_NUMBER}\s*"
    rf"(?:o['’]?clock|am|pm|a\.m\.?|p\.m\.?|sharp)|{_NUMBER}[:.]\d\d|{_NUMBER}"
    rf" (?:thirty|fifteen|forty[- ]five)|{_NUMBER}{_END})"
    rf"|\b(?:by )?{_NUMBER} o['’]?clock\b"
    rf"|(?<!no )(?<!not )\b(?:later on|later|some other time|another time){_END}"
    r"|\bfrom (?:now|today|tomorrow|this day) on(?:wards?)?\b|\bhenceforth\b"
    r"|\b(?:when|once|whenever|as soon as|after|the (?:moment|minute)) (?:i|we|he|she|they)"
    r"(?:['’](?:m|re|s|ve)| am| are| is| get| gets| come| comes| return| returns| have| has| leave|"
    r" leaves| arrive| arrives| finish| finishes| wake| wakes| call| calls| ring| rings)\b"
    r"(?! (?:a |the )?(?:moment|second|minute|time|sec)\b)"
)
"""A time of the clock or the calendar, how often, and when somebody else has done something."""
_STANDING = re.compile(r"^\W*(?:please\s+)?always\s+(\w+)")
"""*Always* put it there: a rule, and no order."""
_NO_OCCASION = re.compile(r"\b(?:not|no|don['’]?t|never|than|for|of)\s+(?:the\s+)?$")
"""Not *tonight*: what it is not; later *than ten*; *for* tonight: what for."""
_CLAUSES = re.compile(
    r"[,;:!?—–(]+|\.(?!\d)|"
    r"\b(?:but|so|because|since|cause|(?<!soon )as(?! soon)|while|although|though)\b"
)
_TOLD = re.compile(
    r"['’](?:s|re|ve|ll|m|d)\b|\b(?:is|are|was|were|am|will|has|had|does|did|comes?|came|starts?|"
    r"started|opens|closes|leaves|left|arrives?|arrived|goes|went|gets|got|said|says|saw|use|uses|"
    r"used|did|bought|brought|put|took)\b"
)
_ASKS = re.compile(
    r"\b(?:please|can|could|would|will|should|shall|must|need|needs|want|wants|like|let|let['’]?s|"
    r"have to|has to|got to|ought|to be|be sure|make sure|remember to|don['’]?t forget to)\b"
)
_OF_ORDERS = frozenset(("please", "and", "then", "robot", "now", "just", "you", "also", "kindly"))
_SUBJECTS = [[word] for word in ("i", "we", "he", "she", "they", "it", "there", "you")]
_ALONE = 2
"""So few words beside an occasion make no clause of their own."""


def occasions(plain: str) -> Iterator[str]:
    """What is told in a text in lower case of when, or how often, something is to be done."""
    always = _STANDING.match(plain)
    if always and _orders([always[1]]):
        yield "always"
    begin = 0
    for sign in [*_CLAUSES.finditer(plain), None]:
        end = sign.start() if sign else len(plain)
        clause = plain[begin:end]
        for found in _OCCASION.finditer(clause):
            if not _NO_OCCASION.search(clause[: found.start()]) and is_of_order(
                clause, found.span()
            ):
                yield found.group().strip()
        begin = sign.end() if sign else end


def is_of_order(clause: str, occasion: tuple[int, int]) -> bool:
    """Whether a clause orders something on an occasion that stands in it, or only says when.

    Args:
        clause: In lower case, without signs.
        occasion: From where to where it is said in it.
    """
    start, end = occasion
    rest = f"{clause[:start]} {clause[end:]}"
    words = [word for word in words_in(rest) if word not in _OF_ORDERS]
    subject = words[:1] in _SUBJECTS
    told = bool(_TOLD.search(rest)) or subject
    if not words or (len(words) <= _ALONE and not told):
        return True
    ordered = _orders(words) and not subject
    return ordered or (bool(_ASKS.search(rest)) and not _tells(words))


def _orders(words: list[str]) -> bool:
    return bool(words) and words[0] in FIRST_WORDS and base_form(words[0]) == words[0]


def _tells(words: list[str]) -> bool:
    """He *will come*, I *must go*: what somebody else does."""
    return words[0] in lexicon.words("i we he she they it there") and words[1:2] not in (
        ["want"], ["need"], ["would"], ["'d"],
    )  # fmt: skip
