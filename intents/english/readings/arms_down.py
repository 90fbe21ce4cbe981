"""An arm, a hand or both that are to come down: "lower your left arm", "hands down".

What says so is matched as a whole, by verb, limb and direction, because most of its verbs put
things down or raise a limb in other sentences ("put your hands up", "drop the cup").
"""

import re

from intents.english.frames.postures import lowering
from intents.english.phrases.complements import ends_clause
from intents.english.reading import Found, Sentence
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.goals import Balance, Gesture, Goal

_WHOSE = (
    r"(?:(?:your|the|an|a|one|one of your|my|both|both your|both of your|both of the|all your)"
    r" (?P<other>other )?)?"
)
_LIMB = rf"{_WHOSE}(?P<side>left |right )?(?P<limb>arms?|hands?)"
_DOWN = r"(?:back )?(?:down|downwards?|to the ground|in)(?: again| now)?"
_REST = (
    r"(?:to|by|at|on|against) (?:your|the) (?:side|sides|body|hip|hips)|to (?:rest|a rest)|at rest|"
    r"loose|loosely|free"
)
_TAIL = rf"(?: (?:{_DOWN}|{_REST}|again|now|slowly|please))*"
_TO_SIDES = rf"(?:{_DOWN}(?: {_REST})?|{_REST})"
_LIFTED = r"(?:put|bring|take|get|pull|move|let|have|hold|keep|lay|set|place|stick|swing)"
_PATTERNS = tuple(
    re.compile(rf"{pattern}(?: (?:please|now|again|slowly))*")
    for pattern in (
        rf"(?:lower|drop|sink) (?:down )?{_LIMB}{_TAIL}",
        rf"(?:rest|relax|stow) {_LIMB.replace('|hands?', '')}{_TAIL}",
        rf"{_LIFTED} {_LIMB} {_TO_SIDES}",
        rf"{_LIFTED} down {_LIMB}{_TAIL}",
        rf"(?:let|have) {_LIMB} (?:hang|drop|fall|sink|dangle|rest|relax|go){_TAIL}",
        rf"{_LIMB} {_TO_SIDES}",
    )
)
_IT = re.compile(
    r"(?:(?:and )?(?:lower|drop) (?:it|them)|(?:put|bring|take|let) (?:it|them) (?:back )?down|"
    r"(?:and )?(?:down|lower) again)(?: (?:again|now|please))*"
)
"""What comes down then is the arm, or the leg, that was to be raised just now."""
_RAISED = {
    "raise_arm": "lower_arm",
    "raise_left_arm": "lower_left_arm",
    "raise_right_arm": "lower_right_arm",
    "raise_both_arms": "lower_both_arms",
    **{kind: kind for kind in ("lower_arm", "lower_left_arm", "lower_right_arm")},
    "lower_both_arms": "lower_both_arms",
}


def arms_down(sentence: Sentence, at: int) -> Found | None:
    """Lower your left arm; put your arms down; raise your arm, then *lower it*."""
    text, end = sentence.text, at
    while end < len(text) and text.word(end) not in (COMMA, FULL_STOP):
        end += 1
        if not ends_clause(text, end) and text.word(end) not in ("and", "then"):
            continue
        said = " ".join(text.words[at:end])
        found = next(filter(None, (pattern.fullmatch(said) for pattern in _PATTERNS)), None)
        if found is not None and found["other"] is None:
            sentence.notes.passed.append((at, at + 1))  # the verb: "relax" is said by no goal
            return [Gesture(kind=lowering(found["side"], several=_several(found)))], end
        about_thing = sentence.scope.object is not None and not said.startswith(("lower", "and l"))
        lowered = _lowered(sentence) if _IT.fullmatch(said) and not about_thing else None
        if lowered is not None:
            return [lowered], end
    return None


def _several(found: re.Match[str]) -> bool:
    return found["limb"].endswith("s") or "both" in found[0]


def _lowered(sentence: Sentence) -> Goal | None:
    """What lowers the limb that was to be raised last of all, in this sentence or before it."""
    goals = [*sentence.history, *sentence.before]
    last = goals[-1] if goals else None
    if isinstance(last, Balance) and last.mode == "one_leg":
        return Balance(mode="stand")
    if isinstance(last, Gesture) and last.kind in _RAISED:
        return Gesture(kind=_RAISED[last.kind])
    return None
