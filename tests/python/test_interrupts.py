# SPDX-License-Identifier: MIT
"""Ctrl-C ends a search soon, and signal handlers run during one; what was searching can be used on.

Each search runs in a process of its own and would take a minute or more to its end. The limits are a small part of
that, and a large multiple of the fifth of a second that an interrupt takes: the machine may be busy. Searches of few
boxes take less than a second; of these it is the processor time that is compared with that of the whole search.
"""

import signal
import subprocess
import sys
import threading
import time

import pytest
from conftest import READS_FILES

PRELUDE = """
import signal, sys
import allpairs
import numpy as np

heap = np.tile([0.0, 0, 0, 1, 1, 1], (1_000_000, 1))  # all in one place: 500 billion pairs
row = heap + 2.0 * np.arange(len(heap))[:, None]  # none
one = np.ones(len(heap), np.uint32)

def interrupted(work):
    print("begins", flush=True)
    try:
        work()
    except KeyboardInterrupt:
        print("interrupted", flush=True)
    else:
        sys.exit("ran to its end")
"""

SEARCHES = {
    "count": "interrupted(lambda: allpairs.count(heap))",
    "count on two threads": "interrupted(lambda: allpairs.count(heap, threads=2))",
    "overlaps": "interrupted(lambda: allpairs.overlaps(row, strategy='exhaustive'))",
    "overlaps on two threads": "interrupted(lambda: allpairs.overlaps(heap, group=one, threads=2))",
    "overlaps of two sets": "interrupted(lambda: allpairs.overlaps_between(heap, heap, group=(one, one)))",
    "count of two sets": "interrupted(lambda: allpairs.count_between(heap, heap))",
    "batches": "interrupted(lambda: next(allpairs.batches(row, strategy='exhaustive')))",
    "batches in order": "interrupted(lambda: next(allpairs.batches(heap, group=one, threads=2)))",
    "batches that are left": """
stream = allpairs.batches(np.vstack([heap[:100], row[100:]]), strategy="exhaustive", order="unordered", batch_size=1)
next(stream)
print("begins", flush=True)
stream.close()
print("interrupted", flush=True)
""",
    "a step": """
for threads in (1, 2):
    world = allpairs.World(threads=threads)
    first = world.add([[0, 0, 0, 1, 1, 1], [1, 1, 1, 2, 2, 2]])
    assert len(world.step().began) == 1
    ids = world.add(heap, group=1)
    interrupted(world.step)
    world.remove(ids)
    world.move(first[1:], [[5, 5, 5, 6, 6, 6]])
    step = world.step()
    assert (len(step.pairs), step.ended.tolist()) == (0, [[0, 1]])
""",
    "a query": """
world = allpairs.World()
world.add(heap[:50_000])
interrupted(lambda: world.nearest(np.zeros((500_000, 3)), 10))
assert len(world.overlapping(heap[:1])) == 50_000
""",
    "a query of all hits": """
world = allpairs.World()
world.add(heap[:50_000], category=2)
interrupted(lambda: world.all_hits(heap[:500_000], [1, 0, 0], 1, mask=1))
assert len(world.all_hits(heap[:1], [1, 0, 0])[1]) == 50_000
""",
    "two worlds": """
worlds = [allpairs.World(threads=threads) for threads in (1, 2)]
for world in worlds:
    world.add(heap[:300_000], group=1)
interrupted(lambda: worlds[0].overlaps_between(worlds[1]))
interrupted(lambda: worlds[1].overlaps_between(worlds[0]))
for world in worlds:
    world.remove(world.ids())
    world.add(row[:300_000])
assert len(worlds[0].overlaps_between(worlds[1])) == 300_000
""",
    "a partition": """
points = np.random.default_rng(1).random((2_000_000, 3))
interrupted(lambda: allpairs.Partition(points, points, cells=1_000_000))
partition = allpairs.Partition(row[::10], cells=500)
interrupted(lambda: partition.cells_of(np.tile([0, 0, 0, 2e6, 1, 1], (200_000, 1))))  # each in all cells
assert partition.cells_of(row[:5]).tolist() == [[i, 0] for i in range(5)]
""",
    "candidates": """
mesh = allpairs.MeshCandidates(np.arange(600_000).reshape(-1, 3), 600_000)
mesh.set_positions(np.tile([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]], (200_000, 1)))
interrupted(lambda: mesh.count("face-face"))
mesh.set_positions(np.arange(1_800_000.0).reshape(-1, 3))
assert mesh.count("face-face") == 0
""",
    # Without the exhaustive search it would have ended before.
    "detect that verifies boxes": """
import tempfile
with tempfile.TemporaryDirectory() as folder:
    np.save(folder + "/row.npy", row[:600_000])
    scene = allpairs.load(folder + "/row.npy")
    interrupted(lambda: scene.detect(verify=True))
    assert len(scene.detect()) == 0
""",
}


FEW = """
import os, threading, time

few = heap[:12_000]
groups = np.arange(12_000) // 2 + 1

def halves(work, count=lambda result: result):
    "The whole, then one that Ctrl-C ends after a tenth of it; then one with a handler that raises nothing."
    def press(after):
        begin = time.process_time()
        def wait():
            while time.process_time() - begin < after:
                time.sleep(0.002)
            os.kill(os.getpid(), signal.SIGINT)
        thread = threading.Thread(target=wait)
        thread.start()
        return thread
    begin = time.process_time()
    expected = count(work())
    whole = time.process_time() - begin
    for _ in range(5):  # where all cores are busy, the key may be pressed late
        begin = time.process_time()
        thread = press(whole / 10)
        try:
            work()
            thread.join()
        except KeyboardInterrupt:
            part = time.process_time() - begin
        thread.join()
        if part <= 0.7 * whole:
            break
    else:
        sys.exit(f"{part} of {whole} s")
    seen = []
    usual = signal.signal(signal.SIGINT, lambda *_: seen.append(1))
    thread = press(whole / 10)
    assert count(work()) == expected
    thread.join()
    signal.signal(signal.SIGINT, usual)
    assert seen == [1]
"""

FEW_SEARCHES = {
    "count": "halves(lambda: allpairs.count(few, group=groups))",
    "count by a hierarchy": "halves(lambda: allpairs.count(few, group=groups, strategy='bvh'))",
    "count between": """
halves(lambda: allpairs.count_between(few, few, group=(groups, groups)))
""",
    "overlaps": "halves(lambda: allpairs.overlaps(few, group=one[:12_000]), len)",
    "overlaps by a hierarchy": """
halves(lambda: allpairs.overlaps(few, group=one[:12_000], order="second", strategy="bvh"), len)
""",
    "neighbors": "halves(lambda: allpairs.neighbors(few, group=one[:12_000]), lambda rows: len(rows[1]))",
    "many worlds": """
offsets = [0, 6000, 12_000]
halves(lambda: allpairs.overlaps_in_worlds(few, offsets=offsets, group=groups), lambda found: len(found[0]))
""",
    "a query": """
world = allpairs.World()
world.add(few[:6000])
halves(lambda: world.overlapping(few[:6000]), len)
""",
    "a step": """
world = allpairs.World()
ids = world.add(few[:6000])
assert len(world.step().pairs) == 6000 * 5999 // 2
world.remove(ids)
assert len(world.step().ended) == 6000 * 5999 // 2
ids = world.add(few[:6000])
thread = threading.Timer(0.05, lambda: os.kill(os.getpid(), signal.SIGINT))
thread.start()
try:
    world.step()
    sys.exit("ran to its end")
except KeyboardInterrupt:
    assert len(world.step().began) == 6000 * 5999 // 2
""",
    "a step in a handler": """
def full():
    world = allpairs.World()
    world.add(few[:6000])
    return world

many = 6000 * 5999 // 2
world = full()
began = []
signal.signal(signal.SIGINT, lambda *_: began.append(len(world.step().began)))
begin = time.monotonic()
world.step()
whole = time.monotonic() - begin
for part in (0.5, 0.7, 0.9):  # where the lists are copied, among others
    world = full()
    began.clear()
    thread = threading.Timer(part * whole, lambda: os.kill(os.getpid(), signal.SIGINT))
    thread.start()
    try:
        began.append(len(world.step().began))
    except allpairs.Error as error:
        assert "the lists of this step are gone" in str(error)
        began.append(many)
    thread.join()
    assert sum(began) == many, began
""",
    "detect": """
scene = allpairs.load(sys.argv[1])
assert len(scene) == 2500
halves(lambda: scene.detect(strategy="exhaustive"), len)
halves(lambda: scene.detect(strategy="exhaustive", threads=2), len)
halves(lambda: scene.detect(verify=True), len)
""",
    "load": "halves(lambda: allpairs.load(sys.argv[2]), len)",
}


def run(program, *arguments):
    """The process of a program; one that hangs ends after a while."""
    command = [sys.executable, "-c", PRELUDE + program, *map(str, arguments)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    watch = threading.Timer(60, process.kill)
    watch.daemon = True
    watch.start()
    return process


@pytest.mark.parametrize("name", SEARCHES)
def test_ctrl_c_ends(name):
    if "detect" in name and not READS_FILES:
        pytest.skip("this build of allpairs reads no files")
    with run(SEARCHES[name] + "\nassert allpairs.count(heap[:5]) == 10\nprint('usable')") as process:
        while (line := process.stdout.readline()) == "begins\n":
            time.sleep(0.5)
            process.send_signal(signal.SIGINT)
            begin = time.monotonic()
            assert process.stdout.readline() == "interrupted\n"
            assert time.monotonic() - begin < 5
        assert line == "usable\n"
        assert process.wait() == 0


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Many triangles in one place, and as many boxes as take a while to read."""
    folder = tmp_path_factory.mktemp("files")
    triangles = (f"o t{i}\nv 0 0 0\nv 1 0 0\nv 0 1 1\nf -1 -2 -3\n" for i in range(2500))
    (folder / "heap.obj").write_text("".join(triangles))
    (folder / "boxes.csv").write_text("0.125,0.25,0.5,1.125,1.25,1.5\n" * 400_000)
    return folder / "heap.obj", folder / "boxes.csv"


@pytest.mark.parametrize("name", FEW_SEARCHES)
def test_ctrl_c_ends_what_takes_no_thread(name, files):
    if name in ("detect", "load") and not READS_FILES:
        pytest.skip("this build of allpairs reads no files")
    with run(FEW + FEW_SEARCHES[name] + "\nprint('usable')", *files) as process:
        assert process.communicate()[0] == "usable\n"


def test_a_handler_that_raises_nothing_runs_during_the_search_and_changes_nothing():
    program = """
seen = []
world = allpairs.World()
world.add(row[:100_000])
signal.signal(signal.SIGALRM, lambda *_: seen.append(len(world)))
signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
for strategy in ("bvh", "exhaustive"):
    for threads in (1, 2):
        assert allpairs.count(row[:100_000], strategy=strategy, threads=threads) == 0
during = len(seen)
for _ in range(5):
    world.move(np.arange(100_000), row[:100_000] + 0.5)
    assert len(world.step().pairs) == 0
signal.setitimer(signal.ITIMER_REAL, 0)
assert during > 1, seen
assert set(seen) == {100_000}, seen
print("usable")
"""
    with run(program) as process:
        assert process.communicate()[0] == "usable\n"


def test_handlers_run_during_a_search_of_few_boxes_beside_many_that_worlds_share():
    program = """
few, many = heap[:200], heap[:100_000]
def searches():
    yield allpairs.count_in_worlds(few, offsets=[0, 200], shared=many).tolist(), [20_000_000]
    yield len(allpairs.overlaps_in_worlds(few, offsets=[0, 200], shared=many)[0]), 20_000_000
seen = []
signal.signal(signal.SIGALRM, lambda *_: seen.append(1))
found = searches()
for _ in range(2):
    seen.clear()
    signal.setitimer(signal.ITIMER_REAL, 0.001, 0.001)
    result, expected = next(found)
    signal.setitimer(signal.ITIMER_REAL, 0)
    assert result == expected
    assert len(seen) > 10, len(seen)  # before and after the search it is three
print("usable")
"""
    with run(program) as process:
        assert process.communicate()[0] == "usable\n"
