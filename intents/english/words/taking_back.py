"""What people say between what they said and what they meant: "aiya, wrong, ...".

Such an interruption [Shriberg1994] is a run of cries, regrets, words of address and of what one
says of oneself, in any number and order, that stands between signs and holds at least one thing
that takes something back. So the kinds are listed, and no combination is; each run is read as a
plain ", no,". What takes back one thing by itself ("no", "I mean") is left as it was said, for
readings tell those apart (:mod:`intents.english.clauses.markers`).

[Shriberg1994] E. Shriberg, Preliminaries to a Theory of Speech Disfluencies, UC Berkeley, 1994.
"""

import re
from collections.abc import Iterable

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.measures import number
from intents.english.words.names import NameIndex
from intents.english.words.repairs import TAKES_BACK

Phrase = tuple[str, ...]


def _phrases(text: str) -> frozenset[Phrase]:
    return frozenset(tuple(phrase.split()) for phrase in text.split(","))


_NOES = _phrases(
    "no,nah,naw,nay,nae,nope,non,nein,negative,wrong,that is wrong,that was wrong,not right,"
    "that is not right,wrong one,wrong way,not that,no good"
)
_OF_ONESELF = _phrases(
    "what am i saying,what am i on about,what am i like,what am i thinking,what am i doing,"
    "what was i thinking,what do i say,what i say,what did i say,silly me,stupid me,daft me,"
    "foolish me,silly old me,i tell a lie,tell a lie,i am mistaken,i was mistaken,"
    "i have me mistaken,i have mistaken,i made a mistake,i mistake,i misspoke,i got that wrong,"
    "i said that wrong,i said it wrong,i got mixed up,i am mixing things up,i got confused,"
    "i was confused,i am confused,i confuse,come to think of it,now i think of it,"
    "now i think about it,now that i think of it,thinking about it,on second thoughts,"
    "on second thought,second thoughts,on reflection,upon reflection,changed my mind,"
    "i changed my mind,i have changed my mind,change of plan,change of plans,typo,just kidding,"
    "kidding,jk,as you were,belay that,scratch that,strike that,scrap that,cancel that,forget that,"
    "forget it,cancel,scratch,my mistake,my bad,my fault,i mean,i meant,i do mean,i mean to say,"
    "i meant to say,i should say,i should have said,or rather,rather,correction,make that,make it,"
    "better make that,i take that back,listen to me"
)
"""These take something back, the last ones whatever stands around them."""
_TAKING = _NOES | _OF_ONESELF | TAKES_BACK
_PAUSES = _phrases(
    "wait,wait a tick,wait a minute,wait a second,wait a sec,wait a moment,wait a bit,hang on,"
    "hang about,hold on,hold your horses,hold it,hang on a sec,hang on a second,hold on a sec,"
    "hold on a second,one second,one moment,half a mo,just a second,just a minute,let me think,"
    "let me see,you know what,do you know what,know what,tell you what,i tell you what,i know,"
    "give over,get away,go on,go on then,never mind,actually,or,well,well then,then,but,and"
)
_CRIES = _phrases(
    "oh,ah,ach,och,aw,aww,ay,ooh,er,err,uh,um,eh,hm,hmm,äh,ähm,euh,oops,whoops,oopsie,whoopsie,"
    "aiya,aiyah,aiyo,aiyoh,aiyaa,alamak,arre,arrey,arey,cho,damn,dammit,darn,dang,blast,bother,"
    "drat,crikey,heck,hell,bloody hell,oh hell,shoot,crumbs,gosh,heavens,good heavens,good grief,"
    "good lord,oh lord,goodness,my goodness,goodness me,for heaven 's sake,ugh,argh,tsk,doh,"
    "oh dear,dear me,dear oh dear,lol,haha,ha,sigh,sorry,so sorry,very sorry,i am sorry,"
    "i am so sorry,pardon,pardon me,excuse,excuse me,forgive me,do forgive me,apologies,"
    "my apologies,i beg your pardon,beg pardon,beg your pardon,a thousand pardons,oh sorry"
)
_ADDRESS = _phrases(
    "man,sah,sir,madam,love,lovely,my love,my lovely,dear,my dear,darling,mate,pal,pet,hen,hinny,"
    "duck,me duck,me ducks,lad,son,boss,bro,bruv,bruh,dude,please,hon,honey,sweetheart,robot,"
    "my friend,friend,brother,guv,buddy,lah,leh,lor"
)
_SELF_REPROACH = re.compile(
    r"(?:i am|i 'm|me head is|my head is|my mind is|i have gone|i am going) (?:all |a bit |so |"
    r"quite |such )*(?:over the (?:shop|place)|at sea|in a muddle|muddled|over the place|"
    r"scatty|dotty|daft|gone|doolally|not myself|losing it|stupid|silly|hopeless|elsewhere|tired)"
    r"(?: today| this morning| tonight| me)?"
)
"""I'm all over the shop today: said behind it, too."""
_BY_THEMSELVES = _phrases("no,nope,no no,no no no,sorry,wait,i mean,i meant,rather,correction")
"""Single ones that are left as they were said."""
_MADE = _phrases(
    "make that,make it,i mean,i meant,i do mean,i mean to say,i meant to say,i should say"
)
"""Behind these what is meant follows without a sign."""
_REPORTS = lexicon.words("say tell announce shout whisper repeat sing ask spell")
_SUBJECTS = lexicon.words("i he she it they we that this there too")
_SPOTS = lexicon.words("to in on into onto at from for by")
_ENOUGH = _phrases(
    "will do,would do,will be fine,is fine,is better,better,would be better,will be better,"
    "are enough,is enough,are plenty,is plenty,will do fine,will do nicely,do better,is more better"
)
"""What is said behind what will do instead."""
_UNLESS = lexicon.words("if unless otherwise else whether")
_FEWEST_TOLD = 2
_LONGEST = 6
_WORDS = re.compile(r"[\w']+")
_HARMLESS = lexicon.words(
    "rush hurry problem need worries matter longer more one idea doubt trouble other further"
)
"""No *rush*: behind a "no" these make it take nothing back."""
_SAID_ALOUD = _TAKING | _phrases("sorry,instead,actually,hang on,hold on,wait,excuse,forgive me")
"""What takes something back in a sentence that has no more than its words."""


def behind_what_takes_back(text: str) -> str | None:
    """What of a text stands behind the last words that take something back; None if none do."""
    said = list(_WORDS.finditer(text.lower().replace("’", "'")))
    words = [one.group() for one in said]
    for at in range(len(words) - 1, -1, -1):
        for size in range(min(_LONGEST, len(words) - at), 0, -1):
            if tuple(words[at : at + size]) not in _SAID_ALOUD:
                continue
            if size > 1 or words[at + 1 : at + 2] == [] or words[at + 1] not in _HARMLESS:
                return text[said[at + size - 1].end() :]
    return None


def interruptions(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens with ", no," for each interruption that takes something back."""
    words = [token.text for token in tokens]
    kept: list[Token] = []
    at = 0
    while at < len(tokens):
        token, end = tokens[at], _interruption_end(words, at, index)
        if end is None:
            kept.append(token)
            at += 1
            continue
        kept += [token, Token("no", "no"), Token(COMMA, ",")]
        enough = _enough_end(words, end, index)
        if enough is not None:
            kept += tokens[end:enough]
            end += len(list(_clause(words[end:])))
        at = end
    return _without_reproach(kept)


def _without_reproach(tokens: list[Token]) -> list[Token]:
    """The tokens without what one says of oneself behind it: "..., I'm all at sea today"."""
    words = [token.text for token in tokens]
    begin = max((n + 1 for n, word in enumerate(words[:-1]) if word == COMMA), default=0)
    clause = " ".join(_clause(words[begin:]))
    if begin and "no" in words[:begin] and _SELF_REPROACH.fullmatch(clause):
        return tokens[: begin - 1]
    return tokens


def _interruption_end(words: list[str], at: int, index: NameIndex) -> int | None:
    """Where a run ends that begins with a sign, and what is meant begins."""
    if at == 0 or words[at] not in (COMMA, FULL_STOP) or not _REPORTS.isdisjoint(words[:at]):
        return None
    begin = at
    while begin < len(words) and words[begin] in (COMMA, FULL_STOP):
        begin += 1
    said, end, apart = list[Phrase](), begin, False
    while end < len(words):
        phrase = _phrase(words, end, index)
        if phrase is None:
            break
        said.append(phrase)
        end += len(phrase)
        apart = end < len(words) and words[end] in (COMMA, FULL_STOP)
        while end < len(words) and words[end] in (COMMA, FULL_STOP):
            end += 1
    if not said or end >= len(words):
        return None
    meant = _past_reasons(words, end, index) if apart else end
    enough = _enough_end(words, meant, index)
    takes = any(phrase in _TAKING for phrase in said)
    pauses = any(phrase in _PAUSES or phrase in _CRIES for phrase in said)
    takes = takes or (pauses and (words[end] == "not" or enough is not None))
    plain = all(phrase in _BY_THEMSELVES for phrase in said) and meant == end and enough is None
    goes_on = apart or said[-1] in _MADE
    return meant if takes and goes_on and not plain else None


def _past_reasons(words: list[str], at: int, index: NameIndex) -> int:
    """Past why it was taken back, to what is meant: "she's had her dinner, *Yusra*".

    A reason is a clause with a subject and no name in it; what is meant is a name, an amount, or
    where it is to go.
    """
    begin = at
    while begin < len(words):
        clause = list(_clause(words[begin:]))
        end = begin + len(clause) + 1
        named = any(index.match(words, n) for n in range(begin, begin + len(clause)))
        if not clause or named or clause[0] not in _SUBJECTS or len(clause) < _FEWEST_TOLD:
            break
        begin = end
        while begin < len(words) and words[begin] in (COMMA, FULL_STOP):
            begin += 1
    return begin if begin > at and _is_meant(words, begin, index) else at


def _is_meant(words: list[str], at: int, index: NameIndex) -> bool:
    """Whether a name begins at a word, with or without where it is, or how many are."""
    first = at
    for table in (_SPOTS, lexicon.DETERMINERS):
        first += first < len(words) and words[first] in table
    if first < len(words) and number(words, first) is not None:
        return True
    return first < len(words) and index.match(words, first) is not None


def _enough_end(words: list[str], at: int, index: NameIndex) -> int | None:
    """Where what is meant ends before "will do", "is better", "are enough"; None if nothing is."""
    clause = list(_clause(words[at:])) if at < len(words) else []
    if not clause or not _is_meant(words, at, index) or not _UNLESS.isdisjoint(words):
        return None
    for phrase in _ENOUGH:
        if len(clause) > len(phrase) and tuple(clause[-len(phrase) :]) == phrase:
            return at + len(clause) - len(phrase)
    return None


def _phrase(words: list[str], at: int, index: NameIndex) -> Phrase | None:
    """The longest phrase of a run at a word; what is the name of something is none."""
    for size in range(min(_LONGEST, len(words) - at), 0, -1):
        phrase = tuple(words[at : at + size])
        if any(phrase in table for table in _ALL):
            return phrase if index.match(words, at) is None or size > 1 else None
    rest = " ".join(_clause(words[at:]))
    reproach = _SELF_REPROACH.fullmatch(rest)
    return tuple(rest.split()) if reproach else None


def _clause(words: Iterable[str]) -> Iterable[str]:
    for word in words:
        if word in (COMMA, FULL_STOP):
            return
        yield word


_ALL = (_TAKING, _PAUSES, _CRIES, _ADDRESS)
