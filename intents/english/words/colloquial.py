"""Little words of talk that stand for others, or for nothing: "put *the lot* there".

"Where is it *at*", "*make* close the door", "the *thing*, the pipette", "what have we got *left*".
"""

from intents.english.words.lexer import COMMA, DASHES, FULL_STOP, Token
from intents.english.words.lexicon import DETERMINERS, words
from intents.english.words.verbs import verbs_at

_BEGINS = words(", . and then to please you after before")
_RECEIVERS = words("him her me them us want wants")
_WHATSITS = words("thing thingy whatsit thingummy thingamajig thingamabob doodah gizmo doohickey")
_MADE = words("close open turn go walk bring take put switch come on off")
_SEEN_TO = (("see", "to", "that"), ("see", "to", "it"), ("see", "to", "this"))
_ORDERS = words("see is are was do does did can could")
"""What an order does not begin with, though it may be a verb."""
_AFTER_LEFT = words("in on at to over and") | {COMMA, FULL_STOP}


def colloquial(tokens: list[Token]) -> list[Token]:
    """Put *the lot* there: them; where is it *at*; *make close* the door; *the*, the cup."""
    kept: list[Token] = []
    words = [t.text for t in tokens]
    tokens = _looked_into(_seen_to(tokens, words))
    words = [t.text for t in tokens]
    for at in range(len(words) - 3, -1, -1):
        if words[at] in _WHATSITS and words[at + 1] == COMMA and words[at + 2] in DETERMINERS:
            begin = at - (words[at - 1] in DETERMINERS)
            del tokens[begin : at + 2]  # the thing, the pipette
    words = [t.text for t in tokens]
    for at, token in enumerate(tokens):
        last = kept[-1].text if kept else FULL_STOP
        begins = last in _BEGINS
        broken_off = token.raw in DASHES
        if last in ("the", "a", "an", "my") and token.text in (COMMA, last) and not broken_off:
            continue  # the, um, the stapler
        if token.text in ("that", "this") and _points_there(words, at):
            continue  # what is that on the bench
        if token.text == "left" and _remains(words, at):
            continue  # what have we got left
        if token.text == "lot" and last == "the" and words[at + 1 : at + 2] != ["of"]:
            kept[-1] = Token("them", f"{kept[-1].raw} {token.raw}")
        elif token.text == "1" and at + 1 == len(words) and last in _RECEIVERS:
            kept += [Token("a", ""), Token("one", token.raw)]
        elif (
            (
                token.text == "make"
                and begins
                and words[at + 1 : at + 2]
                and (
                    words[at + 1] in _MADE
                    and (words[at + 1] != "turn" or words[at + 2 : at + 3] == ["to"])
                )
            )
            or (token.text == "you" and at == 1 and words[0] in _MADE and words[2:3] != ["go"])
            or (token.text == "at" and at + 1 == len(words) and "where" in words[:3])
        ):
            continue
        else:
            kept.append(token)
    return kept


def _seen_to(tokens: list[Token], words: list[str]) -> list[Token]:
    """Bring it to Ada, *please see to that*: which says no more than the order before it."""
    end = len(words) - (words[-1:] == ["please"])
    begin = end - 3
    if tuple(words[begin:end]) not in _SEEN_TO or begin < 2 or not verbs_at(words, 0):
        return tokens
    begin -= words[begin - 1] == "please"
    if words[begin - 1] not in (COMMA, FULL_STOP, "and") or not _ORDERS.isdisjoint(words[:1]):
        return tokens
    return tokens[: begin - 1]


def _looked_into(tokens: list[Token]) -> list[Token]:
    """Go and *have a look* in the hall: look there."""
    words = [t.text for t in tokens]
    for at in range(len(words) - 4, -1, -1):
        goes = words[at] == "go" and (not at or words[at - 1] in _BEGINS)
        start = at + 1 + (words[at + 1] == "and")
        took = words[start] in ("have", "take") and words[start + 1 : start + 2] == ["a"]
        look = start + 2 + (words[start + 2 : start + 3] in (["quick"], ["good"], ["wee"]))
        seen = words[look : look + 1] in (["look"], ["peek"], ["peep"], ["gander"])
        if goes and took and seen and words[look + 1 : look + 2] in (["in"], ["into"]):
            tokens = [*tokens[:at], Token("look", tokens[look].raw), *tokens[look + 1 :]]
    return tokens


def _points_there(words: list[str], at: int) -> bool:
    asked = words[at - 2 : at] == ["what", "is"]
    return asked and words[at + 1 : at + 2] in (["on"], ["in"], ["under"], ["at"], ["by"], ["over"])


def _remains(words: list[str], at: int) -> bool:
    """Whether "left" is what remains: what have we got *left*? Count what we have *left*."""
    if "if" in words[max(0, at - 7) : at] and "there" in words[max(0, at - 6) : at]:
        return bool(verbs_at(words, at + 1)) or words[at + 1 : at + 2] in ([COMMA], [])
    owned = words[at - 1] == "got" or words[at - 2 : at] in (["we", "have"], ["you", "have"])
    return owned and _AFTER_LEFT.issuperset(words[at + 1 : at + 2])
