"""What is made again from the journal of a run that was cut off, to be gone on with."""

import math
from pathlib import Path

import pytest

from executive.engine.jobs import Limits
from executive.engine.loop import Interrupts
from executive.journal.why import told
from executive.meaning.request import Understood, request
from executive.runs.again.continuation import Left, left_in, return_to
from executive.runs.runtimes import Opened, Setup
from executive.runs.session import Session
from tests.fakes.puppet_runtime import PuppetRuntime
from tests.fakes.worlds import WHERE, puppet


@pytest.fixture
def session(tmp_path: Path):
    runtime = PuppetRuntime(puppet())
    setup = Setup(where=WHERE, folder=tmp_path)
    with Session(setup, Opened(runtime, runtime.planner), interrupts=Interrupts()) as made:
        made.begin("a test")
        yield made


def left(session: Session) -> Left:
    session.run(until=lambda: session.now_s > 0.2)
    assert session.setup.folder is not None
    return left_in(session.setup.folder)


def understood(text: str = "say hello, then go to the table") -> Understood:
    found = request(text, WHERE)
    assert isinstance(found, Understood), found
    return found


def test_it_has_the_limits_and_the_steps_left_out_that_it_was_begun_with(session: Session):
    limits = Limits(speed_m_s=0.2)
    session.submit(understood(), limits=limits, done=frozenset({"1/"}))
    found = left(session).newest(WHERE)
    assert found is not None
    assert found.limits == limits
    assert found.done == {"1/"}
    assert found.understood.task == understood().task
    assert "done" not in (found.origin or {})


def test_limits_that_were_not_set_are_none(session: Session):
    session.submit(understood())
    found = left(session).newest(WHERE)
    assert found is not None
    assert (found.limits.speed_m_s, found.limits.duration_s) == (math.inf, math.inf)


def test_where_nothing_was_asked_for_nothing_is_left_to_do(session: Session, tmp_path: Path):
    assert left(session).newest(WHERE) is None
    assert left_in(tmp_path / "nowhere") == Left(folder=tmp_path / "nowhere", events=[])
    assert left_in(tmp_path / "nowhere").next_number == 0


def test_an_executive_that_follows_another_one_goes_on_with_the_numbers_of_jobs(session: Session):
    session.submit(understood("say hello"))
    session.run()
    session.submit(understood("go to the table"))
    found = left(session)
    session.replace_executive(jobs_before=found.jobs)
    return_to(session, found)
    assert session.submit(understood("say goodbye")) == 3
    session.run()
    assert {job.number: job.text for job in session.executive.jobs} == {
        2: "go to the table", 3: "say goodbye",
    }  # fmt: skip
    assert session.setup.folder is not None
    for number, text in enumerate(("say hello", "go to the table", "say goodbye"), start=1):
        why = told(session.setup.folder, job=number).text
        assert f"Asked for: {text}" in why
        assert why.startswith("Done")


def test_the_jobs_that_are_over_are_told_by_the_one_that_takes_over(session: Session):
    session.submit(understood("say hello"))
    session.run()
    session.submit(understood("go to the table"))
    assert left(session).ended == ((1, "done", "say hello"),)
