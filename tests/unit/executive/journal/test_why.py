"""The chain from symptom to cause, told from journals of every kind of end."""

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.frontends import progress
from executive.journal import words
from executive.journal.journal import Event
from executive.journal.reader import Reader
from executive.journal.reader import told as run_of
from executive.journal.why import Explanation, why
from executive.journal.why import told as told_of

RUN = ("run", {"text": "pick up the red cup", "runtime": "fast", "world": "kitchen", "seed": 3})
PICK = {"step": "pick up the red cup", "id": "1"}
LOOK = {"step": "look for the red cup", "id": "1+1.1"}
MISSED = {
    "code": "grasp_missed",
    "cause": "the fingers closed on air",
    "evidence": {"gap_m": 0.001},
}


def journal(*entries) -> list[Event]:
    """Events a second apart, or at the time an entry begins with."""
    events, now_s = [], 0.0
    for entry in entries:
        if len(entry) == 3:
            now_s, kind, data = entry
        else:
            kind, data = entry
            now_s += 1.0
        events.append(Event(len(events), now_s, kind, data))
    return events


def explained(events, *, live: bool = False) -> Explanation:
    return why(run_of(events), live=live)


def job(state: str, **data):
    return (
        "job",
        {"job": 1, "text": "pick up the red cup", "state": state, "urgent": False, **data},
    )


FAILS = (
    RUN,
    job("running"),
    (2.0, "step", {**PICK, "attempt": 0}),
    (30.0, "phase", {**PICK, "phase": "closing the left fingers"}),
    (31.0, "failure", {**PICK, **MISSED}),
    ("recovery", {**PICK, "remedy": "look again, then retry", "count": "1 of 2"}),
    ("step", {**LOOK, "attempt": 1}),
    ("done", LOOK),
    ("step", {"step": PICK["step"], "id": "1+1", "attempt": 1}),
)  # fmt: skip


def test_a_failure_is_told_from_the_last_go_back_to_what_began_it():
    events = journal(
        *FAILS[:3],
        (29.0, "fault", {"fault": {"fault": "move", "target": "red_cup"}}),
        *FAILS[3:],
        (60.0, "failure", {"step": PICK["step"], "id": "1+1", **MISSED}),
        ("no recovery", {**PICK, "code": "grasp_missed", "why": "tried 1 times"}),
        job("failed", **MISSED),
        ("outcome", {**MISSED, "took_s": 62.0, "recoveries": 1}),
    )
    told = explained(events)
    assert told.status == "failed"
    assert told.lines == (
        "Failed after 62.0 s: the fingers closed on air (grasp_missed).",
        "Asked for: pick up the red cup  (fast, kitchen, seed 3)",
        'Because "pick up the red cup" failed twice, the last time first:',
        "     60.0 s  the fingers closed on air (grasp_missed: gap 0.001 m)",
        "             then: no recovery: tried 1 times",
        "     31.0 s  the fingers closed on air (grasp_missed: gap 0.001 m)",
        "             while closing the left fingers, for 1.0 s",
        "             then: look again, then retry (1 of 2)",
        "               look for the red cup: done in 1.0 s",
        "What happened around it:",
        "     29.0 s  fault injected: move (target red_cup)",
        "What to do: check where the object is.",
    )


def test_a_success_tells_what_had_to_be_recovered():
    again = {"step": PICK["step"], "id": "1+1"}
    told = explained(
        journal(*FAILS, (50.0, "done", again), job("done"), ("outcome", {"code": "done"}))
    )
    assert told.status == "done"
    assert told.lines[2:] == (
        "On the way:",
        '  "pick up the red cup"',
        "     31.0 s  the fingers closed on air (grasp_missed: gap 0.001 m)",
        "             while closing the left fingers, for 1.0 s",
        "             then: look again, then retry (1 of 2)",
        "               look for the red cup: done in 1.0 s",
        "     50.0 s  done",
    )


def test_a_prompt_at_which_nothing_was_asked_is_no_run_that_was_cut_off():
    told = explained([Event(0, 0.0, "run", {"text": "prompt", "attended": True})])
    assert (told.status, told.text) == ("idle", "Nothing was asked for.")
    assert explained([Event(0, 0.0, "run", {"text": "squat"})]).status == "cut off"


def test_a_run_that_was_killed_tells_where_it_was():
    told = explained(journal(*FAILS[:4]))
    assert told.status == "cut off"
    assert told.verdict == "The journal ends at 30.0 s without an outcome: it was cut off."
    assert 'doing "pick up the red cup" since 2.0 s (28.0 s), closing the left' in told.text
    assert "humanoid resume" in told.text


@pytest.mark.parametrize(("runtime", "said"), [("live", True), ("fast", False)])
def test_logs_are_named_only_where_there_are_processes_that_write_some(runtime, said):
    header = {"text": "squat", "runtime": runtime}
    events = [Event(0, 0.0, "run", header), *journal(*FAILS[:4])[1:]]
    assert ("logs/" in explained(events).text) is said


def test_a_run_under_way_tells_what_it_does_and_its_trouble_so_far():
    told = explained(journal(*FAILS), live=True)
    assert told.status == "going on"
    assert "Trouble so far:" in told.text
    assert 'doing "pick up the red cup" since 35.0 s' in told.text
    assert "resume" not in told.text


def test_a_stop_tells_who_wanted_it_and_how_long_it_took():
    told = explained(
        journal(
            *FAILS[:4],
            (33.0, "stop", {"why": "stopped on request"}),
            (33.0, "stopping", PICK),
            (34.5, "stopped", {**PICK, "took_s": 1.5}),
            (34.5, "step", {"step": "come to a stand", "id": "", "attempt": 0}),
            (34.8, "done", {"step": "come to a stand", "id": ""}),
            (34.8, "outcome", {"code": "cancelled", "cause": "stopped on request", "took_s": 33.8}),
        )
    )
    assert told.status == "stopped"
    assert told.verdict == "Stopped after 33.8 s: stopped on request."
    assert "It came to rest in 1.8 s." in told.lines
    assert "come to a stand" not in told.text
    assert "closing the left fingers, for 3.0 s" in told.text


def test_a_stop_while_it_waited_for_help_tells_for_what_and_what_had_gone_wrong():
    blocked = {**PICK, "code": "goal_in_collision", "cause": "forearm and table overlap"}
    events = (
        *FAILS[:4],
        (32.0, "failure", blocked),
        (32.0, "help", {**PICK, "question": "please make room, then say continue"}),
        (40.0, "stop", {"why": "the operator leaves"}),
        (40.1, "outcome", {"code": "cancelled", "cause": "the operator leaves", "took_s": 39.0}),
    )
    told = explained(journal(*events))
    assert told.status == "stopped"
    assert "It was waiting for a person since 32.0 s" in told.text
    assert "please make room" in told.text
    assert "forearm and table overlap (goal_in_collision)" in told.text
    assert "Nothing was being done" not in told.text
    answered = (*events[:-2], (35.0, "answer", {**PICK, "answer": "continue"}), *events[-2:])
    assert "waiting for a person" not in explained(journal(*answered)).text


def test_a_failure_from_above_tells_what_it_interrupted_and_what_was_measured():
    lost = {
        "code": "localisation_lost",
        "cause": "no fix for 2.0 s",
        "evidence": {"fix_age_s": 2.0},
    }
    told = explained(
        journal(
            *FAILS[:4],
            (31.0, "health", {"name": "localisation", "level": "HOLD", **lost}),
            (31.0, "hold", {"why": "no fix for 2.0 s"}),
            (51.0, "abort", lost),
            (51.0, "stopping", PICK),
            (51.5, "outcome", {**lost, "took_s": 50.5}),
        )
    )
    assert told.lines[0].startswith("Failed after 50.5 s: no fix for 2.0 s (localisation_lost)")
    assert "Measured: fix age 2 s." in told.lines
    assert "     31.0 s  hold: no fix for 2.0 s" in told.lines
    assert "     31.0 s  it stood still: no fix for 2.0 s" in told.lines


def test_of_several_jobs_the_newest_is_explained():
    first = journal(*FAILS, (50.0, "failure", {**PICK, **MISSED}), job("failed", **MISSED))
    second = [
        Event(20, 60.0, "job", {"job": 2, "text": "squat", "state": "running", "urgent": False}),
        Event(21, 60.0, "step", {"step": "squat", "id": "1", "attempt": 0}),
        Event(22, 65.0, "done", {"step": "squat", "id": "1"}),
        Event(23, 65.0, "job", {"job": 2, "text": "squat", "state": "done", "urgent": False}),
    ]
    told = explained([*first, *second])
    assert told.status == "done"
    assert told.text.startswith("Done after 5.0 s.\nAsked for: squat")
    assert "red cup" not in told.text


@pytest.mark.parametrize("only", [None, 2])
def test_a_job_that_failed_before_it_began_is_explained_once_nothing_else_is_done(only):
    def state(number: int, text: str, told: str, **data: object) -> dict[str, object]:
        return {"job": number, "text": text, "state": told, "urgent": False, **data}

    pressed = {"code": "emergency_stop", "cause": "the operator pressed the emergency stop"}
    begun = [(1.0, state(1, "walk", "running")), (2.0, state(2, "wave", "waiting"))]
    refused = (3.0, state(2, "wave", "failed", **pressed))
    reader = Reader(job=only)
    for n, (t_s, data) in enumerate([*begun, (2.5, state(1, "walk", "done")), refused]):
        reader.event(Event(n, t_s, "job", data))
    text = why(reader.run).text
    assert "Asked for: wave" in text and pressed["cause"] in text
    reader = Reader()
    for n, (t_s, data) in enumerate([*begun, refused]):
        reader.event(Event(n, t_s, "job", data))
    assert "Asked for: walk" in why(reader.run, live=True).text


def test_what_was_asked_before_a_job_began_is_none_of_its_own():
    def state(number: int, text: str, told: str) -> dict[str, object]:
        return {"job": number, "text": text, "state": told, "urgent": False}

    reader = Reader(job=2)
    for n, (t_s, kind, data) in enumerate(
        [
            (1.0, "job", state(1, "walk", "running")),
            (5.0, "pause", {"why": "paused on request"}),
            (8.0, "stop", {"why": "the first stop"}),
            (9.0, "job", state(1, "walk", "cancelled")),
            (20.0, "job", state(2, "squat", "running")),
            (28.0, "stop", {"why": "the second stop"}),
            (29.5, "job", state(2, "squat", "cancelled")),
        ]
    ):
        reader.event(Event(n, t_s, kind, data))
    text = why(reader.run).text
    assert "It came to rest in 1.5 s." in text
    assert "the first stop" not in text
    assert "paused" not in text


def test_lost_events_are_told():
    events = journal(*FAILS)
    assert "2 events are missing" in explained([*events[:4], *events[6:]]).text


def test_old_journals_without_ids_and_jobs_are_understood():
    told = explained(
        journal(
            RUN,
            ("step", {"step": "walk"}),
            ("failure", {"step": "walk", "code": "no_path", "cause": "no way"}),
            ("recovery", {"step": "walk", "code": "no_path", "remedy": "wait", "count": "1 of 2"}),
            ("step", {"step": "stand and wait"}),
            ("done", {"step": "stand and wait"}),
            ("step", {"step": "walk"}),
            ("done", {"step": "walk"}),
            ("outcome", {"code": "done", "took_s": 7.0}),
        )
    )
    assert told.lines[2:] == (
        "On the way:",
        '  "walk"',
        "      3.0 s  no way (no_path)",
        "             then: wait (1 of 2)",
        "               stand and wait: done in 1.0 s",
        "      8.0 s  done",
    )


EVENTS = st.builds(
    Event,
    st.integers(0, 50),
    st.floats(0, 100),
    st.sampled_from(
        ["run", "job", "step", "phase", "done", "failure", "recovery", "no recovery", "hold",
         "abort", "stopping", "stopped", "health", "fault", "outcome", "pause", "said", "new"]
    ),
    st.dictionaries(
        st.sampled_from(["step", "id", "code", "cause", "state", "job", "fault", "evidence"]),
        st.sampled_from(["a", "b", "1", "1+1", "done", "failed", "running", 1, {"x_m": 1.0}, None]),
    ),
)  # fmt: skip


@given(st.lists(EVENTS, max_size=30), st.booleans())
def test_no_journal_breaks_it(events, live):
    told = explained(events, live=live)
    assert told.verdict
    assert told.lines[0] == told.verdict


@pytest.mark.parametrize(
    ("measured", "said"),
    [
        ({"gap_m": 0.0012}, "gap 0.0012 m"),
        ({"temperature_c": 81.26}, "temperature 81.3 °C"),
        ({"blocker": "chair", "replans": 3}, "blocker chair, replans 3"),
        ({"m": 2.0}, "m 2"),
        ({"ok": True}, "ok True"),
    ],
)
def test_measurements_are_told_with_their_units(measured, said):
    assert words.evidence(measured) == said


@pytest.mark.parametrize("content", [b"", b"\n\n", b"{", b"what is this\n\xff\xfe\n"])
def test_a_journal_without_an_event_is_told_as_such_and_not_to_be_resumed(tmp_path, content):
    (tmp_path / "journal.jsonl").write_bytes(content)
    told = told_of(tmp_path)
    assert told.status == "unreadable"
    assert "humanoid resume" not in told.text and "humanoid do" in told.text
    unreadable = content.count(b"\n") if content.strip() and b"\n" in content else 0
    assert ("2 lines of the journal cannot be read, from line 1" in told.text) == bool(unreadable)


def cut_off(folder, *damaged: bytes) -> str:
    """What is told of a journal that was cut off, with some lines more in its middle."""
    events = [msgspec.json.encode({"n": one.n, "t_s": one.t_s, "event": one.event, **one.data})
              for one in journal(*FAILS)]  # fmt: skip
    folder.mkdir()
    text = b"\n".join([*events[:3], *damaged, *events[3:]]) + b"\n"
    (folder / "journal.jsonl").write_bytes(text)
    return told_of(folder).text


def test_only_what_can_be_gone_on_with_is_to_be_resumed(tmp_path):
    whole = cut_off(tmp_path / "whole")
    assert "with `humanoid resume`" in whole and "cannot be read" not in whole
    damaged = cut_off(tmp_path / "damaged", b"not json")
    assert "(1 line of the journal cannot be read, from line 4.)" in damaged
    assert "humanoid resume" not in damaged and "humanoid do" in damaged
    linked = tmp_path / "linked"
    linked.mkdir()
    (linked / "journal.jsonl").symlink_to(tmp_path / "whole" / "journal.jsonl")
    assert "in the place of the link, then go on" in told_of(linked).text


def test_of_a_run_in_which_nothing_was_begun_nothing_is_to_be_resumed():
    assert "humanoid resume" not in explained(journal(RUN)).text


WAITS = {"name": "world/state", "level": "HOLD", "cause": "the robot is finding its place"}


@pytest.mark.parametrize("beginning", [True, False])
def test_what_every_run_waits_for_at_its_start_is_no_news(beginning):
    mark = {"beginning": True} if beginning else {}
    events = journal(
        RUN,
        ("health", {**WAITS, **mark}),
        ("hold", {"why": WAITS["cause"], **mark}),
        job("running"),
        ("health", {"name": "world/state", "level": "OK", **mark}),
        ("step", {**PICK, "attempt": 0}),
        ("done", PICK),
        job("done"),
        ("outcome", {"code": "done", "took_s": 3.0}),
    )
    text = explained(events).text
    assert ("finding its place" in text) is not beginning
    assert ("Besides:" in text) is not beginning
    assert "world/state is well" not in text or not beginning
    shown = [progress.sentence(event) for event in events]
    assert any("finding its place" in line for line in shown) is not beginning
