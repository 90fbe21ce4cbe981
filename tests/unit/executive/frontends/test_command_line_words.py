"""The words of a command line, and the last words of a command that could not do its work."""

import errno
import os

import pytest
import typer
from rich.text import Text

from executive.engine.job_book import JobError
from executive.frontends import cli
from executive.frontends.exit import ended_by
from executive.frontends.prompt.commands.job_words import number_of
from robot.errors import ConfigError


@pytest.mark.parametrize("word", ["a\x1b[2J", "a\u202eb", "a\udcffb", "\u200eplease\u200f"])
def test_a_word_that_cannot_be_printed_is_refused(word):
    with pytest.raises(ConfigError, match="cannot be printed"):
        cli._checked(word)


@pytest.mark.parametrize(
    "cry",
    ["\u202dstop\u202c", "\x1b[31mstop\x1b[0m", "st\x01op", "stop\udcff", "wait, stop\u200e!"],
)
def test_a_cry_to_stop_is_heard_whatever_was_pasted_along_with_it(cry):
    assert cli._checked(cry) == "stop"


def test_any_other_word_stays_as_it_is():
    assert cli._checked("do not stop at the ▸ table") == "do not stop at the ▸ table"


@pytest.mark.parametrize(
    "words", [["do", "--run-dir", "", "wave"], ["film", "-o", ""], ["do", "--world=", "wave"]]
)
def test_an_option_whose_value_is_empty_is_refused_by_its_name(words):
    with pytest.raises(ConfigError, match=r"what follows (--run-dir|-o|--world) is empty"):
        cli._check_values(words)


@pytest.mark.parametrize(
    "words", [["parse", ""], ["mission", "run", "a.yaml", "--param", "words="], ["do", "a --b="]]
)
def test_a_sentence_or_a_parameter_may_be_empty(words):
    cli._check_values(words)


def helps(command, name="humanoid"):
    """What is said of each option and argument of a command and of those below it."""
    for one in command.params:
        if getattr(one, "help", None):
            yield f"{name} {one.name}", one.help
    for key, below in getattr(command, "commands", {}).items():
        yield from helps(below, f"{name} {key}")


def test_no_help_loses_a_word_to_markup():
    found = list(helps(typer.main.get_command(cli.app)))
    assert len(found) > 50
    for where, text in found:
        assert Text.from_markup(text).plain == text, f"{where}: [...] is taken for a style"


@pytest.mark.parametrize("text", ["9" * 5001, "-1", "nan", "", "²", "1 2"])
def test_what_is_no_number_of_a_job_is_refused(text):
    with pytest.raises(JobError, match="is no job's number") as error:
        number_of(text)
    assert len(str(error.value)) < 200


@pytest.mark.parametrize(
    "error",
    [
        *(OSError(code, os.strerror(code)) for code in (errno.EAGAIN, errno.EMFILE)),
        MemoryError(),
        RuntimeError("can't start new thread"),
    ],
)
def test_what_the_machine_has_no_more_of_is_no_mistake_of_this_software(error, capsys):
    assert ended_by(error, as_json=False) == 2
    said = capsys.readouterr().err
    assert "ulimit" in said
    assert "Errno" not in said
