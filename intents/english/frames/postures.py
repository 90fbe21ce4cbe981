"""Postures, balance and gestures of the robot itself."""

from intents.english.frames.motion import must_be_beside, must_be_to
from intents.english.frames.slots import Slots
from intents.english.phrases.complements import Clause
from intents.english.phrases.phrase import NounPhrase
from intents.english.phrases.referents import Scope, is_person, to_object, to_person, to_place
from intents.english.trouble import Misfit, NotUnderstood
from intents.english.words.measures import STEP_M
from intents.english.words.verbs import base_form
from intents.goals import (
    OPERATOR,
    Balance,
    BalanceMode,
    Displacement,
    Find,
    Gesture,
    Goal,
    GoTo,
    LookAt,
    Side,
    Wait,
)

_LEGS = ("leg", "legs", "foot", "feet")
_FLOOR = ("floor", "ground")
_OTHER: dict[str, Side] = {"left": "right", "right": "left"}


def _limb(slots: Slots, *roles: str) -> NounPhrase | None:
    """A part of the body among the complements."""
    for complement in slots.rest:
        if complement.phrases and complement.role in roles and complement.phrase.noun == "body":
            slots.rest.remove(complement)
            return complement.phrase
    return None


def _side(word: str) -> Side | None:
    return "left" if word == "left" else "right" if word == "right" else None


def _balance(slots: Slots, mode: BalanceMode, side: Side | None = None) -> list[Goal]:
    duration = slots.measure("time")
    slots.direction("up", "down", "forward", "around")
    slots.done()
    return [Balance(mode=mode, side=side, duration_s=duration)]


def stand(clause: Clause, scope: Scope) -> list[Goal]:
    """Stand up; stand on one leg; balance on the left foot for ten seconds."""
    slots = Slots(clause, scope)
    limb = _limb(slots, "at", "to", "with")
    if limb is None:
        place = slots.take("at")
        if place:
            duration = slots.measure("time")
            slots.done()
            if is_person(place.phrase, scope):
                return [Find(person=to_person(place.phrase, scope))]
            must_be_to(place, clause)
            must_be_beside(place.phrase, clause, scope)
            pause: list[Goal] = [Wait(duration_s=duration)] if duration is not None else []
            return [GoTo(place=to_place(place.phrase, scope)), *pause]
        if slots.direction("backward"):  # stand back: to make room
            slots.done()
            return [GoTo(by=Displacement(forward_m=-STEP_M))]
        return _balance(slots, "stand")
    if limb.said not in _LEGS:
        raise NotUnderstood(f"I can stand on one leg or on both, not on my {limb.said}")
    both = limb.count in (2, "all") or (limb.said in ("legs", "feet") and not limb.side)
    return _balance(slots, "stand" if both else "one_leg", _side(limb.side))


def lift_leg(clause: Clause, scope: Scope) -> list[Goal]:
    """Lift your left foot: stand on the right leg; put it down: on both."""
    slots = Slots(clause, scope)
    limb = _limb(slots, "")
    if limb is None:
        return _head(slots)
    down = slots.direction("up", "down") == "down" or clause.verb.startswith("lower")
    slots.rest = [c for c in slots.rest if not (c.phrases and c.phrase.said in _FLOOR)]
    if limb.said in _LEGS and down:
        return _balance(slots, "stand")
    if limb.said in _LEGS:
        return _balance(slots, "one_leg", _OTHER.get(limb.side))
    if limb.said.rstrip("s") in ("arm", "hand"):
        slots.done()
        if down:
            both = limb.count in (2, "all") or (limb.said.endswith("s") and not limb.side)
            return [Gesture(kind=lowering(limb.side, several=both))]
        return [Gesture(kind="_".join(w for w in ("raise", limb.side, "arm") if w))]
    raise NotUnderstood(f"I cannot {'lower' if down else 'raise'} my {limb.said}")


def lowering(side: str | None, *, several: bool) -> str:
    """The sign that brings an arm down, or both."""
    if side and side.strip() in _OTHER:
        return f"lower_{side.strip()}_arm"
    return "lower_both_arms" if several else "lower_arm"


def _head(slots: Slots) -> list[Goal]:
    """Raise your head: look up."""
    said = slots.take("")
    if said is None or said.phrase.said != "head":
        raise Misfit("that is no part of my body")
    slots.direction("up", "down")
    slots.done()
    return [LookAt(place="down" if slots.clause.verb.startswith("lower") else "up")]


def squat(clause: Clause, scope: Scope) -> list[Goal]:
    """Squat for five seconds."""
    return _balance(Slots(clause, scope), "squat")


def sit(clause: Clause, scope: Scope) -> list[Goal]:
    """Sit down; sit on the chair."""
    slots = Slots(clause, scope)
    place = slots.take("at")
    down = _balance(slots, "sit")
    return [GoTo(place=to_place(place.phrase, scope)), *down] if place else down


def lean(clause: Clause, scope: Scope) -> list[Goal]:
    """Lean to the left; bend forward for three seconds."""
    slots = Slots(clause, scope)
    said = slots.direction("left", "right", "forward", "backward")
    side: Side = "forward"
    for known in ("left", "right", "backward"):
        side = known if said == known else side
    limb = _limb(slots, "")
    if limb is not None and limb.said in ("knee", "knees", "leg", "legs"):
        return _balance(slots, "squat")
    return _balance(slots, "lean", side)


_KINDS = (
    ("thumbs", "thumbs_up"), ("shake your head", "shake_head"), ("shake head", "shake_head"),
    ("shake", "shake_hands"), ("high five", "high_five"), ("wave", "wave"), ("nod", "nod"),
    ("point", "point"), ("clap", "clap"), ("shrug", "shrug"), ("danc", "dance"),
    ("bow", "bow"), ("both", "raise_both_arms"), ("your hands", "raise_both_arms"),
    ("your arms", "raise_both_arms"), ("hands up", "raise_both_arms"),
    ("curtsy", "bow"), ("cross your arms", "cross_arms"), ("raise both", "raise_both_arms"),
    ("raise your arms", "raise_both_arms"), ("raise your hands", "raise_both_arms"),
    ("raise your left", "raise_left_arm"), ("raise your right", "raise_right_arm"),
    ("raise", "raise_arm"),
)  # fmt: skip


def gesture(clause: Clause, scope: Scope) -> list[Goal]:
    """Wave; point at the cup; nod; give a thumbs up."""
    slots = Slots(clause, scope)
    first, *rest = clause.verb.split()
    verb = " ".join([base_form(first), *rest])
    kind = next((kind for word, kind in _KINDS if word in verb), verb)
    limb = _limb(slots, "", "with")
    side = None if limb is None or kind.startswith("raise") else _hand(limb, kind)
    slots.direction("up", "down", "left", "right", "forward")
    points = clause.verb.startswith("point")
    shown = slots.take("") if points else None
    target = shown or slots.take("to", "at") or slots.take("") or slots.take("for")
    if points and target:
        slots.take_person("to")
        slots.take_person("for")
    if target and target.role == "for" and target.phrase.noun == "operator":
        target = None
    slots.measure("time")
    slots.done()
    return [Gesture(kind=kind, at=_target(target.phrase, scope) if target else None, side=side)]


def _hand(limb: NounPhrase, kind: str) -> Side | None:
    """The hand that a sign is made with.

    Raises:
        NotUnderstood: It takes one hand, and both are named; or it takes none.
    """
    if limb.said.rstrip("s") not in ("hand", "arm"):
        return None
    both = limb.count in (2, "all") or (limb.said.endswith("s") and not limb.side)
    if both and kind in ("wave", "point"):
        raise NotUnderstood(f"I {kind} with one hand, not with both")
    if limb.side and kind in ("nod", "bow", "shake_head"):
        raise NotUnderstood(f"I do not need a hand to {kind.replace('_', ' ')}")
    return _side(limb.side)


def _target(phrase: NounPhrase, scope: Scope) -> str | None:
    """What a gesture is for, as a name."""
    if phrase.noun == "operator":
        return OPERATOR
    if is_person(phrase, scope):
        return to_person(phrase, scope).name
    if phrase.name("place", "room") or phrase.noun in ("there", "here"):
        return to_place(phrase, scope)
    query = to_object(phrase, scope)
    if not (query.name or query.category or query.held):
        raise NotUnderstood(f"I do not know what “{phrase.said}” is to be")
    return " ".join(w for w in (query.color, query.name or query.category) if w) or None
