"""A run read from a journal is the run that was played."""

from __future__ import annotations

from itertools import pairwise

import msgspec
from hypothesis import given, settings
from hypothesis import strategies as st

from executive.journal.run import Run
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from tests.fakes.recorded import Recorded, read
from tests.fakes.rig import PICK, PUT, WAIT, WALK
from tests.fakes.scripted_skills import Script


def shown(run: Run, t_s: float) -> dict[str, str]:
    """Names of the skills in view to their states."""
    return {
        node.name: node.at(t_s).state
        for _, node in run.walk()
        if node.kind == "skill" and node.in_view(t_s) and node.name != "come to a stand"
    }


def line(event: str, t_s: float = 0.0, **data) -> bytes:
    return msgspec.json.encode({"n": 0, "t_s": t_s, "event": event, **data}) + b"\n"


def test_the_tree_is_known_at_any_time():
    rig = Recorded({NavigateParams: [Script(steps=4)], PickParams: [Script(steps=4)]})
    rig.begin(WALK, PICK)
    seen = {}
    for _ in range(20):
        rig.tick()
        by_name = {n.name: n for n in rig.tree.root.iterate() if type(n).__name__ == "RunSkill"}
        if "walk" in by_name:  # a task that is over is taken out
            now_s = rig.stage.now_s
            seen[now_s] = {name: by_name[name].status.value for name in ("walk", "pick")}
    run = rig.read()
    states = {"INVALID": "waiting", "RUNNING": "running", "SUCCESS": "done"}
    walked = {t_s: shown(run, t_s) for t_s in seen}
    for t_s, statuses in seen.items():
        for name, status in statuses.items():
            # what was done stays done, even when py_trees forgets it
            expected = states[status]
            assert walked[t_s][name] in (
                {expected, "done"} if expected == "waiting" else {expected}
            )
    steps = ("walk", "pick")
    assert [walked[0.0][name] for name in steps] == ["running", "waiting"]
    assert [walked[max(walked)][name] for name in steps] == ["done", "done"]


def test_intervals_follow_one_another_without_gaps():
    rig = Recorded({NavigateParams: [Script(steps=4)]})
    rig.begin(WALK, PICK).run()
    run = rig.read()
    for _, node in run.walk():
        spans = node.intervals(run.end_s)
        assert all(span.begin_s <= span.end_s for span in spans)
        assert all(a.end_s <= b.begin_s for a, b in pairwise(spans))


def test_a_recovery_is_told_with_the_failure_it_is_for():
    rig = Recorded({PickParams: [Script(code="grasp_missed"), Script(steps=3)]})
    rig.begin(PICK).run()
    (trouble,) = rig.read().troubles
    assert (trouble.step, trouble.code, trouble.ended) == ("pick", "grasp_missed", "recovered")
    assert [what for _, what in trouble.tried] == ["look again, then retry (1 of 2)"]
    assert trouble.suggestion or trouble.cause
    assert rig.read().nodes[trouble.node].name == "pick"
    assert rig.read().nodes[trouble.node].at(trouble.t_s).state == "failed"


def test_a_failure_that_nothing_helps_is_not_recovered():
    rig = Recorded({PickParams: [Script(code="grasp_missed")]})
    rig.begin(PICK, WAIT).run()
    run = rig.read()
    assert len(run.troubles) > 1
    assert {trouble.ended for trouble in run.troubles} == {"not recovered"}
    assert run.outcome is not None
    assert run.outcome.code == "grasp_missed"
    assert shown(run, run.end_s)["wait"] == "waiting"


def test_a_task_stays_in_view_until_the_next_one():
    rig = Recorded()
    rig.begin(WALK).run()
    rig.tick(5)
    assert "walk" in shown(rig.read(), 99.0)
    rig.begin(PICK).run()
    run = rig.read()
    assert "walk" not in shown(run, run.end_s)
    assert "pick" in shown(run, run.end_s)
    assert "walk" in shown(run, 0.05)


def test_jobs_have_their_states():
    rig = Recorded({NavigateParams: [Script(steps=50)]})
    rig.begin(WALK).tick(3)
    rig.submit(PICK, urgent=True)
    rig.run()
    jobs = {job.number: [state for _, state in job.states] for job in rig.read().jobs}
    assert jobs[1][-1] == jobs[2][-1] == "done"
    assert "interrupted" in jobs[1]


def test_a_stopped_run_shows_what_was_stopped():
    rig = Recorded({NavigateParams: [Script(steps=500, stop_steps=4)]})
    rig.begin(WALK).tick(5)
    rig.executive.stop("enough")
    rig.run()
    run = rig.read()
    assert shown(run, run.end_s)["walk"] == "stopped"
    assert run.outcome is not None
    assert run.outcome.code == "cancelled"


def test_a_journal_can_be_cut_anywhere():
    rig = Recorded({PickParams: [Script(code="grasp_missed"), Script(steps=3)]})
    rig.begin(WALK, PICK, PUT).run()
    whole = b"".join(rig.written)
    full = rig.read()
    for end in range(0, len(whole), 37):
        part = whole[:end]
        run = read(part.splitlines(keepends=True))
        assert run.unreadable == 0
        assert run.events == part.count(b"\n") or part.endswith(b"}")
        assert run.cut == bool(part and not part.endswith(b"\n"))
        assert set(run.nodes) <= set(full.nodes)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 400), st.binary(max_size=60)), max_size=8))
def test_garbage_between_the_lines_is_counted_and_does_no_harm(junk):
    rig = Recorded({PickParams: [Script(code="grasp_missed"), Script()]})
    rig.begin(WALK, PICK).run()
    lines = list(rig.written)
    count = 0
    for place, junk_text in junk:
        text = b"#" + junk_text.replace(b"\n", b"?") + b"\n"
        lines.insert(place % (len(lines) + 1), text)
        count += 1
    run = read(lines)
    assert run.unreadable == count
    clean = rig.read()
    run.unreadable = run.unreadable_line = 0
    assert run == clean


HOSTILE = [
    b"[]\n", b"{}\n", b"null\n", b"\xff\xfe\n", b"[" * 50_000 + b"\n", b'{"event":1,"t_s":"x"}\n',
    b'{"n":1,"t_s":1e308,"event":"node","id":3,"status":"running"}\n',
    line("node", id="3", status="running"), line("node", id=3, status="asleep"),
    line("node", id=10**30, status="running"), line("tree", nodes=[[1]]),
    line("tree", nodes=[[0, 7, "x", "y"]]), line("tree", order=[[0, [5]]]), line("tree", nodes=3),
    line("board", value=3), line("failure", step=3), line("health"), line("pose", x_m="far"),
    line("map", furniture=[{"outline_m": 3}]), line("outcome"), line("job", job="one"),
    line("recovery", step="s"), line("phase"),
]  # fmt: skip


def test_events_that_make_no_sense_are_left_out():
    clean = read([line("run", text="go")])
    for bad in HOSTILE:
        run = read([line("run", text="go"), bad])
        assert run.unreadable == 1, bad
        assert run.unreadable_line == 2
        assert (run.nodes, run.troubles, run.path) == (clean.nodes, clean.troubles, clean.path)


def test_unknown_events_are_kept_as_words():
    run = read([line("run", text="go"), line("sneeze", t_s=2.0, loud=True)])
    assert run.unreadable == 0
    assert [entry.text for entry in run.log] == ["asked: go", "sneeze, loud True"]


def test_a_run_that_was_gone_on_with_has_a_second_tree():
    tree = line("tree", nodes=[[0, -1, "sequence", "all"], [1, 0, "skill", "walk"]])
    first = [tree, line("node", t_s=5.0, id=1, status="running")]
    again = [line("run", text="go"), tree, line("node", t_s=1.0, id=1, status="success")]
    run = read([*first, *again])
    assert [node.name for node in run.nodes.values()] == ["all", "walk", "all", "walk"]
    assert run.nodes[1].at(9.0).state == "stopped"
    assert run.nodes[3].at(9.0).state == "done"
    assert run.end_s == 6.0  # time went on


def test_what_comes_round_again_is_not_done_any_more():
    tree = line("tree", nodes=[[0, -1, "repeat", "twice"], [1, 0, "skill", "walk"]])
    events = [(0.0, 0, "running"), (0.0, 1, "running"), (1.0, 1, "success"), (1.0, 0, "success")]
    events += [(2.0, 0, "running"), (2.0, 1, "invalid"), (3.0, 1, "running")]
    run = read([tree, *(line("node", t_s=t, id=i, status=s) for t, i, s in events)])
    assert [run.nodes[1].at(t_s).state for t_s in (0, 1, 2, 3)] == [
        "running", "done", "waiting", "running",
    ]  # fmt: skip


def test_a_run_survives_json():
    rig = Recorded({PickParams: [Script(code="grasp_missed"), Script()]})
    rig.begin(WALK, PICK).run()
    run = rig.read()
    assert msgspec.json.decode(msgspec.json.encode(run), type=Run) == run
