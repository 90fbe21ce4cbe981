"""A sentence as a network says it again, and whether its words or the grammar's are acted on.

The network (:mod:`intents.english.paraphrase`) makes no goals: it says the sentence in plain
words, and how sure it is of them; the grammar reads those. Which of the two readings is to be
acted on, or whether neither is, was learnt (:mod:`intents.english.learnt.choice`): also where the
grammar read every word, unless that is likely enough by itself.
"""

import re
from collections.abc import Callable, Sequence

from intents.english.faithfulness import numbers
from intents.english.learnt.choice import SILENT, Both, Kind, Name, Side, alone, choice, lost
from intents.english.learnt.field import LEARNT, Fields
from intents.english.learnt.plainness import is_plainly_put, plainness
from intents.english.learnt.sight import Sight, sight
from intents.english.learnt.trust import Reading, is_known, trust
from intents.english.learnt.trust import Source as Words
from intents.english.paraphrase.paraphrasing import ASK, NOTHING, Heard
from intents.english.paraphrase.source import units, words_of
from intents.english.trouble import (
    Doubtful,
    Idle,
    NotUnderstood,
    Offered,
    Partly,
    Unasked,
    Unpromised,
)
from intents.english.words import lexicon
from intents.english.words.limits import CONDITIONS, MEASURES
from intents.english.words.measures import number
from intents.english.words.names import NameIndex
from intents.english.words.reporting import is_reported
from intents.goals import (
    Answer,
    Cancel,
    Goal,
    If,
    LookAt,
    Pause,
    Report,
    Say,
    Stop,
    Tell,
    Wait,
    each,
)
from intents.outcomes import Goals, Outcome, Question, Refusal
from intents.second_look import (
    LONGEST,
    Attempt,
    Grammar,
    is_plain,
    is_settled,
    just_that,
    only_asks,
    remarked,
)

SURE, LIKELY = 0.7, 0.35
"""From the first on the network's reading is acted on, from the second on it is asked about, where
the grammar could not read every word: to act wrongly is three times as bad as to ask."""
KEPT, DOUBTED = 0.55, 0.3
"""What the grammar read from every word stays from the first on; below the second, where the
network's reading is no likelier than `SURE`, it is asked about."""
TRUSTED = 0.8
"""From here on the grammar's reading is acted on without asking the network."""
FOUND, HEARD = 0.5, 0.3
"""So sure the network itself has to be of the words that are acted on, and asked about."""
SURER = 0.9
"""From here on it is acted on where something is said that a network may well guess: how long, how
far, in which cases, what to say."""
SHORT = 6
"""In so few words the one that the grammar asks about may well matter: "the lamp, gingerly"."""

_RELATIVE = lexicon.words("that which who is")
"""Behind one of these "not" says which is meant: "all that is not red"."""
_REFERS = lexicon.words(
    "it its this that these those them they he him his she her there then one ones same again back "
    "rest other others another else more both all"
)
"""What may stand for something that was said before."""
_TAKEN_BACK = lexicon.words("no nope instead rather")
"""With these the grammar knows what takes whose place, and the network seldom."""
_TITLE = re.compile(r"^(?:mr|mrs|ms|miss|dr|prof|professor|doctor|sir|madam|uncle|auntie)\.? ")
_WORDS = re.compile(r"[\w']+")
_MEANT = re.compile(r"\bI meant? (?:the|a|an|my|your|our|his|her|this|that)\s+\w", re.IGNORECASE)
"""I mean *the cellar*: what takes another's place, be it known or not."""
_KEPT = (Say, Tell, Answer, If)
"""What is read word for word, or checked part by part."""
_ON_PURPOSE = ("as said to", "I do only what I am asked for")
"""What the grammar remarks where it keeps from an order what is another's, or forbidden."""
_ALTERNATIVE, _ACT_MISSING = " or ", "What shall I do with"
"""In a question: what can be meant in two ways; what is named, and nothing is said to be done."""
_BY_THE_WAY = (Wait, Stop, Cancel, Pause, Report)
"""What is read out of talk beside an order: "hang on", "never mind", "look"."""
_ASKS = lexicon.words("please you your me us can could would should must ought let lets let's")
"""Without one of these, and without a verb at the beginning, a sentence only tells something."""
_SMALL_TALK = (Report, Cancel)
"""What is easily read out of what is said to anybody: "how is the day", "what is on the list"."""
_STRANGE = 1
"""With so many unknown words an order that the grammar read whole is still plainly put."""
_GREETING = re.compile(
    r"^\W*(?:(?:sorry|excuse me|hey|hi|hello|okay|ok|well|right|so)\b\W*)+", re.IGNORECASE
)
"""Ahead of an order these leave it as plainly put."""
_SEVERAL = 2
_BESIDE = re.compile(rf",\s*(?:{'|'.join(sorted(lexicon.DETERMINERS))})\s+(\w+)\s*,")
"""Something more that is meant: "the kettle, the cosy, ..."."""

Hearing = Callable[[str, NameIndex], Heard]


def third_look(
    text: str,
    index: NameIndex,
    before: Attempt,
    read: Grammar,
    *,
    follows: bool = False,
    hear: Hearing = Heard,
    fields: Fields = LEARNT,
) -> Attempt:
    """The reading of a sentence to act on, or a question or refusal.

    Args:
        text: What was said.
        index: The names of this world.
        before: What was made of it so far.
        read: The grammar.
        follows: Whether something was said before: the network has not heard it, so what refers to
            it is left to the grammar.
        hear: What says it in plain words; by default the network that comes with the package.
        fields: What was learnt of the choice; by default what comes with the package.
    """
    names = _names(text, index)
    if not _is_open(text, [name.said for name in names], before, follows=follows):
        return before
    own = _side(before, "whole", sight(text, index))
    if isinstance(before.outcome, Goals) and alone(text, names, own, fields) >= TRUSTED:
        return before
    found = looked(text, index, before, read, hear)
    if found is None or _leaves_one_out(text, found[0]):
        return before
    both, other = found
    kept, likely = choice(both, fields)
    said = None if other is None or not isinstance(other.outcome, Goals) else other
    lacks = said is None or _lacks(text, index, before, both, likely)
    is_read = isinstance(before.outcome, Goals)
    if is_read and kept >= KEPT:
        return before
    if said and likely >= SURE and not lacks:
        return _taken(said, both)
    if is_read:
        return _asked(text, before, "I am not sure that I got that") if kept < DOUBTED else before
    small = all(isinstance(goal, _SMALL_TALK) for goal in both.other.goals)
    if said and not small and likely >= LIKELY and both.likely >= HEARD and not _offers(before):
        return _asked(text, said, "I did not get every word")
    return before


def _names(text: str, index: NameIndex) -> list[Name]:
    said = units(words_of(text), index)
    return [Name(one.sort, one.names, one.is_whole, one.said) for one in said if one.names]


def _offers(before: Attempt) -> tuple[Goal, ...]:
    """What the grammar asks whether it is meant."""
    return before.outcome.goals if isinstance(before.outcome, Question) else ()


def _lacks(text: str, index: NameIndex, before: Attempt, both: Both, likely: float) -> bool:
    """Whether something may be missing in what the network says, however sure it is."""
    goals = both.other.goals
    is_short = len(text.split()) <= SHORT and _offers(before) == goals
    guessed = both.likely < FOUND
    guessed |= isinstance(before.error, Idle) or before.tells or _has_no_request(text, both)
    guessed |= is_reported(text) or only_asks(text, goals) or _calls_somebody(text, both)
    says = any(isinstance(goal, Say) for goal in each(goals))
    guessed |= likely < SURER and (says or _measures(text) or _loses_limit(text, both))
    small = all(isinstance(goal, _SMALL_TALK) for goal in goals)
    less = small or _leaves_out(goals, before)
    return bool(lost(both)) or is_short or guessed or less or _loses_count(text, index, goals)


def _leaves_out(goals: Sequence[Goal], before: Attempt) -> bool:
    """Whether the network only leaves out an order that the grammar read, and no talk."""
    if not isinstance(before.outcome, Goals) or any(goal not in before.goals for goal in goals):
        return False
    return any(not _is_by_the_way(goal) for goal in before.goals if goal not in goals)


def _is_by_the_way(goal: Goal) -> bool:
    """Whether somebody may have said that without asking for it: "hang on", not "wait 10 s"."""
    if isinstance(goal, LookAt):
        return goal.object is None and goal.person is None
    return isinstance(goal, _BY_THE_WAY) and not (isinstance(goal, Wait) and goal.duration_s)


def _has_no_request(text: str, both: Both) -> bool:
    """Whether a sentence has no form of a request: "the scarf is needed for the party"."""
    words = _WORDS.findall(text.lower().replace("’", "'"))
    signs = plainness(text, [name.said for name in both.names], 1, "")
    told = not {"begins=article", "begins=name", "begins=about"}.isdisjoint(signs)
    return told and _ASKS.isdisjoint(words)


def _calls_somebody(text: str, both: Both) -> bool:
    """Whether a sentence begins with the name of somebody, who is spoken to: "Leo, sit here"."""
    people = [name.said.lower() for name in both.names if name.sort == "person"]
    said = _TITLE.sub("", text.lower().lstrip())
    return any(said.startswith((f"{one},", f"{one}!")) for one in people)


def _leaves_one_out(text: str, both: Both) -> bool:
    """Whether something more that is meant is not among the network's words."""
    return any(word not in both.plain for word in _BESIDE.findall(text.lower()))


def _taken(said: Attempt, both: Both) -> Attempt:
    told = f"I take that as “{both.plain.replace(' ;', ';')}”"
    return said._replace(outcome=remarked(said.outcome, told))


def looked(
    text: str, index: NameIndex, before: Attempt, read: Grammar, hear: Hearing
) -> tuple[Both, Attempt | None] | None:
    """What grammar and network make of a sentence; None if it is too long for the network.

    Returns:
        Both, and what the grammar makes of the network's words: None if it says that nothing is
        to be done, or that it has to be asked.
    """
    heard = hear(text, index)
    if not heard.is_whole:
        return None
    said = heard.paraphrase()
    other = None if said.text in (ASK, NOTHING) else read(said.text)
    seen = sight(text, index)
    sides = _side(before, "whole", seen), _side(other, "plain", seen) if other else SILENT
    return Both(text, _names(text, index), said.text, said.likely, *sides), other


def _is_open(text: str, said: Sequence[str], before: Attempt, *, follows: bool) -> bool:
    """Whether other words might be read better than those that were said.

    What is asked or refused on purpose no other words make clear. For an order that is plainly put,
    what is to be said word for word or on a condition, and what no stranger asks for the grammar
    was made; few words leave no room for others; and the network has not heard what was said
    before.
    """
    if _is_on_purpose(text, before) or is_plain(text) or len(text.split()) > LONGEST:
        return False
    if isinstance(before.outcome, Goals):
        kept = any(isinstance(goal, _KEPT) for goal in each(before.goals))
        kept |= any(remark in (before.outcome.reason or "") for remark in _ON_PURPOSE)
        if kept or not is_known(before.goals):
            return False
        words = _WORDS.findall(text.lower())
        beside = len(before.goals) > 1 and any(map(_is_by_the_way, before.goals))
        plain = is_plainly_put(_GREETING.sub("", text), said, strange=_STRANGE) and not beside
        refers = follows and not _REFERS.isdisjoint(words)
        return not (refers or plain or not _TAKEN_BACK.isdisjoint(words))
    return bool(before.goals) or not is_settled(text, before)


def _is_on_purpose(text: str, before: Attempt) -> bool:
    """Whether the grammar asks or refuses what it understood: that is never overridden.

    Which of several is meant, or of names that are like one that nobody has; what would help who
    only tells of something; what is forbidden, cannot be promised or not be taken account of; what
    is not for the robot to do; a condition that cannot be checked.
    """
    if isinstance(before.error, Unasked | Offered | Unpromised | Doubtful):
        return True
    words = _WORDS.findall(text.lower().replace("’", "'"))
    if type(before.error) is NotUnderstood and not CONDITIONS.isdisjoint(words):
        return True
    question = before.outcome if isinstance(before.outcome, Question) else None
    asks_which = question and (
        question.kind == "choice"
        or _ALTERNATIVE in question.question
        or question.question.startswith(_ACT_MISSING)
    )
    return bool(asks_which) or type(before.error) is Partly


def _measures(text: str) -> bool:
    """Whether it is said how long or how far: of what may well be guessed."""
    return not MEASURES.isdisjoint(_WORDS.findall(text.lower()))


def _loses_count(text: str, index: NameIndex, goals: Sequence[Goal]) -> bool:
    """Whether it is said how many of a thing are meant, and no goal says that."""
    words = _WORDS.findall(text.lower())
    told = numbers(goals)
    for at in range(len(words) - 1):
        count = number(words, at)
        if count is None or count.value < _SEVERAL or count.value in told:
            continue
        names = (index.match(words, n) for n in range(count.end, min(count.end + 2, len(words))))
        if any(match is not None and match.of("object", "category") for match in names):
            return True
    return False


def _loses_limit(text: str, both: Both) -> bool:
    """Whether words make an order one for some cases only, or tell which, and may be lost."""
    words = _WORDS.findall(text.lower().replace("’", "'"))
    if _MEANT.search(text):
        return True
    if CONDITIONS.intersection(words) and "if" not in both.plain.split():
        return True
    denied = [n for n, word in enumerate(words) if word == "not" or word.endswith("n't")]
    return any(n == 0 or words[n - 1] in _RELATIVE for n in denied)


def _side(attempt: Attempt, words: Words, seen: Sight | None) -> Side:
    outcome = attempt.outcome
    goals = () if isinstance(outcome, Refusal) else outcome.goals
    puzzled = not isinstance(outcome, Goals) and outcome.puzzled
    told = (outcome.reason or "") if isinstance(outcome, Goals) else ""
    likely = trust([Reading(words, goals)], seen, attempt.trouble)[0] if seen and goals else 0.0
    return Side(_kind(outcome), goals, attempt.trouble, puzzled, told, likely)


def _kind(outcome: Outcome) -> Kind:
    if isinstance(outcome, Goals):
        return "goals"
    return "question" if isinstance(outcome, Question) else "refusal"


def _asked(text: str, attempt: Attempt, doubt: str) -> Attempt:
    return attempt._replace(outcome=just_that(text, Partly(doubt, attempt.goals)))
