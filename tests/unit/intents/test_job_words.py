"""Which of several jobs somebody speaks of: by number, by place, by what they are to do."""

import pytest

from intents.job_words import Jobs, jobs_to_end, step_to_leave_out
from intents.outcomes import Goals, Refusal
from intents.parser import parse
from intents.vocabulary import Thing, Vocabulary

HOME = Vocabulary.of(
    objects=[Thing(name="cup", color="red"), Thing(name="bottle")], places=["table", "doorway"]
)


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("cancel the second job", Jobs(places=(2,))),
        ("cancel the second one", Jobs(places=(2,))),
        ("drop the 3rd task", Jobs(places=(3,))),
        ("no, cancel the last job, please", Jobs(places=(-1,))),
        ("cancel the second and the fourth job", Jobs(places=(2, 4))),
        ("cancel job 4", Jobs(numbers=(4,))),
        ("Cancel number five.", Jobs(numbers=(5,))),
        ("abort jobs 2, 3 and 7", Jobs(numbers=(2, 3, 7))),
        ("cancel 2 and 3", Jobs(numbers=(2, 3))),
        ("remove jobs 2 to 4 from the queue", Jobs(numbers=(2, 3, 4))),
        ("cancel the first two jobs", Jobs(first=2)),
        ("could you cancel the last two", Jobs(last=2)),
        ("skip the next job", Jobs(next=True)),
        ("cancel the current job", Jobs(current=True)),
        ("cancel everything", Jobs(every=True)),
        ("cancel all jobs", Jobs(every=True)),
        ("cancel everything else", Jobs(others=True)),
        ("clear the queue", Jobs(others=True)),
        ("cancel everything but the first", Jobs(every=True, but=Jobs(places=(1,)))),
        ("cancel all except job 3", Jobs(every=True, but=Jobs(numbers=(3,)))),
    ],
)
def test_jobs_are_told_by_number_and_by_place(said: str, meant: Jobs) -> None:
    assert jobs_to_end(said) == meant


@pytest.mark.parametrize(
    "said",
    ["cancel it", "cancel the task", "drop the second cup", "drop the second one",
     "forget the rest", "clear the table", "skip the wave", "bring me the second cup",
     "end at the table", "x" * 1000],
)  # fmt: skip
def test_what_may_be_about_things_is_about_no_job(said: str) -> None:
    assert jobs_to_end(said) is None


@pytest.mark.parametrize(
    ("said", "what"),
    [
        ("leave out the wave", "the wave"),
        ("leave the wave out please", "the wave"),
        ("leave out the wave of job 4", "the wave"),
        ("skip the wave", "the wave"),
        ("don't wave", "wave"),
        ("you needn't go to the table", "go to the table"),
        ("leave that out", "that"),
    ],
)
def test_it_is_told_what_is_to_be_left_out(said: str, what: str) -> None:
    step = step_to_leave_out(said)
    assert step is not None and step.what == what


@pytest.mark.parametrize("said", ["don't drop it", "not the cup, the bottle", "leave the table"])
def test_warnings_and_corrections_leave_nothing_out(said: str) -> None:
    assert step_to_leave_out(said) is None


@pytest.mark.parametrize(
    "said", ["leave out the wave", "leave the wave out", "cancel the second job", "cancel job 4",
             "leave out the cup", "cancel everything but the first"],
)  # fmt: skip
def test_without_a_queue_nothing_else_comes_of_it(said: str) -> None:
    assert isinstance(parse(said, HOME), Refusal)


def test_to_leave_the_house_is_still_to_go() -> None:
    assert isinstance(parse("leave the apartment", HOME), Goals)
    assert isinstance(parse("cancel everything", HOME), Goals)
