"""Words that are passed on: where a message begins and where it ends.

"Tell Ada, *in these very words*: the tea is cold and she is late, then come back".
"""

from copy import copy

from intents.english.clauses.compounds import condition
from intents.english.clauses.conditions import IF
from intents.english.clauses.openings import nothing_end, otherwise_end, skip_openings
from intents.english.phrases.complements import connector_end
from intents.english.phrases.referents import Scope
from intents.english.phrases.times import ARRIVED
from intents.english.trouble import ReadingError
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP, QUOTE
from intents.english.words.measures import measure
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at

_VERBATIM = lexicon.phrases(
    "word for word,exactly,verbatim,as follows,the following,exactly this,just this,this,"
    "exactly that,"
    "the exact words,exactly as i say it,and i quote,quote,in so many words,to the letter"
)
_WORDS_OF = lexicon.words("these those the my exact exactly very precise same just following own")
"""What stands between "in" and "words" that are to be said as they are."""
_GOES_ON = lexicon.words("and but because that as since so or while though although if when")
"""Behind one of these "she is" is a part of the message."""


def message_start(text: Text, at: int) -> int:
    """Past what announces the words: ", in these very words:", "exactly this:"."""
    start = at + (text.word(at) == COMMA)
    end = text.phrase_end(_VERBATIM, start)
    if end is None and text.word(start) in ("in", "with"):
        end = start + 1
        while text.word(end) in _WORDS_OF:
            end += 1
        end = end + 1 if end > start + 1 and text.word(end) in ("word", "words") else None
    if end is None:
        return at
    signs = end
    while text.word(signs) in (COMMA, FULL_STOP) and signs < len(text):
        signs += 1
    return signs if signs > end or text.word(signs) == QUOTE else at


def content_end(text: Text, at: int) -> int:
    """Where words to be said end: at a full stop, or where another command begins."""
    end = at
    while end < len(text) and text.word(end) != FULL_STOP:
        aside = text.word(end) in ("she", "he", "they") and text.word(end + 1) in ("is", "are")
        if aside and end > at + 1 and text.word(end - 1) not in lexicon.WH | _GOES_ON:
            return end - (text.word(end - 1) == COMMA)
        if at < end <= at + 2 and text.phrase_end(ARRIVED, end):
            return end  # say hello when you get to the counter: no words of a greeting
        after = connector_end(text, end) if text.word(end) != COMMA else end + 1
        if after and text.word(end) == COMMA:
            after = connector_end(text, after) or after
        if after and end > at and (verbs_at(text.words, after) or _is_otherwise(text, after)):
            return _without_connector(text, at, end)
        end += 1
    return end


def _without_connector(text: Text, at: int, end: int) -> int:
    """It is late *and, um*, walk her home: what joins the next order is no part of the message."""
    joined = end - 1 if text.word(end - 1) in ("and", "then") and end - 1 > at else end
    return joined - (joined < end and text.word(joined - 1) == COMMA)


def _is_otherwise(text: Text, at: int) -> bool:
    """Say supper is ready; *if she is not there, come back*: no part of what is to be said."""
    start = otherwise_end(text, at)
    if start is None and text.phrase_end(IF, at):
        start = at
        while start < len(text) and text.word(start) not in (COMMA, FULL_STOP):
            start += 1
        if "not" not in text.words[at:start] or text.word(start) != COMMA:
            return False
    if start is None:
        return False
    act = skip_openings(text, start)
    return bool(nothing_end(text, start) or verbs_at(text.words, act))


def before_times(text: Text, at: int, end: int) -> int:
    """Say hello *twice*: the words to be said end before how often."""
    for start in range(max(at + 1, end - 3), end):
        amount = measure(text.words, start)
        if amount and amount.kind == "times" and amount.end == end:
            return start
    return end


_FINDS_OUT = lexicon.words("check see look ask out know wonder remember")


def before_condition(text: Text, at: int, end: int, scope: Scope) -> int:
    """Say dinner is ready *if Ada is in the kitchen*: what can be checked is a condition.

    Tell Leo to check *if it is there*: that is what he is to find out.
    """
    for link in range(at + 1, end):
        start = text.phrase_end(IF, link)
        if start is None or (text.word(link) == "if" and text.word(link - 1) in _FINDS_OUT):
            continue
        try:
            _, stop = condition(text, start, copy(scope))
        except ReadingError:
            continue
        if stop >= end:
            return link
    return end
