"""What a language model reads at the prompt: read back, changed, agreed to, stopped."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread
from types import SimpleNamespace
from typing import cast

from benchmarks.intents.endpoint import Reply, Server, serving
from executive.frontends.listening.obeying import Conversation
from executive.frontends.prompt.shell import Shell
from intents.language_model import Endpoint, LanguageModel
from intents.language_model.endpoint import MAX_DEADLINE_S
from intents.speech.ear import Ear, Spoken
from tests.fakes.fast_shell import shell_in
from tests.fakes.waiting import eventually

WAVE = """{"outcome": "goals", "goals": [{"goal": "say", "what": "good morning"}]}"""


def test_what_a_model_reads_is_read_back_and_its_troubles_are_told(tmp_path: Path):
    with serving(Reply(content=WAVE), Reply(status=500)) as server:
        model = LanguageModel(Endpoint(base_url=server.url, model="local"))
        with shell_in(tmp_path, model=model) as shell:
            shell.line("brighten up the morning")
            assert "Shall I?" in shell.out[-1]
            assert not shell.robot.executive.jobs
            shell.line("yes")
            shell.robot.wait()
            assert shell.robot.executive.jobs[-1].state == "done"
            shell.line("brighten up the evening")
            assert "language model was of no help" in shell.out[-1]


STEPS = """{"goals": [{"goal": "say", "what": "one"}, {"goal": "say", "what": "two"},
                    {"goal": "say", "what": "three"}]}"""


def test_a_plan_is_shown_by_numbers_and_changed_before_it_is_done(tmp_path: Path):
    with serving(Reply(content=STEPS), Reply(content="Hm."), Reply(content="Hm.")) as server:
        model = LanguageModel(Endpoint(base_url=server.url, model="local"))
        with shell_in(tmp_path, model=model) as shell:
            for line in ("brighten up the morning", "no, skip two", "three first", "yes"):
                shell.line(line)
            shell.robot.wait()
            assert "  2. say “two”\n" in shell.out[0]
            assert shell.robot.executive.jobs[-1].state == "done"
            assert shell.robot.executive.jobs[-1].text == "say “three”, then say “one”"
            shell.line("brighten up the evening")
            assert "language model was of no help" in shell.out[-1]
            shell.line("fold the laundry, it is late")
            shell.line("it is late")  # of which no model was asked
            assert "no help" not in shell.out[-1]


def test_a_plan_that_is_agreed_to_beforehand_is_shown_and_done(tmp_path: Path):
    with serving(Reply(content=STEPS)) as server:
        model = LanguageModel(Endpoint(base_url=server.url, model="local"))
        with shell_in(tmp_path, model=model) as shell:
            shell.dialogue.agreed = True
            shell.line("brighten up the morning")
            shell.robot.wait()
            assert "  2. say “two”\n" in shell.out[0]
            assert [job.state for job in shell.robot.executive.jobs] == ["done"]


@contextmanager
def asking_for_ever(folder: Path) -> Iterator[tuple[Shell, Server]]:
    """A shell at work, whose language model never answers."""
    with serving(Reply(delay_s=3600.0)) as server:
        endpoint = Endpoint(base_url=server.url, model="local", deadline_s=MAX_DEADLINE_S)
        with shell_in(folder, "empty", LanguageModel(endpoint)) as shell:
            shell.line("squat for 60 seconds")
            assert eventually(shell.queue.under_way)
            yield shell, server


def test_a_stop_acts_while_a_language_model_is_asked(tmp_path: Path):
    with asking_for_ever(tmp_path) as (shell, server):
        how = {"stops": shell.brake.stops}
        line = Thread(target=shell.line, args=("brighten up the morning",), kwargs=how)
        line.start()
        assert eventually(lambda: server.requests)
        assert shell.stop_at_once("stop")
        shell.robot.wait()
        assert [job.state for job in shell.robot.executive.jobs] == ["cancelled"]
        line.join()
        assert "“brighten up the morning” was there when you said stop" in shell.out.text
        assert shell.dialogue.question is None


def test_who_leaves_does_not_wait_for_a_language_model(tmp_path: Path):
    with asking_for_ever(tmp_path) as (shell, server):
        line = Thread(target=shell.line, args=("brighten up the morning",))
        line.start()
        assert eventually(lambda: server.requests)
        shell.leave()
        line.join()
        assert len(shell.robot.executive.jobs) == 1


def test_a_stop_is_heard_while_a_language_model_is_asked(tmp_path: Path):
    with asking_for_ever(tmp_path) as (shell, server):
        ear = cast(Ear, SimpleNamespace(replying=False, said=lambda _text: None))
        conversation = Conversation(shell, ear, recorded=False)
        conversation.take(Spoken(kind="sentence", text="brighten up the morning"))
        assert eventually(lambda: server.requests)
        conversation.take(Spoken(kind="stop", text="stop"))
        shell.robot.wait()
        assert [job.state for job in shell.robot.executive.jobs] == ["cancelled"]
        assert eventually(lambda: "was there when you said stop" in shell.out.text)
