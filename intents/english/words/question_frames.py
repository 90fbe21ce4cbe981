"""Questions told by the closed class of words around a name, in whatever order those stand.

"Whaur's ma stick got tae?", "which shelf have the sugar?", "the mop in where are we keeping?" ask
where something is; "what's that ye've got in yer haun?" asks what is held; "in the yard there is
somebody?" asks whether anybody is there. Where every word but one name is of a class that only
asks that, the order does not matter, and the question is put plainly. One word more, and it is
left as it was said.
"""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.names import Kind, Match, NameIndex

_LITTLE = lexicon.unlisted(
    "the a an my ma me your our his her their that this yon them those is are 's was were be am "
    "do does did has have had of to tae at in on for and so now then just please robot you ye we "
    "they i it there here got get gone been would could can tell know ken even again wee old auld "
    "own mine bloody flipping blinking blooming"
)
_WHERE = lexicon.unlisted("where whaur wheres whereabouts")
_OATHS = lexicon.unlisted("god gods heaven heavens name earth hell devil blazes world in on the 's")
_KEPT = lexicon.unlisted(
    "keep keeping kept put putting left leave leaving hid hide hidden hiding stay staying live "
    "lives living went go goes away off up somebody someone everybody anyone disappeared vanished "
    "find see sitting standing lying stored"
)
_PLACES = lexicon.unlisted(
    "shelf cupboard place drawer room box rack surface table corner spot cabinet"
)
_HANDS = lexicon.unlisted("hand hands haun haund hauns haunds fist grip paw paws")
_HOLDS = lexicon.unlisted("what whit wot whats thing hold holding holdin carry carrying clutching")
_BODY = lexicon.unlisted("somebody someone anybody anyone anybody nobody soul")
_AROUND = lexicon.unlisted(
    "all out down up over right any left inside or not still around about who what anything owt "
    "anythin"
)
_LIES = lexicon.unlisted(
    "what all lying knocking about kicking around sitting doing left anything owt anythin over up "
    "top inside still down"
)
_SPOTS = lexicon.unlisted("on in at under inside")
_QUEUES = lexicon.unlisted("waiting queueing queuing seated queued")


def plainly_put(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with a plain question for one in any order; else as they are."""
    words = [token.text for token in tokens]
    ends = next((n for n, word in enumerate(words) if word in (COMMA, FULL_STOP)), len(words))
    if not any(token.text == FULL_STOP and "?" in token.raw for token in tokens[: ends + 1]):
        return tokens
    alone = ends >= len(words) - 1  # "anybody at the till? go there" is a condition
    for read in (_where, _held, *((_anybody, _waiting, _lying) if alone else ())):
        plain = read(tokens[:ends], words[:ends], index)
        if plain is not None:
            return [*plain, *tokens[ends:]]
    return tokens


def _name_among(words: list[str], index: NameIndex, *sorts: Kind) -> tuple[int, Match] | None:
    """The only name of a sentence, and where it begins; None if there are several or none."""
    found: list[tuple[int, Match]] = []
    at = 0
    while at < len(words):
        match = index.match(words, at)
        if match is not None and words[at] not in _LITTLE:
            found.append((at, match))
            at = match.end
        else:
            at += 1
    one = found[0] if len(found) == 1 else None
    return one if one is not None and one[1].of(*sorts) else None


def _rest(words: list[str], named: tuple[int, Match]) -> set[str]:
    return {*words[: named[0]], *words[named[1].end :]}


def _said(text: str) -> list[Token]:
    return [Token(word, word) for word in text.split()]


def _where(tokens: list[Token], words: list[str], index: NameIndex) -> list[Token] | None:
    """*Where in God's name did they put* my frame?"""
    named = _name_among(words, index, "object", "person")
    if named is None:
        return None
    rest = _rest(words, named)
    asks = not _WHERE.isdisjoint(rest) or (
        not {"which", "what"}.isdisjoint(rest) and not _PLACES.isdisjoint(rest)
    )
    known = _LITTLE | _WHERE | _KEPT | _OATHS | _PLACES | {"which", "what"}
    if not asks or not rest <= known or ({"you", "i", "we"} & rest and {"go", "goes"} & rest):
        return None
    who = named[1].of("person")
    thing = tokens[named[0] : named[1].end]
    return [*_said("where is" if who else "where is the"), *thing]


def _held(tokens: list[Token], words: list[str], index: NameIndex) -> list[Token] | None:
    """What's that *ye've got in yer haun*? What have you there?"""
    del tokens, index
    rest = set(words)
    hands = not _HANDS.isdisjoint(rest) and not {"your", "yer", "you", "ye"}.isdisjoint(rest)
    there = words in (["what", "have", "you", "there"], ["what", "you", "have", "there"],
                      ["what", "have", "you", "got", "there"])  # fmt: skip
    holds = bool(rest & {"holding", "holdin"}) and not {"you", "ye"}.isdisjoint(rest)
    asks = not {"what", "whit", "wot"}.isdisjoint(rest)
    known = _LITTLE | _HANDS | _HOLDS | {"yer", "have", "what"}
    plain = asks and (hands or there or holds) and rest <= known
    return _said("what are you holding") if plain else None


def _anybody(tokens: list[Token], words: list[str], index: NameIndex) -> list[Token] | None:
    """*In the yard* there is somebody?"""
    named = _name_among(words, index, "place", "room")
    rest = _rest(words, named) if named else set[str]()
    if named is None or _BODY.isdisjoint(rest) or not rest <= _LITTLE | _BODY | _AROUND:
        return None
    spot = tokens[named[0] : named[1].end]
    return [*_said("is there anybody in the"), *spot]


def _waiting(tokens: list[Token], words: list[str], index: NameIndex) -> list[Token] | None:
    """*How many have I got waiting on* that bench?"""
    named = _name_among(words, index, "place", "room")
    rest = _rest(words, named) if named else set[str]()
    if named is None or words[:2] != ["how", "many"] or _QUEUES.isdisjoint(rest):
        return None
    if not rest <= _LITTLE | _QUEUES | {"how", "many"}:
        return None
    spot = tokens[named[0] : named[1].end]
    return [*_said("how many people are at the"), *spot]


def _lying(tokens: list[Token], words: list[str], index: NameIndex) -> list[Token] | None:
    """What all *is knocking about on* the worktop? *Anything left in* the freezer?"""
    named = _name_among(words, index, "place")
    rest = _rest(words, named) if named else set[str]()
    asks = {"what", "anything", "owt", "anythin"} & rest
    more = rest & {"all", "lying", "knocking", "kicking", "left", "about"}
    if named is None or not asks or not more or not rest <= _LITTLE | _LIES:
        return None
    spots = [word for word in words[: named[0]] if word in _SPOTS]
    spot = tokens[named[0] : named[1].end]
    return [*_said(f"what is {spots[-1]} the"), *spot] if spots else None
