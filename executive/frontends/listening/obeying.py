"""`humanoid listen` with a robot: what is said is read back, and done when that is confirmed."""

from __future__ import annotations

import re
from collections import deque
from concurrent.futures import ThreadPoolExecutor

from executive.frontends.emergency import emergency
from executive.frontends.launching import from_plain_options
from executive.frontends.listening.hearing import audio_errors, ear, sound
from executive.frontends.listening.options import Listen
from executive.frontends.output import as_mistake, say
from executive.frontends.prompt import cli
from executive.frontends.prompt.shell import Shell
from executive.frontends.reading_back import Risk, doubtful_risk, heard_risk
from executive.frontends.speaking import Speech, able
from executive.journal.journal import Event
from intents.risks import risk
from intents.speech.audio import RATE_HZ
from intents.speech.ear import Ear, Spoken
from intents.speech.voice import voice
from intents.stopping import is_stop
from robot.bringup.mailbox import Handle
from robot.exit_status import ExitStatus

_SENTENCE = re.compile(r"(?<=[.!?;])\s+")


def obey(options: Listen, handle: Handle | None = None) -> int:
    """Listen until the recording ends or the person leaves; returns the exit status.

    Raises:
        RobotError: a file is wrong (ConfigError), or a part does not start.
    """
    with audio_errors():  # they are no mistakes of this software, to be started again after
        with sound(options):
            pass  # what is missing is said before a robot is started
        program = options.voice.value
        if program == "auto" and not able(wanted=True, model=options.voice_model):
            program = "none"
        with Speech(voice(program, model=options.voice_model)) as speech:
            return _converse(options, handle, speech)


in_executive = from_plain_options(Listen, obey)


def _converse(options: Listen, handle: Handle | None, speech: Speech) -> int:
    """Listen, and do what is said."""
    prompt = cli.Begun(
        world=options.world, robot=options.robot, seed=options.seed, fast=options.fast,
        run_dir=options.run_dir, model=options.model, reality=options.reality,
        eyes=options.eyes,
        localisation=options.localisation,
        driver=options.driver, camera=options.camera, view=options.view, record=options.record,
    )  # fmt: skip
    with cli.conversation(prompt, "listen", handle=handle, speech=speech) as shell:
        listener = ear(options, shell.robot.where.knowledge.vocabulary())
        recorded = options.file is not None
        conversation = Conversation(shell, listener, recorded=recorded, confirm=not options.yes)
        status = conversation.run(options)
    speech.finish()
    return status


REMEMBERED = 5000
"""Blocks of sound of which it is known how often the robot had been told to stop by then."""


class Conversation:
    """A person and a robot, both of whom speak.

    What was heard is worked off in a thread of its own, however long that takes (a language model
    has seconds), so that a cry to stop is heard meanwhile.
    """

    def __init__(
        self, shell: Shell, listener: Ear, *, recorded: bool, confirm: bool = True
    ) -> None:
        """Begin.

        Args:
            shell: does what a sentence says, and answers.
            listener: hears it.
            recorded: whether a recording is listened to, which hears nothing of the robot: each
                job is done before it goes on.
            confirm: whether what moves the robot is read back however clearly it was heard.
        """
        self._shell = shell
        self._ear = listener
        self._recorded = recorded
        self._stops = shell.brake.stops
        self._left_out = False
        self._heard_s = 0.0
        self._heard_by: deque[tuple[float, int]] = deque(maxlen=REMEMBERED)
        self._risk = heard_risk if confirm else risk
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="sentences")
        shell.speech.screen = self._said
        shell.robot.session.journal.listen(self._note)

    def run(self, options: Listen) -> int:
        """Listen to the end; returns the exit status."""
        try:
            self._listen(options)
        finally:
            if self._over:
                self._shell.leave()
            self._worker.shutdown(wait=True)
        return self._status()

    def _listen(self, options: Listen) -> None:
        shell = self._shell
        with sound(options) as blocks:
            for block in blocks:
                self._heard_s += len(block.sound) / RATE_HZ
                self._heard_by.append((self._heard_s, shell.brake.stops))
                speaking = shell.speech.speaking and not self._recorded
                self._ear.at_work = shell.robot.busy
                for one in self._ear.push(block.sound, speaking=speaking, heeded=block.heeded):
                    self.take(one)
                for one in self._ear.finish() if block.ends else ():
                    self.take(one)
                if self._over:
                    break
            else:
                for one in self._ear.finish():
                    self.take(one)

    @property
    def _over(self) -> bool:
        """Whether the robot is gone, or somebody wanted to leave; standing since ends no wish."""
        robot = self._shell.robot
        return robot.lost is not None or robot.interrupts.pressed > 0

    def take(self, one: Spoken) -> None:
        """Do what was said; of what comes after a wish to leave, only a stop."""
        shell = self._shell
        if one.kind == "ignored":
            if one.text:
                say(f"(“{one.text}” passed over: {one.why})")
            return
        say(f"> {one.text}")
        if (named := emergency(one.text)) is not None and not named.undoes:
            shell.stop_at_once(one.text)
            self._stops = shell.brake.stops
        elif one.kind == "stop" or shell.brake.is_cry(one.text):
            shell.brake.stop("a cry to stop was heard")
            self._stops = shell.brake.stops
        elif self._over:
            return
        elif self._recorded and shell.brake.stops != self._stops:
            if not self._left_out:
                say(f"Not done: “{one.text}”, and what follows it: the robot was told to stop")
            self._left_out = True
        elif one.kind == "halt":
            shell.halt_at_once(one.text, spoken=True)
        elif one.kind == "halted":
            self._worker.submit(self._ask)
        elif shell.asks and not one.sure:
            shell.answer("I did not hear that well. Please say it again.")
        elif not shell.help(one.text):
            shell.halt_at_once(one.text, spoken=True)
            doing = self._worker.submit(self._do, one, self._stops_by(one.end_s))
            if not self._recorded:
                return
            doing.result()
            shell.robot.wait()
        self._ear.replying = shell.asks

    def _stops_by(self, end_s: float) -> int:
        """How often it had been told to stop when somebody had spoken so far.

        To notice that they have ended, and to recognise it, takes a second or two: a stop meanwhile
        is about what they said, too.
        """
        heard_by = () if self._recorded else tuple(self._heard_by)
        now = self._shell.brake.stops
        return next((stops for heard_s, stops in heard_by if heard_s >= end_s), now)

    def _do(self, one: Spoken, stops: int) -> None:
        """One sentence; a mistake in this software must not end the listening."""
        read_back: Risk = self._risk if one.sure else doubtful_risk(one.doubtful)
        try:
            self._shell.hear(one.text, stops=stops, risk=read_back)
        except Exception as error:
            self._shell.out(as_mistake(error))
        self._ear.replying = self._shell.asks

    def _ask(self) -> None:
        """Ask about a halt for a cry that may have been none; nothing else comes of it."""
        self._shell.ask_to_go_on()
        self._ear.replying = self._shell.asks

    def _said(self, text: str) -> str:
        """What is said of a text: all but cries to stop, for it would heed them."""
        text = " ".join(one for one in _SENTENCE.split(text) if not is_stop(one))
        if not self._recorded:
            self._ear.said(text)
        return text

    def _note(self, event: Event) -> None:
        """What is asked may be answered in a word."""
        if event.event == "help":
            self._ear.replying = True

    def _status(self) -> int:
        if self._shell.dialogue.question is not None:
            say("Nobody answered; that is not done.")
            return ExitStatus.INVALID
        status = cli.status_of(self._shell)
        return max(status, ExitStatus.FAILED) if self._left_out else status
