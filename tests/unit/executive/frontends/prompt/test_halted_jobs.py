"""What is said to a robot that halts for it: of the job that it was at, in the order it happens."""

from __future__ import annotations

from collections.abc import Generator

import pytest

from executive.engine.jobs import OVER
from executive.frontends.prompt.shell import Shell
from executive.frontends.since_boot import now_s
from executive.journal.words import sentence
from tests.fakes.puppet_shell import puppet_shell
from tests.fakes.waiting import eventually

said: list[str] = []


@pytest.fixture
def shell(tmp_path) -> Generator[Shell]:
    said.clear()
    with puppet_shell(tmp_path, said) as made:
        yield made
        made.brake.stop("the test is over")


def walks(shell: Shell) -> bool:
    return shell.robot.session.runtime.link.body().mode == "walk"


def begin(shell: Shell, *lines: str) -> None:
    for line in lines:
        shell.line(line)
    assert eventually(lambda: walks(shell))


def open_jobs(shell: Shell) -> list[str]:
    given_up = shell.brake.halt.gave_up
    return [
        job.text
        for job in shell.robot.executive.jobs
        if job.state not in OVER and not given_up(job)
    ]


def last_words(shell: Shell) -> list[str]:
    return [text.rsplit(" ", 1)[-1] for text in open_jobs(shell)]


def test_a_correction_is_of_the_job_that_was_halted_also_with_others_after_it(shell: Shell):
    begin(shell, "walk to the shelf", "wave")
    shell.line("no, to the table")
    assert "Instead of “walk to the shelf”." in said
    left = open_jobs(shell)
    assert "walk to the shelf" not in left
    assert "wave" in left
    assert any("table" in text for text in left)


def test_a_correction_that_fits_nothing_is_named(shell: Shell):
    begin(shell, "walk to the shelf", "wave")
    shell.line("no, to the plumbus")
    assert any("plumbus" in one for one in said)
    assert "walk to the shelf" in open_jobs(shell)


def test_halting_is_said_before_it_is_asked_whether_to_go_on(shell: Shell):
    begin(shell, "walk to the shelf")
    shell.halt_at_once("wait")  # heard before the line is one
    shell.line("where are you?")  # whose end asks already
    shell.line("wait")
    told = [one for one in said if one == "Halting." or one.startswith("Shall I go on")]
    assert told[0] == "Halting."
    assert told.count("Halting.") == 1


@pytest.mark.parametrize("text", ["abort", "never mind", "cancel that"])
def test_who_calls_a_job_off_while_it_walks_is_not_told_that_it_goes_on(shell: Shell, text: str):
    told: list[str] = []
    shell.robot.session.journal.listen(lambda event: told.append(sentence(event.event, event.data)))
    begin(shell, "walk to the shelf")
    shell.line(text)
    assert eventually(lambda: not open_jobs(shell) and any("cancelled" in one for one in told))
    assert not any("going on" in one for one in told)


def test_who_calls_one_of_two_jobs_off_is_told_that_it_goes_on_with_the_other(shell: Shell):
    told: list[str] = []
    shell.robot.session.journal.listen(lambda event: told.append(sentence(event.event, event.data)))
    begin(shell, "walk to the shelf", "wave")
    shell.line("wait")
    shell.line("yes")
    assert eventually(lambda: any(one == "going on" for one in told))


def test_every_line_that_is_asked_back_about_counts_also_in_the_same_words(shell: Shell):
    for count, text in enumerate(("pick up the cup", "banana", "banana"), start=1):
        shell.line(text)
        assert shell.asked_back == count


def test_nothing_is_let_go_where_nothing_is_held(shell: Shell):
    shell.line("break off")
    assert said[-1] == "No step is held any more."


def test_what_is_asked_instead_after_a_halt_has_the_place_of_what_was_halted(shell: Shell):
    begin(shell, "walk to the shelf", "squat for 3 seconds", "walk to the doorway")
    shell.line("wait")
    shell.line("put the cup on the counter")  # asks which
    shell.line("the blue one")
    assert "Instead of “walk to the shelf”." in said
    assert not any(one.startswith(("Still open", "Queued as 4")) for one in said)
    assert eventually(lambda: last_words(shell) == ["counter", "seconds", "doorway"])
    assert shell.dialogue.question is None


def test_what_is_agreed_to_after_a_halt_has_the_place_of_what_was_halted(shell: Shell):
    begin(shell, "walk to the shelf", "squat for 3 seconds", "walk to the doorway")
    shell.line("hold it")
    shell.line("go to the cabinet but stop if I clap")  # is asked about
    assert said[-1].endswith("Shall I just go to the cabinet?")
    shell.line("yes")
    assert not any(one.startswith("Still open") for one in said)
    assert "Instead of “walk to the shelf”." in said
    assert eventually(lambda: last_words(shell) == ["cabinet", "seconds", "doorway"])


def test_what_waits_after_a_job_that_was_given_up_is_not_ended_by_what_comes_before_it(
    shell: Shell,
):
    begin(shell, "walk to the shelf", "squat for 3 seconds", "walk to the doorway")
    shell.line("wait")
    shell.line("no")
    assert eventually(lambda: len(open_jobs(shell)) == 2)
    shell.line("go to the cabinet")
    assert eventually(lambda: last_words(shell) == ["cabinet", "seconds", "doorway"])


def test_a_correction_of_the_job_under_way_has_its_place(shell: Shell):
    begin(shell, "walk to the shelf", "squat for 3 seconds", "wave")
    shell.line("no, to the table")
    assert eventually(lambda: last_words(shell) == ["table", "seconds", "wave"])


def test_what_comes_first_after_a_halt_comes_first(shell: Shell):
    begin(shell, "walk to the shelf", "squat for 3 seconds")
    shell.line("hold on, go to the cabinet first")
    first = next(job for job in shell.robot.executive.jobs if "cabinet" in job.text)
    assert first.urgent
    assert "walk to the shelf" in open_jobs(shell)


@pytest.mark.parametrize(
    ("line", "reason"),
    [("wait", "because you called out"), ("pause", "paused on request"),
     ("estop", "The emergency stop is on")],
)  # fmt: skip
def test_why_it_stands_is_told_while_it_does(shell: Shell, line: str, reason: str):
    shell.line("wave")
    assert eventually(lambda: not open_jobs(shell))
    begin(shell, "walk to the shelf")
    shell.line(line)
    assert eventually(lambda: not walks(shell))
    said.clear()
    shell.line("why did you stop?")
    assert reason in said[0]
    shell.line("estop release")
    shell.line("estop reset")


QUESTIONS = [
    "are you certain?",
    "what are you looking for?",
    "where is the bottle?",
    "how many cups are on the table?",
    "do you see Anna?",
    "is the doorway open?",
]
"""Small ones, of which the robot would ask back about some, and go to see for others."""


@pytest.mark.parametrize("asked", QUESTIONS)
def test_a_yes_after_a_small_question_goes_on_with_what_was_halted(shell: Shell, asked: str):
    begin(shell, "walk to the shelf")
    shell.line("wait")
    shell.line(asked)
    assert said[-1] == "Still open: Shall I go on with “walk to the shelf”?"
    assert not any(one.startswith("Instead") or "Shall I just" in one for one in said)
    shell.line("yes")
    assert not shell.brake.halt.on
    assert open_jobs(shell) == ["walk to the shelf"]


@pytest.mark.parametrize("asked", QUESTIONS)
def test_a_correction_after_a_small_question_is_of_what_was_halted(shell: Shell, asked: str):
    begin(shell, "walk to the shelf")
    shell.line("wait")
    shell.line(asked)
    shell.line("no, the table")
    assert "Instead of “walk to the shelf”." in said
    assert eventually(lambda: last_words(shell) == ["table"])


def test_what_is_asked_beside_a_choice_is_no_choice(shell: Shell):
    shell.line("put the cup on the counter")
    shell.line("are you certain?")
    assert said[-1].endswith("Which cup, the red one or the blue one?")
    shell.line("the red one")
    assert open_jobs(shell) == ["put the red cup on the counter"]


def test_what_is_urgent_is_what_is_under_way(shell: Shell):
    begin(shell, "go to the cabinet")  # so that it is interrupted, and does not only wait
    shell.line("now go to the counter")
    assert eventually(lambda: shell.robot.executive.jobs[0].text == "go to the counter")
    assert eventually(lambda: shell.robot.view.goal == "go to the counter")
    shell.line("resume")
    assert said[-1] == "Nothing is paused: “go to the counter” is under way."
    shell.line("what are you doing?")
    assert "counter" in said[-1]
    assert "cabinet" not in said[-1]
    shell.line("wait")
    assert said[-1].startswith("Shall I go on with “go to the counter” and 1 more?")
    shell.line("yes")
    shell.line("cancel")
    assert eventually(lambda: open_jobs(shell) == ["go to the cabinet"])


def test_what_was_just_asked_for_now_is_what_is_cancelled(shell: Shell):
    begin(shell, "go to the cabinet")
    shell.line("now go to the counter")
    shell.line("now go to the shelf")
    shell.line("cancel")
    assert eventually(lambda: last_words(shell) == ["counter", "cabinet"])


@pytest.mark.parametrize("text", ["not the red cup, the blue one", "the blue cup, not the red one"])
def test_a_job_that_waits_is_corrected_by_the_name_of_what_it_is_about(shell: Shell, text: str):
    begin(shell, "walk to the shelf", "bring me the red cup", "wave")
    shell.line(text)
    assert "Instead of “bring me the red cup”." in said
    shell.line("yes")
    assert eventually(
        lambda: open_jobs(shell) == ["walk to the shelf", "bring the blue cup to you", "wave"]
    )


def test_a_job_that_waits_is_corrected_where_the_last_one_cannot_be_meant(shell: Shell):
    begin(shell, "walk to the shelf", "bring me the red cup", "wave")
    shell.line("no, the blue one")
    assert "Instead of “bring me the red cup”." in said
    assert "walk to the shelf" in open_jobs(shell)


def test_what_is_answered_corrects_what_was_asked_about(shell: Shell):
    begin(shell, "walk to the shelf", "bring me the bottle", "wave")
    shell.line("not the bottle, the cup")
    shell.line("the blue one")
    assert "Instead of “bring me the bottle”." in said
    assert "bring me the bottle" not in open_jobs(shell)
    assert "wave" in open_jobs(shell)


def test_what_is_remarked_on_is_told_once(shell: Shell):
    shell.line("nod quickly")
    assert said[0] == "  I move at my own pace: “quickly” changes nothing."
    assert sum("I move at my own pace" in one for one in said) == 1


def test_it_is_known_how_often_there_had_been_a_stop_at_any_time(shell: Shell):
    first_s = now_s()
    shell.stop("one")
    second_s = now_s()
    shell.brake.press()
    assert [shell.stops_by(at_s) for at_s in (first_s, second_s, now_s(), None)] == [0, 1, 2, 2]
    shell.line("walk to the shelf", stops=shell.stops_by(second_s))
    assert not open_jobs(shell)


def test_a_fault_that_there_is_not_is_refused_with_an_example(shell: Shell):
    shell.line("inject push impulse_n_s=70")
    assert said[-1].strip().startswith("For example: inject ")
    assert shell.refused == 1
