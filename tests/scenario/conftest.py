"""The command line, as people call it."""

import os

import pytest

from executive.frontends import cli
from executive.runs import run_folder


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
