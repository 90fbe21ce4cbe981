"""A snapshot as PNG, drawn with Pillow."""

from __future__ import annotations

import io
from collections.abc import Sequence

from PIL import Image, ImageDraw, ImageFont

from executive.journal.dumps.layout import (
    LINE_HEIGHT,
    LOOKS,
    MARK_WIDTH,
    NAME_PX,
    NOTE_HEIGHT,
    NOTE_PX,
    PAD_X,
    Box,
    Picture,
    arrange,
)
from executive.journal.dumps.svg import mark
from executive.journal.snapshot import Shown

MAX_PIXELS = 16_000_000
"""A larger picture is drawn smaller."""

Font = ImageFont.FreeTypeFont | ImageFont.ImageFont
_FONTS = ("DejaVuSans.ttf", "LiberationSans-Regular.ttf", "Arial.ttf")


def png(roots: Sequence[Shown], *, scale: float = 2.0) -> bytes:
    """A picture; `scale` is pixels of the picture for one of the layout."""
    probe = _Pen(1.0)
    picture = arrange(roots, probe.measure)
    area = max(picture.width * picture.height, 1.0)
    pen = _Pen(min(scale, (MAX_PIXELS / area) ** 0.5))
    image = pen.draw(picture)
    file = io.BytesIO()
    image.save(file, format="PNG")
    return file.getvalue()


class _Pen:
    """Draws at a scale."""

    def __init__(self, scale: float) -> None:
        self._scale = scale
        self._fonts = {size: font(size * scale) for size in (NAME_PX, NOTE_PX)}

    def measure(self, text: str, size: int) -> float:
        """Width of a text in pixels of the layout."""
        return self._fonts[size].getlength(text) / self._scale

    def draw(self, picture: Picture) -> Image.Image:
        """All of it on white."""
        size = (self._px(max(picture.width, 1.0)), self._px(max(picture.height, 1.0)))
        image = Image.new("RGB", size, "#ffffff")
        draw = ImageDraw.Draw(image)
        for parent, child in picture.edges:
            self._edge(draw, picture.boxes[parent], picture.boxes[child])
        for box in picture.boxes:
            self._box(draw, box)
        return image

    def _px(self, value: float) -> int:
        return max(1, round(value * self._scale))

    def _edge(self, draw: ImageDraw.ImageDraw, a: Box, b: Box) -> None:
        y0, y1 = a.y + 0.5 * a.height, b.y + 0.5 * b.height
        middle = b.x - 17.0
        points = [(a.x + a.width, y0), (middle, y0), (middle, y1), (b.x, y1)]
        draw.line(self._points(points), fill="#9ca3af", width=self._px(1.0))

    def _box(self, draw: ImageDraw.ImageDraw, box: Box) -> None:
        look = LOOKS[box.shown.state]
        corners = self._points([(box.x, box.y), (box.x + box.width, box.y + box.height)])
        width = self._px(1.0 if look.dashed else 1.5)
        draw.rounded_rectangle(
            corners, self._px(5.0), fill=look.fill, outline=look.line, width=width
        )
        for stroke in mark(box):
            draw.line(self._points(stroke), fill=look.line, width=self._px(2.0), joint="curve")
        x, y = box.x + PAD_X + MARK_WIDTH, box.y + 0.5 * LINE_HEIGHT
        self._text(draw, (x, y), box.name, NAME_PX, look.text)
        if box.note:
            self._text(draw, (x, y + NOTE_HEIGHT + 1.0), box.note, NOTE_PX, look.text)

    def _text(
        self, draw: ImageDraw.ImageDraw, at: tuple[float, float], text: str, size: int, fill: str
    ) -> None:
        draw.text(self._points([at])[0], text, font=self._fonts[size], fill=fill, anchor="lm")

    def _points(self, points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
        return [(x * self._scale, y * self._scale) for x, y in points]


def font(size: float) -> Font:
    """A font of this machine with many letters, else the one that Pillow brings."""
    for name in _FONTS:
        try:
            return ImageFont.truetype(name, size)
        except OSError:
            continue
    return ImageFont.load_default(size)
