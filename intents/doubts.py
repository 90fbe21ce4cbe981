"""What may be missing in what the network says of a sentence, and how sure it then has to be.

Each doubt is a kind of loss that a guess at other words is prone to. How likely the network's
reading has to be (:mod:`intents.english.learnt.choice`) in spite of it was measured with the
sentences of `training/paraphrase/pairs/16*`, of which two worlds were kept out of what was learnt:
from the likelihoods below on nine in ten and more were what was meant. What is never acted on, is
asked about.
"""

import re
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

from intents.english.faithfulness import CARRYING, numbers, strings
from intents.english.learnt.choice import Both, lost
from intents.english.trouble import Idle
from intents.english.words import lexicon
from intents.english.words.lexer import words_in
from intents.english.words.limits import (
    CALENDAR,
    CHOICES,
    CONDITIONS,
    DENIALS,
    MEASURES,
    QUANTITIES,
    SPOTS,
    TIMES,
)
from intents.english.words.measures import UNIT_WORDS, measure, number
from intents.english.words.names import NameIndex
from intents.english.words.spelling import GRAMMAR_WORDS
from intents.goals import (
    Cancel,
    Count,
    Find,
    Goal,
    GoTo,
    LookAt,
    Pause,
    Person,
    Report,
    Say,
    Stop,
    Tell,
    Wait,
    each,
    to_builtins,
)
from intents.grounding import queries
from intents.mismatches import (
    counts_another,
    explains_another,
    is_beside_itself,
    loses_all,
    measures_lost,
    mistimes,
    orders_fewer,
    puts_by_part,
    switches_furniture,
    turns_round,
    waits_for_nothing,
    whose_is_lost,
)
from intents.outcomes import Goals, Question
from intents.sameness import same
from intents.second_look import Attempt
from intents.sentence_kind import SentenceKind, kind_of
from intents.stakes import Stake, stake_of
from intents.taken_back import are_taken_back, takes_back, what_is_meant

SURE, SURER, SUREST, NEVER = 0.7, 0.9, 0.95, 2.0
"""From these on the network's reading is acted on: where there is no doubt; where it says how long,
how far, in which cases or what to say, which a network may well guess; where the grammar sees
nothing to do in the sentence, or the network itself is not sure of its words; never."""
QUITE_SURE = 0.85
"""The same for a sentence whose form is no order's, and what the robot is to tell of itself."""
WITNESSED = 0.6
"""The same where the grammar offers just what the network says: two that know nothing of one
another were wrong in one of 75. What says which, in which cases or how many is still not lost."""
DOUBTED_ALONE = 0.8
"""The same where a single thing is in doubt that is seldom the matter, or several are and nothing
moves but a switch or a door, which a word undoes: of 83 such readings 76 were what was meant, and
of 25 looks and answers 24. What takes something back the network knows least."""
TAKEN_BACK = 0.5
"""The same where all that is lost was taken back, and what was named instead is kept: of 25 such
readings 24 were what was meant."""
FOUND = 0.5
"""So sure the network itself has to be of its words, or its reading to be one of the `SUREST`."""
SHORT = 6
"""In so few words the one that the grammar asks about may well matter: "the lamp, gingerly"."""

_RELATIVE = lexicon.words("that which who is")
"""Behind one of these "not" says which is meant: "all that is not red"."""
_TITLE = re.compile(r"^(?:mr|mrs|ms|miss|dr|prof|professor|doctor|sir|madam|uncle|auntie)\.? ")
_WHICH = re.compile(r"\bthe (\w+) one\b")
_MEANT = re.compile(r"\bI meant? (?:the|a|an|my|your|our|his|her|this|that)\s+\w", re.IGNORECASE)
"""I mean *the cellar*: what takes another's place, be it known or not."""
_BY_THE_WAY = (Wait, Stop, Cancel, Pause, Report)
"""What is read out of talk beside an order: "hang on", "never mind", "look"."""
_SEVERAL = 2
_POSTURES = lexicon.words("sitting standing lying")
_BRINGS = lexicon.words("bring take carry fetch")
_TAKEN = lexicon.words("him her them it")
_LIMITING = (
    CARRYING | CONDITIONS | TIMES | CALENDAR | DENIALS | CHOICES | QUANTITIES | MEASURES | SPOTS
) - lexicon.words("one")
_POINTING = lexicon.words("it him her them this that these those he she they there")
_YOU = lexicon.words("you you're you've your yourself u ur ya ye yer y'all thou")
_PEOPLE = lexicon.PERSON_NOUNS | lexicon.GENDERS.keys() | lexicon.words("who nobody")


class _Case(NamedTuple):
    """A sentence, what was made of it before, and what the network makes of it."""

    text: str
    names: NameIndex
    before: Attempt
    both: Both

    @property
    def goals(self) -> tuple[Goal, ...]:
        return self.both.other.goals

    @property
    def words(self) -> list[str]:
        return words_in(self.text)


def needed(
    text: str,
    index: NameIndex,
    before: Attempt,
    both: Both,
    *,
    least: float = SURE,
    outweighs: bool = False,
) -> float:
    """How likely the network's reading has to be to be acted on [0..1]; above 1 if it never is.

    Args:
        text: What was said.
        index: The names of this world.
        before: What was made of it so far.
        both: It, and what the network says instead.
        least: How likely it has to be in any case: beyond `SURE` the grammar has its reasons to
            ask or to refuse, and then no word may be lost that limits an order.
        outweighs: Whether it is likelier than what the grammar reads from every word: then an order
            may be left out that the grammar saw in it.
    """
    case = _Case(text, index, before, both)
    agreed = agree(both) and bool(offers(before))
    doubts = _DOUBTS if least <= SURE else (*_DOUBTS, *_MORE_DOUBTS)
    if outweighs:
        doubts = tuple((doubt, one) for doubt, one in doubts if doubt is not _leaves_out)
    if agreed:
        doubts = tuple((doubt, one) for doubt, one in doubts if doubt not in _WITNESSED)
        least = WITNESSED if least <= SURE else least
    names = [name.said for name in both.names]
    kind = kind_of(text, case.goals, tells=before.tells, names=names)
    by_kind = 0.0 if agreed and kind is SentenceKind.UNASKED else _BY_KIND[kind]
    gone, meant = lost(both), case
    if gone and are_taken_back(case.text, both.names, gone):
        doubts = tuple((doubt, one) for doubt, one in doubts if doubt not in _ABOUT_ALL)
        least = TAKEN_BACK if least <= SURE else least
        by_kind = 0.0 if kind is SentenceKind.UNASKED else by_kind
        meant = case._replace(text=what_is_meant(text, gone))
    found = [(doubt, one) for doubt, one in doubts if doubt(case if doubt in _OF_ALL else meant)]
    if not isinstance(before.outcome, Goals) and _is_slight(case, [doubt for doubt, _ in found]):
        by_kind = by_kind if by_kind >= NEVER else min(by_kind, DOUBTED_ALONE)
        return max(least, by_kind, DOUBTED_ALONE)
    return max((least, by_kind, *(one for _, one in found)))


def _is_slight(case: _Case, found: Sequence[Callable[[_Case], bool]]) -> bool:
    """Whether what is in doubt costs little, should it be wrong, or stands in doubt alone."""
    stake = stake_of(case.goals)
    few = _counts_nobody_said in found and len(case.text.split()) <= SHORT
    if not found or few or takes_back(case.text):
        return False
    slight = _SLIGHT[stake]
    alone = len(found) == 1 or stake < Stake.MOTION
    return alone and all(doubt in slight for doubt in found)


def agree(both: Both) -> bool:
    """Whether what the grammar reads and what the network says come to the same."""
    return same(to_builtins(both.own.goals), to_builtins(both.other.goals))


def is_by_the_way(goal: Goal) -> bool:
    """Whether somebody may have said that without asking for it: "hang on", not "wait 10 s"."""
    if isinstance(goal, LookAt):
        return goal.object is None and goal.person is None
    return isinstance(goal, _BY_THE_WAY) and not (isinstance(goal, Wait) and goal.duration_s)


def offers(before: Attempt) -> tuple[Goal, ...]:
    """What the grammar asks whether it is meant."""
    return before.outcome.goals if isinstance(before.outcome, Question) else ()


def _is_short(case: _Case) -> bool:
    """Whether the grammar asks about a word of a few, and the network only passes it over."""
    return len(case.text.split()) <= SHORT and offers(case.before) == case.goals


def _is_idle(case: _Case) -> bool:
    return isinstance(case.before.error, Idle)


def _calls_somebody(case: _Case) -> bool:
    """Whether a sentence begins with the name of somebody, who is spoken to: "Leo, sit here"."""
    people = [name.said.lower() for name in case.both.names if name.sort == "person"]
    said = _TITLE.sub("", case.text.lower().lstrip())
    return any(said.startswith((f"{one},", f"{one}!")) for one in people)


def _is_unsure(case: _Case) -> bool:
    return case.both.likely < FOUND


def _passes_on(case: _Case) -> bool:
    return any(isinstance(goal, Say) for goal in each(case.goals))


def _loses_measure(case: _Case) -> bool:
    """Whether it is said how long or how far, and no goal says that: it may well matter."""
    lost = measures_lost(case.words, case.goals)
    return lost or (not MEASURES.isdisjoint(case.words) and not numbers(case.goals))


def _is_contrary(case: _Case) -> bool:
    """Whether the contrary is done of what was said, or to more, fewer or others."""
    words, goals, index = case.words, case.goals, case.names
    return (
        turns_round(words, goals)
        or switches_furniture(words, goals)
        or counts_another(words, goals, index)
        or mistimes(words, goals)
        or loses_all(words, goals, index)
        or orders_fewer(case.text, goals)
        or waits_for_nothing(words, goals)
        or whose_is_lost(words, goals)
        or explains_another(case.text, goals)
        or _loses_figure(case)
        or _says_another_amount(case)
    )


def _loses_figure(case: _Case) -> bool:
    """On the shelf *7*: whether a number in figures comes back in no goal, nor in words."""
    words, told = case.words, numbers(case.goals)
    said = {*case.both.plain.split(), *strings(case.goals)}
    alone = (w for at, w in enumerate(words) if w.isdecimal() and measure(words, at) is None)
    return any(float(word) not in told for word in alone if word not in said)


def _says_another_amount(case: _Case) -> bool:
    """Whether an amount is told where none, or another, can be read in the sentence.

    *Twa metres* is not one metre, a *quarter turn* not half of one.
    """
    words = case.words
    if not numbers(case.goals):
        return False
    read = {one.end - 1 for at in range(len(words)) if (one := measure(words, at)) is not None}
    units = {at for at, word in enumerate(words) if word in UNIT_WORDS}
    return bool(units - read) or measures_lost(words, case.goals)


def _loses_limit(case: _Case) -> bool:
    """Whether words make an order one for some cases only, or tell which, and may be lost."""
    words = case.words
    if _MEANT.search(case.text):
        return True
    if CONDITIONS.intersection(words) and "if" not in case.both.plain.split():
        return True
    denied = [n for n, word in enumerate(words) if word == "not" or word.endswith("n't")]
    return any(n == 0 or words[n - 1] in _RELATIVE for n in denied)


def _loses_which(case: _Case) -> bool:
    """Whether it is said which one is meant, and does not come back: "the long one"."""
    said = _WHICH.findall(case.text.lower())  # the last counts: "the blue one, no, the red one"
    return bool(said) and said[-1] not in {*case.both.plain.split(), *strings(case.goals)}


def _loses_any_limit(case: _Case) -> bool:
    """Whether any word that could limit an order does not come back: "for later", "both hands"."""
    plain = set(case.both.plain.lower().split())
    kept = {*plain, *strings(case.goals)}
    if "if" in plain:
        kept |= CONDITIONS | {"not", "when", "once", "should"}
    if any(isinstance(goal, Count) for goal in each(case.goals)):
        kept |= {"many", "much"}
    told = numbers(case.goals)
    for at, word in enumerate(case.words):
        meant = lexicon.COLORS.get(word) or lexicon.SIZES.get(word) or word
        count = number(case.words, at)
        gone = word in _LIMITING or count is not None
        if gone and not {word, meant} & kept and not (count and count.value in (1, *told)):
            return True
    return False


def _points(case: _Case) -> bool:
    """Whether it speaks of something by a pronoun alone: "follow him"."""
    told = all(isinstance(goal, Report | Tell) for goal in each(case.goals))
    return not told and not _POINTING.isdisjoint(case.words)


def _begins_unknown(case: _Case) -> bool:
    """Whether it begins with an order that nobody knows: "smash the cup on the bar"."""
    first, second = (*case.words, "", "")[:2]
    known = first in GRAMMAR_WORDS or case.names.match(case.words, 0) is not None
    return not known and second in lexicon.DETERMINERS


def _loses_time(case: _Case) -> bool:
    """Whether it is said at what time something is to be done, which no plain word says."""
    return not CALENDAR.isdisjoint(case.words)


def _tells_of_itself(case: _Case) -> bool:
    return all(isinstance(goal, Report) for goal in case.goals)


def _is_not_of_itself(case: _Case) -> bool:
    """Whether the robot would tell of itself to who does not speak to it: "where's my hat?"."""
    return _tells_of_itself(case) and _YOU.isdisjoint(case.words)


def _ends_something(case: _Case) -> bool:
    """Whether all is to tell or to end something, easily read out of talk: "forget it"."""
    small = all(isinstance(goal, Report | Cancel) for goal in case.goals)
    return small and not _tells_of_itself(case)


def _leaves_out(case: _Case) -> bool:
    return leaves_out(case.before, case.goals)


def leaves_out(before: Attempt, goals: Sequence[Goal]) -> bool:
    """Whether goals only leave out an order that the grammar read, and no talk."""
    if not isinstance(before.outcome, Goals) or any(g not in before.goals for g in goals):
        return False
    return any(not is_by_the_way(goal) for goal in before.goals if goal not in goals)


def _loses_name(case: _Case) -> bool:
    gone = lost(case.both)
    return bool(gone) and not are_taken_back(case.text, case.both.names, gone)


def _names_nothing(case: _Case) -> bool:
    """Whether something is told by its colour or size alone, of which more was said."""
    told = any(
        (query.color or query.size) and not (query.name or query.category or query.at)
        for query in queries(case.goals)
    )
    return told and any(name.sort in ("object", "category") for name in case.both.names)


def _counts_nobody_said(case: _Case) -> bool:
    """Whether people would be counted of whom nobody spoke: "how many on the bar?"."""
    counts = any(isinstance(goal, Count) and goal.person for goal in each(case.goals))
    return counts and _PEOPLE.isdisjoint(case.words)


def _loses_count(case: _Case) -> bool:
    """Whether it is said how many of a thing are meant, and no goal says that."""
    words, told = case.words, numbers(case.goals)
    for at in range(len(words) - 1):
        count = number(words, at)
        if count is None or count.value < _SEVERAL or count.value in told:
            continue
        ends = range(count.end, min(count.end + 2, len(words)))
        names = (case.names.match(words, n) for n in ends)
        if any(match is not None and match.of("object", "category") for match in names):
            return True
    return False


def _loses_who(case: _Case) -> bool:
    """How many *ladies* are *sitting* there? Whether no goal says of which people that is asked."""
    people = [
        person
        for goal in each(case.goals)
        for person in [getattr(goal, "person", None)]
        if isinstance(person, Person)
    ]
    if not people or any(person.name for person in people):
        return False
    genders = {lexicon.GENDERS[word] for word in case.words if word in lexicon.GENDERS}
    postures = {word for word in case.words if word in _POSTURES}
    lost_gender = len(genders) == 1 and all(person.gender is None for person in people)
    return lost_gender or (bool(postures) and all(person.posture is None for person in people))


def _does_purpose(case: _Case) -> bool:
    """*In order to open it* bring me the key: whether more is done than what is good for that."""
    return "in order to" in " ".join(case.words) and len(case.goals) > 1


def _carries_nothing(case: _Case) -> bool:
    """*Bring him* (to) see Ada: whether somebody or something is to be taken, and none is."""
    every = list(each(case.goals))
    if not all(isinstance(goal, (Find, Tell, LookAt, Count, GoTo)) for goal in every):
        return False
    return any(word in _BRINGS and after in _TAKEN for word, after in pairwise(case.words))


def _puts_by_part(case: _Case) -> bool:
    return puts_by_part(case.words, case.goals, case.names)


def _is_beside_itself(case: _Case) -> bool:
    return is_beside_itself(case.words, case.goals)


_BY_KIND = {
    SentenceKind.ORDER: 0.0,
    SentenceKind.UNASKED: QUITE_SURE,
    SentenceKind.TOLD: NEVER,
    SentenceKind.QUESTION: NEVER,
    SentenceKind.QUOTED: NEVER,
}
"""How likely it has to be by the kind of sentence it is a reading of."""
_DOUBTS: tuple[tuple[Callable[[_Case], bool], float], ...] = (
    (_loses_name, NEVER),
    (_is_contrary, NEVER),
    (_loses_count, NEVER),
    (_loses_which, NEVER),
    (_counts_nobody_said, NEVER),
    (_names_nothing, NEVER),
    (_loses_time, NEVER),
    (_leaves_out, NEVER),
    (_loses_who, NEVER),
    (_does_purpose, NEVER),
    (_carries_nothing, NEVER),
    (_puts_by_part, NEVER),
    (_is_beside_itself, NEVER),
    (_is_short, NEVER),
    (_calls_somebody, NEVER),
    (_is_not_of_itself, NEVER),
    (_is_idle, SUREST),
    (_is_unsure, SUREST),
    (_ends_something, SUREST),
    (_passes_on, SURER),
    (_loses_measure, SURER),
    (_loses_limit, SURER),
    (_tells_of_itself, QUITE_SURE),
)
_WITNESSED = (
    _is_unsure, _loses_measure, _passes_on, _points,
    _is_idle,
)  # fmt: skip
"""What is no doubt where the grammar offers the same."""
_OF_ALL = (_is_short, _calls_somebody, _is_not_of_itself)
"""What is seen of a whole sentence, though a part of it was taken back."""
_ABOUT_ALL = (_loses_name, _leaves_out)
"""What is no doubt where all that is lost was taken back."""
_SLIGHT_FOR_LOOKS = (
    _is_idle, _is_unsure, _is_short, _loses_limit, _loses_measure, _tells_of_itself,
    _counts_nobody_said,
)  # fmt: skip
_SLIGHT = {
    Stake.LOOK: _SLIGHT_FOR_LOOKS,
    Stake.DEVICE: (*_SLIGHT_FOR_LOOKS, _loses_name),
    Stake.SPEECH: (),
    Stake.MOTION: (_is_idle, _is_unsure),
}
"""What is seldom the matter where the network is likely to be right, by what is at stake."""
_MORE_DOUBTS: tuple[tuple[Callable[[_Case], bool], float], ...] = (
    (_loses_any_limit, NEVER),
    (_points, NEVER),
    (_begins_unknown, NEVER),
)
"""Each doubt, and how likely what the network says has to be in spite of it."""
