"""What is said into the microphone of a page: handed to the ears (`ears.py`), and what they heard.

One page speaks at a time, up to `MOST_S` at a press. The ears begin with the first press and stay;
ears that die, or are behind, cost what was said and nothing else.
"""

from __future__ import annotations

import asyncio
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import msgspec

import robot
from executive.frontends.since_boot import now_s

MODULE = "executive.frontends.console.ears"
RATE_HZ = 16_000
"""Of the sound that comes, as `intents.speech.audio` takes it."""
BYTES_A_S = 2 * RATE_HZ
MOST_S = 20.0
"""Of a press: nobody tells a robot more at a time."""
MOST_WAITING = 400
"""Pieces that wait for ears which only load: a press and a half."""
MAX_LINE = 1 << 16
TAKEN = "Somebody else is speaking to the robot from another page."
TOO_LONG = f"That was longer than {MOST_S:.0f} s; what came after is not heard."
DEAF = "What was said could not be heard: see the console's log. Type it instead."


class Sound(msgspec.Struct, frozen=True, kw_only=True):
    """A piece of what is said while a page's button is pressed.

    Attributes:
        data: one channel at `RATE_HZ`, int16, little-endian.
        ends: whether the button was let go after it.
        replying: whether the robot asks something.
    """

    data: bytes = b""
    ends: bool = False
    replying: bool = False


class Said(msgspec.Struct, frozen=True, kw_only=True):
    """What the ears heard: as `intents.speech.ear.Spoken`, as far as it is needed here."""

    kind: str
    text: str = ""
    why: str = ""
    sure: bool = True
    doubtful: tuple[str, ...] = ()


class Hearing:
    """The ears of one console.

    What it hears comes as `heard(said, begun_s)`, where `begun_s` is when the button was pressed,
    in seconds since boot; what people are to be told of it as `tell(text)`.
    """

    def __init__(self, heard: Callable[[Said, float], None], tell: Callable[[str], None]) -> None:
        """Start nothing yet."""
        self._heard, self._tell = heard, tell
        self._ears: _Ears | None = None
        self._speaker: object | None = None
        self._begun_s = 0.0
        self._bytes = 0

    def begin(self, speaker: object, about: Mapping[str, Any]) -> str:
        """A page's button is pressed; why it is not listened to, or empty."""
        if self._speaker is not None and self._speaker is not speaker:
            return TAKEN
        self._speaker, self._begun_s, self._bytes = speaker, now_s(), 0
        if self._ears is None:
            try:
                self._ears = _Ears(about, self._take)
            except OSError as error:
                self._speaker = None
                return f"{DEAF} ({error.strerror})"
        return ""

    def push(self, speaker: object, data: bytes, *, replying: bool) -> str:
        """Some sound of a page that speaks; why no more is heard, once, or empty."""
        if speaker is not self._speaker:
            return ""
        before, most = self._bytes, round(MOST_S * BYTES_A_S)
        self._bytes += len(data)
        if self._bytes <= most:
            self._hand_on(Sound(data=data[: len(data) // 2 * 2], replying=replying))
        return TOO_LONG if before <= most < self._bytes else ""

    def end(self, speaker: object, *, replying: bool) -> None:
        """The button is let go, or the page is gone."""
        if speaker is self._speaker:
            self._speaker = None
            self._hand_on(Sound(ends=True, replying=replying))

    def _hand_on(self, sound: Sound) -> None:
        if self._ears is not None:
            self._ears.hear(msgspec.json.encode(sound) + b"\n")

    def _take(self, ears: _Ears, line: bytes) -> None:
        """A line of what was heard, in the loop's thread; an empty one is the last."""
        if ears is not self._ears:
            return
        if line:
            self._heard(msgspec.json.decode(line, type=Said), self._begun_s)
        else:
            self._ears = None
            self._tell(DEAF)

    def close(self) -> None:
        """End the ears."""
        ears, self._ears = self._ears, None
        if ears is not None:
            ears.close()


class _Ears:
    """The process: what it is behind with waits here, so much of it, and never in the loop."""

    def __init__(self, about: Mapping[str, Any], take: Callable[[_Ears, bytes], None]) -> None:
        """Start it; each line that comes is taken in the loop that runs now.

        Raises:
            OSError: it cannot be started.
        """
        here = str(Path(robot.__file__).parent.parent)
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", MODULE, msgspec.json.encode(about), str(os.getpid())],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, process_group=0,
            env={**os.environ, "PYTHONPATH": here},
        )  # fmt: skip
        self._waiting: queue.Queue[bytes] = queue.Queue(MOST_WAITING)
        self._loop, self._take = asyncio.get_running_loop(), take
        for work in (self._tell, self._listen):
            threading.Thread(target=work, name="ears", daemon=True).start()

    def hear(self, line: bytes) -> None:
        """Let it hear something; ears that are behind miss it."""
        with suppress(queue.Full):
            self._waiting.put_nowait(line)

    def _tell(self) -> None:
        assert self._process.stdin is not None
        with suppress(OSError), self._process.stdin as told:
            while line := self._waiting.get():
                told.write(line)
                told.flush()

    def _listen(self) -> None:
        assert self._process.stdout is not None
        with suppress(RuntimeError):  # the loop is closed
            with self._process.stdout as heard:
                while line := heard.readline(MAX_LINE):
                    self._loop.call_soon_threadsafe(self._take, self, line)
            self._loop.call_soon_threadsafe(self._take, self, b"")
        self.close()
        self._process.wait()

    def close(self) -> None:
        """End it at once."""
        self._process.kill()
        self.hear(b"")
