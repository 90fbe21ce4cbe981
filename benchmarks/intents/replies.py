"""Replies as language models give them, with what each means: how many are read rightly.

The same few plans over and over, in the shapes that models of many sizes put them into: prose and
fences around the JSON, thoughts before it, near misses of the schema. Some may not be read at all:
names that nobody has, goals that do not exist, slots that are missing, numbers beyond all ranges.

    python -m benchmarks.intents.replies        # the table
"""

from __future__ import annotations

import json
from typing import Any, NamedTuple

from benchmarks.intents.endpoint import Reply, serving
from intents.context import Context
from intents.goals import from_builtins
from intents.grounding import Entity
from intents.language_model import Endpoint, LanguageModel
from intents.outcomes import Goals, Outcome, Question, Refusal
from intents.vocabulary import Someone, Spot, Thing, Vocabulary

HOME = Vocabulary.of(
    objects=[
        Thing(name="mug", color="red", category="dish"),
        Thing(name="mug", color="white", category="dish"),
        Thing(name="plate", category="dish"),
        Thing(name="crate", size="big"), Thing(name="crate", size="small"),
        Thing(name="tea towel"),
    ],
    places=["sideboard", "dishwasher", Spot(name="sofa", synonyms=("couch",)), "coffee table"],
    rooms=["study"],
    people=[Someone(name="Ada"), Someone(name="Ben")],
    categories={"dish": "dishes"},
)  # fmt: skip
THERE = (
    Entity(id="m1", name="mug", color="red", category="dish", at="coffee table"),
    Entity(id="m2", name="mug", color="white", category="dish", at="sofa"),
    Entity(id="p", name="plate", category="dish", at="coffee table"),
    Entity(id="c1", name="crate", size_m=(0.5, 0.5, 0.5)),
    Entity(id="c2", name="crate", size_m=(0.2, 0.2, 0.2)),
    Entity(id="t", name="tea towel", at="sofa"),
)

_MUG: dict[str, Any] = {"name": "mug", "color": "red"}
_TAKE: dict[str, Any] = {"goal": "pick", "object": _MUG}
_PUT: dict[str, Any] = {"goal": "place", "object": _MUG, "on": "sideboard"}
_PLATE: dict[str, Any] = {"goal": "place", "object": {"name": "plate"}, "in": "dishwasher"}
_BOTH = [_PUT, _PLATE]
_PLAN: dict[str, Any] = {"outcome": "goals", "goals": _BOTH}
_NONE = "nothing"


class Case(NamedTuple):
    """One reply.

    Attributes:
        shape: What is peculiar to it.
        said: The model's words.
        means: Goals, or "question", "refusal" or "nothing": it may not be read.
    """

    shape: str
    said: str
    means: list[dict[str, Any]] | str


def _plan(*goals: Any, **more: Any) -> str:
    return json.dumps({"outcome": "goals", "goals": list(goals), **more})


_JSON, _PRETTY = json.dumps(_PLAN), json.dumps(_PLAN, indent=2)

CASES = (
    # --- what is around it ---
    Case("as asked", _JSON, _BOTH),
    Case("on many lines", f"\n\n{_PRETTY}\n", _BOTH),
    Case("a fence", f"```json\n{_PRETTY}\n```", _BOTH),
    Case("a fence with another name", f"```JSON5\n{_PRETTY}\n```\n", _BOTH),
    Case("prose before", f"Sure! Here is the plan for tidying up:\n\n{_JSON}", _BOTH),
    Case("prose after", f"{_JSON}\n\nThis puts {{both}} things where they belong.", _BOTH),
    Case("prose and a fence", f"Here you go:\n```json\n{_PRETTY}\n```\nAnything else?", _BOTH),
    Case("thoughts", f"<think>\nThe mug {{red}} goes [there].\n</think>\n{_JSON}", _BOTH),
    Case("thoughts with a draft", f"<think>{_plan(_TAKE)} no, both.</think>{_JSON}", _BOTH),
    Case("thoughts that only end", f"First the mug, then the plate.\n</think>\n\n{_JSON}", _BOTH),
    Case("thinking", f"<thinking>Hm, {{two}} things.</thinking>\n{_JSON}", _BOTH),
    Case("channels", "<|channel|>analysis<|message|>Two things.<|end|><|start|>assistant"
         f"<|channel|>final<|message|>{_JSON}<|return|>", _BOTH),
    Case("an end token", f"{_JSON}<|im_end|>", _BOTH),
    Case("a draft, then the answer", f"Draft: {_plan(_TAKE)}\nFinal answer: {_JSON}", _BOTH),
    Case("a byte order mark", f"\ufeff{_JSON}", _BOTH),
    # --- JSON that is none ---
    Case("trailing commas", _PRETTY.replace("}\n    ]" if "}\n    ]" in _PRETTY else "}\n  ]",
         "},\n  ],"), _BOTH),
    Case("as Python writes it", repr({**_PLAN, "text": None}), _BOTH),
    Case("comments", _PRETTY.replace('"goals": [', '"goals": [  // the steps'), _BOTH),
    Case("bare keys", '{outcome: "goals", goals: [{goal: "go_to", place: "study"}]}',
         [{"goal": "go_to", "place": "study"}]),
    Case("a line each", f"{json.dumps(_PUT)}\n{json.dumps(_PLATE)}", _BOTH),
    Case("written out in a string", json.dumps(_JSON), _BOTH),
    # --- another frame ---
    Case("only the list", json.dumps(_BOTH), _BOTH),
    Case("one goal by itself", json.dumps(_PUT), [_PUT]),
    Case("one goal in place of a list", json.dumps({"outcome": "goals", "goals": _PUT}), [_PUT]),
    Case("no outcome", json.dumps({"goals": _BOTH}), _BOTH),
    Case("another outcome", json.dumps({"outcome": "success", "goals": _BOTH}), _BOTH),
    Case("remarks beside it", _plan(*_BOTH, explanation="It is tidy then.", confidence=0.9), _BOTH),
    Case("an empty text", _plan(*_BOTH, text=""), _BOTH),
    Case("steps", json.dumps({"steps": _BOTH}), _BOTH),
    Case("wrapped once more", json.dumps({"response": _PLAN}), _BOTH),
    Case("wrapped behind a thought", json.dumps({"thought": "Hm, {two}.", "result": _PLAN}), _BOTH),
    Case("steps by number", json.dumps({"outcome": "goals", "goals": {"1": _PUT, "2": _PLATE}}),
         _BOTH),
    Case("capital keys", json.dumps({"Outcome": "Goals", "Goals": _BOTH}), _BOTH),
    Case("a need for clarity", json.dumps(
        {"outcome": "needs_clarification", "text": "Which mug?"}), "question"),
    Case("a question", json.dumps({"outcome": "question", "text": "Which mug?"}), "question"),
    Case("a question under its name", json.dumps({"question": "Which mug?"}), "question"),
    Case("a refusal with no goals", json.dumps(
        {"outcome": "refusal", "goals": [], "text": "I cannot iron."}), "refusal"),
    Case("a reason for a refusal", json.dumps(
        {"outcome": "refusal", "reason": "I cannot iron."}), "refusal"),
    # --- goals and slots ---
    Case("a colour in the name", _plan({**_PUT, "object": {"name": "red mug"}}), [_PUT]),
    Case("the object as a string", _plan({**_PUT, "object": "the red mug"}), [_PUT]),
    Case("a size in the name", _plan({"goal": "pick", "object": {"name": "small crate"}}),
         [{"goal": "pick", "object": {"name": "crate", "size": "small"}}]),
    Case("a place in the name",
         _plan({"goal": "pick", "object": {"name": "plate on the coffee table"}}),
         [{"goal": "pick", "object": {"name": "plate", "at": "coffee table"}}]),
    Case("capitals", _plan({"goal": "Place", "object": {"name": "Mug", "color": "Red"},
                            "on": "Sideboard"}), [_PUT]),
    Case("names as identifiers", _plan({"goal": "place", "object": {"name": "tea_towel"},
                                        "on": "coffee_table"}),
         [{"goal": "place", "object": {"name": "tea towel"}, "on": "coffee table"}]),
    Case("a colour in brackets", _plan({**_PUT, "object": {"name": "Mug (red)"}}), [_PUT]),
    Case("a preposition", _plan({"goal": "pick", "object": {"name": "plate",
                                                            "at": "on the coffee table"}}),
         [{"goal": "pick", "object": {"name": "plate", "at": "coffee table"}}]),
    Case("from where", _plan({"goal": "pick", "object": "plate", "from": "coffee table"}),
         [{"goal": "pick", "object": {"name": "plate", "at": "coffee table"}}]),
    Case("articles", _plan({"goal": "go_to", "place": "the study"}),
         [{"goal": "go_to", "place": "study"}]),
    Case("a plural name", _plan({"goal": "place", "object": {"name": "mugs"}, "on": "sideboard"}),
         [{"goal": "place", "object": {"name": "mug", "count": "all"}, "on": "sideboard"}]),
    Case("the plural of a kind", _plan({"goal": "place", "object": {"category": "dishes"},
                                        "in": "dishwasher"}),
         [{"goal": "place", "object": {"category": "dish", "count": "all"}, "in": "dishwasher"}]),
    Case("a kind as a name", _plan({"goal": "find", "object": {"name": "dish"}}),
         [{"goal": "find", "object": {"category": "dish"}}]),
    Case("a synonym of a place", _plan({"goal": "go_to", "place": "couch"}),
         [{"goal": "go_to", "place": "sofa"}]),
    Case("a person as a string", _plan({"goal": "bring", "object": _MUG, "to": "ada"}),
         [{"goal": "bring", "object": _MUG, "to": {"name": "Ada"}}]),
    Case("the user", _plan({"goal": "bring", "object": _MUG, "to": "user"}),
         [{"goal": "bring", "object": _MUG, "to": {"who": "operator"}}]),
    Case("me as a person", _plan({"goal": "give", "object": {"held": True}, "to": {"name": "me"}}),
         [{"goal": "give", "object": {"held": True}, "to": {"who": "operator"}}]),
    Case("a place as an object", _plan({**_PUT, "on": {"name": "sideboard"}}), [_PUT]),
    Case("nulls", _plan({**_PUT, "in": None, "part": None,
                         "object": {**_MUG, "size": None, "held": False}}), [_PUT]),
    Case("empty strings", _plan({**_PUT, "in": "", "object": {**_MUG, "size": "", "at": ""}}),
         [_PUT]),
    Case("numbers as strings", _plan({"goal": "wait", "duration_s": "10"}),
         [{"goal": "wait", "duration_s": 10.0}]),
    Case("truth as a string", _plan({"goal": "pick", "object": {"name": "plate", "held": "false"}}),
         [{"goal": "pick", "object": {"name": "plate"}}]),
    Case("goals by other names", _plan({"goal": "fetch", "object": _MUG, "to": {"name": "Ada"}},
                                       {"goal": "navigate", "place": "study"}),
         [{"goal": "bring", "object": _MUG, "to": {"name": "Ada"}},
          {"goal": "go_to", "place": "study"}]),
    Case("camel case",
         _plan({"goal": "goTo", "place": "study"}, {"goal": "lookAt", "place": "left"}),
         [{"goal": "go_to", "place": "study"}, {"goal": "look_at", "place": "left"}]),
    Case("an action for a goal", _plan({"action": "pick", "object": _MUG}), [_TAKE]),
    Case("a call of a function", _plan({"name": "pick", "arguments": {"object": _MUG}}), [_TAKE]),
    Case("all in capitals", _plan({**_PUT, "goal": "PLACE"}), [_PUT]),
    Case("slots one level down", _plan({"goal": "place", "slots": {"object": _MUG,
                                                                 "on": "sideboard"}}), [_PUT]),
    Case("the goal as a key", _plan({"place": {"object": _MUG, "on": "sideboard"}}), [_PUT]),
    Case("slots by other names", _plan({"goal": "go_to", "destination": "study"},
                                       {"goal": "place", "item": _MUG, "to": "sideboard"},
                                       {"goal": "say", "text": "done"}),
         [{"goal": "go_to", "place": "study"}, _PUT, {"goal": "say", "what": "done"}]),
    Case("notes in a goal", _plan({**_PUT, "id": 1, "description": "put the mug away"}), [_PUT]),
    Case("only a gesture", _plan({"goal": "wave", "at": "Ada"}),
         [{"goal": "gesture", "kind": "wave", "at": "Ada"}]),
    # --- what may not be read ---
    Case("an invented thing", _plan({"goal": "pick", "object": {"name": "vacuum cleaner"}}), _NONE),
    Case("an invented colour", _plan({"goal": "pick", "object": {"name": "purple crate"}}), _NONE),
    Case("an invented place", _plan({"goal": "go_to", "place": "garage"}), _NONE),
    Case("an invented person", _plan({"goal": "greet", "person": {"name": "Zoe"}}), _NONE),
    Case("an invented goal", _plan({"goal": "vacuum", "place": "study"}), _NONE),
    Case("a missing slot", _plan({"goal": "pick"}), _NONE),
    Case("a slot too many", _plan({**_TAKE, "force_n": 900}), _NONE),
    Case("a number beyond", _plan({"goal": "go_to", "by": {"forward_m": "9000"}}), _NONE),
    Case("a goal that steers", _plan({"goal": "resume"}), _NONE),
    Case("no goals", _plan(), _NONE),
    Case("cut off", _JSON[: len(_JSON) // 2], _NONE),
    Case("only thoughts", "<think>The mug goes to the sideboard, and", _NONE),
    Case("only prose", "I would put the red mug on the sideboard.", _NONE),
)  # fmt: skip


def is_right(case: Case, outcome: Outcome | None) -> bool:
    """Whether it is what the reply means."""
    if isinstance(case.means, list):
        return isinstance(outcome, Goals) and outcome.goals == from_builtins(case.means)
    kind = {Question: "question", Refusal: "refusal"}.get(type(outcome), "nothing")
    return not isinstance(outcome, Goals) and kind == case.means


def examine() -> list[tuple[Case, Outcome | None, str]]:
    """Every case with what is made of it, and what was wrong with it."""
    with serving(Reply()) as server:
        model = LanguageModel(Endpoint(base_url=server.url, model="scripted"))
        made: list[tuple[Case, Outcome | None, str]] = []
        for case in CASES:
            server.replies = [Reply(content=case.said)]
            model.begin_mission()
            outcome = model("get this room into shape", HOME, Context(entities=THERE))
            made.append((case, outcome, model.trouble))
        model.close()
    return made


def main() -> None:
    """Print the table."""
    made = examine()
    for case, outcome, trouble in made:
        mark = "right" if is_right(case, outcome) else "WRONG"
        print(f"{mark}  {case.shape:32} {trouble or type(outcome).__name__}"[:150])
    right = [case for case, outcome, _ in made if is_right(case, outcome)]
    readable = sum(case.means != _NONE for case in CASES)
    read, kept = sum(c.means != _NONE for c in right), sum(c.means == _NONE for c in right)
    print(f"{read} of {readable} read rightly, {kept} of {len(CASES) - readable} refused rightly")


if __name__ == "__main__":
    main()
