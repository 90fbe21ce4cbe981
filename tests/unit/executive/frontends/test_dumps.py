"""Pages and pictures of trees say what is there."""

from pathlib import Path

from py_trees.common import Status

from executive.frontends.reference.failures import page
from executive.frontends.tree_lines import lines, text
from executive.journal.pages.text import ASCII_MARKS
from executive.skills.parameters import PickParams
from executive.trees.build import build
from executive.trees.parts import Series
from tests.fakes.rig import PICK, WAIT, Rig
from tests.fakes.scripted_skills import Script

ROOT = Path(__file__).parents[4]


def test_the_page_of_failures_is_current():
    current = (ROOT / "docs" / "failures.md").read_text(encoding="utf-8")
    assert current == page(), (
        "run: python -m executive.frontends.reference.failures docs/failures.md"
    )


def test_a_tree_is_shown_without_the_nodes_that_mean_nothing():
    rig = Rig({PickParams: [Script(steps=3)]})
    node = build(Series(name="task", parts=(PICK, WAIT)), rig.stage)
    rig.executive.submit(lambda _: node, text="task")
    rig.tick(2)
    assert text(node, marks=ASCII_MARKS) == "> task\n  > pick: working\n    wait"


def test_a_recovery_shows_what_was_tried():
    rig = Rig({PickParams: [Script(code="grasp_missed"), Script(steps=5)]})
    node = build(Series(name="task", parts=(PICK, WAIT)), rig.stage)
    rig.executive.submit(lambda _: node, text="task")
    rig.tick(4)
    shown = [(line.depth, line.name, line.state) for line in lines(node)]
    assert shown == [
        (0, "task", "running"),
        (1, "pick", "running"),
        (2, "pick", "failed"),
        (2, "recover", "done"),
        (2, "look again, then retry", "running"),
        (3, "look for cup", "done"),
        (3, "pick", "running"),
        (1, "wait", "waiting"),
    ]
    assert node.status is Status.RUNNING
