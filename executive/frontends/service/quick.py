"""`humanoid stop` and `humanoid estop` without all that the command line takes to load.

A second passes until that is loaded, and a robot may be on its way into something.
"""

from __future__ import annotations

WORDS = ("stop", "estop")


def is_meant(words: list[str]) -> bool:
    """Whether a command line is a stop and nothing else, so that this is enough."""
    match words:
        case [word] | [word, "--name", _]:
            return word in WORDS
        case _:
            return False


def run(words: list[str]) -> int:
    """Stop what is up, and only then load what it takes to say so; returns the exit status."""
    from executive.frontends.service.stopping import pressed, stop_all

    name = words[2] if len(words) > 2 else None
    done = error = None
    try:
        done = stop_all(name, "stop" if words[0] == "stop" else "estop")
    except Exception as caught:
        error = caught
    from executive.frontends import streams
    from executive.frontends.exit import ended_by

    streams.steady()
    if error is not None:
        return ended_by(error, as_json=False)
    return pressed(done or [])
