"""Which of the jobs of a queue are meant, and what becomes of them."""

from __future__ import annotations

from collections.abc import Generator

import pytest

from executive.engine.jobs import OVER, Job
from executive.frontends.prompt.naming_jobs import which
from executive.frontends.prompt.shell import Shell
from intents.job_words import Jobs
from tests.fakes.puppet_shell import puppet_shell
from tests.fakes.waiting import eventually

QUEUE = [
    Job(number=number, text=f"job {number}", state="running" if number == 2 else "waiting")
    for number in (2, 3, 5, 6)
]
said: list[str] = []


@pytest.mark.parametrize(
    ("meant", "numbers"),
    [
        (Jobs(places=(2,)), [3]),
        (Jobs(places=(-1,)), [6]),
        (Jobs(places=(9,)), []),
        (Jobs(numbers=(5, 3)), [3, 5]),
        (Jobs(first=2), [2, 3]),
        (Jobs(last=2), [5, 6]),
        (Jobs(next=True), [3]),
        (Jobs(current=True), [2]),
        (Jobs(every=True), [2, 3, 5, 6]),
        (Jobs(others=True), [3, 5, 6]),
        (Jobs(every=True, but=Jobs(places=(1,))), [3, 5, 6]),
        (Jobs(every=True, but=Jobs(numbers=(5,))), [2, 3, 6]),
    ],
)
def test_places_are_counted_among_what_is_to_be_done(meant: Jobs, numbers: list[int]):
    assert [job.number for job in which(meant, QUEUE)[0]] == numbers


def test_a_number_of_none_is_told():
    assert which(Jobs(numbers=(4, 5)), QUEUE)[1] == [4]


@pytest.fixture
def shell(tmp_path) -> Generator[Shell]:
    said.clear()
    with puppet_shell(tmp_path, said) as made:
        yield made
        made.brake.stop("the test is over")


def open_texts(shell: Shell) -> list[str]:
    gave_up = shell.brake.halt.gave_up
    jobs = shell.robot.executive.jobs
    return [job.text for job in jobs if job.state not in OVER and not gave_up(job)]


def test_the_job_that_is_named_ends_and_no_other(shell: Shell):
    for line in ("walk to the shelf", "wave", "nod", "bow"):
        shell.line(line)
    shell.line("cancel the second job")
    assert open_texts(shell) == ["walk to the shelf", "nod", "bow"]
    shell.line("cancel job 4")
    assert open_texts(shell) == ["walk to the shelf", "nod"]
    shell.line("cancel number 7")
    assert said[-2] == "There is no job 7 to be done."
    shell.line("cancel everything but the first")
    assert open_texts(shell) == ["walk to the shelf"]


def test_a_step_is_left_out_of_what_waits_and_not_of_what_has_begun(shell: Shell):
    shell.line("go to the shelf, then nod")
    shell.line("go to the table, then wave, then go to the chair")
    assert eventually(lambda: bool(shell.queue.under_way()))
    shell.line("leave out the wave")
    shell.line("leave the nod out")
    assert open_texts(shell) == [
        "go to the shelf, then nod",
        "go to the table, then go to the chair",
    ]
    assert said[-1].startswith("I leave nothing out of a job that has begun")
    shell.line("skip the bow")
    assert len(open_texts(shell)) == 2
    assert "called “the bow”" in said[-2]
