# SPDX-License-Identifier: MIT
"""Boxes in the plane: two axes, of which alone it depends what overlaps."""

import allpairs
import numpy as np
import pytest
from conftest import every_pair, plane_boxes


def plane_pairs(lower, upper, distance=0.0):
    """The double loop over two axes; the third is one where all overlap, however much is asked for."""
    n = len(lower)
    return every_pair(np.hstack([lower, np.full((n, 1), -1e9)]), np.hstack([upper, np.full((n, 1), 1e9)]), distance)


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.int64])
@pytest.mark.parametrize("distance", [0, 1, -1, -2.5])
def test_pairs_are_those_of_the_double_loop(dtype, distance):
    lower, upper = plane_boxes()
    if dtype is np.int64:
        upper[np.isinf(upper)] = 1000
    lower, upper = lower.astype(dtype), upper.astype(dtype)
    expected = plane_pairs(lower, upper, distance)
    assert len(expected) > 50
    for strategy in ("auto", "exhaustive", "bvh"):
        settings = {"distance": distance, "strategy": strategy}
        np.testing.assert_array_equal(allpairs.overlaps(lower, upper, **settings), expected)
        np.testing.assert_array_equal(allpairs.overlaps(np.hstack([lower, upper]), **settings), expected)
        assert allpairs.count(lower.tolist(), upper.tolist(), **settings) == len(expected)
    np.testing.assert_array_equal(np.vstack(list(allpairs.batches(lower, upper, distance=distance))), expected)


def test_without_negative_distances_it_is_as_if_they_had_no_depth():
    lower, upper = plane_boxes(2000, seed=22)
    none = np.zeros((2000, 1))
    expected = allpairs.overlaps(np.hstack([lower, none]), np.hstack([upper, none]), distance=0.5)
    np.testing.assert_array_equal(allpairs.overlaps(lower, upper, distance=0.5), expected)


@pytest.mark.parametrize("margins", [(-1.0, -0.5), (-1.0, 2.0)])
def test_negative_margins_ask_for_no_depth(margins):
    lower, upper = plane_boxes()
    margin = np.where(np.arange(300) % 2, *margins)
    deep = np.full((300, 1), 1e9)
    expected = allpairs.overlaps(np.hstack([lower, -deep]), np.hstack([upper, deep]), margin=margin)
    np.testing.assert_array_equal(allpairs.overlaps(lower, upper, margin=margin), expected)
    between = allpairs.overlaps_between((lower, upper), np.hstack([lower, upper]), margin=(margin, -0.25))
    expected = allpairs.overlaps_between(
        (np.hstack([lower, -deep]), np.hstack([upper, deep])),
        (np.hstack([lower, -deep]), np.hstack([upper, deep])),
        margin=(margin, -0.25),
    )
    assert len(expected) > 300
    np.testing.assert_array_equal(between, expected)


@pytest.mark.parametrize("distance", [0, -1])
def test_a_region_is_in_the_plane_too(distance):
    lower, upper = plane_boxes()
    low, high = np.array([3.0, 4.0]), np.array([12.0, 9.0])
    apart = (lower > high + distance) | (low > upper + distance)
    inside = ~apart.any(axis=1) & (lower <= upper).all(axis=1)
    expected = [pair for pair in plane_pairs(lower, upper, distance).tolist() if inside[pair].all()]
    assert 0 < len(expected) < len(plane_pairs(lower, upper, distance))
    for region in ([low, high], [*low, *high]):
        assert allpairs.overlaps(lower, upper, distance=distance, region=region).tolist() == expected


def test_a_set_without_boxes_has_any_number_of_axes():
    plane, space = np.zeros((2, 4)), np.zeros((2, 6))
    for some in (plane, space):
        for none in ([], np.zeros((0, 4)), np.zeros((0, 6))):
            assert allpairs.count_between(some, none) == allpairs.count_between(none, some) == 0
    assert allpairs.count(np.zeros((0, 2)), np.zeros((0, 2))) == allpairs.count([], []) == 0
    assert allpairs.count_between(plane, [], region=[0, 0, 1, 1]) == 0


@pytest.mark.parametrize("settings", [{}, {"distance": -1.0}, {"margin": -0.5}, {"region": [3, 4, 12, 9], "order": "second"}])
def test_worlds_in_the_plane_are_searched_like_each_alone(settings):
    lower, upper = plane_boxes()
    worlds, shared = np.hstack([lower, upper]).reshape(10, 30, 4), np.array([[2.0, 2, 9, 9], [5, 0, 6, 20]])
    for given in ((worlds,), (lower.reshape(10, 30, 2), upper.reshape(10, 30, 2)), (lower, upper, np.arange(11) * 30)):
        pairs, offsets = allpairs.overlaps_in_worlds(*given, **settings)
        with_shared, begin = allpairs.overlaps_in_worlds(*given, shared=shared, **settings)
        assert len(pairs) > 5 and len(with_shared) > 5
        both = settings | ({"margin": (settings["margin"], None)} if "margin" in settings else {})
        for k, world in enumerate(worlds):
            assert pairs[offsets[k] : offsets[k + 1]].tolist() == allpairs.overlaps(world, **settings).tolist()
            alone = allpairs.overlaps_between(world, shared, **both)
            assert with_shared[begin[k] : begin[k + 1]].tolist() == alone.tolist()


def test_worlds_and_what_they_share_have_the_same_axes():
    with pytest.raises(allpairs.InvalidArgument, match="the boxes of the worlds have 2 axes and the shared ones 3"):
        allpairs.overlaps_in_worlds(np.zeros((3, 2, 4)), shared=np.zeros((1, 6)))
    pairs, offsets = allpairs.overlaps_in_worlds(np.zeros((3, 2, 4)), shared=[])
    assert (len(pairs), offsets.tolist()) == (0, [0, 0, 0, 0])
    with pytest.raises(allpairs.InvalidArgument, match=r"without offsets it takes \(worlds, n, 6\) or \(worlds, n, 4\)"):
        allpairs.overlaps_in_worlds(np.zeros((3, 2, 5)))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("setting", [{"distance": -1e300}, {"margin": -1e39}, {"margin": [-1e300] * 3}])
def test_distances_that_float32_does_not_hold_warn_of_nothing(setting):
    boxes = np.float32([[0, 0, 1, 1], [0, 0, 1, 1], [-np.inf, -np.inf, np.inf, np.inf]])
    assert allpairs.overlaps(boxes, **setting).tolist() == allpairs.overlaps(boxes.astype(float), **setting).tolist()
    assert allpairs.count_in_worlds(boxes, offsets=[0, 3], **setting).tolist() == [allpairs.count(boxes, **setting)]


def test_a_nan_is_named_as_in_space():
    with pytest.raises(allpairs.InvalidBox, match="^box 1: max y"):
        allpairs.overlaps([[0, 0, 1, 1], [0, 0, 1, np.nan]])


@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("setting", [{"distance": -1e-46}, {"margin": -1e-50}, {"distance": -5e-324}])
def test_depth_decides_nothing_however_small_a_negative_distance_is(kind, setting):
    assert allpairs.overlaps(np.array([[0, 0, 2, 2], [1, 1, 3, 3]], kind), **setting).tolist() == [[0, 1]]
