"""What is wished for around the telling of where things belong.

"Clean up the hall a bit: *all the mugs in there go on the rack*"; "the mugs go on the rack, *can
you put them away*".
"""

from intents.english.clauses.belonging import belongs_somewhere
from intents.english.frames.homes import told_home
from intents.english.phrases.complements import ends_clause
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import to_place
from intents.english.reading import Found, Sentence
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.goals import ForEach, Place

_TIDIES = lexicon.phrases(
    "tidy up,tidy,clean up,clean,clear up,straighten up,straighten,neaten up,have a tidy in,"
    "sort out,pick up in"
)
_A_BIT = lexicon.phrases(
    "a bit,a little,a little bit,up,up a bit,up a little,up a little bit,quickly,properly,nicely"
)
_PUTS = lexicon.words("put place pop stow tidy clear stash pack move return take bring carry get")
_CARRIES = lexicon.words("take bring carry get")
"""What these take away or back need not come to where it belongs."""
_THEM = lexicon.phrases(
    "it,them,that,this,those,these,both,it all,them all,them both,all of it,all of them,"
    "both of them,all of these,all of those"
)
_AWAY = lexicon.phrases("away,back,up,away again,back again,in its place,in their place")
_THERE = lexicon.phrases(
    "there,back there,over there,where it belongs,where they belong,back where it belongs,"
    "back where they belong,where it goes,where they go,where it lives,where they live,"
    "to where it belongs,to where they belong,back to where it belongs,back to where they belong"
)


def room_tidied(sentence: Sentence, at: int) -> Found | None:
    """*Tidy up the hall a bit*: the mugs go on the rack; without that nobody knows what to do."""
    text = sentence.text
    start = text.phrase_end(_TIDIES, at)
    spot = noun_phrase(text, start) if start else None
    cleaned = text.words[at:start] == ["clean"]  # a table is cleaned with a cloth
    if spot is None or not (spot.name("room") or (spot.name("place") and not cleaned)):
        return None
    end = text.phrase_end(_A_BIT, spot.end) or spot.end
    if text.word(end) not in (COMMA, FULL_STOP) or not belongs_somewhere(text, end + 1):
        return None
    sentence.scope.mention(to_place(spot, sentence.scope))
    return [], end


def home_told(sentence: Sentence, at: int) -> Found | None:
    """Put the mugs away, *they should all go on the rack*: the order before it has that already."""
    told = told_home(sentence.text, at, sentence.scope) if sentence.before else None
    last = sentence.before[-1] if told else None
    if isinstance(last, ForEach):
        last = last.goals[-1]
    if told is None or not isinstance(last, Place):
        return None
    return ([], told[1]) if (last.on, last.in_) == (told[0].on, told[0].in_) else None


def put_home(sentence: Sentence, at: int) -> Found | None:
    """The mugs go on the rack, *put them away*: it is told already where to."""
    text, homes = sentence.text, sentence.notes.homes
    if not homes or tuple(sentence.before[-len(homes) :]) != homes:
        return None
    them = text.phrase_end(_THEM, at + 1) if text.word(at) in _PUTS else None
    if them is None:
        return None
    end = text.phrase_end(_THERE, them)
    if end is None and text.word(at) not in _CARRIES:
        end = text.phrase_end(_AWAY, them)
    return ([], end) if end is not None and ends_clause(text, end) else None
