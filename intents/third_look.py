"""A sentence as a network says it again, and whether its words or the grammar's are acted on.

The network (:mod:`intents.english.paraphrase`) makes no goals: it says the sentence in plain
words, and how sure it is of them; the grammar reads those. Which of the two readings is to be
acted on, or whether neither is, was learnt (:mod:`intents.english.learnt.choice`): also where the
grammar read every word, unless that is likely enough by itself.
"""

import re
from collections.abc import Callable, Sequence

from intents.doubts import (
    NEVER,
    QUITE_SURE,
    SURE,
    SURER,
    agree,
    is_by_the_way,
    leaves_out,
    needed,
    offers,
)
from intents.english.faithfulness import strings
from intents.english.learnt.choice import SILENT, Both, Kind, Name, Side, alone, choice
from intents.english.learnt.field import LEARNT, Fields
from intents.english.learnt.plainness import is_plainly_put
from intents.english.learnt.sight import Sight, sight
from intents.english.learnt.trust import Reading, is_known, trust
from intents.english.learnt.trust import Source as Words
from intents.english.paraphrase.paraphrasing import ASK, NOTHING, Heard
from intents.english.paraphrase.source import units, words_of
from intents.english.trouble import (
    Doubtful,
    NotUnderstood,
    Offered,
    Partly,
    Unasked,
    Unpromised,
)
from intents.english.words import lexicon
from intents.english.words.lexer import words_in
from intents.english.words.limits import CONDITIONS
from intents.english.words.names import NameIndex
from intents.goals import (
    Answer,
    Cancel,
    If,
    Report,
    Say,
    Tell,
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
    remarked,
)
from intents.sentence_kind import LOOKING
from intents.taken_back import takes_back

LIKELY, HEARD = 0.35, 0.3
"""From the first on the network's reading is asked about, where the grammar could not read every
word, and the network itself is surer of its words than the second."""
KEPT, DOUBTED = 0.55, 0.3
"""What the grammar read from every word stays from the first on; below the second, where the
network's reading is no likelier than `SURE`, it is asked about."""
HELD, CLEAR = 0.5, 0.5
"""What else is never given up is so below the first, where the network's reading is likelier and
the network surer of its words than the second: of 18 such readings 15 were what was meant."""
TRUSTED, CAREFUL = 0.8, 0.7
"""From here on the grammar's reading is acted on without asking the network; from the second on
what is never given up for the network's."""
_REFERS = lexicon.words(
    "it its this that these those them they he him his she her there then one ones same again back "
    "rest other others another else more both all"
)
"""What may stand for something that was said before."""
_TAKEN_BACK = lexicon.words("no nope instead rather")
"""With these the grammar knows what takes whose place, and the network seldom."""
_KEPT = (Say, Tell, Answer, If)
"""What is read word for word, or checked part by part."""
_SPOKEN = (Say, Answer)
_ON_PURPOSE = ("as said to", "I do only what I am asked for")
"""What the grammar remarks where it keeps from an order what is another's, or forbidden."""
_ALTERNATIVE, _ACT_MISSING = " or ", "What shall I do with"
"""In a question: what can be meant in two ways; what is named, and nothing is said to be done."""
_SMALL_TALK = (Report, Cancel)
"""What is easily read out of what is said to anybody: "how is the day", "what is on the list"."""
STRANGE = 1
"""With so many unknown words an order that the grammar read whole is still plainly put."""
GREETING = re.compile(
    r"^\W*(?:(?:sorry|excuse me|hey|hi|hello|okay|ok|well|right|so)\b\W*)+", re.IGNORECASE
)
"""Ahead of an order these leave it as plainly put."""
_CLIPPED = re.compile(r"\b[tT]['’](?=[a-z]{2})")
"""On *t'* worktop: the article in the north of England, which hides the name."""
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
    names = names_in(text, index)
    least = _least(text, names, before, follows=follows)
    is_read = isinstance(before.outcome, Goals)
    if least >= NEVER and not (is_read and _is_weighed(text, names, before, follows=follows)):
        return before
    own = side_of(before, "whole", sight(text, index))
    if is_read and alone(text, names, own, fields) >= (TRUSTED if least < NEVER else CAREFUL):
        return before
    found = looked(text, index, before, read, hear)
    if found is None or _leaves_one_out(text, found[0]):
        return before
    both, other = found
    kept, likely = choice(both, fields)
    said = None if other is None or not isinstance(other.outcome, Goals) else other
    if is_read and least >= NEVER:
        left = said is not None and leaves_out(before, said.goals) and not takes_back(text)
        if said is None or left or not _outweighs(both, kept, likely):
            return before
        if likely >= needed(text, index, before, both, outweighs=True):
            return _taken(said, both)
        return _asked(text, said, "I am not sure that I got that")
    if is_read and kept >= KEPT:
        return before
    if said and likely >= needed(text, index, before, both, least=least):
        return _taken(said, both)
    if is_read:
        return _asked(text, before, "I am not sure that I got that") if kept < DOUBTED else before
    small = all(isinstance(goal, _SMALL_TALK) for goal in both.other.goals)
    asks = least <= SURE and not small and not offers(before)
    if said and asks and likely >= LIKELY and both.likely >= HEARD:
        return _asked(text, said, "I did not get every word")
    return before


def _outweighs(both: Both, kept: float, likely: float) -> bool:
    """Whether what the network says casts doubt on what is never given up without it."""
    return kept < min(HELD, likely) and both.likely >= CLEAR and not _says_less(both)


def _says_less(both: Both) -> bool:
    """Whether both come to the same, or the grammar only says more of what it is done with.

    Also where it only looks for something as well, or only in some case.
    """
    own, other = both.own.goals, both.other.goals
    acts = [[type(goal) for goal in each(side)] for side in (own, other)]
    if If in acts[0] and If not in acts[1]:
        return True
    if acts[0] == acts[1] and set(strings(other)) <= set(strings(own)):
        return True
    done = [[type(g) for g in side if not isinstance(g, LOOKING)] for side in (own, other)]
    return agree(both) or (done[0] == done[1] and len(own) > len(other))


def names_in(text: str, index: NameIndex) -> list[Name]:
    """The names of the world in a sentence."""
    said = units(words_of(_CLIPPED.sub("the ", text)), index)
    return [Name(one.sort, one.names, one.is_whole, one.said) for one in said if one.names]


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
    sides = side_of(before, "whole", seen), side_of(other, "plain", seen) if other else SILENT
    return Both(text, names_in(text, index), said.text, said.likely, *sides), other


def _least(text: str, names: Sequence[Name], before: Attempt, *, follows: bool) -> float:
    """How likely other words have to be to be acted on [0..1]; above 1 if they never are.

    For an order that is plainly put, what is to be said word for word or on a condition, and what
    no stranger asks for the grammar was made, and the network has not heard what was said before.
    What is asked or refused on purpose other words seldom make clear, and few words leave little
    room for others: they have to be surer, and are never asked about.
    """
    if len(text.split()) > LONGEST:
        return NEVER
    if isinstance(before.outcome, Goals):
        is_open = not (_is_kept(text, before) or _is_plain(text, names, before, follows=follows))
        return SURE if is_open else NEVER
    if _is_on_purpose(text, before):
        return _least_on_purpose(names, before)
    if is_plain(text):
        names_unknown = type(before.error) is NotUnderstood
        return NEVER if names_unknown or follows else SURER
    return SURE if before.goals or not is_settled(text, before) else NEVER


def _is_weighed(text: str, names: Sequence[Name], before: Attempt, *, follows: bool) -> bool:
    """Whether what the grammar read may be asked about, though it is never given up.

    No message is: the network often puts it otherwise; nor a few words or one order, plainly put.
    """
    says = any(isinstance(goal, _SPOKEN) for goal in each(before.goals))
    if (
        says
        or _is_remarked_on(before)
        or refers(text, follows=follows)
        or not is_known(before.goals)
    ):
        return False
    said = [name.said for name in names]
    short = is_plain(text) or len(before.goals) == 1
    return not (short and is_plainly_put(GREETING.sub("", text), said, strange=STRANGE))


def _is_kept(text: str, before: Attempt) -> bool:
    """Whether what the grammar read is never given up: what is said word for word, say."""
    if any(isinstance(goal, _KEPT) for goal in each(before.goals)) or _is_remarked_on(before):
        return True
    return is_plain(text) or not is_known(before.goals)


def _is_remarked_on(before: Attempt) -> bool:
    """Whether the grammar kept from an order on purpose, and says so."""
    told = getattr(before.outcome, "reason", "") or ""
    return any(remark in told for remark in _ON_PURPOSE)


def _is_plain(text: str, names: Sequence[Name], before: Attempt, *, follows: bool) -> bool:
    """Whether an order that the grammar read is plainly put, or refers to what was said before."""
    words, said = words_in(text), [name.said for name in names]
    beside = len(before.goals) > 1 and any(map(is_by_the_way, before.goals))
    plain = is_plainly_put(GREETING.sub("", text), said, strange=STRANGE) and not beside
    return refers(text, follows=follows) or plain or not _TAKEN_BACK.isdisjoint(words)


def refers(text: str, *, follows: bool) -> bool:
    """Whether it may speak of what was said before, which the network has not heard."""
    return follows and not _REFERS.isdisjoint(words_in(text))


def _least_on_purpose(names: Sequence[Name], before: Attempt) -> float:
    """How likely other words have to be where the grammar asks or refuses on purpose.

    A name that is said whole is that, whatever stands beside it ("the *armchair* comma"); and
    what the grammar could not take account of may have been no part of the order.
    """
    error = before.error
    if type(error) is Doubtful:
        said = getattr(error, "said", "").lower()
        whole = any(one.is_whole and one.said.lower() in said for one in names)
        return QUITE_SURE if whole else NEVER
    return SURER if type(error) is Partly else NEVER


def _is_on_purpose(text: str, before: Attempt) -> bool:
    """Whether the grammar asks or refuses what it understood: that is never overridden.

    Which of several is meant, or of names that are like one that nobody has; what would help who
    only tells of something; what is forbidden, cannot be promised or not be taken account of; what
    is not for the robot to do; a condition that cannot be checked.
    """
    if isinstance(before.error, Unasked | Offered | Unpromised | Doubtful):
        return True
    if type(before.error) is NotUnderstood and not CONDITIONS.isdisjoint(words_in(text)):
        return True
    question = before.outcome if isinstance(before.outcome, Question) else None
    asks_which = question and (
        question.kind == "choice"
        or _ALTERNATIVE in question.question
        or question.question.startswith(_ACT_MISSING)
    )
    return bool(asks_which) or type(before.error) is Partly


def side_of(attempt: Attempt, words: Words, seen: Sight | None) -> Side:
    """What an attempt comes to, as the choice weighs it."""
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
