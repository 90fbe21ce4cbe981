"""A picture of the robot with the task tree beside it, and what it says below."""

from __future__ import annotations

from bisect import bisect_right
from typing import TypeAlias

from PIL import Image, ImageDraw, ImageFont

from executive.journal.run import Run
from executive.journal.snapshot import Shown, in_order, snapshot, window
from executive.journal.tree import State
from robot.printable import printable_line
from robot.reality.studio import Image as Pixels

Frame: TypeAlias = Image.Image
COLOURS: dict[State, str] = {
    "waiting": "#8b93a1", "running": "#0072b2", "done": "#00835f", "failed": "#c2410c",
    "stopped": "#7a4fb5",
}  # fmt: skip
PANEL_SHARE = 0.3
SAYING_S = 3.0


def panel_px(width: int) -> int:
    """How wide the tree is, of a film so wide; even, as encoders want it."""
    return 2 * round(PANEL_SHARE * width / 2)


class Composer:
    """Puts the parts together."""

    def __init__(self, run: Run, *, width: int, height: int) -> None:
        """Of a run, in pictures of that size."""
        self._run = run
        self._size = (width, height)
        self._panel = panel_px(width)
        self._font = ImageFont.load_default(max(9.0, width / 62))
        self._large = ImageFont.load_default(max(11.0, width / 44))
        self._line = round(max(9.0, width / 62) * 1.5)
        self._said = [(line.t_s, line.text) for line in run.log if line.kind == "said"]

    def compose(self, pixels: Pixels, t_s: float) -> Frame:
        """One picture of the film."""
        frame = Image.new("RGB", self._size, "#ffffff")
        frame.paste(Image.fromarray(pixels), (self._panel, 0))
        draw = ImageDraw.Draw(frame)
        rows = (self._size[1] - 3 * self._line) // self._line
        y = self._line // 2
        for depth, shown in window(in_order(snapshot(self._run, t_s)), max(3, rows)):
            y = self._row(draw, y, depth, shown)
            if y > self._size[1] - 2 * self._line:
                break
        clock = f"{int(t_s // 60)}:{t_s % 60:04.1f}"
        draw.text((self._line // 2, self._size[1] - 1.5 * self._line), clock, "#5c6676", self._font)
        self._subtitle(draw, t_s)
        return frame

    def _row(self, draw: ImageDraw.ImageDraw, y: int, depth: int, shown: Shown) -> int:
        """A node of the tree, on as many lines as it takes; returns where the next one goes."""
        left = self._line // 2 + depth * self._line // 2
        colour = COLOURS[shown.state]
        size = self._line // 3
        top = y + self._line // 3
        draw.ellipse((left, top, left + size, top + size), fill=colour)
        text = "#1b2230" if shown.state == "running" else "#5c6676"
        left += self._line * 2 // 3
        words = [printable_line(shown.name)]
        if shown.note and shown.state in ("running", "failed"):
            words.append(printable_line(shown.note))
        for number, part in enumerate(words):
            for line in self._wrapped(part, self._panel - left - 4):
                draw.text((left, y), line, colour if number else text, self._font)
                y += self._line
        return y

    def _wrapped(self, text: str, width: int) -> list[str]:
        """A text in lines that fit, three at most."""
        lines, line = list[str](), ""
        for word in text.split():
            longer = f"{line} {word}".strip()
            if line and self._font.getlength(longer) > width:
                lines.append(line)
                line = word
            else:
                line = longer
        return [*lines, line][:3]

    def _subtitle(self, draw: ImageDraw.ImageDraw, t_s: float) -> None:
        k = bisect_right(self._said, t_s, key=lambda one: one[0]) - 1
        if k < 0 or t_s - self._said[k][0] > SAYING_S:
            return
        text = f"“{printable_line(self._said[k][1]).removeprefix('says: ')}”"
        width = self._large.getlength(text)
        x = self._panel + (self._size[0] - self._panel - width) / 2
        y = self._size[1] - 2.4 * self._line
        box = (x - 10, y - 5, x + width + 10, y + 1.3 * self._line)
        draw.rounded_rectangle(box, 8, fill="#1b2230")
        draw.text((x, y), text, "#ffffff", self._large)
