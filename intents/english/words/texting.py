"""Words as they are typed on a telephone, spelled out: "giv it 2 ravi", "wat r u doin", "sooo".

Short forms stand in one closed table; what is written by rule is undone by rule: letters drawn out
("pleeease"), "z" for "s" ("keyz"), "-in" for "-ing" ("holdin"), figures for the words they sound
like ("2 me", "4 ravi") and letters likewise ("r u", "can u c it"), apostrophes left out ("olgas
cap"). A word of the vocabulary is never changed, and what was changed is told.
"""

import re
from itertools import product

from intents.english.words import lexicon
from intents.english.words.dictionary import is_english
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.names import NameIndex
from intents.english.words.verbs import FIRST_WORDS

_SHORT_FORMS = {
    short: tuple(meant.split())
    for meant, forms in (
        # verbs
        ("give", "giv gve gib"), ("have", "hav hv hve"), ("take", "tk tke"), ("bring", "brng"),
        ("can", "cn"), ("could", "cud cld culd"), ("would", "wud wld wuld"), ("wait", "w8"),
        ("should", "shud shld"), ("will", "wil wll"), ("need", "ned nid"), ("want", "wnt"),
        ("check", "chk"), ("get", "gt"), ("find", "fnd"), ("fetch", "ftch"), ("forget", "4get"),
        ("come", "kum"), ("love", "luv"), ("do not", "dnt dun"), ("do not know", "dunno"),
        ("have got to", "gotta"), ("give me", "gimmie"), ("let me", "lemmi"),
        # apostrophes left out, where that makes no other word
        ("did not", "didnt"), ("does not", "doesnt"), ("is not", "isnt aint"), ("are not", "arent"),
        ("was not", "wasnt"), ("were not", "werent"), ("have not", "havent"), ("has not", "hasnt"),
        ("could not", "couldnt"), ("would not", "wouldnt"), ("should not", "shouldnt"),
        ("how is", "hows"), ("that is", "dats"), ("it is", "itz"), ("they are", "theyre"),
        ("they have", "theyve"), ("we have", "weve"),
        ("you have", "youve"), ("you will", "youll ull"), ("you would", "youd"),
        ("it will", "itll"), ("that will", "thatll"), ("they will", "theyll"), ("i am", "iam"),
        # little words
        ("what", "wot wat wut wht"), ("what is", "wats wots wuts"), ("where", "whr wher"),
        ("when", "wen"), ("why", "wai"), ("the", "da tha"), ("this", "dis diz"), ("that", "dat"),
        ("these", "deez"), ("them", "dem"), ("they", "dey"), ("there", "dere"),
        ("with", "wid wif wiv wth wi"), ("from", "frm frum"), ("about", "abt"), ("over", "ovr"),
        ("through", "thru"), ("next", "nxt"), ("back", "bak bck"), ("before", "b4"),
        ("because", "bc bcz bcoz becoz becuz cuz coz cos cus"), ("and", "nd"), ("of", "ov"),
        ("your", "yr yur yor"), ("you", "ya ye yous youse yinz thee"), ("yourself", "urself"),
        ("except", "xept xcept exept excpt xcpt"), ("yourself", "yersel yersell thissen thisen"),
        ("myself", "masel mesel missen misen"), ("himself", "hissel hissen"),
        ("take", "tek tak"), ("make", "mek"),
        ("straight", "str8"), ("now", "noo"), ("down", "doon"), ("doing", "daein"),
        ("together", "2gether"),
        # nouns and the like
        ("something", "smth sth sumthin sumthing somethin"), ("somebody", "some1 sum1"),
        ("anybody", "any1"), ("nobody", "no1"), ("everybody", "every1"), ("people", "ppl"),
        ("mate", "m8"), ("little", "lil smol"), ("big", "chonky"), ("good", "gud"),
        ("great", "gr8"), ("night", "nite"),
        ("light", "lite"), ("today", "2day"), ("tonight", "2nite tonite"), ("later", "l8r l8er"),
        ("tomorrow", "2moro 2morrow tmrw tmw"), ("really", "rly rlly"), ("thing", "thang"),
        # set phrases
        ("please", "plz pls plox plse pleez"), ("thanks", "tnx thnx tks thanx ty tysm"),
        ("right now", "rn"), ("at the moment", "atm"), ("yes", "yh yep yup yeh"),
        ("no", "nah nope naw"), ("okay", "kk okie okey"), ("sorry", "soz sry srry"),
        ("never mind", "nvm"), ("i do not care", "idc"), ("i do not know", "idk"),
        ("by the way", "btw"), ("as soon as possible", "asap"),
    )
    for short in forms.split()
}  # fmt: skip
"""None of them is a word that a robot is likely to hear as itself."""
_LEFT_OUT = lexicon.words(
    "lol lmao lmfao rofl omg omfg ngl tbh imo imho smh haha hahaha hehe hihi xd fr ffs jk ikr xoxo"
)
"""What is only put in to be friendly."""
_KISSES = ("x", "xx", "xxx", "xo")
_ASKING = lexicon.words("what where who how why when which there they you these those we and")
_OF_SUBJECTS = lexicon.words("there you u ya they we the these those my your")
_RECEIVERS = lexicon.words("me him her us them em you u everyone everybody")
_COUNTED = lexicon.words("get bring take give have want need fetch grab me us")
_FINITE = lexicon.words("r is are did do does dont cant wont")
_PREPOSITIONS = lexicon.words("on in with from to by of at for off")
_DRAWN_OUT = re.compile(r"(.)\1{2,}")
_MOST_DRAWN_OUT = 3
"""So many letters of one word are tried as single and as double: eight words at most."""


def spelled_out(tokens: list[Token], index: NameIndex) -> tuple[list[Token], list[tuple[str, str]]]:
    """The tokens in plain spelling, and which words were changed into which.

    What is only passed on ("say ...") is still said as it was written: the first word of several
    carries what was written for all.
    """
    words = [t.text for t in tokens]
    plain: list[Token] = []
    changed: list[tuple[str, str]] = []
    for at, token in enumerate(tokens):
        meant = _meant(words, at, index)
        if meant is None or (meant == () and len(words) == 1):
            plain.append(token)
            continue
        if meant and meant[-1] != "'s":
            changed.append((token.raw, " ".join(meant)))
        raws = (token.raw, *[""] * len(meant))
        plain += [Token(word, raw) for word, raw in zip(meant, raws, strict=False)]
    return plain, changed


def _meant(words: list[str], at: int, index: NameIndex) -> tuple[str, ...] | None:
    """The words that a word stands for; None if for itself."""
    word = words[at]
    if not word[0].isalnum() or (word in index.words and word.isalpha()):
        return None
    if word in _LEFT_OUT or (
        word in _KISSES and at == len(words) - 1 and not _is_figure(words, at)
    ):
        return ()
    if word == "ur":
        after = words[at + 1] if at + 1 < len(words) else FULL_STOP
        doing = after in ("going", "gonna", "not") or after.endswith("ing")
        return ("you", "are") if doing else ("your",)
    by_sound = _by_sound(words, at, index)
    if by_sound or word in _SHORT_FORMS:
        instead = at + 1 + (words[at + 1 : at + 2] in (["the"], ["a"], ["my"]))
        if word == "nvm" and instead < len(words) and index.match(words, instead):
            return ("no", "wait")  # get me the tea nvm the juice
        return (by_sound,) if by_sound else _SHORT_FORMS[word]
    return _undone(word, words[at + 1 : at + 2], index)


def _is_figure(words: list[str], at: int) -> bool:
    return at > 0 and words[at - 1][0].isdecimal()


def _by_sound(words: list[str], at: int, index: NameIndex) -> str:
    """A letter or a figure that is read as the word it sounds like, where that word can stand."""
    word, last = words[at], words[at - 1] if at else FULL_STOP
    after = words[at + 1] if at + 1 < len(words) else FULL_STOP
    if word in ("2", "4"):
        named = index.match(words, at + 1) if at + 1 < len(words) else None
        somebody = named is not None and bool(named.of("person"))
        whole = after in _RECEIVERS or after in lexicon.DETERMINERS or somebody or after == "da"
        there = word == "2" and named is not None and bool(named.of("place", "room"))
        once = there and not (named and words[named.end - 1].endswith("s"))
        handed = once and last not in _COUNTED and not last.startswith(("patrol", "visit"))
        to_do = word == "2" and after in FIRST_WORDS and last in ("want", "need", "wanna", "have")
        meant = "to" if word == "2" else "for"
        return meant if at and (whole or handed or to_do) else ""
    letters = {
        "r": "are" if last in _ASKING or after in _OF_SUBJECTS else "",
        "c": "see" if last in ("can", "to", "i", "cn", "u", "you", "we") else "",
        "b": "be" if last in ("will", "wil", "to", "can", "cn", "would", "wud", "ill") else "",
        "y": "why" if after in _FINITE else "",
        "k": "okay" if at == 0 or after in (COMMA, FULL_STOP) else "",
        "w": "with" if after in lexicon.DETERMINERS | _RECEIVERS else "",
        "v": "very" if last in ("is", "am", "are", "im", "its", "so") else "",
        "o": "of" if last in ("cup", "couple", "bit", "kind", "pair", "bottle", "glass") else "",
        "rite": "right" if after in ("now", "here", "there", "away") else "",
        "sum": "some" if last in _COUNTED else "",
        "ma": "my" if index.match(words, at + 1) else "",
        "hw": "how" if after in ("r", "u", "are", "is", "many", "much") else "",
    }
    your = word in ("ya", "ye", "yer") and last in _PREPOSITIONS and after.isalpha()
    return "your" if your and after not in lexicon.FUNCTION_WORDS else letters.get(word, "")


def _undone(word: str, after: list[str], index: NameIndex) -> tuple[str, ...] | None:
    """A word without what was done to its spelling, if that makes it one that is known."""
    if not word.isalpha():
        return None
    single = _not_drawn_out(word, index)
    if single:
        return _SHORT_FORMS.get(single, (single,))
    owner = index.match([word[:-1]], 0) if word.endswith("s") and len(word) > 2 else None
    if owner and owner.of("person") and after and after[0] not in (COMMA, FULL_STOP):
        return word[:-1], "'s"
    if is_english(word):
        return None
    plural = word[:-1] + "s"
    if word.endswith("z") and len(word) > 3 and _is_word(plural, index):
        return (plural,)
    if word.endswith("in") and len(word) > 3 and is_english(word + "g"):
        return (word + "g",)
    return None


def _not_drawn_out(word: str, index: NameIndex) -> str:
    """A word whose letters are drawn out, with one or two of each.

    Of words that are only English the one with two is meant: "mooon" is the moon, no mon.
    """
    runs = len(_DRAWN_OUT.findall(word))
    if not runs or runs > _MOST_DRAWN_OUT:
        return ""
    every: list[str] = []
    for lengths in product((1, 2), repeat=runs):
        left = iter(lengths)
        every.append(_DRAWN_OUT.sub(lambda run, left=left: run.group(1) * next(left), word))
    known = (index.words, _SHORT_FORMS, FIRST_WORDS, lexicon.FUNCTION_WORDS)
    said = (one for one in every if any(one in words for words in known))
    return next(said, "") or next(filter(is_english, reversed(every)), "")


def _is_word(word: str, index: NameIndex) -> bool:
    return word in index.words or is_english(word)
