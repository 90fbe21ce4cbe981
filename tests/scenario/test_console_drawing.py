"""What a page of the console draws, in a real browser: bodies, plans, senses, the truth."""

from __future__ import annotations

import io
import math

import msgspec
import mujoco
import numpy as np
import pytest
from PIL import Image

from executive.frontends.composition_root import REALITY
from executive.journal import journal, motion, sensed
from executive.journal.motion import Moment, flat
from executive.journal.sensed import ArmMotion, Reach, Scan, Sensed
from executive.meaning import request
from robot import shots
from robot.model import description
from robot.model.body import BodyModel
from robot.reality import trail
from robot.reality.trail import Truth
from robot.se3 import SE3
from robot.shots import Shot
from tests.fakes.browser import BROWSER
from tests.fakes.served_page import served

pytestmark = [
    pytest.mark.skipif(not BROWSER, reason="there is no Chromium here (apt install chromium)"),
    pytest.mark.slow,
]


def test_the_picture_stands_as_mujoco_has_it(browser, shell):
    """Forward kinematics of the page against MuJoCo's, in a posture of which every joint counts."""
    robot = description.load("juno")
    body = BodyModel(robot)
    rng = np.random.default_rng(3)
    q = rng.uniform(body.lower_rad, body.upper_rad)
    X_WB = SE3.from_rpy(0.1, -0.2, 0.7, (1.0, -2.0, 0.8))
    data = body.data()
    body.write_base(data, X_WB)
    body.write_joints(data, q)
    mujoco.mj_kinematics(body.model, data)
    scene = REALITY.world("kitchen").scene(robot)
    with served(shell.folder) as console:
        page = browser.page(console.url)
        page.wait("page.scene")
        moment = {"t_s": 1e6, "base": [*X_WB.p, *X_WB.quat_wxyz], "q": q.tolist()}
        drawn = page.eval(
            f"(() => {{ const m = new Motion(); m.add({moment!r});"
            "return matricesAt(page.scene, m, 1e6, page.resting)"
            ".map((one) => one ? Array.from(one) : null); })()"
        )
    for place, one in enumerate(scene.bodies):
        if one.role != "robot":
            continue
        matrix = np.array(drawn[place]).reshape(4, 4).T
        there = data.body(one.id)
        np.testing.assert_allclose(matrix[:3, 3], there.xpos, atol=1e-4, err_msg=one.id)
        np.testing.assert_allclose(matrix[:3, :3], there.xmat.reshape(3, 3), atol=1e-4)


def test_a_body_of_no_parent_is_drawn_and_a_broken_picture_stops_nothing(browser, shell):
    with served(shell.folder) as console:
        page = browser.page(console.url)
        page.wait("page.drawn > 0 && page.steers")
        page.eval(
            "page.scene.bodies.find((one, n) => one.role === 'robot' && n !== page.scene.base)"
            ".parent = undefined; page.dirty = true"
        )
        drawn = page.eval("page.drawn")
        page.wait(f"page.drawn > {drawn}")
        assert page.mistakes() == []
        page.eval(
            "(() => { const draw = drawing.draw; page.dirty = true; drawing.draw = () => {"
            "drawing.draw = draw; throw new Error('no picture'); }; })()"
        )
        page.wait("page.problem === 'no picture'")
        page.eval("page.dirty = true")
        drawn = page.eval("page.drawn")
        page.wait(f"page.drawn > {drawn}")


def sights(folder):
    """A run in which the robot stands before a cup: what it sees, plans, and how hard it works."""
    where = request.setting(REALITY, "kitchen", robot="juno")
    robot, cup = where.description, SE3((0.75, 0.0, 0.62))
    base = flat(SE3((0.0, 0.0, 0.6)))
    q = robot.posture("nominal")
    moves = [
        Moment(t_s=0.05 * k, base=base, q=q, objects={"red_cup": flat(cup)}) for k in range(1, 100)
    ]
    arm = tuple(robot.indices("left_arm"))
    start = tuple(q[k] for k in arm)
    end = tuple(value + 0.4 for value in start)
    ranges = np.full(180, 1500, "<u2").tobytes()
    lines = [
        Sensed(
            t_s=1.0,
            torque=tuple(0.5 * one.torque_limit_nm for one in robot.motors.values()),
            heat=(25.0,) * len(q),
            scan=Scan(from_rad=-math.pi, step_rad=math.tau / 180, ranges_mm=ranges),
            sees=("red_cup",),
            source="oracle",
            way=((0.5, 0.0, 0.0), (1.0, 0.5, 0.4)),
            steps=((0, 0.2, 0.1, 0.0), (1, 0.4, -0.1, 0.0)),
        ),
        Sensed(
            t_s=2.0,
            torque=(1.0,) * len(q),
            reach=Reach(
                kind="pick", side="left", thing="red_cup", stance=(0.4, 0.0, 0.0),
                hand=(flat(SE3((0.6, 0.0, 0.6))), flat(cup), flat(SE3((0.75, 0.0, 0.7)))),
            ),
            arm=ArmMotion(
                side="left", motors=arm, times_s=(0.0, 1.0), positions=(start, end)
            ),
        ),
        Sensed(t_s=3.5, torque=(2.0,) * len(q), way=(), no_reach=True),
    ]  # fmt: skip
    event = {"n": 0, "t_s": 0.0, "event": "run", "text": "look", "world": "kitchen"}
    folder.mkdir()
    for name, told in (
        (journal.FILE, [msgspec.json.encode({**event, "robot": "juno", "seed": 0})]),
        (motion.FILE, map(motion.encode, moves)),
        (sensed.FILE, map(sensed.encode, lines)),
        (shots.COLOUR_FILE, map(shots.encode, (view(1.0, "colour"), view(2.0, "colour")))),
        (shots.DEPTH_FILE, map(shots.encode, (view(1.0, "depth"),))),
    ):
        (folder / name).write_bytes(b"".join(line + b"\n" for line in told))
    return folder


def view(t_s, kind):
    """A picture of one shade: green, or depth of 2 m."""
    data = io.BytesIO()
    colour = kind == "colour"
    shade = Image.new("RGB", (320, 240), (0, 160, 0)) if colour else Image.new("L", (320, 240), 128)
    shade.save(data, "JPEG" if colour else "PNG")
    return Shot(
        t_s=t_s, kind=kind, type="jpeg" if colour else "png", data=data.getvalue(), width=320,
        height=240, focal_px=(207.8, 207.8), centre_px=(159.5, 119.5),
        range_m=0.0 if colour else 4.0,
    )  # fmt: skip


COUNT = "(plans.marks.all.get('{}') || {{ count: 0 }}).count"


def test_plans_and_lidar_of_a_run_that_is_over_are_drawn_of_the_time_that_is_looked_at(
    browser, tmp_path
):
    """By clicks, and each layer can be switched off."""
    with served(sights(tmp_path / "run")) as console:
        page = browser.page(console.url)
        page.wait("page.drawn > 0 && sensing.torque.times.length === 3")

        def drawn(t_s, *names):
            page.eval(f"goTo({t_s})")
            page.eval("picture(performance.now())")
            return [page.eval(COUNT.format(name)) for name in names]

        floor, solid, arm, lidar = drawn(1.5, "floor", "solid", "arm", "lidar")
        assert floor > 0 and solid == arm == 0 and lidar == 180
        floor, solid, arm, _ = drawn(2.5, "floor", "solid", "arm", "lidar")
        assert floor > 0 and solid > 0 and arm > 2
        assert drawn(3.6, "solid", "arm", "lidar") == [0, 0, 0]  # over, and the scan is old
        # Where the hand is to end, by MuJoCo.
        robot = description.load("juno")
        body = BodyModel(robot)
        q = np.array(robot.posture("nominal"))
        q[robot.indices("left_arm")] += 0.4
        data = body.data()
        body.write_base(data, SE3((0.0, 0.0, 0.6)))
        body.write_joints(data, q)
        mujoco.mj_kinematics(body.model, data)
        drawn(2.5)
        ends = page.eval("Array.from(plans.armPath.at(-1).hand).slice(12, 15)")
        np.testing.assert_allclose(ends, data.site(robot.hands["left"].grasp_site).xpos, atol=1e-3)
        for layer, name in (("plans", "solid"), ("lidar", "lidar"), ("zones", "floor")):
            page.click("#layers summary")
            page.click(f"[data-layer={layer}]")
            page.click("#layers summary")
            assert drawn(2.4, name) == [0], layer
        assert page.mistakes() == []


def test_a_scan_is_drawn_where_it_hits(browser, tmp_path):
    with served(sights(tmp_path / "run")) as console:
        page = browser.page(console.url)
        page.wait("page.drawn > 0 && sensing.scan.times.length === 1")
        points = np.array(
            page.eval(
                "pointsOf(sensing.scan.values[0], siteAt(page.scene.lidar,"
                " matricesAt(page.scene, motion, 1.0, page.resting)))"
            )
        )
    robot = description.load("juno")
    body = BodyModel(robot)
    data = body.data()
    body.write_base(data, SE3((0.0, 0.0, 0.6)))
    body.write_joints(data, np.array(robot.posture("nominal")))
    mujoco.mj_kinematics(body.model, data)
    lidar = data.site(robot.sensors.lidar.site).xpos
    np.testing.assert_allclose(np.linalg.norm(points - lidar, axis=1), 1.5, atol=1e-3)
    np.testing.assert_allclose(
        points[90], lidar + np.array((1.5, 0.0, 0.0)), atol=2e-3
    )  # straight ahead
    assert points[135][1] > lidar[1] + 1.4  # to its left


def test_the_camera_shows_the_picture_of_the_time_with_a_box_around_what_it_sees(browser, tmp_path):
    with served(sights(tmp_path / "run")) as console:
        page = browser.page(console.url)
        page.wait("page.drawn > 0 && sensing.torque.times.length === 3")
        assert (
            page.eval("Object.keys(camera_.shots).length") == 0
        )  # costs nothing until it is shown
        page.eval("goTo(1.2)")
        page.click("#eye")
        page.wait("camera_.shots.colour && camera_.shots.colour.t_s === 1")
        page.wait("document.querySelector('#seen-note').innerText.includes('oracle')")
        yellow = (
            "(() => { const c = document.querySelector('#picture'), p = c.getContext('2d')"
            ".getImageData(0, 0, c.width, c.height).data, at = [];"
            "for (let k = 0; k < p.length; k += 4) "
            "if (p[k] > 240 && p[k + 1] > 190 && p[k + 2] < 60)"
            " at.push([k / 4 % c.width, Math.floor(k / 4 / c.width)]);"
            "return at; })()"
        )
        box = np.array(page.eval(yellow))
        # The cup's middle is inside of the box, by the camera's own model.
        robot = description.load("juno")
        body = BodyModel(robot)
        data = body.data()
        body.write_base(data, SE3((0.0, 0.0, 0.6)))
        body.write_joints(data, np.array(robot.posture("nominal")))
        mujoco.mj_kinematics(body.model, data)
        X_WC = body.site_pose(data, body.site_id(robot.sensors.camera.site))
        x, y, z = (X_WC.inverse() @ SE3((0.75, 0.0, 0.62))).p
        u, v = (1.5 * (centre + 207.8 * one / z) for centre, one in ((159.5, x), (119.5, y)))
        (left, top), (right, bottom) = box.min(axis=0), box.max(axis=0)
        assert left < u < right and top < v < bottom
        page.click("#seen-depth")
        page.wait("camera_.shots.depth")
        page.wait("document.querySelector('#seen-note').innerText.includes('depth to 4 m')")
        page.click("#layers summary")
        page.click("[data-layer=cloud]")
        page.wait(COUNT.format("cloud") + " === 320 * 240")
        page.eval("goTo(2.5)")
        page.wait("camera_.shots.colour.t_s === 2")
        page.click("#seen-close")
        assert page.eval("document.querySelector('#seen').hidden")
        assert page.mistakes() == []


def test_motors_show_torque_and_temperature_of_the_time(browser, tmp_path):
    with served(sights(tmp_path / "run")) as console:
        for how in ({}, {"width": 390, "height": 844, "mobile": True}):
            page = browser.page(console.url, **how)
            page.wait("page.drawn > 0 && sensing.torque.times.length === 3")
            page.click("[data-show=motors]")
            page.eval("goTo(1.2)")
            page.wait("document.querySelectorAll('.motor').length === 33")
            knee = ".motor:nth-child(4)"
            page.wait(f"document.querySelector('{knee}').innerText.includes('70 N m')")
            assert "25 °C" in page.text(knee)
            page.eval("goTo(4.0)")
            page.wait(f"document.querySelector('{knee}').innerText.includes('2.0 N m')")
            page.click(knee)
            assert page.text("#motor-name").casefold() == "left knee"
            wide = page.eval(
                "[document.documentElement.scrollWidth, document.querySelector('#motors')"
                ".scrollWidth - document.querySelector('#motors').clientWidth]"
            )
            assert wide[0] <= how.get("width", 1280) and wide[1] <= 0
            page.click("#eye")  # and the camera's picture can be put away again
            apart = page.eval(
                "document.querySelector('#seen').getBoundingClientRect().right"
                " - document.querySelector('#seen-close').getBoundingClientRect().right"
            )
            assert apart >= 0
            page.click("#seen-close")
            page.wait("document.querySelector('#seen').hidden")
            assert page.mistakes() == []


def test_the_truth_is_a_ghost_where_belief_errs_and_can_be_switched_off(browser, tmp_path):
    folder = sights(tmp_path / "run")
    base = flat(SE3((0.0, 0.0, 0.6)))
    there, away = flat(SE3((0.75, 0.0, 0.62))), flat(SE3((0.75, 0.1, 0.62)))
    truths = [
        Truth(t_s=0.05, base=base, objects={"red_cup": there, "bottle": away}),
        Truth(t_s=2.0, base=flat(SE3((0.1, 0.0, 0.6))), objects={"red_cup": away}),
    ]
    (folder / trail.FILE).write_bytes(b"".join(msgspec.json.encode(one) + b"\n" for one in truths))
    ghosts = "(page.real ? [...page.real.bodies].map((k) => page.scene.bodies[k].id) : [])"
    with served(folder) as console:
        page = browser.page(console.url)
        page.wait("page.drawn > 0 && truth.times.length === 2")
        page.eval("goTo(1.0)")
        page.wait(f"page.real && {ghosts}.length === 1")  # a thing that nobody has seen yet
        assert page.eval(ghosts) == ["bottle"]
        assert "truth of the simulation" in page.text("#real")
        page.eval("goTo(2.5)")
        page.wait(f"{ghosts}.includes('red_cup')")
        assert (
            page.eval(f"{ghosts}.length") > 10
        )  # and all of the robot, which is not where it thinks
        page.click("#layers summary")
        page.click("[data-layer=truth]")
        page.wait("page.real === null && document.querySelector('#real').hidden")
        assert page.mistakes() == []
