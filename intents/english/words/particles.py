"""Particles: small words with which talk begins and turns to somebody, and that say nothing.

"Right so", "och aye well", "arre yaar", "yeah like": before an order any run of them says nothing,
whatever their number and order, and whether a comma stands behind them or not. So they are listed
once, by what they are, and no combination is. Alone they may be an answer or a greeting, and are
left as they are; elsewhere ("the sweet tea") they are words like others, which the law of
faithfulness looks at, so they are in no list that it knows.
"""

from intents.english.words.lexer import COMMA, FULL_STOP, Token
from intents.english.words.lexicon import DETERMINERS, phrases, unlisted
from intents.english.words.measures import NUMBER_WORDS
from intents.english.words.names import NameIndex
from intents.english.words.verbs import FIRST_WORDS

_PARTICLES = unlisted(
    "right so ok okay well now yeah yes yep aye och ah oh eh um uh erm hmm hey hi yo oi hello "
    "anyway anyways anyhow alright righto rightio basically actually honestly listen arre "
    "arrey arey are accha acha achha haan chalo yaar bhai beta ji na nah lah leh lor aiyo "
    "aiyah hoots jings crikey blimey gosh golly goodness heavens jeez gee whew phew sheesh "
    "man dude bro mate buddy pal bud folks ja oke doch naja tja bon alors ben voila bueno "
    "pues vale oye mira hombre cheers ta tsk ahem hullo cor strewth begorrah sure grand "
    "lovely brilliant great perfect cool sweet fine good fab super champion fantastic "
    "wonderful excellent splendid"
)
"""What opens a turn, assents, calls out or addresses, in the English of many homes."""
_BEFORE_A_COMMA = ("say", "look", "see", "like", "there")
"""These say nothing only with a comma behind them."""
_LIKE = ("like", "just", "then", "also", "plus", "and", "but", "so")
"""These go with other particles, and never alone."""
_OPENS = (
    DETERMINERS
    | NUMBER_WORDS
    | unlisted("can could would will you i please if when once there what where who how is are me")
    | unlisted("let do all both each every on upon in at from under with which")
)
"""What an order or a question begins with, besides its verb."""
_ONE = ("one", "ones", "other", "others")
"""What stands for a thing that was named before."""
_AFTER_THINGS = (COMMA, FULL_STOP, "please", "too", "thanks")
_MOST_ADJECTIVES = 3
_NEVER_ALONE = unlisted(
    "are na man great sure good fine super cool sweet ja ben mira bon ta no bas"
)
"""Words of other senses: particles only beside others, or with a comma."""
_IDIOMS = phrases(
    "pray tell,what you do,here is what you do,you know what,i tell you what,tell you what,"
    "here is the thing,thing is,the thing is,so the thing is,let me think,let me see,beg pardon,"
    "beg your pardon,begging your pardon,if i may,if you would,do one thing,you do one thing,"
    "one thing,quick one,quick thing,never you mind,come to think of it,while i think of it,"
    "before i forget,while i remember,god bless you,bless you"
)
"""Turns of talk of several words, with a comma behind them."""


def without_particles(tokens: list[Token], index: NameIndex) -> list[Token]:
    """The tokens without runs of particles before an order or a question."""
    said = [token.text for token in tokens]
    kept: list[Token] = []
    at = 0
    while at < len(tokens):
        begins = at == 0 or said[at - 1] == FULL_STOP
        end = _run_end(said, at, index) if begins else at
        if end == at:
            kept.append(tokens[at])
            end += 1
        elif (turns := _turns_to(said, at, end, index)) is not None:
            kept.append(Token("then", tokens[turns].raw))
        at = end
    return kept


def _turns_to(said: list[str], begin: int, end: int, index: NameIndex) -> int | None:
    """Where the "now" of "now the blue one" stands, with which a run of particles ends.

    A thing and nothing else follows it: it goes on from what was asked for last, as "then" does.
    """
    last = end - 1 - (said[end - 1] == COMMA)
    if begin or last < begin or said[last] != "now" or said[end] not in DETERMINERS:
        return None
    for at in range(end + 1, min(len(said), end + 2 + _MOST_ADJECTIVES)):
        name = index.match(said, at)
        rest = said[at + 1 :] if said[at] in _ONE else said[name.end :] if name else None
        if rest is not None and all(word in _AFTER_THINGS for word in rest):
            return last
    return None


def _run_end(said: list[str], begin: int, index: NameIndex) -> int:
    """Where a run of particles ends that an order follows; where it begins if there is none."""
    at, count, comma = begin, 0, False
    while at < len(said):
        idiom = max((len(one) for one in _IDIOMS if _is_idiom(said, at, one)), default=0)
        apart = said[at + 1 : at + 2] == [COMMA]
        if idiom:
            at += idiom
        elif index.match(said, at) is not None:
            break
        elif _is_particle(said[at], begun=count > 0, apart=apart):
            at += 1
        else:
            break
        count += 1
        comma = said[at : at + 1] == [COMMA]
        at += comma
    told = count > 1 or (count == 1 and (comma or said[begin] not in _NEVER_ALONE))
    return at if told and _is_followed(said, at) else begin


def _is_particle(word: str, *, begun: bool, apart: bool) -> bool:
    return word in _PARTICLES or (begun and word in _LIKE) or (apart and word in _BEFORE_A_COMMA)


def _is_idiom(said: list[str], at: int, idiom: tuple[str, ...]) -> bool:
    return tuple(said[at : at + len(idiom)]) == idiom and said[at + len(idiom) :][:1] == [COMMA]


def _is_followed(said: list[str], at: int) -> bool:
    """Whether an order or a question of more than one word goes on."""
    return at + 1 < len(said) and (said[at] in FIRST_WORDS or said[at] in _OPENS)
