"""What is left of a sentence without its background, and how sure that is."""

from itertools import pairwise
from typing import NamedTuple

from intents.english.clauses.parentheses import INTERJECTIONS
from intents.english.faithfulness import CARRYING, is_superlative
from intents.english.learnt.background import Passed, background
from intents.english.learnt.looks import Said, said
from intents.english.learnt.rewording import is_unheard_verb
from intents.english.learnt.sight import Sight
from intents.english.learnt.trust import CERTAIN, NEVER, SURE
from intents.english.trouble import listing
from intents.english.words import lexicon
from intents.english.words.courtesy import ADDRESSES
from intents.english.words.dictionary import is_english
from intents.english.words.limits import CONDITIONS, DENIALS, MEASURES, TIMES
from intents.english.words.measures import NUMBER_WORDS
from intents.english.words.names import NameIndex
from intents.english.words.reporting import reports
from intents.english.words.verbs import verbs_at

_SURE = 0.8
"""From here on something is passed over at the first attempt, below it at the second."""
_SURE_OF_TALK, _TALK = 0.65, 4
"""The same for at least so many words: nobody orders what is not known at such length."""
_LIKELY, _POSSIBLE = 0.5, 0.25
"""From here on something is passed over at the second attempt, and at the third."""
_SURE_OF_MUCH = 0.95
"""So sure words are passed over that change what is asked more often than not: a number, a time."""
_CHANGING = (
    CARRYING | MEASURES | DENIALS | (TIMES - lexicon.words("before after while then"))
    | lexicon.words("times clock with using to into onto")
)  # fmt: skip
_LIMITS = CONDITIONS | lexicon.words("only twice thrice")
"""What holds one of these is never passed over, however sure the tagger is."""
_POLITE = lexicon.words("mind please possible convenient kind moment dare you'd")
"""With one of these "if" is only courtesy."""
_WHOSE = lexicon.words("i you he she we they that which who whose")
"""After a name these may begin what says which is meant: "the cap she is wearing"."""
_RELATIVE = lexicon.words("that which who whose")
_SUBJECTS = lexicon.words("it i you he she we they which so or is are that's it's to who not")
"""What begins with one of these is no order."""
_ERRANDS = lexicon.words("tell bring give fetch find put answer open close take")
_SAYINGS = INTERJECTIONS | lexicon.words(
    "let rest god bless see mind wait excuse forgive pardon mark cross like man note hush thank"
)
"""Verbs of what is said beside an order: "let me see", "rest her soul"."""
_ONTO = lexicon.DETERMINERS | lexicon.words("me them us him her it")
"""What stands behind the verb of an order."""
_HOW = lexicon.words("with without by using")
_WHEN = MEASURES | (TIMES - lexicon.words("then"))
_SHORT = 6
"""What has fewer words may say how, when or which, without a verb of its own."""
_ASKING = lexicon.words("how why what who when did does")
_ARTICLES = lexicon.words("the a an some")
_TELLING = lexicon.words(
    "i we he she they who already never always say says said told to not didn't don't would will"
)
"""Ahead of an order these make of it what somebody does, did or said: "I already put it there"."""
_EVENTS = ("as soon as ", "every time ", "each time ", "the moment ", "the minute ", "save for ",
           "apart from ", "other than ", "whenever ", "any time ", "once i ", "once he ",
           "once she ", "once they ", "once we ", "once the ", "once it ", "until ")  # fmt: skip
"""What begins so says when something is to be done, or what with it is not."""
_PICKING = (frozenset(lexicon.COLORS) | frozenset(lexicon.SIZES)) - lexicon.words("little light")
_NUMBERS = NUMBER_WORDS - lexicon.words("one a an second")
_OF = lexicon.words("of o") | MEASURES
_QUOTES = frozenset('"“”')
_FURTHER = lexicon.words("and plus with also")
_ASIDES = lexicon.LISTED | ADDRESSES | INTERJECTIONS
"""What is said beside an order in a single word."""
_MOST_CLAUSES = 4
"""So many clauses are left out at most."""
_SUBJECTS_ALONE = lexicon.words(
    "i i'm i've i'd i'll im ive he he's he'd she she's they they're we we're we've somebody "
    "someone everybody everyone nobody"
)
_LINKS = lexicon.words(
    "because cos cause coz since so but and or if while when whenever once until till before after "
    "as than that which who where what how why not"
)
_EVENTFUL = lexicon.words("once until till whenever before after as when")
_OPENING_SUBJECTS = lexicon.words(
    "it it's its you you're you've there there's theres that's thats this what's"
)
"""These begin a clause where a verb of it follows."""
_REFUSING = lexicon.words("not don't dont never")
_WHITHER = lexicon.words("to into onto from of off")
_TURNING = lexicon.words("on off open closed shut left right up down")
_AROUND_TURNS = _TURNING | lexicon.words(
    "no sorry oh wait actually please then again i mean rather instead well ah so now and it back"
)
_SIGNS = str.maketrans(".;:!?…–—", "," * 8)
_EDGES = " ,.;:!?-–—…"


class Remainder(NamedTuple):
    """What is left of a sentence.

    Attributes:
        text: The sentence without its background.
        spans: The characters that were passed over, from where to where.
        passed: What was passed over, in quotation marks, as a list in words.
        least: How likely a reading of it has to be to be acted on [0..1]; above 1 if it never is.
        harms: What else the background may say: "manner", "when".
    """

    text: str
    spans: tuple[tuple[int, int], ...]
    passed: str
    least: float
    harms: frozenset[str] = frozenset()


def remainders(text: str, seen: Sight, index: NameIndex) -> list[Remainder]:
    """What may be left of a sentence, the surest first; empty if nothing can be passed over."""
    likely, possible = (
        [span for span in background(seen.words, seen.idle, least) if not _limits(text, span)]
        for least in (_LIKELY, _POSSIBLE)
    )
    sure = [span for span in likely if _is_harmless(text, span, index)]
    found: list[Remainder] = []
    for spans in (sure, likely, possible):
        left = _left(text, spans, index)
        if spans and any(map(str.isalnum, left.text)) and left not in found:
            found.append(left)
    return found


def parts(text: str, seen: Sight, index: NameIndex) -> list[Remainder]:
    """What is left without whole clauses, the likeliest talk first: one of them, two, ...

    Nothing is left out that holds a condition or a denial.
    """
    plain = {word.raw.lower() for word in seen.words}
    if plain & CONDITIONS and not plain & _POLITE:
        return []  # what hangs on a condition is part of it
    clauses = _clauses(seen.words)
    idle = [sum(float(p) for p in seen.idle[a:b]) / (b - a) for a, b in clauses]
    order = sorted(range(len(clauses)), key=lambda n: -idle[n])
    found: list[Remainder] = []
    for most in range(1, min(len(clauses), _MOST_CLAUSES + 1)):
        spans = _joined(seen, clauses, sorted(order[:most]))
        if not all(any(map(str.isalnum, text[span.start : span.end])) for span in spans):
            continue
        if any(_limits(text, span) or _says_when(text, span) for span in spans):
            break
        found.append(_left(text, spans, index))
    return [one for one in found if any(map(str.isalnum, one.text))]


def _clauses(words: list[Said]) -> list[tuple[int, int]]:
    """From which word to which each clause goes, with the signs behind it."""
    plain = [word.raw.lower().replace("’", "'") for word in words]
    starts = [0]
    for n in range(1, len(words)):
        after_sign = words[n - 1].is_sign and not words[n].is_sign
        if after_sign or (n - starts[-1] > 1 and _opens_clause(plain, n)):
            starts.append(n)
    if len(starts) > 1 and all(word.is_sign for word in words[: starts[1]]):
        del starts[1]
    return list(pairwise([*starts, len(words)]))


def _opens_clause(plain: list[str], at: int) -> bool:
    """Whether a clause begins at a word without a sign before it."""
    if plain[at - 1] in _LINKS or plain[at - 1 : at + 1] == ["soon", "as"]:
        return False
    return _is_subject(plain, at + 1 if plain[at] in _LINKS else at)


def _is_subject(plain: list[str], at: int) -> bool:
    """Whether the subject of a statement stands at a word."""
    if at >= len(plain):
        return False
    following = plain[at + 1] if at + 1 < len(plain) else ""
    states = following in lexicon.AUXILIARIES or following.endswith("n't") or "'" in plain[at]
    return plain[at] in _SUBJECTS_ALONE or (plain[at] in _OPENING_SUBJECTS and states)


def _joined(seen: Sight, clauses: list[tuple[int, int]], gone: list[int]) -> list[Passed]:
    """The clauses that are left out, those beside one another as one."""
    spans: list[Passed] = []
    for n in gone:
        first, last = clauses[n]
        start, end = seen.words[first].start, seen.words[last - 1].end
        sure = min(float(p) for p in seen.idle[first:last])
        if spans and n - 1 in gone:
            spans[-1] = Passed(spans[-1].start, end, min(sure, spans[-1].sure))
        else:
            spans.append(Passed(start, end, sure))
    return spans


def _says_when(text: str, span: Passed) -> bool:
    first = next((w.raw.lower() for w in said(text[span.start :]) if not w.is_sign), "")
    return first in _EVENTFUL


def _limits(text: str, span: Passed) -> bool:
    words = [word.raw.lower() for word in said(text[span.start : span.end])]
    heard = [word for word in words if word[0].isalnum()]
    bare = any(  # no wait, don't
        one in _REFUSING and not two[0].isalnum() for one, two in pairwise([*words, "."])
    )
    denied = (
        bare
        or not _REFUSING.isdisjoint(heard[:2])
        or any(  # "but not before noon"
            one == "not" and two in TIMES for one, two in pairwise(heard)
        )
    )
    return denied or (bool(_LIMITS.intersection(words)) and not _POLITE.intersection(words))


def _is_harmless(text: str, span: Passed, index: NameIndex) -> bool:
    """Whether nothing in it is likely to say which thing is meant, how many, when or how."""
    words = [word.raw.lower() for word in said(text[span.start : span.end])]
    named = any(index.match(words, at) for at in range(len(words)))
    much = named or bool(_CHANGING.intersection(words))
    least = _SURE_OF_MUCH if much else _SURE_OF_TALK if len(words) >= _TALK else _SURE
    return span.sure >= least and not _harms(text, span, index)


def _harms(text: str, span: Passed, index: NameIndex) -> dict[str, float]:
    """What it may say, and how likely the rest then has to be what was meant [0..1].

    Which thing is meant, how, when, or an order: beyond 1 where it mostly does.
    """
    words = [word.raw.lower() for word in said(text[span.start : span.end])]
    before = [word.raw.lower() for word in said(text[: span.start])]
    heard = [word for word in words if word[0].isalnum()]
    first, *others = heard
    verbless = not lexicon.AUXILIARIES.intersection(heard) and "'" not in "".join(heard)
    short = len(heard) < _SHORT and verbless
    named = any(
        match is not None and match.end == len(before)
        for match in (index.match(before, at) for at in range(max(0, len(before) - 4), len(before)))
    )
    goes_on = text[span.end :].lstrip()[:1].isalnum()
    thing = short and not _ARTICLES.isdisjoint(heard[:-1])
    which = named and words[0] in _WHOSE
    found = {
        "manner": NEVER if not others and first.endswith("ly") else 0.0,
        "thing": (NEVER if first in _ARTICLES | _FURTHER else CERTAIN) if thing else 0.0,
        "where": NEVER if first == "where" or _leads_there(heard, index) else 0.0,
        "asks": NEVER if first in _ASKING and goes_on else 0.0,  # "how would you ..."
        "which": (NEVER if first in _RELATIVE or len(heard) < _TALK else CERTAIN) if which else 0.0,
        "when": NEVER if short and not _WHEN.isdisjoint(heard) else 0.0,  # "tomorrow at dawn"
        "how": NEVER if short and first in _HOW else 0.0,
        "order": NEVER if any(is_order(heard) for is_order in _ORDERS) or _turns(words) else 0.0,
        "corrects": NEVER if _corrects(heard, index) else 0.0,
        "told": NEVER if goes_on and (words[-1] in _TELLING or reports(heard)) else 0.0,
        "event": NEVER if f"{' '.join(heard)} ".startswith(_EVENTS) else 0.0,
        "grave": NEVER if _picks_out(heard, short=short) else 0.0,
        "quoted": NEVER if not _QUOTES.isdisjoint(text[span.start : span.end]) else 0.0,
    }
    return {harm: least for harm, least in found.items() if least}


def _contrasts(heard: list[str]) -> bool:
    """Whether an order is set against the one before: "but stay outside"."""
    return heard[0] == "but" and heard[1:2] not in ([], ["mind"]) and bool(verbs_at(heard, 1))


def _orders(heard: list[str]) -> bool:
    """Whether an order may be among the words: "and answer his question", "tell them the day"."""
    return any(
        (n == 0 or heard[n - 1] in _FURTHER or (verb in _ERRANDS and heard[n - 1] not in _SUBJECTS))
        and verb not in _SAYINGS
        and after in _ONTO
        and (bool(verbs_at([verb], 0)) or is_unheard_verb(verb))
        for n, (verb, after) in enumerate(pairwise(heard))
    )


def _corrects(heard: list[str], index: NameIndex) -> bool:
    """Whether it may say what is meant instead: "I mean the radio", "or rather, the other bin"."""
    anew = heard[2:3] != [] and heard[2] in lexicon.DETERMINERS
    if heard[:2] in (["i", "mean"], ["i", "meant"]) and anew:
        return True  # "I mean the cellar", which nobody may know
    marked = heard[:2] in (["i", "mean"], ["i", "meant"], ["or", "rather"], ["no", "wait"])
    marked = marked or heard[0] in ("no", "rather", "correction")
    return marked and any(index.match(heard, at) for at in range(1, min(len(heard), _SHORT)))


def _turns(words: list[str]) -> bool:
    """Whether a clause of it is nothing but "off", "on" or "open": what was asked, turned over."""
    clauses = [part.split() for part in " ".join(words).translate(_SIGNS).split(",")]
    return any(
        len(clause) < _SHORT
        and not _TURNING.isdisjoint(clause)
        and _AROUND_TURNS.issuperset(clause)
        for clause in clauses
    )


def _picks_out(heard: list[str], *, short: bool) -> bool:
    """Whether it may say which or how many: "blue, the ones from last week", "four of them"."""
    counts = any(one in NUMBER_WORDS and two in _OF for one, two in pairwise(heard))
    just = heard[0] in ("just", "only") and short
    figures = short and any(one[0].isdigit() or one in _NUMBERS for one in heard)
    coloured = any(one in _PICKING and two == "one" for one, two in pairwise(heard))
    singled = heard[0] in _PICKING or "ones" in heard or any(map(is_superlative, heard))
    return singled or coloured or counts or just or figures


def _leads_there(heard: list[str], index: NameIndex) -> bool:
    """Whether it begins or ends with where from or to: "out of the shed", "... to the hall"."""
    for at, word in enumerate(heard[:-1]):
        if word not in _WHITHER or (at > 1 and verbs_at(heard, at - 1)):
            continue
        name = at + 1 + (heard[at + 1] in lexicon.DETERMINERS and at + 2 < len(heard))
        match = index.match(heard, name)
        spot = match is not None and match.of("place", "room")
        if match is not None and spot and (at <= 1 or match.end == len(heard)):
            return True
    return False


def _is_terse(heard: list[str]) -> bool:
    """Whether it may be an order or a thing in a single word: "juggle", "and a saucer"."""
    telling = [word for word in heard if word not in lexicon.FUNCTION_WORDS]
    alone = len(telling) == 1 and is_english(telling[0]) and telling[0] not in _ASIDES
    return alone and heard[0] not in _SUBJECTS


_ORDERS = (_is_terse, _orders, _contrasts)


def _left(text: str, spans: list[Passed], index: NameIndex) -> Remainder:
    left = text
    for span in reversed(spans):
        left = f"{left[: span.start].rstrip()} {left[span.end :].lstrip()}"
    quoted = [f"“{text[span.start : span.end].strip(_EDGES)}”" for span in spans]
    harms = [harm for span in spans for harm in _harms(text, span, index).items()]
    harmless = all(_is_harmless(text, span, index) for span in spans)
    least = max((least for _, least in harms), default=SURE if harmless else CERTAIN)
    where = tuple((span.start, span.end) for span in spans)
    told = frozenset(harm for harm, _ in harms)
    return Remainder(left.strip(), where, listing(quoted, "and"), least, told)
