"""Joint maps and servo maps: sound ones with one value that is not, and none is opened unasked."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

from tests.hostile.cases import Case, fifo, folder, link, sparse
from tests.hostile.corpus.shapes import ESCAPE, NUMBERS, changed, document, flow, in_turn
from tests.hostile.exam import exam

_JUNO = Path(__file__).parents[3] / "robot" / "model" / "juno"
READ = ("motors", "read", "--map", "m.yaml")
_OF_A_MOTOR = (
    "model", "id", "lower_rad", "upper_rad", "velocity_limit_rad_s", "torque_limit_nm", "gear",
    "sign", "offset_rad",
)  # fmt: skip
FIELDS = {
    "can": (
        "rate_hz", "watchdog_s", "buses.left_leg.bitrate_hz", "joints.left_knee.bus",
        "joints.left_knee.reply_id", "joints.left_knee.ranges", "linkages",
        *(f"joints.left_knee.{key}" for key in _OF_A_MOTOR),
    ),
    "dynamixel": (
        "rate_hz", "watchdog_s", "others", "ports.head.baud_hz", "joints.head_yaw.port",
        *(f"joints.head_yaw.{key}" for key in _OF_A_MOTOR),
    ),
    "ethernet": (
        "rate_hz", "watchdog_s", "uplink_hz", "boards.left_leg.number", "boards.left_leg.port",
        "boards.left_leg.link_hz", "boards.left_leg.turn_s", "joints.left_knee.board", "linkages",
        *(f"joints.left_knee.{key}" for key in _OF_A_MOTOR),
    ),
    "pwm": (
        "rate_hz", "watchdog_s", "others", "chips.hat.bus", "chips.hat.address",
        "chips.hat.frame_hz", "chips.hat.oscillator_hz", "chips.hat.bus_hz", "joints.head_yaw.chip",
        "joints.head_yaw.pulse_us", "joints.head_yaw.travel_rad", "joints.head_yaw.start_rad",
        *(f"joints.head_yaw.{key}" for key in _OF_A_MOTOR),
    ),
}  # fmt: skip
PLACES = {
    "can": "buses.left_leg.channel", "dynamixel": "ports.head.device",
    "ethernet": "boards.left_leg.address", "pwm": "chips.hat.emulated",
}  # fmt: skip
DEVICES = {
    "zero": "/dev/zero", "terminal": "/dev/tty", "up": "../../../../dev/zero", "escape": ESCAPE,
    "outside": "@OUTSIDE@/secret.txt", "url": "socket://example.org:80", "long": "d" * 10_000,
    "quote": 'can0"]\nhooks = ["x',
}  # fmt: skip


def _maps() -> Iterator[tuple[str, str, str]]:
    for kind, fields in FIELDS.items():
        sound: dict[str, Any] = yaml.safe_load((_JUNO / f"{kind}.yaml").read_text())
        for path, name, value in in_turn(list(fields), NUMBERS, 3):
            with_it = sound
            if path.rpartition(".")[2] not in _at(sound, path.rpartition(".")[0]):
                with_it = changed(sound, path, 0)
            yield kind, f"{path}-{name}", document(changed(with_it, path, value))


def _at(value: Any, path: str) -> Any:
    for key in path.split(".") if path else ():
        value = value[key]
    return value


def _devices() -> Iterator[tuple[str, str]]:
    for kind, path in PLACES.items():
        sound = yaml.safe_load((_JUNO / f"{kind}.yaml").read_text())
        for name, device in DEVICES.items():
            yield f"{kind}-{name}", document(changed(sound, path, device))


CASES = [
    *(
        Case(name=f"field-{kind}.{name}", argv=READ, files={"m.yaml": text})
        for kind, name, text in _maps()
    ),
    *(
        Case(name=f"device-{name}", argv=READ, files={"m.yaml": text})
        for name, text in _devices()
    ),
    *(
        Case(name=f"odd-{name}", argv=READ, files={"m.yaml": make})
        for name, make in {
            "fifo": fifo, "folder": folder, "zero": link("/dev/zero"), "endless": sparse(10 << 30),
            "outside": link("@OUTSIDE@/secret.txt"), "deep": "[" * 100_000, "null": "null",
            "alias": "a: &a [*a]\n", "list": flow([1, 2]),
        }.items()
    ),
    *(
        Case(name=f"flaw-{number}", argv=("motors", "read", "--emulated", "--fail", flaw))
        for number, flaw in enumerate(("", "=", "head_yaw", "=silent", "head_yaw=" + ESCAPE,
                                       ESCAPE + "=silent", "head_yaw=" + "x" * 50_000))
    ),
    *(
        Case(name=f"joint-{number}", argv=("motors", "jog", "--by", "0.1", "--emulated", "--", joint))
        for number, joint in enumerate(("", ESCAPE, "../x", "x" * 50_000, "head_yaw\nDone."))
    ),
]  # fmt: skip
test_motors = exam("motors", CASES)
