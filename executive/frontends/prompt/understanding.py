"""What a sentence asks for here: it is answered, asked back about, refused, or to be done."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from msgspec.structs import replace

from executive.frontends.prompt import foresight
from executive.frontends.prompt.answering import Answering
from executive.frontends.prompt.brake import Brake
from executive.frontends.prompt.queueing import Queueing
from executive.frontends.prompt.robot import AtWork
from executive.frontends.prompt.state import robot_state
from executive.meaning.request import Refused, Understood, meant, unable
from intents.dialogue import Dialogue
from intents.goals import Cancel, Goal, Pause, Resume, Stop
from intents.halting import besides, is_halt
from intents.outcomes import Goals, Question, Refusal, Reply, Turn
from intents.plans import numbered
from intents.state import RobotState
from intents.wording import in_words

if TYPE_CHECKING:
    from intents.language_model import LanguageModel


class Understanding:
    """Understands sentences one after the other, each with what was said before it."""

    def __init__(
        self,
        robot: AtWork,
        dialogue: Dialogue,
        *,
        brake: Brake,
        queue: Queueing,
        people: Answering,
        steer: Callable[[str], None],
        model: LanguageModel | None,
    ) -> None:
        """Nothing was said yet.

        Args:
            robot: that is spoken to.
            dialogue: what was said so far.
            brake: knows of stops and halts.
            queue: knows what was asked for.
            people: are answered.
            steer: does what a command does that takes no words: "pause".
            model: is asked what the grammar does not understand.
        """
        self._robot = robot
        self._dialogue = dialogue
        self._brake = brake
        self._queue = queue
        self._people = people
        self._steer = steer
        self._model = model
        if model is not None:
            model.unable = self._unable

    def understand(self, text: str, *, steers: bool = True) -> Understood | None:
        """What a sentence asks for; None when something else was said about it already.

        One that only steers the jobs ("pause") does so at once, if `steers`.
        """
        state, dialogue = self.state(), self._dialogue
        if self._model is not None:
            self._model.trouble = ""
            if not self._robot.busy:
                self._model.begin_mission()
        answers = dialogue.question is not None
        self.turn_to_order(text, state)
        turn = dialogue.hear(text, state)
        if self._brake.stopped:  # it may have taken as long as a language model does
            dialogue.forget()
            self._people.refuse_stopped(text)
            return None
        if dialogue.dropped and not self._brake.halt.on:
            self._people.out(f"Dropped, and nothing is done about it: “{dialogue.dropped}”")
        understood = self._heed(text, turn, state, answers=answers, steers=steers)
        still = dialogue.question
        if understood and steers and still is not None and still.goals == (Resume(),):
            dialogue.unask()  # what is to be done instead answers it
            still = None
        if still is not None and not isinstance(turn, Question):
            about = f"“{still.text}”: " if still.text else ""
            self._people.answer(f"Still open: {about}{still.question}")
        return understood

    def turn_to_order(self, text: str, state: RobotState) -> None:
        """Let what says by name what it corrects correct the newest order that speaks of it.

        That may be one which waits: "not the bottle, the box".
        """
        for job in self._queue.open_orders():
            goals = self._queue.goals_of(job)
            if self._dialogue.corrects(text, goals, state):
                self._dialogue.about(goals)
                self._queue.corrected = job.number
                return

    def state(self) -> RobotState:
        """What the robot knows of itself, now."""
        robot, queue = self._robot, self._queue
        state = robot_state(robot.executive, robot.session.runtime.link, robot.where.knowledge)
        X_WS, under_way = queue.X_WS, queue.under_way()
        return replace(
            state,
            examples=lambda: foresight.examples(robot.where, X_WS),
            foresee_s=lambda: queue.foresee_s(under_way[0]) if under_way else None,
        )

    def _unable(self, goals: tuple[Goal, ...]) -> str:
        """Why goals that a language model makes cannot be done."""
        held = self._queue.held_now()
        return unable(goals, self._robot.where, held=held, state=self.state())

    def _heed(
        self, text: str, turn: Turn, state: RobotState, *, answers: bool, steers: bool
    ) -> Understood | None:
        """Say what a turn of the conversation leads to, steer the jobs, or return what is asked."""
        people = self._people
        asks_or_not = isinstance(turn, Question | Refusal) and not answers
        if asks_or_not and is_halt(text) and not besides(text):
            self._dialogue.unask()
            people.answer(self._brake.standing())  # to one that moves it would have been a cry
        elif isinstance(turn, Reply):
            people.answer(turn.text)
        elif isinstance(turn, Question):
            people.ask_back(turn.question)
            self._tell_trouble()
        elif isinstance(turn, Refusal):
            people.refuse(f"Not understood: {turn.reason}", "`help` shows what can be said.")
            self._tell_trouble()
        elif not all(isinstance(goal, Stop | Pause | Resume | Cancel) for goal in turn.goals):
            if turn.parser == "model" and not answers:
                people.answer(f"I shall do this:\n{numbered(turn.goals)}")
            # an answer ("no, the blue one") says nothing by itself: the job is called what it means
            by_itself = not (answers or turn.instead or turn.elliptic)
            return self._settle(text if by_itself else in_words(turn.goals), turn, state)
        elif steers:
            for goal in turn.goals:
                self._steer(type(goal).__name__.casefold())
        else:
            people.answer(f"I would {in_words(turn.goals)} at once.")
        return None

    def means(self, goals: tuple[Goal, ...]) -> Understood | None:
        """What goals mean here that nobody says in words; None when it is said why nothing."""
        return self._settle(in_words(goals), Goals(goals=goals), self.state())

    def _settle(self, text: str, turn: Goals, state: RobotState) -> Understood | None:
        """What the goals mean here."""
        self._queue.corrects = turn.instead
        held = self._queue.held_then()
        understood = meant(text, turn.goals, self._robot.where, held=held, state=state)
        if isinstance(understood, Refused):
            if understood.outcome == "hands_full":
                self._dialogue.not_to_be_had()
            self._people.refuse(f"Not done: {understood.reason}", understood.suggestion)
            return None
        if turn.reason:
            self._people.out(f"  {turn.reason}")
        return understood

    def _tell_trouble(self) -> None:
        if self._model is not None and self._model.trouble:
            self._people.out(f"The language model was of no help: {self._model.trouble}.")
