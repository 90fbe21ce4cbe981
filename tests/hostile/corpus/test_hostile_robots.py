"""Robots: figures that no machine has, models that are bombs, meshes from next door."""

from typing import Any

import yaml

from tests.hostile.cases import OUTSIDE, Case, Expect, Make, fifo, folder, link, sparse
from tests.hostile.corpus.shapes import (
    NAMES,
    NUMBERS,
    Raw,
    changed,
    document,
    field_of,
    in_turn,
)
from tests.hostile.exam import ROOT, exam

MODEL = ROOT / "robot" / "model" / "juno"
ROBOT: dict[str, Any] = yaml.safe_load((MODEL / "juno.yaml").read_text())
MJCF = (MODEL / "juno.xml").read_text()
COURIER: dict[str, Any] = yaml.safe_load(
    (ROOT / "examples" / "robot_courier" / "courier.yaml").read_text()
)
OVERLAY = (ROOT / "examples" / "robot_courier" / "overlay.xml").read_text()

FRONTS: dict[str, tuple[str, ...]] = {
    "export": ("model", "export", "--urdf", "a.urdf", "--robot", "r.yaml"),
    "doctor": ("doctor", "--robot", "r.yaml"),
    "do": ("do", "--fast", "--robot", "r.yaml", "wave"),
    "walk": ("walk", "--fast", "--for", "0.1", "--robot", "r.yaml"),
    "check": ("mission", "check", "hello", "--robot", "r.yaml"),
    "doctor-json": ("doctor", "--json", "--robot", "r.yaml"),
    "repl": ("repl", "--fast", "--robot", "r.yaml"),
    "view": ("view", "--robot", "r.yaml", "--snapshot", "a.png"),
    "eval": ("eval", "wave", "--robot", "r.yaml", "--seeds", "1"),
}
_fronts = list(FRONTS)


def _numbers(value: Any, path: str = "") -> list[str]:
    """Paths of all numbers; of a list the first only."""
    if isinstance(value, bool | str) or value is None:
        return []
    if isinstance(value, int | float):
        return [path]
    items = value.items() if isinstance(value, dict) else list(enumerate(value))[:1]
    prefix = f"{path}." if path else ""
    return [found for key, inner in items for found in _numbers(inner, f"{prefix}{key}")]


def _one_of_each(paths: list[str]) -> list[str]:
    """A path of each field: the motors are alike, and so are left and right."""
    found = {(path.split(".")[0], field_of(path)): path for path in paths}
    return [*found.values()]


FIELDS = _one_of_each(
    [path for path in _numbers(ROBOT) if not path.startswith(("postures", "getting_up.motions"))]
)
FIELDS += ["postures.nominal.left_knee", "postures.carry.left_elbow"]
FIELDS += [path for path in _numbers(ROBOT["getting_up"], "getting_up") if "posture" not in path]
TORQUE = "motors.left_knee.torque_limit_nm"
LIMITS: dict[str, tuple[str, Any]] = {
    "torque-1e12": (TORQUE, 1e12),
    "torque-minus": (TORQUE, -139),
    "torque-zero": (TORQUE, 0),
    "torque-subnormal": (TORQUE, Raw("1.0e-320")),
    "speed-zero": ("motors.left_knee.velocity_limit_rad_s", 0),
    "kp-1e300": ("motors.left_knee.kp", Raw("1.0e+300")),
    "kp-minus": ("motors.left_knee.kp", -200),
    "kd-minus": ("motors.left_knee.kd", -5),
    "beams-2e9": ("sensors.lidar.beams", 2_000_000_000),
    "beams-zero": ("sensors.lidar.beams", 0),
    "beams-minus": ("sensors.lidar.beams", -180),
    "beams-fraction": ("sensors.lidar.beams", 1.5),
    "camera-width-1e6": ("sensors.camera.width", 1_000_000),
    "camera-height-zero": ("sensors.camera.height", 0),
    "camera-fovy-7": ("sensors.camera.fovy_rad", 7),
    "range-minus": ("sensors.lidar.range_m", -1),
    "noise-minus": ("sensors.imu.gyro_noise_rad_s", -1),
    "step-zero": ("walking.single_support_s", 0),
    "step-tiny": ("walking.single_support_s", Raw("1.0e-9")),
    "step-year": ("walking.single_support_s", 3.2e7),
    "width-minus": ("walking.stance_width_m", -0.2),
    "base-zero": ("walking.base_height_m", 0),
    "base-100-m": ("walking.base_height_m", 100),
    "speed-100-m-s": ("walking.max_forward_m_s", 100),
    "friction-minus": ("balance.friction", -1),
    "friction-zero": ("balance.friction", 0),
    "task-1e300": ("balance.tasks.height.kp_1_s2", Raw("1.0e+300")),
    "task-minus": ("balance.tasks.height.kp_1_s2", -80),
    "knee-1e6": ("postures.nominal.left_knee", 1_000_000),
    "arm-speed-zero": ("arms.speed_rad_s", 0),
    "arm-speed-1e9": ("arms.speed_rad_s", 1e9),
    "lift-minus": ("arms.max_lift_kg", -1),
    "battery-zero": ("battery.capacity_wh", 0),
    "battery-efficiency-2": ("battery.efficiency", 2),
    "heat-constant-zero": ("heating.time_constant_s", 0),
    "rate-zero": ("sensors.lidar.rate_hz", 0),
    "quota-2e9": ("handling.reaching.leans.0.quota", 2_000_000_000),
    "leans-100000": ("handling.reaching.leans", [{"ahead_m": [0.3], "cost": 0.0, "quota": 1}] * 100_000),
    "aside-100000": ("handling.reaching.aside_m", [0.06] * 100_000),
    "motors-none": ("motors", {}),
    "groups-none": ("groups", {}),
    "feet-none": ("feet", {}),
    "feet-one": ("feet", {"left": ROBOT["feet"]["left"]}),
    "postures-none": ("postures", {}),
    "postures-100000": ("postures", {"nominal": {}, **{f"p{i}": {} for i in range(100_000)}}),
    "mjcf-outside": ("mjcf", f"{OUTSIDE}/secret.txt"),
    "mjcf-passwd": ("mjcf", "/etc/passwd"),
    "mjcf-dots": ("mjcf", "../outside/secret.txt"),
    "mjcf-zeros": ("mjcf", "/dev/zero"),
    "mjcf-memory": ("mjcf", "/proc/self/mem"),
    "mjcf-folder": ("mjcf", "."),
    "mjcf-itself": ("mjcf", "r.yaml"),
    "mjcf-empty": ("mjcf", ""),
    "mjcf-nul": ("mjcf", "a\x00b"),
    "mjcf-long": ("mjcf", "a" * 10_000),
    "overlay-passwd": ("overlay", "/etc/passwd"),
    "overlay-zeros": ("overlay", "/dev/zero"),
    "published-root": ("published", {"places": ["/"], "cure": "none", "source": "x"}),
    "published-escape": ("published", {"places": ["nowhere"], "cure": NAMES["escape"], "source": "x"}),
    "published-100000": ("published", {"places": ["nowhere"] * 100_000, "cure": "x", "source": "x"}),
    "drivers-outside": ("drivers", {"motors": "os.system", "imu": "../../etc/passwd"}),
    "joint-escape": ("motors.left_knee.joint", NAMES["escape"]),
    "joint-unknown": ("motors.left_knee.joint", "nobody"),
    "joint-twice": ("motors.left_knee.joint", "right_knee"),
    "source-bidi": ("motors.left_knee.source", NAMES["bidi"]),
    "group-unknown": ("groups.left_leg", ["nobody"]),
    "group-twice": ("groups.left_leg", ["left_knee"] * 6),
    "group-100000": ("groups.head", ["head_yaw"] * 100_000),
    "site-unknown": ("sensors.imu.site", "nobody"),
    "name-dots": ("name", "../../etc"),
    "name-empty": ("name", ""),
    "name-newline": ("name", "a\nb"),
}  # fmt: skip

HEAD = '<mujoco model="bomb"><worldbody>'
TAIL = "</worldbody></mujoco>"
ENTITIES = (
    '<!DOCTYPE m [<!ENTITY a "aaaaaaaaaa"><!ENTITY b0 "&a;&a;">'
    + "".join(f'<!ENTITY b{i} "{f"&b{i - 1};" * 10}">' for i in range(1, 10))
    + "]><mujoco><custom><text name='n' data='&b9;'/></custom></mujoco>"
)
MODELS: dict[str, str | bytes | Make] = {
    "fifo": fifo,
    "folder": folder,
    "empty": "",
    "link-passwd": link("/etc/passwd"),
    "link-zeros": link("/dev/zero"),
    "sparse-10-GB": sparse(10 << 30, b"<mujoco>"),
    "text": "not XML at all",
    "open": "<mujoco><worldbody>",
    "other-root": "<html><body/></html>",
    "none": HEAD + TAIL,
    "replicate-3e6": HEAD
    + '<replicate count="3000000"><body><geom size="1"/></body></replicate>'
    + TAIL,
    "replicate-nested": HEAD
    + '<replicate count="200">' * 4
    + '<geom size="1"/>'
    + "</replicate>" * 4
    + TAIL,
    "replicate-minus": HEAD + '<replicate count="-1"><geom size="1"/></replicate>' + TAIL,
    "replicate-2e9": HEAD + '<replicate count="2147483647"><geom size="1"/></replicate>' + TAIL,
    "composite-cable": HEAD
    + '<composite type="cable" count="2000000 1 1" size="1e5"><joint kind="main"/>'
    '<geom type="capsule" size=".01"/></composite>' + TAIL,
    "flexcomp": HEAD
    + '<flexcomp name="f" type="grid" count="500 500 500" spacing="1 1 1" mass="1"/>'
    + TAIL,
    "hfield": '<mujoco><asset><hfield name="h" nrow="100000" ncol="100000" size="1 1 1 1"/></asset>'
    "<worldbody/></mujoco>",
    "texture": '<mujoco><asset><texture name="t" type="2d" builtin="flat" width="100000" height="100000"/>'
    "</asset><worldbody/></mujoco>",
    "texture-127-MB": '<mujoco><asset><texture name="t" type="2d" builtin="checker" width="6500" '
    'height="6500"/></asset><worldbody/></mujoco>',
    "memory": '<mujoco><size memory="100G"/><worldbody/></mujoco>',
    "nuser": '<mujoco><size nuser_body="100000000"/><worldbody><body/></worldbody></mujoco>',
    "keyframes": '<mujoco><size nkey="2000000000"/><worldbody/></mujoco>',
    "camera-resolution": HEAD + '<camera name="c" resolution="2000000000 2000000000"/>' + TAIL,
    "text-asset": f'<mujoco><custom><text name="{"n" * 1_000_000}" data="x"/></custom></mujoco>',
    "bodies-20000": HEAD + '<body><geom size="1"/></body>' * 20_000 + TAIL,
    "deep-5000": HEAD + "<body>" * 5000 + '<geom size="1"/>' + "</body>" * 5000 + TAIL,
    "include-passwd": '<mujoco><include file="/etc/passwd"/></mujoco>',
    "include-secret": '<mujoco><include file="../outside/secret.txt"/></mujoco>',
    "include-itself": '<mujoco><include file="model.xml"/></mujoco>',
    "include-zeros": '<mujoco><include file="/dev/zero"/></mujoco>',
    "mesh-passwd": '<mujoco><asset><mesh name="m" file="/etc/passwd"/></asset></mujoco>',
    "mesh-secret": '<mujoco><compiler meshdir="../outside"/><asset><mesh name="m" file="secret.txt"/>'
    "</asset></mujoco>",
    "mesh-zeros": '<mujoco><asset><mesh name="m" file="/dev/zero" content_type="model/stl"/></asset></mujoco>',
    "texture-passwd": '<mujoco><asset><texture name="t" type="2d" file="/etc/passwd"/></asset></mujoco>',
    "hfield-secret": '<mujoco><asset><hfield name="h" size="1 1 1 1" file="../outside/secret.txt"/></asset>'
    "</mujoco>",
    "model-secret": '<mujoco><asset><model name="m" file="../outside/secret.txt"/></asset></mujoco>',
    "skin-secret": '<mujoco><asset><skin name="s" file="../outside/secret.txt"/></asset></mujoco>',
    "plugin": '<mujoco><extension><plugin plugin="mujoco.elasticity.cable"/></extension></mujoco>',
    "plugin-unknown": '<mujoco><extension><plugin plugin="../outside/owned.so"/></extension></mujoco>',
    "entities": ENTITIES,
    "entity-passwd": '<!DOCTYPE m [<!ENTITY x SYSTEM "file:///etc/passwd">]><mujoco model="a">&x;</mujoco>',
    "name-escape": f'<mujoco model="{"&#x9b;31m"}"><worldbody><body name="&#x202e;x"/></worldbody></mujoco>',
    "unknown-element": f"<mujoco><{'x' * 5000}/></mujoco>",
    "numbers-nan": MJCF.replace("<worldbody>", '<option gravity="nan nan nan"/><worldbody>', 1),
    "timestep-zero": MJCF.replace("<worldbody>", '<option timestep="0"/><worldbody>', 1),
    "timestep-1e-12": MJCF.replace("<worldbody>", '<option timestep="1e-12"/><worldbody>', 1),
    "timestep-minus": MJCF.replace("<worldbody>", '<option timestep="-1"/><worldbody>', 1),
    "mass-nan": MJCF.replace("<worldbody>", '<worldbody><geom size="nan" mass="nan"/>', 1),
    "mass-1e300": MJCF.replace("</worldbody>", '<body><freejoint/><geom size="1" mass="1e300"/></body></worldbody>', 1),
    "replicate-in-juno": MJCF.replace(
        "</worldbody>", '<replicate count="3000000"><geom size="1"/></replicate></worldbody>', 1
    ),
    "mesh-in-juno": MJCF.replace(
        "<worldbody>", '<asset><mesh name="m" file="../outside/secret.txt"/></asset><worldbody>', 1
    ),
}  # fmt: skip


HARMLESS = {
    "limit-name-dots", "timestep-zero", "timestep-1e-12", "timestep-minus", "unknown-body", "option",
    "sound",
}  # fmt: skip
"""Refused or not: a name is no path, the time step is the program's own, a body more hurts nobody."""


def _robot(name: str, path: str, new: Any, front: str) -> Case:
    return Case(
        name=name,
        argv=FRONTS[front],
        files={"r.yaml": document(changed(ROBOT, path, new)), "juno.xml": MJCF},
        expect=Expect.ENDS if name in HARMLESS else Expect.REFUSED,
        says=(field_of(path), "r.yaml", *([new] if isinstance(new, str) and new else [])),
    )


def _model(name: str, content: str | bytes | Make, front: str) -> Case:
    return Case(
        name=f"model-{name}",
        argv=FRONTS[front],
        files={"r.yaml": document({**ROBOT, "mjcf": "model.xml"}), "model.xml": content},
        expect=Expect.ENDS if name in HARMLESS else Expect.REFUSED,
        says=("model.xml", "r.yaml"),
    )


def _front(index: int) -> str:
    return _fronts[index % len(_fronts)]


def _overlay(name: str, content: str, front: str) -> Case:
    robot = {**COURIER, "published": {**COURIER["published"], "places": [str(MODEL)]}}
    return Case(
        name=f"overlay-{name}",
        argv=FRONTS[front],
        files={"r.yaml": document(robot), "overlay.xml": content},
        expect=Expect.ENDS if name in HARMLESS else Expect.REFUSED,
        says=("overlay.xml", "r.yaml"),
    )


OVERLAYS: dict[str, str] = {
    "sound": OVERLAY,
    "replicate": '<mujoco><worldbody><body name="torso"><replicate count="3000000">'
    '<geom size="1"/></replicate></body></worldbody></mujoco>',
    "include-passwd": '<mujoco><include file="/etc/passwd"/></mujoco>',
    "mesh-secret": '<mujoco><asset><mesh name="m" file="@OUTSIDE@/secret.txt"/></asset></mujoco>',
    "unknown-body": '<mujoco><worldbody><body name="&#x9b;31m"/></worldbody></mujoco>',
    "deep": "<mujoco><worldbody>" + "<body>" * 5000 + "</body>" * 5000 + "</worldbody></mujoco>",
    "entities": ENTITIES,
    "nan": '<mujoco><worldbody><body name="torso"><geom size="nan" mass="nan"/></body></worldbody></mujoco>',
    "option": '<mujoco><option timestep="0"/></mujoco>',
    "empty": "",
}  # fmt: skip

CAMERAS: dict[str, tuple[str, str | Make]] = {
    "pipe": ("film", fifo),
    "listens": ("tcp:/127.0.0.1:9913?listen=1", ""),
    "play-list": ("film", "#EXTM3U\n#EXTINF:1,\nfile:///dev/zero\n"),
    "digits": ("%0999999999d.png", ""),
    "device": ("/dev/../dev/zero", ""),
    "outside": (f"{OUTSIDE}/secret.txt", ""),
}

CASES = [
    *(
        _robot(f"number-{path}-{name}", path, new, _front(index))
        for index, (path, name, new) in enumerate(
            in_turn(FIELDS, {key: NUMBERS[key] for key in NUMBERS if key != "list-of-lists"}, 1)
        )
    ),
    *(
        _robot(f"limit-{name}", path, new, _front(index))
        for index, (name, (path, new)) in enumerate(LIMITS.items())
    ),
    *(
        _model(name, content, ("export", "doctor", "do", "check")[index % 4])
        for index, (name, content) in enumerate(MODELS.items())
    ),
    *(
        _overlay(name, content, ("doctor", "export")[index % 2])
        for index, (name, content) in enumerate(OVERLAYS.items())
    ),
    *(
        Case(
            name=f"camera-{name}",
            argv=FRONTS["do"],
            files={
                "r.yaml": document({**ROBOT, "drivers": {**ROBOT["drivers"], "rgbd": "uvc"}}),
                "juno.xml": MJCF,
                "uvc.yaml": document({"device": device}),
                "film": what,
            },
            expect=Expect.ENDS,
            cpu_s=30,
        )
        for name, (device, what) in CAMERAS.items()
    ),
    Case(
        name="sound",
        argv=FRONTS["doctor"],
        files={"r.yaml": document(ROBOT), "juno.xml": MJCF},
        expect=Expect.ACCEPTED,
    ),
    *(
        Case(name=f"name-{name}-{front}", argv=(*FRONTS[front][:-1], text, *FRONTS[front][:0]))
        for front in ("export", "doctor", "walk", "check")
        for name, text in {"dots": "../juno", "escape": NAMES["escape"], "empty": ""}.items()
    ),
]
test_robot = exam("robots", CASES)
