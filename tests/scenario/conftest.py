"""The command line, as people call it; and a browser on a page, with a robot behind it."""

from __future__ import annotations

import os

import pytest

from executive.frontends import cli
from executive.frontends.console.desk import Desk
from executive.runs import run_folder
from robot.bringup import private_folder
from tests.fakes.browser import Browser
from tests.fakes.puppet_shell import puppet_shell


@pytest.fixture
def humanoid(monkeypatch, capsys, tmp_path):
    """Runs the command in an empty folder: (exit status, output)."""
    monkeypatch.chdir(tmp_path)

    def run(*words: str) -> tuple[int, str]:
        monkeypatch.setattr("sys.argv", ["humanoid", *words])
        with pytest.raises(SystemExit) as end:
            cli.main()
        for held in run_folder._claimed.values():  # as the end of its process lets go
            os.close(held)
        run_folder._claimed.clear()
        out, err = capsys.readouterr()
        return int(end.value.code or 0), out + err

    return run


@pytest.fixture(scope="module")
def opened():
    with Browser() as made:
        yield made


@pytest.fixture
def browser(opened):
    yield opened
    opened.close_pages()


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
