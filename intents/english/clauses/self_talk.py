"""What the robot can tell of itself: its state, and small talk."""

import re
from collections.abc import Iterator
from functools import lru_cache

from intents.english.words import lexicon
from intents.english.words.lexer import COMMA
from intents.english.words.text import Text
from intents.goals import Goal, Report, ReportTopic, Say

_NOW = (
    r"(?: (?:right )?now| just| at the moment| currently| just now| then| yet| so far| again| there"
    r"| here"
    r"| today)*"
)
_PATTERNS: tuple[tuple[ReportTopic, str], ...] = (
    ("operator", r"(?:where|whereabouts|where in \w+ \w+) (?:am i|i am|do i stand|are we|we are)"
                 r"(?: standing)?|what is my (?:position|location|place)"),
    ("remaining", r"(?:for )?how long have you (?:been|waited|stood|had)\b.*|since when .*"),
    ("holding", r"(?:in )?(?:which|what) hand\b.*"),
    ("health", r"(?:the |your )?(?:battery|power|charge|motors?|sensors?|joints?|system|health)"
               r"(?: (?:state|status|level|condition|charge|check|health|temperatures?))+"),
    ("remaining", r"(?:and )?how (?:much|many) (?:longer|more|time|seconds|minutes)\b"
                  r"(?: (?:time|seconds|minutes|is|are|do|will|does|it|that|this|you|need|take|be"
                  r"|left|remaining|to|go|still|until|the|job|task|have|there|for|are|done|ready|finished"
                  r"))*"),
    ("remaining", r"how (?:long|far)(?: (?:is|are|will|does|do|it|that|this|you|need|take|be|left"
                  r"|to|go|still|until|the|job|task|for|done|ready|finished|there|away|more|till|have"
                  r"|got|way))*"),
    ("remaining", r"what (?:time|distance) (?:is|remains)(?: (?:left|remaining|to go))?"
                  r"|(?:what is the )?(?:time|distance|eta)(?: (?:left|remaining|to go))"
                  r"|(?:what is (?:the|your) )?eta|what is left(?: to do| of it)?"
                  r"|what (?:remains|is (?:next|still to do|to be done))(?: to do)?"),
    ("remaining", r"when (?:will|are|is|do|does) (?:you|it|that|this|the (?:job|task))\b"
                  r"(?: (?:be|get|finish|end|done|ready|finished|over|there|through|back|arrive"
                  r"|complete))+"),
    ("remaining", r"(?:are|is) (?:you|we|it|that) (?:nearly |almost )?(?:there|done|over|finished"
                  r"|ready)(?: soon| yet| already)+|(?:are|is) (?:you|we) (?:nearly|almost)? ?there"
                  r"|(?:nearly|almost) (?:done|there|finished|ready)"),
    ("why", r"(?:explain|account for|justify) yourself"),
    ("why", r"what (?:stopped|made) you(?: \w+){0,2}"),
    ("why", r"what (?:is|was) the reason (?:that |why |for )?.*"),
    ("why", r"why (?:it|that|this) (?:did not|does not|has not|is not|was not|failed|stopped).*"),
    ("capabilities", r"(?:what are )?(?:all )?(?:your (?:skills|abilities|capabilities"
                     r"|functions)|my options)"),
    ("holding", r"(?:are|is) your (?:hands?|grippers?|arms?) (?:empty|full|free)"),
    ("holding", r"(?:the|that|any|every)? ?(?:thing|things|object|objects|item|items) "
                r"(?:that )?(?:you are|are you) (?:holding|carrying)"),
    ("seeing", r"(?:what|which)(?: \w+)? (?:is|are) (?:visible|in front of you|around you"
               r"|in sight)(?: to you| for you)?"),
    ("seeing", r"(?:do|can) you see (?:anything|something|any objects?)"),
    ("location", r"(?:whereabouts|where in \w+ \w+|where exactly) (?:are you|you are)"),
    ("status", r"(?:what|which) (?:task|job|mission|step) are you (?:on|at|doing|working on)"),
    ("status", r"is (?:the|your) (?:task|job|mission|work) (?:done|finished|complete"
               r"|completed|over)"),
    ("health", r"(?:is |are )?(?:anything|something|everything) (?:wrong|broken|okay|fine"
               r"|alright|all right) with you"),
    ("why", r"(?:why|how come|for what reason|what made you)\b.*\b(?:you|your)\b.*"),
    ("why", r"(?:why|how come)(?: not| is that| (?:did|does|has|is) (?:it|that|this)\b"
            r"(?! (?!so\b|too\b|not\b)\w+ (?:so|too|such|that)\b).*)?"),
    ("why", r"what(?: is| was)?(?: the)? (?:matter|problem|wrong|reason|trouble"
            r"|error)(?: with you)?"),
    ("why", r"what (?:was that|(?:has )?(?:happened|went wrong|gone wrong|broke))"
            r"(?: there| to you| with you| here)?"),
    ("capabilities", r"(?:what|which)\b.*\b(?:you|i)\b.*\b(?:able to do|capable of|good at"
                     r"|say|ask you"
                     r"|tell you(?: to do)?|know how to do|ask you to do|ask of you"
                     r"|ask you for)"),
    ("capabilities", r"what(?: else| all)?(?: things| tasks)? (?:can you|you can"
                     r"|could you) do(?: for me| here)?"),
    ("capabilities", r"(?:what|which)(?: kinds? of| sorts? of)? (?:commands?|things|tasks"
                     r"|words|sentences|orders"
                     r"|requests|skills)\b.*\byou\b.*(?:understand|know|do|have|follow|obey"
                     r"|ask you)"),
    ("capabilities", r"(?:what do you understand|what are your (?:skills|abilities"
                     r"|capabilities|functions)"
                     r"|how can you help(?: me| us)?|who are you|what are you|help(?: me)?)"),
    ("holding", r"(?:(?:what|which|are|is|do|have|did|anything|whatever)\b.*)?\b(?:you"
                r"|your)\b(?! (?:can|could|should))"
                r".*\b(?:holding|hold|carrying|carry|gripping|grasping|clutching)"
                r"(?: anything| something)?(?: there)?(?: in (?:your|the) (?:\w+ )?(?:hands?"
                r"|grippers?|arms?))?"),
    ("holding", r"(?:what|which|are|is|do|have|did|anything)\b.*"
                r"(?:in|inside|inside of|within) (?:your|the robot 's|the) (?:\w+ )?"
                r"(?:hands?|grippers?|fingers?)"),
    ("holding", r"(?:what|anything|something) (?:have you|you have|do you have|you|have you got)"
                r" (?:in hand|in hands|at hand)"),
    ("holding", r"what (?:did you pick up|have you (?:picked up|got)|you (?:have|are) got)"),
    ("status", r"(?:what|how) is (?:currently |just )?(?:going on|happening|up|new)"),
    ("status", r"(?:what|how|where)\b.*\b(?:(?:are|were|have) you|you (?:are|were|have)) "
               r"(?:currently |just )?"
               r"(?:doing|up to|busy with|working on|going|going on|heading|far|far along"
               r"|doing there)"),
    ("status", r"how far (?:along )?(?:are you|have you (?:got|come))"),
    ("status", r"(?:are|have|were|did) you\b(?: \w+)? ?(?:done|finished|ready|busy|working"
               r"|finish|complete|completed)"
               r"(?: it| that| with (?:it|that|the task))?"),
    ("status", r"(?:what is )?(?:the|your)(?: current)? (?:status|progress|task|job|mission)"
               r"|how is it going"),
    ("seeing", r"(?:(?:what|which)\b.*|anything |everything )?(?:do you|can you|you can|you"
               r"|are you|you are able to"
               r"|are you able to) (?:can |currently )?(?:see|seeing|looking at|look at"
               r"|perceive|detect|observe|recognize)"
               r"(?: around you| in front of you| from there| (?:from )?over there| from here"
               r"| from where you (?:are|stand))?"),
    ("seeing", r"what is (?:in front of you|around you|in (?:your )?view|in sight|before you)"),
    ("location", r"(?:in |at )?(?:where|which (?:room|place|spot)|what (?:room|place"
                 r"|spot))\b(?: \w+)?"
                 r" (?:are you|you are|do you stand|are you standing|are you in|are you at"
                 r"|you are in|you stand)(?: in| at| standing)?"),
    ("location", r"(?:where|whereabouts) (?:you|are you|you are) ?(?:at|to|now)?"),
    ("location", r"(?:what is )?your (?:current |present )?(?:position|location|pose|whereabouts"
                 r"|coordinates)"),
    ("health", r"(?:how|what|is|are|do|does|did|have|has)\b.*\b(?:you|your|everything"
               r"|anything|something)\b.*"
               r"\b(?:battery|batteries|charge|charged|charging|recharging|okay|alright|fine"
               r"|broken|joints?|motors?|hot|warm"
               r"|overheat|overheating|overheated|feel|feeling|healthy|health|well|tired|hurt"
               r"|damaged|injured|temperature"
               r"|errors?|faults?|power|malfunctioning|wrong|in order|all right"
               r"|low)(?: level)?(?: left| full| working)?"),
    ("health", r"how (?:are you|you are|do you do)(?: doing| feeling)?(?: robot)?"),
    ("location", r"are you (?:in|at|near|by) (?:the|my) \w+(?: \w+)?"),
    ("health", r"(?:how|what)\b.*\b(?:battery|batteries)\b.*|(?:your )?(?:battery"
               r"|health)(?: level| status)?"),
)  # fmt: skip
_ABOUT_ROBOT: tuple[tuple[ReportTopic, re.Pattern[str]], ...] = tuple(
    (topic, re.compile(rf"(?:{pattern}){_NOW}")) for topic, pattern in _PATTERNS
)
"""Questions about the robot, in order: the first pattern that fits a whole clause counts."""
_LONGEST = 14
_LINKS = lexicon.words("and then but also")
_ASKING = lexicon.words(
    "what which who whose where when why how whereabouts are is do does did can have has will"
)
_SMALL_TALK = lexicon.words(
    "what which is it the a an of today tomorrow day time date week month year current now this "
    "joke something funny about yourself your team teams 's name country affiliation leader are "
    "you who me in right be to tell"
)
_SMALL_TALK_HEADS = lexicon.words("time day date joke yourself name affiliation country something")


def about_robot(text: Text, at: int) -> tuple[list[Goal], int] | None:
    """What are you holding? How are you? What can you do?"""
    if text.words[at - 1 : at + 2] == [COMMA, "you", "see"] and at + 2 >= len(text):
        return None  # I am thinking of jam, you see
    end = at
    while end < len(text) and text.word(end)[0].isalnum() and end <= at + _LONGEST:
        end += 1
    if any(text.lookup(lexicon.SUPERLATIVES, n) for n in range(at + 1, end)):
        return None  # the heaviest thing you can see
    for stop in _ends(text, at, end):
        topic = _topic(" ".join(text.words[at:stop]))
        if topic and not (topic == "health" and _of_a_thing(text, at, stop)):
            return [Report(topic=topic)], stop
    return None


def _of_a_thing(text: Text, at: int, end: int) -> bool:
    """How many batteries are there? Of the robot's own it is "your battery"."""
    named = ((n, text.name_at(n)) for n in range(at, end))
    return any(
        name and name.of("object", "category") and text.word(n - 1) != "your" for n, name in named
    )


def _ends(text: Text, at: int, end: int) -> Iterator[int]:
    """Where a question may end: before another one that is linked to it, else as late as it can."""
    links = [link for link in range(at + 1, end) if text.word(link) in _LINKS]
    for link in links:
        following = link + 1 + (text.word(link + 1) in _LINKS)
        if text.word(following) in _ASKING:
            yield link
    if end > at:
        yield end
    yield from reversed(links)


@lru_cache(maxsize=256)
def _topic(said: str) -> ReportTopic | None:
    return next((topic for topic, pattern in _ABOUT_ROBOT if pattern.fullmatch(said)), None)


def small_talk(text: Text, at: int, end: int) -> Say | None:
    """The time, a joke, something about itself: what the robot can tell without looking."""
    words = text.words[at:end]
    known = bool(words) and all(w in _SMALL_TALK for w in words)
    if known and any(w in _SMALL_TALK_HEADS for w in words):
        return Say(what=text.raw(at, end))
    return None
