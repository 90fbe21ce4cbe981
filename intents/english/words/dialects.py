"""What dialects and learners put where others put another little word.

"Dump *me* socks in the basket" (my), "put *them* scissors there" (those), "next *of* the printer"
(to), "*what you are* holding" (what are you). Each is turned into the word that the grammar knows,
where the words around it leave no other sense.

[Aikhenvald2006] A. Aikhenvald, Serial verb constructions in typological perspective, OUP, 2006.
"""

from intents.english.words import lexicon
from intents.english.words.lexer import FULL_STOP, Token
from intents.english.words.names import NameIndex
from intents.english.words.verbs import FIRST_WORDS

_GIVES_ME = lexicon.words(
    "give bring get fetch hand pass find show tell buy lend send offer serve make pour grab teach "
    "read leave let help with for to us"
)
_GIVES_THEM = lexicon.words(
    "give bring hand pass show tell buy lend send offer serve make pour teach read let help with "
    "for to of"
)
"""After these "me" and "them" may be who gets something: "bring them towels"."""
_DESCRIBING = frozenset(lexicon.SIZES) | frozenset(lexicon.COLORS) | lexicon.EMPTY_ADJECTIVES
_PREPOSITIONS: dict[lexicon.Phrase, lexicon.Phrase] = {
    ("next", "of"): ("next", "to"), ("next", "from"): ("next", "to"), ("near", "of"): ("near",),
    ("near", "from"): ("near",), ("close", "of"): ("close", "to"),
    ("close", "from"): ("close", "to"),
    ("beside", "of"): ("beside",), ("besides", "of"): ("beside",), ("beside", "to"): ("beside",),
    ("besides", "to"): ("beside",), ("behind", "of"): ("behind",), ("behind", "from"): ("behind",),
    ("under", "of"): ("under",), ("in", "front", "from"): ("in", "front", "of"),
    ("in", "front", "to"): ("in", "front", "of"), ("between", "of"): ("between",),
    ("above", "of"): ("above",), ("inside", "to"): ("inside",), ("on", "top", "from"): ("on",),
    ("in", "which", "place"): ("where",), ("at", "which", "place"): ("where",),
    ("in", "what", "place"): ("where",), ("on", "which", "place"): ("where",),
    ("say", "me"): ("tell", "me"), ("explain", "me"): ("tell", "me"),
    ("about", "turn"): ("turn", "around"),
    ("come", "on", "over"): ("come", "over"), ("come", "on", "in"): ("come", "in"),
    ("come", "on", "back"): ("come", "back"), ("come", "on", "here"): ("come", "here"),
    ("count", "and", "tell"): ("count",), ("count", "and", "tell", "me"): ("count",),
    ("all", "the", "way", "on", "the", "left"): ("on", "the", "far", "left"),
    ("all", "the", "way", "on", "the", "right"): ("on", "the", "far", "right"),
    ("roond",): ("round",), ("ower",): ("over",), ("howay", "ower"): ("come", "over"),
    ("haway", "ower"): ("come", "over"), ("howay", "here"): ("come", "here"),
    ("yem",): ("home",), ("gan",): ("go",), ("giz",): ("give", "us"), ("gis",): ("give", "us"),
    ("wey", "dey", "on"): ("that", "is", "on"),
    ("wey", "dey", "in"): ("that", "is", "in"), ("wey", "dey"): ("that", "is", "in"),
    ("that", "there"): ("that",), ("this", "here"): ("this",),
    ("i", "wonder", "if", "you", "could"): ("could", "you"),
    ("i", "wonder", "if", "you", "can"): ("can", "you"),
    ("i", "wonder", "if", "you", "would"): ("would", "you"),
    ("i", "wonder", "whether", "you", "could"): ("could", "you"),
    ("i", "wonder", "whether", "you", "can"): ("can", "you"),
    ("i", "wonder", "whether", "you", "would"): ("would", "you"),
    ("inquire", "of"): ("ask",), ("enquire", "of"): ("ask",), ("find", "out", "from"): ("ask",),
    ("check", "with"): ("ask",), ("unto",): ("to",), ("thou",): ("you",), ("thee",): ("you",),
    ("thy",): ("your",),
    ("in", "the", "left", "side", "of"): ("to", "the", "left", "of"),
    ("in", "the", "right", "side", "of"): ("to", "the", "right", "of"),
    ("nearest", "the"): ("next", "to", "the"), ("nearest", "to", "the"): ("next", "to", "the"),
    ("closest", "to", "the"): ("next", "to", "the"),
    ("say", "her"): ("tell", "her"), ("say", "him"): ("tell", "him"),
    ("say", "them"): ("tell", "them"), ("say", "us"): ("tell", "us"),
    ("therefore",): ("so",), ("hence",): ("so",), ("thus",): ("so",), ("consequently",): ("so",),
    ("thereafter",): ("then",), ("thereupon",): ("then",), ("whereupon",): ("then",),
    ("subsequently",): ("then",),
    ("but", "no", "the"): ("but", "not", "the"), ("but", "nae", "the"): ("but", "not", "the"),
    ("shalt",): ("shall",), ("wilt",): ("will",), ("canst",): ("can",), ("dost",): ("do",),
    ("who", "all"): ("who",),
    ("remain", "on", "one"): ("stand", "on", "one"),
    ("stay", "on", "one"): ("stand", "on", "one"), ("keep", "on", "one"): ("stand", "on", "one"),
}  # fmt: skip
_LONGEST = 6
_IS = lexicon.words("is are was were will has have had may might must can could would should")
_UNLESS_BEFORE: dict[tuple[str, ...], frozenset[str]] = {("that", "there"): _IS}
"""Say *that there is* a fire is no dialect."""
_OWNERS = {"me": ("my", _GIVES_ME), "them": ("those", _GIVES_THEM)}
_THIRD = {"want": "wants", "need": "needs", "require": "requires", "ask": "asks"}
_ASKED_WITH = lexicon.words("do does did can could will would let make if and or to help")
"""Behind one of these a verb has no ending."""
_HANDING = lexicon.words("bring give take fetch get hand carry")
_CARRYING = lexicon.words("carry bring take send move follow lead guide")
_BEFORE_GO = lexicon.words("to let and then please will can must you i we")
_LINKS = lexicon.words(", . and then")
_ASK = lexicon.words("what where why how")
_BEFORE_SUBJECTS = lexicon.words("are were have can could will do did should must")
"""What stands before its subject in a question."""
_SEEING = lexicon.words("see have find hold carry")


def in_standard_words(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with the words of the grammar in place of those of a dialect."""
    tokens = _those(_linked(_prepositions(_handled(tokens))), index)
    tokens = _agreeing(_carried(tokens, index), index)
    words = [t.text for t in tokens]
    for at, token in enumerate(tokens):
        owner, gives = _OWNERS.get(token.text, ("", _GIVES_ME))
        last = words[at - 1] if at else FULL_STOP
        owned = owner and (last not in gives or last in ("us", "me"))
        if owned and _is_thing(words, at + 1, index):
            tokens[at] = Token(owner, token.raw)
    return _asked_the_other_way_round(tokens)


def _handled(tokens: list[Token]) -> list[Token]:
    """Bring *am*, put *am* there: it, in the Pidgin of Nigeria."""
    before = [Token("i", ""), *tokens]
    return [
        Token("it", token.raw)
        if token.text == "am"
        and last.text in FIRST_WORDS
        and last.text not in ("i", "who", "what")
        and after.text != "i"
        else token
        for last, token, after in zip(before, tokens, [*tokens[1:], Token("", "")], strict=False)
    ]


def _those(tokens: list[Token], index: NameIndex) -> list[Token]:
    """*Them there* cups: those; but take *them there*, to that place."""
    words = [t.text for t in tokens]
    for at in range(len(words) - 2, 0, -1):
        if words[at - 1 : at + 1] == ["them", "there"] and _is_thing(words, at + 1, index):
            tokens[at - 1 : at + 1] = [Token("those", tokens[at - 1].raw)]
    return tokens


def _linked(tokens: list[Token]) -> list[Token]:
    """Take it *an* put it there: and."""
    return [
        Token("and", token.raw)
        if token.text == "an" and after.text[:1] not in "aeiou8" and after.text in FIRST_WORDS
        else token
        for token, after in zip(tokens, [*tokens[1:], Token("a", "")], strict=False)
    ]


def _carried(tokens: list[Token], index: NameIndex) -> list[Token]:
    """Carry the towels *go* room twelve: to, where one verb follows the other [Aikhenvald2006]."""
    words = [t.text for t in tokens]
    for at in range(2, len(words) - 1):
        match = index.match(words, at + 1) if words[at] == "go" else None
        spot = match is not None and match.of("place", "room")
        begin = max((n + 1 for n in range(at) if words[n] in _LINKS), default=0)
        carries = begin < at and words[begin] in _CARRYING and words[at - 1] not in _BEFORE_GO
        if spot and carries:
            tokens[at] = Token("to", tokens[at].raw)
    return tokens


def _agreeing(tokens: list[Token], index: NameIndex) -> list[Token]:
    """She *want* it: wants; bring *for her* wheelchair: bring her the wheelchair."""
    words = [t.text for t in tokens]
    for at in range(len(words) - 1, 0, -1):
        somebody = words[at - 1] in ("she", "he", "it") or _ends_person(words, at, index)
        asked = somebody and any(word in _ASKED_WITH for word in words[:at])
        if words[at] in _THIRD and somebody and not asked:
            tokens[at] = Token(_THIRD[words[at]], tokens[at].raw)
        handing = at > 1 and words[at - 2] in _HANDING and words[at - 1] in ("for", "to")
        match = index.match(words, at + 1) if handing and words[at] == "her" else None
        if match and match.of("object") and match.end not in range(len(words)):
            tokens[at - 1 : at + 1] = [Token("her", tokens[at].raw), Token("the", "")]
    return tokens


def _ends_person(words: list[str], at: int, index: NameIndex) -> bool:
    """Whether somebody's name ends before a word."""
    matches = (index.match(words, n) for n in range(max(0, at - 2), at))
    return any(match and match.end == at and match.of("person") for match in matches)


def _is_thing(words: list[str], at: int, index: NameIndex) -> bool:
    """Whether a thing or a place is named at a word, or after one that describes it."""
    at += at < len(words) and (words[at] in _DESCRIBING or words[at] in index.colors)
    match = index.match(words, at) if at < len(words) else None
    if match is None:
        return at < len(words) and bool(index.partial(words[at]))
    return not match.of("person")


def _prepositions(tokens: list[Token]) -> list[Token]:
    """Next *of* the printer: next to it."""
    kept: list[Token] = []
    at = 0
    while at < len(tokens):
        for size in range(_LONGEST, 0, -1):
            said = tuple(t.text for t in tokens[at : at + size])
            meant = _PREPOSITIONS.get(said)
            after = tokens[at + size].text if at + size < len(tokens) else ""
            if meant and after not in _UNLESS_BEFORE.get(said, ()):
                raws = [t.raw for t in tokens[at : at + size]]
                kept += [Token(word, raw) for word, raw in zip(meant, raws, strict=False)]
                at += size
                break
        else:
            kept.append(tokens[at])
            at += 1
    return kept


def _asked_the_other_way_round(tokens: list[Token]) -> list[Token]:
    """*What you are* holding? *Where I can* find it? Only where a sentence begins."""
    words = [t.text for t in tokens]
    for at in range(len(words) - 2):
        begins = at == 0 or words[at - 1] == FULL_STOP
        if not begins or words[at] not in _ASK or words[at + 1] not in ("you", "i", "we", "they"):
            continue
        if words[at + 2] in _BEFORE_SUBJECTS and (at + 3 < len(words) or words[at] == "where"):
            tokens[at + 1], tokens[at + 2] = tokens[at + 2], tokens[at + 1]
        elif words[at + 2] in _SEEING:
            tokens.insert(at + 1, Token("do", ""))
        break
    return tokens
