# SPDX-License-Identifier: MIT
"""Bad input is a ValueError that names what is wrong."""

import pickle

import allpairs
import numpy as np
import pytest

BOXES = np.zeros((4, 6))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_nan_names_its_box(dtype):
    lower, upper = np.zeros((5, 3), dtype), np.ones((5, 3), dtype)
    upper[3, 1] = np.nan
    with pytest.raises(ValueError, match="^box 3: max y") as caught:
        allpairs.overlaps(lower, upper)
    assert isinstance(caught.value, allpairs.InvalidBox)
    assert caught.value.index == 3


def test_a_nan_of_one_of_two_sets_names_the_set():
    bad = BOXES.copy()
    bad[2, 0] = np.nan
    with pytest.raises(allpairs.InvalidBox, match="^second set: box 2") as caught:
        allpairs.overlaps_between(BOXES, bad)
    assert caught.value.index == 2


def test_a_margin_that_is_none_names_its_box():
    with pytest.raises(allpairs.InvalidBox) as caught:
        allpairs.overlaps(BOXES, margin=[0, 1, np.nan, 0])
    assert caught.value.index == 2


def test_a_label_that_does_not_fit_names_its_box():
    with pytest.raises(allpairs.InvalidBox, match=r"group\[1\] is -1") as caught:
        allpairs.overlaps(BOXES, group=[0, -1, 0, 0])
    assert caught.value.index == 1
    with pytest.raises(allpairs.InvalidBox, match="4294967296"):
        allpairs.overlaps(BOXES, mask=[0, 0, 0, 2**32])


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"lower": np.zeros((2, 3))}, r"lower has shape \(2, 3\); alone it takes \(n, 6\)"),
        ({"lower": np.zeros((2, 6)), "upper": np.zeros((2, 3))}, r"lower has shape \(2, 6\)"),
        ({"lower": np.zeros((2, 3)), "upper": np.zeros((3, 3))}, "lower has 2 rows and upper 3"),
        ({"lower": np.zeros(6)}, r"lower has shape \(6,\)"),
        ({"lower": np.zeros((2, 6), complex)}, "complex128"),
        ({"lower": [["a"] * 6]}, "dtype"),
        ({"lower": BOXES, "margin": [1, 2]}, r"margin has shape \(2,\); for 4 boxes"),
        ({"lower": BOXES, "margin": np.nan}, "margin"),
        ({"lower": BOXES, "group": [1, 2, 3]}, r"group has shape \(3,\)"),
        ({"lower": BOXES, "group": [0.5] * 4}, "group has dtype float64"),
        ({"lower": BOXES, "ignore": [1, 2, 3]}, r"ignore has shape \(3,\)"),
        ({"lower": BOXES, "region": [1, 2, 3]}, r"region has shape \(3,\)"),
        ({"lower": BOXES, "region": [[1, 1, 1], [0, 0, 0]]}, "region"),
        ({"lower": BOXES, "distance": np.nan}, "distance"),
        ({"lower": BOXES, "order": "third"}, "'first', 'second', 'unordered'"),
        ({"lower": BOXES, "strategy": []}, "strategy"),
        ({"lower": BOXES, "threads": -1}, "threads is -1"),
        ({"lower": BOXES, "max_pairs": -1}, "max_pairs is -1"),
    ],
)
def test_arguments_that_make_no_sense_are_named(arguments, message):
    with pytest.raises(allpairs.InvalidArgument, match=message):
        allpairs.overlaps(**arguments)


def test_two_sets_take_their_settings_in_pairs():
    with pytest.raises(allpairs.InvalidArgument, match="group takes a tuple of two"):
        allpairs.overlaps_between(BOXES, BOXES, group=[1, 2, 3, 4])
    with pytest.raises(allpairs.InvalidArgument, match="second set: group has shape"):
        allpairs.overlaps_between(BOXES, BOXES, group=(None, [1]))
    with pytest.raises(allpairs.InvalidArgument, match="a tuple of 3"):
        allpairs.overlaps_between((1, 2, 3), BOXES)


def test_more_pairs_than_allowed_say_how_many():
    with pytest.raises(allpairs.LimitExceeded) as caught:
        allpairs.overlaps(BOXES, max_pairs=5)
    assert caught.value.count == 6
    assert len(allpairs.overlaps(BOXES, max_pairs=6)) == 6


def test_wrong_types_are_type_errors():
    with pytest.raises(TypeError):
        allpairs.overlaps(BOXES, threads=1.5)
    with pytest.raises(TypeError):
        allpairs.overlaps()


def test_errors_survive_being_sent_to_another_process():
    for error in (
        allpairs.InvalidBox("box 3", 3),
        allpairs.LimitExceeded("many", 7),
        allpairs.FileError("a.scn:1: bad", "a.scn", 1, 0),
    ):
        copy = pickle.loads(pickle.dumps(error))
        assert (type(copy), str(copy), vars(copy)) == (type(error), str(error), vars(error))


def test_errors_are_value_errors_and_those_of_files_os_errors():
    assert issubclass(allpairs.Error, ValueError)
    for kind in (allpairs.InvalidArgument, allpairs.InvalidBox, allpairs.LimitExceeded, allpairs.FileError):
        assert issubclass(kind, allpairs.Error)
    assert issubclass(allpairs.FileError, OSError)
