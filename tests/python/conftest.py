# SPDX-License-Identifier: MIT
"""The oracle, which shares no code with what it tests, and boxes for it."""

import numpy as np
import pytest


def every_pair(lower, upper, distance=0.0):
    """Every pair of the plain double loop, by broadcasting, in ascending order."""
    lower, upper = np.asarray(lower, dtype=np.float64), np.asarray(upper, dtype=np.float64)
    apart = lower[:, None] > upper[None] + distance
    full = (lower <= upper).all(axis=1)
    meet = ~(apart | apart.transpose(1, 0, 2)).any(axis=2) & full[:, None] & full
    return np.argwhere(np.triu(meet, k=1)).astype(np.uint32)


def every_pair_between(first, second, distance=0.0):
    """Those of a box of the first set and a box of the second, each numbered in its own; both (lower, upper)."""
    lower, upper = np.vstack([first[0], second[0]]), np.vstack([first[1], second[1]])
    pairs = every_pair(lower, upper, distance)
    n = len(first[0])
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


@pytest.fixture
def boxes():
    return random_boxes(400)
