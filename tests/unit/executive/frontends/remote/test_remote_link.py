"""From another machine: the same requests, by role; a lost link stops what came by it."""

from __future__ import annotations

import socket
import ssl
import threading
from contextlib import suppress
from datetime import UTC, datetime, timedelta

import msgspec
import pytest

from executive.frontends.remote import gate as gates
from executive.frontends.remote import invitation as invitations
from executive.frontends.remote import wire
from executive.frontends.remote.authority import Authority, utc_now
from executive.frontends.service import client as clients
from executive.frontends.service import commands
from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service.client import Connection, Cut, Silent
from executive.frontends.since_boot import now_s
from robot.errors import ConfigError
from robot.exit_status import ExitStatus
from tests.fakes.house_with_gate import LIMITS
from tests.fakes.waiting import HANG_S, eventually


def lose(house, how, monkeypatch):
    """Break the links, so that both ends are told, or so that they have to notice by themselves."""
    if how == "cut":
        house.network.cut()
        return
    for (where, name), usual_s in LIMITS.items():
        monkeypatch.setattr(where, name, usual_s)
    before = house.network.answers  # whoever waits for the next beat waits as long as usual
    assert eventually(lambda: house.network.answers > before + 1)
    house.network.is_dead = True


def ask(place, request):
    words: list[str] = []

    def hear(told):
        words.append(told.text if isinstance(told, m.Words) else "")

    with Connection(place) as connection:
        return connection.ask(request, hear, wait_s=HANG_S), words


def test_what_is_said_from_afar_is_done_as_here(house):
    with house.visited() as (place, words):
        assert ask(place, m.Say(text="go to the table"))[0].status == ExitStatus.DONE
        assert house.told.did == ["go to the table (0)"]
        assert ask(place, m.Say(text="nonsense"))[0].status == ExitStatus.INVALID
        assert ask(place, m.Say(text="where are you?"))[1] == ["Here."]
        standing = ask(place, m.Status())[0].standing
        assert (standing.robot, standing.world) == ("juno", "w")
    assert words[0].startswith("anna is juno in w")


@pytest.mark.parametrize("role", ["watch", "command", "stop"])
@pytest.mark.parametrize("button", ["stop", "estop"])
def test_everybody_who_is_in_stops_it(house, role, button):
    with house.visited(role=role) as (place, _):
        assert clients.press(place, button, lambda _: None).status == ExitStatus.DONE
        assert house.told.did == [button]


def test_a_stop_does_not_wait_for_a_line_that_is_worked_off(house):
    house.told.go_on.clear()
    with house.visited() as (place, _), Connection(place) as busy:
        busy.send(m.Say(text="something long"))
        assert ask(place, m.Press(button="stop"))[0].status == ExitStatus.DONE
        assert house.told.did == ["stop"]
        house.told.go_on.set()


def test_who_watches_commands_nothing_and_is_told_why(house):
    with house.visited(role="watch") as (place, _):
        ended, words = ask(place, m.Say(text="go to the table"))
        assert ended.status == ExitStatus.INVALID
        assert "role watch" in words[0]
        assert house.told.did == []


def test_a_stop_covers_what_was_asked_for_before_it_and_comes_after_it(house):
    """A terminal that was slow to start, at whose machine the clock is another one."""
    with house.visited() as (place, _):
        before_s = now_s()
        assert ask(place, m.Press(button="stop"))[0].status == ExitStatus.DONE
        ask(place, m.Say(text="go to the table", begun_s=before_s))
        ask(place, m.Say(text="go to the shelf", begun_s=now_s()))
        assert house.told.did == ["stop", "go to the table (0)", "go to the shelf (1)"]


def test_a_stop_covers_what_is_under_way_over_a_slow_link(house):
    robot = next(one for one in places.places_up() if one.name == "robot")
    with house.visited() as (place, _), Connection(place) as anna:
        anna.ask(m.Status(), lambda told: None, wait_s=HANG_S)
        house.told.did.clear()
        house.network.open.clear()
        anna.send(m.Say(text="go to the table", begun_s=now_s()))
        assert ask(robot, m.Press(button="stop"))[0].status == ExitStatus.DONE
        house.network.open.set()
        assert eventually(lambda: len(house.told.did) == 2)
        assert house.told.did == ["stop", "go to the table (0)"]


def test_who_watches_stops_by_a_line_and_sets_nothing_going(house):
    with house.visited(role="watch") as (place, _):
        ended, _ = ask(place, m.Say(text="walk to the table and stop"))
        assert ended.status == ExitStatus.DONE
        assert house.told.did == ["stop"]


@pytest.mark.parametrize(
    "asked",
    [m.Press(button="reset"), *(m.Say(text=text) for text in ("estop reset", "éstop reset"))],
)
def test_an_emergency_stop_is_not_undone_from_afar(house, asked):
    with house.visited() as (place, _):
        ended, words = ask(place, asked)
        assert (ended.status, house.told.did) == (ExitStatus.INVALID, [])
        assert "stands at the robot" in words[0]


def test_a_robot_is_not_ended_from_afar_and_nobody_waits_for_that(house, monkeypatch):
    monkeypatch.setattr(commands, "say", lambda text, err=False: None)
    with house.visited() as (place, _):
        assert commands.down(place.name) == ExitStatus.INVALID


@pytest.mark.parametrize("how", ["cut", "dead"])
def test_a_lost_link_stops_what_came_by_it(house, how, monkeypatch):
    with house.visited() as (place, _):
        ask(place, m.Say(text="go to the table"))
        house.told.did.clear()
        lose(house, how, monkeypatch)
        assert eventually(lambda: len(house.told.did) == 2)
    assert house.told.did == ["goals", "stop"]


@pytest.mark.parametrize("how", ["cut", "dead"])
def test_a_lost_link_stops_nothing_that_came_from_elsewhere(house, how, monkeypatch):
    robot = next(one for one in places.places_up() if one.name == "robot")
    with house.visited() as (place, words):
        ask(robot, m.Say(text="go to the table"))  # of somebody who stands there
        ask(place, m.Status())
        house.told.did.clear()
        lose(house, how, monkeypatch)
        assert eventually(lambda: any("is lost" in text for text in words))
        house.network.is_dead = False
    assert house.told.did == []


def test_a_line_that_is_worked_off_still_is_stopped_with_its_link(house):
    house.told.go_on.clear()
    with house.visited() as (place, _):
        with Connection(place) as connection:
            connection.send(m.Say(text="something long"))
            assert eventually(lambda: any("something long" in text for text in house.told.said))
        house.network.cut()
        assert eventually(lambda: house.told.did)
        assert house.told.did == ["stop"]
        house.told.go_on.set()


def test_who_leaves_on_purpose_leaves_the_robot_as_it_is(house):
    with house.visited() as (place, _):
        ask(place, m.Say(text="go to the table"))
        house.told.did.clear()
    assert house.told.did == []


def test_a_gate_that_closes_stops_what_came_by_it(house):
    with house.visited() as (place, _):
        ask(place, m.Say(text="go to the table"))
        house.told.did.clear()
        house.__exit__()
        assert house.told.did[:2] == ["goals", "stop"]


def test_a_link_comes_back(house):
    with house.visited() as (place, words):
        house.network.cut()
        assert eventually(lambda: any("is lost" in text for text in words))
        assert eventually(lambda: ask(place, m.Status())[0].standing)


def test_a_dead_network_is_told_and_not_waited_for(house):
    with house.visited() as (place, _):
        house.network.close()
        assert eventually(lambda: ask(place, m.Press(button="stop"))[0].status)


def is_answered(place):
    with suppress(Cut, Silent):
        return ask(place, m.Status())[0].status != ExitStatus.BROKEN
    return False


def test_who_is_revoked_is_let_go(house):
    with house.visited() as (place, words):
        assert ask(place, m.Status())[0].standing
        house.authority.revoke("anna")
        assert eventually(lambda: any("is lost" in text for text in words))
        assert eventually(lambda: not is_answered(place))
        assert eventually(lambda: any("worth nothing" in text for text in house.said))


def test_who_speaks_without_a_link_that_is_watched_is_not_heeded(house):
    anna = house.invite("anna", "command")
    context = invitations.client_context(anna)
    with (
        socket.create_connection(("127.0.0.1", house.port)) as plain,
        context.wrap_socket(plain, server_hostname=invitations.SERVER_NAME) as tls,
    ):
        tls.sendall(m.line_of(m.Say(number=1, text="go to the table")))
        words = m.told(tls.makefile("rb").readline())
        assert isinstance(words, m.Words)
        assert "remote join" in words.text
        tls.sendall(m.line_of(m.Press(number=2, button="stop")))  # but for a stop
        assert eventually(lambda: house.told.did == ["stop"])


# --- who is nobody --------------------------------------------------------------------------------


def stranger(folder, **more):
    made = Authority(folder).invite("anna", "command", host="127.0.0.1", port=1, days=9)
    return msgspec.structs.replace(made, **more)


def is_let_in(house, context):
    """Whether a request is answered: TLS 1.3 refuses a certificate only after the handshake."""
    with suppress(OSError):
        plain = socket.create_connection(("127.0.0.1", house.port))
        with context.wrap_socket(plain, server_hostname=invitations.SERVER_NAME) as tls:
            tls.sendall(m.line_of(m.Press(number=1, button="stop")))
            return bool(tls.recv(1))
    return False


def test_without_a_certificate_of_ours_nobody_gets_in(house, tmp_path):
    anna = house.invite("anna", "command")
    assert is_let_in(house, invitations.client_context(anna))
    house.told.did.clear()
    bare = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    bare.load_verify_locations(cadata=anna.authority)
    other = stranger(tmp_path / "other", authority=anna.authority)
    old = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    old.maximum_version = ssl.TLSVersion.TLSv1_2
    old.load_verify_locations(cadata=anna.authority)
    invitations.load_chain(old, certificate=anna.certificate, key=anna.key)
    for context in (bare, invitations.client_context(other), old):
        assert not is_let_in(house, context)
    assert house.told.did == []


def test_an_expired_certificate_is_worth_nothing(house):
    house.now = datetime(2020, 1, 1, tzinfo=UTC)
    anna = house.invite("anna", "command")
    house.now = utc_now()
    assert not is_let_in(house, invitations.client_context(anna))
    ben = house.invite("ben", "command")
    house.now += timedelta(days=10)  # over by the list; the certificate goes by the system's clock
    assert not is_let_in(house, invitations.client_context(ben))
    assert house.told.did == []


def test_a_gate_that_is_not_the_inviter_is_not_joined(house, tmp_path):
    mine = house.invite("anna", "command")
    other = stranger(tmp_path / "other", port=house.network.port)
    with house.joined(msgspec.structs.replace(mine, authority=other.authority)) as (_, _, ended):
        assert eventually(lambda: ended)
    assert isinstance(ended[0], ConfigError)
    assert "not whom the invitation is from" in str(ended[0])


def test_no_guest_can_pose_as_the_gate(house):
    anna, ben = house.invite("anna", "command"), house.invite("ben", "command")
    posing = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    invitations.load_chain(posing, certificate=ben.certificate, key=ben.key)
    one, other = socket.socketpair()

    def pose():
        with suppress(OSError), posing.wrap_socket(other, server_side=True):
            pass

    thread = threading.Thread(target=pose)
    thread.start()
    with pytest.raises(ssl.SSLCertVerificationError):
        invitations.client_context(anna).wrap_socket(one, server_hostname=invitations.SERVER_NAME)
    one.close()
    thread.join()


def test_a_crowd_at_the_door_keeps_out_nobody_who_is_in(house):
    with house.visited() as (place, _):
        crowd = []
        for _ in range(3 * gates.MOST_SHAKING):
            with suppress(OSError):
                crowd.append(socket.create_connection(("127.0.0.1", house.port)))
        for one in crowd:
            one.close()
        assert eventually(lambda: ask(place, m.Press(button="stop"))[0].status == ExitStatus.DONE)


@pytest.mark.parametrize(
    "data", [b"\n", b"{}\n", b"\xff\n", b"[" * 60_000 + b"\n", b"a" * 2_000_000, wire.BEAT * 20_000]
)
def test_whoever_is_in_and_talks_rubbish_is_let_go_alone(house, data):
    ben = invitations.client_context(house.invite("ben", "command"))
    with house.visited() as (place, _):
        with suppress(OSError):
            plain = socket.create_connection(("127.0.0.1", house.port))
            with ben.wrap_socket(plain, server_hostname=invitations.SERVER_NAME) as tls:
                tls.sendall(data)
        assert ask(place, m.Status())[0].standing
