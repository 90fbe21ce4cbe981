"""What real shells make of a stranger's file names, when somebody presses Tab among them."""

from __future__ import annotations

import os
import pty
import select
import shutil
import sys
from pathlib import Path

import pytest

from tests.fakes.waiting import HANG_S

SHELLS = {
    "bash": (["bash", "--norc", "--noprofile", "-i"], "bind 'set enable-bracketed-paste off'"),
    "zsh": (["zsh", "-f", "-i"], "autoload -U compinit; compinit -D -u"),
}
NAMES = ("a$(touch ran)", "b\\$(touch ran)")
"""Bash runs the first with the line; of the second, zsh while it completes. A Tab costs a start."""
ROOT = Path(__file__).parents[4]


class Terminal:
    """A shell at a terminal of its own."""

    def __init__(self, command: list[str], folder: Path) -> None:
        variables = {"PATH": f"{folder}:{os.environ['PATH']}", "HOME": str(folder)}
        self._pid, self._keys = pty.fork()
        if self._pid == 0:
            os.chdir(folder)
            os.execvpe(command[0], command, {**variables, "TERM": "dumb", "LANG": "C.UTF-8"})
        self._asked = 1000

    def does(self, line: str) -> None:
        """Type a line, and wait until it is done."""
        self._asked += 1
        # What the terminal echoes is the sum, and not yet the answer.
        typed = f"{line}\r\recho answer-$(({self._asked} + 0))\r"
        os.write(self._keys, typed.encode())
        seen = b""
        while f"answer-{self._asked}".encode() not in seen:
            ready, _, _ = select.select([self._keys], [], [], HANG_S)
            assert ready, f"the shell hangs after {line!a}: {seen[-2000:]!a}"
            seen += os.read(self._keys, 65536)

    def close(self) -> None:
        os.close(self._keys)
        os.waitpid(self._pid, 0)


@pytest.mark.parametrize("shell", SHELLS)
def test_a_shell_runs_nothing_that_a_name_says(shell, tmp_path):
    if shutil.which(shell) is None:
        pytest.skip(f"there is no {shell} here")
    program = tmp_path / "humanoid"
    program.write_text(
        f'#!/bin/sh\n[ -n "$_HUMANOID_COMPLETE$1" ] || exit 0\n'
        'case "$_HUMANOID_COMPLETE$1" in complete*|--show-completion) ;;\n'
        f'*) echo "$@" >> {tmp_path}/told; exit 0;; esac\n'
        f"PYTHONPATH={ROOT} exec {sys.executable} -P -c "
        '\'import sys; sys.argv[0] = "humanoid"; from executive.frontends.cli import main; main()'
        '\' "$@"\n'
    )
    program.chmod(0o755)
    for name in (*NAMES, "good"):
        (tmp_path / f"{name}.yaml").touch()
        (tmp_path / "runs" / name).mkdir(parents=True)
        (tmp_path / "runs" / name / "journal.jsonl").touch()
    command, setting = SHELLS[shell]
    terminal = Terminal(command, tmp_path)
    try:
        terminal.does(setting)
        terminal.does(f'eval "$(humanoid --show-completion {shell})"')
        terminal.does("humanoid do -w goo\t")
        terminal.does("humanoid why goo\t")
        terminal.does("humanoid why a\t")
        for name in NAMES:
            terminal.does(f"humanoid do -w {name[0]}\t")
    finally:
        terminal.close()
    told = (tmp_path / "told").read_text()
    assert "do -w good.yaml" in told
    assert "why good" in told
    assert not (tmp_path / "ran").exists()
