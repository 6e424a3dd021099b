# SPDX-License-Identifier: MIT
"""Boxes in the plane in a World, and queries there, against double loops over two axes."""

import pickle

import allpairs
import numpy as np
import pytest
from conftest import every_pair, plane_boxes


def meet(lower, upper, other_lower, other_upper, distance=0.0):
    """Which boxes of the one set overlap which of the other: a table."""
    lower, upper = np.asarray(lower, np.float64), np.asarray(upper, np.float64)
    apart = (lower[:, None] > other_upper[None] + distance) | (other_lower[None] > upper[:, None] + distance)
    full = (lower <= upper).all(axis=1)[:, None] & (other_lower <= other_upper).all(axis=1)
    return ~apart.any(axis=2) & full


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("distance", [0.0, 1.0, -1.0])
def test_steps_are_those_of_the_double_loop(dtype, distance):
    rng = np.random.default_rng(3)
    lower, upper = plane_boxes(300, 1, dtype)
    world = allpairs.World(distance=distance)
    ids = world.add(lower, upper)
    before = []
    for step in range(8):
        found, expected = world.step(), every_pair(lower, upper, distance).tolist()
        assert found.pairs.tolist() == expected
        assert found.began.tolist() == [pair for pair in expected if pair not in before]
        assert found.ended.tolist() == [pair for pair in before if pair not in expected]
        assert len(expected) > 20
        before = expected
        some = rng.choice(300, 40, replace=False)
        lower[some] = rng.integers(0, 40, (40, 2))
        upper[some] = lower[some] + 2
        if step % 2:
            world.move(ids[some], lower[some], upper[some])
        else:
            world.move(ids[some], np.hstack([lower[some], upper[some]]))


def test_negative_margins_set_later_ask_for_no_depth():
    lower, upper = plane_boxes(200, 2)
    world = allpairs.World(distance=0.5)
    ids = world.add(lower, upper)
    world.set_properties(ids, margin=-0.75)
    assert world.step().pairs.tolist() == every_pair(lower, upper, -1.0).tolist()


def test_swept_boxes_are_the_union_of_start_and_end():
    lower, upper = plane_boxes(100, 4)
    full = np.flatnonzero((lower <= upper).all(axis=1))
    lower, upper = lower[full], upper[full]
    world = allpairs.World()
    ids = world.add(lower, upper)
    world.move_swept(ids, (lower, upper), np.hstack([lower + [3, 0], upper + [3, 0]]))
    assert world.step().pairs.tolist() == every_pair(lower, upper + [3, 0]).tolist()


def test_overlapping_is_the_double_loop():
    lower, upper = plane_boxes(300, 5)
    asked_lower, asked_upper = plane_boxes(40, 6)
    world = allpairs.World()
    world.add(lower, upper)
    expected = np.argwhere(meet(asked_lower, asked_upper, lower, upper)).tolist()
    assert world.overlapping(asked_lower, asked_upper).tolist() == expected
    assert world.overlapping(np.hstack([asked_lower, asked_upper])).tolist() == expected
    first = [pair for pair in expected if pair[0] == 1]
    assert world.overlapping(asked_lower[1], asked_upper[1]).tolist() == [[0, other] for _, other in first]
    assert world.overlapping([*asked_lower[1], *asked_upper[1]]).tolist() == [[0, other] for _, other in first]


def test_the_nearest_boxes_are_those_of_the_double_loop():
    lower, upper = plane_boxes(300, 7)
    world = allpairs.World()
    world.add(lower, upper)
    points = np.random.default_rng(8).uniform(0, 45, (50, 2))
    ids, distances = world.nearest(points, k=3)
    for point, near, far in zip(points, ids, distances):
        away = np.hypot(*np.maximum(np.maximum(lower - point, point - upper), 0).T)
        away[(lower > upper).any(axis=1)] = np.inf
        order = np.lexsort([np.arange(300), away])[:3]
        np.testing.assert_array_equal(near, order)
        np.testing.assert_allclose(far, away[order])
    assert world.nearest(points[0], k=3)[0].tolist() == ids[:1].tolist()
    flat = np.hstack([points, points])  # boxes of a point each
    np.testing.assert_array_equal(world.nearest(flat, k=3)[0], ids)
    np.testing.assert_array_equal(world.nearest(flat, k=3)[1], distances)


def test_rays_hit_what_the_double_loop_hits_first():
    rng = np.random.default_rng(9)
    lower = rng.integers(0, 40, (300, 2)).astype(float)
    upper = lower + rng.integers(1, 4, (300, 2))
    world = allpairs.World()
    world.add(lower, upper)
    origins, ways = rng.uniform(-5, 45, (60, 2)), rng.uniform(-1, 1, (60, 2))
    ids, t = world.first_hits(origins, ways)
    for origin, way, hit, at in zip(origins, ways, ids, t):
        one, two = (lower - origin) / way, (upper - origin) / way
        enter = np.maximum(np.minimum(one, two).max(axis=1), 0)
        leave = np.maximum(one, two).min(axis=1)
        enter[enter > leave] = np.inf
        assert at == enter.min()
        assert hit == (np.argmin(enter) if np.isfinite(at) else allpairs.NO_BOX)
    assert 20 < np.isfinite(t).sum()


def test_boxes_have_no_end_in_depth_and_meet_boxes_of_three_axes_at_any():
    world = allpairs.World()
    world.add([0, 0, 1, 1])
    world.add([0, 0], [1, 1])
    world.add([[0, 0, 1e30, 1, 1, 1e30], [2, 2, 0, 3, 3, 0]])
    np.testing.assert_array_equal(world.boxes([1]), [[0, 0, -np.inf, 1, 1, np.inf]])
    assert world.step().pairs.tolist() == [[0, 1], [0, 2], [1, 2]]
    again = pickle.loads(pickle.dumps(world))
    assert again.step().pairs.tolist() == [[0, 1], [0, 2], [1, 2]]


def test_other_shapes_and_a_nan_are_refused_with_a_sentence():
    world = allpairs.World()
    world.add(np.zeros((2, 4)))
    with pytest.raises(ValueError, match=r"lower has shape \(2, 5\); alone it takes \(n, 6\) or \(n, 4\)"):
        world.add(np.zeros((2, 5)))
    with pytest.raises(ValueError, match=r"upper has shape \(2, 3\); it takes \(n, 2\)"):
        world.overlapping(np.zeros((2, 2)), np.zeros((2, 3)))
    with pytest.raises(ValueError, match=r"points has shape \(5,\); it takes \(k, 3\) or \(k, 2\), and for boxes \(k, 6\)"):
        world.nearest([0, 0, 0, 0, 0])
    with pytest.raises(allpairs.InvalidBox, match="^box 1: max y"):
        world.add([[0, 0, 1, 1], [0, 0, 1, np.nan]])
    assert len(world) == 2
    with pytest.raises(ValueError, match=r"origins has shape \(1, 2\), directions \(1, 3\): not of the same axes"):
        world.first_hits([[0, 0]], [[1, 0, 0]])
    with pytest.raises(ValueError, match=r"origins has shape \(3,\), directions \(2,\)"):
        world.first_hits([0, 0, 0], [1, 0])


def test_nothing_is_of_any_axes():
    world = allpairs.World()
    for lower, upper in (([], np.zeros((0, 2))), (np.zeros((0, 2)), []), ([], np.zeros((0, 3))), ([], [])):
        assert world.add(lower, upper).tolist() == []
        assert len(allpairs.overlaps(lower, upper)) == 0
