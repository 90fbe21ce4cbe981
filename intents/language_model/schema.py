"""The JSON schema of an answer, and the same as lines for a model that is shown no schema.

Servers make a grammar of it: llama.cpp and ollama one of their own, vLLM by xgrammar or llguidance.
So it keeps to what all of them know (type, properties, required, enum, anyOf, $ref, bounds of
arrays), names what is used often once, and has no nulls: what is not said is left out.
"""

from functools import lru_cache
from typing import Any, cast, get_args

import msgspec

from intents import allowed
from intents.allowed import Names
from intents.goals import Goal, Part, Superlative
from intents.vocabulary import Vocabulary

Schema = dict[str, Any]
_REF = "#/$defs/"
_SPOT, _THING, _KIND, _NAME, _DEVICE = "SpotName", "ThingName", "KindName", "PersonName", "Device"
_CHOICES: dict[str, tuple[str, ...]] = {
    _SPOT: (
        "ObjectQuery.at", "Person.at", "GoTo.place", "Place.on", "Place.in", "Follow.to",
        "Guide.to", "Bring.to",
    ),
    _THING: ("ObjectQuery.name",),
    _KIND: ("ObjectQuery.category",),
    _NAME: ("Person.name",),
    _DEVICE: ("Open.what", "Close.what", "Switch.what", "State.what"),
    "LookedAt": ("LookAt.place",),
    "PointedAt": ("Gesture.at",),
    "GestureName": ("Gesture.kind",),
    "Property": ("Tell.property",),
    "Asked": ("Answer.what",),
    "Posed": ("Person.gesture",),
}  # fmt: skip
"""Slots that are strings, by what they may say."""
_DROPPED = ("title", "description", "default", "discriminator")
_STEERING = frozenset(kind.__name__ for kind in allowed.STEERING)
_LEFT_OUT = {*_STEERING, "Pose2"}
"""Coordinates are for programs: a model is told none."""
_BARE = {"type": "string"}
_SPOKEN = {"type": "string", "maxLength": allowed.MAX_SPOKEN}


@lru_cache(maxsize=4)
def answer_schema(vocabulary: Vocabulary) -> Schema:
    """What an answer may be: for each outcome what it has to hold, with the names of this world."""
    defs = _definitions(vocabulary)
    goals = {"type": "array", "items": {"$ref": f"{_REF}Goal"}, "minItems": 1,
             "maxItems": allowed.MAX_GOALS}  # fmt: skip
    text = _SPOKEN
    outcomes = {"goals": ("goals", goals), "question": ("text", text), "refusal": ("text", text)}
    return {
        "type": "object",
        "anyOf": [
            _object({"outcome": {"enum": [outcome]}, slot: held}, ["outcome", slot])
            for outcome, (slot, held) in outcomes.items()
        ],
        "$defs": defs,
    }


def _object(properties: Schema, required: list[str]) -> Schema:
    return {"type": "object", "properties": properties, "required": required,
            "additionalProperties": False}  # fmt: skip


def _definitions(vocabulary: Vocabulary) -> Schema:
    """Every goal and what it is made of."""
    made = msgspec.json.schema_components([tuple[Goal, ...]], ref_template=_REF + "{name}")
    kinds = [
        option for option in made[0][0]["items"]["anyOf"]
        if option["$ref"].removeprefix(_REF) not in _STEERING
    ]  # fmt: skip
    structs = {name: _plain(one) for name, one in made[1].items() if name not in _LEFT_OUT}
    del structs["GoTo"]["properties"]["pose"]
    structs["Say"]["properties"]["what"] = _SPOKEN
    known = _names(vocabulary)
    for choice, slots in _CHOICES.items():
        for struct, slot in (place.split(".") for place in slots):
            _close(structs[struct], slot, choice if known[choice] else "")
    named = {choice: {"enum": words} for choice, words in known.items() if words}
    return {"Goal": {"anyOf": kinds}, **named, **structs}


def _names(vocabulary: Vocabulary) -> dict[str, list[str]]:
    """What each choice is between."""
    names = Names(vocabulary)
    spots = sorted(names.spots)
    return {
        _SPOT: spots, _THING: sorted(names.objects), _KIND: sorted(names.categories),
        _NAME: sorted(names.people), _DEVICE: sorted(names.devices),
        "LookedAt": [*spots, *allowed.DIRECTIONS],
        "PointedAt": sorted(names.spots | names.people),
        "GestureName": list(allowed.GESTURES), "Property": list(allowed.PROPERTIES),
        "Asked": list(allowed.ANSWERS), "Posed": list(allowed.PERSON_GESTURES),
    }  # fmt: skip


def _close(struct: Schema, slot: str, choice: str) -> None:
    """A slot's string becomes one of a choice; without one it can say nothing, and is left out."""
    properties = struct["properties"]
    if not choice:
        del properties[slot]
    elif properties[slot] == _BARE:
        properties[slot] = {"$ref": _REF + choice}
    else:
        options = properties[slot]["anyOf"]
        properties[slot] = {"anyOf": [{"$ref": _REF + choice} if one == _BARE else one
                                      for one in options]}  # fmt: skip


def _plain(schema: Any) -> Any:
    """Without what is for people, and without nulls, at any depth; the goals inside are `Goal`."""
    if isinstance(schema, list):
        return [_plain(one) for one in cast("list[Any]", schema)]
    if not isinstance(schema, dict):
        return schema
    kept = {k: v for k, v in cast("Schema", schema).items() if k not in _DROPPED}
    if "anyOf" in kept:
        options = [one for one in kept.pop("anyOf") if one != {"type": "null"}]
        if len(options) == 1:
            return _plain({**options[0], **kept})
        if {"$ref": f"{_REF}GoTo"} in options:
            return {"$ref": f"{_REF}Goal"}
        kept["anyOf"] = options
    if "properties" in kept:  # whose names are no words of a schema
        kept["properties"] = {k: _plain(v) for k, v in kept["properties"].items()}
        return kept
    return {k: _plain(v) for k, v in kept.items()}


# --- as lines ------------------------------------------------------------------------------------

_SHORT = {
    "ObjectQuery": "OBJECT", "Person": "PERSON", "Relation": "RELATION", "Displacement": "BY",
    "Clothing": "CLOTHING", "Goal": "GOAL", _SPOT: "SPOT", _THING: "THING", _KIND: "KIND",
    _NAME: "NAME", _DEVICE: "DEVICE", "PointedAt": "SPOT|NAME",
    "LookedAt": "|".join(["SPOT", *(f'"{way}"' for way in allowed.DIRECTIONS)]),
}  # fmt: skip
"""What is called by a name in the lines; other things are written out."""
_EXPLAINED = ("ObjectQuery", "Person", "Clothing", "Relation", "Displacement")
_CONDITIONS = ("Present", "Holding", "State")
_RANKS = "|".join(f'"{word}"' for word in sorted(get_args(Superlative)))
_PARTS = "|".join(f'"{word}"' for word in sorted(get_args(Part)))


@lru_cache(maxsize=1)
def goal_lines() -> str:
    """Each goal with its slots and what it means, a line each, and what the slots hold."""
    everybody = Vocabulary.of(objects=["a"], people=["b"], categories={"c": "c"})
    defs = _definitions(everybody)
    made = msgspec.json.schema_components([tuple[Goal, ...]], ref_template=_REF + "{name}")[1]
    kinds = [option["$ref"].removeprefix(_REF) for option in defs["Goal"]["anyOf"]]
    lines = [f"{_written(defs[kind], defs)}  {_meaning(made[kind])}" for kind in kinds]
    lines += [f"{_SHORT[part]} = {_written(defs[part], defs)}" for part in _EXPLAINED]
    lines.append("CONDITION = " + " or ".join(_written(defs[one], defs) for one in _CONDITIONS))
    often = {"RANK": _RANKS, "PART": _PARTS}
    text = "\n".join([*lines, *(f"{name} = {choices}" for name, choices in often.items())])
    for name, choices in often.items():
        text = text.replace(f":{choices}", f":{name}")
    return text


def _meaning(struct: Schema) -> str:
    return cast("str", struct["description"]).split("\n")[0].replace("``", "")


def _written(struct: Schema, defs: Schema) -> str:
    """A struct as one writes its type: {"goal":"pick","object":OBJECT,"at"?:SPOT}."""
    slots = [
        f'"{slot}"{"" if slot in struct["required"] else "?"}:{_type(one, defs)}'
        for slot, one in struct["properties"].items()
    ]
    return "{" + ", ".join(slots) + "}"


def _type(schema: Schema, defs: Schema) -> str:
    name = cast("str", schema.get("$ref", "")).removeprefix(_REF)
    if name in _SHORT:
        return _SHORT[name]
    if name in _CONDITIONS:
        return "CONDITION"
    if name:
        return _type(defs[name], defs)
    if "anyOf" in schema:
        return "|".join(dict.fromkeys(_type(one, defs) for one in schema["anyOf"]))
    if "enum" in schema:
        return "|".join(f'"{one}"' for one in schema["enum"])
    if schema["type"] == "array":
        return f"[{_type(schema['items'], defs)}, ...]"
    return "true|false" if schema["type"] == "boolean" else cast("str", schema["type"])
