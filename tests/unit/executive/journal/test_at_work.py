"""The tree on the screen, grown from the journal while it is written, is the tree that ticks."""

from executive.journal.dumps.text import picture
from executive.journal.snapshot import at_work, in_order, snapshot
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.wait import WaitParams
from executive.trees.build import build
from executive.trees.parts import OnFail, Series
from tests.fakes.recorded import Recorded
from tests.fakes.rig import PICK, WAIT, WALK
from tests.fakes.scripted_skills import Script


def seen(rig: Recorded) -> list[tuple[int, str, str]]:
    lines = in_order(at_work(rig.executive.so_far))
    return [(depth, shown.name, shown.state) for depth, shown in lines]


def test_a_tree_is_shown_without_the_nodes_that_mean_nothing():
    rig = Recorded({PickParams: [Script(steps=3)]})
    rig.begin(PICK, WAIT).tick(2)
    text = picture(at_work(rig.executive.so_far), style="ascii")
    assert text == "> task\n  > pick: working\n    wait"


def test_a_recovery_shows_what_was_tried():
    rig = Recorded({PickParams: [Script(code="grasp_missed"), Script(steps=5)]})
    rig.begin(PICK, WAIT).tick(4)
    assert seen(rig) == [
        (0, "task", "running"),
        (1, "pick", "running"),
        (2, "pick", "failed"),
        (2, "recover", "done"),
        (2, "look again, then retry", "running"),
        (3, "look for cup", "done"),
        (3, "pick", "running"),
        (1, "wait", "waiting"),
    ]


def test_people_see_on_the_screen_what_a_dump_shows():
    rig = Recorded({PickParams: [Script(steps=2, code="grasp_missed"), Script(steps=9)]})
    rig.begin(WALK, PICK, WAIT)
    for _ in range(10):
        rig.tick()
        (root,) = snapshot(rig.read())
        assert seen(rig) == [(depth, shown.name, shown.state) for depth, shown in root.walk()]


def test_a_task_that_is_over_is_seen_until_it_is_taken_out():
    rig = Recorded()
    assert seen(rig) == []
    rig.begin(WALK).run()
    assert seen(rig) == [(0, "walk", "done")]
    rig.tick(3)
    assert seen(rig) == []


def test_a_step_that_is_held_up_says_so_and_goes_on():
    rig = Recorded({NavigateParams: [Script(steps=50, stop_steps=3), Script(steps=50)]})
    rig.begin(WALK).tick(3)
    rig.executive.pause("wait")
    rig.tick(5)
    assert picture(at_work(rig.executive.so_far), style="ascii") == "> walk: interrupted"
    rig.executive.resume()
    rig.tick(5)
    assert picture(at_work(rig.executive.so_far), style="ascii") == "> walk: working"


def test_what_was_never_begun_is_not_shown_as_done():
    rig = Recorded({WaitParams: [Script(steps=9)]})
    handled = OnFail(name="walk", part=WALK, handlers=(("fallen", PICK),))
    node = build(Series(name="task", parts=(handled, WAIT)), rig.stage)
    rig.executive.submit(lambda _: node, text="task")
    rig.tick(4)
    assert ("wait", "running") in {line[1:] for line in seen(rig)}
    assert ("pick", "waiting") in {line[1:] for line in seen(rig)}
