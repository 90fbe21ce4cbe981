"""What the robot says aloud: its answers and questions, what it was told to say, how it ended.

All of it is printed as well. A stop silences it at once.
"""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

from executive.frontends.output import say
from executive.journal import failures
from executive.journal.journal import Event
from intents.speech.audio import AudioError
from intents.speech.voice import Silence, Synthesiser, Voice, voice
from robot.closing import Closing
from robot.errors import ConfigError, Problem

LAST_WORDS_S = 20.0
"""How long the last words may take after everything else is over."""
TRIAL_S = 2.0
ONLY_PRINTED = "what the robot says is only printed"


def _as_it_is(text: str) -> str:
    return text


class Speech(Closing):
    """What is for ears goes through here; a context manager, silent afterwards."""

    def __init__(
        self, voice: Voice | None = None, *, screen: Callable[[str], str] = _as_it_is
    ) -> None:
        """Speak with a voice (None: not at all).

        Args:
            voice: of this machine.
            screen: makes of a text what is said of it; empty if that is nothing.
        """
        self.screen = screen
        self._voice = voice or Silence()
        self._told = False

    @property
    def speaking(self) -> bool:
        """Whether something is being said, or about to be."""
        return self._voice.speaking

    def say(self, text: str) -> None:
        """Say a text after what is being said; returns at once."""
        self._voice.say(self.screen(text.replace("`", "")))
        self._tell()

    def hush(self) -> None:
        """Be silent at once, and forget what was still to be said."""
        self._voice.hush()

    def note(self, event: Event) -> None:
        """Say what is for ears in the journal: what is said, what is asked, and how it ended."""
        data = event.data
        if event.event == "said":
            self.say(str(data["text"]))
        elif event.event == "help":
            self.say(str(data["question"]))
        elif event.event == "stop":
            self.hush()
        elif event.event == "job" and data["state"] in ("done", "failed"):
            cause = data.get("cause")
            self.say(failures.in_first_person("that", cause) if cause else failures.verdict(None))

    def finish(self, within_s: float = LAST_WORDS_S) -> None:
        """Let it finish what it says, in bounded time; Ctrl-C silences it."""
        try:
            self._voice.wait(within_s)
        except KeyboardInterrupt:
            self.hush()
        self._tell()

    def close(self) -> None:
        """Be silent for good."""
        self._voice.close()

    def _tell(self) -> None:
        """Tell people once why they hear nothing."""
        problem = self._voice.problem if isinstance(self._voice, Synthesiser) else ""
        if problem and not self._told:
            self._told = True
            say(f"Nothing is heard ({problem.splitlines()[-1]}).", err=True)


def opened(*, wanted: bool, model: Path | None = None) -> Speech:
    """The robot's speech; it is silent unless it is wanted.

    Args:
        wanted: as `able` says.
        model: a voice for piper (`NAME.onnx`); None: espeak-ng speaks.

    Raises:
        ConfigError: piper lacks something.
    """
    try:
        return Speech(voice("auto", model=model) if wanted else None)
    except AudioError as error:
        raise ConfigError([Problem(str(error), suggestion=error.cure)]) from None


def able(*, wanted: bool, model: Path | None = None) -> bool:
    """Whether to speak: not where there is nothing to be heard, which is told in a line.

    Raises:
        ConfigError: piper lacks something.
    """
    if not wanted:
        return False
    if model is not None:
        with opened(wanted=True, model=model):
            return True
    try:
        voice("espeak-ng").close()
    except AudioError as error:
        say(f"No voice: {error}, so {ONLY_PRINTED}. To hear it, {error.cure}", err=True)
        return False
    reason = _unheard()
    if reason:
        say(f"No voice: espeak-ng makes no sound ({reason}), so {ONLY_PRINTED}.", err=True)
    return not reason


def _unheard() -> str:
    """Why espeak-ng makes no sound: it ends well even so. Empty where it does."""
    try:
        tried = subprocess.run(
            ["espeak-ng", "--stdin"], input=b" ", capture_output=True, timeout=TRIAL_S, check=False
        )
    except subprocess.TimeoutExpired:
        return "it does not end"
    except OSError as error:
        return error.strerror or str(error)
    lines = tried.stderr.decode(errors="replace").splitlines()
    told = [line for line in lines if line.startswith("error:")]
    return told[-1] if told else f"it ended with {tried.returncode}" if tried.returncode else ""
