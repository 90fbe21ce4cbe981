"""Word order and turns of those who think in another language, in the order of English.

"The under the bench lying glove" (the glove under the bench), "take from the loaves the smallest"
(take the smallest loaf), "show with the finger on the oven" (point at it), "we are having" (we
have). Each is told by its form, whatever is named in it.
"""

from intents.english.words.lexer import COMMA, FULL_STOP, Token, singular
from intents.english.words.lexicon import DETERMINERS, LOCATIVES, SUPERLATIVES, unlisted
from intents.english.words.names import NameIndex
from intents.english.words.verbs import FIRST_WORDS, base_form

_LIES = unlisted("lying laying standing sitting hanging placed located being situated")
_WARMS = unlisted("warming heating cooling starting revving firing")
_WISHES = (("i", "want"), ("i", "need"), ("we", "want"), ("we", "need"))
_STATES = {"having": "have", "wanting": "want", "needing": "need", "liking": "like"}
_BE = unlisted("am are is")
_SHOWS = unlisted("show point indicate")
_TAKES = unlisted("take bring fetch give get pick choose select")
_COUNTS = unlisted("one two three four five a an some")
_LINKS = unlisted("that which who where when what if is are")
_OBJECTS = unlisted("it me him her them us to here back in on off up")
_LONGEST = 3


def in_english_order(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens in the order that the grammar knows."""
    tokens = _wished_last(_started(_stated(_afterwards(tokens, index))))
    tokens = _verb_second(_pointed(_most(tokens, index)), index)
    for at in range(len(tokens) - 3, -1, -1):
        tokens = _described_ahead(tokens, at, index) or _chosen_from(tokens, at, index) or tokens
    return tokens


def _stated(tokens: list[Token]) -> list[Token]:
    """We *are having* two: we have two."""
    plain: list[Token] = []
    for token in tokens:
        meant = _STATES.get(token.text)
        if (
            meant
            and len(plain) > 1
            and plain[-1].text in _BE
            and plain[-2].text in ("i", "we", "you")
        ):
            plain[-1] = Token(meant, f"{plain[-1].raw} {token.raw}")
        else:
            plain.append(token)
    return plain


def _afterwards(tokens: list[Token], index: NameIndex) -> list[Token]:
    """Wait here *and after* bring the tea: and then."""
    said = [token.text for token in tokens]
    plain = list(tokens)
    for at in range(1, len(said) - 2):
        verb = said[at + 1]
        bare = verb in FIRST_WORDS and base_form(verb) == verb and not index.match(said, at + 1)
        joined = said[at] == "after" and said[at - 1] in ("and", COMMA, FULL_STOP)
        goes_on = said[at + 2] in DETERMINERS or index.match(said, at + 2) is not None
        if joined and bare and (goes_on or said[at + 2] in _OBJECTS):
            plain[at] = Token("then", tokens[at].raw)
    return plain


def _most(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The bowl *more small*: the smallest bowl."""
    said = [token.text for token in tokens]
    for at in range(len(said) - 2):
        match = index.match(said, at + 1) if said[at] == "the" else None
        size = said[match.end : match.end + 2] if match and match.of("object", "category") else []
        sized = len(size) > 1 and size[0] in ("more", "most") and ("most", size[1]) in SUPERLATIVES
        if match is not None and sized:
            most = [Token("most", tokens[match.end].raw), tokens[match.end + 1]]
            noun = tokens[at + 1 : match.end]
            return [*tokens[: at + 1], *most, *noun, *tokens[match.end + 2 :]]
    return tokens


def _started(tokens: list[Token]) -> list[Token]:
    """Get the oven *warming up*: going."""
    said = [token.text for token in tokens]
    for at in range(2, len(said) - 1):
        begins = said[at] in _WARMS and said[at + 1] == "up" and "get" in said[:at]
        if begins and said[at - 1] not in _BE:
            raw = f"{tokens[at].raw} {tokens[at + 1].raw}"
            return [*tokens[:at], Token("going", raw), *tokens[at + 2 :]]
    return tokens


def _wished_last(tokens: list[Token]) -> list[Token]:
    """*One cup of tea I want*: I want one cup of tea."""
    said = [token.text for token in tokens]
    ends = [n for n, word in enumerate(said) if word in (COMMA, FULL_STOP)]
    close = ends[0] if ends else len(said)
    wish = tuple(said[close - 2 : close])
    first = said[:1] and (said[0] in DETERMINERS or said[0] in _COUNTS)
    if wish not in _WISHES or not first or not _LINKS.isdisjoint(said[1 : close - 2]):
        return tokens
    return [*tokens[close - 2 : close], *tokens[: close - 2], *tokens[close:]]


def _verb_second(tokens: list[Token], index: NameIndex) -> list[Token]:
    """When Ada in the hall *is*, ...: when Ada is in the hall."""
    said = [token.text for token in tokens]
    for at in range(len(said) - 4):
        first = at + 1 + (said[at + 1] in DETERMINERS)
        match = index.match(said, first) if said[at] in ("if", "when") else None
        end = said.index(COMMA, at) if match is not None and COMMA in said[at:] else 0
        if match is None or end - 1 <= match.end or said[end - 1] not in ("is", "are"):
            continue
        if tuple(said[match.end : match.end + 1]) in LOCATIVES:
            verb, rest = tokens[end - 1], tokens[match.end : end - 1]
            return [*tokens[: match.end], verb, *rest, *tokens[end:]]
    return tokens


def _pointed(tokens: list[Token]) -> list[Token]:
    """Show *with the finger on* the oven: point at it."""
    said = [token.text for token in tokens]
    for at in range(len(said) - 4):
        finger = said[at + 1] == "with" and said[at + 2] in DETERMINERS and said[at + 3] == "finger"
        if said[at] in _SHOWS and finger and said[at + 4] in ("on", "at", "to"):
            raw = " ".join(token.raw for token in tokens[at : at + 4])
            return [
                *tokens[:at],
                Token("point", raw),
                Token("at", tokens[at + 4].raw),
                *tokens[at + 5 :],
            ]
    return tokens


def _described_ahead(tokens: list[Token], at: int, index: NameIndex) -> list[Token] | None:
    """The *under the bench lying* glove: the glove under the bench."""
    said = [token.text for token in tokens]
    if said[at] not in DETERMINERS:
        return None
    size = next(
        (n for n in range(_LONGEST, 0, -1) if tuple(said[at + 1 : at + 1 + n]) in LOCATIVES), 0
    )
    spot = at + 1 + size
    first = spot + (said[spot : spot + 1] != [] and said[spot] in DETERMINERS)
    where = index.match(said, first) if size and first < len(said) else None
    lies = where is not None and said[where.end : where.end + 1] != [] and said[where.end] in _LIES
    if where is None or not lies or where.end + 1 >= len(said):
        return None
    thing = index.match(said, where.end + 1)
    if thing is None or not thing.of("object", "category"):
        return None
    ahead, noun = tokens[at + 1 : where.end], tokens[where.end + 1 : thing.end]
    return [*tokens[: at + 1], *noun, *ahead, *tokens[thing.end :]]


def _chosen_from(tokens: list[Token], at: int, index: NameIndex) -> list[Token] | None:
    """Take *from the loaves the smallest*: take the smallest loaf."""
    said = [token.text for token in tokens]
    if said[at] not in _TAKES or said[at + 1 : at + 2] not in (["from"], ["of"]):
        return None
    first = at + 2 + (said[at + 2] in DETERMINERS)
    things = index.match(said, first) if first < len(said) else None
    if things is None or not things.of("object", "category") or singular(said[things.end - 1]) == (
        said[things.end - 1]
    ):  # fmt: skip
        return None
    the = things.end
    sizes = range(2, 0, -1)
    most = next((n for n in sizes if tuple(said[the + 1 : the + 1 + n]) in SUPERLATIVES), 0)
    end = the + 1 + most
    closes = end >= len(said) or said[end] in (COMMA, FULL_STOP, "and", "to", "for")
    if said[the : the + 1] != ["the"] or not most or not closes:
        return None
    noun = tokens[first : things.end]
    return [*tokens[: at + 1], *tokens[the:end], *noun, *tokens[end:]]
