"""One conversation: what was said before, the one open question, confirmations, answers.

Order of a turn: a cry to stop; the answer to the open question; what the sentence means by
itself. Questions about the robot and about where things are get an answer from its state; goals
that are risky or cannot be undone are read back first.
"""

import re
from collections.abc import Callable

from msgspec.structs import replace

from intents import looking_back, plans, replies, small_questions, wording
from intents.amending import swapped
from intents.answering import asks_where, confirmation, told_at_once
from intents.context import Context, answered, noted, verdict_of
from intents.correcting import in_full, is_correction, is_turn
from intents.distances import how_far
from intents.goals import (
    Balance,
    Bring,
    Cancel,
    Give,
    Goal,
    Pause,
    Pick,
    Place,
    Report,
    Resume,
    Stop,
    Wait,
    each,
)
from intents.grammar import SHALL_NOT
from intents.grounding import queries
from intents.halting import besides, without_care
from intents.in_hand import which_in_hand
from intents.outcomes import Goals, Outcome, Question, Refusal, Reply, Turn
from intents.parser import Fallback, hear
from intents.plans import HOW_I_READ_IT
from intents.risks import risk
from intents.state import RobotState
from intents.stopping import is_stop
from intents.the_rest import is_rest, with_the_rest
from intents.undoing import is_back, is_things_back, is_undo, is_undo_of_several, undone
from intents.vocabulary import Vocabulary

__all__ = ["Context", "Dialogue"]

TAKES_CARE = "I take care in any case; I did not get what I am to do."
MAX_REPEATS = 2
"""A question is asked again so often; then it is dropped and the refusal told."""
_AGAIN = re.compile(
    r"(?:(?:and|now|ok|okay|please|robot)\W+)*"
    r"(?:(?:do|try|repeat)(?: (?:it|that|this|the same(?: thing)?))? )?"
    r"(?:again|once more|once again|one more time|another time)(?:\W+(?:please|robot))*\W*"
    r"|(?:please )?repeat(?: (?:it|that|this))?(?: please)?\W*",
    re.IGNORECASE,
)
"""Nothing but a wish to have the last thing done once more."""

_HANDLING = (Bring, Give, Pick, Place)
_STEERING = (Stop, Pause, Resume, Cancel)
_AND = re.compile(r"^\W*(?:and|or|what about|how about)\W+(?=(?:the|my|a|an)\b)", re.IGNORECASE)
"""And *the blue one*?"""


class Dialogue:
    """A conversation with one person, turn by turn.

    >>> from intents.grounding import Entity
    >>> from intents.state import RobotState
    >>> from intents.vocabulary import Thing, Vocabulary
    >>> home = Vocabulary.of(
    ...     objects=[Thing(name="cup", color="red"), Thing(name="cup", color="blue")],
    ...     places=["shelf", "trash can"],
    ... )
    >>> state = RobotState(
    ...     entities=(
    ...         Entity(id="c1", name="cup", color="red", held=True),
    ...         Entity(id="c2", name="cup", color="blue", at="shelf"),
    ...     )
    ... )
    >>> dialogue = Dialogue(home)
    >>> dialogue.hear("what are you holding?", state).text
    'I am holding the red cup.'
    >>> dialogue.hear("look at the cup", state).question
    'Which cup, the red one or the blue one?'
    >>> wording.in_words(dialogue.hear("the blue one", state).goals)
    'look at the blue cup at the shelf'
    >>> dialogue.hear("throw it away", state).question  # doctest: +ELLIPSIS
    'I shall put the blue cup at the shelf into the trash can; what is thrown away may be...'
    >>> dialogue.hear("no", state).text
    'All right, I leave it.'

    Attributes:
        context: What was said before; also holds the open question.
        confirm: Whether risky goals are read back before they are returned.
        risk: Why goals are read back, in words; empty where they need not be.
        agreed: Whether what a language model makes is done unasked, unless it is risky.
        dropped: The question that the last turn left open for good, because it asked for something
            else; empty if there is none.
    """

    def __init__(
        self,
        vocabulary: Vocabulary,
        *,
        confirm: bool = True,
        fallback: Fallback | None = None,
        risk: Callable[[tuple[Goal, ...]], str] = risk,
    ) -> None:
        """Begin a conversation.

        Args:
            vocabulary: The names of this world.
            confirm: Whether risky goals are read back before they are returned.
            fallback: Asked what the grammar does not understand, such as a language model.
            risk: Why goals are read back, in words; empty where they need not be.
        """
        self.vocabulary = vocabulary
        self.confirm = confirm
        self.fallback = fallback
        self.risk = risk
        self.agreed = False
        self.context = Context()
        self.dropped = ""
        self._repeats = 0
        self._before: tuple[tuple[Goal, ...], RobotState] | None = None
        self._handled: tuple[tuple[Goal, ...], RobotState] | None = None
        self._told_of = ""
        self._answered = False
        self._in_hand = False
        self._instead = False
        self._asked_where = False
        self._pending: Context | None = None
        self._asked_before: list[tuple[Question, Context | None]] = []

    @property
    def question(self) -> Question | None:
        """The question that is open."""
        return self.context.question

    def hear(self, text: str, state: RobotState | None = None) -> Turn:
        """What one turn of the person leads to.

        Args:
            text: What was said or typed; every string is accepted.
            state: What the robot knows of itself now.

        Returns:
            Goals to carry out (``parser`` is "stop" for a cry to stop), a question (the one that
            is open from now on), a refusal with its reason, or a reply, which is all there is to
            say.
        """
        turn = self._hear(text, state or RobotState())
        if not isinstance(turn, Goals) or turn.parser != "stop":
            self.context = noted(self.context, text, in_turn(turn))
        return turn

    def _hear(self, text: str, state: RobotState) -> Turn:
        self.dropped = ""
        if is_stop(text, at_rest=not state.doing):
            self._close()
            self._asked_before.clear()
            return Goals(goals=(Stop(),), parser="stop")
        opened = self.context.question
        polite = None if opened else replies.courtesy(text)
        if polite:
            return Reply(text=polite)
        about = looking_back.told(text, state, opened)
        if about:
            return Reply(text=about)
        far = how_far(text, state, lambda said: self._read(said, state))
        if far:
            return Reply(text=far)
        turn = self._answer(text, opened, state) if opened else None
        asked_where, self._asked_where = self._asked_where, False
        if asked_where and _AND.match(text):
            text = _AND.sub("where is ", text)
        if opened is None and self._told_of and _AGAIN.fullmatch(text.strip()):
            text = self._repeatable(text)
        self._back_to_order(text, state)
        turn = turn or self._revised(text, state) or self._understand(text, state, opened)
        self._told_of = text if isinstance(turn, Reply) else ""
        self._asked_where = asks_where(text) and isinstance(turn, Reply)
        if isinstance(turn, Goals) and not all(isinstance(goal, _STEERING) for goal in turn.goals):
            self._before = (turn.goals, state)
            handled = any(isinstance(goal, _HANDLING) for goal in each(turn.goals))
            self._handled = self._before if handled else self._handled
        if self.question is None and self._asked_before:
            question, self._pending = self._asked_before.pop()
            self.context = replace(self.context, question=question)
        return turn

    def _back_to_order(self, text: str, state: RobotState) -> None:
        """Let what corrects something correct the last order, and no question since.

        A question of things ("where is the red cup?") is what is corrected while nothing is done.
        """
        goals = self.context.goals
        of_robot = all(isinstance(goal, Report) for goal in goals)
        if self._answered and self._before and is_correction(text) and (of_robot or state.doing):
            self.about(self._before[0])

    def _repeatable(self, text: str) -> str:
        """What "again" repeats after a question: the last order, or else the question."""
        if self._before is None:
            return self._told_of
        self.context = replace(self.context, goals=self._before[0])
        return text

    def _read(self, text: str, state: RobotState) -> Outcome:
        """What a sentence means by itself, here and now."""
        before = replace(self.context, question=None, entities=state.entities, view=state.view)
        return (
            swapped(text, before, self.vocabulary) or hear(text, self.vocabulary, context=before)
        )[0]

    def ask(self, question: Question) -> None:
        """Put a question of somebody else's, as the one that is open from now on."""
        self._pending, self._repeats, self._instead = None, 0, False
        self.context = replace(self.context, question=question)

    def unask(self) -> None:
        """Close the open question."""
        self._close()

    def is_answered_by(self, text: str) -> bool:
        """Whether a text answers the open question, so that its "no" is no cry."""
        question = self.question
        if question is None:
            return False
        if verdict_of(text) is not None or answered(text, question) is not None:
            return True
        return plans.changed(text, question, self.vocabulary) is not None

    def corrects(self, text: str, goals: tuple[Goal, ...], state: RobotState) -> bool:
        """Whether a sentence says by name what of these goals is another: "not the cup, ..."."""
        before = replace(self.context, goals=goals, entities=state.entities, view=state.view)
        return swapped(text, before, self.vocabulary) is not None

    def about(self, goals: tuple[Goal, ...]) -> None:
        """What is said next is about these goals, whatever was asked after them."""
        self._answered = False
        self.context = replace(self.context, goals=goals)

    def not_to_be_had(self) -> None:
        """What was asked for cannot be taken, for the hands are full: "it" is not that."""
        self.context = replace(self.context, object=None)
        self._in_hand = True

    def besides(self, text: str, state: RobotState) -> str:
        """What a cry to halt asks for, as a sentence of its own; empty if it is only cried.

        "No, the blue one" corrects what was asked last, "hold on, go to the hall" is a wish,
        "careful, the glass" is neither.
        """
        self._back_to_order(text, state)
        said = besides(text)
        for one in dict.fromkeys((text, said)):
            outcome = self._read(one, state) if one else None
            goals = outcome.goals if isinstance(outcome, Goals) else ()
            if goals and all(isinstance(goal, Cancel | Resume) for goal in goals):
                return one
            if goals and all(isinstance(goal, Pause) for goal in goals):
                return ""  # it has halted, and is asked about
            waits = any(isinstance(goal, Wait | Balance) for goal in goals)
            if said and not waits and (goals or _is_choice(outcome)):
                return one
        return ""

    def forget(self) -> None:
        """Begin anew: nothing was said, nothing is open."""
        self._close()
        self._asked_before.clear()
        self.context = Context()

    def _close(self) -> None:
        self.context = replace(self.context, question=None)
        self._pending, self._repeats = None, 0

    def _answer(self, text: str, opened: Question, state: RobotState) -> Turn | None:
        """Yes or no to a confirmation, or what changes the plan in it; no to any question."""
        changed = plans.changed(text, opened, self.vocabulary, risk=self.risk)
        if changed is not None:
            self.context = replace(self.context, question=changed)
            if self._pending is not None:
                self._pending = replace(self._pending, goals=changed.goals)
            return changed
        verdict = verdict_of(text)
        if verdict is None or (verdict and opened.kind != "confirmation"):
            return None
        pending = self._pending
        self._close()
        if not verdict:
            halted = small_questions.is_halt(opened)
            busy = halted or (bool(state.doing) and "cancel" in text.lower())
            return Goals(goals=(Cancel(),)) if busy else Reply(text="All right, I leave it.")
        if pending is not None:
            self.context = replace(pending, question=None, said=self.context.said)
        agreed = Goals(goals=opened.goals, parser=opened.parser, instead=self._instead)
        told = told_at_once(text, agreed, state)
        return told if isinstance(told, Reply) else agreed

    def _revised(self, text: str, state: RobotState) -> Turn | None:
        """What takes back what was asked last, or asks it for the others; None if it is neither."""
        if is_undo(text) and state.doing:
            return Goals(goals=(Cancel(),))
        if is_undo_of_several(text):
            return Reply(text="I can undo what was asked last, and no more: say “undo that”.")
        if is_undo(text) or (is_back(text) and not state.doing and self._before):
            if self._before is None:
                return Reply(text="There is nothing that I could undo.")
            things = self._handled if is_things_back(text) else None
            revised = undone(text, *(things or self._before), state)
        elif is_rest(text) and self.context.goals:
            revised = with_the_rest(self.context.goals, state)
        else:
            return None
        self._close()
        if isinstance(revised, str):
            return Reply(text=revised)
        after = replace(self.context, goals=revised)
        return self._settle(text, Goals(goals=revised, elliptic=True), after, state)

    def _understand(self, text: str, state: RobotState, opened: Question | None) -> Turn:
        before = replace(self.context, entities=state.entities, view=state.view)
        other = swapped(text, before, self.vocabulary)
        corrects = is_correction(text) or is_turn(text, before) or other is not None
        text = in_full(text, before, self.vocabulary)
        outcome, after = other or hear(
            text, self.vocabulary, context=before, fallback=self.fallback
        )
        if _ends_it(outcome) and (careful := without_care(text)) != text:
            # nobody who says "dont drop it" wants it to end, unless the rest says so
            outcome, after = hear(careful, self.vocabulary, context=before, fallback=self.fallback)
            if _ends_it(outcome) and isinstance(outcome, Question):
                outcome, after = Refusal(reason=TAKES_CARE), before
        if state.doing and isinstance(outcome, Question) and outcome.goals == (Stop(),):
            outcome = Goals(goals=(Stop(),))  # whatever it hangs on: to stop at once is safe
        if isinstance(outcome, Refusal) and opened and self._repeats < MAX_REPEATS:
            self._repeats += 1
            again = opened.question.removeprefix("I did not get that. ")
            return replace(opened, question=f"I did not get that. {again}", ms=outcome.ms)
        aside = opened is not None and self._set_aside(text, opened, outcome, before, state)
        if isinstance(aside, Reply):
            return replace(aside, ms=outcome.ms)
        answers = opened is not None and not self.dropped
        self._close()
        self._instead = corrects or (answers and self._instead)
        if state.doing and isinstance(outcome, Refusal) and outcome.reason == f"{SHALL_NOT}.":
            goes_on = f"I am at “{state.doing}” and go on with it: “cancel” or “stop” ends it."
            return replace(outcome, reason=goes_on)
        self._in_hand = self._in_hand and after.object is None
        if isinstance(outcome, Goals):
            which = which_in_hand(text, outcome.goals, state) if self._in_hand else None
            if which is not None:
                self.ask(which)
                return which
            outcome = replace(outcome, instead=self._instead)
            return self._settle(text, outcome, after, state)
        self.context = after
        return outcome

    def _set_aside(
        self, text: str, opened: Question, outcome: Turn, before: Context, state: RobotState
    ) -> Reply | None:
        """What becomes of an open question when something is said that does not answer it.

        A question of the person's is answered and leaves it open; one that has to be asked back
        is asked first; anything else to be done is done instead.
        """
        alone, _ = hear(text, self.vocabulary, context=replace(before, question=None))
        if isinstance(alone, Goals) and isinstance(outcome, Goals) and alone.goals == outcome.goals:
            told = told_at_once(text, alone, state)
            if isinstance(told, Question) and small_questions.is_halt(opened):
                told = small_questions.without_offer(told)
            aside = told or small_questions.not_offered(text, opened, alone)
            if isinstance(aside, Reply):
                return aside
            if opened.kind == "missing" and opened.about in queries(outcome.goals):
                return None  # “it” was what was named: that is the answer
            self.dropped = opened.question.removeprefix("I did not get that. ")
            self._asked_before.clear()
        elif isinstance(alone, Question) and isinstance(outcome, Question):
            aside = small_questions.not_offered(text, opened, alone)
            if aside is not None:
                return aside
            self._asked_before.append((opened, self._pending))
        return None

    def _settle(self, text: str, outcome: Goals, after: Context, state: RobotState) -> Turn:
        """Answer what needs no motion, confirm what is risky, and pass on the rest."""
        told = told_at_once(text, outcome, state)
        self._answered = isinstance(told, Reply)
        if isinstance(told, Reply):
            self.context = after
            return replace(told, ms=outcome.ms)
        why = self.risk(outcome.goals) if self.confirm else ""
        if self.confirm and outcome.parser == "model" and not self.agreed:
            why = why or HOW_I_READ_IT
        if told is None and not why:
            self.context = after
            return outcome
        readback = plans.proposal(outcome.goals, why)
        question = told or confirmation(outcome, readback)
        question = replace(question, text=text, ms=outcome.ms)
        self._pending = after
        self.context = replace(self.context, question=question)
        return question


def in_turn(turn: Turn) -> str:
    """What the robot says to a turn, or does about it, in words."""
    if isinstance(turn, Goals):
        return f"I {wording.in_words(turn.goals)}."
    if isinstance(turn, Question):
        return turn.question
    return turn.reason if isinstance(turn, Refusal) else turn.text


def _ends_it(outcome: Outcome) -> bool:
    """Whether all that is understood, or offered, is to end what is being done."""
    return not isinstance(outcome, Refusal) and outcome.goals in ((Cancel(),), (Stop(),))


def _is_choice(outcome: Turn | None) -> bool:
    return isinstance(outcome, Question) and outcome.kind == "choice"
