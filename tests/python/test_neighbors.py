# SPDX-License-Identifier: MIT
"""Rows of neighbors: against the double loop's pairs, and as SciPy reads them."""

import allpairs
import numpy as np
import pytest
from conftest import every_pair, random_boxes


def rows_of(pairs, boxes):
    """The CSR arrays of some pairs."""
    pairs = np.array(sorted(map(tuple, pairs.tolist())), dtype=np.int64).reshape(-1, 2)
    counts = np.bincount(pairs[:, 0], minlength=boxes)
    return np.concatenate([[0], np.cumsum(counts)]), pairs[:, 1]


def assert_rows(found, pairs, boxes):
    indptr, indices = found
    expected = rows_of(pairs, boxes)
    assert indptr.dtype == np.int64
    assert indices.dtype == np.uint32
    np.testing.assert_array_equal(indptr, expected[0])
    np.testing.assert_array_equal(indices, expected[1])


@pytest.mark.parametrize("strategy", ["auto", "exhaustive", "bvh"])
@pytest.mark.parametrize("n", [0, 1, 2, 17, 300, 1200])
def test_rows_are_the_pairs_of_the_double_loop(n, strategy):
    lower, upper = random_boxes(n, seed=n)
    for settings in ({}, {"distance": 1.5}, {"threads": 2, "distance": 0.5}):
        pairs = every_pair(lower, upper, distance=settings.get("distance", 0.0))
        half = allpairs.neighbors(lower, upper, form="half", strategy=strategy, **settings)
        assert_rows(half, pairs, n)
        full = allpairs.neighbors(lower, upper, strategy=strategy, **settings)
        assert_rows(full, np.vstack([pairs, pairs[:, ::-1]]), n)


def test_settings_are_those_of_overlaps():
    lower, upper = random_boxes(200, seed=4)
    rng = np.random.default_rng(4)
    settings = {
        "margin": rng.random(200),
        "region": [0, 0, 0, 6, 6, 6],
        "group": rng.integers(0, 5, 200),
        "category": rng.integers(1, 8, 200),
        "mask": rng.integers(1, 8, 200),
        "ignore": [[3, 4], [7, 6]],
        "distance": 2.0,
    }
    pairs = allpairs.overlaps(lower, upper, **settings)
    assert 10 < len(pairs) < len(allpairs.overlaps(lower, upper, distance=2.0))
    assert_rows(allpairs.neighbors(lower, upper, form="half", **settings), pairs, 200)
    assert_rows(allpairs.neighbors(lower, upper, **settings), np.vstack([pairs, pairs[:, ::-1]]), 200)
    with pytest.raises(allpairs.LimitExceeded):
        allpairs.neighbors(lower, upper, max_pairs=len(pairs) - 1, **settings)
    assert_rows(allpairs.neighbors(lower, upper, form="half", max_pairs=len(pairs), **settings), pairs, 200)


def test_rows_between_two_sets_are_those_of_the_first():
    first, second = random_boxes(150, seed=5), random_boxes(90, seed=6)
    for settings in ({}, {"distance": 1.0, "group": (np.arange(150) % 3, np.arange(90) % 3), "margin": (0.5, None)}):
        pairs = allpairs.overlaps_between(first, second, **settings)
        assert len(pairs) > 0
        assert_rows(allpairs.neighbors_between(first, second, **settings), pairs, 150)
    nothing = np.empty((0, 6))
    assert_rows(allpairs.neighbors_between(first, nothing), np.empty((0, 2), dtype=int), 150)
    assert_rows(allpairs.neighbors_between(nothing, first), np.empty((0, 2), dtype=int), 0)


def test_another_form_is_refused():
    with pytest.raises(allpairs.InvalidArgument, match="form is 'upper'; it can be 'full', 'half'"):
        allpairs.neighbors(np.zeros((2, 6)), form="upper")


def test_rows_are_a_sparse_matrix():
    sparse = pytest.importorskip("scipy.sparse")
    lower, upper = random_boxes(300, seed=7)
    indptr, indices = allpairs.neighbors(lower, upper)
    matrix = sparse.csr_array((np.ones(len(indices)), indices, indptr), shape=(300, 300))
    assert matrix.has_canonical_format
    dense = np.zeros((300, 300))
    for i, j in every_pair(lower, upper):
        dense[i, j] = dense[j, i] = 1
    np.testing.assert_array_equal(matrix.toarray(), dense)
