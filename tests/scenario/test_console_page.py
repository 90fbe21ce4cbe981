"""The page in a real browser: what is seen, and that its STOP stops."""

from __future__ import annotations

import asyncio
import socket
import threading
import time
from contextlib import contextmanager
from pathlib import Path

import mujoco
import numpy as np
import pytest

from executive.frontends.composition_root import REALITY
from executive.frontends.console.address import HOST
from executive.frontends.console.desk import Desk
from executive.frontends.console.server import PageServer
from executive.frontends.recorded_place import scene_of
from executive.runs import run_folder
from robot.bringup import private_folder
from robot.model import description
from robot.model.body import BodyModel
from robot.se3 import SE3
from tests.fakes.browser import BROWSER, Browser
from tests.fakes.puppet_prompt import ERRAND
from tests.fakes.puppet_shell import puppet_shell
from tests.fakes.waiting import HANG_S

pytestmark = [
    pytest.mark.skipif(not BROWSER, reason="there is no Chromium here (apt install chromium)"),
    pytest.mark.slow,
]


@contextmanager
def served(folder: Path):
    """A console of a run's folder in a thread of its own."""
    ready, over = threading.Event(), threading.Event()
    console = PageServer(lambda: folder, scene_of)

    async def serve():
        async with await console.open(socket.create_server((HOST, 0))):
            following = asyncio.create_task(console.follow())
            ready.set()
            while not over.is_set():
                await asyncio.sleep(0.02)
            following.cancel()

    thread = threading.Thread(target=lambda: asyncio.run(serve()))
    thread.start()
    ready.wait()
    try:
        yield console
    finally:
        over.set()
        thread.join()


def until(so):
    limit_s = time.monotonic() + HANG_S
    while not so():
        assert time.monotonic() < limit_s
        time.sleep(0.02)


@pytest.fixture(scope="module")
def browser():
    with Browser() as made:
        yield made


@pytest.fixture
def shell(tmp_path):
    """A puppet at work on orders, with a desk."""
    said: list[str] = []
    folder = tmp_path / "run"
    run_folder.claim(folder)
    with puppet_shell(folder, said) as made:
        private = private_folder.create()
        with Desk(made, folder=folder, private=private.path):
            yield made
        private_folder.remove(private)


def ordered(page, text):
    page.click("#line")
    page.type(text)
    page.key("Enter")


def set_off(page):
    """Order what takes longer than any test, which is read back first."""
    ordered(page, ERRAND)
    page.wait("page.asks && page.asks.choices.includes('yes')")
    page.click("#ask button")


def test_orders_questions_and_a_stop(browser, shell):
    with served(shell.folder) as console:
        page = browser.page(console.url)
        page.wait("page.drawn > 0 && page.steers")
        ordered(page, "look at the cup")
        page.wait("!document.querySelector('#ask').hidden")
        assert "Which cup" in page.text("#ask")
        page.click("#ask button:last-child")
        page.wait("document.querySelector('#ask').hidden")
        set_off(page)
        page.wait("parts.jobs.some(([, , state]) => state == 'running')")
        page.wait("document.querySelector('#tree .running')")
        assert shell.stops == 0
        page.click("#stop")
        page.wait("parts.head.ending && parts.head.ending.code == 'cancelled'")
        assert shell.stops == 1
        assert "Stopping." in page.text("#talk")
        page.wait("document.querySelector('#badge').innerText == 'stopped'")
        page.key("Escape")  # the key, while nothing has the focus but the page
        until(lambda: shell.stops == 2)
        page.click("#line")
        page.type("half a line")
        page.key("Escape")  # and in the middle of a line
        until(lambda: shell.stops == 3)
        assert page.mistakes() == []


def test_a_phone_has_the_stop_in_reach_and_two_pages_see_the_same(browser, shell):
    with served(shell.folder) as console:
        phone = browser.page(console.url, width=390, height=844, mobile=True)
        phone.wait("page.drawn > 0 && page.steers")
        desktop = browser.page(console.url)
        desktop.wait("page.drawn > 0 && page.steers")
        set_off(desktop)
        phone.wait("parts.jobs.some(([, , state]) => state == 'running')")
        for tab in ("tree", "talk", "well", "jobs"):
            phone.click(f"[data-show={tab}]")
            box = phone.eval(
                "(() => { const b = document.querySelector('#stop').getBoundingClientRect();"
                "const top = document.elementFromPoint(b.x + b.width / 2, b.y + b.height / 2);"
                "return [b.left, b.top, b.right, b.bottom, top.id]; })()"
            )
            assert box[0] >= 0 and box[1] >= 0 and box[2] <= 390 and box[3] <= 844
            assert box[4] == "stop" and box[3] - box[1] >= 44  # nothing lies over it
        assert phone.eval("document.documentElement.scrollWidth") <= 390
        phone.click("#stop")
        desktop.wait("parts.head.ending && parts.head.ending.code == 'cancelled'")
        assert phone.mistakes() == desktop.mistakes() == []


def test_the_newest_line_stays_in_sight_until_somebody_scrolls_up(browser, shell):
    """Also while another tab is shown, and on a phone, whose list is short."""
    fill = (
        "((n) => showTalk(Array.from({{length: n}}, (_, k) => [k, 'answer', `line ${{k}}`, '']))"
        ")({lines})"
    )
    below = "talk.scrollHeight - talk.scrollTop - talk.clientHeight"
    with served(shell.folder) as console:
        page = browser.page(console.url, width=375, height=740, mobile=True)
        page.wait("page.drawn > 0 && page.steers")
        page.click("[data-show=tree]")
        page.eval(fill.format(lines=100))
        page.click("[data-show=talk]")
        page.wait(f"talk.clientHeight > 0 && {below} < 2")
        page.eval(fill.format(lines=150))
        page.wait(f"{below} < 2")
        page.eval("talk.scrollTop = 100")
        page.wait("!talk.follows")
        page.eval(fill.format(lines=200))
        assert page.eval("talk.scrollTop") == 100
        ordered(page, "where is the cup?")  # whose answer is to be seen
        page.wait(f"talk.follows && {below} < 2")


@pytest.mark.parametrize("end_s", [9.9, 235.8, 7271.0])
def test_a_phone_shows_the_whole_time(browser, shell, end_s):
    with served(shell.folder) as console:
        page = browser.page(console.url, width=375, height=740, mobile=True)
        page.wait("page.drawn > 0 && page.steers")
        apart = page.eval(
            f"(() => {{ motion.end = {end_s}; panels.time();"
            "const box = (id) => document.querySelector(id).getBoundingClientRect();"
            "const clock = document.querySelector('#clock');"
            "return [box('#clock').left - box('#slider').right, box('#now').left"
            " - box('#clock').right, box('#stop').left - box('#now').right,"
            " clock.clientWidth - clock.scrollWidth]; })()"
        )
        assert min(apart) >= 0


def test_a_page_without_the_token_says_so_and_shows_nothing(browser, shell):
    with served(shell.folder) as console:
        page = browser.page(console.url.partition("#")[0])
        page.wait("document.querySelector('#banner').innerText.includes('no longer valid')")
        assert page.eval("document.querySelector('#stop').hidden")


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
