# SPDX-License-Identifier: MIT
"""What a World can be asked, against double loops."""

import threading

import allpairs
import numpy as np
import pytest
from conftest import every_kept_pair_between, plane_boxes, random_boxes, what_boxes_may_have

BOX = [0, 0, 0, 1, 1, 1]


def hits_of(moving, way, length, lower, upper):
    """In ascending (t, id), which boxes a box meets on its way, and when: one axis after the other, in double. Those that
    are met by nothing have an upper corner of minus infinity."""
    axes = len(way)
    begin, end = np.zeros(len(lower)), np.full(len(lower), float(length))
    if (moving[:axes] > moving[axes:]).any():
        return []
    for axis in range(axes):
        ahead, behind = lower[:, axis] - moving[axes + axis], upper[:, axis] - moving[axis]
        if way[axis] == 0:
            begin[(ahead > 0) | (behind < 0)] = np.inf
            continue
        first, last = (ahead, behind) if way[axis] > 0 else (behind, ahead)
        begin, end = np.maximum(begin, first / way[axis]), np.minimum(end, last / way[axis])
    hit = np.flatnonzero((begin <= end) & np.isfinite(begin))
    return sorted((begin[id], id) for id in hit)


def check_hits(asked, sweeps, expected, **filters):
    """Both queries of a world against lists of (t, id); `sweeps` are their first three arguments."""
    indptr, ids, t = asked.all_hits(*sweeps, **filters)
    assert (indptr.dtype, ids.dtype, t.dtype) == (np.int64, np.uint32, np.float64)
    np.testing.assert_array_equal(indptr, np.cumsum([0] + [len(hits) for hits in expected]))
    assert list(zip(t.tolist(), ids.tolist())) == [hit for hits in expected for hit in hits]
    ids, t = asked.first_hits(*sweeps, **filters)
    first = [hits[0] if hits else (np.inf, allpairs.NO_BOX) for hits in expected]
    assert list(zip(t.tolist(), ids.tolist())) == first


def motions(count, axes, seed):
    """Directions, some of which leave an axis as it is or begin nowhere to go; and lengths, some of them without end."""
    rng = np.random.default_rng(seed)
    ways = rng.integers(-3, 4, (count, axes)).astype(float)
    return ways, np.where(rng.random(count) < 0.3, np.inf, rng.integers(0, 9, count))


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_rays_and_moving_boxes_hit_what_the_double_loop_hits(dtype, threads):
    lower, upper = random_boxes(300, 31, dtype)
    upper[5::53] = lower[5::53] + 9  # no end: a quotient of infinities decides nothing
    margin = np.random.default_rng(32).integers(-1, 3, 300) / 4
    world = allpairs.World(threads=threads, distance=3)
    world.add(lower, upper, margin=margin)
    full = (lower <= upper).all(axis=1)
    wide_lower, wide_upper = lower - margin[:, None], upper + margin[:, None]
    wide_upper[~full] = -np.inf
    begin, end = random_boxes(80, 33)
    end[5::53] = begin[5::53]
    ways, length = motions(80, 3, 34)
    boxes = np.hstack([begin, end])
    expected = [hits_of(*sweep, wide_lower, wide_upper) for sweep in zip(boxes, ways, length)]
    assert sum(map(len, expected)) > 300
    check_hits(world, (boxes, ways, length), expected)
    points = np.hstack([begin, begin])
    expected = [hits_of(*sweep, wide_lower, wide_upper) for sweep in zip(points, ways, length)]
    assert sum(map(len, expected)) > 100
    check_hits(world, (begin, ways, length), expected)


def test_boxes_that_move_in_the_plane_hit_what_the_double_loop_hits():
    lower, upper = plane_boxes(300, 35)
    begin, end = plane_boxes(60, 36)
    upper[5::53], end[5::53] = lower[5::53] + 9, begin[5::53]
    upper[(lower > upper).any(axis=1)] = -np.inf
    world = allpairs.World()
    world.add(lower, upper)
    ways, length = motions(60, 2, 37)
    boxes = np.hstack([begin, end])
    check_hits(world, (boxes, ways, length), [hits_of(*s, lower, upper) for s in zip(boxes, ways, length)])
    points = np.hstack([begin, begin])
    check_hits(world, (begin, ways, length), [hits_of(*s, lower, upper) for s in zip(points, ways, length)])


def test_hits_are_filtered():
    lower, upper = random_boxes(200, 38)
    upper = np.maximum(lower, np.minimum(upper, lower + 5))
    rng = np.random.default_rng(39)
    category, mask = rng.integers(1, 8, (2, 200))
    static, number = rng.integers(0, 2, 200).astype(bool), rng.integers(0, 3, 200)
    world = allpairs.World()
    world.add(lower, upper, category=category, mask=mask, static=static, world=number)
    boxes, way = np.hstack([lower[:20], upper[:20]]), np.array([1.0, -1, 0.5])
    everything = [hits_of(box, way, 9, lower, upper) for box in boxes]
    for filters, kept in (
        ({"category": 2, "mask": 5}, ((category & 5) != 0) & ((mask & 2) != 0)),
        ({"static": False}, ~static),
        ({"moving": False}, static),
        ({"world": 1}, number == 1),
    ):
        expected = [[hit for hit in hits if kept[hit[1]]] for hits in everything]
        assert 0 < sum(map(len, expected)) < sum(map(len, everything))
        check_hits(world, (boxes, way, 9), expected, **filters)


def test_one_may_be_given_for_all_and_nothing_hits_nothing():
    world = allpairs.World()
    world.add([[3, 0, 0, 4, 1, 1], [6, 0, 0, 7, 1, 1]])
    check_hits(world, (BOX, [1, 0, 0]), [[(2, 0), (5, 1)]])
    check_hits(world, (BOX, [1, 0, 0], 2), [[(2, 0)]])  # it touches
    check_hits(world, (BOX, [[4, 0, 0], [0, 1, 0], [-1, 0, 0]], 1), [[(0.5, 0)], [], []])
    check_hits(world, ([0.5, 0.5, 0.5], [[1, 0, 0], [2, 0, 0]]), [[(2.5, 0), (5.5, 1)], [(1.25, 0), (2.75, 1)]])
    check_hits(world, ([BOX, [5, 5, 5, 6, 6, 6], [2, 0, 0, 1, 1, 1]], [1, 0, 0]), [[(2, 0), (5, 1)], [], []])
    for nothing in ([], np.zeros((0, 3)), np.zeros((0, 6))):
        check_hits(world, (nothing, [1, 0, 0]), [])
    check_hits(allpairs.World(), (BOX, [1, 0, 0]), [[]])


@pytest.mark.parametrize("query", ["first_hits", "all_hits"])
@pytest.mark.parametrize(
    "arguments, message",
    [
        (([0, np.nan, 0], [1, 0, 0]), "ray 0: its origin is not finite"),
        ((BOX, [1, np.inf, 0]), "sweep 0: its motion is not finite"),
        ((BOX, [1, 0, 0], -1), "sweep 0: its length is NaN or negative"),
        (([0, 0, 0], [1, 0, 0], np.nan), "ray 0: its length is NaN or negative"),
        (([0] * 5, [1, 0, 0]), r"origins has shape \(5,\); it takes \(k, 3\) or \(k, 2\), and for boxes \(k, 6\) or \(k, 4\)"),
        ((np.zeros((2, 2, 6)), [1, 0, 0]), r"origins has shape \(2, 2, 6\); it takes"),
        ((BOX, [1, 0]), r"origins has shape \(6,\), directions \(2,\): not of the same axes"),
        (([0, 0, 1, 1], [1, 0, 0]), r"origins has shape \(4,\), directions \(3,\): not of the same axes"),
        ((BOX, BOX), r"directions has shape \(1, 6\); it takes \(k, 3\) or \(k, 2\)"),
        (([BOX] * 2, np.ones((3, 3))), "origins has 2 rows and directions 3"),
        ((BOX, [1, 0, 0], [1, 2]), r"length has shape \(2,\); for 1 rays it takes \(1,\)"),
        ((["a"] * 6, [1, 0, 0]), "origins has dtype <U1"),
        ((np.zeros(6, complex), [1, 0, 0]), "origins has dtype complex128"),
        ((np.ma.masked_less(np.zeros(6), 1), [1, 0, 0]), "origins has masked entries"),
        ((None, [1, 0, 0]), "origins "),
    ],
)
def test_hits_of_nonsense_are_refused_in_a_line(query, arguments, message):
    world = allpairs.World()
    world.add([BOX])
    with pytest.raises(allpairs.InvalidArgument, match="^" + message) as caught:
        getattr(world, query)(*arguments)
    assert "\n" not in str(caught.value)
    with pytest.raises(allpairs.InvalidArgument, match="^world is 4294967295"):
        getattr(world, query)(BOX, [1, 0, 0], world=allpairs.EVERY_WORLD)
    with pytest.raises(allpairs.InvalidBox, match="^sweep 1: its box has a NaN") as caught:
        getattr(world, query)([BOX, [0, 0, 0, 1, np.nan, 1]], [1, 0, 0])
    assert caught.value.index == 1


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("order", ["first", "second"])
def test_two_worlds_meet_where_the_double_loop_says(order, threads):
    boxes = [np.hstack(random_boxes(n, seed)) for n, seed in ((300, 41), (170, 42))]
    has = [what_boxes_may_have(n, seed) for n, seed in ((300, 43), (170, 44))]
    worlds = []
    for rows, each, distance in zip(boxes, has, (0.5, 1.5)):
        worlds.append(allpairs.World(distance=distance, order=order, threads=threads))
        worlds[-1].add(rows, **each, static=True)  # which are pairs here all the same
    both = {name: (has[0][name], has[1][name]) for name in has[0]}
    expected = every_kept_pair_between(*boxes, distance=1.0, **both)
    assert len(expected) > 50
    if order == "second":
        expected = expected[np.lexsort(expected.T)]
    found = worlds[0].overlaps_between(worlds[1])
    assert found.dtype == np.uint32
    np.testing.assert_array_equal(found, expected)
    for world in worlds:  # ids, and not rows
        world.remove(np.arange(0, 100, 3))
    expected = expected[((expected >= 100) | (expected % 3 != 0)).all(axis=1)]
    np.testing.assert_array_equal(worlds[0].overlaps_between(worlds[1]), expected)


def test_two_worlds_meet_by_number_and_a_world_meets_itself():
    world, other = allpairs.World(), allpairs.World()
    assert world.overlaps_between(other).shape == (0, 2)
    world.add([BOX, BOX, BOX], world=[1, 2, allpairs.EVERY_WORLD])
    assert world.overlaps_between(other).shape == (0, 2)
    other.add([BOX, BOX], world=[2, 3])
    assert world.overlaps_between(other).tolist() == [[1, 0], [2, 0], [2, 1]]
    assert world.overlaps_between(world).tolist() == [[0, 0], [0, 2], [1, 1], [1, 2], [2, 0], [2, 1], [2, 2]]
    for wrong in (None, [BOX], "world", world._core):
        with pytest.raises(TypeError, match="^other is .*; it takes a World$") as caught:
            world.overlaps_between(wrong)
        assert "\n" not in str(caught.value)


def test_two_worlds_that_ask_each_other_on_two_threads_end():
    worlds = [allpairs.World(), allpairs.World()]
    for world in worlds:
        world.add(np.tile(BOX, (30, 1)))
    found = []

    def ask(first, second):
        for _ in range(300):
            found.append(len(first.overlaps_between(second)))

    threads = [threading.Thread(target=ask, args=pair) for pair in (worlds, worlds[::-1], (worlds[0], worlds[0]))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [900] * 900


def test_properties_are_those_that_were_given():
    rng = np.random.default_rng(45)
    given = {name: rng.integers(0, 2**32, 50) for name in ("category", "mask", "group", "world")}
    given["static"] = rng.integers(0, 2, 50).astype(bool)
    given["margin"] = rng.random(50)
    world = allpairs.World()
    ids = world.add(np.tile(BOX, (50, 1)), **given)
    some = ids[[7, 3, 3, 49]]
    found = world.properties(some)
    assert set(found) == set(given)
    for name, values in found.items():
        kind = {"margin": np.float64, "static": np.bool_}.get(name, np.uint32)
        assert (values.dtype, values.shape) == (kind, (4,))
        np.testing.assert_array_equal(values, given[name][some])
    twin = allpairs.World()
    twin.add(np.tile(BOX, (50, 1)))
    twin.set_properties(ids, **world.properties(ids))
    for name, values in twin.properties(ids).items():
        np.testing.assert_array_equal(values, given[name])
    assert world.properties(3)["margin"].tolist() == [given["margin"][3]]
    assert [values.shape for values in world.properties([]).values()] == [(0,)] * 6


@pytest.mark.parametrize("get", ["properties", "boxes"])
def test_what_is_asked_of_a_box_that_is_not_there_names_it(get):
    world = allpairs.World()
    world.add([BOX] * 3)
    world.remove(1)
    with pytest.raises(allpairs.InvalidBox, match="^there is no box with the id 1, entry 2 of the ids$") as caught:
        getattr(world, get)([0, 2, 1])
    assert caught.value.index == 2
    for ids, message in (
        ([True], "ids has dtype bool"),
        ([0.5], "ids has dtype float64"),
        ([[0, 2]], r"ids has shape \(1, 2\)"),
        ([-1], r"ids\[0\] is -1"),
    ):
        with pytest.raises(allpairs.Error, match="^" + message):
            getattr(world, get)(ids)


def test_a_world_that_is_cleared_has_no_boxes():
    world = allpairs.World()
    world.clear()
    world.add([BOX] * 3)
    world.step()
    world.clear()
    assert (len(world), world.ids().tolist(), 0 in world) == (0, [], False)
    assert world.step().ended.tolist() == [[0, 1], [0, 2], [1, 2]]
    assert world.add([BOX])[0] < 3
