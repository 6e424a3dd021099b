# SPDX-License-Identifier: MIT
"""Cells, and joins of files, against the double loop."""

import itertools
import pickle

import numpy as np
import pytest

import allpairs
from conftest import corners, every_kept_pair, every_kept_pair_between, every_pair_between, what_boxes_may_have


def some_boxes(count=300, seed=1, dtype=np.float32):
    rng = np.random.default_rng(seed)
    lower = rng.random((count, 3)).astype(dtype) * 5
    return np.hstack([lower, lower + rng.random((count, 3)).astype(dtype)])


def double_loop(boxes, distance=0.0):
    wide = boxes.astype(np.float64)
    low, high = wide[:, :3], wide[:, 3:] + distance
    return [
        [i, j]
        for i, j in itertools.combinations(range(len(boxes)), 2)
        if (low[i] <= high[j]).all() and (low[j] <= high[i]).all()
    ]


@pytest.mark.parametrize("distance", [0.0, 0.25, -0.125])
def test_cells_have_each_pair_once(distance):
    boxes = some_boxes()
    partition = allpairs.Partition(boxes, cells=9, distance=distance)
    assert len(partition) > 6
    homes = partition.cells_of(boxes, distance=distance)
    assert homes.dtype == np.int64 and len(homes) > len(boxes)
    found = []
    for number, cell in enumerate(partition.cells):
        here = homes[homes[:, 1] == number, 0]
        pairs = allpairs.overlaps_in_cell(boxes[here], None, here + 2**40, cell, distance=distance)
        assert pairs.dtype == np.uint64
        found += (pairs - np.uint64(2**40)).tolist()
    assert sorted(found) == double_loop(boxes, distance)


def test_cells_have_each_pair_of_two_sets_once():
    first, second = some_boxes(200, 4), some_boxes(150, 5, np.float64)
    margins = np.linspace(0, 0.25, 200), np.linspace(0, 0.5, 150)
    partition = allpairs.Partition(np.vstack([first, second]), cells=6, margin=0.5)
    found = []
    homes = [partition.cells_of(boxes, margin=m, max_margin=0.5) for boxes, m in zip((first, second), margins)]
    for number, cell in enumerate(partition.cells):
        a, b = (rows[rows[:, 1] == number, 0] for rows in homes)
        here = (margins[0][a], margins[1][b])
        found += allpairs.overlaps_between_in_cell(first[a], second[b], (a, b), cell, margin=here).tolist()
    assert sorted(found) == allpairs.overlaps_between(first, second, margin=margins).tolist()
    assert len(found) > 100


def test_margins_widen_and_are_seen():
    boxes = some_boxes(80)
    margins = np.linspace(0, 0.5, 80)
    partition = allpairs.Partition(boxes, cells=4, margin=margins)
    homes = partition.cells_of(boxes, margin=margins)
    assert (homes == partition.cells_of(boxes, margin=margins, max_margin=0.5)).all()
    found = []
    for number, cell in enumerate(partition.cells):
        here = homes[homes[:, 1] == number, 0]
        found += allpairs.overlaps_in_cell(boxes[here], None, here, cell, margin=margins[here]).tolist()
    assert sorted(found) == allpairs.overlaps(boxes, margin=margins).tolist()


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_cells_leave_out_what_a_search_leaves_out(dtype):
    boxes, own = some_boxes(400, 6, dtype), what_boxes_may_have(400, 6)
    options = {"distance": 0.125, "region": [[1, 1, 1], [4, 5, 3]]}
    margin = own["margin"]
    partition = allpairs.Partition(boxes, cells=7, distance=0.125, margin=margin)
    homes = partition.cells_of(boxes, distance=0.125, margin=margin)
    found, count = [], 0
    for number, cell in enumerate(partition.cells):
        here = homes[homes[:, 1] == number, 0]
        given = {name: values[here] for name, values in own.items()}
        found += allpairs.overlaps_in_cell(boxes[here], None, here, cell, **options, **given).tolist()
        count += allpairs.count_in_cell(boxes[here], None, cell, **options, **given)
    assert sorted(found) == every_kept_pair(boxes, **options, **own).tolist()
    assert count == len(found) > 20


def test_cells_leave_out_what_a_search_of_two_sets_leaves_out():
    sets = [some_boxes(300, 7), some_boxes(200, 8)]
    owns = [what_boxes_may_have(300, 7), what_boxes_may_have(200, 8)]
    options = {"distance": -0.125, "region": [[1, 1, 1], [4, 5, 3]]}
    own = {name: (owns[0][name], owns[1][name]) for name in owns[0]}
    partition = allpairs.Partition(np.vstack(sets), cells=7)
    homes = [partition.cells_of(boxes, margin=o["margin"], max_margin=4.0) for boxes, o in zip(sets, owns)]
    found, count = [], 0
    for number, cell in enumerate(partition.cells):
        a, b = (rows[rows[:, 1] == number, 0] for rows in homes)
        given = {name: (first[a], second[b]) for name, (first, second) in own.items()}
        found += allpairs.overlaps_between_in_cell(sets[0][a], sets[1][b], (a, b), cell, **options, **given).tolist()
        count += allpairs.count_between_in_cell(sets[0][a], sets[1][b], cell, **options, **given)
    assert sorted(found) == every_kept_pair_between(*sets, **options, **own).tolist()
    assert count == len(found) > 20


def test_bounds_of_many_cells():
    corners = np.arange(60_000.0)[:, None] * np.ones(6)
    partition = allpairs.Partition(corners, cells=30_000)
    cells = partition.cells
    assert len(cells) == len(partition) == 30_000
    assert (cells[:, 0] < cells[:, 1]).all()


def test_a_partition_pickles():
    boxes = some_boxes()
    partition = allpairs.Partition(boxes, cells=5)
    again = pickle.loads(pickle.dumps(partition))
    assert (again.cells == partition.cells).all()
    assert (again.cells_of(boxes) == partition.cells_of(boxes)).all()


def test_bad_arguments_are_named():
    boxes = some_boxes(3)
    space = [[-np.inf] * 3, [np.inf] * 3]
    with pytest.raises(allpairs.InvalidArgument, match=r"ids has shape \(2,\); for 3 boxes it takes \(3,\)"):
        allpairs.overlaps_in_cell(boxes, None, [1, 2], space)
    with pytest.raises(allpairs.InvalidArgument, match="ids is -3; it is at least 0"):
        allpairs.overlaps_in_cell(boxes, None, [1, 2, -3], space)
    with pytest.raises(allpairs.InvalidArgument, match=r"ids\[2\] is -3; it is at least 0"):
        allpairs.overlaps_in_cell(boxes, None, np.array([1, 2, -3]), space)
    with pytest.raises(allpairs.InvalidArgument, match="ids has dtype float64; it takes integers"):
        allpairs.overlaps_in_cell(boxes, None, np.array([1, 2, 3.0]), space)
    with pytest.raises(allpairs.InvalidArgument, match=r"cell has shape \(3,\)"):
        allpairs.overlaps_in_cell(boxes, None, [1, 2, 3], [1, 2, 3])
    with pytest.raises(allpairs.InvalidArgument, match="two boxes have the id 7"):
        allpairs.overlaps_in_cell(boxes * 0, None, [7, 7, 3], space)
    with pytest.raises(allpairs.InvalidArgument, match="second set: ids has shape"):
        allpairs.overlaps_between_in_cell(boxes, boxes, ([1, 2, 3], [1, 2]), space)
    with pytest.raises(allpairs.InvalidArgument, match="ids takes a tuple of two"):
        allpairs.overlaps_between_in_cell(boxes, boxes, [1, 2, 3], space)
    with pytest.raises(allpairs.InvalidArgument, match=r"group has shape \(2,\); for 3 boxes it takes \(3,\)"):
        allpairs.count_in_cell(boxes, None, space, group=[1, 2])
    with pytest.raises(allpairs.InvalidArgument, match=r"second set: margin has shape \(2,\)"):
        allpairs.count_between_in_cell(boxes, boxes, space, margin=(None, [1, 2]))
    with pytest.raises(allpairs.InvalidArgument, match="cells is 0"):
        allpairs.Partition(boxes, cells=0)


def test_ids_have_64_bits():
    space = [[-np.inf] * 3, [np.inf] * 3]
    large = [1, 2**63, 2**64 - 1]
    assert allpairs.overlaps_in_cell(np.zeros((3, 6)), None, large, space).tolist() == [
        [1, 2**63],
        [1, 2**64 - 1],
        [2**63, 2**64 - 1],
    ]


def test_what_is_wrong_with_a_box_names_it_as_it_was_given_whatever_its_id():
    lower, upper = np.zeros((3, 3)), np.ones((3, 3))
    lower[0, 0] = np.nan
    space, ids, margins = [[-np.inf] * 3, [np.inf] * 3], [70, 50, 60], [1.0, 2, 3]

    def refused(message, lower=upper, ids=ids, **options):
        with pytest.raises(allpairs.Error, match=message) as caught:
            allpairs.overlaps_in_cell(lower, upper, ids, space, **options)
        return caught.value

    assert refused("^box 0: min x is not a number", lower, margin=margins).index == 0
    assert refused("^box 0: min x is not a number", np.vstack([lower[:1], lower[:2]]), margin=margins).index == 0  # of two
    assert refused("^box 1: its margin is NaN", margin=[1, np.nan, 3]).index == 1
    for name in ("group", "category", "mask"):
        assert refused(rf"^{name}\[0\] is -1; ", margin=margins, **{name: [-1, 0, 0]}).index == 0
    refused(r"^ids\[1\] is -50; it is at least 0$", ids=np.array([70, -50, 60]), margin=margins)


def test_margins_are_added_in_the_order_of_ids():
    rng = np.random.default_rng(7)
    n = 400
    margin = rng.random(n)
    group = np.arange(n) // 7 + 1
    lower = np.zeros((n, 3))
    # Each box touches the first one if the sum of their margins is rounded up.
    lower[1:, 0] = np.maximum((0.1 + margin[0]) + margin[1:], (0.1 + margin[1:]) + margin[0])
    upper = lower + 1
    lower[0], upper[0] = -1, 0
    upper[1:, 1:], lower[1:, 1:] = 0, 0
    expected = allpairs.overlaps(lower, upper, distance=0.1, margin=margin, group=group)
    order = np.arange(n)[::-1]
    own = {"distance": 0.1, "margin": margin[order], "group": group[order]}
    space = [[-np.inf] * 3, [np.inf] * 3]
    found = allpairs.overlaps_in_cell(lower[order], upper[order], order, space, **own)
    assert found.tolist() == expected.tolist()
    rows = np.hstack([lower, upper])[order]
    assert allpairs.overlaps_in_cell(rows, None, order, space, **own).tolist() == found.tolist()
    assert len(allpairs.overlaps(rows, **own)) > len(expected)  # so that the order decides
    least = 2**63 - 200
    large = [least + int(number) for number in order]  # in a list, of which NumPy makes floats
    assert (allpairs.overlaps_in_cell(rows, None, large, space, **own) - np.uint64(least)).tolist() == found.tolist()


def test_a_join_of_files_is_the_search_in_memory(tmp_path):
    boxes = some_boxes(400)
    np.save(tmp_path / "a.npy", boxes[:150])
    np.save(tmp_path / "b.npy", boxes[150:].astype(np.float64))
    summary = allpairs.join([tmp_path / "a.npy", tmp_path / "b.npy"], tmp_path / "pairs.npy", distance=0.125)
    expected = double_loop(boxes, 0.125)
    assert np.load(tmp_path / "pairs.npy").tolist() == expected
    assert summary.pairs == len(expected) and summary.boxes == 400
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.npy", "b.npy", "pairs.npy"]
    assert allpairs.join(str(tmp_path / "a.npy"), threads=2).pairs == len(double_loop(boxes[:150]))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("distance", [0.0, 0.125])
def test_a_join_of_two_sets_is_the_search_in_memory(tmp_path, dtype, distance):
    first, second = some_boxes(250, 2, dtype), some_boxes(200, 3, dtype)
    np.save(tmp_path / "a.npy", first)
    np.save(tmp_path / "b.npy", second[:90])
    np.save(tmp_path / "c.npy", second[90:])
    others = [tmp_path / "b.npy", tmp_path / "c.npy"]
    summary = allpairs.join(tmp_path / "a.npy", tmp_path / "pairs.npy", second=others, distance=distance)
    pairs = np.load(tmp_path / "pairs.npy")
    expected = every_pair_between(corners(first), corners(second), distance)
    assert pairs.tolist() == expected.tolist()
    assert pairs.tobytes() == allpairs.overlaps_between(first, second, distance=distance).tobytes()
    assert summary.boxes == 450 and summary.second_boxes == 200 and summary.pairs == len(expected)
    assert allpairs.join(tmp_path / "a.npy", second=others, distance=distance).pairs == len(expected)
    np.save(tmp_path / "none.npy", first[:0])
    assert allpairs.join(tmp_path / "a.npy", second=tmp_path / "none.npy").pairs == 0
    assert allpairs.join(tmp_path / "none.npy", second=tmp_path / "a.npy").pairs == 0


def saved(folder, name, values):
    np.save(folder / f"{name}.npy", values)
    return folder / f"{name}.npy"


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_join_leaves_out_what_a_search_leaves_out(tmp_path, dtype):
    boxes, own = some_boxes(500, 12, dtype), what_boxes_may_have(500, 12)
    options = {"distance": 0.125, "region": [[1, 1, 1], [4, 5, 3]]}
    files = {name: saved(tmp_path, name, values) for name, values in own.items()}
    files["group"] = [saved(tmp_path, "a", own["group"][:90]), str(saved(tmp_path, "b", own["group"][90:].astype(">i8")))]
    boxes_file = saved(tmp_path, "boxes", boxes)
    done = allpairs.join(boxes_file, tmp_path / "pairs.npy", **options, **files)
    expected = every_kept_pair(boxes, **options, **own)
    assert np.load(tmp_path / "pairs.npy").tobytes() == expected.tobytes() and len(expected) > 20
    assert done.pairs == allpairs.join(boxes_file, **options, **files).pairs == len(expected)
    assert done.copies == 0


TYPES_OF_LABELS = ["?", "i1", "u1", "<i2", ">u2", "<i4", ">u4", "<i8", ">u8"]
TYPES_OF_MARGINS = [*TYPES_OF_LABELS, "<f2", ">f2", ">f4", "<f8"]


@pytest.mark.parametrize("name, types", [("margin", TYPES_OF_MARGINS), ("group", TYPES_OF_LABELS), ("mask", TYPES_OF_LABELS)])
def test_files_of_values_have_the_types_that_arrays_have(tmp_path, name, types):
    boxes = some_boxes(100, 15)
    boxes_file = saved(tmp_path, "boxes", boxes)
    for type_name in types:
        values = (np.arange(100) % 3).astype(type_name)
        expected = len(allpairs.overlaps(boxes, **{name: values}))
        assert allpairs.join(boxes_file, **{name: saved(tmp_path, "values", values)}).pairs == expected > 0, type_name


def test_a_join_of_two_sets_leaves_out_what_a_search_leaves_out(tmp_path):
    first, second = some_boxes(400, 13), some_boxes(300, 14, np.float64)
    owns = [what_boxes_may_have(400, 13), what_boxes_may_have(300, 14)]
    names = [saved(tmp_path, "first", first), saved(tmp_path, "second", second)]
    options = {"distance": -0.125, "region": [1, 1, 1, 4, 5, 3]}
    for left_out in ((), ("margin", 0), ("mask", 1), ("group", 0)):
        own = {name: [owns[0][name], owns[1][name]] for name in owns[0]}
        if left_out:
            own[left_out[0]][left_out[1]] = None
        files = {
            name: tuple(None if v is None else saved(tmp_path, f"{name}{i}", v) for i, v in enumerate(pair))
            for name, pair in own.items()
        }
        allpairs.join(names[0], tmp_path / "pairs.npy", second=names[1], **options, **files)
        expected = allpairs.overlaps_between(first, second, **options, **{n: tuple(pair) for n, pair in own.items()})
        assert np.load(tmp_path / "pairs.npy").tobytes() == expected.tobytes(), left_out
        if not left_out:
            oracle = every_kept_pair_between(first, second, **options, **{n: tuple(pair) for n, pair in own.items()})
            assert expected.tolist() == oracle.tolist() and len(oracle) > 20


def test_a_join_says_what_is_wrong_with_values(tmp_path):
    boxes = saved(tmp_path, "boxes", some_boxes(10))
    margins = saved(tmp_path, "margins", np.array([0.0] * 7 + [np.nan] * 3))
    with pytest.raises(allpairs.FileError, match="margins.npy: margin 7 is a NaN"):
        allpairs.join(boxes, margin=margins)
    with pytest.raises(allpairs.FileError, match="margins.npy: holds numbers of type '<f8'; groups are integers"):
        allpairs.join(boxes, group=margins)
    with pytest.raises(allpairs.FileError, match="short.npy: has 9 masks for 10 boxes"):
        allpairs.join(boxes, mask=saved(tmp_path, "short", np.arange(9)))
    with pytest.raises(allpairs.InvalidArgument, match="category takes a tuple of two here"):
        allpairs.join(boxes, second=boxes, category=[margins, margins])
    with pytest.raises(allpairs.InvalidArgument, match="margin names no file"):
        allpairs.join(boxes, margin=[])
    with pytest.raises(allpairs.InvalidArgument, match="region"):
        allpairs.join(boxes, region=[[1, 1, 1], [0, 2, 2]])


def test_join_says_what_is_wrong(tmp_path):
    boxes = some_boxes(10)
    boxes[4, 2] = np.nan
    np.save(tmp_path / "nan.npy", boxes)
    with pytest.raises(allpairs.FileError, match="nan.npy: box 4: min z is not a number"):
        allpairs.join(tmp_path / "nan.npy", tmp_path / "pairs.npy")
    with pytest.raises(allpairs.InvalidArgument, match="64 MiB"):
        allpairs.join(tmp_path / "nan.npy", memory=1)
    with pytest.raises(allpairs.InvalidArgument, match="no file"):
        allpairs.join([])
    with pytest.raises(allpairs.InvalidArgument, match="second names no file"):
        allpairs.join(tmp_path / "nan.npy", second=[])
    with pytest.raises(allpairs.InvalidArgument, match="output is '.*pairs.csv'; a join writes .npy files"):
        allpairs.join(tmp_path / "nan.npy", tmp_path / "pairs.csv")
    with pytest.raises(allpairs.InvalidArgument, match="work is empty; it takes the path of a folder"):
        allpairs.join(tmp_path / "nan.npy", tmp_path / "pairs.npy", work="")
    assert [path.name for path in tmp_path.iterdir()] == ["nan.npy"]
