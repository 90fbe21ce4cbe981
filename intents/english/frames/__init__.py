"""Frames: what a verb in one sense makes of its complements.

A frame is a function ``frame(clause, scope) -> goals``. It raises
:class:`~intents.english.trouble.ReadingError` where the complements do not fit.
"""

from collections.abc import Callable

from intents.english.frames import devices, handling, mission, motion, people, postures
from intents.english.phrases.complements import Clause
from intents.english.phrases.referents import Scope
from intents.goals import Goal

Frame = Callable[[Clause, Scope], list[Goal]]

FRAMES: dict[str, Frame] = {
    "go": motion.go,
    "leave": motion.leave,
    "turn": motion.turn,
    "find": motion.find,
    "look": motion.look,
    "wait": motion.wait,
    "pick": handling.pick,
    "take": handling.take,
    "put": handling.put,
    "drop": handling.put,
    "clear": handling.clear,
    "swap": handling.swap,
    "bring": handling.bring,
    "give": handling.give,
    "want": handling.want,
    "follow": people.follow,
    "guide": people.guide,
    "meet": people.meet,
    "collect": people.collect,
    "greet": people.greet,
    "open": devices.open_,
    "close": devices.close,
    "switch": devices.switch,
    "stand": postures.stand,
    "balance": postures.stand,
    "squat": postures.squat,
    "sit": postures.sit,
    "lean": postures.lean,
    "lift_leg": postures.lift_leg,
    "gesture": postures.gesture,
    "stop": mission.stop,
    "pause": mission.pause,
    "resume": mission.resume,
    "cancel": mission.cancel,
    "report": mission.report,
}
"""Frames by sense of the verb (:mod:`intents.english.words.verbs`)."""
