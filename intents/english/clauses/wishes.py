"""How wishes begin, and how it is said that somebody has a question."""

from intents.english.words import lexicon
from intents.english.words.text import Text

WISHES = lexicon.phrases("i want,i need,i would like,we want,we need,we would like")
"""How a wish begins."""
NEEDS = lexicon.phrases(
    "needs,wants,would like,would like to have,wants to have,would love,asked for,has asked for,"
    "is asking for,asks for,ordered,has ordered,is waiting for,requested,has requested,requires,"
    "is in need of,could use,fancies,is after,'s after,desires,craves,is wanting,is needing,"
    "is dying for,is gasping for,keeps asking for,has been asking for,could do with,"
    "would appreciate,would fancy,would not mind,'d like,wishes for,wishes to have,is to get,"
    "is to have,should get,should have,shall have,can have"
)
"""How it is said that somebody wants a thing: "Ada *needs* it"."""
_ASKING = lexicon.words(
    "who that whose wants want would like likes to ask asks asking is has have got a an any some "
    "one question questions for you me with which needs need answer answered answering be "
    "something your will should can must"
)


def asks_end(text: Text, at: int) -> int | None:
    """Where words end that say that somebody has a question to be answered."""
    end, asks = at, False
    while text.word(end) in _ASKING and (end == at or text.word(end) not in ("who", "whose")):
        asks = asks or text.word(end) in ("ask", "asks", "asking", "question", "questions")
        end += 1
    return end if asks else None
