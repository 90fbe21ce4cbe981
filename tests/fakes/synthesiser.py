"""A stand-in for espeak-ng: a program that keeps the lines it is to say."""

from __future__ import annotations

from pathlib import Path


class Synthesiser:
    """Put a folder of its own on the PATH; `said` is what was said, line by line."""

    def __init__(self, folder: Path, *, first: str = "", last: str = "") -> None:
        """Install it; `first` and `last` are lines of shell before and after it speaks."""
        folder.mkdir(exist_ok=True)
        self._said = folder / "said"
        program = folder / "espeak-ng"
        program.write_text(
            f"#!/bin/sh\nread -r line\n{first}\necho \"$line\" >> '{self._said}'\n{last}\n"
        )
        program.chmod(0o755)

    @property
    def said(self) -> list[str]:
        """What was said, but for the trial."""
        lines = self._said.read_text().splitlines() if self._said.exists() else []
        return [line for line in lines if line]
