"""Courtesies: what is said to be polite, to be quick or to be rude, and asks for nothing.

"If it is not too much trouble", "when you've got a sec", "would you, love?", "thanks a million",
"be a good lad and ...", "I was wondering whether you might ...". They are told by the words they
are made of rather than one by one: a clause that begins with "if" and has no word but such as these
is a courtesy, whatever their order.
"""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.measures import NUMBER_WORDS
from intents.english.words.verbs import FIRST_WORDS, base_form

_SIGNS = (COMMA, FULL_STOP)
_IF = lexicon.words("if when whenever once unless as soon as provided assuming")
_GRACIOUS = lexicon.words(
    "if when whenever once as soon provided assuming it is are was were not no too much a an of "
    "any trouble bother problem hassle imposition you ya i we that this do does did mind could "
    "would can may might will be so very kind good possible have has had get got find the time "
    "moment moments minute minutes second seconds sec secs mo tick chance free spare busy okay ok "
    "all right alright fine convenient like want wish please to ask at some point able willing "
    "enough happen really feel up ready please god allows only 's nothing else on for with or me "
    "burden inconvenient inconvenience troubling troublesome bold say know myself ourselves fates "
    "fate permit permits permitted allow allowed fickle by miracle some ever such one"
)
"""What a courtesy that begins with "if" or "when" is made of."""
_GRACE = lexicon.words(
    "trouble bother problem hassle mind kind possible time moment minute second sec secs mo tick "
    "chance spare busy okay ok right alright fine convenient like want wish please could would can "
    "may able willing ready free happen ask burden inconvenient inconvenience troubling "
    "troublesome bold say know permit permits permitted allow allowed allows"
)
"""One of these is in it."""
_GRACED = lexicon.words("you it possible fates fate god")
"""Whose grace it is."""
_TAGS = lexicon.words("would will could can do does did is are should shall may won ca")
_TAGGED = lexicon.words("you ya yah it we they he she i")
_THANKS = lexicon.words("thanks thank ta cheers thx ty thankyou")
_MUCH = lexicon.words(
    "a million lot lots bunch ton tons heaps you ya so very much in advance ever again kindly for "
    "that your help everything awfully mate love"
)
ADDRESSES = lexicon.words(
    "love luv dear dearie darling sweetheart sweetie honey hun hon pet duck mate matey pal buddy "
    "bud bro dude man guv boss chief friend robot bot droid machine sir madam maam mister champ "
    "duck ducky duckie petal hinny treacle sunshine babe doll chap fella lad lass "
    "mister buster genius tinman oi yo hey ahem hen son sonny laddie lassie flower chuck"
)
"""What the robot may be called."""
_FAMILIAR = lexicon.words(
    "love luv dear darling sweetheart honey hun mate pal buddy bro dude robot bot sir champ"
)
"""What needs no comma before it at the end."""
_ADDRESSED = lexicon.words("my me good old little big wee dear you the clever young kind")
_POLITELY_CALLED = lexicon.words("man lady fellow woman gentleman person people folks sir")
"""What the robot may be called behind "young", "good" or "dear"."""
_CALLED = ADDRESSES | _ADDRESSED | _POLITELY_CALLED
_CURSES = lexicon.words(
    "bloody fucking fuckin damn damned goddamn freaking frigging effing flipping blasted ruddy "
    "goddamned sodding"
)
_EXPLETIVES = lexicon.phrases(
    "the hell,the heck,the fuck,the devil,the dickens,the blazes,the deuce,tf,on earth,"
    "in the world,in heaven 's name,in god 's name"
)
"""What behind a question word only says how keen one is to know."""
_TAILS = lexicon.phrases(
    "already,pronto,chop chop,sharpish,on the double,stat,quick smart,this instant,this minute,"
    "right this minute,quick as you can,as quick as you can,as fast as you can,"
    "as quickly as you can,as soon as you can,and make it snappy,and make it quick,and hurry,"
    "and hurry up,and nothing else,and nothing more,and be quick,and be quick about it,"
    "go go go,go go,quick quick,now now,hop hop,vite vite,allez allez,"
    "this time,once and for all,"
    "arrange,oblige,do the needful,do needful,and oblige,do oblige,get a move on,look lively,"
    "look sharp,hop to it,jump to it,shake a leg,snap to it,move it,"
    "get cracking,come on,make haste,spit spot,vamos,andale,and step on it,and quick,and quickly,"
    "there is a good chap,there is a good lad,there is a good girl,there is a good boy,"
    "there is a dear,there is a love,innit,eh,yeah,yes,okay,ok,alright,all right,right,no,hey,huh,"
    "you hear,do you hear,got it,understood,if you please,and thanks,and thank you,and that is it,"
    "and that is all,that is all,that is it,would be great,would be lovely,"
    "would be nice,will do,asap,too please,apparently,obviously,seriously,and not just anywhere,"
    "not just anywhere,"
    "and nowhere else,and not anywhere else,or somebody,or whatever,or something,or so,"
    "and no dawdling,and do not dawdle,or else,for once,"
    "whatever,either way,for crying out loud,for goodness sake,for heaven 's sake,"
    "for god 's sake,lah,na,yaar,"
    "only please,de,ne,there 's a good chap,good man yourself,good woman yourself,"
    "good lad yourself,good girl yourself,good on you,good on ya,fair play to you,fair play to ya,"
    "i need room,i need some room,i need more room,i need the room,i need a bit of room,"
    "i need space,i need some space,i need more space,i need the space,i need a bit of space,"
    "we need room,we need some room,we need space,we need some space,we need the space"
)
"""What may be said behind a request and adds nothing to it."""
_LEAVES = lexicon.words("leave let left be is are was am live stand")
"""*Leave it* alone."""
_SAYING = lexicon.words("say tell announce shout whisper repeat answer ask sing")
_SMALL = lexicon.phrases(
    "exactly,at least,at most,up to,no more than,not more than,about,roughly,around,approximately,"
    "for about,precisely"
)
_HEDGES = lexicon.words(
    "kill hurt i was am were just wondering wonder wondered whether if you might may could would "
    "can possibly perhaps maybe be able to kindly so good kind as enough mind terribly awfully "
    "very please do think there is any chance that of me trouble bother ask it us we bothering "
    "inconvenience appreciate greatly really grateful for will not possible happen sorry hope "
    "hoping ya do should be obliged indebted thankful delighted pleased glad happy honoured "
    "honored most ever esteem consider count a favour favor request suggest propose kindest "
    "gracious nice much so immensely eternally exceedingly deeply shall kindness goodness "
    "courtesy have had the please suppose supposing persuaded persuade convinced tempted prevail "
    "upon see your way clear find heart in yourself manage what are chances odds getting honour "
    "feel inclined disposed minded care consider considering dream"
)
_HEDGED = lexicon.words(
    "kill hurt wondering wonder wondered inconvenience trouble bother chance mind possibly "
    "terribly awfully appreciate grateful perhaps happen hoping hope possible might maybe obliged "
    "indebted thankful delighted pleased honoured honored kindness goodness courtesy esteem "
    "favour favor request suggest propose persuaded persuade convinced tempted prevail way heart "
    "chances odds honour inclined disposed minded consider considering"
)
_DUTIES = lexicon.words(
    "favour favor solid needful kindness turn service small big huge quick good"
)
_RATHER = lexicon.words("rather do really quite should would")
_BELIEVES = lexicon.words(
    "think believe suppose reckon imagine expect fancy guess understand gather"
)
_STATES = lexicon.words("is are was were should must lies stands")
_KINDNESSES = lexicon.words("kindness goodness courtesy decency grace")
_LONGEST = 20


def courtesy_end(words: list[str], at: int, *, kept: list[str]) -> int | None:
    """Where a courtesy ends that begins at a word; ``kept`` are the words kept before it."""
    if not _SAYING.isdisjoint(kept):
        return None  # say thank you: that is what is to be said
    begins = not kept or kept[-1] in (*_SIGNS, "and", "so", "well", "then")
    return (
        _gracious(words, at)
        or _with_cherries(words, at)
        or _excuse(words, at)
        or (_hedge(words, at) if begins else None)
        or (_prelude(words, at) if begins else None)
        or _tag(words, at, kept)
        or _thanks(words, at)
        or _address(words, at, kept)
        or _insistence(words, at)
        or _belief(words, at)
        or _small_word(words, at)
    )


def _word(words: list[str], at: int) -> str:
    return words[at] if 0 <= at < len(words) else FULL_STOP


def _is_verb(words: list[str], at: int) -> bool:
    word = _word(words, at)
    return base_form(word) in FIRST_WORDS and word not in ("i", "can", "could", "may", "we")


def _gracious(words: list[str], at: int) -> int | None:
    """If it is not too much trouble; when you have got a sec; *and only* if you are free."""
    if words[at : at + 1] == ["and"] or words[at] == "only":
        begun = at + (words[at] == "and")
        begun += _word(words, begun) in ("only", "even")
        linked = begun > at and _word(words, begun) in _IF and _word(words, begun - 1) != "and"
        return _gracious(words, begun) if linked else None
    if words[at] not in _IF:
        return None
    if words[at + 1 : at + 3] == ["you", "are"] and _word(words, at + 3) in ("done", "finished"):
        busy = at + 4
        while _word(words, busy) not in _SIGNS and _word(words, at + 4).endswith("ing"):
            busy += 1
        return busy if busy > at + 4 else None  # when you are done faffing about
    end = at + 1
    while (
        end < len(words) and words[end] in _GRACIOUS and not (end > at + 1 and _wishes(words, end))
    ):
        end += 1
    said = words[at:end]
    if any(said[n : n + 2] in (["find", "it"], ["get", "it"]) for n in range(len(said))):
        return None  # or the tea, if you cannot find it
    mine = said[1:3] in (["i", "may"], ["i", "might"], ["i", "am"])
    asks = _GRACE.intersection(said) and (mine or not _GRACED.isdisjoint(said))
    closed = (
        _word(words, end) in _SIGNS
        or _wishes(words, end)
        or (
            _is_verb(words, end)
            and words[end] not in ("see", "find", "spot", "locate", "hold", "need")
        )
    )
    return end if asks and closed and end > at + 1 else None


def _wishes(words: list[str], at: int) -> bool:
    """If it is no trouble, *I would like it* done: a wish, and no courtesy."""
    return words[at : at + 3] in (["i", "would", "like"], ["i", "would", "love"])


def _hedge(words: list[str], at: int) -> int | None:
    """I was wondering whether you might possibly ...; might I trouble you to ..."""
    end = at
    while end < min(len(words), at + _LONGEST) and words[end] in _HEDGES:
        end += 1
    said = words[at:end]
    wished = said[-2:] == ["if", "you"] and "would" in said
    wished = wished or said[-2:] in (["as", "to"], ["enough", "to"])
    addressed = "you" in said or "your" in said
    hedged = (_HEDGED.intersection(said) or wished) and addressed and end > at + 2
    return end if hedged and _is_verb(words, end) and said[-1] != "for" else None


def _excuse(words: list[str], at: int) -> int | None:
    """*Sorry to bother you again, but* could you ..."""
    if words[at : at + 2] != ["sorry", "to"] or words[at + 3 : at + 4] != ["you"]:
        return None
    end = at + 4
    while _word(words, end) in ("again", "with", "this", "that", "so", "late", "early", "but"):
        end += 1
    return end


def _with_cherries(words: list[str], at: int) -> int | None:
    """Pretty please *with sugar on top and a cherry*."""
    if words[at] != "with" or "please" not in words[max(0, at - 4) : at]:
        return None
    top = next((n for n in range(at + 2, min(len(words), at + 8)) if words[n] in ("top", "it")), 0)
    if not top or words[top - 1] != "on":
        return None
    end = top + 1
    while _word(words, end) not in _SIGNS and words[end] not in FIRST_WORDS and end < top + 6:
        end += 1
    return end


def _prelude(words: list[str], at: int) -> int | None:
    """Be a good lad and ...; do me a favour and ...; what I'd like you to do is ..."""
    first = words[at]
    if first == "what" and words[at + 1 : at + 2] in (["i"], ["we"]):
        asked = [n for n in range(at + 2, min(len(words), at + 12)) if words[n] == "do"]
        if asked and words[asked[0] - 2 : asked[0]] == ["you", "to"]:
            for n in range(asked[0] + 1, min(len(words), asked[0] + _LONGEST)):
                if words[n] == "is" and _is_verb(words, n + 1 + (_word(words, n + 1) == "to")):
                    return n + 1 + (_word(words, n + 1) == "to")
        return None
    if first == "have" and _word(words, at + 2) in _KINDNESSES and _word(words, at + 3) == "to":
        return at + 4  # have the goodness to ...
    if words[at : at + 2] == ["do", "be"]:
        return _prelude(words, at + 1)
    bidden = first == "be" and words[at + 1 : at + 2] in (["a"], ["an"])
    done = first == "do" and bool(_DUTIES.intersection(words[at + 1 : at + 5]))
    if not (bidden or done):
        return None
    for n in range(at + 2, min(len(words), at + 7)):
        if words[n] in ("and", COMMA) and _is_verb(words, n + 1):
            return n + 1
        if words[n] == "of" and done and _word(words, n + 1).endswith("ing"):
            return n + 1  # do me the kindness of bringing ...
    return None


def _tag(words: list[str], at: int, kept: list[str]) -> int | None:
    """..., would you?; ..., and make it snappy; ..., okay?"""
    if not kept or kept[-1] in lexicon.WH or _asks(kept):
        return None
    for end in range(min(len(words), at + 6), at, -1):
        if tuple(words[at:end]) in _TAILS and _closes(words, end):
            ambiguous = words[at:end] in (
                ["right"], ["no"], ["all", "right"], ["that"], ["whatever"], ["move", "it"]
            )  # fmt: skip
            praised = words[at : at + 2] in (["would", "be"], ["will", "do"]) and kept[-1] not in (
                "that",
                "it",
            )
            if praised and not any(_is_verb(kept, n) for n in range(len(kept))):
                return None  # a tea would be lovely
            return end if not ambiguous or kept[-1] == COMMA else None
    if words[at] == "alone" and _closes(words, at + 1) and not _LEAVES.intersection(kept):
        return at + 1 if any(_is_verb(kept, n) for n in range(len(kept))) else None
    end = at + 2 + (_word(words, at + 1) in ("not", "nt"))
    tagged = words[at] in _TAGS and _word(words, end - 1) in _TAGGED
    spoken = kept[-1] not in lexicon.DETERMINERS and kept[-1] not in ("and", "or", "how", "that")
    return end if tagged and spoken and _closes(words, end) else None


def _asks(kept: list[str]) -> bool:
    """Whether the clause so far is a question itself: "where are you", "are you okay"."""
    begin = max((n + 1 for n, word in enumerate(kept) if word in _SIGNS), default=0)
    said = [word for word in kept[begin:] if word != COMMA]
    if said[:2] == ["do", "not"]:
        return False
    asked = bool(said) and said[0] in ("are", "is", "do", "does", "did", "have", "has", "am", "was")
    return asked or not (lexicon.WH | {"whereabouts"}).isdisjoint(said[:3])


def _closes(words: list[str], end: int) -> bool:
    """Whether a sentence ends here, but for an address: "..., would you, love?"."""
    while _word(words, end) == COMMA or _word(words, end) in ADDRESSES | {"please"}:
        end += 1
    return _word(words, end) == FULL_STOP


def _thanks(words: list[str], at: int) -> int | None:
    if words[at] not in _THANKS or (words[at] == "thank" and _word(words, at + 1) != "you"):
        return None
    end = at + 1
    while end < len(words) and words[end] in _MUCH:
        end += 1
    return end if _word(words, end) in _SIGNS or words[at] in ("ta", "cheers") else None


def _address(words: list[str], at: int, kept: list[str]) -> int | None:
    """Love, ...; ..., you clever robot."""
    end = at
    while _word(words, end) in _ADDRESSED and _word(words, end + 1) in _CALLED:
        end += 1
    called = end > at and _word(words, end) in _POLITELY_CALLED and words[end - 1] != "the"
    if _word(words, end) not in ADDRESSES and not called:
        return None
    opens = (not kept or kept[-1] in _SIGNS) and _word(words, end + 1) == COMMA
    closes = bool(kept) and _word(words, end + 1) == FULL_STOP
    plain = bool(kept) and kept[-1] not in lexicon.DETERMINERS | lexicon.OTHER_WORDS
    apart = bool(kept) and (kept[-1] == COMMA or (plain and words[end] in _FAMILIAR))
    return end + 1 if opens or (closes and apart) else None


def _insistence(words: list[str], at: int) -> int | None:
    """The lamp, *I say*."""
    said = at and words[at : at + 2] == ["i", "say"] and _word(words, at + 2) in _SIGNS
    return at + 2 if said else None


def _belief(words: list[str], at: int) -> int | None:
    """The menu, which *I rather think* is on the bar."""
    if words[at] != "i" or _word(words, at - 1) not in (
        "which",
        "that",
        "who",
        "it",
        "they",
        COMMA,
    ):
        return None
    end = at + 1
    while _word(words, end) in _RATHER:
        end += 1
    believes = _word(words, end) in _BELIEVES and _word(words, end + 1) in _STATES
    return end + 1 if believes else None


def _small_word(words: list[str], at: int) -> int | None:
    """*Exactly* three; the *bloody* cup; so *like* can you."""
    if words[at] in _CURSES:
        return at + 1
    if _word(words, at - 1) in lexicon.WH and (end := _phrase_end(_EXPLETIVES, words, at)):
        return end
    if words[at] in ("very", "really", "quite", "extra", "super", "ever") and (
        tuple(words[at + 1 : at + 2]) in lexicon.FILLERS
    ):
        return at + 2
    after = words[at + 1 : at + 3]
    if words[at] == "like" and words[at - 2 : at] in (["could", "you"], ["can", "you"]):
        return at + 1
    if words[at] == "like" and after and after[0] in ("can", "could", "would") and "you" in after:
        return at + 1
    if words[at] == "know" and words[at - 2 : at] in (["can", "you"], ["could", "you"]):
        return at + 1 if _is_verb(words, at + 1) else None
    if at and words[at : at + 4] == ["what", "is", "it", "called"]:
        return at + 4
    if words[at : at + 2] == ["you", "know"] and _word(words, at + 2) not in lexicon.WH | {"that"}:
        asked = _word(words, at - 1) in ("do", "if", "can", "could", "would")
        return None if asked else at + 2
    if words[at : at + 3] == ["let", "us", "see"] and _word(words, at + 3) == COMMA:
        return at + 3
    if words[at : at + 2] == ["go", "on"] and (not at or words[at - 1] in (*_SIGNS, "so")):
        end = at + 2 + (_word(words, at + 2) == "then")
        urged = _word(words, end) == COMMA or end > at + 2
        return end if urged and _is_verb(words, end + (_word(words, end) == COMMA)) else None
    end = _phrase_end(_SMALL, words, at)
    counted = end and (_word(words, end) in NUMBER_WORDS or _word(words, end)[0].isdigit())
    return end if counted else None


def _phrase_end(table: frozenset[lexicon.Phrase], words: list[str], at: int) -> int | None:
    """Where the longest phrase of a set at a word ends."""
    ends = range(min(len(words), at + 4), at, -1)
    return next((end for end in ends if tuple(words[at:end]) in table), None)
