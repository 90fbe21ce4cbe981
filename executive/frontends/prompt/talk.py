"""What a prompt needs of whom it talks to: the shell of this process, or that of another one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from executive.engine.loop import Interrupts
from executive.frontends.prompt.command import Command
from executive.frontends.prompt.view import View
from intents.vocabulary import Vocabulary


class Named(Protocol):
    """Knows the names of a world."""

    @property
    def vocabulary(self) -> Vocabulary:
        """They."""
        ...


class Hushed(Protocol):
    """Falls silent."""

    def hush(self) -> None:
        """Say no more of what was to be said aloud."""
        ...


class Seen(Protocol):
    """A robot, as far as a prompt shows it."""

    interrupts: Interrupts

    @property
    def view(self) -> View:
        """How it is now."""
        ...

    @property
    def busy(self) -> bool:
        """Whether a job is under way or waits."""
        ...

    def wait(self, *, asked: bool = False) -> None:
        """Return when nothing is left to do, the robot is gone, or waits to be told to go on.

        With `asked` also when it asks a person for help.
        """
        ...


class Stopping(Protocol):
    """What brings a robot to a stand; `executive.frontends.prompt.brake.Brake`."""

    @property
    def stops(self) -> int:
        """How often it was told to stop."""
        ...

    def is_cry(self, text: str) -> bool:
        """Whether a line is a cry to stop."""
        ...

    def stop(self, why: str) -> None:
        """Bring the robot to a stand and end all jobs, and say so."""
        ...

    def stop_unsaid(self, why: str) -> None:
        """Stop without a word."""
        ...

    def ask_no_more(self) -> bool:
        """Close what was asked of the person; whether there was anything."""
        ...

    def standing(self) -> str:
        """What is true of a robot that has nothing to stop."""
        ...


class Spoken(Protocol):
    """Takes lines."""

    leaving: bool

    @property
    def robot(self) -> Seen:
        """Who is spoken to."""
        ...

    @property
    def brake(self) -> Stopping:
        """What stops the robot."""
        ...

    @property
    def gone(self) -> str:
        """That the robot is gone, and what to do; empty while it is there."""
        ...

    def out(self, text: str, /) -> None:
        """Say a line to people."""
        ...

    def line(self, text: str, *, stops: int | None = None) -> None:
        """Do what a line says that was typed when `stops` was so much."""
        ...

    def unhelped(self, text: str = "") -> bool:
        """Give up where a job asks for help, unless a line answers it; whether it was given up."""
        ...


class Talk(Spoken, Protocol):
    """A conversation, as a prompt on a terminal needs it; `executive.frontends.prompt.shell`."""

    @property
    def dialogue(self) -> Named:
        """What is completed."""
        ...

    @property
    def speech(self) -> Hushed:
        """What is said aloud."""
        ...

    @property
    def commands(self) -> Mapping[str, Command]:
        """By their names."""
        ...

    def answer(self, text: str) -> None:
        """Say a line to people, and aloud."""
        ...

    def stop_at_once(self, text: str) -> bool:
        """Stop if a line is a cry to stop, before anything else looks at it."""
        ...

    def is_emergency(self, text: str) -> bool:
        """Whether a line is about the emergency stop; it is pressed here."""
        ...

    def halt_at_once(self, text: str, *, busy: bool | None = None) -> bool:
        """Halt a robot at work if a line is a cry that ends nothing."""
        ...

    def leave(self) -> None:
        """The person leaves."""
        ...
