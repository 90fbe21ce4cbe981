"""Text to tokens: lower case, contractions undone, punctuation reduced to three signs."""

import re
from typing import NamedTuple

from intents.letters import seen, unmixed

COMMA = ","
FULL_STOP = "."
DASHES = ("—", "–", "--", "-")
"""How a dash is written, which is a comma besides."""
QUOTE = '"'
"""The text of a quoted token; what was quoted is in ``raw``."""


class Token(NamedTuple):
    """A word, a number, a quotation or a sign.

    Attributes:
        text: Lower case; punctuation is ``COMMA`` or ``FULL_STOP``, a quotation ``QUOTE``.
        raw: As it was written; empty if the token before holds it.
    """

    text: str
    raw: str


_APART = re.compile(r"(?<=\w) +(?=(?:'s|n't|'re|'ll|'ve|'d|'m)\b)", re.IGNORECASE)
"""Before an ending that was written apart: "the cup 's", "do n't"."""
_COMMA_S = re.compile(r"\b(what|where|who|it|that|there|he|she),s\b", re.IGNORECASE)
_UNITS = r"(?:m|cm|mm|km|s|sec|secs|min|mins|h|ms|deg|degs|rad|ft|x)\b"
_TOKEN = re.compile(
    rf"""  "(?P<quote>[^"]+)"
    | (?<!\w)'(?P<single>[^']*\ [^']*)'(?!\w)
    | (?P<number>(?<![\w-])-?\d+(?:[.,]\d+)?)(?=\s|[^\w]|{_UNITS}|$)
    | (?P<word>[^\W_]+(?:'[^\W_]+)*)
    | (?P<degree>°)
    | (?P<stop>[.!?]+)
    | (?P<comma>[,;:()—]|--+|\s[-–](?=\s))""",
    re.VERBOSE,
)
_QUOTES = str.maketrans({"’": "'", "‘": "'", "`": "'", "´": "'", "“": '"', "”": '"', "„": '"',
                         "«": '"', "»": '"', "\t": " ", "\n": " ", "\r": " "})  # fmt: skip
_AT_HE = re.compile(r"\b(at|in|on|to|from|by|of|for) he\b(?!\s+(?:is|was|has))", re.IGNORECASE)
"""A slip of the fingers: "at he fridge"."""
_SLIPS = tuple(
    (re.compile(slip, re.IGNORECASE), meant)
    for slip, meant in (
        (r"\btoo(?=\s+(?:the|my|your|a|an|her|his)\b)", "to"),
        (r"\b(i|we) should like\b", r"\1 would like"),
        (r"\s\+\s", " and "),
        (r"\bits(?= (?:a|an|so|too|very|really|getting|going|been|not|just|all)\b)", "it's"),
        (r"((?:^|[.!?,;])\s*)nae (?=\w+ (?:for|in|on)\b)", r"\1no "),
        (r"\bo(?= (?:the|that|them|those|ma|my|your|yon)\b)", "of"),
        (
            r"\b(?:i|we) (?:(?:must|have to|would|will|do|shall|really) )?(?:ask|beg|implore|"
            r"request|entreat|urge) (?:of )?you,? (?:(?:please|kindly),? )?not to\b",
            "do not",
        ),
        (r",?\s+or (?:not|what|no)(?=\s*[?.!]*$)", ""),
        (r"((?:^|[,.;]|\bthen|\band)\s*)(left|right) turn\b", r"\1turn \2"),
        (
            r"((?:^|[,.;]|\bthen|\band|\bplease)\s*(?:turn|close|open|shut|put|take|switch|go|come|"
            r"walk|carry|place|lay|lift)) you(?= (?:it|me|the|a|an|my|to|left|right|off|on|\d|"
            r"ninety|one|two|here|there)\b)",
            r"\1",
        ),
        (r"\b(counter|anti)[\s-]+(?=clockwise\b)", r"\1"),
        (r"\b(would|could|will|won't|can|can't)\s?(?:ja|jya|ya|cha)\b", r"\1 you"),
        (r"\bform(?=\s+(?:the|my|your|her|his)\b)", "from"),
        (r"\boot(?=\s+(?:the|ma|my|your|that|yon)\b)", "out of"),
        (
            r"\b(bring|grabb|fetch|gett|putt|tak|giv|clos|pass|help|look|check|pick|open|turn)in\b'?"
            r"(?!g)",
            r"\1ing",
        ),
        (
            r"\b(sitt|stand|hold|hav|need|want|stay|leav|mov|shift|hoy|wear|point|carry)in\b'?(?!g)",
            r"\1ing",
        ),
        (r"\byour self\b", "yourself"),
        (r"&", " and "),
        (r"\s*(?:-+>|=+>|→|⇒|(?<=\s)>+(?=\s))\s*", " to "),
    )
)
"""More of them: "go too the table", "take it form the table"."""
_IS = {"what", "where", "who", "how", "which", "there", "here", "that", "it", "he", "she", "this",
       "when", "why"}  # fmt: skip  # "what's" holds a verb, "Julia's" does not
_WHOLE = {
    "let's": ("let", "us"), "lets": ("let", "us"),
    "goto": ("go", "to"), "won't": ("will", "not"), "can't": ("can", "not"),
    "cannot": ("can", "not"), "i'm": ("i", "am"), "whats": ("what", "is"),
    "wheres": ("where", "is"), "whos": ("who", "is"), "theres": ("there", "is"),
    "em": ("them",), "needn't": ("need", "not"), "whilst": ("while",),
    "yer": ("your",), "dont": ("do", "not"), "gimme": ("give", "me"),
    "lemme": ("let", "me"), "wanna": ("want", "to"), "gonna": ("going", "to"),
    "gotta": ("have", "to"), "u": ("you",), "pls": ("please",), "plz": ("please",),
    "isn't": ("is", "not"), "ain't": ("is", "not"),
    "ok": ("okay",), "til": ("until",), "teh": ("the",),
    "pik": ("pick",), "pickup": ("pick", "up"), "putdown": ("put", "down"), "putit": ("put", "it"),
    "lookat": ("look", "at"), "giveme": ("give", "me"),
    "hte": ("the",), "adn": ("and",), "nad": ("and",),
    "thats": ("that", "is"), "till": ("until",), "hes": ("he", "is"), "shes": ("she", "is"),
    "tellme": ("tell", "me"), "bringme": ("bring", "me"), "givme": ("give", "me"),
    "youre": ("you", "are"), "whens": ("when", "is"), "tho": ("to",), "fo": ("of",),
    "uturn": ("u-turn",), "plase": ("please",), "te": ("the",), "n": ("and",),
    "gonnae": ("will", "you"), "gonny": ("will", "you"), "gie": ("give",),
    "c'mon": ("come", "on"), "cmon": ("come", "on"), "cept": ("except",), "'cept": ("except",),
    "awa": ("away",), "whit": ("what",), "whaur": ("where",), "yon": ("that",),
    "frae": ("from",), "intae": ("into",), "ontae": ("onto",), "wi": ("with",),
    "owt": ("anything",),    "nowt": ("nothing",), "summat": ("something",), "yall": ("you",),
    "gies": ("give", "us"), "oot": ("out",), "doon": ("down",), "aff": ("off",), "tae": ("to",),
    "dinnae": ("do", "not"), "dinna": ("do", "not"), "cannae": ("can", "not"),
    "y'all": ("you",), "oughta": ("ought", "to"), "outta": ("out", "of"),
    "outa": ("out", "of"), "tryna": ("trying", "to"),
    "im": ("i", "am"), "ive": ("i", "have"), "dnt": ("do", "not"), "cant": ("can", "not"),
    "yuo": ("you",), "thier": ("their",), "pleas": ("please",), "pleese": ("please",),
}  # fmt: skip
_ENDINGS = (("n't", "not"), ("'re", "are"), ("'ll", "will"), ("'ve", "have"), ("'d", "would"),
            ("'m", "am"))  # fmt: skip


_SAID = re.compile(r"[\w']+")


def words_in(text: str) -> list[str]:
    """The words of a text as they were said, in lower case, without signs."""
    return _SAID.findall(text.lower().replace("’", "'"))


def tokenize(text: str) -> list[Token]:
    """Tokens of a text; every string is accepted, signs that mean nothing are dropped."""
    text = unmixed(seen(text)).translate(_QUOTES)
    text = _AT_HE.sub(r"\1 the", _COMMA_S.sub(r"\1's", _APART.sub("", text)))
    for slip, meant in _SLIPS:
        text = slip.sub(meant, text)
    tokens: list[Token] = []
    for match in _TOKEN.finditer(text):
        kind, raw = match.lastgroup, match.group()
        if kind in ("quote", "single"):
            tokens.append(Token(QUOTE, raw[1:-1].strip()))
        elif kind == "number":
            tokens.append(Token(raw.replace(",", "."), raw))
        elif kind == "degree":
            tokens.append(Token("degrees", raw))
        elif kind == "stop":
            tokens.append(Token(FULL_STOP, raw))
        elif kind == "comma":
            tokens.append(Token(COMMA, raw.strip()))
        else:
            tokens.extend(_words(raw))
    return tokens


def _words(raw: str) -> list[Token]:
    """One written word as tokens: contractions come apart, possessives become "'s"."""
    word = raw.lower()
    if word in _WHOLE:
        first, *rest = _WHOLE[word]
        return [Token(first, raw), *(Token(w, "") for w in rest)]
    for ending, meaning in _ENDINGS:
        if word.endswith(ending) and len(word) > len(ending):
            return [
                Token(word[: -len(ending)], raw[: -len(ending)]),
                Token(meaning, raw[-len(ending) :]),
            ]
    if word.endswith("'s") and len(word) > 2:
        stem = Token(word[:-2], raw[:-2])
        return [stem, Token("is" if stem.text in _IS else "'s", raw[-2:])]
    return [Token(word.replace("'", ""), raw)]


_IRREGULAR = {
    "knives": "knife", "shelves": "shelf", "loaves": "loaf", "leaves": "leaf", "halves": "half",
    "people": "person", "persons": "person", "men": "man", "women": "woman", "mice": "mouse",
    "children": "child", "feet": "foot", "cookies": "cookie", "teeth": "tooth", "lens": "lens",
    "thermoses": "thermos", "buses": "bus", "lenses": "lens", "cactuses": "cactus",
    "veggies": "veggie", "ladies": "lady", "movies": "movie", "brownies": "brownie",
    "smoothies": "smoothie", "scarves": "scarf",
    "cacti": "cactus", "geese": "goose", "dice": "die", "calves": "calf", "wives": "wife",
    "wolves": "wolf", "hooves": "hoof", "grey": "gray", "pies": "pie", "ties": "tie",
}  # fmt: skip


def singular(word: str) -> str:
    """The singular of a noun; a singular noun is left alone."""
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    if len(word) <= 3 or not word.endswith("s") or word.endswith(("ss", "us", "is")):
        return word
    if word.endswith("ies"):
        return word[:-3] + "y"
    if word.endswith(("ches", "shes", "xes", "sses", "zes", "toes")):
        return word[:-2]
    return word[:-1]
