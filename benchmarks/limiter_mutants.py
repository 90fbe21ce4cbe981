"""`python -m benchmarks.limiter_mutants`: is the last word on motor commands tested to the letter?

One place of `robot/drivers/motors/limiter.py` after the other is made wrong: another operator, a
comparison that is off by its edge, a bound that is the other one, a number that is another, a
branch that is always or never taken, a statement left out. Tests of the limiter have to fail for
each. One that passes is a survivor: either nothing tests that place, or the change changes nothing.
"""

from __future__ import annotations

import ast
import copy
import importlib
import os
import signal
import sys
import time
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, TypeGuard

import hypothesis
import mujoco
import numpy
import pytest
import typer

BEFORE = (hypothesis, mujoco, numpy, pytest)
"""Loaded once, and not anew for every mutant; whatever knows the limiter is."""
NAME = "robot.drivers.motors.limiter"
TESTS = "tests/unit/robot/drivers/can/test_can_limiter.py"
ROOT = Path(__file__).parents[1]
PATIENCE_S = 120.0
"""For the tests of one mutant: one that never ends is noticed, too."""

BINARY: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd,
}  # fmt: skip
COMPARED: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.Gt), ast.Gt: (ast.GtE, ast.Lt), ast.LtE: (ast.Lt, ast.GtE),
    ast.GtE: (ast.Gt, ast.LtE), ast.Eq: (ast.NotEq,), ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,), ast.IsNot: (ast.Is,),
}  # fmt: skip
OTHERS = {"minimum": "maximum", "maximum": "minimum", "min": "max", "max": "min"}
FACTOR = 1.1


def mutants(source: str) -> Iterator[tuple[str, str]]:
    """What is changed, with its line, and the module's text then."""
    tree = ast.parse(source)
    nodes = list(_behaving(tree))
    for number, node in enumerate(nodes):
        for what, change in _changes(node):
            changed = copy.deepcopy(tree)
            there = list(_behaving(changed))[number]
            change(there)
            line = getattr(node, "lineno", 0)
            yield f"line {line}: {what}", ast.unparse(ast.fix_missing_locations(changed))


def _behaving(node: ast.AST) -> Iterator[ast.AST]:
    """What a module does, in one order; what it says of types is nothing that it does."""
    yield node
    for field, value in ast.iter_fields(node):
        if field in {"annotation", "returns"}:
            continue
        children: list[object] = value if isinstance(value, list) else [value]
        for child in children:
            if isinstance(child, ast.AST):
                yield from _behaving(child)


def _changes(node: ast.AST) -> Iterator[tuple[str, _Change]]:
    if isinstance(node, ast.BinOp | ast.AugAssign) and type(node.op) in BINARY:
        other = BINARY[type(node.op)]
        yield f"{type(node.op).__name__} to {other.__name__}", _Change("op", other())
    elif isinstance(node, ast.Compare) and len(node.ops) == 1:
        for compared in COMPARED.get(type(node.ops[0]), ()):
            name = f"{type(node.ops[0]).__name__} to {compared.__name__}"
            yield name, _Change("ops", [compared()])
    elif isinstance(node, ast.BoolOp):
        other_bool = ast.Or() if isinstance(node.op, ast.And) else ast.And()
        yield f"{type(node.op).__name__} to {type(other_bool).__name__}", _Change("op", other_bool)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield "without its minus", _Change("op", ast.UAdd())
    elif isinstance(node, ast.If | ast.IfExp):
        yield "always", _Change("test", ast.Constant(value=True))
        yield "never", _Change("test", ast.Constant(value=False))
    elif isinstance(node, ast.Attribute | ast.Name):
        field = "attr" if isinstance(node, ast.Attribute) else "id"
        if (name := getattr(node, field)) in OTHERS:
            yield f"{name} to {OTHERS[name]}", _Change(field, OTHERS[name])
    elif isinstance(node, ast.Constant) and _is_number(value := node.value):
        other_value = value * FACTOR if value else 1
        yield f"{value} to {other_value:g}", _Change("value", other_value)
    elif isinstance(node, ast.FunctionDef):
        yield from _left_out(node)


def _is_number(value: object) -> TypeGuard[int | float]:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _left_out(node: ast.FunctionDef) -> Iterator[tuple[str, _Change]]:
    """Each statement of a function left out, but for what it returns and its docstring."""
    for place, statement in enumerate(node.body):
        if not isinstance(statement, ast.Assign | ast.AugAssign | ast.Expr | ast.If | ast.For):
            continue
        if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant):
            continue
        body = [*node.body[:place], ast.Pass(), *node.body[place + 1 :]]
        yield f"without line {statement.lineno} of {node.name}", _Change("body", body)


class _Change:
    """Sets one field of a node."""

    def __init__(self, field: str, value: object) -> None:
        self._field, self._value = field, value

    def __call__(self, node: ast.AST) -> None:
        setattr(node, self._field, self._value)


def is_killed(source: str) -> bool:
    """Whether the tests fail with this text in place of the limiter's."""
    child = os.fork()
    if not child:
        _play(source)
    until_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < until_s:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return status != 0
        time.sleep(0.02)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return True


def _play(source: str) -> None:
    """In a process of its own: run the tests and end with their status."""
    found = (hypothesis.Phase.explicit, hypothesis.Phase.generate)  # an example need not be small
    hypothesis.settings.register_profile("mutants", phases=found, database=None)
    hypothesis.settings.load_profile("mutants")
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 1)
    os.dup2(quiet, 2)
    status = 1
    try:
        module = types.ModuleType(NAME)
        module.__file__ = str(ROOT / "robot/drivers/motors/limiter.py")
        sys.modules[NAME] = module
        exec(compile(source, module.__file__, "exec"), module.__dict__)
        importlib.import_module(NAME.rpartition(".")[0]).limiter = module  # pyright: ignore
        status = int(pytest.main(["-x", "-q", "-p", "no:cacheprovider", str(ROOT / TESTS)]))
    finally:
        os._exit(1 if status else 0)


def main(
    *,
    match: Annotated[str, typer.Option(help="only changes whose name contains this")] = "",
) -> None:
    """Play all; a line for each survivor. Ends with 1 if there is any."""
    source = (ROOT / "robot/drivers/motors/limiter.py").read_text(encoding="utf-8")
    if is_killed(ast.unparse(ast.parse(source))):
        print("the limiter's own tests fail", file=sys.stderr)
        raise typer.Exit(2)
    survivors: list[str] = []
    count = 0
    for name, text in mutants(source):
        if match not in name:
            continue
        count += 1
        if not is_killed(text):
            survivors.append(name)
            print(f"survives: {name}", flush=True)
    print(f"{count} mutants, {count - len(survivors)} killed, {len(survivors)} survive")
    raise typer.Exit(1 if survivors else 0)


if __name__ == "__main__":
    typer.run(main)
