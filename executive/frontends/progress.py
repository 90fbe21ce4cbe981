"""What people see while the robot works: a live tree on a terminal, plain lines elsewhere."""

from __future__ import annotations

from collections.abc import Callable
from typing import Self

from rich.console import Group
from rich.live import Live
from rich.text import Text

from executive.blackboard import GOAL, HEALTH, HELD, SAID, STOP
from executive.engine.executive import Executive
from executive.frontends.output import Screen, say
from executive.frontends.recurring import Recurring
from executive.journal import words
from executive.journal.dumps.text import MARKS
from executive.journal.journal import Event
from executive.journal.snapshot import Shown, at_work, in_order, window
from executive.journal.tree import State
from robot.closing import Closing
from robot.printable import printable_line

REFRESH_S, SELDOM_S = 0.1, 1.0
_STYLES: dict[State, str] = {
    "waiting": "dim", "running": "bold yellow", "done": "green", "failed": "red",
    "stopped": "magenta",
}  # fmt: skip


class Silent(Closing):
    """Shows nothing (`--json`)."""

    def update(self) -> None:
        """Show nothing."""

    def close(self) -> None:
        """Leave the screen in order."""


class Lines(Silent):
    """One line an event: for pipes, logs and CI."""

    def __init__(self, executive: Executive) -> None:
        """Print the journal's events as they come."""
        self._recurring, self._heard_s = Recurring(), 0.0
        executive.journal.listen(self._heard)

    def _heard(self, event: Event) -> None:
        self._heard_s = event.t_s
        for told in self._recurring.news(event, sentence(event)):
            self._say(told)

    def _say(self, told: str) -> None:
        say(f"[{self._heard_s:7.2f} s] {told}")

    def close(self) -> None:
        """Tell what nobody has said to be over."""
        for told in self._recurring.rest():
            self._say(told)


class LiveTree(Silent):
    """The tree, redrawn in place."""

    def __init__(
        self, executive: Executive, console: Screen, *, wall_s: Callable[[], float]
    ) -> None:
        """Draw on `console`; `wall_s` paces the drawing."""
        self._executive = executive
        self._wall_s = wall_s
        self._drawn_s = self._begun_s = wall_s()
        self._first_s: float | None = None
        self._live = Live(console=console, auto_refresh=False, vertical_overflow="crop")
        self._console = console
        executive.journal.listen(self._heard)

    def _heard(self, event: Event) -> None:
        """Warnings scroll by above the tree."""
        if event.event == "warning":
            self._console.print(f"warning: {event.data['text']}", style="yellow")

    def update(self) -> None:
        """Draw, at most every `REFRESH_S`, and seldom while the controller is pressed for time."""
        now_s, health = self._wall_s(), self._executive.board.read(HEALTH)
        if now_s - self._drawn_s >= (SELDOM_S if health.pressed else REFRESH_S):
            self._drawn_s = now_s
            self._live.update(self._picture(now_s), refresh=True)

    def _picture(self, wall_s: float) -> Group:
        board, stage = self._executive.board, self._executive.stage
        if self._first_s is None:
            self._first_s, self._begun_s = stage.now_s, wall_s
        past_s, wall_past_s = stage.now_s - self._first_s, wall_s - self._begun_s
        factor = past_s / wall_past_s if wall_past_s > 0.5 else 1.0
        head = _line(printable_line(board.read(GOAL)), style="bold")
        foot = Text(f"{stage.now_s:6.1f} s  {factor:4.1f} x real time", style="dim")
        if board.read(STOP):
            foot.append("  stopping; Ctrl-C again to let the motors damp at once", style="yellow")
        health = board.read(HEALTH)
        if health.failure is not None:
            foot.append(f"  {health.failure.cause}", style="red")
        held = ", ".join(f"{side} hand: {name}" for side, name in board.read(HELD).items())
        if held:
            foot.append(f"  {held}")
        said = board.read(SAID)
        if said:
            foot.append(f"  says {said!r}", style="cyan")
        return Group(head, *self._tree(), foot)

    def _tree(self) -> list[Text]:
        room = max(6, self._console.size.height - 5)
        lines = window(in_order(at_work(self._executive.so_far)), room)
        return [drawn(depth, shown) for depth, shown in lines]

    def __enter__(self) -> Self:
        """Take the screen's last lines."""
        self._live.start()
        return self

    def close(self) -> None:
        """Leave the last picture standing."""
        self._live.update(self._picture(self._wall_s()), refresh=True)
        self._live.stop()


def _line(text: str, *, style: str = "") -> Text:
    """A line that is cut where the terminal ends: the tree must not grow when it gets narrow."""
    return Text(text, style, no_wrap=True, overflow="ellipsis")


def drawn(depth: int, shown: Shown) -> Text:
    """One line of the tree in its colours."""
    text = _line("  " * depth)
    text.append(f"{MARKS[shown.state]} {printable_line(shown.name)}", style=_STYLES[shown.state])
    if shown.note and shown.state != "done":
        text.append(f"  {printable_line(shown.note)}", style="dim")
    return text


NEWS = frozenset({
    "step", "done", "failure", "recovery", "no recovery", "hold", "abort", "stopping", "paused",
    "resume", "resumed", "help", "answer", "fault", "health", "said", "heard",
    "warning",
    "slip", "break",
})  # fmt: skip
"""Kinds of events that people are told as they happen."""


def sentence(event: Event) -> str:
    """An event in words on one line, empty for those that are not news to people."""
    data = event.data
    if event.event == "phase":
        return printable_line(f"{data['step']}: {data['phase']}")
    if data.get("beginning") or (event.event == "health" and data["level"] == "OK"):
        return ""  # every run waits for its first messages, and what is over troubles nobody
    return printable_line(words.sentence(event.event, data)) if event.event in NEWS else ""
