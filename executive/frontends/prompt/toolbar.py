"""The lines below the prompt: the tree, if it is wanted, and the state of the robot."""

from __future__ import annotations

from prompt_toolkit.formatted_text import StyleAndTextTuples
from rich.cells import cell_len, set_cell_size

from executive.frontends.prompt.view import View
from executive.health import Level
from executive.journal.dumps.text import MARKS
from executive.journal.snapshot import Shown, window
from robot.printable import printable

STYLES: dict[str, str] = {
    "bottom-toolbar": "noreverse",
    "status": "reverse",
    "status.bad": "reverse fg:ansired bold",
    "status.note": "reverse fg:ansiyellow",
    "tree.waiting": "fg:ansibrightblack",
    "tree.running": "fg:ansiyellow bold",
    "tree.done": "fg:ansigreen",
    "tree.failed": "fg:ansired",
    "tree.stopped": "fg:ansimagenta",
    "tree.note": "fg:ansibrightblack",
}


MOST_LINES = 4
"""Of the state; the least needed is left out after that."""


def toolbar(view: View, *, columns: int, rows: int) -> StyleAndTextTuples:
    """The toolbar for a terminal of that width, with at most `rows` lines of tree."""
    if columns < 2:
        return []
    parts: StyleAndTextTuples = []
    for depth, shown in window(view.tree, rows):
        parts += _tree_line(depth, shown, columns)
    parts += _status(view, columns)
    return parts


def _tree_line(depth: int, shown: Shown, columns: int) -> StyleAndTextTuples:
    name = _cropped(f"{'  ' * depth}{MARKS[shown.state]} {shown.name}", columns - 1)
    note = f"  {shown.note}" if shown.note and shown.state != "done" else ""
    note = _cropped(note, columns - 1 - cell_len(name))
    return [(f"class:tree.{shown.state}", name), ("class:tree.note", note), ("", "\n")]


def _status(view: View, columns: int) -> StyleAndTextTuples:
    """Mode, help, health, goal, pose, pace: the most needed first, on as many lines as it takes."""
    fields: list[tuple[str, str]] = [("class:status", f" {_mode(view)} ")]
    if view.help:
        fields.append(("class:status.note", f" asks: {view.help} "))
    if view.level > Level.OK:
        style = "class:status.bad" if view.level >= Level.HOLD else "class:status.note"
        fields.append((style, f" {view.level.name.lower()}: {view.unwell} "))
    else:
        fields.append(("class:status", " healthy "))
    if view.goal:
        doing = [f" {view.goal} ({view.phase}) "] if view.phase else [f" {view.goal} "]
        if cell_len(doing[0]) > columns and view.phase:
            doing = [f" {view.goal} ", f" {view.phase} "]
        fields += [("class:status", text) for text in doing]
    if view.waiting:
        fields.append(("class:status", f" +{view.waiting} waiting "))
    if view.held:
        fields.append(("class:status", f" holds {', '.join(view.held)} "))
    if view.pose is not None:
        x_m, y_m, yaw_deg = view.pose
        fields.append(("class:status", f" at {x_m:.1f}, {y_m:.1f} m, {yaw_deg:.0f}° "))
    fields.append(("class:status", f" {view.time_s:.0f} s, {view.pace:.1f}x "))
    return _laid_out(fields, columns)


def _mode(view: View) -> str:
    mode = "low" if view.mode == "stand" and view.low else view.mode
    if view.state in ("idle", "working"):
        return mode
    return f"{mode}, {view.state}"


def _laid_out(fields: list[tuple[str, str]], columns: int) -> StyleAndTextTuples:
    """The fields on lines of that width; one that is longer than a line is cut at its end."""
    lines: list[list[tuple[str, str]]] = [[]]
    for style, text in fields:
        told = _cropped(text, columns)
        used = sum(cell_len(one) + 1 for _, one in lines[-1])
        if lines[-1] and used + cell_len(told) > columns:
            if len(lines) == MOST_LINES:
                break
            lines.append([])
        lines[-1].append((style, told))
    shown: StyleAndTextTuples = []
    for line in lines:
        shown += [("", "\n")] if shown else []
        width = sum(cell_len(text) for _, text in line) + len(line) - 1
        for number, (style, text) in enumerate(line):
            shown.append((style, f"|{text}" if number else text))
        shown.append(("class:status", " " * max(0, columns - width)))
    return shown


def _cropped(text: str, columns: int) -> str:
    """As much of a text as fits into so many columns of one line."""
    line = printable(text.replace("\n", " ").replace("\t", " "))
    if cell_len(line) <= columns:
        return line
    return f"{set_cell_size(line, max(0, columns - 1))}…"
