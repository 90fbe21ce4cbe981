"""Which jobs of a prompt that was cut off are gone on with, from its journal."""

from pathlib import Path

from executive.journal.journal import Event
from executive.runs.again.continuation import Left, unfinished


def journal(*kinds: object) -> list[Event]:
    """Events of short words: "submit" (of a new job), "returned", (job, state), or (kind, job)."""
    made: list[Event] = []
    jobs = 0
    for kind in kinds:
        n = len(made)
        number = kind[1] if isinstance(kind, tuple) and kind[0] == "submit" else jobs + 1
        if kind in ("submit", ("submit", number)):
            jobs = max(jobs, number)
            data = {"request": "submit", "job": number, "text": f"at {n}"}
            made.append(Event(n, 0.1 * n, "request", data))
        elif isinstance(kind, tuple) and isinstance(kind[0], str):
            made.append(Event(n, 0.1 * n, kind[0], {"job": kind[1]}))
        elif isinstance(kind, tuple):
            made.append(Event(n, 0.1 * n, "job", {"job": kind[0], "state": kind[1]}))
        else:
            made.append(Event(n, 0.1 * n, str(kind)))
    return made


def open_at(*kinds: object) -> list[int]:
    return [since[0].n for since in unfinished(journal(*kinds))]


def test_nothing_is_open_before_the_first_job_and_after_the_last():
    assert open_at("run") == []
    assert open_at("run", "submit", (1, "running"), (1, "done")) == []


def test_what_ran_and_what_waited_is_open_in_its_order():
    assert open_at("run", "submit", "submit", (1, "running"), "submit") == [1, 2, 4]


def test_every_ending_closes_a_job():
    ends = ("done", "failed", "cancelled")
    jobs = [(number, state) for number, state in enumerate(ends, start=1)]
    assert open_at("run", "submit", "submit", "submit", "submit", *jobs) == [4]


def test_after_a_return_jobs_have_their_numbers_and_their_newest_submission_counts():
    again = ("submit", 2)
    assert open_at("run", "submit", "submit", (1, "done"), "returned", again) == [5]
    assert open_at("run", "submit", "submit", (1, "done"), "returned", again, (2, "done")) == []


def test_a_return_that_was_cut_off_before_it_asked_again_loses_no_job():
    assert open_at("run", "submit", "submit", (1, "done"), "returned") == [2]


def test_numbers_go_on_from_the_highest_there_was():
    jobs = lambda *kinds: Left(folder=Path("there"), events=journal(*kinds)).jobs  # noqa: E731
    assert jobs("run") == 0
    assert jobs("run", "submit", "submit", (2, "done"), "returned", ("submit", 1)) == 2


def test_a_job_that_is_open_brings_all_events_since_its_submission():
    events = journal("run", "submit", (1, "running"), "step", "done")
    assert unfinished(events) == [events[1:]]


def test_what_another_job_did_beside_it_is_not_its_own():
    """Both call their first step "1": one that is done must not be taken for the other."""
    events = journal(
        "run", "submit", (1, "running"), "submit", ("step", 1), ("done", 2), (2, "done"),
        ("held", 2),
    )  # fmt: skip
    (of_first,) = unfinished(events)
    assert [(event.event, event.data.get("job")) for event in of_first] == [
        ("request", 1), ("job", 1), ("step", 1), ("held", 2),
    ]  # fmt: skip
