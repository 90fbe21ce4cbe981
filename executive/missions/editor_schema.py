"""The types of `schema` as a JSON Schema, with which an editor completes and checks a mission."""

from __future__ import annotations

from typing import Any

import msgspec

from executive.missions.schema import STEPS, BranchNode, FaultNode, MissionRecord, StepNode


def json_schema() -> dict[str, Any]:
    """The JSON Schema of a mission file, for editors."""
    places: dict[type, dict[str, Any]] = {
        StepNode: {"$ref": "#/$defs/Step"},
        FaultNode: {"type": "object"},
        BranchNode: {
            "anyOf": [
                {"$ref": "#/$defs/Step"},
                {"type": "array", "items": {"$ref": "#/$defs/Step"}, "minItems": 1},
            ]
        },
    }

    def hook(kind: type) -> dict[str, Any]:
        return places[kind]

    (root,), parts = msgspec.json.schema_components(
        [MissionRecord], schema_hook=hook, ref_template="#/$defs/{name}"
    )
    refs, steps = msgspec.json.schema_components(
        list(STEPS.values()), schema_hook=hook, ref_template="#/$defs/{name}"
    )
    sentence = {"type": "string", "minLength": 1, "description": "A sentence in plain English."}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Mission of humanoid-executive",
        **root,
        "$defs": {**parts, **steps, "Step": {"anyOf": [sentence, *refs]}},
    }
