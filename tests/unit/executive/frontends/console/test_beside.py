"""The address of a page beside a run: kept where it is still good, and no longer than that."""

from __future__ import annotations

import json
import socket

import pytest

from executive.frontends.console import beside
from executive.frontends.console.address import HOST


class NoProcess:
    """In place of the console's process."""

    stdin = None

    def __init__(self, *_, **__) -> None:
        pass


@pytest.fixture(autouse=True)
def _no_process(monkeypatch):
    monkeypatch.setattr(beside.subprocess, "Popen", NoProcess)


def test_a_run_that_goes_on_has_the_same_address(tmp_path):
    _, first = beside._started(tmp_path)
    _, second = beside._started(tmp_path)
    assert second == first


def test_on_another_port_there_is_another_token(tmp_path):
    _, first = beside._started(tmp_path)
    with socket.create_server((HOST, first.port)):
        _, second = beside._started(tmp_path)
    assert second.port != first.port
    assert second.token != first.token


@pytest.mark.parametrize("port", [99999, -1, 0, 2**70, 1.5, "x", None])
def test_an_address_that_is_none_is_not_used_again(tmp_path, port):
    kept = tmp_path / beside.FILE
    kept.write_text(json.dumps({"port": port, "token": "a" * 24}))
    kept.chmod(0o600)
    _, address = beside._started(tmp_path)
    assert 0 < address.port < 65536 and address.token != "a" * 24


@pytest.mark.parametrize("token", ["", "short", "\x1b[31m" + "a" * 19, "a" * 25])
def test_a_token_that_cannot_be_ours_is_not_used_again(tmp_path, token):
    kept = tmp_path / beside.FILE
    kept.write_text(json.dumps({"port": 9, "token": token}))
    kept.chmod(0o600)
    assert beside._started(tmp_path)[1].token != token
