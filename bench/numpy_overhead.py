# SPDX-License-Identifier: MIT
"""What a search from NumPy costs beside the same search through the C interface, which is the engine and no copy.

    PYTHONPATH=build/dev/python python3 bench/numpy_overhead.py build/dev/src/c/liballpairs_c.so

Both run in turn on the same arrays in one process; least processor time of many. The column `ratio` is NumPy's time by
C's. Both find from scratch, without memory from a search before.
"""

import ctypes
import sys
import time

import allpairs
import numpy as np

REPEATS = {1_000: 2000, 100_000: 60, 1_000_000: 25}


class Pairs(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("count", ctypes.c_size_t)]


def c_search(library, rows):
    """One search through the C interface; returns the number of pairs."""
    boxes, search, pairs = ctypes.c_void_p(), ctypes.c_void_p(), Pairs()
    create = library.allpairs_set_create_f32 if rows.dtype == np.float32 else library.allpairs_set_create_f64
    assert create(rows.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(len(rows)), ctypes.byref(boxes)) == 0
    assert library.allpairs_search_create(None, ctypes.byref(search)) == 0
    assert library.allpairs_find(search, boxes, ctypes.byref(pairs)) == 0
    library.allpairs_search_destroy(search)
    library.allpairs_set_destroy(boxes)
    return pairs.count


def seconds(call):
    begin = time.process_time()
    call()
    return time.process_time() - begin


def scene(n, dtype):
    """Boxes of about 2.3 pairs each, whatever their number."""
    rng = np.random.default_rng(1)
    side = n ** (1 / 3)
    lower = rng.random((n, 3)) * side
    return np.hstack([lower, lower + rng.random((n, 3)) * 1.66]).astype(dtype)


def main(path):
    library = ctypes.CDLL(path)
    print("boxes      type     pairs      C, ms      NumPy, ms  ratio")
    for n, repeats in REPEATS.items():
        for dtype in (np.float32, np.float64):
            rows = scene(n, dtype)
            assert c_search(library, rows) == len(allpairs.overlaps(rows))
            times = [(seconds(lambda: c_search(library, rows)), seconds(lambda: allpairs.overlaps(rows))) for _ in range(repeats)]
            c, python = (1e3 * least for least in np.min(times, axis=0))
            count = allpairs.count(rows)
            print(f"{n:<10,} {dtype.__name__:8} {count:<10,} {c:<10.4f} {python:<10.4f} {python / c:.3f}")


main(sys.argv[1])
