"""No torn record is ever taken for a whole one."""

import threading
from itertools import islice
from mmap import mmap

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from robot.drivers.simulation.seqlock import HEADER_BYTES, Seqlock

SIZE = 40


@pytest.fixture
def memory() -> mmap:
    return mmap(-1, Seqlock.bytes_for(SIZE))


def test_nothing_is_read_before_the_first_record(memory: mmap):
    record = Seqlock(memory, 0, size=SIZE)
    assert record.read() is None
    assert record.torn == 0


@given(values=arrays(np.float64, SIZE, elements=st.floats(allow_nan=True)))
def test_what_was_written_is_read(values: np.ndarray):
    memory = mmap(-1, Seqlock.bytes_for(SIZE))
    Seqlock(memory, 0, size=SIZE).write(values)
    found = Seqlock(memory, 0, size=SIZE).read()
    assert found is not None
    np.testing.assert_array_equal(found[1], values)


def test_sequences_grow_by_two(memory: mmap):
    record = Seqlock(memory, 0, size=SIZE)
    sequences = []
    for number in range(5):
        record.write(np.full(SIZE, float(number)))
        sequences.append(record.read()[0])
    assert np.all(np.diff(sequences) == 2)
    assert sequences[-1] == record.sequence


def test_a_writer_that_died_half_way_is_refused_and_counted(memory: mmap):
    writer, reader = Seqlock(memory, 0, size=SIZE), Seqlock(memory, 0, size=SIZE)
    writer.write(np.ones(SIZE))
    header = np.frombuffer(memory, np.uint64, 2)
    header[0] += 1  # the writer has begun: the sequence is odd, half of the numbers are new
    np.frombuffer(memory, np.float64, SIZE // 2, HEADER_BYTES)[:] = 2.0
    assert reader.read() is None
    assert reader.torn == 1
    Seqlock(memory, 0, size=SIZE).write(np.full(SIZE, 3.0))  # another writer takes over
    assert (reader.read()[1] == 3.0).all()


@given(place=st.integers(HEADER_BYTES, Seqlock.bytes_for(SIZE) - 1), bit=st.integers(0, 7))
def test_any_flipped_bit_is_refused(place: int, bit: int):
    memory = mmap(-1, Seqlock.bytes_for(SIZE))
    record = Seqlock(memory, 0, size=SIZE)
    record.write(np.linspace(0.0, 1.0, SIZE))
    memory[place] ^= 1 << bit
    assert record.read() is None
    assert record.torn == 1


def test_an_old_record_under_a_new_sequence_is_refused(memory: mmap):
    record = Seqlock(memory, 0, size=SIZE)
    record.write(np.ones(SIZE))
    np.frombuffer(memory, np.uint64, 2)[0] += 2  # stores seen in the wrong order
    assert record.read() is None


def test_readers_beside_a_writer_see_whole_records_only(memory: mmap):
    writer, reader = Seqlock(memory, 0, size=SIZE), Seqlock(memory, 0, size=SIZE)
    stop = threading.Event()

    def write() -> None:
        number = 0.0
        while not stop.is_set():
            number += 1.0
            writer.write(np.full(SIZE, number))

    thread = threading.Thread(target=write)
    thread.start()
    try:
        # A writer that waits for the interpreter in mid-record shows nothing for a while.
        found = (reader.read() for _ in range(1_000_000))
        seen = [record[1] for record in islice((one for one in found if one), 2000)]
    finally:
        stop.set()
        thread.join()
    assert len(seen) == 2000
    assert all((values == values[0]).all() for values in seen)
    firsts = [values[0] for values in seen]
    assert firsts == sorted(firsts)


def test_news_is_told_once(memory: mmap):
    writer, reader = Seqlock(memory, 0, size=SIZE), Seqlock(memory, 0, size=SIZE)
    assert reader.news() is None
    for number in (1.0, 2.0):
        writer.write(np.full(SIZE, number))
        assert (reader.news() == number).all()
        assert reader.news() is None
