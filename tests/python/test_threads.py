# SPDX-License-Identifier: MIT
"""Whatever takes long lets other Python threads run meanwhile."""

import functools
import pathlib
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
        reading,
        a_detection,
    ],
)
def test_other_threads_run_during(make):
    # The other thread must wake up while the work lasts, which the system may not grant at the first attempt.
    assert any(lets_others_run(make(3000)) for _ in range(200))
