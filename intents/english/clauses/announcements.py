"""What announces what is to come or says that it comes later, and asks for nothing by itself.

"Three things I need from you."; "here's the plan:"; "you do one thing,"; "when that is done,";
"and only then"; "help, ...".
"""

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.measures import number
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at

_SIGNS = (COMMA, FULL_STOP)
_SHOWS = lexicon.phrases(
    "here is,here are,this is,these are,that is,there is,there are,i have,i have got,we have,"
    "we have got,i need,i want,do,you do,you have,you have got,now"
)
_SOME = lexicon.phrases(
    "a few,some,several,a couple of,the following,another,just,only,these,this,the,a,an,my,one"
)
_LIKE_WHAT = lexicon.words("more quick small little simple easy last other further tiny short")
_THINGS = lexicon.words(
    "thing things job jobs task tasks errand errands favour favours favor favors chore chores "
    "request requests order orders point points matter matters command commands instruction "
    "instructions assignment assignments plan list programme program deal drill"
)
_FOR_YOU = lexicon.words(
    "that which i we need want would like have got from for of you to do doing done ask in mind "
    "left on my your list please today now be the is are"
)
"""What may be said of such things: "that I need from you", "for you to do"."""
_WHAT = lexicon.phrases("here is what,this is what,that is what,what you do is,what you do is this")
_ANNOUNCED = lexicon.phrases(
    "do this,do the following,do as follows,the following,as follows,in this order,in that order,"
    "only then,not before that,not before,no sooner,not sooner,not earlier,no earlier,"
    "not until then,not a second earlier,not a moment earlier,not a minute earlier,"
    "not a second sooner,not a moment sooner,not a minute sooner,not a second before,"
    "not a moment before,first things first,to begin with,to start with,for a start,for starters"
)
_CALLS = lexicon.phrases(
    "help,help me,help us,somebody help,someone help,help please,please help,please help me,"
    "i need help,i need your help,we need help,can you help me,could you help me"
)
"""Ahead of an order these only call for whoever is to do it."""
_THEN = lexicon.phrases("only then,not until then,not before that,only after that")
_FIRST_OF_ALL = lexicon.phrases(
    "before anything else,before you do anything else,before doing anything else,before all else"
)
"""At the beginning these say no more than "first"; later they turn the order round."""
_WHEN = lexicon.phrases(
    "once,when,after,as soon as,only once,only when,only after,only as soon as,whenever"
)
_ALL_THAT = lexicon.words(
    "that this it you everything all of those both these is are have has got 's been be with the "
    "first one job task thing things and"
)
_DONE = lexicon.words("done finished complete completed over sorted through ready accomplished")
_ABOUT = lexicon.words(
    "with that it this those all of them about around the first one job task whatever what you are "
    "doing"
)


def announced_end(text: Text, at: int) -> int | None:
    """Where an announcement ends that begins at a word."""
    end = text.phrase_end(_ANNOUNCED, at)
    if end is not None and text.word(end) in _SIGNS:
        return end
    called = text.phrase_end(_CALLS, at)
    if called is not None and text.word(called) in _SIGNS and _commands(text, called + 1):
        return called
    then = text.phrase_end(_THEN, at)
    if then is not None and _commands(text, then):
        return then
    first = text.phrase_end(_FIRST_OF_ALL, at)
    if first is not None and not any(word[0].isalnum() for word in text.words[:at]):
        return first
    return _list_end(text, at) or _done_end(text, at)


def _list_end(text: Text, at: int) -> int | None:
    """Three things I need from you; here is what I want: up to the sign behind it."""
    what = text.phrase_end(_WHAT, at)
    if what is not None:
        return _sign_after(text, what)
    n = text.phrase_end(_SHOWS, at) or at
    while counted := text.phrase_end(_SOME, n) or getattr(number(text.words, n), "end", None):
        n = counted
    while text.word(n) in _LIKE_WHAT:
        n += 1
    if n == at or text.word(n) not in _THINGS or text.name_at(n):
        return None
    return _sign_after(text, n + 1)


def _sign_after(text: Text, at: int) -> int | None:
    while text.word(at) in _FOR_YOU:
        at += 1
    return at if text.word(at) in _SIGNS and at < len(text) else None


def _done_end(text: Text, at: int) -> int | None:
    """When that is done; once you are finished with it; when you are done faffing about."""
    start = text.phrase_end(_WHEN, at)
    if start is None:
        return None
    end = start
    while text.word(end) in _ALL_THAT and text.word(end) not in _DONE:
        end += 1
    if end == start or text.word(end) not in _DONE:
        return None
    end += 1
    gerund = text.word(end)
    if gerund.endswith("ing") and not verbs_at(text.words, end) and not text.name_at(end):
        end += 1
    while text.word(end) in _ABOUT:
        end += 1
    return end if text.word(end) in _SIGNS or _commands(text, end) else None


def _commands(text: Text, at: int) -> bool:
    return bool(verbs_at(text.words, at)) or text.word(at) in ("you", "please")
