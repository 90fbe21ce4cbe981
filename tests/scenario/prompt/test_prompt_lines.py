"""Lines of all kinds, given to a robot in the fast runtime."""

import re
from pathlib import Path

import pytest

from executive.frontends.prompt.cli import words
from executive.frontends.prompt.plain import work_off
from executive.frontends.prompt.shell import Shell
from executive.frontends.speaking import Speech
from executive.journal.journal import read
from executive.meaning import request
from executive.skills.catalogue import SKILLS
from tests.fakes.fast_shell import shell_in
from tests.fakes.voices import Loudspeaker
from tests.fakes.waiting import eventually


def test_a_sentence_is_done(shell: Shell):
    shell.line("say good morning")
    shell.robot.wait()
    job = shell.robot.executive.jobs[-1]
    assert (job.text, job.state) == ("say good morning", "done")


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("bring the moon to the table", "Not understood"),
        ("asdf qwer", "Not understood"),
        ("pick up the cup", "Which"),
        ("goals drop 99", "there is no job 99"),
        ("goals drop x", "no job's number"),
        ("goals move 1 0", "there is no waiting job 1"),
        ("cancel 99", "there is no job 99"),
        ("cancel", "Nothing is under way"),
        ("inject meteor", "unknown fault"),
        ("run nowhere.yaml", "nowhere.yaml"),
        ("save mission", "save it where?"),
    ],
)
def test_what_cannot_be_meant_is_said_and_nothing_moves(shell: Shell, line: str, words: str):
    before = len(shell.robot.executive.jobs)
    shell.line(line)
    assert words in shell.out.text
    assert len(shell.robot.executive.jobs) == before


@pytest.mark.parametrize(
    "line",
    [
        "run to the table",
        "step back half a metre",
        "watch the table",
        "help me",
        "status quo",
        "history of the world",
    ],
)
def test_a_sentence_that_begins_like_a_command_is_a_sentence(shell: Shell, line: str):
    first, _, rest = line.partition(" ")
    assert not shell.commands[first].accepts(rest)


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("run nope", "there is no mission 'nope'"),
        ("run brng", "did you mean 'bring'?"),
        ("help foo", "there is no command 'foo' (valid: break, cancel,"),
        ("help canccel", "did you mean 'cancel'?"),
        ("watch batery", "there is no key 'batery'"),
        ("tree of", "did you mean 'off'?"),
        ("cancel foo", "Use: cancel [N]"),
        ("step 2", "Use: step"),
    ],
)
def test_a_command_with_what_it_does_not_take_says_what_it_takes(
    shell: Shell, line: str, says: str
):
    shell.line(line)
    assert says in shell.out.text
    assert shell.dialogue.question is None


def test_a_breakpoint_that_holds_nothing_is_told(shell: Shell):
    shell.line("break plaice*")
    assert "No step" not in shell.out.text  # nobody knows yet what will be asked
    shell.line("say hello")
    assert "No breakpoint (plaice*) holds a step of it: say hello." in shell.out.text
    shell.line("break off")
    shell.robot.wait()
    shell.line("walk 1 metre back")
    shell.out.clear()
    shell.line("break say*")
    assert "No step of what is to be done is called so: walk 1 m back" in shell.out.text
    shell.line("break walk*")
    assert shell.out[-1].startswith("Holding before walk*")
    shell.line("break off")
    shell.line("stop")
    shell.robot.wait()


def test_every_command_explains_itself(shell: Shell):
    shell.line("help")
    for command in shell.commands.values():
        assert command.usage in shell.out.text
        assert command.usage.startswith(command.name)
        assert not command.summary.endswith(".")
        shell.line(f"help {command.name}")
    shell.line("help skills")
    assert all(skill.summary in shell.out.text for skill in SKILLS)


def test_a_question_is_open_until_it_is_answered(shell: Shell):
    shell.line("look at the cup")
    assert "Which cup" in shell.out.text
    shell.line("the blue one")
    assert shell.robot.executive.jobs[-1].text == "look at the blue cup"
    shell.line("stop")
    shell.robot.wait()
    assert shell.robot.executive.jobs[-1].state == "cancelled"


def test_a_question_that_is_dropped_is_told_as_no_question(shell: Shell):
    shell.line("pick up the cup")
    asked = shell.dialogue.question
    assert asked is not None
    shell.line("say hello")
    shell.robot.wait()
    assert f"Dropped, and nothing is done about it: “{asked.question}”" in shell.out
    assert shell.dialogue.question is None


def test_two_open_questions_are_both_answered(shell: Shell):
    shell.line("look at the cup")
    shell.line("where are you?")
    assert "Still open" in shell.out[-1]
    shell.line("pick up the cup")
    before = len(shell.robot.executive.jobs)
    shell.line("the red one")
    assert any("“look at the cup”" in said for said in shell.out)
    shell.line("the blue one")
    texts = [job.text for job in shell.robot.executive.jobs[-2:]]
    assert len(shell.robot.executive.jobs) == before + 2
    assert texts[0].startswith("pick up the red cup")
    assert texts[1] == "look at the blue cup"
    shell.line("stop")
    shell.robot.wait()


@pytest.mark.rest
def test_counting_waits_for_the_walk_before_it(shell: Shell):
    shell.line("walk half a metre forward")
    shell.line("count the cups")
    assert eventually(shell.queue.under_way)
    assert eventually(lambda: shell.robot.view.goal == "walk half a metre forward")
    shell.line("why")
    assert "Asked for: walk half a metre forward" in shell.out.text
    shell.robot.wait()
    walk, count = shell.robot.executive.jobs[-2:]
    assert count.began_s is not None
    assert walk.began_s is not None
    assert walk.took_s is not None
    assert count.began_s >= walk.began_s + walk.took_s


def test_a_job_is_moved_to_a_place_that_is_named(shell: Shell):
    before = len(shell.out.text)
    shell.line("goals move 1")
    assert "goals move 3 1" in shell.out.text[before:]
    for line in ("walk 0.3 metres back", "squat for 1 second", "wave"):
        shell.line(line)
    last = shell.robot.executive.jobs[-1].number
    shell.line(f"goals move {last} 0")
    assert f"Job {last} waits at place 0" in shell.out.text
    shell.line("stop")
    shell.robot.wait()


def test_words_after_a_wait_are_said_after_it(shell: Shell):
    shell.line("wait 2 seconds")
    shell.line("say hello")
    shell.robot.wait()
    wait, say = shell.robot.executive.jobs[-2:]
    assert wait.took_s is not None and say.began_s is not None
    assert say.began_s >= (wait.began_s or 0.0) + wait.took_s


def test_why_names_the_job_that_is_meant_and_not_the_one_that_spoke_beside_it(shell: Shell):
    shell.line("walk 0.3 metres back")
    shell.line("say hello")
    shell.robot.wait()
    first, _ = sorted(job.number for job in shell.robot.executive.jobs[-2:])
    shell.line("why")
    assert "Asked for: walk 0.3 metres back" in shell.out.text
    shell.line(f"why {first + 1}")
    assert "Asked for: say hello" in shell.out.text


@pytest.mark.parametrize("line", ["move 3 1", "drop 2", "cancle 2"])
def test_a_mistyped_command_moves_nothing(shell: Shell, line: str):
    before = len(shell.robot.executive.jobs)
    shell.line(line)
    assert "Did you mean" in shell.out.text
    assert len(shell.robot.executive.jobs) == before


def test_a_yes_to_the_command_that_was_meant_runs_it_and_a_no_nothing(shell: Shell):
    shell.line("cancle 99")
    shell.line("no thanks")
    assert "no job 99" not in shell.out.text
    shell.line("cancle 99")
    shell.line("yes")
    assert "no job 99" in shell.out.text
    shell.line("yes")
    assert shell.out.text.count("no job 99") == 1


def test_a_line_from_before_a_stop_comes_to_nothing(shell: Shell):
    typed = shell.brake.stops
    shell.line("stop")
    before = len(shell.robot.executive.jobs)
    shell.line("squat for 5 seconds", stops=typed)
    assert "when you said stop" in shell.out.text
    assert len(shell.robot.executive.jobs) == before


@pytest.mark.parametrize(
    "line",
    ["where am I?", "how much longer?", "what time is left", "how far is it", "are you done yet",
     "when will you be done", "how long will it take", "are we there yet"],
)  # fmt: skip
def test_how_far_it_is_can_be_asked(shell: Shell, line: str):
    shell.line("wait 20 seconds")
    shell.out.clear()
    shell.line(line)
    assert shell.out
    assert "Not understood" not in shell.out.text
    shell.line("stop")
    shell.robot.wait()


def test_what_is_suggested_can_be_done(shell: Shell):
    shell.line("what can you do?")
    examples = re.findall(r"“([^”]+)”", shell.out[-1])[:-1]
    assert examples
    for example in examples:
        assert isinstance(request.request(example, shell.robot.where), request.Understood), example


def test_questions_about_the_robot_are_answered_without_a_job(shell: Shell):
    before = len(shell.robot.executive.jobs)
    for line in (
        "what are you holding?",
        "where are you?",
        "what can you do?",
        "why did you stop?",
    ):
        shell.out.clear()
        shell.line(line)
        assert shell.out
    assert len(shell.robot.executive.jobs) == before


def test_the_queue_can_be_reordered_and_cut(shell: Shell):
    executive = shell.robot.executive
    executive.break_at("*")
    first = len(executive.jobs)
    for seconds in (31, 32, 33):
        shell.line(f"squat for {seconds} seconds")
    one, two, three = (job.number for job in executive.jobs[first:])
    assert eventually(lambda: executive.held)
    shell.line(f"goals move {three} 0")
    assert eventually(lambda: [job.number for job in executive.jobs][-3:] == [one, three, two])
    shell.line(f"goals drop {two}")
    state_of = lambda number: next(j.state for j in executive.jobs if j.number == number)  # noqa: E731
    assert eventually(lambda: state_of(two) == "cancelled")
    shell.line("goals")
    assert "squat for 33 seconds" in shell.out.text
    shell.line("break off")
    shell.line("stop")
    shell.robot.wait()
    assert {state_of(one), state_of(three)} == {"cancelled"}


def test_why_and_status_and_history_tell_of_the_run(shell: Shell):
    shell.line("say hello")
    shell.robot.wait()
    for line in ("why", "status", "history", "tree"):
        shell.out.clear()
        shell.line(line)
        assert shell.out.text
    assert "say hello" in shell.out.text


def test_an_emergency_stop_stays_until_it_is_released_and_reset(shell: Shell):
    shell.line("squat for 30 seconds")
    shell.line("estop")
    shell.robot.wait()
    assert shell.robot.executive.jobs[-1].state in ("failed", "cancelled")
    shell.line("estop reset")
    assert "still pressed" in shell.out.text
    shell.line("estop release")
    shell.line("estop reset")
    shell.line("squat for one second")
    shell.robot.wait()
    assert shell.robot.executive.jobs[-1].state == "done"


def test_what_is_asked_of_a_paused_robot_is_told_to_wait(shell: Shell):
    shell.line("squat for 30 seconds")
    assert eventually(lambda: bool(shell.queue.under_way()))
    shell.line("pause")
    shell.line("cancel")
    assert eventually(lambda: not shell.queue.under_way())
    shell.line("squat for one second")
    assert "paused: `resume` lets it begin" in shell.out.text
    shell.line("resume")
    shell.robot.wait()
    assert shell.robot.executive.jobs[-1].state == "done"


def test_a_mission_is_one_job(shell: Shell, tmp_path: Path):
    path = tmp_path / "words.yaml"
    path.write_text(
        "name: two words\nparameters: {word: {type: text, default: one}}\n"
        'steps: [{say: "{{word}}"}, {say: two}]\n'
    )
    shell.line(f"run {path} word=eleven")
    shell.robot.wait()
    job = shell.robot.executive.jobs[-1]
    assert (job.text, job.state) == ("two words", "done")
    said = [event.data["text"] for event in read(shell.folder) if event.event == "said"]
    assert said[-2:] == ["eleven", "two"]


def test_leaving_in_mid_work_stops_first(tmp_path: Path):
    with shell_in(tmp_path, "empty") as shell:
        shell.line("walk one metre forward")
        assert eventually(lambda: shell.robot.view.mode == "walk")
    job = shell.robot.executive.jobs[-1]
    assert job.state == "cancelled"
    assert shell.robot.view.mode == "stand"


def test_what_was_done_is_kept_as_a_mission(shell: Shell, tmp_path: Path):
    shell.line("say good evening")
    shell.robot.wait()
    shell.line("look at the cup")
    shell.line("the red one")
    shell.line("stop")
    shell.robot.wait()
    path = tmp_path / "evening.yaml"
    shell.line(f"save mission {path}")
    text = path.read_text()
    assert "name: evening" in text
    assert "- say good evening" in text
    assert "the red one" not in text  # it was stopped, and says nothing by itself
    shell.line(f"save mission {path}")
    assert "is there already" in shell.out.text
    shell.line("save mission /nowhere/at/all.yaml")
    assert "cannot be written" in shell.out.text


def test_where_nothing_was_done_there_is_nothing_to_save(tmp_path: Path):
    with shell_in(tmp_path, "empty") as shell:
        shell.line(f"save mission {tmp_path / 'morning.yaml'}")
        assert "nothing was done yet" in shell.out.text


@pytest.mark.parametrize("line", ["resume", "continue", "carry on"])
def test_who_goes_on_where_nothing_is_paused_is_told_so(shell: Shell, line: str):
    shell.line("say hello")
    shell.robot.wait()
    shell.line(line)
    assert "Nothing is paused, and nothing is to be done." in shell.out.text
    assert "say hello" in shell.out.text
    shell.line("squat for 20 seconds")
    assert eventually(shell.queue.under_way)
    shell.line(line)
    assert "Nothing is paused: “squat for 20 seconds” is under way." in shell.out.text
    shell.out.clear()
    shell.line("pause")
    shell.line(line)  # at once, before the pause was carried out
    assert "Nothing is paused" not in shell.out.text
    shell.line("stop")
    shell.robot.wait()


def test_left_and_right_are_as_the_robot_sees_them(shell: Shell):
    """Two cups on one table, looked at from one place: each line means another one."""
    shell.line("go to the table, then look at the blue cup")  # from where it sees both
    shell.robot.wait()
    before = len(shell.robot.executive.jobs)
    for line in ("look at the leftmost cup", "look at the rightmost cup"):
        shell.line(line)
        shell.robot.wait()
    jobs = shell.robot.executive.jobs[before:]
    assert [job.state for job in jobs] == ["done", "done"], shell.out
    steps = [
        event.data.get("step", "") for event in read(shell.folder / "journal.jsonl")
        if event.event == "step" and "cup" in event.data.get("step", "")
    ]  # fmt: skip
    assert set(steps[-2:]) == {"look at the red cup", "look at the blue cup"}, steps


def test_answers_are_said_aloud_what_commands_show_is_not(shell: Shell):
    voice = Loudspeaker()
    shell.speech = Speech(voice)
    try:
        for line in ("what are you holding?", "status", "help", "blah blah", "pick up the cup"):
            shell.line(line)
        holding, refused, asked = voice.told
        assert holding == "I am not holding anything."
        assert refused.startswith("Not understood:")
        assert asked.startswith("Which cup")
        shell.line("stop")
        assert voice.told[-1] == "(hush)"
    finally:
        shell.speech = Speech()


def test_a_robot_that_is_gone_is_said_to_be_and_takes_no_more_jobs(tmp_path: Path):
    with shell_in(tmp_path) as shell:
        work_off(shell, ["inject kill process=controller", "squat for 1 second"] * 4)
        assert shell.out[-1] == shell.gone != ""
        assert shell.robot.lost is not None
        assert shell.robot.lost.cause in shell.gone
        assert eventually(lambda: shell.robot.view.mode == "gone")
        before = len(shell.robot.executive.jobs)
        shell.out.clear()
        shell.line("say hello")
        assert shell.out == [shell.gone]
        assert len(shell.robot.executive.jobs) == before


def test_a_step_that_a_breakpoint_holds_is_told(shell: Shell):
    told: list[str] = []
    shell.robot.session.journal.listen(lambda event: told.append(words(event)))
    shell.line("break say*")
    shell.line("say hello")
    assert eventually(lambda: any("held at a breakpoint" in one for one in told))
    shell.line("break off")
    shell.line("continue")
    shell.robot.wait()
    assert "say hello: held at a breakpoint" in "\n".join(told)


@pytest.mark.parametrize(
    ("line", "says"),
    [("plan pause", "I would pause"), ("plan resume", "I would go on"),
     ("plan pick up the cup", "Which cup")],
)  # fmt: skip
def test_a_plan_does_nothing_also_when_its_question_is_answered(shell: Shell, line: str, says: str):
    before = len(shell.robot.executive.jobs)
    shell.line(line)
    assert says in shell.out.text
    assert not any(word in shell.out.text for word in ("Pausing", "Stopping", "stand already"))
    shell.line("the red one")
    assert len(shell.robot.executive.jobs) == before


@pytest.mark.parametrize("name", ["a\0b", "\x1b[2J", "\x07"])
def test_letters_that_cannot_be_seen_are_no_part_of_a_line(shell: Shell, name: str):
    shell.line(f"run {name}.yaml")
    shell.line(f"save mission /nowhere/{name}")
    assert "\0" not in shell.out.text
    assert "\x1b" not in shell.out.text
