from hypothesis import given
from hypothesis import strategies as st
from prompt_toolkit.formatted_text import to_plain_text
from rich.cells import cell_len

from executive.frontends.prompt.toolbar import MOST_LINES, toolbar
from executive.frontends.prompt.view import View, view_of_lost
from executive.health import Level
from executive.journal.snapshot import Shown, window
from robot.failures import failure
from robot.printable import is_printable

words = st.text(st.one_of(st.characters(), st.sampled_from("\x1b\x9b\n\t\u202e杯👋")), max_size=60)
trees = st.lists(
    st.tuples(
        st.integers(0, 30),
        st.builds(
            Shown,
            id=st.just(0),
            kind=st.just("skill"),
            name=words,
            state=st.sampled_from(["waiting", "running", "done", "failed", "stopped"]),
            note=words,
        ),
    ),
    max_size=60,
)


@given(
    tree=trees,
    goal=words,
    phase=words,
    unwell=words,
    columns=st.integers(2, 200),
    rows=st.integers(0, 20),
)
def test_the_toolbar_fits_any_terminal(tree, goal, phase, unwell, columns, rows):
    level = Level.HOLD if unwell else Level.OK
    view = View(
        goal=goal, phase=phase, unwell=unwell, level=level, tree=tuple(tree), pose=(1, 2, 3)
    )
    lines = to_plain_text(toolbar(view, columns=columns, rows=rows)).split("\n")
    assert len(lines) <= rows + MOST_LINES
    assert all(cell_len(line) <= columns for line in lines)
    assert cell_len(lines[-1]) == columns
    assert all(map(is_printable, lines))


@given(tree=trees, rows=st.integers(1, 20))
def test_what_runs_stays_in_sight(tree, rows):
    shown = window(tuple(tree), rows)
    running = [line for line in tree if line[1].state == "running"]
    assert len(shown) == min(rows, len(tree))
    if running:
        assert running[-1] in shown


def test_trouble_and_questions_are_told():
    view = View(level=Level.HOLD, unwell="the lidar is silent", help="move the chair")
    text = to_plain_text(toolbar(view, columns=120, rows=0))
    assert "hold: the lidar is silent" in text
    assert "asks: move the chair" in text
    assert "healthy" not in text


def test_a_robot_that_is_gone_is_not_called_healthy():
    lost = failure("plant_lost", "the simulation died")
    view = view_of_lost(View(mode="walk", goal="go to the table", pose=(1, 2, 3)), lost)
    text = to_plain_text(toolbar(view, columns=120, rows=0))
    assert "gone" in text
    assert "the simulation died" in text
    assert "healthy" not in text
    assert "table" not in text


def test_at_sixty_columns_nothing_is_cut_off():
    view = View(
        mode="walk", goal="put the red cup on the shelf", phase="walking to the table", waiting=2,
        held=("right: red cup",), pose=(-1.2, 3.4, 120.0), time_s=123.0,
    )  # fmt: skip
    text = to_plain_text(toolbar(view, columns=60, rows=0))
    for told in ("walk", "healthy", view.goal, view.phase, "+2 waiting", "holds right: red cup",
                 "at -1.2, 3.4 m, 120°", "123 s"):  # fmt: skip
        assert told in text


def test_a_robot_that_squats_is_not_said_to_stand():
    view = View(mode="stand", low=True, state="working", goal="squat for 5 s")
    text = to_plain_text(toolbar(view, columns=100, rows=0))
    assert "low |" in text
    assert "stand" not in text
