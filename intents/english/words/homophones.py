"""Words that were heard as others that sound alike: "sea if she's their", "the read cup".

Dictation writes one for the other, and so do people in a hurry. A word is taken for another only
where it cannot stand itself and the other can; what was changed is told, and a word of the
vocabulary is never changed.
"""

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import DETERMINERS, words
from intents.english.words.measures import NUMBER_WORDS
from intents.english.words.names import NameIndex
from intents.english.words.verbs import FIRST_WORDS

_MODALS = words("can could to not i you we will would let's please and then")
_BEFORE_THERE = words("is are was were 's sitting standing lying waiting put it them him her")
_POLITE = words("just kindly now robot hey ok okay you ll ya")
_WHOM = words("me us him her them the my your")
_TAKES = words("take get grab pick clear remove lift wipe move fetch bring knock collect")
_WAITED = NUMBER_WORDS | words("for a until here there while") | {COMMA, FULL_STOP}
_COLOURS = {"read": "red", "blew": "blue", "wight": "white"}
_ALIKE = frozenset(_COLOURS) | words("sea their theirs its hear weight wood four two than of")
_SIGNS = (COMMA, FULL_STOP)
_SWITCHES = words("turn switch turning switching")
_SWITCHED = words("the that this it my your our all both every")
_SOME = words("any a an some no one two three still another anything something anybody anyone")
_GOES_ON = words("gone in on under behind at near lying sitting standing still not over rolled")
_SAYS = words("say tell announce shout whisper repeat sing ask spell")


def as_meant(tokens: list[Token], index: NameIndex) -> tuple[list[Token], list[tuple[str, str]]]:
    """The tokens with what was meant, and which words were changed into which."""
    said = [token.text for token in tokens]
    meant: list[Token] = []
    changed: list[tuple[str, str]] = []
    for at, token in enumerate(tokens):
        alike = said[at] in _ALIKE and said[at] not in index.words
        word = _meant(said, at, index) if alike else ""
        if word and not _SAYS.intersection(said[:at]):
            changed.append((token.raw, word))
            said[at] = word.split()[-1]
            meant += [Token(one, one) for one in word.split()[:-1]]
        meant.append(Token(said[at], token.raw))
    return meant, changed


def _meant(said: list[str], at: int, index: NameIndex) -> str:
    """What a word is to be taken for; empty if for itself."""
    word, last = said[at], said[at - 1] if at else FULL_STOP
    after = said[at + 1] if at + 1 < len(said) else FULL_STOP
    begins = last in _SIGNS or last in _MODALS
    goes_on = after in DETERMINERS or after in _WHOM or after in ("if", "whether")
    where = last in _BEFORE_THERE and (after in _SIGNS or after in ("and", "then", "so"))
    named = index.match(said, at + 1) if at + 1 < len(said) else None
    described = (last in DETERMINERS or last in NUMBER_WORDS) and named is not None
    fits = {
        "sea": "see" if begins and goes_on else "",
        "their": "there" if where else "",
        "hear": "here" if last in ("come", "over", "it", "them") and after in _SIGNS else "",
        "weight": "wait" if begins and after in _WAITED and last not in ("the", "a") else "",
        "wood": "would" if begins and after == "you" else "",
        "four": "for" if after in _WHOM and last not in _SIGNS else "",
        "two": "to" if after in _WHOM and last not in _SIGNS else "",
        "than": "then" if after in FIRST_WORDS and last in (*_SIGNS, "and") else "",
        "theirs": "there is"
        if last in ("if", "whether", "and", *_SIGNS) and after in _SOME
        else "",
        "its": "it is" if after in _GOES_ON else "",
        "of": "off" if _is_off(said, at, index) or _is_taken_off(said, at, index) else "",
    }
    return fits.get(word) or (_COLOURS.get(word, "") if described else "")


def _is_off(said: list[str], at: int, index: NameIndex) -> bool:
    """Turn *of* the lamp, switch the lamp *of*: what turns something of another is a noun."""
    last, before = said[at - 1] if at else "", said[at - 2] if at > 1 else FULL_STOP
    if last in _SWITCHES:
        named = at + 1 < len(said) and index.match(said, at + 1) is not None
        orders = before in _SIGNS or before in _MODALS or before in _POLITE
        return orders and (named or said[at + 1 : at + 2] == [] or said[at + 1] in _SWITCHED)
    clause = max((n + 1 for n in range(at) if said[n] in (*_SIGNS, "and", "then")), default=0)
    ends = at + 1 == len(said) or said[at + 1] in (*_SIGNS, "please", "and", "then", "now")
    return ends and not _SWITCHES.isdisjoint(said[clause:at])


def _is_taken_off(said: list[str], at: int, index: NameIndex) -> bool:
    """Take the cap *of the hook*: a thing that is no part of the place behind it."""
    clause = max((n + 1 for n in range(at) if said[n] in (*_SIGNS, "and", "then")), default=0)
    spot = index.match(said, at + 2) if said[at + 1 : at + 2] == ["the"] else None
    if spot is None or not spot.of("place") or not _TAKES.intersection(said[clause:at]):
        return False
    begun = (index.match(said, n) for n in range(clause, at))
    return any(
        thing is not None and thing.end == at and bool(thing.of("object")) for thing in begun
    )
