"""`python -m benchmarks.prompt_stops`: whether every stop acts, whatever the prompt is about.

The real prompt on a real pty, with a puppet for a robot. While that walks, the terminal gets random
keys, pastes, escape sequences and sizes; then a stop. It acted if the job is over and the robot
stands, both for good. The prompt is kept from try to try, in whatever state it was left in, and
started again only when a stop was lost or the try was to end it.
"""

from __future__ import annotations

import contextlib
import os
import random
import signal
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import typer

from tests.fakes.terminal import Pty

GIVE_UP_S = 60.0
"""How long a stop may take on a busy machine before it counts as lost; the puppet stands in 0.3 s
of its time, which is 10 times as fast as the wall's."""
SETTLE_S = 0.05
"""How long it must stay at a stand: ten ticks of the puppet."""
PROGRAM = "tests.fakes.puppet_prompt"

WORDS = ("walk", "squat for 30 seconds", "what can you do?", "goals", "why", "pause", "the cup", "")
SEQUENCES = (
    "\x1b[31m", "\x1b[0m", "\x1b[", "\x1b[3", "\x1b[M", "\x1b[M#", "\x1b[M##", "\x1b[<0;3", "\x1b",
    "\x1b[<0;31;5M", "\x1b[96;14;13M", "\x1b[200~", "\x1b[201~", "\x1b[200", "\x1bO",
    "\x1b]0;x\x07",
    "\x1b]8;;", "\x1bP+q", "\x1b[?1049h", "\x1b[12;40R", "\x1b[1;5D", "\x1b[A", "\x1b[B", "\x1b[H",
    "\x1b[3~", "\x1b[99999999999M", "\x1b[1;2;3;4m", "\x1b[c", "\x1b[;m", "\x1b[<m", "\x1b\x1b\x1b",
)  # fmt: skip
"""What terminals, pastes of coloured text and mice send, whole and cut off."""
PENDING = (
    "\x12", "\x13", "\x12st", "\x18", "\x18(", "\x18)", "\x18e", "\x11", "\x16", "\x1d", "\x1b\x1d",
    "\x1b9", "\x1b99", "\x1b-", "\t", "\t\t", "g\t", "\x0f", "\x1a", "\x1c", "\x1e", "\x1f", "\x14",
    "\x00", "\x0c", "\x18\x18", "\x18\x15", "\x1b<", "\x1b.", "\x1b#", "\x1b*",
)  # fmt: skip
"""Keys that wait for another, open a search or a menu, or record."""
SIZES = ((100, 30), (60, 20), (20, 5), (3, 2), (1, 1), (300, 90))


@dataclass
class Result:
    """What came of many tries: how many of each stop, and those that were lost."""

    tried: Counter[str] = field(default_factory=Counter[str])
    lost: list[str] = field(default_factory=list[str])


class Prompt:
    """A prompt before a puppet."""

    def __init__(self, folder: Path) -> None:
        """Start it; `ready` waits for it."""
        self._told, told = os.pipe()
        heard, self._heard = os.pipe()
        os.set_blocking(self._told, False)
        run = Path(tempfile.mkdtemp(dir=folder))
        self.pty = Pty(
            "-m", PROGRAM, str(run), str(told), str(heard), folder=run, pass_fds=(told, heard)
        )
        os.close(told)
        os.close(heard)
        self._rest = b""
        self.walking = self.busy = self.left = False
        self.jobs = 0

    def look(self) -> None:
        """Read what the puppet told."""
        with contextlib.suppress(BlockingIOError):
            while data := os.read(self._told, 65536):
                *lines, self._rest = (self._rest + data).split(b"\n")
                for line in lines:
                    self._take(line.decode())

    def _take(self, line: str) -> None:
        if line == "left":
            self.left = True
        else:
            self.walking, self.busy, self.jobs = map(int, line.split())

    def until(self, true: object, *, within_s: float = GIVE_UP_S) -> bool:
        """Whether a condition comes true in time."""
        assert callable(true)
        end_s = time.monotonic() + within_s
        while time.monotonic() < end_s:
            self.look()
            if true():
                return True
            time.sleep(0.002)
        return bool(true())

    def walk(self) -> bool:
        """Let the puppet walk; whether it does.

        The line of a cry that was heeded as it was typed may come late, and end the next walk.
        """
        before = self.jobs
        for within_s in (120.0, 20.0, 20.0):  # the first one may have to wait for the start
            os.write(self._heard, b"w")
            begun = self.until(lambda: self.walking or self.jobs > before, within_s=within_s)
            if begun and self.until(lambda: self.walking, within_s=5.0):
                return True
        return False

    @property
    def stands(self) -> bool:
        """Whether nothing is under way, and it stands."""
        return not self.busy and not self.walking

    def stopped(self) -> bool:
        """Whether it comes to a stand, for good."""
        if not self.until(lambda: self.stands):
            return False
        end_s = time.monotonic() + SETTLE_S
        while time.monotonic() < end_s:
            self.look()
            if not self.stands:
                return False
            time.sleep(0.005)
        return True

    def close(self) -> None:
        """End it."""
        self.pty.close()
        for fd in (self._told, self._heard):
            os.close(fd)


def junk(rng: random.Random) -> list[bytes | tuple[int, int] | bool]:
    """What a terminal gets: bytes, sizes, and whether it reads what is written."""
    said: list[bytes | tuple[int, int] | bool] = []
    for _ in range(rng.randint(0, 6)):
        kind = rng.choice("kkkssspppwwlbrt")
        if kind == "k":
            said.append(bytes(rng.choice(_KEYS) for _ in range(rng.randint(1, 12))))
        elif kind == "s":
            said.append(rng.choice(SEQUENCES).encode())
        elif kind == "p":
            said.append(rng.choice(PENDING).encode())
        elif kind == "w":
            said.append((rng.choice(WORDS) + rng.choice(("", "\r", "\n"))).encode())
        elif kind == "l":
            lines = "\r\n".join(rng.choice(WORDS) for _ in range(rng.randint(1, 30)))
            closed = rng.choice(("\x1b[201~", "\x1b[201~", ""))
            said.append(f"\x1b[200~{lines}{closed}".encode())
        elif kind == "b":
            said.append(rng.randbytes(rng.randint(1, 200)).translate(None, _LEAVING))
        elif kind == "r":
            said.append(rng.choice(SIZES))
        else:
            said.append(rng.random() < 0.5)
    return said


_LEAVING = b"\x03\x04\x1c"
"""Keys that stop or leave: they are the stop that is tried."""
_KEYS = bytes(n for n in range(256) if n not in _LEAVING)
STOPS: dict[str, bytes] = {
    "Ctrl-C": b"\x03", "stop": b"stop\r", "Stop!": b"Stop!\n", "halt": b"halt\r",
    "s.t.o.p hidden": "st\u200bop\r".encode(),
}  # fmt: skip
LEAVES = ("hang up", "SIGTERM", "SIGHUP", "SIGINT")


def attempt(prompt: Prompt, rng: random.Random) -> tuple[str, list[object], bool]:
    """One try: the stop, what came before it, and whether it acted."""
    said = junk(rng)
    stop = rng.choice(("Ctrl-C",) * 8 + tuple(STOPS) * 2 + LEAVES[: 1 + 3 * (rng.random() < 0.5)])
    for one in said:
        _give(prompt.pty, one)
        if rng.random() < 0.3:
            time.sleep(rng.choice((0.01, 0.05, 0.6 if rng.random() < 0.1 else 0.1)))
    if stop in STOPS:
        prompt.pty.press(STOPS[stop])
    elif stop == "hang up":
        prompt.pty.hang_up()
    else:
        prompt.pty.process.send_signal(getattr(signal, stop))
    acted = prompt.stopped()
    prompt.pty.reads = True
    return stop, list[object](said), acted


def _give(pty: Pty, one: bytes | tuple[int, int] | bool) -> None:
    if isinstance(one, bool):
        pty.reads = one
    elif isinstance(one, tuple):
        pty.resize(*one)
    else:
        pty.press(one)


def tries(
    count: int, *, seed: int, folder: Path, tell: Callable[[str], None] = lambda _: None
) -> Result:
    """Try so many times; every try is drawn from the seed and its number.

    Args:
        count: how often.
        seed: of all that is random.
        folder: for what the prompts write.
        tell: told from time to time how far it is.
    """
    result = Result()
    prompt: Prompt | None = None
    for number in range(count):
        rng = random.Random(f"{seed}/{number}")
        if prompt is None:
            prompt = Prompt(folder)
        if not prompt.walk():
            ended = prompt.pty.process.poll()
            result.lost.append(f"{number}: no walk ({ended=}, {prompt.jobs} jobs)")
            tell(result.lost[-1])
            prompt.close()
            prompt = None
            continue
        stop, said, acted = attempt(prompt, rng)
        result.tried[stop] += 1
        if (number + 1) % 20 == 0:
            tell(f"{number + 1} tries, {len(result.lost)} stops lost")
        if not acted:
            result.lost.append(f"{number}: {stop} after {said}")
            tell(result.lost[-1])
        gone = prompt.left or prompt.pty.process.poll() is not None
        if not acted or gone or stop in LEAVES:
            prompt.close()
            prompt = None
    if prompt is not None:
        prompt.close()
    return result


def _say(text: str) -> None:
    print(text, flush=True)


def main(
    count: Annotated[int, typer.Option("--tries", help="how often")] = 1000,
    seed: Annotated[int, typer.Option(help="of all that is random")] = 0,
) -> None:
    """Try, and say how many stops were lost, and after what."""
    begin_s = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        result = tries(count, seed=seed, folder=Path(folder), tell=_say)
    print(", ".join(f"{n} x {stop}" for stop, n in result.tried.most_common()))
    took_s = time.monotonic() - begin_s
    print(f"{len(result.lost)} stops lost in {count} tries, {took_s:.0f} s")


if __name__ == "__main__":
    typer.run(main)
