"""Other words that models use for goals and their slots, and what they stand for.

A list of what was seen, and no more: what is not in it is a mistake that the model is told of.
"""

from typing import Any, cast

from intents.allowed import GESTURES
from intents.english.words import lexicon
from intents.goals import Goal, snake_case

Slots = dict[str, Any]
_TAGS = ("goal", "action", "skill", "type", "command", "function")
"""Where the kind of a goal stands."""
NESTS = ("slots", "parameters", "params", "args", "arguments")
"""Where its slots may stand, one level down."""
NOTES = lexicon.words(
    "id step number description reason comment explanation thought note confidence"
)
"""What a model remarks on a goal; it means nothing to the robot."""
KINDS = frozenset(snake_case(kind.__name__) for kind in Goal.__args__)
_OTHER_KINDS = {
    "go_to": "go goto walk walk_to move_to navigate navigate_to go_to_place drive_to",
    "pick": "pick_up pickup grab grasp take get",
    "place": "put put_down put_on put_in place_on place_in set_down drop store move",
    "bring": "fetch deliver carry bring_to",
    "give": "hand hand_over",
    "find": "search search_for look_for locate",
    "say": "speak announce",
    "look_at": "look gaze_at",
    "guide": "lead escort",
    "switch": "turn_on turn_off switch_on switch_off",
    "for_each": "foreach",
}
_KIND_OF = {other: kind for kind, others in _OTHER_KINDS.items() for other in others.split()}
_OTHER_SLOTS: dict[str, dict[str, str]] = {
    "go_to": {"place": "destination location target to room"},
    "find": {"object": "item thing target", "at": "location from place"},
    "pick": {"object": "item thing target", "at": "location from place"},
    "place": {"object": "item thing", "in": "into inside",
              "on": "onto to destination location place"},
    "bring": {"object": "item thing", "to": "destination recipient person location place on"},
    "give": {"object": "item thing", "to": "recipient person"},
    "say": {"what": "text message words content", "to": "person"},
    "greet": {"person": "to name target"},
    "meet": {"person": "to name target"},
    "follow": {"person": "target name", "to": "destination location place"},
    "guide": {"person": "target name", "to": "destination location place"},
    "look_at": {"place": "direction location"},
    "open": {"what": "object device target"},
    "close": {"what": "object device target"},
    "switch": {"what": "object device target", "on": "state"},
    "wait": {"duration_s": "duration seconds time time_s"},
    "balance": {"duration_s": "duration seconds time time_s"},
    "gesture": {"kind": "gesture name", "at": "to person target"},
    "repeat": {"times": "count n", "goals": "steps actions"},
    "for_each": {"goals": "steps actions do"},
}  # fmt: skip
_SLOT_OF = {
    kind: {other: slot for slot, others in slots.items() for other in others.split()}
    for kind, slots in _OTHER_SLOTS.items()
}
_ON_OR_OFF = {"turn_on": True, "switch_on": True, "turn_off": False, "switch_off": False,
              "on": True, "off": False}  # fmt: skip


def _tag_of(goal: Slots) -> str:
    """Where a goal says its kind, empty if nowhere; in calls of functions it is the "name"."""
    tags = (*_TAGS, "name") if any(isinstance(goal.get(key), dict) for key in NESTS) else _TAGS
    return next((tag for tag in tags if isinstance(goal.get(tag), str)), "")


def goal_kind(goal: Slots) -> str | None:
    """What a goal calls itself, in lower case; None if it is no goal."""
    tag = _tag_of(goal)
    if tag:
        return _snake(goal[tag])
    only = _snake(next(iter(goal))) if len(goal) == 1 else ""
    return only if only in KINDS and isinstance(next(iter(goal.values())), dict) else None


def in_our_words(goal: Slots) -> Slots:
    """A goal with its kind and its slots called as the contract calls them, notes left out."""
    said = goal_kind(goal)
    if said is None:
        return goal
    tag = _tag_of(goal)
    slots = {key: value for key, value in goal.items() if key != tag} if tag else next(
        iter(goal.values())
    )  # fmt: skip
    slots = _flat(slots)
    kind = said if said in KINDS else _KIND_OF.get(said, said)
    if said in GESTURES:
        kind, slots = "gesture", {"kind": said, **slots}
    elif said in _ON_OR_OFF:
        slots = {"on": _ON_OR_OFF[said], **slots}
    if said == "get" and ("to" in slots or "recipient" in slots):
        kind = "bring"
    renamed = _SLOT_OF.get(kind, {})
    taken = set(slots)
    ours: Slots = {"goal": kind}
    for slot, value in slots.items():
        name = renamed.get(slot, slot)
        ours[name if name not in taken else slot] = value
    if kind in ("find", "pick") and "at" in ours and "object" in ours:
        thing = ours["object"]
        said_at = {"at": ours.pop("at")}
        ours["object"] = said_at | (thing if isinstance(thing, dict) else {"name": thing})
    if kind == "switch" and isinstance(ours.get("on"), str):
        ours["on"] = _ON_OR_OFF.get(ours["on"].lower(), ours["on"])
    return ours


def _flat(slots: Slots) -> Slots:
    """Slots without notes, and those that stand one level down."""
    flat: Slots = {}
    for key, value in slots.items():
        if key in NESTS and isinstance(value, dict):
            flat |= _flat(cast("Slots", value))
        elif key not in NOTES:
            flat[key] = value
    return flat


def _snake(name: str) -> str:
    name = name.lower() if name.isupper() else name
    return snake_case(name.strip().replace(" ", "_").replace("-", "_")).replace("__", "_")
