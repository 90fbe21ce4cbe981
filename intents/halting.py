"""Cries that a robot at work halts for at once, and asks after: wait, no, careful, not that.

They end nothing, so one too many costs a question. Whoever moves halts for a short utterance that
says wait, hold, no, don't, careful, enough or not that, or warns of what is about to happen. What
names an errand of its own ("hold the cup", "wait for me at the door", "don't forget the box", "no
rush, bring me the book") is none. To a robot that stands most of these are words like any others,
so only a robot at work is asked about them (:mod:`intents.stopping` is for both).
"""

import re

from rapidfuzz.distance import OSA

from intents.cries import AROUND, HALTS, STEMS_OF_HALTS
from intents.english.words.lexicon import words
from intents.english.words.verbs import verbs_at
from intents.letters import bare, without_sequences
from intents.whole_cries import WholeCries

_LOOKED_AT = 240
"""Characters: a longer text is no cry."""
_MOST_WORDS = 9
"""Of a clause: "careful, the glass is about to fall off that table" is cried, an essay is not."""
_CLAUSE = re.compile(r"[.!?,;:\n\r¡¿。！、，…]+|\s+-+\s+|\s*–\s*")
_WORD = re.compile(r"[^\W_]+")
_ADDRESS = words(
    "hey hi yo oi oh ah ahh aah ok okay please robot now just listen sorry excuse me well right "
    "aye alright and but so um uh er god jesus christ damn shit man mate buddy dude"
)
"""What may be called out before a cry."""
_SHORT_TIME = r"(?:moment|minute|min|second|sec|mo|tick|jiffy)s?"
_MANNERS = words("please now robot thanks thank you already ok okay man mate sir buddy")
"""What may follow a cry."""
_IDLE = _ADDRESS | _MANNERS
_SUBJECT = r"(?:you|youre|it|its|he|she|they|(?:the|that|my|your) \w+(?: \w+)?)"
_HARM = (
    r"(?:hit|fall|drop|break|spill|crash|bump|hurt|knock|trip|burn|scratch|crush|collide|tip|slip|"
    r"squash|smash|topple|kick|damage|kill|stumble|lose|(?:walk|run|step) (?:into|on|over|off))\b"
)
_HARMING = (
    r"(?:hitting|falling|dropping|breaking|spilling|crashing|bumping|hurting|tripping|burning|"
    r"scratching|crushing|tipping|slipping|leaking|squashing|kicking)\b"
)

_TO_THINGS = (
    r"(?:drop(?:ping)?|break(?:ing)?|spill(?:ing)?|los(?:e|ing)|damag(?:e|ing)|smash(?:ing)?|"
    r"squash(?:ing)?|scratch(?:ing)?|tip(?:ping)?|topp(?:le|ling))"
)
"""Harm to what is carried; where somebody may be hurt, to stop is always a fair guess."""
_CARE = re.compile(
    r"(?:^|(?<![\s,;.!?–-])[\s,;.!?–-]++)"
    r"(?:(?:and|but|so|just|please|pls|plz|be careful|careful|mind)[\s,]{1,3}){0,4}"
    r"(?:do ?n[o'’]?t|do not|dnt|never|try not to|(?:so )?you (?:do ?n[o'’]?t|do not)|without)\s+"
    rf"(?:(?:you|ever|dare|go and|to)\s+){{0,2}}{_TO_THINGS}\b[^,;.!?\n]*",
    re.IGNORECASE,
)
"""And *dont drop it*, without *spilling it*: what the robot takes care of in any case."""
_SIGHTS = (
    r"(?:child|kid|baby|person|somebody|someone|dog|cat|man|woman|girl|boy|toddler|animal|pet|hole|"
    r"step|stairs?|cable|wire|puddle)"
)
_PATTERNS = (
    # wait; "wait for me at the door", "wait in the hall", "wait ten seconds" are errands
    r"wait",
    rf"wait (?:(?:just |for )?(?:a|one)|half a) (?:{_SHORT_TIME}|bit|while|little)\b.*",
    r"wait (?:for (?:me|us|him|her|it|them|that|this)|until .*|till .*)",
    r"wait (?!(?:for|in|at|by|near|next|outside|inside|behind|beside|on|over|with|and|then|about|"
    r"around|under|until|till|(?:a|an) (?:hour|quarter)|half|\d+|one|two|three|four|five|six|"
    r"seven|eight|nine|ten|fifteen|twenty|thirty|forty|sixty)\b).*",
    rf"(?:(?:hold|hang) on|hang about|(?:just |only |give me )?(?:a|one|half a) {_SHORT_TIME})"
    r"(?: (?:please|wait|hold|hang|i|you|that|there|no|not|stop|what|let|robot|before|we|it|now|a"
    r"|just|one|for)\b.*)?",
    r"(?:hold|stand) (?:fast|by|down|clear)|hold|stp|sto|stap|stahp|sotp",
    r"hold (?:(?:it|it )?(?:right )?there|it|up|everything|your \w+|the phone|the line|steady|"
    rf"back|off)(?: (?:will you|would you|(?:for )?(?:a|one) {_SHORT_TIME}|(?:you|i|thats) .*))?",
    r"steady(?: (?:on|now|there))?|easy(?: (?:now|there|does it|tiger|boy|girl|easy|on|on there))?|"
    r"gently|gentle|hold (?:your )?fire|back (?:it )?up|ease (?:off|up)|leave off|give over|"
    r"pack (?:it|that) in|cut (?:it|that|this) out.*|"
    r"(?:not|no) (?:(?:a|one|another|an|single)(?: single)? )?"
    r"(?:(?:more )?(?:step|inch|move|word|centimet(?:re|er)|millimet(?:re|er)|foot|metre|meter)s?"
    r"(?: (?:more|further|farther|closer|nearer))?|further|farther|closer|nearer)",
    r"time ?out|hands off.*|slow down.*|slower",
    r"(?:not so|too|way too|much too) (?:fast|close|far|hot|hard|high|low|near|rough|quick|loud|"
    r"dangerous|much|quickly).*",
    # no; "no rush", "no problem", "no cups there" say something else
    r"(?:no+|nope|nah|nay|non|nein)(?: (?:no+|nope))*(?: (?:not|dont|do|never|that|thats|this|its?"
    r"|you|youre|im?|wait|stop|please|way|more|the|he|she|they|we|theres?|wrong|put|leave|take|go"
    r"|come|bring|turn|walk|thanks?|robot|hold|hang|careful|oh|god|look|watch|stay|get|back|use"
    r"|give|mine|sorry|in|on|to|over|other|red|blue|green)\b.*)?",
    # don't; "don't forget", "don't worry", "don't stop" wish it to go on
    r"(?:dont|do not|never|(?:you )?must ?not|(?:you )?mustnt|cannot|you cant|you cannot)"
    r"(?: (?!(?:forget|worry|stop|hurry|rush|wait|mind|pause|hesitate|bother|ask|halt|know|care|"
    r"be (?:shy|late|afraid|long|slow)|give up|you (?:have|know|see|want|need)|let me down)\b)"
    r".*)?",
    # not that; "not at all", "not bad" are answers
    r"not(?: (?!.* but |at all|far |bad|too bad|a problem|sure|only|much|just|everyone|everybody|"
    r"enough)\b.*)?",
    # that is wrong, that is enough
    r"(?:that|this|it|thats|its)(?: s| is)? (?:not (?!enough|bad|far|all)|(?:the )?wrong|enough|"
    r"too|dangerous|no good|mine\b|hot|bad|incorrect|a mistake|far enough|close enough).*",
    r"wrong(?: \w+)?|no more.*|nothing more|(?:that ll|thatll|that will|this will) do.*",
    r"(?:(?:that|it)(?:s| is| s) )?(?:(?:quite|far|close|near|more than|just about) ){0,2}enough"
    r"(?: (?:now|already|of (?:that|this|it)|is enough|enough|for now))*",
    # ends a task; the line is then read for what is to end
    r"(?:cancel|abort|quit|pause|interrupt|cease|desist|abandon|terminate|scrap|scratch|drop|"
    r"finish|end|leave|forget|cut|call off|give up|kill|break off|suspend|undo|belay)"
    r"(?: (?:it|that|this|everything|all|out|off|there|alone|now|be|about|him|her|them|me|"
    r"(?:(?:the|this|that|your|my) )?(?:mission|task|job|action|plan|movement|walk|motion|run|"
    r"order|command|request|operation)|what you are doing))*",
    r"never ?mind.*|call it off|knock it off.*|cut it out.*|give it a rest|quit \w+ing.*",
    r"(?:power|shut|switch|turn)(?: (?:it|yourself|everything))? (?:off|down)",
    r"let go(?: of (?:it|that|this|me|him|her|them|us|my \w+))?|let (?:me|him|her|it) go",
    # careful, watch out; "watch me", "look out of the window" are errands
    r"(?:(?:just |do |very |more |so )?be |very |more )?careful+(?: .*)?",
    r"(?:watch|look) (?:out|it)(?: (?!(?:of|the window|through|a window|at|over)\b).*)?",
    r"(?:watch|mind|beware of|beware)(?: (?:yourself|out|(?:the|my|your|his|her|their|that|those|"
    r"this|these|our) \w+(?: \w+)?))?",
    r"(?:watch|look|mind) where .*|eyes open|nobody move.*|do nothing|bear with me|gently does it|"
    r"pause(?: (?:for )?(?:a|one) .*)?|i (?:have )?changed my mind",
    r"i (?:do not|dont|did not|didnt) .*",
    r"heads up|(?:behind|above|below|beside|in front of) you|on your (?:left|right)",
    r"(?:back off|(?:get|stay|keep|stand) (?:off|away|back|clear))(?: (?:from|of) .*)?",
    # what is about to happen, and what has
    rf"{_SUBJECT}(?: (?:are|re|is|s))? (?:(?:just )?(?:going to|gonna|about to)|will|ll) {_HARM}.*",
    rf"(?:youll|itll) {_HARM}.*|{_SUBJECT}(?: (?:are|re|is|s))? {_HARMING}.*",
    r"(?:you|youre)(?: are| re)? (?:hurting|scaring|dropping|spilling|too|in the way|on my|on the "
    r"wrong|going the wrong|standing on|falling|tipping|leaning|taking the wrong|holding my|"
    r"blocking|pushing|not supposed|not allowed).*",
    r"there(?:s| is| are| s)? .*(?:in front of|behind|beneath|below|under|next to|beside|near|over)"
    r" you",
    r"(?:you|youre)(?: are| re)? \w+ing (?:on|my|me|it|him|her|too|into|over|against) ?.*",
    r"(?:you|youve|you have|you ve) (?:got the wrong|missed|forgot|dropped|broke|hit|hurt)\b.*",
    r"(?:that|it|this) hurts.*",
    r"(?:the|my) \w+ is right (?:there|here|behind|in front|next|beside).*",
    rf"there(?:s| is| s)? (?:(?:a|an|the|my|some) )?{_SIGHTS}\b.*",
    r"(?:ouch|ow+|oops|oopsie|whoops|yikes|ahh+|aah+|argh+|eek|uh oh|oh no+|oh god|my god|"
    r"oh my god|oh shit|oh dear|danger|dangerous|fire|attention|sos|hazard|collision|help help|yo)"
    r"(?: .{0,12})?",
)
"""Clauses that are a cry from end to end, letter signs left out."""
_UNMISTAKABLE = re.compile(
    r"^(?:not|no) (?:a |one |another )|^no further|enough$|your horses$|hold (?:your )?fire"
)
"""What is said to nobody but who does something."""
_PACE = re.compile(r"(?:slower|slow down)\b")
"""What is about how fast, and asks for no stop of who does nothing."""
_CRIES = tuple(re.compile(pattern) for pattern in _PATTERNS)
_EXCLAIMED = re.compile(r"^\W*(?:help|fire|hey|oi|robot|danger|down|back)\s*!", re.IGNORECASE)
"""With its sign of exclamation a cry; without it, a word that commands begin with."""
_SCOTS = {
    "haud": "hold", "hud": "hold", "yer": "your", "nae": "no", "dinnae": "dont", "dinna": "dont",
    "cannae": "cannot", "mair": "more", "wheesht": "enough", "aff": "off",
}  # fmt: skip
_KEYWORDS = ("wait", "careful", "enough", "hold on", "watch out", "look out", "hang on", "pause")
_OTHER_WORDS = words("want what waist watt wet bait gait waits waiter waiting weight")
_NO = re.compile(
    r"^(?:(?:oh|no+|nope|wait|hold on|hang on)\b\s*+)+"
    r"(?!not\b|don|way\b|more\b|further\b|farther\b|closer\b|nearer\b|another\b|one more\b)",
    re.IGNORECASE,
)
"""*No* the blue one."""
_DRAWN_OUT = re.compile(r"(\w)\1{2,}")
_ABROAD = WholeCries(HALTS, stems=STEMS_OF_HALTS, around=AROUND)


def is_halt(text: str) -> bool:
    """Whether a text is a cry that a robot at work halts for, before it asks what is meant."""
    if len(text) > _LOOKED_AT:
        return False
    plain = bare(without_sequences(text).replace("’", "'"))
    if _EXCLAIMED.match(plain) or _ABROAD.cried(plain):
        return True
    clauses = [found for one in _CLAUSE.split(plain) if (found := _words_of(one))]
    while clauses and _is_address(clauses[0], last=len(clauses) == 1):
        del clauses[0]
    return bool(clauses) and _is_cry(clauses[0])


def without_care(text: str) -> str:
    """A text without what it asks to take care of: *the red one, please*, and dont drop it."""
    return _CARE.sub("", text)


def is_insistent(text: str) -> bool:
    """Whether a cry to halt is one to whoever hears it, be they under way or not.

    It is called out, said more than once or in more than one way, and asks for nothing else.
    """
    if not is_halt(text) or besides(text):
        return False
    clauses = [found for one in _CLAUSE.split(bare(text)) if (found := _words_of(one))]
    cries = [one for one in clauses if _is_cry(one) and not _PACE.match(" ".join(one))]
    if not cries:
        return False
    plain = any(_UNMISTAKABLE.search(" ".join(one)) for one in cries)
    return plain or "!" in text or len(cries) > 1 or any(_once(one) != one for one in cries)


def besides(text: str) -> str:
    """What a cry to halt says besides: *the hall* in "wait, the hall"; empty if it is all cry."""
    clauses = [one.strip() for one in _CLAUSE.split(text) if _WORD.search(one)]
    left = [one for one in clauses if not is_halt(one) and set(_words_of(bare(one))) - _IDLE]
    if left or not clauses:
        return ", ".join(left)
    return _NO.sub("", clauses[-1]) if _NO.match(clauses[-1]) else ""


def _words_of(clause: str) -> list[str]:
    """The words of a clause, with what is written with an apostrophe as one."""
    joined = re.sub(r"(?<=\w)'(?=\w)", "", clause)
    said = [_DRAWN_OUT.sub(r"\1", word) for word in _WORD.findall(joined)]
    return [plain for word in said for plain in _SCOTS.get(word, word).split()]


def _once(clause: list[str]) -> list[str]:
    """Wait *wait wait*; hold it *hold it*: a clause without what is only said again."""
    for size in range(1, len(clause) // 2 + 1):
        times, rest = divmod(len(clause), size)
        if not rest and clause == clause[:size] * times:
            return clause[:size]
    return clause


def _is_address(clause: list[str], *, last: bool) -> bool:
    """Hey, robot; Juno, wait."""
    return not last and (set(clause) <= _ADDRESS or (len(clause) == 1 and not _is_cry(clause)))


def _is_cry(clause: list[str]) -> bool:
    if len(clause) > _MOST_WORDS:
        return False
    clause = _once(clause)
    begins, end = [0], len(clause)
    while begins[-1] < end - 1 and clause[begins[-1]] in _ADDRESS:
        begins.append(begins[-1] + 1)
    if 1 < end < 4 and not verbs_at(clause, 0):
        begins.append(1)  # Juno wait
    while end > 1 and clause[end - 1] in _MANNERS:
        end -= 1
    said = [" ".join(clause[at:to]) for at in dict.fromkeys(begins) for to in {end, len(clause)}]
    return any(pattern.fullmatch(one) for one in said for pattern in _CRIES) or any(
        _is_misspelt(one) for one in said
    )


def _is_misspelt(said: str) -> bool:
    """Wiat, carefull, hodl on: letters that changed places, or one doubled or left out."""
    if said in _OTHER_WORDS or len(said) < 4:
        return False
    return any(
        sorted(said) == sorted(word) or (len(word) > 5 and _is_near(said, word))
        for word in _KEYWORDS
        if said[0] == word[0]
    )


def _is_near(said: str, word: str) -> bool:
    return OSA.distance(said, word, score_cutoff=1) <= 1
