"""Which jobs of a prompt that was cut off are gone on with, from its journal."""

from executive.journal.journal import Event
from executive.runs.again.continuation import unfinished


def journal(*kinds: object) -> list[Event]:
    """Events of short words: "submit", "returned", (job, state), or (kind, job)."""
    made: list[Event] = []
    for kind in kinds:
        n = len(made)
        if kind == "submit":
            made.append(Event(n, 0.1 * n, "request", {"request": "submit", "text": f"at {n}"}))
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


def test_after_a_return_jobs_are_counted_anew():
    assert open_at("run", "submit", "submit", (1, "done"), "returned", "submit") == [5]
    assert open_at("run", "submit", "returned", "submit", (1, "done")) == []


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
        ("request", None), ("job", 1), ("request", None), ("step", 1), ("held", 2),
    ]  # fmt: skip
