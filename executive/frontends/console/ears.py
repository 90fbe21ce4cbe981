"""What people say into pages, as a process of its own: sound comes in, and what was said goes out.

Recognising takes a second of a core: in the console's own process it would hold up a STOP, and in
the executive's the robot. A line of standard input is a `Sound`, one of standard output a `Said`
(`hearing.py`).
"""

from __future__ import annotations

import sys

import msgspec
import numpy as np

from executive.frontends.console.hearing import Said, Sound
from executive.frontends.recorded_place import place_of
from executive.meaning.knowledge import Knowledge
from intents.speech.dictation import Dictation
from intents.speech.ear import Ear
from intents.speech.keywords import Keywords
from intents.speech.spotting import Spotter
from robot.bus.lifeline import Turn, ask_for_turn, tie_to_parent
from robot.errors import RobotError

FULL_SCALE = 32768.0


def main(about: str, parent_pid: str) -> None:
    """Load what the world of a run is called by, and listen until standard input ends."""
    tie_to_parent(int(parent_pid))
    ask_for_turn(Turn.OTHERS)
    listener = ear(msgspec.json.decode(about, type=dict[str, object]))
    decoder = msgspec.json.Decoder(Sound)
    for line in sys.stdin.buffer:
        piece = decoder.decode(line)
        listener.replying = piece.replying
        sound = np.frombuffer(piece.data, "<i2").astype(np.float32) / FULL_SCALE
        said = listener.push(sound)
        if piece.ends:
            said += listener.finish()
        for one in said:
            found = Said(
                kind=one.kind, text=one.text, why=one.why, sure=one.sure, doubtful=one.doubtful
            )
            sys.stdout.buffer.write(msgspec.json.encode(found) + b"\n")
        sys.stdout.buffer.flush()


def ear(about: dict[str, object]) -> Ear:
    """What listens for the names of the world of a run that was started with this.

    Raises:
        RobotError: the world cannot be read, or nobody says which it was.
    """
    from intents.speech.sphinx import Sphinx

    place = place_of(about)
    if place is None:
        raise RobotError("nobody says what the world of this run is")
    vocabulary = Knowledge(place.world.map).vocabulary()
    dictation = Dictation(vocabulary)
    recogniser = Sphinx(vocabulary, dictation=dictation)
    return Ear(recogniser, spotter=Spotter(dictation, Keywords()))


if __name__ == "__main__":
    main(*sys.argv[1:])
