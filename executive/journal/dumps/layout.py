"""Where the nodes of a picture stand: a tidy tree from left to right.

Leaves stand one below the other; a node stands in the middle of its children, in the column of its
depth. Every node has its box to itself, whatever the tree ([Wetherell and Shannon 1979] calls it
tidy), and 500 of them remain a list that can be read from top to bottom, in columns.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise

import msgspec

from executive.journal.snapshot import Shown
from executive.journal.tree import State
from robot.printable import printable_line

MARGIN, GAP_X, GAP_Y = 16.0, 34.0, 8.0
PAD_X, MARK_WIDTH = 10.0, 22.0
LINE_HEIGHT, NOTE_HEIGHT = 26.0, 15.0
NAME_CHARS, NOTE_CHARS = 48, 60

NAME_PX, NOTE_PX = 13, 11
ASPECT = 1.5
"""How high a picture may be for its width; a higher one gets another column."""

Measure = Callable[[str, int], float]
"""Width of a text in pixels, in letters of a size."""


class Look(msgspec.Struct, frozen=True):
    """Colours of a state: fill, border and text; whether the border is dashed."""

    fill: str
    line: str
    text: str
    dashed: bool = False


LOOKS: dict[State, Look] = {
    "waiting": Look("#ffffff", "#8b93a1", "#4b5563", dashed=True),
    "running": Look("#dbeafe", "#1d4ed8", "#0f2a6b"),
    "done": Look("#dcfce7", "#15803d", "#0b4a22"),
    "failed": Look("#fee2e2", "#b91c1c", "#7a1010"),
    "stopped": Look("#ede9fe", "#6d28d9", "#3d1580", dashed=True),
}

STROKES: dict[State, tuple[tuple[tuple[float, float], ...], ...]] = {
    "waiting": (((0.4, 0.5), (0.5, 0.4), (0.6, 0.5), (0.5, 0.6), (0.4, 0.5)),),
    "running": (((0.3, 0.2), (0.78, 0.5), (0.3, 0.8), (0.3, 0.2)),),
    "done": (((0.15, 0.55), (0.4, 0.82), (0.88, 0.2)),),
    "failed": (((0.2, 0.2), (0.8, 0.8)), ((0.8, 0.2), (0.2, 0.8))),
    "stopped": (((0.22, 0.22), (0.78, 0.22), (0.78, 0.78), (0.22, 0.78), (0.22, 0.22)),),
}
"""The mark of a state as lines in the unit square, y down: a shape, so that no hue is needed."""


class Box(msgspec.Struct, kw_only=True):
    """A node in the picture, in pixels; `name` and `note` are cut to what fits."""

    x: float
    y: float
    width: float
    height: float
    shown: Shown
    name: str
    note: str


class Picture(msgspec.Struct, kw_only=True):
    """Boxes, and lines between them as pairs of their indices."""

    width: float
    height: float
    boxes: list[Box]
    edges: list[tuple[int, int]]


def arrange(roots: Sequence[Shown], measure: Measure) -> Picture:
    """Lay a snapshot out: in one column, or, where that would be a long strip, in several."""
    whole = _column(roots, measure)
    count = round(math.sqrt(whole.height / (ASPECT * max(whole.width, 1.0))))
    if count < 2:
        return whole
    return _beside([_column(part, measure) for part in split(roots, count)])


def split(roots: Sequence[Shown], count: int) -> list[list[Shown]]:
    """A snapshot in parts of about as many leaves each, in order.

    What a leaf stands in comes again in every part that it goes on into.
    """
    leaves = sum(1 for root in roots for _, shown in root.walk() if not shown.children)
    parts: list[list[Shown]] = [[] for _ in range(count)]
    copies: list[dict[int, Shown]] = [{} for _ in range(count)]
    path: list[Shown] = []
    number = 0
    for root in roots:
        for depth, shown in root.walk():
            path[depth:] = [shown]
            if shown.children:
                continue
            part = number * count // leaves
            number += 1
            siblings, known = parts[part], copies[part]
            for above in path:
                if above.id not in known:
                    again = any(above.id in before for before in copies[:part])
                    known[above.id] = _copy(above, again=again)
                    siblings.append(known[above.id])
                siblings = known[above.id].children
    return parts


def _copy(shown: Shown, *, again: bool) -> Shown:
    note = "continued" if again else shown.note
    return msgspec.structs.replace(shown, note=note, children=[])


def _beside(columns: Sequence[Picture]) -> Picture:
    """Columns side by side."""
    whole = Picture(width=0.0, height=0.0, boxes=[], edges=[])
    for column in columns:
        first = len(whole.boxes)
        for box in column.boxes:
            box.x += whole.width
        whole.boxes += column.boxes
        whole.edges += [(parent + first, child + first) for parent, child in column.edges]
        whole.width += column.width
        whole.height = max(whole.height, column.height)
    return whole


def _column(roots: Sequence[Shown], measure: Measure) -> Picture:
    boxes, edges, depths = _boxes(roots, measure)
    widths: dict[int, float] = {}
    for box, depth in zip(boxes, depths, strict=True):
        widths[depth] = max(widths.get(depth, 0.0), box.width)
    lefts = [MARGIN]
    for depth in range(len(widths)):
        lefts.append(lefts[depth] + widths[depth] + GAP_X)
    below: list[list[int]] = [[] for _ in boxes]
    for parent, child in edges:
        below[parent].append(child)
    for index, box in enumerate(boxes):
        box.x = lefts[depths[index]]
    _stack(boxes, below, [index for index, depth in enumerate(depths) if depth == 0])
    width = max((box.x + box.width for box in boxes), default=0.0) + MARGIN
    height = max((box.y + box.height for box in boxes), default=0.0) + MARGIN
    return Picture(width=width, height=height, boxes=boxes, edges=edges)


def _stack(boxes: list[Box], below: list[list[int]], roots: list[int]) -> None:
    """Give every subtree a strip of its own, as high as its node or its children need."""
    heights = [box.height for box in boxes]
    inside = [0.0] * len(boxes)
    for index in reversed(range(len(boxes))):  # children before parents
        if below[index]:
            inside[index] = sum(heights[child] + GAP_Y for child in below[index]) - GAP_Y
            heights[index] = max(heights[index], inside[index])
    tops = [MARGIN] * len(boxes)
    for first, second in pairwise(roots):
        tops[second] = tops[first] + heights[first] + GAP_Y
    for index, box in enumerate(boxes):
        top = tops[index] + 0.5 * (heights[index] - inside[index])
        for child in below[index]:
            tops[child] = top
            top += heights[child] + GAP_Y
        box.y = tops[index] + 0.5 * (heights[index] - box.height)
    for index in reversed(range(len(boxes))):  # in the middle of its first and last child
        children = [boxes[child] for child in below[index]]
        if children and inside[index] >= boxes[index].height:
            first, last = children[0], children[-1]
            middle = 0.5 * (first.y + 0.5 * first.height + last.y + 0.5 * last.height)
            boxes[index].y = middle - 0.5 * boxes[index].height


def _boxes(
    roots: Sequence[Shown], measure: Measure
) -> tuple[list[Box], list[tuple[int, int]], list[int]]:
    boxes: list[Box] = []
    edges: list[tuple[int, int]] = []
    depths: list[int] = []
    stack = [(0, -1, root) for root in reversed(roots)]
    while stack:
        depth, parent, shown = stack.pop()
        index = len(boxes)
        boxes.append(_box(shown, measure))
        depths.append(depth)
        if parent >= 0:
            edges.append((parent, index))
        stack.extend((depth + 1, index, child) for child in reversed(shown.children))
    return boxes, edges, depths


def _box(shown: Shown, measure: Measure) -> Box:
    name, note = cut(shown.name, NAME_CHARS), cut(_note(shown), NOTE_CHARS)
    width = MARK_WIDTH + max(measure(name, NAME_PX), measure(note, NOTE_PX)) + 2.0 * PAD_X
    height = LINE_HEIGHT + (NOTE_HEIGHT if note else 0.0)
    return Box(x=0.0, y=0.0, width=width, height=height, shown=shown, name=name, note=note)


def _note(shown: Shown) -> str:
    """What stands in a node's second line: of a leaf, what it says; how long it took."""
    took = f"{shown.took_s:.1f} s" if shown.took_s else ""
    kind = shown.kind.replace("_", " ") if shown.children else ""
    return ", ".join(word for word in (kind, shown.note, took) if word)


def cut(text: str, chars: int) -> str:
    """A text on one line, no longer than that."""
    line = printable_line(text)
    return line if len(line) <= chars else line[: chars - 1] + "…"
