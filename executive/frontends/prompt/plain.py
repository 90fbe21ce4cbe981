"""Lines from a pipe: one after the other, each job done before the next line is read."""

from __future__ import annotations

from collections.abc import Iterable

from executive.frontends.prompt.shell import Shell


def work_off(shell: Shell, lines: Iterable[str]) -> None:
    """Do every line; ends with the last, with `quit`, or when the robot is gone."""
    for line in lines:
        text = line.strip()
        if not text or text.startswith("#"):
            continue
        shell.out(f"> {text}")
        shell.line(text)
        shell.robot.wait()
        if shell.gone:
            shell.out(shell.gone)
        if shell.leaving or shell.gone or shell.robot.interrupts.count:
            return
