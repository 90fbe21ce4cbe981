"""What was said, of what a grammar, a language model and a cry to stop make of the same sound."""

from __future__ import annotations

from difflib import SequenceMatcher
from typing import NamedTuple

from intents.outcomes import Goals, Refusal
from intents.parser import parse
from intents.speech.rejection import (
    DOUBTFUL,
    Fit,
    doubt_of_command,
    doubt_of_free,
    features,
    mean_score,
)
from intents.stopping import is_stop
from intents.vocabulary import Vocabulary

AS_WELL = 1.5
"""So much worse than other words may those of a cry fit, to be heeded [nat/frame]. Free words fit
better than those of a command by 0.5 to 1.5 where that was said, and by 1 to 4 where it was not."""
FEW_WORDS = 2
FOR_A_CRY, FOR_ONE_WORD, FOR_MANY = 1.2, 3.0, 0.5
"""How much worse than a command a cry may fit a short utterance, to be heeded; a bare one; where
the command has more than a few words [nat/frame]: a cry is misheard as one or two words, hardly as
five that happen to fit."""
WORST_CRY = -8.5
"""How badly the words of a cry may fit [nat/frame]."""
SHORT_CRY = 3
"""Words: a longer cry among free words has to be believed like other words to be heeded."""
MEANS_NOTHING = 2.0
"""So much more doubtful are free words that ask for nothing: talk beside it is passed over."""
CRY_ALONE = 0.05
"""Share of the power of an utterance that may fall on no word of a cry."""


class Found(NamedTuple):
    """The words that fit an utterance best: of a command, free ones, and of a cry to stop."""

    command: list[Fit]
    free: list[Fit]
    cry: list[Fit]


class Choice(NamedTuple):
    """What was said.

    Attributes:
        fits: the words.
        doubt: as in `Heard`.
        doubtful: as in `Heard`.
    """

    fits: list[Fit]
    doubt: float = 0.0
    doubtful: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The words as a text."""
        return text_of(self.fits)


def chosen(found: Found, vocabulary: Vocabulary, *, replying: bool) -> Choice:
    """What was said of what was found.

    Args:
        found: by the decoders.
        vocabulary: the names of the world, in which two texts may mean the same.
        replying: whether a question is open.
    """
    command, free, cry = found
    if cry and not is_stop(text_of(command)) and _is_cry(cry, command, replying=replying):
        command = cry
    if not command or not free:
        return Choice(command or free, DOUBTFUL if command or free else 0.0)
    if is_stop(text_of(command)) and mean_score(command) > mean_score(free) - AS_WELL:
        return Choice(command)
    agree = _same(text_of(command), text_of(free), vocabulary)
    of_command = doubt_of_command(command, free, agree=agree)
    of_free = doubt_of_free(free, command, agree=agree)
    if is_stop(text_of(free)):
        if len(free) <= SHORT_CRY or of_free < 1.0:
            return Choice(free)
        free, of_free = [], DOUBTFUL
    elif isinstance(parse(text_of(free), vocabulary), Refusal):
        of_free *= MEANS_NOTHING
    if is_stop(text_of(command)) or (free and of_free < of_command):
        return Choice(free, of_free, _otherwise(free, command))
    return Choice(command, of_command, _otherwise(command, free))


def text_of(fits: list[Fit]) -> str:
    """Words as a text."""
    return " ".join(fit.word for fit in fits)


def _same(one: str, other: str, vocabulary: Vocabulary) -> bool:
    """Whether two texts mean the same in a world."""
    if one == other:
        return True
    meant = [parse(text, vocabulary) for text in (one, other)]
    return (
        isinstance(meant[0], Goals) and isinstance(meant[1], Goals)
        and meant[0].goals == meant[1].goals
    )  # fmt: skip


def _otherwise(fits: list[Fit], other: list[Fit]) -> tuple[str, ...]:
    """The words that were heard otherwise, too."""
    words = [fit.word for fit in fits]
    matched = SequenceMatcher(None, words, [fit.word for fit in other]).get_matching_blocks()
    same = {at for block in matched for at in range(block.a, block.a + block.size)}
    return tuple(word for at, word in enumerate(words) if at not in same)


def _is_cry(cry: list[Fit], fits: list[Fit], *, replying: bool) -> bool:
    """Whether the words of a cry fit all of the sound, and about as well as a command."""
    seen = features(cry)
    if seen.worst < WORST_CRY or seen.unsaid > CRY_ALONE:
        return False
    if replying or len(fits) > FEW_WORDS:  # a "yes" is short, too
        margin = FOR_MANY
    else:
        margin = FOR_ONE_WORD if len(cry) == 1 else FOR_A_CRY
    return not fits or seen.mean > mean_score(fits) - margin
