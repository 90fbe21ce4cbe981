"""Who is quoted: "the king cries, bring me the book", "my friend said to me, please open it".

Who speaks may say again what they want ("I said", "as I told you"): that is no quotation.
"""

import re

from intents.english.words import lexicon
from intents.english.words.lexer import words_in

_SAID = lexicon.words(
    "said says saying told tells telling asked asks ordered orders cried cries shouted shouts "
    "yelled yells wrote writes sang sings whispered whispers replied replies called calls goes "
    "went read reads screamed screams begged begs texted texts answered answers commanded commands"
)
_SAID_TO = lexicon.words(
    "to me us him her them it everyone everybody please that loudly aloud out like"
)
"""What may stand behind one of these ahead of what was said."""
_OWN_WORDS = lexicon.words("i we i've we've i'd i'm you")
_REACH = 2
_CLAUSES = re.compile(r"[,:;.!?—–]+")


def reports(words: list[str]) -> bool:
    """Whether what follows some words in lower case is what somebody else said."""
    last = len(words) - 1
    while last > 0 and words[last] in _SAID_TO:
        last -= 1
    says = last > 0 and words[last] in _SAID
    return says and _OWN_WORDS.isdisjoint(words[max(0, last - _REACH) : last])


def is_reported(text: str) -> bool:
    """Whether a sentence holds what somebody else said, set off by a sign."""
    clauses = _CLAUSES.split(text.lower().replace("’", "'"))
    return any(reports(words_in(clause)) for clause in clauses[:-1])
