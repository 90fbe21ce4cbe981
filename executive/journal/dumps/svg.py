"""A snapshot as SVG."""

from __future__ import annotations

from collections.abc import Sequence
from unicodedata import east_asian_width
from xml.sax.saxutils import escape

from executive.journal.dumps.layout import (
    LINE_HEIGHT,
    LOOKS,
    MARK_WIDTH,
    NAME_PX,
    NOTE_HEIGHT,
    NOTE_PX,
    PAD_X,
    STROKES,
    Box,
    Picture,
    arrange,
)
from executive.journal.snapshot import Shown
from robot.printable import printable

FONT = "DejaVu Sans, Verdana, Helvetica, Arial, sans-serif"
_NARROW, _WIDE = frozenset("fijlrtI.,:;'|!()[] "), frozenset("mwMW@%…")


def svg(roots: Sequence[Shown], *, title: str) -> str:
    """A picture of its own size, with the whole names as tool tips."""
    picture = arrange(roots, measure)
    width, height = round(picture.width), round(picture.height)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" font-family="{FONT}" role="img">',
        f"<title>{_safe(title)}</title>",
        '<rect width="100%" height="100%" fill="#ffffff"/>',
        *_edges(picture),
        *(_box(box) for box in picture.boxes),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def measure(text: str, size: int) -> float:
    """About how wide a text is in the fonts named above; rather more than less."""
    return size * sum(
        0.38
        if c in _NARROW
        else 0.98
        if c in _WIDE
        else 1.3
        if east_asian_width(c) in "WF"
        else 0.66
        for c in text
    )


def _edges(picture: Picture) -> list[str]:
    lines: list[str] = []
    for parent, child in picture.edges:
        a, b = picture.boxes[parent], picture.boxes[child]
        x0, y0 = a.x + a.width, a.y + 0.5 * a.height
        x1, y1 = b.x, b.y + 0.5 * b.height
        middle = x1 - 17.0
        path = f"M{x0:.1f} {y0:.1f}H{middle:.1f}V{y1:.1f}H{x1:.1f}"
        lines.append(f'<path d="{path}" fill="none" stroke="#9ca3af"/>')
    return lines


def _box(box: Box) -> str:
    look = LOOKS[box.shown.state]
    dash = ' stroke-dasharray="4 3"' if look.dashed else ""
    x, y = box.x + PAD_X + MARK_WIDTH, box.y + 0.5 * LINE_HEIGHT + 4.5
    tip = f"{box.shown.name} ({box.shown.kind}): {box.shown.state}"
    tip += f", {box.shown.note}" if box.shown.note else ""
    note = (
        f'<text x="{x:.1f}" y="{y + NOTE_HEIGHT:.1f}" font-size="{NOTE_PX}" '
        f'fill="{look.text}">{_safe(box.note)}</text>'
        if box.note
        else ""
    )
    return (
        f"<g><title>{_safe(tip)}</title>"
        f'<rect x="{box.x:.1f}" y="{box.y:.1f}" width="{box.width:.1f}" height="{box.height:.1f}" '
        f'rx="5" fill="{look.fill}" stroke="{look.line}" stroke-width="1.5"{dash}/>'
        f'<path d="{_mark(box)}" fill="none" stroke="{look.line}" stroke-width="2" '
        'stroke-linecap="round" stroke-linejoin="round"/>'
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{NAME_PX}" fill="{look.text}">'
        f"{_safe(box.name)}</text>{note}</g>"
    )


def mark(box: Box, size: float = 12.0) -> list[list[tuple[float, float]]]:
    """The lines of a box's mark in pixels."""
    left, top = box.x + PAD_X, box.y + 0.5 * (LINE_HEIGHT - size)
    return [
        [(left + size * u, top + size * v) for u, v in stroke]
        for stroke in STROKES[box.shown.state]
    ]


def _mark(box: Box) -> str:
    return "".join("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in stroke) for stroke in mark(box))


def _safe(text: str) -> str:
    """Text as XML may have it: escaped, with the characters that it forbids written out."""
    return escape(printable(text), {'"': "&quot;"})
