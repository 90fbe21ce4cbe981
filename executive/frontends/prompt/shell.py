"""What comes of a line: a command, an answer, or a sentence. Knows no terminal.

A line is, in this order: a cry to stop; to a robot at work a cry to halt, which is asked about; a
command of the table; the answer to what the robot asks; a sentence, as part of one conversation.
Sentences queue up: each is done when those before it are, or beside them where they do not need the
same parts of the body.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from executive.behaviours.ask import ANSWERS, Answer, answer_of
from executive.behaviours.breakpoints import fits
from executive.blackboard import HELD, WORLD
from executive.engine.executive import JobError
from executive.engine.jobs import OVER, UNDER_WAY, Job
from executive.frontends.prompt import foresight
from executive.frontends.prompt.brake import Brake
from executive.frontends.prompt.command import Command
from executive.frontends.prompt.mistyped import meant as meant_command
from executive.frontends.prompt.mistyped import polite
from executive.frontends.prompt.robot import AtWork
from executive.frontends.prompt.state import robot_state
from executive.frontends.speaking import Speech
from executive.journal import failures
from executive.meaning.request import Refused, Understood, meant, unable
from executive.trees.parts import errands
from intents.context import Context, verdict_of
from intents.dialogue import Dialogue
from intents.goals import Cancel, Goal, Pause, Resume, Stop
from intents.halting import besides, is_halt
from intents.letters import bare, seen, without_sequences
from intents.outcomes import Goals, Question, Refusal, Reply, Turn
from intents.parser import hear
from intents.plans import numbered
from intents.state import RobotState
from intents.wording import in_words
from robot.errors import RobotError
from robot.misfits import listed, shown
from robot.se3 import SE3

if TYPE_CHECKING:
    from intents.language_model import LanguageModel

Out = Callable[[str], None]
MOST_DIGITS = 9
"""Of a job's number; a run has a few hundred."""


class Shell:
    """Takes lines and says what comes of them.

    Attributes:
        robot: what is spoken to.
        brake: brings it to a stand.
        out: says a line to people.
        speech: says aloud what it answers.
        folder: of this run.
        leaving: whether the person wants to go.
        refused: how many lines led to nothing, because they could not be meant.
    """

    def __init__(
        self,
        robot: AtWork,
        out: Out,
        *,
        table: Callable[[Shell], Iterable[Command]],
        folder: Path,
        model: LanguageModel | None = None,
        speech: Speech | None = None,
    ) -> None:
        """Begin a conversation.

        Args:
            robot: what is spoken to.
            out: says a line to people.
            table: makes the commands (`executive.frontends.prompt.commands`).
            folder: of this run.
            model: is asked what the grammar does not understand.
            speech: says aloud what it answers.
        """
        self.robot = robot
        self.out = out
        self.speech = speech or Speech()
        self.folder = folder
        self.leaving = False
        self.refused = 0
        self._stops_before: int | None = None
        self._one_line = threading.Lock()
        self.dialogue = Dialogue(robot.where.knowledge.vocabulary(), fallback=model)
        self.brake = Brake(
            robot,
            self.dialogue,
            out=self._to_people,
            speech=self.speech,
            model=model,
        )
        self._model = model
        if model is not None:
            model.unable = self._unable
        self._holds: tuple[str, ...] = ()
        self._asked: dict[int, tuple[Understood, SE3 | None]] = {}
        self._corrects = False
        self._slip = "", 0
        self.commands: dict[str, Command] = {one.name: one for one in table(self)}

    def stop_at_once(self, text: str) -> bool:
        """Stop if a line is a cry to stop, before anything else looks at it; never waits."""
        text = _plain(text)
        if text.startswith("estop"):
            self.commands["estop"].run(text.removeprefix("estop").strip())
            return True
        if not self.brake.is_cry(text):
            return False
        self.brake.stop("the operator said stop")
        return True

    def is_emergency(self, text: str) -> bool:
        """Whether a line is about the emergency stop; unless it undoes that, it is pressed here."""
        name, *rest = _plain(text).split(maxsplit=1) or [""]
        if not name.startswith("estop"):
            return False
        if rest not in (["release"], ["reset"]):
            self.brake.press()
        return True

    @property
    def asks(self) -> bool:
        """Whether the person is asked something, by the conversation or by a job."""
        return self.dialogue.question is not None or bool(self.robot.executive.question)

    @property
    def asked(self) -> tuple[str, tuple[str, ...]] | None:
        """What the person is asked, and what can be answered where that is limited."""
        question = self.dialogue.question
        if question is not None:
            return question.question, tuple(choice.label for choice in question.choices)
        wanted = self.robot.executive.question
        return (wanted, ANSWERS) if wanted else None

    @property
    def stops(self) -> int:
        """How often the robot was told to stop; a line from before comes to nothing."""
        return self.brake.stops

    def stop(self, why: str) -> None:
        """Bring the robot to a stand and end all jobs; from any thread."""
        self.brake.stop(why)

    def command(self, name: str) -> None:
        """Do what a command does that takes no words."""
        self.commands[name].run("")

    def halt_at_once(self, text: str, *, busy: bool | None = None, spoken: bool = False) -> bool:
        """Halt a robot at work if a line is a cry that ends nothing; never waits.

        Args:
            text: the line.
            busy: whether there is something to halt (None: if there are jobs).
            spoken: whether it was heard; commands are typed.
        """
        at_work = self.robot.busy if busy is None else busy
        if not (at_work or self.brake.halt.on) or not is_halt(text):
            return False
        if self._is_answer(text) or (not spoken and self._is_command(text)):
            return False
        self.brake.halt_robot()
        return True

    def _is_answer(self, text: str) -> bool:
        """Whether a line that may be a cry answers what is asked: "no", "give up"."""
        return self._helped(text) is not None or self.dialogue.is_answered_by(text)

    def _helped(self, text: str) -> Answer | None:
        """The answer that a line is to what a job asks; a mere "yes" is for what was asked here."""
        answer = answer_of(text) if self.robot.executive.question else None
        return answer if answer == text or self.dialogue.question is None else None

    def help(self, text: str) -> bool:
        """Tell the job that asks for help what a line answers; whether it is an answer."""
        answer = self._helped(text.casefold().strip(" .!"))
        if answer is not None:
            self.robot.executive.answer(answer)
        return answer is not None

    @property
    def gone(self) -> str:
        """That the robot is gone, and what to do; empty while it is there."""
        lost = self.robot.lost
        if lost is None:
            return ""
        cure = failures.suggestion(lost.code, lost.suggestion)
        return f"The robot is gone: {lost.cause}; {cure}."

    def _to_people(self, text: str) -> None:
        """Say a line by what `out` is by then: pages join after the start."""
        self.out(text)

    def answer(self, text: str) -> None:
        """Say a line to people, and aloud."""
        self.out(text)
        self.speech.say(text)

    def leave(self) -> None:
        """Let nothing begin any more, and bring the robot to a stand."""
        self.leaving = True
        self.brake.leave()

    def line(self, text: str, *, stops: int | None = None) -> None:
        """Do what a line says; never raises for what is in it.

        Args:
            text: what was typed.
            stops: what `stops` was by then; a stop since then is about this line too.
        """
        try:
            if self.stop_at_once(text):
                return
        except RobotError as error:
            self._refuse(f"Not done: {error}")
            self.ask_to_go_on()
            return
        with self._one_line:  # people at the terminal and at pages take turns
            self._line(text, stops=stops)

    def _line(self, text: str, *, stops: int | None) -> None:
        self._stops_before = stops
        try:
            halted = self.halt_at_once(text)
            text = "".join(one if one.isprintable() else " " for one in seen(text)).strip()
            if self._stopped:
                self._refuse_stopped(text)
            elif halted:
                self._take_halted(text)
            elif text:
                self._take(text)
        except RobotError as error:
            self._refuse(f"Not done: {error}")
        finally:
            self._stops_before = None
        self.ask_to_go_on()

    def ask_again(self) -> None:
        """Ask what was asked by an executive before this one: whether to go on after a halt."""
        self.brake.halt.on = True
        self.ask_to_go_on()

    def hear(self, text: str, *, stops: int) -> None:
        """Do what a sentence says that was heard when `stops` was so much; never raises for it."""
        with self._one_line:
            self._hear(text, stops=stops)

    def _hear(self, text: str, *, stops: int) -> None:
        self._stops_before = stops
        try:
            if self.halt_at_once(text, spoken=True):
                self._take_halted(text)
            else:
                self.sentence(text)
        except RobotError as error:
            self._refuse(f"Not done: {error}")
        finally:
            self._stops_before = None
        self.ask_to_go_on()

    def sentence(self, text: str, *, urgent: bool = False) -> None:
        """Understand a sentence in the conversation so far, and do it."""
        understood = self.understand(text)
        if isinstance(understood, Understood):
            self.submit(understood, urgent=urgent)

    def understand(self, text: str, *, steers: bool = True) -> Understood | None:
        """What a sentence asks for; None when something else was said about it already.

        One that only steers the jobs ("pause") does so at once, if `steers`.
        """
        robot = self.robot
        state = self._state()
        if self._model is not None:
            self._model.trouble = ""
            if not robot.busy:
                self._model.begin_mission()
        answers = self.dialogue.question is not None
        turn = self.dialogue.hear(text, state)
        if self._stopped:  # it may have taken as long as a language model does
            self.dialogue.forget()
            self._refuse_stopped(text)
            return None
        if self.dialogue.dropped and not self.brake.halt.on:
            self.out(f"I ask no more: {self.dialogue.dropped}")
        understood = self._heed(text, turn, state, answers=answers, steers=steers)
        still = self.dialogue.question
        if still is not None and not isinstance(turn, Question):
            about = f"“{still.text}”: " if still.text else ""
            self.answer(f"Still open: {about}{still.question}")
        return understood

    def _state(self) -> RobotState:
        """What the robot knows of itself, now."""
        robot = self.robot
        state = robot_state(robot.executive, robot.session.runtime.link, robot.where.knowledge)
        world = robot.executive.board.read(WORLD)
        X_WS = on_the_floor(world.X_WB) if world is not None else None
        under_way = self.under_way()
        asked = self._asked.get(under_way[0].number) if under_way else None
        return replace(
            state,
            examples=lambda: foresight.examples(robot.where, X_WS),
            foresee_s=lambda: foresight.takes_s(asked[0], robot.where, asked[1]) if asked else None,
        )

    def _tell_trouble(self) -> None:
        if self._model is not None and self._model.trouble:
            self.out(f"The language model was of no help: {self._model.trouble}.")

    def _unable(self, goals: tuple[Goal, ...]) -> str:
        """Why goals that a language model makes cannot be done."""
        return unable(goals, self.robot.where, held=self._held(), state=self._state())

    def _heed(
        self, text: str, turn: Turn, state: RobotState, *, answers: bool, steers: bool
    ) -> Understood | None:
        """Say what a turn of the conversation leads to, steer the jobs, or return what is asked."""
        asks_or_not = isinstance(turn, Question | Refusal) and not answers
        if asks_or_not and is_halt(text) and not besides(text):
            self.dialogue.unask()
            self.answer(self.brake.standing())  # to a robot that moves it would have been a cry
        elif isinstance(turn, Reply):
            self.answer(turn.text)
        elif isinstance(turn, Question):
            self.answer(turn.question)
            self._tell_trouble()
        elif isinstance(turn, Refusal):
            self._refuse(f"Not understood: {turn.reason}", "`help` shows what can be said.")
            self._tell_trouble()
        else:
            # an answer ("no, the blue one") says nothing by itself: the job is called what it means
            steering = all(isinstance(goal, Stop | Pause | Resume | Cancel) for goal in turn.goals)
            if not steering:
                if turn.parser == "model" and not answers:
                    self.answer(f"I shall do this:\n{numbered(turn.goals)}")
                by_itself = not (answers or turn.instead or turn.elliptic)
                return self._settle(text if by_itself else in_words(turn.goals), turn, state)
            if steers:
                self._steer(turn.goals)
            else:
                self.answer(f"I would {in_words(turn.goals)} at once.")
        return None

    def submit(self, understood: Understood, *, urgent: bool = False, **how: Any) -> None:
        """Queue a task (`how`: as for `Robot.submit`), and say where it stands."""
        if self.gone:
            self._refuse(self.gone)
            return
        self._make_room(understood.text, urgent=urgent)
        number = self.brake.unless_stopped(
            self._stops_before, lambda: self.robot.submit(understood, urgent=urgent, **how)
        )
        if number is None:
            self._refuse_stopped(understood.text)
            return
        self._holds = understood.holds
        world = self.robot.executive.board.read(WORLD)
        self._asked[number] = understood, on_the_floor(world.X_WB) if world is not None else None
        live = {job.number: job for job in self.robot.executive.jobs if job.state not in OVER}
        mine = live.pop(number, None)
        self._tell_of_breaks(understood)
        before = [
            job
            for job in live.values()
            if mine and job.resources & mine.resources and not self.brake.halt.gave_up(job)
        ]
        if before and not urgent:
            self.answer(f"Queued as {number}, with {len(before)} before it.")
        if self.robot.executive.pause_wanted and not self.brake.halt.on:
            self.answer("The robot is paused: `resume` lets it begin.")

    def steps_to_do(self) -> list[str]:
        """The names of the steps of all that is to be done, as far as it was asked for here."""
        jobs = [job for job in self.robot.executive.jobs if job.state not in OVER]
        asked = [self._asked[job.number][0] for job in jobs if job.number in self._asked]
        return list(dict.fromkeys(step.name for one in asked for step in errands(one.task)))

    def _tell_of_breaks(self, understood: Understood) -> None:
        """Say that a job will not be held, where breakpoints were set to hold something."""
        breaks = self.robot.executive.breaks
        names = list(dict.fromkeys(step.name for step in errands(understood.task)))
        if breaks and names and not any(fits(one, name) for one in breaks for name in names):
            self.out(f"  No breakpoint ({listed(breaks)}) holds a step of it: {listed(names)}.")

    def _make_room(self, text: str, *, urgent: bool) -> None:
        """End what a task takes the place of: what was halted for it, or what it corrects."""
        corrects, self._corrects = self._corrects, False
        last = max(self._asked, default=0)
        jobs = [job for job in self.robot.executive.jobs if job.state not in OVER]
        replaced = [job for job in jobs if corrects and job.number == last]
        comes_first = urgent or "first" in text.casefold().split()
        if self.brake.halt.on and not replaced and not comes_first:
            replaced = self.brake.halt.kept
        if replaced:
            self.brake.halt.give_up(replaced, "something else was asked for instead")
            self.answer(f"Instead of “{replaced[0].text}”.")
        if self.brake.halt.on and (comes_first or not self._still_under_way()):
            self.brake.halt.end()

    def _still_under_way(self) -> list[Job]:
        """The jobs under way that were not given up."""
        return [job for job in self.brake.halt.kept if job.state in UNDER_WAY]

    def under_way(self) -> list[Job]:
        """The jobs that have begun and are not over."""
        return [job for job in self.robot.executive.jobs if job.state in UNDER_WAY]

    def _is_command(self, text: str) -> bool:
        """Whether a line is a command, which says itself what is to be halted: `break off`."""
        first, _, rest = text.partition(" ")
        command = self.commands.get(first.casefold())
        return command is not None and (command.accepts(rest.strip()) or polite(rest))

    def _take(self, text: str) -> None:
        first, _, rest = text.partition(" ")
        rest = rest.strip()
        command = self.commands.get(first.casefold())
        offered = self._take_slip()
        if offered and (said := verdict_of(text)) is not None:
            if said:
                self._take(offered)
            else:
                self.out("Nothing was done.")
        elif command is not None and command.accepts(rest):
            command.run(rest)
        elif command is not None and command.accepts("") and polite(rest):
            command.run("")
        elif not (self.asks and not rest) and (slip := meant_command(text, self.commands)):
            self._slip = slip, self.brake.stops
            self._refuse(f"Did you mean `{slip}`?")
        elif self.help(text):
            pass
        elif command is not None and self._is_no_sentence(text):
            self._refuse(f"Not done: {command.misfit(rest)}", f"Use: {command.usage}")
        else:
            self.sentence(text)

    def _is_no_sentence(self, text: str) -> bool:
        """Whether two words that begin as a command mean nothing else: "run nope", "help foo"."""
        if len(text.split()) != 2 or is_halt(text) or self.dialogue.is_answered_by(text):
            return False
        alone, _ = hear(text, self.dialogue.vocabulary, context=Context())
        return isinstance(alone, Question | Refusal)

    def _take_slip(self) -> str:
        """The command that was offered for the line before; a stop since then withdraws it."""
        (offered, stops), self._slip = self._slip, ("", 0)
        return "" if self.brake.stopped_since(stops) else offered

    def _take_halted(self, text: str) -> None:
        """Do what a cry that the robot has halted for says besides."""
        if not self.brake.halt.kept:
            self.out(self.brake.standing())
            return
        self.out("Halting.")
        said = self.dialogue.besides(text, self._state())
        if said:
            self.sentence(said)

    def ask_to_go_on(self) -> None:
        """Ask what is to become of the jobs that were halted, where nothing else is asked."""
        if not self.brake.halt.on or self.dialogue.question is not None:
            return
        question = self.brake.halt.question()
        if question is None:
            self.brake.halt.end()
            return
        self.dialogue.ask(question)
        self.answer(question.question)

    def _settle(self, text: str, turn: Goals, state: RobotState) -> Understood | None:
        """What the goals mean here."""
        self._corrects = turn.instead
        expected = self.robot.busy and not (self.brake.halt.on or turn.instead)
        held = self._holds if expected else self._held()
        understood = meant(text, turn.goals, self.robot.where, held=held, state=state)
        if isinstance(understood, Refused):
            self._refuse(f"Not done: {understood.reason}", understood.suggestion)
            return None
        return understood

    @property
    def _stopped(self) -> bool:
        """Whether there was a stop since the line that is being done was entered."""
        return self.brake.stopped_since(self._stops_before)

    def _refuse_stopped(self, text: str) -> None:
        self._refuse(f"Not done: “{text}” was there when you said stop")

    def _refuse(self, why: str, cure: str = "") -> None:
        self.refused += 1
        self.answer(why)
        if cure:
            self.out(f"  {cure}")

    def _held(self) -> tuple[str, ...]:
        return tuple(self.robot.executive.board.read(HELD).values())

    def _steer(self, goals: tuple[Goal, ...]) -> None:
        """Steer the jobs as commands would."""
        for goal in goals:
            self.commands[type(goal).__name__.casefold()].run("")


def on_the_floor(X_WB: SE3) -> SE3:
    """Where the robot stands: its base, on the floor and upright."""
    x_m, y_m, _ = X_WB.p
    return SE3.from_xy_yaw(x_m, y_m, X_WB.yaw_rad)


def number_of(text: str) -> int:
    """A job's number as typed.

    Raises:
        JobError: if it is none.
    """
    if not (text.isdecimal() and len(text) <= MOST_DIGITS):
        raise JobError(f"{shown(text)} is no job's number; `goals` shows them")
    return int(text)


def _plain(text: str) -> str:
    """A line without what cannot be seen."""
    return bare(without_sequences(text)).strip()
