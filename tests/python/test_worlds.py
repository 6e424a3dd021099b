# SPDX-License-Identifier: MIT
"""Many worlds in one call: each world's rows are those of the double loop, and those of a call for it alone."""

import array

import allpairs
import numpy as np
import pytest
from conftest import Capsule, every_pair, random_boxes

SIZES = [0, 1, 2, 15, 16, 17, 33, 64, 65, 300, 20, 0, 5]


def scene(dtype=np.float32):
    offsets = np.concatenate([[0], np.cumsum(SIZES)])
    lower, upper = random_boxes(offsets[-1], seed=3, dtype=dtype)
    return lower, upper, offsets


def assert_worlds(found, expected):
    pairs, offsets = found
    assert pairs.dtype == np.uint32
    assert offsets.dtype == np.int64
    assert len(offsets) == len(expected) + 1
    for k, rows in enumerate(expected):
        np.testing.assert_array_equal(pairs[offsets[k] : offsets[k + 1]], rows)


def overlaps_in_worlds(*arrays, **settings):
    """Pairs, as many as are counted."""
    found = allpairs.overlaps_in_worlds(*arrays, **settings)
    counts = allpairs.count_in_worlds(*arrays, **{name: value for name, value in settings.items() if name != "order"})
    assert counts.dtype == np.int64
    np.testing.assert_array_equal(counts, np.diff(found[1]))
    return found


def each(lower, upper, offsets, call):
    return [call(lower[a:b], upper[a:b]) for a, b in zip(offsets[:-1], offsets[1:])]


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("threads", [1, 3])
def test_rows_of_each_world_are_those_of_the_double_loop(dtype, threads):
    lower, upper, offsets = scene(dtype)
    expected = each(lower, upper, offsets, every_pair)
    assert_worlds(overlaps_in_worlds(lower, upper, offsets, threads=threads), expected)
    assert_worlds(overlaps_in_worlds(np.hstack([lower, upper]), offsets=offsets, threads=threads), expected)


@pytest.mark.parametrize("dtype", [np.int32, np.int64, np.uint32, np.uint64, ">i8", np.int16])
def test_offsets_are_of_any_integers(dtype):
    lower, upper, offsets = scene()
    assert_worlds(
        overlaps_in_worlds(lower, upper, offsets.astype(dtype)), each(lower, upper, offsets, every_pair)
    )


def test_worlds_of_equal_size_need_no_offsets():
    lower, upper = random_boxes(12 * 20, seed=4)
    offsets = np.arange(13) * 20
    expected = each(lower, upper, offsets, every_pair)
    low, high = lower.reshape(12, 20, 3), upper.reshape(12, 20, 3)
    assert_worlds(overlaps_in_worlds(low, high), expected)
    assert_worlds(overlaps_in_worlds(np.concatenate([low, high], axis=2)), expected)
    pairs, found = overlaps_in_worlds(np.empty((0, 20, 6)))
    assert pairs.shape == (0, 2)
    assert found.tolist() == [0]


def test_every_setting_holds_in_each_world():
    lower, upper, offsets = scene()
    rng = np.random.default_rng(5)
    n = len(lower)
    settings = {"margin": rng.random(n), "group": rng.integers(0, 4, n), "category": rng.integers(1, 8, n)}
    settings["mask"] = rng.integers(1, 8, n)
    common = {"distance": 0.5, "region": [0, 0, 0, 15, 15, 15], "order": "second"}
    expected = [
        allpairs.overlaps(lower[a:b], upper[a:b], **{key: value[a:b] for key, value in settings.items()}, **common)
        for a, b in zip(offsets[:-1], offsets[1:])
    ]
    assert_worlds(overlaps_in_worlds(lower, upper, offsets, **settings, **common), expected)


def test_a_filter_of_one_world_holds_for_all_of_equal_size():
    lower, upper = random_boxes(30 * 40, seed=6)
    group = np.arange(40) % 6
    ignore = np.stack([np.arange(1, 40), np.arange(39)], axis=1)
    ignore = np.vstack([ignore, np.tile(np.arange(40), (2, 1)).T])  # and every box with itself
    expected = [
        allpairs.overlaps(lower[a : a + 40], upper[a : a + 40], group=group, ignore=ignore) for a in range(0, 1200, 40)
    ]
    low, high = lower.reshape(30, 40, 3), upper.reshape(30, 40, 3)
    assert_worlds(overlaps_in_worlds(low, high, group=group, ignore=ignore), expected)
    every = np.tile(group, (30, 1))
    assert_worlds(overlaps_in_worlds(low, high, group=every, ignore=ignore), expected)


@pytest.mark.parametrize("worlds", [0, 1, 2])
@pytest.mark.parametrize("axes", [3, 2])
def test_what_is_given_of_one_world_holds_for_any_number_of_worlds(worlds, axes):
    one = np.hstack([np.zeros((5, axes)), np.ones((5, axes))])
    boxes, ground, numbers = np.tile(one, (worlds, 1, 1)), one[:3], np.arange(5)
    for name, value in {
        "group": numbers % 2,
        "category": numbers,
        "mask": numbers,
        "margin": numbers - 2.5,
        "ignore": [[0, 1], [4, 2]],
    }.items():
        pairs = allpairs.overlaps(one, **{name: value})
        assert 0 < len(pairs) < 10
        assert_worlds(overlaps_in_worlds(boxes, **{name: value}), [pairs] * worlds)
        pairs = allpairs.overlaps_between(one, ground, **{name: value if name == "ignore" else (value, None)})
        assert_worlds(overlaps_in_worlds(boxes, shared=ground, **{name: value}), [pairs] * worlds)
    for shared in (None, ground):
        for wrong, message in (
            ({"group": numbers[:4]}, "^group has shape"),
            ({"group": numbers - 1}, r"^group\[0\] is -1"),
            ({"margin": np.ones(4)}, "^margin has shape"),
            ({"ignore": [[0, 5]]}, r"\(0, 5\)"),
        ):
            with pytest.raises(allpairs.Error, match=message):
                overlaps_in_worlds(boxes, shared=shared, **wrong)


@pytest.mark.parametrize("wrong", [np.nan, -np.inf, 2**53 + 1, 2**70, "x"])
@pytest.mark.parametrize("axes", [3, 2])
def test_margins_of_one_world_get_the_same_error_whatever_the_number_of_worlds(wrong, axes):
    errors = []
    for worlds in (1, 0, 2):
        for shared in (None, np.zeros((1, 2 * axes))):
            with pytest.raises(allpairs.Error, match="margin") as caught:
                overlaps_in_worlds(np.zeros((worlds, 3, 2 * axes)), margin=[1, wrong, 1], shared=shared)
            errors.append((caught.type, str(caught.value), getattr(caught.value, "index", None)))
    assert errors == errors[:1] * 6


def test_shared_boxes_are_in_every_world():
    lower, upper, offsets = scene()
    shared = np.hstack(random_boxes(9, seed=7))

    def alone(a, b, ignore=(), **settings):
        here = [pair for pair in ignore if pair[0] < len(a)]  # a world may be smaller than the largest
        return allpairs.overlaps_between((a, b), shared, ignore=here, **settings)

    for settings in ({}, {"order": "second"}, {"ignore": [[0, 3], [1, 1]]}, {"distance": 1}):
        expected = each(lower, upper, offsets, lambda a, b, s=settings: alone(a, b, **s))
        assert_worlds(overlaps_in_worlds(lower, upper, offsets, shared=shared, **settings), expected)


def test_arrays_of_others_are_taken():
    lower, upper = random_boxes(60, seed=8, dtype=np.float32)
    rows = np.hstack([lower, upper]).reshape(3, 20, 6)
    expected = each(lower, upper, [0, 20, 40, 60], every_pair)
    assert_worlds(overlaps_in_worlds(Capsule(rows)), expected)
    assert_worlds(overlaps_in_worlds(memoryview(rows)), expected)
    offsets = array.array("q", [0, 20, 40, 60])
    assert_worlds(overlaps_in_worlds(Capsule(lower), Capsule(upper), offsets), expected)


@pytest.mark.parametrize(
    ("offsets", "message"),
    [
        ([0, 5, 4, 10], "world 1 begins at box 5 and ends at 4"),
        ([0, 5, 11], "world 1 ends at box 11, but there are 10 boxes"),
        ([1, 10], "world 0 begins at box 1"),
        ([0, 9], "the last world, 0, ends at box 9 of 10"),
        ([], "no offsets of worlds"),
        ([0, -1], r"offsets\[1\] is -1"),
        ([0.0, 10.0], "it takes integers"),
        ([[0, 10]], "it takes"),
    ],
)
def test_wrong_offsets_are_named(offsets, message):
    for call in (allpairs.overlaps_in_worlds, allpairs.count_in_worlds):
        with pytest.raises(allpairs.InvalidArgument, match=message):
            call(np.zeros((10, 6)), offsets=offsets)


def test_more_pairs_than_the_limit_are_refused_in_counts_too():
    boxes = np.zeros((10, 3, 6))
    assert allpairs.count_in_worlds(boxes, max_pairs=30).tolist() == [3] * 10
    with pytest.raises(allpairs.LimitExceeded):
        allpairs.count_in_worlds(boxes, max_pairs=29)
    with pytest.raises(TypeError):
        allpairs.count_in_worlds(boxes, order="first")


def test_wrong_shapes_are_named():
    with pytest.raises(allpairs.InvalidArgument, match=r"without offsets it takes \(worlds, n, 6\)"):
        allpairs.overlaps_in_worlds(np.zeros((10, 6)))
    with pytest.raises(allpairs.InvalidArgument, match="and upper"):
        allpairs.overlaps_in_worlds(np.zeros((10, 2, 3)), np.zeros((10, 3, 3)))
    with pytest.raises(allpairs.InvalidArgument, match="group has shape"):
        allpairs.overlaps_in_worlds(np.zeros((10, 2, 6)), group=[1, 2, 3])
    with pytest.raises(allpairs.InvalidArgument, match="in no world"):
        allpairs.overlaps_in_worlds(np.zeros((10, 2, 6)), ignore=[[0, 2]])
    bad = np.where(np.arange(60).reshape(5, 2, 6) == 43, np.nan, 0.0)
    with pytest.raises(allpairs.InvalidBox, match=r"^box 7 \(box 1 of world 3\): min y is not a number") as caught:
        allpairs.overlaps_in_worlds(bad)
    assert caught.value.index == 7
    with pytest.raises(allpairs.InvalidBox, match="^box 7: min y"):
        allpairs.count_in_worlds(bad.reshape(10, 6), offsets=[0, 9, 10])


def test_masked_entries_are_refused_and_one_number_holds_for_all_boxes():
    hidden = np.ma.masked_less(np.zeros((10, 2, 6)), 1)
    with pytest.raises(allpairs.InvalidArgument, match="lower has masked entries"):
        allpairs.overlaps_in_worlds(hidden)
    with pytest.raises(allpairs.InvalidArgument, match="offsets has masked entries"):
        allpairs.overlaps_in_worlds(np.zeros((10, 6)), offsets=np.ma.masked_equal([0, 10], 10))
    boxes = np.zeros((10, 2, 6))
    assert len(allpairs.overlaps_in_worlds(boxes)[0]) == 10
    assert len(allpairs.overlaps_in_worlds(boxes, group=3)[0]) == 0
    assert len(allpairs.overlaps_in_worlds(boxes, group=0, mask=1, category=3)[0]) == 10
    with pytest.raises(allpairs.InvalidArgument, match="mask is"):
        allpairs.overlaps_in_worlds(boxes, mask=2**40)


def test_values_for_each_box_have_the_shape_of_the_worlds():
    boxes = np.tile([0, 0, 0, 1, 1, 1], (2, 3, 1))
    rows = np.array([[1, 1, 0], [2, 2, 0]])  # of each world the first two boxes are of one group
    for group in (rows, rows.ravel()):
        assert allpairs.overlaps_in_worlds(boxes, group=group)[0].tolist() == [[0, 2], [1, 2]] * 2
    assert len(allpairs.overlaps_in_worlds(boxes, margin=np.full((2, 3), -0.25))[0]) == 6
    margin = np.array([0, -2.0, 0])  # of each world the second box is in no pair
    assert allpairs.overlaps_in_worlds(boxes, margin=margin)[0].tolist() == [[0, 2]] * 2
    assert allpairs.overlaps_in_worlds(boxes[:, :, [0, 1, 3, 4]], margin=margin)[0].tolist() == [[0, 2]] * 2
    for name in ("group", "category", "mask", "margin"):
        for wrong in (rows.T, rows[np.newaxis]):
            with pytest.raises(allpairs.InvalidArgument, match=f"^{name} has shape .* worlds of n boxes"):
                allpairs.overlaps_in_worlds(boxes, **{name: wrong})


def test_ignored_pairs_with_shared_boxes_are_of_boxes_that_are_there():
    rows = np.zeros((5, 6))
    given = {"offsets": [0, 3, 5], "shared": np.zeros((2, 6))}
    pairs, offsets = allpairs.overlaps_in_worlds(rows, ignore=[[2, 1], [0, 0]], **given)
    assert offsets.tolist() == [0, 4, 7]
    assert [2, 1] not in pairs.tolist()
    with pytest.raises(allpairs.InvalidArgument, match=r"ignore row 0 is \(3, 0\); the number of boxes is 3 and 2"):
        allpairs.overlaps_in_worlds(rows, ignore=[[3, 0]], **given)
