# SPDX-License-Identifier: MIT
"""What is left out: by group, category and mask, by list, by region."""

from decimal import Decimal
from fractions import Fraction

import allpairs
import numpy as np
import pytest
from conftest import every_pair


def test_boxes_of_a_group_are_no_pair_and_group_0_is_none(boxes):
    group = np.arange(400) % 3
    first, second = every_pair(*boxes).T
    keep = (group[first] != group[second]) | (group[first] == 0)
    np.testing.assert_array_equal(allpairs.overlaps(*boxes, group=group), np.stack([first, second], axis=1)[keep])
    assert 0 < keep.sum() < len(keep)


@pytest.mark.parametrize("dtype", [np.uint32, np.int64, np.uint8])
def test_each_box_must_accept_the_other(dtype, boxes):
    rng = np.random.default_rng(4)
    category, mask = rng.integers(0, 8, (2, 400)).astype(dtype)
    first, second = every_pair(*boxes).T
    keep = (mask[first] & category[second] != 0) & (mask[second] & category[first] != 0)
    found = allpairs.overlaps(*boxes, category=category, mask=mask)
    np.testing.assert_array_equal(found, np.stack([first, second], axis=1)[keep])


@pytest.mark.parametrize("one", [int, np.uint32, np.int64, np.array])
def test_one_number_is_for_all_boxes(one, boxes):
    for name, number in (("group", 7), ("group", 0), ("mask", 6), ("mask", 0), ("category", 1)):
        alone = {name: one(number)}
        array = np.full(400, number)
        np.testing.assert_array_equal(allpairs.overlaps(*boxes, **alone), allpairs.overlaps(*boxes, **{name: array}))
        expected = allpairs.overlaps_between(boxes, boxes, **{name: (array, array)})
        np.testing.assert_array_equal(allpairs.overlaps_between(boxes, boxes, **alone), expected)
        expected = allpairs.overlaps_between(boxes, boxes, **{name: (None, array)})
        np.testing.assert_array_equal(allpairs.overlaps_between(boxes, boxes, **{name: (None, one(number))}), expected)
    wide = allpairs.overlaps_between(boxes, boxes, margin=(0.5, 0.5))
    np.testing.assert_array_equal(allpairs.overlaps_between(boxes, boxes, margin=0.5), wide)


@pytest.mark.parametrize(
    "number",
    [10**20, -(10**20), 2**53 + 1, Fraction(1, 2), Decimal("-0.5"), np.longdouble(1.5), np.array(10**20), np.float16(0.5), True],
)
def test_a_margin_for_all_boxes_is_any_number_that_a_distance_is(number, boxes):
    lower, upper = boxes
    expected = allpairs.overlaps(lower, upper, distance=2 * float(number))
    np.testing.assert_array_equal(allpairs.overlaps(lower, upper, margin=number), expected)
    np.testing.assert_array_equal(allpairs.overlaps_in_worlds(lower, upper, [0, len(lower)], margin=number)[0], expected)
    of_one = allpairs.overlaps_between((lower, upper), (lower, upper), margin=(number, None))
    np.testing.assert_array_equal(of_one, allpairs.overlaps_between((lower, upper), (lower, upper), distance=number))
    flat = lower[:, :2], upper[:, :2]
    in_plane = allpairs.overlaps(*flat, distance=2 * float(number))
    np.testing.assert_array_equal(allpairs.overlaps(*flat, margin=number), in_plane)
    world = allpairs.World()
    ids = world.add(lower, upper, margin=number)
    np.testing.assert_array_equal(world.step().pairs, expected)
    world.set_properties(ids, margin=0)
    world.set_properties(ids, margin=number)
    assert set(world.properties(ids)["margin"]) == {float(number)}


def test_a_length_is_any_number_that_a_distance_is():
    world = allpairs.World()
    world.add([1e19, 0, 0, 1e20, 1, 1])
    for length, t in ((10**20, 1e19), (Fraction(1, 2), np.inf), (np.longdouble(2e19), 1e19)):
        assert world.first_hits([0, 0, 0], [1, 0, 0], length)[1].tolist() == [t]


def test_a_mask_alone_is_against_categories_of_all_bits(boxes):
    mask = (np.arange(400) % 2).astype(np.uint32)
    pairs = every_pair(*boxes)
    np.testing.assert_array_equal(allpairs.overlaps(*boxes, mask=mask), pairs[mask[pairs].all(axis=1)])


def test_ignored_pairs_are_left_out_in_either_orientation(boxes):
    pairs = every_pair(*boxes)
    ignore = np.vstack([pairs[::3], pairs[1::3, ::-1]])
    np.testing.assert_array_equal(allpairs.overlaps(*boxes, ignore=ignore), pairs[2::3])
    np.testing.assert_array_equal(allpairs.overlaps(*boxes, ignore=[]), pairs)


def test_ignored_pairs_of_two_sets_are_read_as_first_and_second():
    boxes = np.zeros((3, 6))
    found = allpairs.overlaps_between(boxes, boxes, ignore=[[0, 1], [2, 2]])
    assert found.tolist() == [[0, 0], [0, 2], [1, 0], [1, 1], [1, 2], [2, 0], [2, 1]]
    assert allpairs.overlaps_between(boxes, boxes[:1], ignore=[[2, 0]]).tolist() == [[0, 0], [1, 0]]
    with pytest.raises(allpairs.InvalidArgument, match=r"ignore row 1 is \(2, 1\); the number of boxes is 3 and 1"):
        allpairs.overlaps_between(boxes, boxes[:1], ignore=[[2, 0], [2, 1]])


def test_boxes_outside_of_the_region_are_left_out(boxes):
    lower, upper = boxes
    inside = ((lower <= 12) & (upper >= 6)).all(axis=1)
    pairs = every_pair(lower, upper)
    expected = pairs[inside[pairs].all(axis=1)]
    np.testing.assert_array_equal(allpairs.overlaps(lower, upper, region=[[6] * 3, [12] * 3]), expected)
    np.testing.assert_array_equal(allpairs.overlaps(lower, upper, region=np.array([6] * 3 + [12] * 3)), expected)


def test_between_filters_are_given_for_each_set():
    boxes = np.zeros((2, 6))
    assert allpairs.overlaps_between(boxes, boxes, group=([1, 2], [1, 2])).tolist() == [[0, 1], [1, 0]]
    assert allpairs.overlaps_between(boxes, boxes, category=([1, 2], None), mask=(None, [2, 3])).tolist() == [
        [0, 1],
        [1, 0],
        [1, 1],
    ]
    assert allpairs.count_between(boxes, boxes, group=([1, 2], [1, 2])) == 2
