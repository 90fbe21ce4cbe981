"""The command line, as people call it."""

import pytest

from executive.frontends import cli


@pytest.fixture
def humanoid(monkeypatch, capsys, tmp_path):
    """Runs the command in an empty folder: (exit status, output)."""
    monkeypatch.chdir(tmp_path)

    def run(*words: str) -> tuple[int, str]:
        monkeypatch.setattr("sys.argv", ["humanoid", *words])
        with pytest.raises(SystemExit) as end:
            cli.main()
        out, err = capsys.readouterr()
        return int(end.value.code or 0), out + err

    return run
