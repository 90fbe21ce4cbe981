"""The page in a real browser: what is seen, and that its STOP stops."""

from __future__ import annotations

import time
from contextlib import ExitStack
from pathlib import Path

import pytest

from executive.frontends.console import beside
from executive.frontends.console.address import url
from executive.runs import run_folder
from tests.fakes.browser import BROWSER, Browser
from tests.fakes.puppet_prompt import ERRAND
from tests.fakes.puppet_shell import puppet_shell
from tests.fakes.served_page import served
from tests.fakes.waiting import HANG_S

pytestmark = [
    pytest.mark.skipif(not BROWSER, reason="there is no Chromium here (apt install chromium)"),
    pytest.mark.slow,
]


def until(so):
    limit_s = time.monotonic() + HANG_S
    while not so():
        assert time.monotonic() < limit_s
        time.sleep(0.02)


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


@pytest.mark.parametrize(
    "end_s",
    [
        pytest.param(9.9, marks=pytest.mark.rest),
        pytest.param(235.8, marks=pytest.mark.rest),
        7271.0,
    ],
)
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


@pytest.mark.parametrize("stopped", [True, False])
def test_a_run_that_has_ended_is_told_and_is_no_alarm(browser, tmp_path, stopped):
    folder = tmp_path / "run"
    run_folder.claim(folder)
    with ExitStack() as stack:
        stack.enter_context(beside.shown(folder, wanted=True))
        with puppet_shell(folder, []) as shell:
            address = beside._kept(folder)
            assert address is not None
            page = browser.page(url(address))
            page.wait("page.live")
            for line in (ERRAND, "yes") if stopped else ("wave",):
                shell.line(line)
            page.wait("parts.jobs.some(([, , state]) => state != 'waiting')")
            if stopped:
                shell.stop("STOP was pressed on the page")
            shell.robot.wait()
    page.wait("!page.linked")
    banner = page.text("#banner")
    assert "The run is over, and nothing moves any more: " in banner
    assert ("it was done" in banner) is not stopped
    assert "No connection" not in banner
    assert page.eval("document.querySelector('#stop').hidden")


def test_a_fault_is_injected_by_a_press_and_by_the_form(browser, shell):
    with served(shell.folder) as console:
        page = browser.page(console.url)
        page.wait("page.drawn > 0 && page.steers")
        injected = []
        shell.robot.inject = injected.append
        page.click("#tab-faults")
        page.click("#fault-quick button")
        until(lambda: injected == [{"fault": "shove", "strength_n_s": 8}])
        page.eval(
            "(() => { const kind = document.querySelector('#fault-kind'); kind.value = 'heat';"
            "kind.dispatchEvent(new Event('change')); })()"
        )
        page.click("#fault-form button")  # what is needed is not filled in: nothing is sent
        page.click("#fault-keys input[name=motor]")
        page.type("left_knee")
        page.click("#fault-keys input[name=temperature_c]")
        page.type("95")
        page.click("#fault-form button")
        until(
            lambda: injected[1:] == [{"fault": "heat", "motor": "left_knee", "temperature_c": 95}]
        )
        page.wait("document.querySelector('#talk').textContent.includes('Injected: heat')")
        assert page.mistakes() == []


def test_a_stop_that_is_pressed_without_a_connection_is_sent_once_there_is_one(browser, shell):
    with served(shell.folder) as console:
        page = browser.page(console.url)
        page.wait("page.drawn > 0 && page.steers")
        page.eval("link.socket.close(); stop()")
        until(lambda: shell.stops == 1)
        page.wait("page.linked && page.unsent === 0")
        page.eval("page.unsent = performance.now() - UNSENT_MS - 1; link.socket.close()")
        page.wait("!page.linked")
        page.wait("page.linked")  # what was pressed long ago is no wish of now
        assert shell.stops == 1


SPOKEN = Path(__file__).parents[1] / "unit" / "intents" / "speech" / "sounds" / "command.wav"


def test_what_is_said_into_the_page_is_read_back_and_done(shell):
    """By a browser whose microphone is a recording."""
    microphone = (
        "--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream",
        f"--use-file-for-fake-audio-capture={SPOKEN}%noloop",
    )  # fmt: skip
    with Browser(*microphone) as made, served(shell.folder) as console:
        page = made.page(console.url)
        page.wait("page.drawn > 0 && page.steers")
        page.hold("#mic", 3.5)
        page.wait("page.asks && page.asks.choices.includes('yes')")
        # What was said may be drawn after the question that it leads to.
        page.wait("document.querySelector('#talk').textContent.includes('put it on the shelf')")
        assert not shell.robot.busy
        page.click("#ask button")
        page.wait("parts.jobs.some(([, text]) => text.includes('red cup'))")
        assert page.eval("microphone.stream") is None  # nobody listens once it is let go
        assert page.mistakes() == []
        shell.stop("the test is over")


def test_without_a_microphone_the_page_says_so(browser, shell):
    with served(shell.folder) as console:
        page = browser.page(console.url)
        page.wait("page.drawn > 0 && page.steers")
        page.hold("#mic", 0.3)
        page.wait("document.querySelector('#talk').textContent.includes('Nothing can be said')")
        assert page.eval("document.querySelector('#mic').className") == ""
        assert page.mistakes() == []
