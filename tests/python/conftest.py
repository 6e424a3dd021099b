# SPDX-License-Identifier: MIT
"""The oracle, which shares no code with what it tests, and boxes for it."""

import importlib.util
import sys
import types

import allpairs
import numpy as np
import pytest

READS_FILES = importlib.util.find_spec("allpairs._files") is not None


class NoReading(types.ModuleType):
    """In place of what a build without the readers of files lacks: who uses it is skipped."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        pytest.skip("this build of allpairs reads no files")


if not READS_FILES:
    allpairs._reading = sys.modules["allpairs._reading"] = NoReading("allpairs._reading")


def every_pair(lower, upper, distance=0.0):
    """Every pair of the plain double loop, by broadcasting, in ascending order."""
    lower, upper = np.asarray(lower, dtype=np.float64), np.asarray(upper, dtype=np.float64)
    apart = lower[:, None] > upper[None] + distance
    full = (lower <= upper).all(axis=1)
    meet = ~(apart | apart.transpose(1, 0, 2)).any(axis=2) & full[:, None] & full
    return np.argwhere(np.triu(meet, k=1)).astype(np.uint32)


def every_pair_between(first, second, distance=0.0):
    """Those of a box of the first set and a box of the second, each numbered in its own; both (lower, upper)."""
    (lower_a, upper_a), (lower_b, upper_b) = (np.asarray(corner, np.float64).T for corner in first), (
        np.asarray(corner, np.float64).T for corner in second
    )
    meet = (lower_a <= upper_a).all(axis=0)[:, None] & (lower_b <= upper_b).all(axis=0)
    for low_a, high_a, low_b, high_b in zip(lower_a, upper_a, lower_b, upper_b):
        meet &= ~((low_a[:, None] > high_b + distance) | (low_b > (high_a + distance)[:, None]))
    return np.argwhere(meet).astype(np.uint32)


def every_kept_pair(boxes, *, distance=0.0, margin=0.0, region=None, group=0, category=~0, mask=~0):
    """Those of the double loop with all that a search may be told; a row of `boxes` is six numbers."""
    lower, upper = corners(np.asarray(boxes, dtype=np.float64))
    margin = np.broadcast_to(np.float64(margin), len(lower))
    apart_at = ((distance + margin)[:, None] + margin)[..., None]  # of row i and column j: as the first and the second
    kept = ~((lower[:, None] > upper + apart_at) | (lower > upper[:, None] + apart_at)).any(axis=2)
    single = (lower <= upper).all(axis=1)
    if region is not None:
        low, high = np.asarray(region, dtype=np.float64).reshape(2, 3)
        apart_at = (distance + margin)[:, None]
        single &= ~((lower > high + apart_at) | (low > upper + apart_at)).any(axis=1)
    group, category, mask = (np.broadcast_to(np.asarray(values), len(lower)) for values in (group, category, mask))
    kept &= single[:, None] & single
    kept &= (group[:, None] != group) | (group == 0)
    kept &= ((mask[:, None] & category) != 0) & ((category[:, None] & mask) != 0)
    return np.argwhere(np.triu(kept, k=1)).astype(np.uint32)


def every_kept_pair_between(first, second, **options):
    """The same of two sets, each numbered by itself; margins and the like are tuples of two arrays."""
    both = {name: np.concatenate(value) if isinstance(value, tuple) else value for name, value in options.items()}
    pairs = every_kept_pair(np.vstack([first, second]), **both)
    n = len(first)
    return pairs[(pairs[:, 0] < n) & (pairs[:, 1] >= n)] - np.array([0, n], dtype=np.uint32)


def corners(rows):
    """Rows of six numbers as (lower, upper)."""
    return rows[:, :3], rows[:, 3:]


def random_boxes(n, seed=1, dtype=np.float64):
    """Boxes on a coarse grid, so that many touch exactly, a few of them empty or without end."""
    rng = np.random.default_rng(seed)
    lower = rng.integers(0, 24, (n, 3)).astype(dtype)
    upper = lower + rng.integers(0, 5, (n, 3)).astype(dtype)
    upper[::17, 1] = lower[::17, 1] - 1
    upper[5::53] = np.inf
    return lower, upper


def plane_boxes(n=300, seed=21, dtype=np.float64):
    lower, upper = random_boxes(n, seed, dtype)
    return lower[:, :2], upper[:, :2]


def what_boxes_may_have(n, seed):
    """Margins, groups, categories and masks of so many boxes, each of which decides something."""
    rng = np.random.default_rng(seed)
    margin = np.where(rng.random(n) < 0.02, 4.0, rng.random(n) - 0.25)  # some are negative, and a few are large
    bits = rng.integers(1, 8, (2, n)).astype(np.uint32)
    return {"margin": margin, "group": rng.integers(0, 40, n).astype(np.uint32), "category": bits[0], "mask": bits[1]}


class Capsule:
    """What has nothing but __dlpack__."""

    def __init__(self, held):
        self.held = held

    def __dlpack__(self, **settings):
        return self.held.__dlpack__(**settings)

    def __dlpack_device__(self):
        return self.held.__dlpack_device__()


@pytest.fixture
def boxes():
    return random_boxes(400)
