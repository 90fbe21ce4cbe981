"""`humanoid listen` with a robot: what is said is read back, and done when that is confirmed."""

from __future__ import annotations

import re
from datetime import datetime
from typing import Any

import msgspec
from msgspec.structs import replace

from executive.behaviours.ask import ANSWERS
from executive.frontends.listening.hearing import INVALID, Options, audio_errors, ear, sound
from executive.frontends.prompt import cli
from executive.frontends.prompt.shell import Shell
from executive.frontends.speaking import Speech, able
from executive.frontends.supervised import FrontEnd, oversee
from executive.journal.journal import Event
from executive.runs import run_folder
from intents import goals as g
from intents.goals import Goal, each
from intents.risks import risk
from intents.speech.ear import Ear, Spoken
from intents.speech.voice import voice
from intents.stopping import is_stop
from robot.bringup.mailbox import Handle

_SENTENCE = re.compile(r"(?<=[.!?;])\s+")
HARMLESS = (g.Stop, g.Pause, g.Resume, g.Cancel, g.Report, g.Say, g.Answer, g.Wait)
"""Goals that move nothing, and those that only end or hold what is under way."""


def obey(options: Options) -> int:
    """Listen until the recording ends or the person leaves; returns the exit status.

    Raises:
        RobotError: a file is wrong (ConfigError), or a part does not start.
    """
    stamp = f"{datetime.now().astimezone():%Y%m%d-%H%M%S}"
    folder = options.folder or run_folder.folder_for("listen", stamp=stamp)
    run_folder.check_free(folder)
    options = replace(options, folder=folder)
    with sound(options):
        pass  # what is missing is said before a robot is started
    if options.voice == "auto" and not able(wanted=True, model=options.voice_model):
        options = replace(options, voice="none")
    voice(options.voice, model=options.voice_model).close()
    if options.fast:
        return converse(options)
    plain = msgspec.to_builtins(options, enc_hook=str)
    return oversee(FrontEnd.LISTEN, plain, as_json=False)


def overseen(handle: Handle, plain: dict[str, Any]) -> int:
    """Listen in an executive of its own, or go on after one that died."""
    options = msgspec.convert(plain, Options, dec_hook=lambda kind, value: kind(value))
    with audio_errors():  # they are no mistakes of this software, to be started again after
        return converse(options, handle=handle)


def converse(options: Options, *, handle: Handle | None = None) -> int:
    """Listen, and do what is said; `handle` is that of a live robot."""
    prompt = cli.Options(
        world=options.world, robot=options.robot, seed=options.seed, fast=options.fast,
        vary=False, folder=options.folder, model=options.model,
    )  # fmt: skip
    with Speech(voice(options.voice, model=options.voice_model)) as speech:
        with cli.conversation(prompt, handle=handle, speech=speech) as shell:
            listener = ear(options, shell.robot.where.knowledge.vocabulary())
            shell.dialogue.risk = risk if options.yes else heard_risk
            recorded = options.file is not None
            status = Conversation(shell, listener, recorded=recorded).run(options)
        speech.finish()
    return status


def heard_risk(goals: tuple[Goal, ...]) -> str:
    """Why goals that were heard are read back: whatever moves the robot is."""
    known = risk(goals)
    moves = any(not isinstance(goal, HARMLESS) for goal in each(goals))
    return known or ("that is what I heard" if moves else "")


class Conversation:
    """A person and a robot, both of whom speak."""

    def __init__(self, shell: Shell, listener: Ear, *, recorded: bool) -> None:
        """Begin.

        Args:
            shell: does what a sentence says, and answers.
            listener: hears it.
            recorded: whether a recording is listened to, which hears nothing of the robot: each
                job is done before it goes on.
        """
        self._shell = shell
        self._ear = listener
        self._recorded = recorded
        shell.speech.screen = self._said
        shell.robot.session.journal.listen(self._note)

    def run(self, options: Options) -> int:
        """Listen to the end; returns the exit status."""
        shell = self._shell
        with sound(options) as blocks:
            for block in blocks:
                speaking = shell.speech.speaking and not self._recorded
                for one in self._ear.push(block.sound, speaking=speaking, heeded=block.heeded):
                    self.take(one)
                for one in self._ear.finish() if block.ends else ():
                    self.take(one)
                if shell.robot.lost is not None or shell.robot.interrupts.count:
                    break
            else:
                for one in self._ear.finish():
                    self.take(one)
        return self._status()

    def take(self, one: Spoken) -> None:
        """Do what was said."""
        shell = self._shell
        if one.kind == "ignored":
            if one.text:
                cli.say(f"(“{one.text}” passed over: {one.why})")
            return
        cli.say(f"> {one.text}")
        if one.kind == "stop":
            shell.stop("a cry to stop was heard")
        elif shell.robot.executive.question and one.text in ANSWERS:
            shell.robot.executive.answer(one.text)
        else:
            shell.sentence(one.text)
            if self._recorded:
                shell.robot.wait()
        asked = shell.dialogue.question is not None or bool(shell.robot.executive.question)
        self._ear.replying = asked

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
            cli.say("Nobody answered; that is not done.")
            return INVALID
        return cli.status_of(self._shell)
