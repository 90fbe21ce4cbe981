"""The lines below the prompt: the tree, if it is wanted, and the state of the robot."""

from __future__ import annotations

from prompt_toolkit.formatted_text import StyleAndTextTuples

from executive.frontends.prompt.view import View
from executive.health import Level
from executive.journal.dumps.text import MARKS
from executive.journal.snapshot import Shown, window

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
    name = f"{'  ' * depth}{MARKS[shown.state]} {shown.name}"[: columns - 1]
    note = f"  {shown.note}" if shown.note and shown.state != "done" else ""
    note = note[: max(0, columns - 1 - len(name))]
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
        if len(doing[0]) > columns and view.phase:
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
        used = sum(len(told) + 1 for _, told in lines[-1])
        if lines[-1] and used + len(text) > columns:
            if len(lines) == MOST_LINES:
                break
            lines.append([])
        cut = text if len(text) <= columns else f"{text[: columns - 1]}…"
        lines[-1].append((style, cut))
    shown: StyleAndTextTuples = []
    for line in lines:
        shown += [("", "\n")] if shown else []
        width = sum(len(text) for _, text in line) + len(line) - 1
        for number, (style, text) in enumerate(line):
            shown.append((style, f"|{text}" if number else text))
        shown.append(("class:status", " " * max(0, columns - width)))
    return shown
