"""Words that forbid, or only talk of an order, and were lost on the way to goals.

A sentence that the grammar does not read whole is read in other words, with parts of it passed
over or corrected. Where what was lost on the way forbids ("I *forbid* you to go"), is a slip away
from a "not" ("*nevr* go") or makes an order something that is talked about ("*translate into
German:* go"), the goals that are left are the opposite of what was meant or nobody's wish: they
are refused or asked about, never acted on. What the grammar read from every word it has taken
account of, but for a few turns of phrase.
"""

import re
from collections.abc import Iterator

from msgspec.structs import replace
from rapidfuzz.distance import OSA

from intents import goals as g
from intents.english.faithfulness import is_superlative, strings
from intents.english.trouble import Unpromised
from intents.english.words import lexicon
from intents.english.words.dictionary import is_english
from intents.english.words.lexer import COMMA, FULL_STOP, tokenize
from intents.english.words.lexicon import words
from intents.english.words.names import NameIndex, index_of
from intents.english.words.spelling import KNOWN_WORDS
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.letters import bare, latin, seen
from intents.outcomes import Outcome, Question, Refusal
from intents.prohibitions import broken, prohibitions
from intents.second_look import just_that
from intents.vocabulary import Vocabulary

_HARMLESS = (g.Stop, g.Cancel, g.Pause, g.Wait, g.Report)
"""What may be done though it was forbidden: it moves nothing."""
_OTHERS = r"(?:you|yourself|robots?|the robot|anyone|anybody|somebody|someone|him|her|them)"
_FORBIDS = re.compile(
    r"\b(?:forbid(?:s|den|ding)?|forbade|prohibit(?:s|ed|ing)?|disallow(?:s|ed)?|veto(?:es|ed)?|"
    r"verboten|taboo|banned|outlawed|(?:god|heavens?) forbid|off limits|out of bounds|no go area|"
    r"(?<!to )prevent(?:ing|s)?|refrain(?:ing)? from|abstain(?:ing)? from|desist from|cease \w+ing|"
    r"resist the urge|steer clear|shun|lest|beware of \w+ing|far be it|anything but|anywhere but|"
    r"nothing but|rather (?:die|you did not|not)|if i were you|you would not want to|"
    r"(?:just|only|was|am|i'm) (?:kidding|joking)|jk|"
    r"(?:hate|dread|detest|loathe)s? (?:it )?(?:for you|if you|you|that you|when you|to see you)|"
    r"object to (?:you|your)|refuse to (?:let|allow|have|permit)|"
    r"(?:no|lacks?|without|have not|not have) (?:the |any |my )?(?:permission|right|business)|"
    r"not (?:be )?(?:permitted|allowed|authori[sz]ed|supposed|meant|welcome|acceptable|okay|ok)|"
    rf"not (?:permit|allow|want|wish|like|let|have|authori[sz]e|approve|stand|tolerate)\b"
    rf"[^,.;:!?]{{0,20}}\b{_OTHERS}\b|"
    rf"(?:keep|stop|hinder|bar|ban|exclude) [^,.;:!?]{{1,40}} from (?:being |\w+ing\b)|"
    r"(?:by|under|at|on|in) no (?:means|circumstances|account|time|case|event)|no way|"
    r"the last thing|^(?:no ?one|nobody)\b|"
    r"(?:nobody|no one|noone|none) (?:of you )?(?:\w+ly )?(?:should|must|may|shall|"
    r"ought|can|could|is to|are to|is allowed|ever|goes?|takes?|picks?|puts?|brings?|touch(?:es)?|"
    r"moves?|walks?)|nicht|nichts|niemals|kein(?:e|en)?|niet|nooit|jamais|nunca|"
    r"untouched|unmoved)\b"
)
"""What forbids wherever it stands."""
_IN_ANY_CASE = re.compile(
    r"\bif i were you,? (?:i|then i) (?:would|could|should|might) (?:not|never)\b"
)
"""The same where the grammar has read every word."""
_NEGATES = re.compile(
    r"(?:^|[,.;:!?]|\b(?:and|but|or|please|pls|plz|robot|you|to|better|rather|so|just|then|one|sure|"
    r"thou|that|it|they|cup|is|be)\b)\W*"
    r"(?:(?:do|did|does|should|must|shall|may|might|ought|would|will|can|could|had better|"
    r"are to|is to|be)\s+)?(?:ever\s+)?(?:not|never)\b(?P<after>.*)"
)
"""What is told, with a "not" before it."""
_NO_ORDER = re.compile(
    r"^\W*(?:(?:ever|you|to|you to)\s+)?(?:forget|worry|hesitate|mind|hurry|rush|fret|panic|bother|"
    r"know|think|care|matter|see|seem|need|sure|only|just|yet|too|so|very|far|long|bad|at all|"
    r"enough|really|possible|urgent|here|there|be (?:shy|late|afraid|long|slow|silly)|have|fit|"
    r"find|reach|remember|understand|work|feel|like|able|want to|in|on|at|a|an|the|mine|my|"
    r"that|this|where|what|inconvenient|troubling|working|"
    r"happy|feeling|well|good|available|let me down|sound)\b"
)
_SELDOM = re.compile(r"\b(?:why|could|can|will|would|won't|are) (?:do )?(?:you )?(?:not )?$")
_STATES = re.compile(r"\b(?:i|we|he|she|it|they|there|this|that|who|which)\W+(?:\w+\W+)?$")
"""After one of these a negation tells of something: "it should not be there"."""
_ASKS = re.compile(
    r"\b(?:would|could|can|should|might|ought|is|are|was|were|will|has|have|had|does|did) not "
    r"(?:you|he|she|it|they|we|i|there)\b"
)
"""A question, or the tail of what was told: "wouldn't you say". "Don't you touch it" forbids."""
_TALKS = re.compile(
    r"^\W*(?:(?:please|robot|can you|could you|now)\W+)*(?:translate|spell|define|compose|recite|"
    r"summari[sz]e|rephrase|paraphrase|pronounce|write (?:me )?(?:an?|the|down|about))\b|"
    r"\b(?:is|was) what (?:\w+ ){1,3}(?:said|says|wrote|told|asked)\b|"
    r"\b(?:manual|book|sign|label|note|letter|newspaper|poster|text|article|it) (?:here )?"
    r"(?:says?|said|reads?|states?|claims?)\b|"
    r"\b(?:a|the|this|that) (?:story|book|film|movie|poem|song|dream|joke|novel|tale)\b.*\b"
    r"(?:in which|where|about|how)\b|\b(?:i|she|he|we) (?:dreamt|dreamed)\b|"
    r"\bonly (?:a|an|some) (?:\w+ )?(?:fool|idiot|madman|moron|lunatic)s?\b|"
    r"\b(?:robots|people|machines|those|whoever|anyone|anybody|everyone) (?:that|which|who)\b|"
    r"\b(?:hypothetically|imagine(?!\W*[!.,])|suppose|pretend|"
    r"the (?:word|phrase|sentence|order|command|words))\b.*\b(?:you|means?|is)\b"
)
"""What only speaks of an order. How an order is passed on ("Mum says bring it") is none."""
_CONTRACTED = re.compile(r"\b(do|does|did|should|must|would|could|need|is|are|was|have|has|ought|"
                         r"had|may|might)n'?t\b|\b(ca|wo|sha)n'?t\b")  # fmt: skip
_FULL = {"ca": "can not", "wo": "will not", "sha": "shall not"}
_TORN = re.compile(
    r"\bd\W?[o0]?\W?n\W?[o0]?\W{0,2}t(?:\W?t)?\b|\bd\W?[o0]\W+n\W?[o0]\W?t\b|\b"
    r"n[\W_]{1,2}o[\W_]{1,2}t\b"
    r"|(?:^|(?<=\s))n'?t\b"
)
"""Any way in which the letters of "don't" and "not" come apart or together."""
_WHOLE = re.compile(r"don'?t|don t|do not|do\s+not")
_LIKE = words(
    "not never dont donot cannot noone nobody mustnt shouldnt forbid forbidden avoid refrain "
    "prohibit prohibited without"
)
_SHORT = words("nto ont mot npt noy nof nog nkt n0t dnt dpt")
"""Of words so short only slips of the fingers count: "oot" is "out" to a Scot."""
_NONE = words("now note not noted nut nor dot lot hot got")
_AFTER_DO = re.compile(r"\b(?:do|must|should|shall|you) (\w{2,4})\b")
_ON_A_SIDE = re.compile(r"\bon the (?:far )?(left|right)\b")
_THEM = words("she he her him his they them their")
"""Ada, the cup, *she* wants it: who is spoken of is not spoken to."""
_WORD = re.compile(r"[^\W\d_]+")
_APART = re.compile(r"\b[a-z]+[';\"][a-z]+\b")
_NO_VERB = re.compile(r"^\W*(?:(?:please|pls|plz|you|robot|hey)\s+)*(?:no|nope|non)\s+(\w+.*)$")


def cautious(text: str, said: str, outcome: Outcome, vocabulary: Vocabulary) -> Outcome:
    """An outcome; a refusal or a question where what was lost of a text may forbid it.

    Args:
        text: What a person said.
        said: What of it, or in what other words, the grammar read.
        outcome: What came of that.
        vocabulary: The names of this world.
    """
    goals = () if isinstance(outcome, Refusal) else outcome.goals
    if not goals or all(isinstance(goal, _HARMLESS) for goal in goals):
        return outcome
    if isinstance(outcome, Question) and outcome.kind == "confirmation":
        return outcome
    heard = _plain(text)
    forbids = next(_forbidding(heard, _plain(said)), "")
    if forbids and not _is_kept(text, forbids, goals, vocabulary):
        return Refusal(reason=f"I heard “{forbids}”, and take it that I am not to do that.")
    doubt = next(_doubts(text, heard, said, goals, vocabulary), "")
    if not doubt:
        return outcome
    if isinstance(outcome, Question):
        return replace(outcome, question=f"I heard “{doubt}” as well. {outcome.question}")
    return just_that(text, Unpromised(f"I heard “{doubt}” and may get it wrong", goals))


def _forbidding(heard: str, said: str) -> Iterator[str]:
    """What forbids in a text and is not in what was read of it."""
    for found in _IN_ANY_CASE.finditer(heard):
        yield found.group()
    if said == heard:
        return
    for found in _FORBIDS.finditer(heard):
        if found.group() not in said:
            yield found.group()
    for found in _NEGATES.finditer(heard):
        before, after = heard[: found.start("after")], found["after"]
        word = re.split(r"\W+", before.strip())[-1]
        ahead = before[: -len(word) - 1]
        told = _STATES.search(ahead) or _SELDOM.search(ahead) or _NO_ORDER.match(after)
        told = told or _ASKS.search(found.group()) or (word == "or" and not after.strip(" .!?"))
        if not told and not re.search(rf"\b{word}\b", said):
            yield " ".join(found.group()[: found.start("after") - found.start()].split()).strip(
                " ,.;:!?"
            )


def _is_kept(text: str, forbids: str, goals: tuple[g.Goal, ...], vocabulary: Vocabulary) -> bool:
    """Whether what was forbidden is something else, named, that the goals keep away from."""
    named = [one for one in prohibitions(text, vocabulary) if forbids in _plain(one.said)]
    return bool(named) and not broken(goals, [text], vocabulary)


def _doubts(
    text: str, heard: str, said: str, goals: tuple[g.Goal, ...], vocabulary: Vocabulary
) -> Iterator[str]:
    """What may be a negation, or makes an order something that is talked about."""
    read = _plain(said)
    direct = read == heard
    no = _NO_VERB.match(heard)
    if no and direct and _is_all_forbidden(no[1]):
        yield "no"
    slips = list(_slips(text, index_of(vocabulary)))
    if direct:
        is_read = slips and not {"not", "never", "no"}.isdisjoint(Text(said, vocabulary).words)
        yield from () if is_read else slips  # a slip that was read as what it is harms nothing
        return
    yield from (one for one in slips if one not in read)
    told = " ".join(strings(goals))
    yield from (one for one in _WORD.findall(heard) if _is_lost_superlative(one, told))
    side = _ON_A_SIDE.search(heard)
    walks = any(isinstance(goal, g.GoTo | g.LookAt | g.Balance) for goal in g.each(goals))
    if side and side[1] not in told and not walks:
        yield side.group()
    yield from _called_first(text, goals, vocabulary)
    yield from _misplaced(text, goals)
    for found in _TALKS.finditer(heard):
        if found.group() not in read:
            yield found.group()
    if re.search(r"[\"“«].*\w.*[\"”»]\W*(?:is|was|were|means|said|says|sounds)\b", text):
        yield text.strip()


def _is_lost_superlative(word: str, told: str) -> bool:
    """Whether a word that singles one out of several was lost: "the *crustiest* loaf"."""
    most = lexicon.SUPERLATIVES.get((word,), word)
    return is_superlative(word) and most not in told and word not in told


def _misplaced(text: str, goals: tuple[g.Goal, ...]) -> Iterator[str]:
    """Where a thing was said to be, where it is read as "near" and that was not said."""
    said = [token.text for token in tokenize(text)]
    phrases = {tuple(said[at : at + size]) for at in range(len(said)) for size in range(1, 5)}
    hows = {how for phrase, how in lexicon.LOCATIVES.items() if phrase in phrases}
    for goal in g.each(goals):
        relation = getattr(getattr(goal, "object", None), "relation", None)
        if relation is not None and relation.how == "near" and hows and "near" not in hows:
            yield " ".join(max((p for p in phrases if p in lexicon.LOCATIVES), key=len))


def _called_first(text: str, goals: tuple[g.Goal, ...], vocabulary: Vocabulary) -> Iterator[str]:
    """Who is named ahead of an order that brings it to them; a place ahead of one elsewhere."""
    words = Text(text, vocabulary)
    match = words.name_at(0)
    where = match.of("place", "room") if match and words.word(match.end) == FULL_STOP else ""
    if match and where and where.lower() not in strings(goals):
        yield words.raw(0, match.end)  # the yard. Find Jonas
    who = match.of("person") if match else ""
    if not match or not who or words.word(match.end) != COMMA or _THEM.intersection(words.words):
        return
    receivers = [getattr(goal, "to", None) for goal in g.each(goals)]
    if any(isinstance(to, g.Person) and to.name == who for to in receivers):
        yield words.raw(0, match.end)


def _is_all_forbidden(after: str) -> bool:
    """Whether a "no" before some words forbids all they ask for: no sentence after it orders."""
    first, *others = (part.split() for part in re.split(r"[.;!?]", after))
    ordered = any(verbs_at(part, at) for part in others for at in range(min(2, len(part))))
    return bool(verbs_at(first, 0)) and not ordered


def _slips(text: str, names: NameIndex) -> Iterator[str]:
    """Words a slip away from a negation, as they were written."""
    plain = latin(bare(seen(text).replace("’", "'")))
    for found in _TORN.finditer(plain):
        if not _WHOLE.fullmatch(found.group()):
            yield found.group()
    for found in _AFTER_DO.finditer(plain):
        word = found[1]
        known = word in _NONE or (found.group().startswith("you") and word in KNOWN_WORDS)
        if not known and OSA.distance(word, "not") == 1:
            yield found.group()
    apart = [one.group() for one in _APART.finditer(plain) if not _CONTRACTED.match(one.group())]
    whole = re.sub(r"\b\w+n't\b", " ", plain)  # mustn't: that is read
    for word in (*_WORD.findall(whole), *(re.sub(r"\W", "", one) for one in apart)):
        if len(word) < 3 or word in KNOWN_WORDS or word in _NONE or word in _LIKE:
            continue
        near = any(abs(len(word) - len(no)) < 2 and OSA.distance(word, no) == 1 for no in _LIKE)
        near = near and (len(word) > 3 or word in _SHORT)
        if near and not is_english(word) and names.match([word], 0) is None:
            yield word


def _plain(text: str) -> str:
    """In lower case, with what is contracted in full, and one blank between words."""
    lower = latin(bare(seen(text).replace("’", "'").replace("`", "'").replace("´", "'")))
    full = _CONTRACTED.sub(lambda found: f"{found[1]} not" if found[1] else _FULL[found[2]], lower)
    return " ".join(re.sub(r"\bcannot\b", "can not", full).split())
