# SPDX-License-Identifier: MIT
"""Whatever takes long lets other Python threads run meanwhile."""

import functools
import os
import pathlib
import subprocess
import sys
import tempfile
import threading

import allpairs
import numpy as np
import pytest
from conftest import random_boxes

BOXES = np.hstack(random_boxes(3000))
FOLDER = tempfile.TemporaryDirectory()


def a_search(size):
    boxes = BOXES[:size]
    return lambda: allpairs.overlaps(boxes)


def a_count(size):
    boxes = BOXES[:size]
    return lambda: allpairs.count(boxes)


def a_search_of_two_sets(size):
    boxes = BOXES[:size]
    return lambda: allpairs.overlaps_between(boxes, boxes)


def a_count_of_two_sets(size):
    boxes = BOXES[:size]
    return lambda: allpairs.count_between(boxes, boxes)


def a_batch(size):
    stream = allpairs.batches(BOXES[:size])
    return lambda: next(stream)


def a_step(size):
    world = allpairs.World()
    world.add(BOXES[:size])
    return world.step


def a_query(size):
    world = allpairs.World()
    world.add(BOXES[:size])
    return lambda: world.overlapping(BOXES[:size])


def candidates(size):
    mesh = allpairs.MeshCandidates(np.arange(size // 3 * 3).reshape(-1, 3), size)
    mesh.set_positions(BOXES[:size, :3])
    return lambda: mesh.find("face-face")


def a_partition(size):
    return lambda: allpairs.Partition(BOXES[:size], cells=50)


def cells_of(size):
    partition = allpairs.Partition(BOXES[:size], cells=50)
    return lambda: partition.cells_of(BOXES[:size])


@functools.lru_cache
def written(size):
    path = pathlib.Path(FOLDER.name) / f"{size}.csv"
    np.savetxt(path, BOXES[:size], delimiter=",")
    return path


def reading(size):
    path = written(size)
    return lambda: allpairs.load(path)


def a_detection(size):
    return allpairs.load(written(size)).detect


def lets_others_run(work):
    """Whether another thread got the interpreter before `work` was done, though nobody makes a thread give it up.

    The interpreter takes itself from a thread only after the switch interval, which is without end here; so the other
    thread, once it is told to go, runs during `work` if that gives the interpreter back, and else after it.
    """
    go, ran = threading.Lock(), []
    go.acquire()

    def wait():
        go.acquire()
        ran.append(True)

    other = threading.Thread(target=wait)
    interval = sys.getswitchinterval()
    other.start()
    sys.setswitchinterval(1000)
    try:
        go.release()
        before = bool(ran)
        work()
        return bool(ran) and not before
    finally:
        sys.setswitchinterval(interval)
        other.join()


AT_WORK = """
import allpairs, numpy as np, sys, threading
world = allpairs.World(threads=2)
world.add(np.random.default_rng(1).random((2000, 6)).cumsum(1))
boxes = np.random.default_rng(2).random((30000, 6)).cumsum(1)
work = {"step": world.step, "query": lambda: world.overlapping(boxes[:100]), "count": lambda: allpairs.count(boxes)}[sys.argv[1]]
begun = threading.Event()

def for_ever():
    while True:
        work()
        begun.set()

threading.Thread(target=for_ever, daemon=True).start()
begun.wait()
"""


@pytest.mark.parametrize("work", ["step", "query", "count"])
def test_a_program_may_end_while_a_daemon_thread_is_at_work(work):
    for _ in range(5):
        done = subprocess.run([sys.executable, "-c", AT_WORK, work], capture_output=True, text=True, timeout=100)
        assert (done.returncode, done.stderr) == (0, "")


CHANGING_IDS = """
import allpairs, numpy as np, threading, time
n = 40_000
boxes = np.zeros((n, 6))
world = allpairs.World()
ids = world.add(boxes, group=1)
until = time.monotonic() + 3

def change():
    while time.monotonic() < until:
        ids[n // 2] = 4_000_000_000
        ids[n // 2] = n // 2

other = threading.Thread(target=change)
other.start()
while time.monotonic() < until:
    for call in (lambda: world.move(ids, boxes), lambda: world.set_properties(ids, group=1), lambda: world.boxes(ids)):
        try:
            call()
        except allpairs.InvalidBox:
            pass
other.join()
"""


def test_another_thread_may_change_the_ids_that_a_world_is_given():
    assert subprocess.run([sys.executable, "-c", CHANGING_IDS], timeout=100).returncode == 0


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_batches_of_a_parent_are_refused():
    batches = allpairs.batches(BOXES, batch_size=100)
    next(batches)
    child = os.fork()
    if child == 0:
        try:
            next(batches)
        except allpairs.InvalidArgument as problem:
            os._exit(0 if "forked" in str(problem) else 1)
        os._exit(2)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert len(next(batches)) == 100


def test_the_oracle_sees_who_keeps_the_interpreter():
    assert not lets_others_run(lambda: sum(range(200_000)))


@pytest.mark.parametrize(
    "make",
    [
        a_search,
        a_count,
        a_search_of_two_sets,
        a_count_of_two_sets,
        a_batch,
        a_step,
        a_query,
        candidates,
        a_partition,
        cells_of,
        reading,
        a_detection,
    ],
)
def test_other_threads_run_during(make):
    # The other thread must wake up while the work lasts, which the system may not grant at the first attempt.
    assert any(lets_others_run(make(3000)) for _ in range(200))
