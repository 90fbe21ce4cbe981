"""The table of processes names modules that can be run."""

import importlib
import inspect

import pytest

from robot.bringup.processes import EXECUTIVE, PROCESSES, STOP_ORDER


@pytest.mark.parametrize("process", [*PROCESSES, EXECUTIVE], ids=lambda process: process.name)
def test_every_module_of_the_table_has_a_main_for_a_file_and_a_process_id(process):
    module = importlib.import_module(process.module)
    words = ["FILE", "1", "0"] if process is EXECUTIVE else ["FILE", "1"]
    inspect.signature(module.main).bind(*words)
    assert '__name__ == "__main__"' in inspect.getsource(module)


def test_the_owner_of_the_motors_runs_only_where_there_is_to_be_one_and_in_reality_too():
    (owner,) = [row for row in PROCESSES if row.name == "owner"]
    for simulated in (True, False):
        assert not owner.needed(simulated=simulated, pictures=True)
        assert owner.needed(simulated=simulated, owned=True)
    assert STOP_ORDER.index("controller") < STOP_ORDER.index("owner") < STOP_ORDER.index("plant")
