"""Who is invited is known by a certificate of ours, as long as the invitation is good."""

from __future__ import annotations

import os
import ssl
import stat
from datetime import UTC, datetime, timedelta

import msgspec
import pytest

from executive.frontends.remote import invitation as invitations
from executive.frontends.remote.authority import AUTHORITY, INVITED, Authority
from robot.errors import ConfigError

NOON = datetime(2030, 5, 17, 12, tzinfo=UTC)


class Clock:
    now = NOON

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def authority(tmp_path, clock):
    return Authority(tmp_path / "remote", now=clock)


def invite(authority, name="anna", role="watch", days=30):
    return authority.invite(name, role, host="robot.local", port=7450, days=days)


def der(invitation):
    return ssl.PEM_cert_to_DER_cert(invitation.certificate)


def test_who_was_invited_is_known_until_the_invitation_is_over(authority, clock):
    anna = invite(authority, days=2)
    invite(authority, "ben", "command")
    guest = authority.guest(der(anna))
    assert guest is not None
    assert (guest.name, guest.role) == ("anna", "watch")
    assert [one.name for one in authority.guests()] == ["anna", "ben"]
    clock.now = NOON + timedelta(days=2)
    assert authority.guest(der(anna)) is None
    assert invite(authority) != anna  # and may be invited anew


def test_who_is_revoked_is_nobody_at_once_and_others_stay(authority):
    anna, ben = invite(authority), invite(authority, "ben")
    assert authority.revoke("anna")
    assert authority.guest(der(anna)) is None
    assert authority.guest(der(ben)) is not None
    assert not authority.revoke("anna")


def test_nobody_is_invited_twice_by_one_name(authority):
    invite(authority)
    with pytest.raises(ConfigError, match="invited already"):
        invite(authority)


def test_keys_are_for_nobody_else(authority, tmp_path):
    invite(authority)
    folder = tmp_path / "remote"
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    for name in (AUTHORITY, INVITED):
        assert stat.S_IMODE((folder / name).stat().st_mode) == 0o600


@pytest.mark.parametrize("name", [AUTHORITY, INVITED])
@pytest.mark.parametrize("content", [b"", b"{}", b"[" * 9999, b"\xff"])
def test_damaged_files_are_told_and_stay(authority, tmp_path, name, content):
    invite(authority)
    path = tmp_path / "remote" / name
    path.write_bytes(content)
    with pytest.raises(ConfigError, match="damaged"):
        invite(authority, "ben")
    assert path.read_bytes() == content


def test_files_that_others_may_write_are_not_trusted(authority, tmp_path):
    invite(authority)
    (tmp_path / "remote" / INVITED).chmod(0o660)
    with pytest.raises(ConfigError, match="others may use"):
        authority.guests()


def test_without_anybody_invited_there_is_no_gate(authority):
    with pytest.raises(ConfigError, match="nobody is invited"):
        authority.gate_context()


def test_an_invitation_is_read_as_it_was_written(authority, tmp_path):
    made = invite(authority)
    path = tmp_path / "anna.invitation"
    path.write_bytes(msgspec.json.encode(made))
    path.chmod(0o600)
    assert invitations.read(path) == made
    assert invitations.client_context(made).minimum_version == ssl.TLSVersion.TLSv1_3
    path.chmod(0o644)
    with pytest.raises(ConfigError, match="others may use"):
        invitations.read(path)


@pytest.mark.parametrize("content", [b"", b"{}", b"\x00" * 40_000, b"[" * 9999])
def test_what_is_no_invitation_is_told(tmp_path, content):
    path = tmp_path / "odd"
    path.write_bytes(content)
    path.chmod(0o600)
    with pytest.raises(ConfigError):
        invitations.read(path)
    with pytest.raises(ConfigError):
        invitations.read(tmp_path / "nowhere")
    os.mkfifo(tmp_path / "pipe", 0o600)
    with pytest.raises(ConfigError, match="no ordinary file"):
        invitations.read(tmp_path / "pipe")


def test_certificates_that_are_none_are_told(authority):
    made = invite(authority)
    for field in ("authority", "certificate", "key"):
        with pytest.raises(ConfigError, match="certificates are none"):
            invitations.client_context(msgspec.structs.replace(made, **{field: "x"}))
