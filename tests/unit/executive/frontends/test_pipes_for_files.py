"""A pipe where a file is meant: whichever path a command takes, nobody waits for its other end."""

import os
import signal
from collections.abc import Iterator
from typing import Any

import pytest
import typer
from typer.testing import CliRunner

from executive.frontends.cli import app
from robot.errors import RobotError
from tests.fakes.waiting import HANG_S

BOARD = ("--board", "chessboard:9x6:0.025")
READS = {
    ("parse", "--file"): "parse --file pipe",
    ("parse", "--vocabulary"): "parse hello --vocabulary pipe",
    ("parse", "--model"): "parse hello --model pipe",
    ("do", "--model"): "do hello --fast --model pipe",
    ("repl", "--model"): "repl --fast --model pipe",
    ("up", "--model"): "up --fast --model pipe",
    ("listen", "--model"): "listen --fast --file pipe --model pipe",
    ("listen", "--file"): "listen --fast --file pipe",
    ("listen", "--whisper"): "listen --fast --file silence.wav --whisper pipe",
    ("mission import", "file"): "mission import pipe",
    ("eval", "--tasks"): "eval --tasks pipe",
    ("eval", "--resume"): "eval --resume pipe",
    ("people", "--log"): "people --log pipe",
    ("detect", "images"): "detect pipe --model pipe --labels labels",
    ("detect", "--model"): "detect picture --model pipe --labels labels",
    ("detect", "--labels"): "detect picture --model pipe --labels pipe",
    ("sensors estimate", "--log"): "sensors estimate --log pipe --urdf pipe --out new",
    ("sensors estimate", "--urdf"): "sensors estimate --log pipe --urdf pipe --out new",
    ("map build", "--log"): "map build --log pipe --trajectory new",
    ("map locate", "map_file"): "map locate pipe --log pipe",
    ("map locate", "--log"): "map locate pipe --log pipe",
    ("map show", "map_file"): "map show pipe",
    ("calibrate camera", "--images"): f"calibrate camera --images folder {' '.join(BOARD)}",
    ("calibrate hand-eye", "--images"): (
        f"calibrate hand-eye --images folder --poses pipe {' '.join(BOARD)}"
    ),
    ("calibrate hand-eye", "--poses"): (
        f"calibrate hand-eye --images folder --poses pipe {' '.join(BOARD)}"
    ),
    ("calibrate hand-eye", "--camera"): (
        f"calibrate hand-eye --images folder --poses pipe --camera pipe {' '.join(BOARD)}"
    ),
    ("remote join", "invitation"): "remote join pipe",
    **{
        (f"motors {name}", "--map"): f"motors {name} {rest} --map pipe"
        for name, rest in {
            "scan": "", "read": "", "check": "", "watch": "", "log": "new.csv", "zero": "elbow",
            "jog": "elbow --by 0.1", "identify": "elbow",
        }.items()
    },
}  # fmt: skip
"""A command with a pipe for each path that it reads, by the path's name."""
NAMED = {
    "a world": "do hello --fast --world ./pipe.yaml",
    "a robot": "do hello --fast --robot ./pipe.yaml",
    "a mission": "mission run ./pipe.yaml --fast",
    "a mission to check": "mission check ./pipe.yaml",
    "a mission to plan": "mission plan ./pipe.yaml",
    "a mission to export": "mission export ./pipe.yaml",
    "a world to parse for": "parse hello --world ./pipe.yaml",
    "a run": "why pipe",
}
"""The same of what is a file only where it looks like one."""
UNREAD = {
    "--dump", "--run-dir", "--voice-model", "--snapshot", "--output", "--out", "--picture",
    "--data", "--to", "--resume",
}  # fmt: skip
"""Paths that are written, that are folders, or that another program reads (piper)."""
ELSEWHERE = {
    ("resume", "--model"), ("config", "--model"),  # as do
    ("map build", "--trajectory"), ("map locate", "--trajectory"),  # written, or read after the log
    ("worlds new", "--tasks"), ("model export", "--urdf"),  # written
    ("motors log", "file"),  # written
}  # fmt: skip


@pytest.fixture(autouse=True)
def place(tmp_path, monkeypatch) -> Iterator[None]:
    """A folder of pipes; who waits for one is woken, and fails."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    for name in ("pipe", "pipe.yaml", "folder/pipe.png"):
        os.mkfifo(name)
    (tmp_path / "labels").write_text("cup\n")

    def woken(*_: object) -> None:
        pytest.fail("it waits for the other end of a pipe")

    before = signal.signal(signal.SIGALRM, woken)
    signal.alarm(int(HANG_S))
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("words", [*READS.values(), *NAMED.values()])
def test_a_pipe_is_refused_by_whoever_is_told_to_read_it(words: str):
    result = CliRunner().invoke(app, words.split())
    broke = result.exception
    assert isinstance(broke, SystemExit | RobotError), result.output
    assert result.exit_code != 0
    told = str(broke) + result.output
    assert "Usage" not in told, told  # or nothing was tried


def _paths(command: Any, words: tuple[str, ...] = ()) -> Iterator[tuple[str, str]]:
    for name, one in getattr(command, "commands", {}).items():
        yield from _paths(one, (*words, name))
    for parameter in command.params:
        if "path" in str(parameter.type_descriptor).lower():
            yield " ".join(words), parameter.opts[0]


def test_every_path_of_every_command_is_among_them():
    taken = set(_paths(typer.main.get_command(app)))
    assert len(taken) > 50
    missing = {one for one in taken - set(READS) - ELSEWHERE if one[1] not in UNREAD}
    assert missing == set()
    assert set(READS) | ELSEWHERE <= taken
