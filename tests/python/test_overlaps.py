# SPDX-License-Identifier: MIT
"""Pairs of one set and of two: every dtype, layout, distance, order, strategy and number of threads."""

import ctypes
import gc
import sys

import allpairs
import numpy as np
import pytest
from allpairs import _arguments, _core
from conftest import Capsule, every_pair, every_pair_between, random_boxes


def assert_pairs(found, expected):
    assert found.dtype == np.uint32
    assert found.shape == expected.shape
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("n", [0, 1, 2, 17, 300, 1200])
def test_pairs_are_those_of_the_double_loop_in_order(n, dtype):
    lower, upper = random_boxes(n, seed=n, dtype=dtype)
    assert_pairs(allpairs.overlaps(lower, upper), every_pair(lower, upper))


@pytest.mark.parametrize("dtype", [np.float16, ">f8", ">f4", np.int32, np.uint8, np.int64, object])
def test_other_dtypes_are_taken_exactly_or_refused(dtype, boxes):
    lower, upper = np.abs(boxes[0]), np.minimum(np.abs(boxes[1]), 99)
    if dtype is object:
        with pytest.raises(allpairs.InvalidArgument, match="lower has dtype object"):
            allpairs.overlaps(lower.astype(dtype), upper)
    else:
        assert_pairs(allpairs.overlaps(lower.astype(dtype), upper.astype(dtype)), every_pair(lower, upper))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_types_that_name_the_byte_order_of_this_machine_are_taken_without_a_copy(dtype, boxes):
    here = np.dtype(dtype).newbyteorder("<" if sys.byteorder == "little" else ">")
    rows = np.hstack(boxes).astype(dtype)
    named = rows.view(here)
    assert memoryview(named).format == here.byteorder + memoryview(rows).format
    assert_pairs(allpairs.overlaps(named), every_pair(rows[:, :3], rows[:, 3:]))
    assert_pairs(allpairs.overlaps(named[:, :3], named[:, 3:]), every_pair(rows[:, :3], rows[:, 3:]))
    margin = np.ones(len(rows), dtype)
    assert_pairs(allpairs.overlaps(rows, margin=margin.view(here)), allpairs.overlaps(rows, margin=margin))
    assert np.shares_memory(_arguments.floats("lower", named), rows)


def test_arrays_of_ctypes_are_boxes():
    rows = np.array([[0.0, 0, 0, 2, 2, 2], [1, 1, 1, 3, 3, 3], [9, 9, 9, 9, 9, 9]])
    for kind in (ctypes.c_float, ctypes.c_double):
        memory = ((kind * 6) * 3)(*[(kind * 6)(*row) for row in rows])
        assert allpairs.overlaps(memory).tolist() == [[0, 1]]


def test_integers_that_float64_does_not_hold_are_refused():
    big = np.array([[2**53 + 1, 0, 0]])
    with pytest.raises(ValueError, match="beyond"):
        allpairs.overlaps(big, big)


def test_one_float32_and_one_float64_are_compared_in_double():
    lower = np.array([[0, 0, 0], [1, 0, 0]], dtype=np.float32)
    upper = np.array([[1 - 1e-12, 1, 1], [2, 1, 1]])
    assert len(allpairs.overlaps(lower, upper)) == 0
    assert len(allpairs.overlaps(lower, upper + 1e-12)) == 1


def layouts(lower, upper):
    """The same boxes in memory laid out in every way that NumPy has."""
    wide = np.full((3 * len(lower), 11), np.nan, dtype=lower.dtype)
    wide[::3, 1:7:2], wide[::3, 2:8:2] = lower, upper
    record = np.zeros(len(lower), dtype=[("tag", "i1"), ("low", lower.dtype, 3), ("high", lower.dtype, 3)])
    record["low"], record["high"] = lower, upper
    return {
        "fortran": (np.asfortranarray(lower), np.asfortranarray(upper)),
        "rows": (np.hstack([lower, upper]), None),
        "fortran rows": (np.asfortranarray(np.hstack([lower, upper])), None),
        "every third row, every second column": (wide[::3, 1:7:2], wide[::3, 2:8:2]),
        "backwards": (lower[::-1].copy()[::-1], upper[:, ::-1].copy()[:, ::-1]),
        "unaligned fields": (record["low"], record["high"]),
        "lists": (lower.tolist(), upper.tolist()),
    }


@pytest.mark.parametrize("name", layouts(*random_boxes(3)))
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_any_layout_gives_the_same_pairs(name, dtype):
    boxes = random_boxes(250, seed=3, dtype=dtype)
    lower, upper = layouts(*boxes)[name]
    assert_pairs(allpairs.overlaps(lower, upper), every_pair(*boxes))


@pytest.mark.parametrize("name", sorted(layouts(*random_boxes(3)).keys() - {"lists", "unaligned fields"}))
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_any_strides_are_read_where_they_are(name, dtype):
    lower, upper = layouts(*random_boxes(50, seed=3, dtype=dtype))[name]
    held = _arguments.box_set(lower, upper, None, float).boxes
    before = _core.count(held, _core.Options())
    for corner in (lower, upper):
        if corner is not None:
            corner[...] = 1  # the search sees what is written after it was given the arrays: all boxes are in one place
    assert before < _core.count(held, _core.Options()) == 50 * 49 // 2


def test_arrays_that_may_not_be_written_are_read(boxes):
    lower, upper = boxes
    lower.flags.writeable = False
    assert_pairs(allpairs.overlaps(lower, upper), every_pair(lower, upper))


def test_all_boxes_in_one_place_by_a_stride_of_zero():
    corner = np.broadcast_to(np.zeros(3), (100, 3))
    assert_pairs(allpairs.overlaps(corner, corner), every_pair(corner, corner))


@pytest.mark.parametrize("distance", [0.0, 1.0, 0.5, -1.0, np.inf])
def test_a_distance_widens_and_a_negative_one_shrinks(distance, boxes):
    assert_pairs(allpairs.overlaps(*boxes, distance=distance), every_pair(*boxes, distance=distance))


def test_margins_are_added_to_the_distance():
    lower = np.array([[0.0, 0, 0], [2, 0, 0], [4, 0, 0]])
    upper = lower + 1  # gaps of 1
    assert_pairs(allpairs.overlaps(lower, upper, margin=0.5), np.array([[0, 1], [1, 2]], dtype=np.uint32))
    assert_pairs(allpairs.overlaps(lower, upper, margin=[1, 0, 0.25]), np.array([[0, 1]], dtype=np.uint32))
    assert_pairs(allpairs.overlaps(lower, upper, margin=[0, 0, 0.25], distance=0.75), np.array([[1, 2]], dtype=np.uint32))


@pytest.mark.parametrize("strategy", ["auto", "exhaustive", "bvh"])
@pytest.mark.parametrize("threads", [0, 1, 3])
def test_strategy_and_threads_do_not_change_a_byte(strategy, threads):
    rng = np.random.default_rng(5)
    lower = rng.random((25_000, 3), dtype=np.float32)
    found = allpairs.overlaps(lower, lower + np.float32(0.02), strategy=strategy, threads=threads)
    assert_pairs(found, allpairs.overlaps(lower, lower + np.float32(0.02)))
    assert len(found) > 1000


def test_orders(boxes):
    expected = every_pair(*boxes)
    assert_pairs(allpairs.overlaps(*boxes, order="second"), expected[np.lexsort((expected[:, 0], expected[:, 1]))])
    found = allpairs.overlaps(*boxes, order="unordered")
    assert_pairs(found[np.lexsort((found[:, 1], found[:, 0]))], expected)


def test_counts_are_the_number_of_pairs(boxes):
    assert allpairs.count(*boxes) == len(every_pair(*boxes))
    assert allpairs.count(*boxes, distance=1, threads=2) == len(every_pair(*boxes, distance=1))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_pairs_between_two_sets_are_those_of_the_double_loop_in_order(dtype):
    first, second = random_boxes(300, seed=8), random_boxes(70, seed=9, dtype=dtype)
    expected = every_pair_between(first, second)
    assert_pairs(allpairs.overlaps_between(first, second), expected)
    assert_pairs(allpairs.overlaps_between(np.hstack(first), np.hstack(second)), expected)
    assert allpairs.count_between(first, np.hstack(second)) == len(expected)
    assert len(expected) > 100


def test_between_margins_are_given_for_each_set():
    first, second = [[0, 0, 0, 1, 1, 1]], [[2, 0, 0, 3, 1, 1], [5, 0, 0, 6, 1, 1]]
    assert allpairs.overlaps_between(first, second, margin=(0.5, [0.5, 3.5])).tolist() == [[0, 0], [0, 1]]
    assert allpairs.overlaps_between(first, second, margin=(None, [0.5, 4])).tolist() == [[0, 1]]


def test_the_result_lives_as_long_as_somebody_holds_it():
    found = allpairs.overlaps(np.zeros((60, 6)))
    part = found[5:7]
    del found
    gc.collect()
    assert part.tolist() == [[0, 6], [0, 7]]
    part[0, 0] = 9  # and is the caller's to write to
    assert part.tolist() == [[9, 6], [0, 7]]


def test_the_result_is_not_a_copy():
    assert not allpairs.overlaps(np.zeros((3, 6))).flags.owndata


def test_no_pairs_is_an_array_of_no_rows():
    for arguments in ([], []), (np.zeros((0, 6)),), (np.zeros((1, 6)),):
        found = allpairs.overlaps(*arguments)
        assert (found.shape, found.dtype) == ((0, 2), np.uint32)


def test_arrays_at_odd_addresses_are_read():
    boxes = np.sort(np.random.default_rng(3).random((50, 2, 3)), axis=1).reshape(50, 6)
    odd = np.frombuffer(b"x" + boxes.tobytes(), dtype=np.float64, offset=1).reshape(50, 6)
    groups = np.frombuffer(b"x" + np.arange(50, dtype=np.uint32).tobytes(), dtype=np.uint32, offset=1)
    assert not odd.flags.aligned and not groups.flags.aligned
    assert allpairs.overlaps(odd, group=groups).tolist() == allpairs.overlaps(boxes).tolist()
    assert allpairs.overlaps(odd[:, :3], odd[:, 3:], margin=odd[:, 0]).tolist() == (
        allpairs.overlaps(boxes, margin=boxes[:, 0]).tolist()
    )
    world = allpairs.World()
    world.add(odd[:, :3], odd[:, 3:], margin=odd[:, 0])
    assert len(world.step().pairs) == allpairs.count(boxes, margin=boxes[:, 0])


def test_arrays_that_have_nothing_but_dlpack_are_taken_everywhere():
    lower, upper = random_boxes(60, seed=8)
    group = np.arange(60, dtype=np.int64) % 7
    expected = allpairs.overlaps(lower, upper, margin=lower[:, 0], group=group).tolist()
    low, high, labels = Capsule(lower), Capsule(upper), Capsule(group)
    assert allpairs.overlaps(low, high, margin=Capsule(lower[:, 0]), group=labels).tolist() == expected
    assert allpairs.count_between((low, high), Capsule(np.hstack([lower, upper]))) == allpairs.count_between(
        (lower, upper), (lower, upper)
    )
    world = allpairs.World()
    world.add(low, high, margin=Capsule(lower[:, 0]), group=labels)
    assert world.step().pairs.tolist() == expected
    assert world.nearest(low)[1].tolist() == world.nearest(lower)[1].tolist()


def test_what_another_library_refuses_names_the_argument():
    reason = "it lies in the memory of a GPU"

    class Exchanged(Capsule):
        def __dlpack__(self, **settings):
            raise BufferError(reason)

    class Converted:
        def __array__(self, *settings, **more):
            raise TypeError(reason)

    corners = np.zeros((2, 3))
    for elsewhere in (Exchanged(corners), Converted()):
        for call in (allpairs.overlaps, allpairs.count, allpairs.neighbors, allpairs.World().add):
            with pytest.raises(allpairs.InvalidArgument, match=f"^upper cannot be read as an array: {reason}$"):
                call(corners, elsewhere)
        with pytest.raises(allpairs.InvalidArgument, match=f"^group cannot be read as an array: {reason}$"):
            allpairs.overlaps(corners, corners, group=elsewhere)
