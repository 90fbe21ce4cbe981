"""`humanoid stop` and `humanoid estop` without all that the command line takes to load.

A second passes until that is loaded, and a robot may be on its way into something. Whatever else
stands behind them ("stop now", `stop --all`): they act first, on every robot that is up, and
what was not understood is told afterwards.
"""

from __future__ import annotations

WORDS = {"stop": "stop", "halt": "stop", "estop": "estop", "e-stop": "estop"}
"""What is pressed; `halt` is no command of its own."""
_UNDONE = ("release", "reset")
_HELP = ("-h", "--help")


def is_meant(words: list[str]) -> bool:
    """Whether a command line is a stop, for all that is said along with it."""
    button = _button(words)
    if button is None or any(word in _HELP for word in words):
        return False
    return button == "stop" or not any(word in _UNDONE for word in words[1:])


def is_cried(words: list[str], commands: list[str]) -> bool:
    """Whether what begins with no command is a cry to stop all the same (`humanoid freeze!`)."""
    if not words or words[0] in commands or words[0].startswith("-"):
        return False
    from intents.stopping import is_stop

    return is_stop(" ".join(words))


def _button(words: list[str]) -> str | None:
    return WORDS.get(words[0].casefold().strip(" .!")) if words else None


def run(words: list[str]) -> int:
    """Stop what is up, and only then load what it takes to say so; returns the exit status."""
    from executive.frontends.service.stopping import pressed, stop_all

    name, unread = _named(words[1:])
    done = error = None
    try:
        done = stop_all(name, "estop" if _button(words) == "estop" else "stop")
    except Exception as caught:
        error = caught
    from executive.frontends import streams
    from executive.frontends.exit import ended_by
    from executive.frontends.output import say
    from robot.errors import ConfigError
    from robot.printable import printable

    streams.steady()
    if error is not None:
        status = ended_by(error, as_json=False)
        if isinstance(error, ConfigError):
            say("Nothing was stopped.", err=True)
        return status
    status = pressed(done or [])
    if unread:
        said = printable(" ".join(unread))
        cure = "humanoid stop --name NAME stops one only"
        say(f"That was for every robot that is up; “{said}” means nothing here ({cure})", err=True)
    return status


def _named(words: list[str]) -> tuple[str | None, list[str]]:
    """The one robot that is to be stopped, and what else was said; None where that is unclear."""
    match words:
        case ["press"] | []:
            return None, []
        case ["--name", name] if name:
            return name, []
        case [option] if option.startswith("--name=") and option != "--name=":
            return option.removeprefix("--name="), []
        case _:
            return None, words
