"""Speech out: espeak-ng or piper, where they are installed; silence otherwise.

The text goes to the program's standard input, never through a shell. `hush` ends what is being
said at once, together with what was still to come.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import threading
from collections import deque
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Literal, Protocol, Self

import msgspec

from intents.speech.audio import AudioError

Program = Literal["auto", "none", "espeak-ng", "piper"]
MAX_CHARACTERS = 1000
_ENDS_S = 0.5
_INSTALL = "install it: sudo apt install espeak-ng"


class Voice(Protocol):
    """Speaks, one text after the other."""

    @property
    def speaking(self) -> bool:
        """Whether something is being said, or about to be."""
        ...

    def say(self, text: str) -> None:
        """Say a text after what is being said; returns at once."""
        ...

    def hush(self) -> None:
        """Be silent at once, and forget what was still to be said."""
        ...

    def wait(self, timeout_s: float) -> bool:
        """Return when all is said, or the time is over; whether all is said."""
        ...

    def close(self) -> None:
        """Be silent for good."""
        ...


class Silence:
    """The voice of a machine without one."""

    speaking = False

    def say(self, text: str) -> None:
        """Say nothing: it is printed anyway."""

    def hush(self) -> None:
        """Be silent."""

    def wait(self, timeout_s: float) -> bool:  # noqa: ARG002
        """All is said."""
        return True

    def close(self) -> None:
        """Be silent."""


def voice(program: Program = "auto", *, model: Path | None = None) -> Voice:
    """The voice of this machine.

    Args:
        program: which; "auto" takes piper if there is a model for it, else espeak-ng, else none.
        model: a piper voice (`NAME.onnx`, with `NAME.onnx.json` beside it).

    Raises:
        AudioError: it is not installed, or lacks its model.
    """
    if program == "none":
        return Silence()
    if program == "piper" or (program == "auto" and model is not None):
        return Synthesiser(_piper(model))
    if shutil.which("espeak-ng"):
        return Synthesiser([["espeak-ng", "-v", "en-us", "--stdin"]])
    if program == "auto":
        return Silence()
    raise AudioError("espeak-ng is not installed", _INSTALL)


def _piper(model: Path | None) -> list[list[str]]:
    """Piper makes sound of text, aplay makes it heard."""
    for name, package in (("piper", "pip install piper-tts"), ("aplay", "apt install alsa-utils")):
        if not shutil.which(name):
            raise AudioError(f"{name} is not installed", f"install it: {package}")
    if model is None or not model.is_file():
        raise AudioError(
            f"piper needs the file of a voice{f', {model} is none' if model else ''}",
            "name one with --voice-model NAME.onnx",
        )
    rate_hz = _rate_hz(Path(f"{model}.json"))
    play = ["aplay", "-q", "-t", "raw", "-f", "S16_LE", "-c", "1", "-r", str(rate_hz), "-"]
    return [["piper", "--model", str(model), "--output-raw"], play]


class _Audio(msgspec.Struct, frozen=True):
    """How a piper voice sounds."""

    sample_rate: int


class _PiperVoice(msgspec.Struct, frozen=True):
    """What stands beside a piper voice."""

    audio: _Audio


def _rate_hz(described: Path) -> int:
    """The rate that a piper voice speaks with."""
    if not described.is_file():  # a pipe or a device would never end
        raise AudioError(f"{described} is no file", "keep it beside the voice that it belongs to")
    try:
        return msgspec.json.decode(described.read_bytes(), type=_PiperVoice).audio.sample_rate
    except (OSError, msgspec.DecodeError) as error:
        raise AudioError(
            f"{described} does not describe a piper voice: {error}",
            "keep the .onnx.json that belongs to the voice beside it",
        ) from None


class Synthesiser:
    """Speaks through other programs, in a thread of its own; a context manager."""

    def __init__(self, pipeline: list[list[str]]) -> None:
        """Speak by a pipeline of commands, the first of which reads the text.

        Attributes:
            problem: why nothing is heard, as the programs say; empty when all is well.
        """
        self.problem = ""
        self._pipeline = pipeline
        self._texts: deque[str] = deque()
        self._running: list[subprocess.Popen[bytes]] = []
        self._changed = threading.Condition()
        self._closed = self._busy = False
        self._thread = threading.Thread(target=self._work, name="voice", daemon=True)
        self._thread.start()

    @property
    def speaking(self) -> bool:
        """Whether something is being said, or about to be."""
        return self._busy or bool(self._texts)

    def say(self, text: str) -> None:
        """Say a text after what is being said; returns at once."""
        spoken = " ".join("".join(c if c.isprintable() else " " for c in text).split())
        with self._changed:
            if spoken and not self._closed:
                self._texts.append(spoken[:MAX_CHARACTERS])
                self._changed.notify_all()

    def hush(self) -> None:
        """Be silent at once, and forget what was still to be said."""
        with self._changed:
            self._texts.clear()
            for process in self._running:
                _kill(process)

    def close(self) -> None:
        """Be silent for good; safe to call twice."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
        self.hush()
        self._thread.join(_ENDS_S)

    def wait(self, timeout_s: float) -> bool:
        """Return when all is said, or the time is over; whether all is said."""
        with self._changed:
            return self._changed.wait_for(lambda: not self.speaking, timeout_s)

    def __enter__(self) -> Self:
        """Return the voice itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Be silent."""
        self.close()

    def _work(self) -> None:
        while True:
            with self._changed:
                self._busy = False
                self._changed.notify_all()
                self._changed.wait_for(lambda: bool(self._texts) or self._closed)
                if self._closed:
                    return
                self._busy = True
                text = self._texts.popleft()
                started = self._start()
            if started:
                self._speak(text)

    def _start(self) -> bool:
        """Start the programs; called with the lock held, so that `hush` sees all or none."""
        self._running = []
        source: int | object = subprocess.PIPE
        command = self._pipeline[0]
        try:
            for command in self._pipeline:
                last = command is self._pipeline[-1]
                process = subprocess.Popen(
                    command,
                    stdin=source,  # type: ignore[arg-type]
                    stdout=subprocess.DEVNULL if last else subprocess.PIPE,
                    stderr=subprocess.PIPE if last else subprocess.DEVNULL,
                    start_new_session=True,
                )
                self._running.append(process)
                source = process.stdout or subprocess.DEVNULL
        except OSError as error:
            self.problem = f"{command[0]}: {error.strerror}"
            for process in self._running:
                _kill(process)
            return False
        return True

    def _speak(self, text: str) -> None:
        first, last = self._running[0], self._running[-1]
        assert first.stdin is not None
        with suppress(OSError):  # it was hushed, or is broken: its status says so
            first.stdin.write(text.encode() + b"\n")
        with suppress(OSError):
            first.stdin.close()
        told = last.stderr.read().decode(errors="replace").strip() if last.stderr else ""
        statuses = [process.wait() for process in self._running]
        for process in self._running:
            for stream in (process.stdout, process.stderr):
                if stream is not None:
                    stream.close()
        if any(status > 0 for status in statuses):
            self.problem = told or f"{self._pipeline[0][0]} ended with {max(statuses)}"


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End a program and what it has started."""
    if process.poll() is None:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
