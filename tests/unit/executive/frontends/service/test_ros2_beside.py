"""The bridge to ROS 2 beside a robot: what is refused before it moves, and one that dies."""

from __future__ import annotations

import pytest

from executive.frontends.service import ros2_beside
from executive.frontends.service.options import LOCAL_ROUTER
from executive.frontends.service.ros2_beside import MOST_STARTS, bridged, check
from executive.frontends.service.ros2_plan import Plan
from robot.errors import ConfigError
from tests.fakes.waiting import eventually

PLAN = Plan(
    router=LOCAL_ROUTER, domain=0, namespace="", sockets="/nowhere", name="robot",
    place="/nowhere", robot="juno", pictures=False,
)  # fmt: skip


@pytest.mark.parametrize(
    "router", [LOCAL_ROUTER, "tcp/robot-1.local:7447", "tcp/[fe80::1]:7447", "tcp/10.0.0.1:1"]
)
def test_an_endpoint_of_a_router_is_taken(router):
    check(router, fast=False)


@pytest.mark.parametrize(
    "router",
    ["", "7447", "tcp/robot", "tcp/robot:0", "tcp/robot:70000", "udp/robot:7447",
     "tcp/robot:7447#iface=eth0", "tcp/robot:7447?rel=0", "tcp/a b:1", "tcp/robot:7447\n"],
)  # fmt: skip
def test_what_is_none_is_refused_before_anything_moves(router):
    with pytest.raises(ConfigError, match="no endpoint of a router"):
        check(router, fast=False)


def test_a_robot_whose_time_is_simulated_is_not_bridged():
    with pytest.raises(ConfigError, match="keeps time"):
        check(LOCAL_ROUTER, fast=True)


def test_nothing_is_started_where_nobody_wants_it(tmp_path):
    said: list[str] = []
    with bridged(None, logs=tmp_path, out=said.append):
        pass
    assert not said and not list(tmp_path.iterdir())


def test_one_that_dies_is_started_again_but_not_for_ever(tmp_path, monkeypatch):
    said: list[str] = []
    monkeypatch.setattr(ros2_beside, "MODULE", "no.such.module")
    monkeypatch.setattr(ros2_beside, "AGAIN_S", 0.0)
    with bridged(PLAN, logs=tmp_path, out=said.append):
        assert eventually(lambda: any("not started again" in one for one in said))
    ended = [one for one in said if "has ended" in one]
    assert len(ended) == MOST_STARTS and "status 1" in ended[0]
    assert "no.such.module" in (tmp_path / "logs" / ros2_beside.LOG).read_text() or (
        "No module named" in (tmp_path / "logs" / ros2_beside.LOG).read_text()
    )


def test_it_is_ended_with_the_robot(tmp_path, monkeypatch):
    said: list[str] = []
    monkeypatch.setattr(ros2_beside, "MODULE", "tests.fakes.staying_process")
    with bridged(PLAN, logs=tmp_path, out=said.append):
        assert eventually((tmp_path / "logs" / ros2_beside.LOG).exists)
    assert not any("has ended" in one for one in said)
