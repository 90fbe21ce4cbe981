"""Cries to stop, heard before anything is parsed.

Triggering once too often is cheap, missing is not: misspellings, drawn-out letters and other
languages count. Only the beginning and the end of a long text are looked at, so that no text
takes long.
"""

import re
from collections.abc import Iterator

from rapidfuzz.distance import OSA

from intents.cries import AROUND, STEMS_OF_STOPS, STOPS
from intents.english.words.dictionary import is_english
from intents.english.words.lexicon import words
from intents.letters import bare, latin, without_sequences
from intents.limited_stops import Surroundings
from intents.whole_cries import WholeCries

_LOOKED_AT = 240
"""Characters at either end of a long text: people cry first or last, and no text takes long."""
_READ = 2048
"""The same before what cannot be seen is left out: a paste may be full of it."""
_SHORT = 5
"""Up to so many words, a cry anywhere in them counts."""
_WORD = re.compile(r"[^\W_]+")
_SENTENCE = re.compile(r"[.!?\n\r¡¿。！…]")
_CLAUSE = re.compile(r"[.!?,;:\n\r¡¿。！、…]+|\s+-+\s+")
_TORN = re.compile(r"\bd\W?o?\W?n\W?o?\W{0,2}t(?=\s+move\b)")
"""However "don't" is written."""
_STOPS = words(
    "stop stopp stops stopit stopping halt freeze emergency estop abbruch anhalten notaus notstopp "
    "arrete arretez arreter alto detente detengase parate basta ferma fermo fermati fermatevi "
    "stanna stoi stoj zatrzymaj dur durun pysahdy stoppen stoppe стоп стой стойте 停 停止 停下 "
    "止まれ 止まって ストップ 멈춰 정지 توقف קף עצור σταματα mayday "
    "whoa woah cease desist"
)
"""Words that say stop."""
_PHRASES = (
    "do not move", "don't move", "dont move", "don t move", "e stop", "hold it right there",
    "let go of me", "hor auf", "not aus", "au secours", "cut it out", "abort everything",
    "that's enough", "kill switch", "red button", "you are hurting", "you're hurting",
    "get off me",
)  # fmt: skip
_NEAR = ("stop", "freeze", "emergency")
_OTHER_WORDS = words(
    "step steps shop top tops stow slop stoop strop atop spot stomp stock store story stove stool "
    "stone stood prop drop crop stp sop freezer freezes frozen breeze steep stow sto soap storm "
    "topp shops stories stoke"
)
"""Words that are a letter away from a cry and none themselves."""
_GLUED = re.compile(
    r"(?:stop|halt){2,}"
    r"|(?:stop|halt|freeze)(?:now|this|that|please|robot|right|there|here)"
    r"|.+(?<!dont)(?<!not)(?<!non)(?<!un)(?<!bus)(?<!back)(?<!pit)(?<!door)(?<!short)(?<!truck)"
    r"(?<!tab)(?<!asp)(?<!anti)(?:stop|halt|freeze)"
)
"""A cry that runs into what was typed before or after it ("go to thestop"), but for words."""
_BEFORE = words(
    "please robot hey no now just okay ok oh wait e you must should can could would will have to "
    "need got everything immediately abort i said say say's want for god s sake a an the and so "
    "yo hi listen quick quickly dear my goodness damn hell alright right well your will it "
    "emergency"
)
"""Words that may come before a cry."""
_NOT_A_CRY = re.compile(
    r"\b(?:do not|don'?t|never|without|not|did you|have you|when did|are you|bus|train|tram|"
    r"then|the|a|last|next|until i say|till i say|(?<=\w )i say|if i say|full)\s+(?:ever\s+)?$"
)
_ASKS = re.compile(r"^(?:why|when|where|how|what|who|did|do|does|have|has|are|were)\b")
_OF_QUESTION = re.compile(
    r"(?:^|\b(?:to|the|an?|next|last|first|your|my|bus|tram|train|truck|door|full|pit|you|i|we|they|"
    r"he|she|it|robots?|not|never|ever|say|says|saying|word|always|usually|or|and|really|then|"
    r"suddenly|just|was|is|why|when|where|how|what|who|(?<!do )(?<!doing )that|this|of|with|for)\s+"
    r"|\b(?:make|makes|made|let|lets|see|saw|help)\s+(?:\w+\s+){1,2})$"
)
"""Before a last "stop" these make it a part of what is asked: "why did *you* stop"."""
_AUXILIARY = re.compile(r"\b(?:do|does|did|can|could|will|would|should|shall|may|might|must)\b")
_ASKED = re.compile(
    r"\b(?:do|does|did|can|could|will|would|should)\b.*\b(?:hear|see|understand|listen|know|think|"
    r"mean|realise|realize|care|want|do|dare|notice|get)\b"
)
"""With a verb of its own the question is over: "did you *hear* me stop"."""
_TOO_OFTEN = re.compile(r"^how (?:many times|often|much louder)\b.*\bsay\s+$")
_SOUND = re.compile(
    r"a+h+|a+r+g+h*|o+h+|o+w+|e+k+|u+g+h+|(?:h[aeio]+){2,}h?|w+a+h*|n+o+|omf?g|oi+|"
    r"(?:god|jesus|christ|crap|shit|fuck|damn|crikey|help|lol|wtf|ffs|bloody|yikes|heavens)"
)
"""What is called out before a cry."""
_AGAIN = re.compile(
    r"\b(?:sto+p+|halt|freeze)[\s!.,]+(?:sto+p+|halt|freeze)\b(?!\s+(?:sign|button|by|at)\b)"
)
"""Said twice in a row it is a cry wherever it stands."""
_LETS_LIE = re.compile(
    r"^(?:do not|don'?t|don t) move\s+(?:the|my|our|his|her|their|any of|those|these)\s+"
    r"(?!robot|motors?\b|arms?\b|hands?\b|legs?\b|feet\b|foot\b|body\b|head\b|base\b|fingers?\b)\w"
)
"""Do not move *the cup*: a thing that is to stay where it is."""
_AT_HOME = re.compile(
    r"^\s+\w+ing\s+(?:your|his|her|the)\s+(?:little\s+|big\s+)?(?:sister|brother|mother|father|mum|mom|dad|"
    r"cousin|dinner|supper|lunch|food|homework)\b"
)
"""Stop *poking your sister* is said to a child."""
_GOES_ON = words("and then to the a an next every each last first this that bus train tram")
"""Before a last word "stop" these make it a step of a plan, or a noun."""
_WISHED = re.compile(
    r"^(?!.*\b(?:not|never|nobody|nor)\b|.*n't\b)(?:\w+\s+){0,2}(?:i|we)\b.{0,24}\b(?:like|love|want|need|"
    r"wish|order|command|tell|told|ask|asked|beg|prefer|instruct)\w{0,3}\s+(?:for\s+)?"
    r"(?:you|it|the robot|this thing)\s+to\s+$"
)
"""I would like you to *stop*."""
_ENDS = re.compile(
    rf"(?:(?:{'|'.join(sorted(_BEFORE))})\W+)*(?:"
    r"abort(?:\W+abort)+|(?:cut|kill) (?:the |your |all )?(?:power|motors?|engines?)|"
    r"(?:motors?|engines?|power) off|"
    r"(?:switch|turn|shut) (?:the |your )?(?:motors?|engines?|power) off|"
    r"(?:switch|turn|shut) off (?:the |your )?(?:motors?|engines?|power)|shutdown"
    r")(?: (?:now|please|right now|at once|immediately|robot))*"
)
"""What takes the power away, and nothing else said."""
_MAKE_IT = re.compile(
    r"\b(?:make|get) (?:it|him|her|this|that|the robot|this thing|that thing) (?:to )?stop"
    r"(?: (?:now|right|please|immediately|at once|already))*$"
)
_NO_WISH = re.compile(
    r"^(?:how|what|why|who|when|where|which)\b|\b(?:not|never|did|to (?:make|get))\b|n't\b"
)
_KEYS = ("qwertyuiop", "asdfghjkl", "zxcvbnm")
_CALLED = words("atop stoop strop slop sop stp storp stomp")
"""With its sign of exclamation, and alone, a slip; else a word."""
_ON_THE_WAY = re.compile(
    r"^\s*(?:by|at|in|over(?:\s+at)?|off|near|beside|outside|behind|next\s+to|in\s+front\s+of)\s+"
    r"(?:the|my|your|our|a|an|his|her)\b"
)
"""Stop *by the kitchen* is an errand."""
_A_THING = re.compile(r"\b(?:get|fetch|bring|take|grab|pick|find|put|place|move|use)\b.*\bdoor\s+$")
"""*Get the door* stop: a thing; "go to the door stop" is cried."""
_TO_THE_COLD = re.compile(r"^\s+(?:the|my|our|some|these|those)\s+(?!robot|motor|arm|hand|leg)\w")
"""Freeze *the leftovers*."""

_STAYING = (
    "stand still", "hold still", "keep still", "stay still", "be still", "stand there",
    "stand here", "stay there", "stay here", "stay put", "stay where you are", "stay right there",
    "stay right here", "stay right where you are", "stand where you are", "stop where you are",
    "remain there", "remain here", "remain where you are", "hold your position", "hold position",
    "don't go on",
    "do not go on", "don't walk", "do not walk", "stay",
)  # fmt: skip
"""Wishes that a robot stay where it is: a stop to one that moves, else a task."""
_AROUND = _BEFORE | words("right there here then thanks thank that's it stay")
"""Words that may stand around such a wish."""
_ABROAD = WholeCries(STOPS, stems=STEMS_OF_STOPS, around=AROUND)


def is_stay(text: str) -> bool:
    """Whether a text is nothing but a wish to stay, which ends what a robot is at.

    With a time in it ("stand still for 5 seconds") it is a task of its own.
    """
    if len(text) > _LOOKED_AT:
        return False
    clauses = [clause.strip() for clause in _CLAUSE.split(_plain(text)) if clause.strip()]
    stays = [_stays(clause) for clause in clauses]
    return any(stays) and all(
        stay or set(_WORD.findall(clause)) <= _AROUND
        for stay, clause in zip(stays, clauses, strict=True)
    )


def _stays(clause: str) -> bool:
    found = " ".join(clause.split())
    for phrase in _STAYING:
        before, said, after = found.partition(phrase)
        if said and set(_WORD.findall(before + " " + after)) <= _AROUND:
            return True
    return any(OSA.distance(found, phrase) == 1 for phrase in _STAYING if " " in phrase)


def is_stop(text: str, *, at_rest: bool = False) -> bool:
    """Whether a text is a cry to stop; errs towards yes, and takes well under a millisecond.

    Args:
        text: What was said or typed.
        at_rest: Whether it is said to a robot that has nothing to do. What hangs on something
            ("stop after 2 seconds") is a cry to a robot at work only.
    """
    if len(text) > 2 * _READ:
        text = f"{text[:_READ]} . {text[-_READ:]}"
    # What follows an escape may be meant as text, or as a part of a control sequence.
    return any(_is_cried(said, at_rest=at_rest) for said in {text, without_sequences(text)})


def _is_cried(text: str, *, at_rest: bool) -> bool:
    plain = _plain(text)
    if _ABROAD.cried(plain):
        return True
    if len(plain) > 2 * _LOOKED_AT:
        plain = f"{plain[:_LOOKED_AT]} . {plain[-_LOOKED_AT:]}"
    readings = {plain} if plain.isascii() else {plain, latin(plain)}
    return any(_is_stop(reading, at_rest=at_rest) for reading in readings)


def _is_stop(plain: str, *, at_rest: bool) -> bool:
    ahead: list[str] = []
    for clause, sign in _clauses(plain):
        around = Surroundings(ahead, at_rest=at_rest, exclaimed="!" in plain)
        if _cries(clause, around) or _ends_in_cry(clause, around):
            return True
        ahead = [] if _SENTENCE.search(sign) and not at_rest else [*ahead, clause]
    return _spelled_out(plain)


def _clauses(plain: str) -> Iterator[tuple[str, str]]:
    """Each clause, with the sign behind it."""
    at = 0
    for sign in _CLAUSE.finditer(plain):
        if clause := plain[at : sign.start()].strip():
            yield clause, sign.group()
        at = sign.end()
    if clause := plain[at:].strip():
        yield clause, ""


def _plain(text: str) -> str:
    """Lower case without accents and what cannot be seen."""
    for sign in "🛑⛔" if _WORD.search(text) else "🛑⛔✋🖐":
        text = text.replace(sign, " stop ")
    return _TORN.sub("don't", bare(text.replace("’", "'")))


_CRIES = frozenset(map(_plain, _STOPS))


def _cries(clause: str, around: Surroundings) -> bool:
    if any(clause.startswith(phrase) for phrase in _PHRASES) and not _LETS_LIE.match(clause):
        return True
    if _AGAIN.search(clause) and not (_NOT_A_CRY.match(clause) or _ASKS.match(clause)):
        return True
    if _ENDS.fullmatch(clause) or (_MAKE_IT.search(clause) and not _NO_WISH.search(clause)):
        return True
    if _is_slip(clause, around):
        return True
    found = list(_WORD.finditer(clause))
    for number, word in enumerate(found):
        if _is_cry(word.group()):
            if _is_meant(clause, word, around):
                return True
        elif number > 2 * _SHORT or (len(found) > _SHORT and not _leads_in(word.group())):
            return False
    return False


def _is_slip(clause: str, around: Surroundings) -> bool:
    """A cry that is a slip of the fingers from one, and nothing else said."""
    found = [word for word in _WORD.findall(clause) if not _leads_in(word)]
    if not found or len(set(found)) > 1:
        return False
    return found[0] in _SLIPS or (around.exclaimed and found[0] in _CALLED)


def _leads_in(word: str) -> bool:
    """Whether a word may come before a cry: "please", "aaah"."""
    return word in _BEFORE or _SOUND.fullmatch(word) is not None


def _ends_in_cry(clause: str, around: Surroundings) -> bool:
    """Bring me the red cup no stop now: without punctuation, the last words count."""
    found = list(_WORD.finditer(clause))
    for number in range(max(len(found) - 2, 1), len(found)):
        before = found[number - 1].group()
        bound = before in _GOES_ON and not _WISHED.search(clause[: found[number].start()])
        if before == "and" and number == len(found) - 1:
            bound = around.at_rest and not around.exclaimed
        cries = _is_cry(found[number].group()) and not bound
        if cries and _is_meant(clause, found[number], around):
            return True
    return False


def _is_meant(clause: str, word: re.Match[str], around: Surroundings) -> bool:
    if _GLUED.fullmatch(word.group()):
        return True  # what stands before it is no part of the cry
    before, after = clause[: word.start()], clause[word.end() :]
    if word.group() == "freeze" and _TO_THE_COLD.match(after):
        return False
    if word.group() == "stop" and _AT_HOME.match(after):
        return False
    if around.limit(before, after):
        return False
    if _ASKS.match(before) and not _asked_before(before, after):
        return False
    return not (_NOT_A_CRY.search(before) or _ON_THE_WAY.match(after) or _A_THING.search(before))


def _asked_before(before: str, after: str) -> bool:
    """What are you doing *stop*: whether a question is over before a cry at its end."""
    if not set(_WORD.findall(after)) <= _AROUND:
        return False
    if _TOO_OFTEN.match(before):
        return True
    if _OF_QUESTION.search(before):
        return False
    return not _AUXILIARY.search(before) or _ASKED.search(before) is not None


def _slips(word: str) -> Iterator[str]:
    """A word with one letter taken for its neighbour on the keyboard, or two letters swapped."""
    for at, letter in enumerate(word):
        yield from (word[:at] + near + word[at + 1 :] for near in _neighbours(letter))
        yield word[:at] + word[at : at + 2][::-1] + word[at + 2 :]
        yield word[:at] + letter + word[at:]


def _neighbours(letter: str) -> set[str]:
    row = next(number for number, keys in enumerate(_KEYS) if letter in keys)
    at = _KEYS[row].index(letter)
    beside = {_KEYS[row][at - 1 : at], _KEYS[row][at + 1 : at + 2]}
    above = _KEYS[row - 1][at : at + 2] if row else ""
    below = _KEYS[row + 1][max(at - 1, 0) : at + 1] if row < 2 else ""
    return (beside | set(above) | set(below)) - {""}


_SLIPS = frozenset(
    one
    for cry in ("stop", "halt", "freeze", "abort")
    for one in (*_slips(cry), "hault", "holt", "stahp")
    if one not in ("abort", "half", "haft") and one not in _OTHER_WORDS and not is_english(one)
)


def _is_cry(word: str) -> bool:
    if word in _CRIES or _GLUED.fullmatch(word):
        return True
    short = re.sub(r"(.)\1+", r"\1", word)
    if short in ("stop", "halt", "freze"):
        return word not in _OTHER_WORDS
    if word in _OTHER_WORDS or not 3 < len(word) < 11 or word[0] not in "sfe":
        return False
    return any(abs(len(word) - len(c)) < 2 and OSA.distance(word, c) == 1 for c in _NEAR)


def _spelled_out(plain: str) -> bool:
    """S T O P, st.op; abort! abort!"""
    if re.fullmatch(r"\W*(?:abort\W+)+abort\W*", plain):
        return True
    alone = re.sub(r"[\W_]+", "", plain) in ("stop", "halt", "freeze")
    return alone or re.match(r"\W*s\W+t\W+o\W+p\b", plain) is not None
