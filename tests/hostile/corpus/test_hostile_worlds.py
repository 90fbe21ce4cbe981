"""Worlds: one value that is not, bombs, and floods."""

from functools import cache
from typing import Any

from tests.hostile.cases import Case, Expect, Make, link
from tests.hostile.corpus.shapes import (
    NAMES,
    NUMBERS,
    Raw,
    changed,
    document,
    field_of,
    flow,
    in_turn,
)
from tests.hostile.exam import exam

WORLD: dict[str, Any] = {
    "name": "study",
    "rooms": [
        {
            "id": "hall",
            "name": "hall",
            "at_m": [0, 0],
            "size_m": [6, 6],
            "walls": ["north", "west"],
            "doors": [{"wall": "west", "at_m": 0.5, "width_m": 0.95}],
            "wall_height_m": 2.2,
            "floor": "wood",
        }
    ],
    "spots": [{"id": "mark", "at_m": [0.2, -1.3], "yaw_deg": 0}],
    "furniture": [
        {
            "id": "table",
            "kind": "table",
            "at_m": [1.5, 0.5],
            "yaw_deg": 90,
            "size_m": [0.6, 1.2, 0.72],
            "color": "oak",
            "synonyms": ["desk"],
        },
        {"id": "rack", "kind": "shelf", "at_m": [-2.7, 0], "yaw_deg": 0, "boards_m": [0.6, 0.9]},
        {"id": "chair", "kind": "chair", "at_m": [1.5, -1.8], "movable": True, "mass_kg": 5},
    ],
    "objects": [
        {
            "id": "mug",
            "category": "cup",
            "color": "red",
            "shape": "cylinder",
            "size_m": [0.07, 0.07, 0.1],
            "mass_kg": 0.25,
            "on": "table",
            "at_m": [0.1, -0.2],
            "yaw_deg": 0,
        }
    ],
    "people": [
        {"id": "bob", "at_m": [-1.5, 2.0], "yaw_deg": -90, "height_m": 1.7, "color": "orange"}
    ],
    "categories": {"cup": "cups"},
    "start": {"at_m": [-0.8, -1.0], "yaw_deg": 45},
}

FRONTS: dict[str, tuple[str, ...]] = {
    "parse": ("parse", "--world", "w.yaml", "wave"),
    "check": ("mission", "check", "hello", "--world", "w.yaml"),
    "do": ("do", "--fast", "--world", "w.yaml", "wave"),
    "plan": ("mission", "plan", "hello", "--json", "--world", "w.yaml"),
    "view": ("view", "--world", "w.yaml", "--snapshot", "a.png"),
    "repl": ("repl", "--fast", "--world", "w.yaml"),
    "walk": ("walk", "--fast", "--for", "0.1", "--world", "w.yaml"),
    "eval": ("eval", "wave", "--world", "w.yaml", "--seeds", "1"),
    "json": ("do", "--fast", "--json", "--world", "w.yaml", "wave"),
}
_fronts = list(FRONTS)

LENGTHS = [
    "rooms.0.at_m.0", "rooms.0.size_m.1", "rooms.0.wall_height_m", "rooms.0.doors.0.at_m",
    "rooms.0.doors.0.width_m", "spots.0.at_m.1", "spots.0.yaw_deg", "furniture.0.at_m.0",
    "furniture.0.yaw_deg", "furniture.0.size_m.2", "furniture.1.boards_m.0", "furniture.2.mass_kg",
    "objects.0.size_m.0", "objects.0.mass_kg", "objects.0.at_m.1", "objects.0.yaw_deg",
    "people.0.at_m.0", "people.0.yaw_deg", "people.0.height_m", "start.at_m.0", "start.yaw_deg",
]  # fmt: skip
POSITIVE = [
    "rooms.0.size_m.0", "rooms.0.wall_height_m", "rooms.0.doors.0.width_m", "furniture.0.size_m.0",
    "furniture.1.boards_m.1", "furniture.2.mass_kg", "objects.0.size_m.2", "objects.0.mass_kg",
    "people.0.height_m",
]  # fmt: skip
VECTORS = [
    "rooms.0.at_m",
    "rooms.0.size_m",
    "objects.0.size_m",
    "furniture.1.boards_m",
    "start.at_m",
]
TEXTS = [
    "name", "rooms.0.id", "rooms.0.name", "rooms.0.floor", "rooms.0.walls.0", "furniture.0.id",
    "furniture.0.kind", "furniture.0.color", "furniture.0.synonyms.0", "objects.0.id",
    "objects.0.category", "objects.0.on", "people.0.id", "people.0.color",
]  # fmt: skip
WHOLES = ["name", "rooms", "spots", "furniture", "objects", "people", "categories", "start"]

_BAD_NAMES = {
    name: text for name, text in NAMES.items() if name not in {"markup", "format", "dots", "blank"}
}


def _world(name: str, path: str, new: Any, front: str, *, expect: Expect = Expect.REFUSED) -> Case:
    text = document(changed(WORLD, path, new))
    says = (field_of(path), "w.yaml:")
    return Case(
        name=name, argv=FRONTS[front], files={"w.yaml": text}, expect=expect,
        says=says if expect is Expect.REFUSED else (),
    )  # fmt: skip


def _turn(index: int) -> str:
    return _fronts[index % len(_fronts)]


@cache  # for two fronts each
def _many(key: str, count: int) -> str:
    entries: dict[str, list[dict[str, Any]]] = {
        "rooms": [
            {"id": f"r{i}", "at_m": [i % 100 * 5, i // 100 * 5], "size_m": [4, 4]}
            for i in range(count)
        ],
        "objects": [
            {**WORLD["objects"][0], "id": f"mug{i}", "at_m": [0.1, 0.001 * (i % 500)]}
            for i in range(count)
        ],
        "furniture": [
            {**WORLD["furniture"][0], "id": f"t{i}", "at_m": [i % 100, i // 100]}
            for i in range(count)
        ],
        "people": [{**WORLD["people"][0], "id": f"p{i}"} for i in range(count)],
        "spots": [{"id": f"s{i}", "at_m": [0, 0]} for i in range(count)],
    }
    rest = {**WORLD, "objects": [] if key == "furniture" else WORLD["objects"]}
    return document({**rest, key: entries[key]})


def _aliases(levels: int) -> str:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    for i in range(1, levels):
        lines.append(f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]")
    return "\n".join(lines) + "\n"


BOMBS: dict[str, str | bytes | Make] = {
    "aliases-laugh": _aliases(12),
    "aliases-as-name": "name: &n [*n]\n",
    "aliases-loop": "&a\nname: *a\n",
    "merge-keys": "name: a\nrooms:\n  - &r {id: a}\n" + "  - {<<: [*r, *r, *r, *r]}\n" * 2000,
    "flow-431-bytes": "rooms: " + "[" * 212 + "]" * 212 + "\n",
    "flow-anchors": "name: " + "[&a " * 100 + "]" * 100 + "\n",
    "flow-commas": "rooms: [" + "," * 1000 + "]\n",
    "flow-braces": "rooms: " + "{a: " * 3000 + "}" * 3000 + "\n",
    "flow-open": "rooms: " + "[{" * 200 + "\n",
    "flow-stars": "rooms: [" + "*a," * 200 + "]\n",
    "flow-ampersands": "rooms: " + "[&a [*a, " * 48 + "]" * 96 + "\n",
    "blocks-5000-deep": "".join(" " * i + "a:\n" for i in range(1500)),
    "dashes-deep": "rooms:\n" + "- " * 5000 + "a\n",
    "tag-python": "name: !!python/object/apply:os.system ['touch owned']\n",
    "tag-binary": "name: !!binary aGVsbG8=\n",
    "tag-unknown": "name: !secret x\n",
    "tag-timestamp": "name: 2020-01-01\nrooms: 2020-01-01 10:00:00\n",
    "tag-set": "rooms: !!set {a, b}\n",
    "tag-omap": "rooms: !!omap [a: 1]\n",
    "documents": "name: a\n---\nname: b\n",
    "directive": "%YAML 9.9\n---\nname: a\n",
    "directive-tag": "%TAG ! tag:x,2000:\n---\nname: !a b\n",
    "double-keys": "name: a\nname: b\n",
    "key-list": "? [a, b]\n: c\n",
    "key-number": "1: 2\n",
    "key-digits": f"{'9' * 5001}: 2\n",
    "key-null": "~: 2\n",
    "key-escape": '"\\x1b[2J": 2\n',
    "key-bidi": '"\\u202eemos": 2\n',
    "text": "just words\n",
    "number": "42\n",
    "list": "- a\n- b\n",
    "null": "~\n",
    "octal": "name: a\nrooms: 0o777\n",
    "sexagesimal": "name: a\nrooms: 190:20:30\n",
    "escaped-nul": 'name: "a\\0b"\n',
    "scalar-1-MB": "name: " + "x" * 1_000_000 + "\n",
    "flood-5-MB": "name: a\n" + "# comment\n" * 500_000,
}

FLOODS: dict[str, tuple[str, int]] = {
    "rooms-2000": ("rooms", 2000),
    "rooms-20000": ("rooms", 20_000),
    "objects-10000": ("objects", 10_000),
    "furniture-5000": ("furniture", 5000),
    "people-5000": ("people", 5000),
    "spots-20000": ("spots", 20_000),
}

CASES = [
    *(
        _world(f"number-{path}-{name}", path, new, _turn(index))
        for index, (path, name, new) in enumerate(in_turn(LENGTHS, NUMBERS, 4))
    ),
    *(
        _world(f"sign-{path}-{name}", path, Raw(text), _turn(index))
        for index, (path, (name, text)) in enumerate(
            (path, sign) for path in POSITIVE for sign in {"minus": "-1", "zero": "0"}.items()
        )
    ),
    *(
        _world(f"vector-{path}-{name}", path, new, _turn(index))
        for index, (path, name, new) in enumerate(
            in_turn(
                VECTORS,
                {
                    "empty": [],
                    "one": [1],
                    "many": [1] * 1000,
                    "map": {},
                    "word": "far",
                    "null": None,
                },
                3,
            )
        )
        if (path, name) not in {("furniture.1.boards_m", "one")}
    ),
    *(
        _world(f"text-{path}-{name}", path, new, _turn(index))
        for index, (path, name, new) in enumerate(in_turn(TEXTS, _BAD_NAMES, 3))
    ),
    *(
        _world(f"text-{path}-{name}", path, NAMES[name], _turn(index), expect=Expect.ENDS)
        for index, (path, name) in enumerate(
            (path, name)
            for path in ("name", "rooms.0.name")
            for name in ("markup", "format", "dots")
        )
    ),
    *(
        _world(f"type-{path}-{name}", path, new, _turn(index))
        for index, (path, name, new) in enumerate(
            in_turn(
                WHOLES,
                {"word": "abc", "number": 1, "map": {"a": 1}, "list": [[[]]], "null": None},
                3,
            )
        )
        if not (name == "null" or (path, name) in {("name", "word")})
    ),
    *(
        Case(
            name=f"bomb-{name}",
            argv=FRONTS[_turn(index)],
            files={"w.yaml": text},
            says=("w.yaml",),
        )
        for index, (name, text) in enumerate(BOMBS.items())
    ),
    *(
        Case(
            name=f"flood-{name}-{front}",
            argv=FRONTS[front],
            files={"w.yaml": _many(key, count)},
            expect=Expect.ENDS,
        )
        for name, (key, count) in FLOODS.items()
        for front in ("parse", "do")
    ),
    Case(
        name="synonyms-50000",
        argv=FRONTS["parse"],
        expect=Expect.ENDS,
        files={
            "w.yaml": document(
                changed(WORLD, "furniture.0.synonyms", [f"s{i}" for i in range(50_000)])
            )
        },
    ),
    Case(
        name="boards-5000",
        argv=FRONTS["do"],
        expect=Expect.ENDS,
        files={
            "w.yaml": document(
                changed(WORLD, "furniture.1.boards_m", [0.5 + 0.0001 * i for i in range(5000)])
            )
        },
    ),
    Case(
        name="doors-20000",
        argv=FRONTS["do"],
        expect=Expect.ENDS,
        files={
            "w.yaml": document(changed(WORLD, "rooms.0.doors", WORLD["rooms"][0]["doors"] * 20_000))
        },
    ),
    Case(name="name-of-another-file", argv=("parse", "--world", "../outside/secret", "wave")),
    Case(
        name="outside-as-world",
        argv=("parse", "--world", "../outside/secret.txt", "wave"),
        says=("secret.txt",),
    ),
    Case(
        name="outside-as-name",
        argv=("parse", "--world", "w.yaml", "wave"),
        files={"w.yaml": link("@OUTSIDE@/secret.txt")},
        says=("w.yaml",),
    ),
    Case(
        name="sound", argv=FRONTS["do"], files={"w.yaml": document(WORLD)}, expect=Expect.ACCEPTED
    ),
    *(
        Case(
            name=f"sound-{front}",
            argv=FRONTS[front],
            files={"w.yaml": flow(WORLD)},
            expect=Expect.ACCEPTED,
        )
        for front in ("parse", "check", "plan", "repl")
    ),
]
test_world = exam("worlds", CASES)
