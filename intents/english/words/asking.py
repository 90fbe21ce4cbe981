"""Roundabout requests, turned into plain ones: what is asked for with all that is put around it.

"Would it be a dreadful cheek to ask for the menu" (bring me the menu); "I should sleep much better
if you would lock the door" (lock the door); "I would be ever so glad if the tray were back in the
pantry" (the tray should be back in the pantry). They are told by their frame, a subject with a
modal in front of what is asked for, and not by the words in it.
"""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.names import NameIndex
from intents.english.words.verbs import FIRST_WORDS

_LONGEST = 14
"""So many words are put around what is asked for."""
_MODALS = lexicon.words("would should might could will shall may can must")
_SUBJECTS = lexicon.words("i we it that this")
_ASKS = lexicon.words("may might could can shall dare would is will i we")
"""How one begins who asks whether one may ask."""
_AVERSE = lexicon.words(
    "not never upset sorry angry annoyed sad hate mad cross furious disappointed worse unhappy "
    "displeased dislike livid resent object scream complain shame pity dangerous bad terrible "
    "wrong awful horrible cry say wonder ask know what who where how why"
)
"""Who would be so if it were done does not ask for it."""
_GLAD = lexicon.words(
    "pleased glad happy grateful obliged lovely nice great good wonderful delighted better easier "
    "happier thankful perfect ideal kind relieved love like appreciate prefer splendid best "
    "brilliant helpful marvellous fine comfort comfortable calmer tidier safer neater"
)
"""Who would be so wishes that it were; "we could play if it were there" is no wish."""
_WILLING = lexicon.words("would could might can will")
_SO = {
    ("were",): ("should", "be"), ("was",): ("should", "be"), ("could", "be"): ("should", "be"),
    ("might", "be"): ("should", "be"), ("would", "be"): ("should", "be"),
    ("could", "get"): ("should", "get"), ("found", "its", "way"): ("should", "go"),
    ("could", "find", "its", "way"): ("should", "go"),
    ("might", "find", "its", "way"): ("should", "go"),
    ("would", "find", "its", "way"): ("should", "go"),
    ("could", "make", "its", "way"): ("should", "go"), ("went",): ("should", "go"),
    ("could", "go"): ("should", "go"), ("might", "go"): ("should", "go"),
}  # fmt: skip
"""How it is said that something is wished to be so, and how it is said plainly."""
_LONGEST_THING = 7
"""So many words the thing has of which that is said."""


def plainly_asked(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens without what is put around a request."""
    at = 0
    while at < len(tokens):
        if at == 0 or tokens[at - 1].text in (COMMA, FULL_STOP, "and", "so", "but", "well"):
            tokens = _asked_for(tokens, at) or _asked_if(tokens, at, index) or tokens
        at += 1
    return tokens


def _asked_for(tokens: list[Token], at: int) -> list[Token] | None:
    """*Might I ask you for* the menu: bring me the menu."""
    words = [token.text for token in tokens[at : at + _LONGEST]]
    asks = words.index("ask") if "ask" in words else 0
    before, end = words[:asks], asks + 1 + (words[asks + 1 : asks + 2] == ["you"])
    mine = before[:1] and before[0] in _ASKS and not {COMMA, "you", "not"}.intersection(before)
    mine = mine and ("i" in before or "we" in before or before[-1] == "to")
    if not mine or words[end : end + 1] != ["for"] or words[end + 1 : end + 2] == ["you"]:
        return None
    bring = [Token("bring", tokens[at].raw), Token("me", _raw(tokens[at + 1 : at + end + 1]))]
    return [*tokens[:at], *bring, *tokens[at + end + 1 :]]


def _asked_if(tokens: list[Token], at: int, index: NameIndex) -> list[Token] | None:
    """*I should sleep better if you would* lock the door; *I would be glad if* it were locked."""
    words = [token.text for token in tokens[at : at + _LONGEST + 2]]
    if words[:1] == [] or words[0] not in _SUBJECTS or words[1:2] == [] or words[1] not in _MODALS:
        return None
    if "if" not in words:
        return None
    link = words.index("if")
    around = words[:link]
    known = any(index.match(words, n) for n in range(2, link))
    averse = bool(_AVERSE.intersection(around)) or around[2:3] == ["mind"]
    if known or averse or {COMMA, FULL_STOP}.intersection(around):
        return None
    if words[link + 1 : link + 2] == ["you"]:
        willing = words[link + 2 : link + 3] and words[link + 2] in _WILLING
        verb = words[link + 3 : link + 4]
        asks = willing and verb and verb[0] in FIRST_WORDS
        return [*tokens[:at], *tokens[at + link + 3 :]] if asks else None
    glad = not _GLAD.isdisjoint(around)
    return _wished_so(tokens, at, at + link + 1) if glad else None


def _wished_so(tokens: list[Token], at: int, start: int) -> list[Token] | None:
    """The tray *were* back in the pantry: it should be there."""
    words = [token.text for token in tokens]
    for verb in range(start + 1, min(len(words), start + _LONGEST_THING)):
        if words[verb] in (COMMA, FULL_STOP, "you", "i", "there"):
            return None
        for said, meant in _SO.items():
            if tuple(words[verb : verb + len(said)]) == said:
                raw = _raw(tokens[verb : verb + len(said)])
                plain = [Token(word, raw * (n == 0)) for n, word in enumerate(meant)]
                kept = tokens[start:verb]
                return [*tokens[:at], *kept, *plain, *tokens[verb + len(said) :]]
    return None


def _raw(tokens: list[Token]) -> str:
    return " ".join(token.raw for token in tokens if token.raw)
