"""What a case is: a command line among hostile files, and what has to come of it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import partial
from pathlib import Path

OUTSIDE, WORK = "@OUTSIDE@", "@WORK@"
"""Stand in arguments and texts for the folder that is nobody's business, and the case's own."""

SECRET = "c4n4ry-of-the-next-house"
"""Stands in every file outside; no output may hold it."""

NOBODY = 65534
"""The user `nobody`, where a case needs somebody who is not root."""

USUAL_CPU_S = 5
"""Processor time that a case may take, unless it moves a robot."""

Make = Callable[[Path], None]
"""Makes what lies at a path of a case's folder."""


class Expect(Enum):
    """How a command has to end: the table of exit statuses in docs/executive.md."""

    REFUSED = "refused"
    """Status 2, or 1, and a message that names the file, the field or the cure."""
    ACCEPTED = "accepted"
    """Status 0."""
    ENDS = "ends"
    """Any documented status but 3: what matters is how, not whether."""


class Streams(Enum):
    """What the standard streams are."""

    PIPES = "pipes"
    TERMINAL = "a terminal"
    NO_STDIN = "stdin is closed"
    NO_STDOUT = "stdout is closed"
    NO_STDERR = "stderr is closed"
    NONE = "all are closed"
    NOBODY_READS = "the reader of stdout is gone"
    FULL = "stdout is a full device"


@dataclass(frozen=True, kw_only=True)
class Case:
    """One hostile input at one front end."""

    name: str
    argv: tuple[str | bytes, ...]
    files: Mapping[str, str | bytes | Make] = field(default_factory=dict[str, str | bytes | Make])
    """What lies in the folder that it runs in, by path."""
    expect: Expect = Expect.REFUSED
    says: tuple[str, ...] = ()
    """One of these is in the output; if empty and it is refused: a file's name, or a cure."""
    never: tuple[str, ...] = ()
    """None of these is in the output."""
    run: str = ""
    """The recorded run whose folder lies in runs/RUN: "wave", "hello" or "failed"."""
    mutate: Callable[[Path], None] | None = None
    """What is done to the recorded run's folder."""
    stdin: bytes = b""
    streams: Streams = Streams.PIPES
    environment: Mapping[str, str | None] = field(default_factory=dict[str, str | None])
    """Variables that are other than usual; None takes one away."""
    cold: bool = False
    """In a new interpreter: what only its start decides, as the encoding of its streams."""
    user: int | None = None
    """Who it runs as; needs root."""
    inside: Callable[[], None] | None = None
    """Done in the process itself before it begins; a function of a module (it is pickled)."""
    most_output: int = 200_000
    """Bytes."""
    cpu_s: int = USUAL_CPU_S
    memory_mb: int = 500
    private_shm: Callable[[Path], None] | None = None
    """Makes what lies in /dev/shm, which is then one of its own; needs root."""


@dataclass(frozen=True)
class Result:
    """How a case ended."""

    status: int
    """Exit status; negative: the signal that ended it."""
    out: bytes
    err: bytes
    cpu_s: float
    memory_mb: float
    hung: bool
    """It slept and waited for what never came."""


def fifo(path: Path) -> None:
    """A pipe that nobody writes to."""
    os.mkfifo(path)


def folder(path: Path) -> None:
    """A folder where a file is meant."""
    path.mkdir()


def link(to: str) -> Make:
    """A symbolic link."""

    def make(path: Path) -> None:
        path.symlink_to(to.replace(OUTSIDE, str(path.parents[1] / "outside")))

    return make


def _sparse(size: int, start: bytes, path: Path) -> None:
    with path.open("wb") as file:
        file.write(start)
        file.truncate(size)


def sparse(size: int, start: bytes = b"") -> Make:
    """A file of zeros that takes no room."""
    return partial(_sparse, size, start)


def mode(content: str, bits: int) -> Make:
    """A file, or where it ends with a slash a folder, with those permissions."""

    def make(path: Path) -> None:
        path.write_text(content)
        path.chmod(bits)

    return make


def names(cases: Iterable[Case]) -> list[str]:
    """The ids of cases; no two are the same."""
    listed = [case.name for case in cases]
    twice = {name for name in listed if listed.count(name) > 1}
    assert not twice, f"two cases of one name: {twice}"
    return listed
