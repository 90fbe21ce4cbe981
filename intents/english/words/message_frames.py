"""How it is said that somebody is to be told something, put as "tell Ada that ...".

"Holler through to Ada that ...", "give Ada the message that ...", "mention to Ada, would you, that
...", "Ada wants telling that ...", "a word for Ada: ...", "get hold of Ada and tell her ...": the
frame says who is told, and what stands behind it is the message, which is left as it was said. Its
tail ("..., quick!", "..., pet") is to who is asked to tell it, and no part of it.
"""

from collections.abc import Sequence

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.names import NameIndex

Phrase = tuple[str, ...]


def _phrases(text: str) -> frozenset[Phrase]:
    return frozenset(tuple(phrase.split()) for phrase in text.split(","))


_SHOUTS = lexicon.unlisted("holler shout yell call bellow whisper roar sing")
_WAYS = lexicon.unlisted("out through over up across down in along back round on")
_MENTIONS = lexicon.unlisted(
    "mention explain intimate communicate report convey signal hint confirm relay pass announce"
)
_WARNS = lexicon.unlisted("warn alert assure intimate apprise caution")
_GIVES = lexicon.unlisted("give send get pass leave bring")
_NEWS = _phrases(
    "the message,a message,this message,my message,word,the word,the news,the shout,a shout,"
    "a heads up,the heads up,a note,notice,to understand,to know"
)
_PASSES = lexicon.unlisted("pass relay convey get give send take carry deliver bring")
_PASSED = _phrases(
    "this,the message,a message,this message,my message,word,the word,a word,the news"
)
_WANTS_TELLING = _phrases(
    "wants telling,needs telling,want telling,need telling,wants to be told,needs to be told,"
    "wants informing,needs informing,needs to know,ought to know,should know,should be told,"
    "must be told,has to be told,is to be told,wants warning,needs warning,wants reminding,"
    "needs reminding,ought to be told"
)
_REACHES = _phrases(
    "get hold of,get a hold of,get a haud of,get haud of,get ahold of,grab hold of,"
    "get in touch with,track down"
)
_FOR = _phrases(
    "a word for,a word to,a message for,a message to,message for,message to,word for,news for"
)
_GOES = lexicon.unlisted("nip pop run dash hop trot scoot scurry jog hurry")
_TELLS = lexicon.unlisted("tell say inform let remind")
_HIM = lexicon.unlisted("him her them")
_BESIDE_NAMES = lexicon.unlisted(
    "our that the this my your young old wee little poor girl lad boy lass fella lady man"
)
_ASIDES = _phrases("would you,will you,could you,can you,please,if you would,kindly,for me")
_TAILS = _phrases(
    "quick,quickly,be quick,quick now,now,noo,right now,asap,pronto,sharpish,chop chop,hurry,pet,"
    "love,pal,mate,hen,duck,dear,darling,bless,bless him,bless her,ta,cheers,thanks,thank you,"
    "go on,there we are,there is a love,there is a dear,there is a good lad,off you go,"
    "would you,will you,could you"
)
"""What closes the asking, not the message."""
_STARTS = lexicon.unlisted("and then please you to could would can will just robot kindly do so")
_MOST_BESIDE = 3
_COLON = ":"


def with_plain_frames(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with "tell Ada that" for the frame of a message, and without its tail."""
    words = [_COLON if token.raw == _COLON else token.text for token in tokens]
    for at in range(len(words)):
        starts = at == 0 or words[at - 1] in (COMMA, FULL_STOP) or words[at - 1] in _STARTS
        found = _frame(words, at, index) if starts else None
        if found is None:
            continue
        name, end = found
        told = [Token("tell", "tell"), *tokens[name[0] : name[1]], Token("that", "that")]
        return _without_tail([*tokens[:at], *told, *tokens[end:]])
    return _without_tail(tokens)


Found = tuple[tuple[int, int], int] | None
"""From where to where who is told is named, and where the message begins."""


def _frame(words: list[str], at: int, index: NameIndex) -> Found:
    """Who is told, as from where to where they are named; where the message begins."""
    for read in (_shouted, _given, _passed, _mentioned, _warned, _wanted, _reached, _headed):
        found = read(words, at, index)
        if found is not None and found[1] < len(words):
            return found
    return None


def _shouted(words: list[str], at: int, index: NameIndex) -> Found:
    """Holler *through to Ada that* ..."""
    if words[at] not in _SHOUTS:
        return None
    n = _past(words, at + 1, _WAYS)
    name = _named(words, n + 1, index) if words[n : n + 1] in (["to"], ["at"]) else None
    return _linked(words, name, needs=True)


def _given(words: list[str], at: int, index: NameIndex) -> Found:
    """Give *Ada the message that* ..."""
    name = _named(words, at + 1, index) if words[at] in _GIVES else None
    news = _phrase_end(words, name[1], _NEWS) if name else None
    return _linked(words, name, at=news, needs=True) if news else None


def _passed(words: list[str], at: int, index: NameIndex) -> Found:
    """Relay *this to Ada, please:* ...; pass on *to Ada that* ..."""
    if words[at] not in _PASSES:
        return None
    n = at + 1 + (words[at + 1 : at + 2] in (["on"], ["along"]))
    what = _phrase_end(words, n, _PASSED)
    n = what if what is not None else n
    n += words[n : n + 1] in (["on"], ["along"])
    if n == at + 1 or words[n : n + 1] != ["to"]:
        return None
    return _linked(words, _named(words, n + 1, index), needs=True, sign=what is not None)


def _mentioned(words: list[str], at: int, index: NameIndex) -> Found:
    """Mention *to Ada, would you, that* ..."""
    if words[at] not in _MENTIONS or words[at + 1 : at + 2] != ["to"]:
        return None
    return _linked(words, _named(words, at + 2, index), needs=True)


def _warned(words: list[str], at: int, index: NameIndex) -> Found:
    """Warn *Ada* the floor is wet."""
    name = _named(words, at + 1, index) if words[at] in _WARNS else None
    behind = words[name[1]] if name and name[1] < len(words) else FULL_STOP
    if name is None or behind in ("of", "about", COMMA, FULL_STOP, _COLON):
        return None
    return _linked(words, name)


def _wanted(words: list[str], at: int, index: NameIndex) -> Found:
    """*Ada wants telling that* ..."""
    name = _named(words, at, index)
    end = _phrase_end(words, name[1], _WANTS_TELLING) if name else None
    return _linked(words, name, at=end) if end else None


def _reached(words: list[str], at: int, index: NameIndex) -> Found:
    """Get hold of *Ada and tell her* ..."""
    start = _phrase_end(words, at, _REACHES)
    name = _named(words, start, index) if start else None
    if name is None or words[name[1] : name[1] + 1] != ["and"]:
        return None
    tells = words[name[1] + 1 : name[1] + 2]
    him = words[name[1] + 2 : name[1] + 3]
    if tells != ["tell"] or not him or him[0] not in _HIM:
        return None
    return _linked(words, name, at=name[1] + 3)


def _headed(words: list[str], at: int, index: NameIndex) -> Found:
    """*A word for Ada:* ..."""
    start = _phrase_end(words, at, _FOR)
    name = _named(words, start, index) if start else None
    return _linked(words, name, needs=True, sign=True)


def _linked(
    words: list[str],
    name: tuple[int, int] | None,
    *,
    at: int | None = None,
    needs: bool = False,
    sign: bool = False,
) -> Found:
    """Past an aside and "that", to the message; a colon alone may announce it, too.

    Args:
        words: The sentence.
        name: Who is told; None if nobody is named.
        at: Where it goes on; by default behind the name.
        needs: Whether something has to announce the message.
        sign: Whether a colon does.
    """
    if name is None:
        return None
    begin = name[1] if at is None else at
    apart = begin + (words[begin : begin + 1] in ([COMMA], [_COLON]))
    aside = _phrase_end(words, apart, _ASIDES)
    if aside is not None:
        begin = aside
    colon = words[begin : begin + 1] == [_COLON]
    comma = colon or words[begin : begin + 1] in ([COMMA], [FULL_STOP])
    that = words[begin + comma : begin + comma + 1] == ["that"]
    if needs and not that and not (colon and sign):
        return None
    return name, begin + comma + that if (comma or that) else begin


def _named(words: Sequence[str], at: int, index: NameIndex) -> tuple[int, int] | None:
    """From where to where somebody is named, with what stands beside the name."""
    for n in range(at, min(at + _MOST_BESIDE, len(words))):
        match = index.match(list(words), n)
        if match is not None and match.of("person"):
            return at, match.end
        if words[n] not in _BESIDE_NAMES:
            return None
    return None


def _past(words: list[str], at: int, some: frozenset[str]) -> int:
    while at < len(words) and words[at] in some:
        at += 1
    return at


def _phrase_end(words: list[str], at: int, table: frozenset[Phrase]) -> int | None:
    """Where the longest phrase of a table at a word ends."""
    longest = min(len(words), at + 5)
    return next((end for end in range(longest, at, -1) if tuple(words[at:end]) in table), None)


def _without_tail(tokens: list[Token]) -> list[Token]:
    """The tokens without ", quick!" behind a message; and without "nip through and" before it."""
    words = [token.text for token in tokens]
    tells = next((n for n, word in enumerate(words) if word in _TELLS), None)
    if tells is None:
        return tokens
    if words[0] in _GOES and tells > 1 and words[tells - 1] in ("and", "to"):
        ways = words[1 : tells - 1]
        tokens = tokens[tells:] if all(word in _WAYS for word in ways) else tokens
        words = [token.text for token in tokens]
    ends = len(words) - (words[-1] == FULL_STOP)
    signs = [n for n in range(1, ends) if words[n] in (COMMA, FULL_STOP)]
    if not signs or signs[-1] < tells + 2:
        return tokens
    tail = tuple(words[signs[-1] + 1 : ends])
    return [*tokens[: signs[-1]], *tokens[ends:]] if tail in _TAILS else tokens
