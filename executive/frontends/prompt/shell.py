"""What comes of a line: a command, an answer, or a sentence. Knows no terminal.

A line is, in this order: a cry to stop; to a robot at work a cry to halt, which is asked about; a
command of the table; the answer to what the robot asks; a sentence, as part of one conversation.
Sentences queue up: each is done when those before it are, or beside them where they do not need the
same parts of the body.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Generator, Iterable
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from executive.behaviours.ask import ANSWERS, Answer, answer_of
from executive.engine.job_book import JobError
from executive.engine.jobs import Job
from executive.frontends.emergency import AT_THE_MACHINE, AT_THE_ROBOT, emergency, plain, undoes
from executive.frontends.prompt.answering import Answering, Out
from executive.frontends.prompt.brake import Brake
from executive.frontends.prompt.command import Command
from executive.frontends.prompt.mistyped import meant as meant_command
from executive.frontends.prompt.mistyped import polite
from executive.frontends.prompt.naming_jobs import NamingJobs
from executive.frontends.prompt.queueing import Queueing
from executive.frontends.prompt.robot import AtWork
from executive.frontends.prompt.understanding import Understanding
from executive.frontends.speaking import Speech
from executive.journal import failures
from executive.meaning.request import Understood
from intents.context import Context, verdict_of
from intents.correcting import is_correction
from intents.dialogue import Dialogue
from intents.goals import Goal
from intents.halting import besides, is_halt
from intents.letters import seen
from intents.outcomes import Question, Refusal
from intents.parser import hear
from intents.state import RobotState
from robot.errors import RobotError

if TYPE_CHECKING:
    from intents.language_model import LanguageModel


class Shell(Answering):
    """Takes lines and says what comes of them.

    Attributes:
        robot: what is spoken to.
        brake: brings it to a stand.
        queue: what was asked for.
        dialogue: what was said.
        folder: of this run.
        leaving: whether the person wants to go.
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
            table: makes the commands (`executive.frontends.prompt.commands.table`).
            folder: of this run.
            model: is asked what the grammar does not understand.
            speech: says aloud what it answers.
        """
        super().__init__(out, speech)
        self.robot = robot
        self.folder = folder
        self.leaving = False
        self._one_line = threading.Lock()
        self.dialogue = Dialogue(robot.where.knowledge.vocabulary(), fallback=model)
        self.brake = Brake(robot, self.dialogue, people=self, model=model)
        self.queue = Queueing(robot, self.brake, people=self)
        self._understanding = Understanding(
            robot,
            self.dialogue,
            brake=self.brake,
            queue=self.queue,
            people=self,
            steer=self.command,
            model=model,
        )
        self._slip = "", 0
        self._afar = False
        self._naming = NamingJobs(
            robot, brake=self.brake, queue=self.queue, people=self, read=self.dialogue.vocabulary
        )
        self.commands: dict[str, Command] = {one.name: one for one in table(self)}

    def stop_at_once(self, text: str) -> bool:
        """Stop if a line is a cry to stop, before anything else looks at it; never waits."""
        said = emergency(text)
        if said is not None:
            self.commands["estop"].run(said.wish if said.undoes else said.rest)
            return True
        if not self.brake.is_cry(plain(text)):
            return False
        self.brake.stop("the operator said stop")
        return True

    def is_emergency(self, text: str) -> bool:
        """Whether a line is about the emergency stop; unless it undoes that, it is pressed here."""
        said = emergency(text)
        if said is not None and not said.undoes:
            self.brake.press()
        return said is not None

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

    def stops_by(self, begun_s: float | None) -> int:
        """How often it had been told to stop by then, in seconds since boot (None: by now)."""
        return self.brake.stops_by(begun_s)

    def stop(self, why: str) -> None:
        """Bring the robot to a stand and end all jobs; from any thread."""
        self.brake.stop(why)

    def stop_unsaid(self, why: str) -> None:
        """The same, without a word."""
        self.brake.stop_unsaid(why)

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
        question = self.robot.executive.question
        answer = answer_of(text, question) if question else None
        return answer if answer == text or self.dialogue.question is None else None

    def help(self, text: str) -> bool:
        """Tell the job that asks for help what a line answers; whether it is an answer."""
        answer = self._helped(text.casefold().strip(" .!"))
        if answer is not None:
            self.robot.executive.answer(answer)
        return answer is not None

    def unhelped(self, text: str = "") -> bool:
        """Give up where a job asks for help, unless a line answers it; whether it was given up."""
        executive = self.robot.executive
        if not executive.awaits_help or self._helped(text.casefold().strip(" .!")) is not None:
            return False
        self.out("Nobody answers, so I give up.")
        with suppress(JobError):  # it may have ended meanwhile
            executive.answer("give up")
        return True

    @property
    def gone(self) -> str:
        """That the robot is gone, and what to do; empty while it is there."""
        lost = self.robot.lost
        if lost is None:
            return ""
        cure = failures.suggestion(lost.code, lost.suggestion)
        return f"The robot is gone: {lost.cause}; {cure}."

    def leave(self) -> None:
        """Let nothing begin any more, and bring the robot to a stand."""
        self.leaving = True
        self.brake.leave()

    def line(self, text: str, *, stops: int | None = None, afar: bool = False) -> None:
        """Do what a line says; never raises for what is in it.

        Args:
            text: what was typed.
            stops: what `stops` was by then (None: as now), by whom it was looked then whether it
                is a cry; a stop since then is about this line too, which is read no more: many
                may wait, and the robot comes to a stand meanwhile.
            afar: whether whoever typed it may not see the robot: no emergency stop is undone then.
        """
        before = self.stops if stops is None else stops
        if self.brake.stopped_since(stops):
            with self._turn(before):
                self.refuse_stopped(text)
            return
        try:
            if not (afar and undoes(text)) and self.stop_at_once(text):
                return
        except RobotError as error:
            self.refuse(f"Not done: {error}")
            self.ask_to_go_on()
            return
        with self._turn(before, afar=afar):
            halted = self.halt_at_once(text)
            text = "".join(one if one.isprintable() else " " for one in seen(text)).strip()
            if self.brake.stopped:
                self.refuse_stopped(text)
            elif halted:
                self._take_halted(text)
            elif text:
                self._take(text)

    def ask_again(self) -> None:
        """Ask what was asked by an executive before this one: whether to go on after a halt."""
        self.brake.halt.on = self.brake.halt.told = True
        self.ask_to_go_on()

    def hear(
        self, text: str, *, stops: int, risk: Callable[[tuple[Goal, ...]], str] | None = None
    ) -> None:
        """Do what a sentence says that was heard when `stops` was so much; never raises for it.

        `risk` says why its goals are read back (None: as those of a line that was typed).
        """
        with self._turn(stops, risk=risk):
            if self.halt_at_once(text, spoken=True):
                self._take_halted(text)
            elif not self._names_jobs(text):
                self.sentence(text)

    @contextmanager
    def _turn(
        self,
        stops: int,
        *,
        afar: bool = False,
        risk: Callable[[tuple[Goal, ...]], str] | None = None,
    ) -> Generator[None]:
        """One line: people at the terminal and at pages take turns."""
        with self._one_line:
            self.brake.stops_before = stops
            typed, self.dialogue.risk = self.dialogue.risk, risk or self.dialogue.risk
            self._afar = afar
            try:
                yield
            except RobotError as error:
                self.refuse(f"Not done: {error}")
            finally:
                self.brake.stops_before = None
                self.dialogue.risk = typed
            self.ask_to_go_on()

    def sentence(self, text: str, *, urgent: bool = False) -> None:
        """Understand a sentence in the conversation so far, and do it."""
        understood = self.understand(text)
        if isinstance(understood, Understood):
            self.submit(understood, urgent=urgent)
        if self.dialogue.question is None:
            self.queue.corrected = None  # what was corrected is known, or nothing was

    def understand(self, text: str, *, steers: bool = True) -> Understood | None:
        """What a sentence asks for, as `Understanding` says it."""
        return self._understanding.understand(text, steers=steers)

    def submit(self, understood: Understood, *, urgent: bool = False, **how: Any) -> None:
        """Queue a task (`how`: as for `Robot.submit`), and say where it stands."""
        if self.gone:
            self.refuse(self.gone)
        else:
            self.queue.submit(understood, urgent=urgent, **how)

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
        if self._afar and undoes(text):  # also as what a slip was meant to be
            self.refuse(AT_THE_ROBOT)
        elif offered and (said := verdict_of(text)) is not None:
            if said:
                self._take(offered)
            else:
                self.out("Nothing was done.")
        elif command is not None and command.accepts(rest):
            self._run(command, rest)
        elif command is not None and command.accepts("") and polite(rest):
            command.run("")
        elif self._names_jobs(text):
            pass
        elif not (self.asks and not rest) and (slip := meant_command(text, self.commands)):
            self._slip = slip, self.brake.stops
            self.refuse(f"Did you mean `{slip}`?")
        elif self.help(text):
            pass
        elif command is not None and self._is_no_sentence(text):
            self.refuse(f"Not done: {command.misfit(rest)}", f"Use: {command.usage}")
        else:
            self.sentence(text)

    def _run(self, command: Command, rest: str) -> None:
        if self._afar and command.files(rest):
            self.refuse(AT_THE_MACHINE)
        else:
            command.run(rest)

    def _names_jobs(self, text: str) -> bool:
        """Whether a line is about jobs by what they are called, and was done."""
        if self.dialogue.is_answered_by(text):
            return False
        return self._naming.take(text, self._replace_job)

    def _replace_job(self, job: Job, goals: tuple[Goal, ...]) -> None:
        """Put other goals in the place of a job."""
        understood = self._understanding.means(goals)
        if understood is not None:
            self.queue.corrects, self.queue.corrected = True, job.number
            self.submit(understood)

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
        self._tell_of_halt()
        if self._names_jobs(text):
            return
        state = self._understanding.state()
        self._understanding.turn_to_order(text, state)
        said = self.dialogue.besides(text, state) or self._besides_of_halted(text, state)
        if said:
            self.sentence(said)
        elif is_correction(text) and (left := besides(text)):
            self.refuse(f"I do not know what “{left}” is to change.")

    def _besides_of_halted(self, text: str, state: RobotState) -> str:
        """What a cry corrects of a job that is to be done, where it means nothing else.

        The one that it has halted comes first, then the newest.
        """
        before = self.dialogue.context
        for job in (self.brake.halt.kept[0], *self.queue.open_orders()):
            goals = self.queue.goals_of(job)
            self.dialogue.about(goals)
            if goals and (said := self.dialogue.besides(text, state)):
                self.queue.corrected = job.number
                return said
        self.dialogue.about(before.goals)
        return ""

    def _tell_of_halt(self) -> None:
        """Say that the robot halts, once and before anything is asked about it."""
        halt = self.brake.halt
        if not halt.told:
            halt.told = True
            self.out("Halting.")

    def ask_to_go_on(self) -> None:
        """Ask what is to become of the jobs that were halted, where nothing else is asked."""
        if not self.brake.halt.on or self.dialogue.question is not None:
            return
        question = self.brake.halt.question()
        if question is None:
            self.brake.halt.end()
            return
        self._tell_of_halt()
        self.dialogue.ask(question)
        self.answer(question.question)
