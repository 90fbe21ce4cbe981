"""A journal of any length makes a run of bounded size; what is left out is counted."""

import json

import msgspec
import pytest

from executive.journal import journal, past_runs, reader, tree_reader
from executive.journal.journal import Event
from executive.journal.keeping import keep_ends, keep_evenly
from executive.journal.reader import Reader
from executive.runs.again import continuation
from robot.errors import ConfigError


def line(n, kind, **data):
    return json.dumps({"n": n, "t_s": n * 0.1, "event": kind, **data}).encode() + b"\n"


def size_of(events):
    told = Reader()
    for number, (kind, data) in enumerate(events):
        told.event(Event(number, number * 0.1, kind, data))
    return len(msgspec.json.encode(told.run)), told.run


def repeated(count):
    """Jobs that come and go, each with a tree, failures, remedies, poses, values and findings."""
    yield "tree", {"nodes": [[0, -1, "parallel", "robot"], [1, 0, "jobs", "jobs"]]}
    for job in range(count):
        first = 2 + 3 * job
        yield "job", {"job": job, "state": "running", "text": f"job {job}"}
        nodes = [[first, 1, "sequence", "task"], [first + 1, first, "skill", "walk"]]
        nodes.append([first + 2, first, "skill", "wave"])
        yield "tree", {"nodes": nodes, "order": [[1, [first]]]}
        for name, number in (("walk", first + 1), ("wave", first + 2)):
            yield "step", {"step": name, "id": str(number)}
            yield "node", {"id": number, "status": "running"}
            yield "failure", {"step": name, "id": str(number), "code": "fallen", "cause": "it fell"}
            yield "node", {"id": number, "status": "failure"}
            yield "recovery", {"step": name, "code": "fallen", "remedy": "get up", "count": 1}
            yield "fault", {"fault": "push"}
            yield (
                "pose",
                {"x_m": 1.0, "y_m": 2.0, "mode": "walk", "objects": {"cup": {"x_m": 1, "y_m": 2}}},
            )
            yield "board", {"key": "held", "value": "x" * 5000}
            yield "health", {"name": f"motor {job % 40}", "level": "WARN", "cause": "hot"}
            yield "pause", {"why": "y" * 5000}
        yield "outcome", {"code": "fallen", "took_s": 3.0}
        yield "tree", {"order": [[1, []]]}


@pytest.fixture
def small_bounds(monkeypatch):
    """The same bounds, hundreds of times smaller."""
    for name in ("MOST_LOGGED", "MOST_CHANGES", "MOST_FINDINGS", "MOST_POSES", "MOST_SIGHTS"):
        monkeypatch.setattr(reader, name, 40)
    for name in ("MOST_JOBS", "MOST_NOTES"):
        monkeypatch.setattr(reader, name, 20)
    monkeypatch.setattr("executive.journal.step_reader.MOST_TROUBLES", 20)
    monkeypatch.setattr("executive.journal.step_reader.MOST_ATTEMPTS", 20)
    monkeypatch.setattr(tree_reader, "MOST_NODES", 60)
    monkeypatch.setattr(tree_reader, "MOST_CHANGES", 200)


@pytest.mark.usefixtures("small_bounds")
def test_a_run_ten_times_as_long_is_held_in_as_much_memory():
    (short, run), (long, longer) = size_of(repeated(60)), size_of(repeated(600))
    assert long < 1.3 * short
    assert longer.left_out > 10 * run.left_out > 0
    assert longer.unreadable == 0
    assert longer.nodes[longer.roots[-1]].name == "robot"
    assert longer.jobs[0].number == 0
    assert longer.jobs[-1].number == 599
    assert longer.task.text == "job 599"


@pytest.mark.usefixtures("small_bounds")
def test_what_is_held_of_a_tree_is_a_tree():
    _, run = size_of(repeated(300))
    for number, node in run.nodes.items():
        assert node.parent < 0 or number in run.nodes[node.parent].children
        assert all(child in run.nodes for child in node.children)
    assert all(trouble.node < 0 or trouble.node in run.nodes for trouble in run.troubles)


@pytest.mark.usefixtures("small_bounds")
def test_a_tree_that_is_too_large_at_once_is_left_out():
    nodes = [[0, -1, "parallel", "robot"], *([k, 0, "skill", "walk"] for k in range(1, 100))]
    _, run = size_of([("tree", {"nodes": nodes})])
    assert run.unreadable == 1
    assert not run.nodes


def test_an_ordinary_run_is_held_whole():
    _, run = size_of(repeated(20))
    assert run.left_out == 0
    assert len(run.nodes) == 62


def test_the_ends_of_a_story_stay():
    kept, gone = [], 0
    for item in range(1000):
        gone += keep_ends(kept, item, 20)
    assert len(kept) <= 20
    assert gone == 1000 - len(kept)
    assert kept[:5] == [0, 1, 2, 3, 4]
    assert kept[-1] == 999
    assert kept == sorted(kept)


def test_a_line_is_thinned_all_along():
    kept, gone = [], 0
    for item in range(1000):
        gone += keep_evenly(kept, item, 20)
    assert len(kept) <= 20
    assert gone == 1000 - len(kept)
    assert (kept[0], kept[-1]) == (0, 999)
    assert kept == sorted(kept)


def test_a_line_without_end_is_read_in_pieces(tmp_path):
    path = tmp_path / "journal.jsonl"
    long = line(1, "said", text="x" * (3 * journal.MAX_LINE))
    path.write_bytes(line(0, "run", text="a") + long + line(2, "said", text="b"))
    assert max(map(len, journal.lines(path))) <= journal.MAX_LINE
    run = reader.read(path)
    assert (run.events, run.unreadable, run.unreadable_line) == (2, 1, 2)


@pytest.mark.parametrize("extra", [-1, 0, 1])
def test_a_line_as_long_as_the_bound(tmp_path, extra):
    path = tmp_path / "journal.jsonl"
    text = "x" * (journal.MAX_LINE - len(line(0, "said", text="")) + extra)
    path.write_bytes(line(0, "said", text=text) + line(1, "said", text="b"))
    assert len(list(journal.lines(path))) == 2
    assert [event.n for event in journal.read(path)] == ([0, 1] if extra <= 0 else [1])


@pytest.mark.parametrize(
    "text",
    [
        b'{"n":0,"t_s":0,"event":"said","text":' + b"[" * 20_000 + b"]" * 20_000 + b"}",
        b'{"n":' + b"9" * 5001 + b',"t_s":0,"event":"said"}',
        b'{"n":0,"t_s":1e999,"event":"said"}',
        b'{"n":0,"t_s":"nan","event":"said"}',
        b'{"n":-1,"t_s":0,"event":"said"}',
        b'{"n":0,"t_s":1e300,"event":"said"}',
        b'{"n":0,"t_s":0,"event":["said"]}',
        b'{"n":null,"t_s":0,"event":"said"}',
        b"{}",
        b"[]",
        b"\xff",
    ],
)
def test_a_line_that_makes_no_sense_is_no_event(text):
    assert journal.decode(text) is None


def test_a_time_that_is_none_costs_its_event_only():
    _, run = size_of([("run", {"text": "a"}), ("outcome", {"code": "done", "took_s": "abc"})])
    assert (run.unreadable, run.events) == (1, 1)


@pytest.mark.parametrize("value", ["abc", None, [], 1e300, True])
def test_an_odd_summary_hides_no_run(tmp_path, value):
    (tmp_path / "journal.jsonl").write_bytes(line(0, "run", text="a"))
    (tmp_path / "run.json").write_text(json.dumps({"seed": value, "text": value}))
    (tmp_path / "summary.json").write_text(json.dumps({"code": "done", "simulated_s": value}))
    past = past_runs.look(tmp_path)
    assert past.ending == "done"
    assert 0.0 <= past.took_s <= 1.0


@pytest.mark.parametrize("text", ["[" * 100_000, "[1]", "", '{"code":', "x" * 2_000_000])
def test_a_summary_that_is_none_is_not_believed(tmp_path, text):
    (tmp_path / "journal.jsonl").write_bytes(line(0, "run", text="a"))
    (tmp_path / "summary.json").write_text(text)
    assert past_runs.look(tmp_path).ending == "cut off"


def test_a_journal_that_is_too_large_is_not_gone_on_with(tmp_path, monkeypatch):
    monkeypatch.setattr(journal, "MAX_BYTES", 100)
    (tmp_path / "journal.jsonl").write_bytes(b"".join(line(n, "said", text="a") for n in range(9)))
    with pytest.raises(ConfigError, match=r"larger than 0.0001 MB \(it can be looked at"):
        continuation.left_in(tmp_path)


def test_what_is_only_drawn_is_not_held_to_go_on_with(tmp_path):
    pose = {"x_m": 0.0, "y_m": 0.0}
    kinds = ["run", "pose", "step", "node", "done", "pose"]
    path = tmp_path / "journal.jsonl"
    path.write_bytes(b"".join(line(n, kind, **pose) for n, kind in enumerate(kinds)))
    left = continuation.left_in(tmp_path)
    assert [event.event for event in left.events] == ["run", "step", "done", "pose"]
    assert left.next_number == 6
