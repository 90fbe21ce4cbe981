"""The table of processes names modules that can be run."""

import importlib
import inspect

import pytest

from robot.bringup.processes import EXECUTIVE, PROCESSES


@pytest.mark.parametrize("process", [*PROCESSES, EXECUTIVE], ids=lambda process: process.name)
def test_every_module_of_the_table_has_a_main_for_a_file_and_a_process_id(process):
    module = importlib.import_module(process.module)
    words = ["FILE", "1", "0"] if process is EXECUTIVE else ["FILE", "1"]
    inspect.signature(module.main).bind(*words)
    assert '__name__ == "__main__"' in inspect.getsource(module)
