"""What there is to listen to, and what is heard of it, without a robot."""

from __future__ import annotations

import sys
import threading
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import msgspec

from executive.frontends.composition_root import REALITY
from executive.frontends.language_model import language_model
from executive.frontends.listening.options import Listen, RecogniserName
from executive.frontends.output import say, write_json
from executive.meaning.knowledge import Knowledge
from intents.dialogue import Dialogue
from intents.goals import to_builtins
from intents.outcomes import YES_OR_NO, Goals, Question, Refusal, Reply, Turn
from intents.speech import microphone, wav
from intents.speech.audio import AudioError, Samples
from intents.speech.ear import Ear, Spoken
from intents.speech.keywords import Keywords
from intents.speech.recogniser import Recogniser
from intents.speech.spotting import Spotter
from intents.state import RobotState
from intents.vocabulary import Vocabulary
from intents.wording import in_words
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.ordinary_files import open_ordinary

if TYPE_CHECKING:
    from intents.speech.dictation import Dictation


class Block(msgspec.Struct, frozen=True, kw_only=True):
    """A piece of the stream.

    Attributes:
        sound: one channel at 16 kHz.
        heeded: whether sentences in it count; cries to stop always do.
        ends: whether what was being said ends here, by the release of the key.
    """

    sound: Samples
    heeded: bool = True
    ends: bool = False


@contextmanager
def audio_errors() -> Generator[None]:
    """Turn what is wrong with sound into what is wrong with the configuration."""
    try:
        yield
    except AudioError as error:
        raise ConfigError([Problem(str(error), suggestion=error.cure)]) from None


def ear(options: Listen, vocabulary: Vocabulary) -> Ear:
    """What listens for the names of a vocabulary.

    Raises:
        AudioError: the recogniser's model is not there.
    """
    from intents.speech.dictation import Dictation

    dictation = Dictation(vocabulary, wake_word=options.wake_word)
    recogniser = _recogniser(options, vocabulary, dictation)
    spotter = Spotter(dictation, Keywords())
    return Ear(recogniser, spotter=spotter, wake_word=options.wake_word)


def _recogniser(options: Listen, vocabulary: Vocabulary, dictation: Dictation) -> Recogniser:
    if options.recogniser is RecogniserName.WHISPER:
        from intents.speech.whisper import Whisper

        return Whisper(options.whisper)
    from intents.speech.sphinx import Sphinx

    return Sphinx(vocabulary, wake_word=options.wake_word, dictation=dictation)


@contextmanager
def sound(options: Listen) -> Generator[Iterator[Block]]:
    """The stream of sound that the options ask for.

    Raises:
        AudioError: there is no such file, it is no sound, or there is no microphone.
    """
    if options.file is not None:
        found = wav.form(options.file, open_ordinary)
        if found.missing:
            lost_s = found.missing / found.rate_hz
            say(f"{options.file} is cut off: {lost_s:.1f} s are missing", err=True)
        yield (Block(sound=one) for one in wav.blocks(options.file, open_ordinary))
        return
    with microphone.opened(options.device) as source:
        blocks = source.blocks()
        if options.push_to_talk:
            yield _pressed(blocks)
        else:
            say("Listening. Ctrl-C leaves.", err=True)
            yield (Block(sound=one) for one in blocks)


def _pressed(blocks: Iterator[Samples]) -> Iterator[Block]:
    """Sentences count between one press of Enter and the next."""
    talking, left = threading.Event(), threading.Event()

    def read() -> None:
        for _ in sys.stdin:
            if talking.is_set():
                talking.clear()
            else:
                talking.set()
            say("Speak; Enter ends it." if talking.is_set() else "Heard.", err=True)
        left.set()

    threading.Thread(target=read, name="push to talk", daemon=True).start()
    say("Enter, speak, Enter. Stop is heard at any time. Ctrl-D leaves.", err=True)
    before = False
    for one in blocks:
        now = talking.is_set()
        yield Block(sound=one, heeded=now or before, ends=before and not now)
        before = now
        if left.is_set():
            return


def heard(listener: Ear, blocks: Iterator[Block]) -> Iterator[Spoken]:
    """What is said in a stream, to its end."""
    for block in blocks:
        yield from listener.push(block.sound, heeded=block.heeded)
        if block.ends:
            yield from listener.finish()
    yield from listener.finish()


def parse_only(options: Listen) -> int:
    """Say what is heard and what it means, without moving; returns the exit status.

    Raises:
        RobotError: there is nothing to listen with (ConfigError).
    """
    knowledge = Knowledge(REALITY.world(options.world).map)
    vocabulary = knowledge.vocabulary()
    state = RobotState(entities=knowledge.entities())
    dialogue = Dialogue(vocabulary, confirm=False, fallback=language_model(options.model))
    understood = False
    with audio_errors(), sound(options) as blocks:
        listener = ear(options, vocabulary)
        for one in heard(listener, blocks):
            turn = _turn(one, dialogue, state)
            listener.replying = dialogue.question is not None
            understood |= isinstance(turn, Goals | Reply)
            if options.as_json:
                write_json(_record(one, turn))
            else:
                say(_words(one, turn))
    if not understood and not options.as_json:
        say("Nothing was understood as a command.")
    return ExitStatus.DONE if understood else ExitStatus.INVALID


def _turn(one: Spoken, dialogue: Dialogue, state: RobotState) -> Turn | None:
    """What something that was said leads to; nothing, if nothing is meant or it goes on."""
    if one.kind in ("ignored", "halt", "halted"):
        return None
    turn = dialogue.hear(one.text, state)
    if isinstance(turn, Goals) and one.kind == "sentence" and not one.sure:
        which = f"; I am not sure of “{' '.join(one.doubtful)}”" if one.doubtful else ""
        turn = Question(
            question=f"Did you say “{one.text}”{which}?", choices=YES_OR_NO, goals=turn.goals,
            kind="confirmation",
        )  # fmt: skip
        dialogue.ask(turn)
    return turn


def _record(one: Spoken, turn: Turn | None) -> dict[str, object]:
    """What was said and what it means, for programs."""
    kinds = {Goals: "goals", Question: "question", Refusal: "refusal", Reply: "reply"}
    return {
        **msgspec.to_builtins(one),
        "outcome": one.kind if turn is None else kinds[type(turn)],
        "goals": to_builtins(turn.goals) if isinstance(turn, Goals) else [],
        "said": None if turn is None or isinstance(turn, Goals) else answer(turn),
    }


def _words(one: Spoken, turn: Turn | None) -> str:
    """What was said and what it means, for people."""
    head = f"[{one.begin_s:6.2f} s] “{one.text}”"
    if one.kind in ("halt", "halted"):
        return f"{head}  a robot at work halts"
    if turn is None:
        return f"{head}  passed over: {one.why}"
    if isinstance(turn, Goals):
        return f"{head}\n  understood: {in_words(turn.goals)}"
    return f"{head}\n  {answer(turn)}"


def answer(turn: Question | Refusal | Reply) -> str:
    """What the robot says to a turn that leads to no goals."""
    if isinstance(turn, Question):
        return turn.question
    return turn.text if isinstance(turn, Reply) else f"Not understood: {turn.reason}"
