# SPDX-License-Identifier: MIT
"""Masked arrays: NumPy drops a mask without a word, so that what it hides would be found. Here it is refused."""

import allpairs
import numpy as np
import pytest

BOXES = np.tile([0.0, 0, 0, 1, 1, 1], (4, 1))
MESH = {"triangles": [[0, 1, 2]], "vertex_count": 3}


def masked(values):
    """The array with its second entry, or that of its second row, masked."""
    array = np.ma.array(values)
    array[(1, 0) if array.ndim == 2 else 1] = np.ma.masked
    return array


HIDDEN = np.ma.array(3, mask=True)


def world():
    world = allpairs.World()
    world.add(BOXES)
    return world


CALLS = {
    "lower": [
        lambda: allpairs.overlaps(masked(BOXES)),
        lambda: allpairs.count(masked(BOXES.astype(np.float32))),
        lambda: allpairs.count(masked(BOXES.astype(int))),
        lambda: allpairs.overlaps(list(masked(BOXES))),
        lambda: allpairs.batches(masked(BOXES)),
        lambda: allpairs.overlaps(masked(BOXES[:, :3]), BOXES[:, 3:]),
        lambda: allpairs.World().add(masked(BOXES)),
        lambda: world().move(range(4), masked(BOXES)),
        lambda: world().overlapping(masked(BOXES)),
    ],
    "upper": [lambda: allpairs.overlaps(BOXES[:, :3], masked(BOXES[:, 3:]))],
    "second set: lower": [lambda: allpairs.count_between(BOXES, masked(BOXES))],
    "starts: lower": [lambda: world().move_swept(range(4), masked(BOXES), BOXES)],
    "margin": [
        lambda: allpairs.overlaps(BOXES, margin=masked(np.ones(4))),
        lambda: allpairs.overlaps(BOXES, margin=np.ma.masked),
        lambda: world().set_properties(range(4), margin=masked(np.ones(4))),
        lambda: world().set_properties(range(4), margin=HIDDEN),
        lambda: allpairs.World().add(BOXES, margin=np.ma.masked),
    ],
    "group": [
        lambda: allpairs.overlaps(BOXES, group=masked(range(4))),
        lambda: allpairs.overlaps(BOXES, group=HIDDEN),
    ],
    "category": [lambda: allpairs.overlaps(BOXES, category=HIDDEN)],
    "mask": [lambda: allpairs.World().add(BOXES, mask=masked(range(4))), lambda: world().overlapping(BOXES, mask=HIDDEN)],
    "static": [
        lambda: allpairs.World().add(BOXES, static=masked([True] * 4)),
        lambda: world().overlapping(BOXES, static=np.ma.array(True, mask=True)),
    ],
    "distance": [lambda: allpairs.overlaps(BOXES, distance=HIDDEN), lambda: allpairs.World(distance=np.ma.masked)],
    "threads": [lambda: allpairs.overlaps(BOXES, threads=HIDDEN)],
    "max_pairs": [lambda: allpairs.count(BOXES, max_pairs=HIDDEN)],
    "batch_size": [lambda: allpairs.batches(BOXES, batch_size=HIDDEN)],
    "k": [lambda: world().nearest(BOXES, HIDDEN)],
    "world": [lambda: world().result(HIDDEN)],
    "ignore": [lambda: allpairs.overlaps(BOXES, ignore=masked([[0, 1], [1, 2]]))],
    "region": [lambda: allpairs.overlaps(BOXES, region=masked(range(6)))],
    "ids": [
        lambda: world().remove(masked(range(4))),
        lambda: allpairs.overlaps_in_cell(BOXES, None, [0, 1, 2, HIDDEN], [[-np.inf] * 3, [np.inf] * 3]),
    ],
    "origins": [lambda: world().first_hits(masked(BOXES[:, :3]), [1, 0, 0])],
    "length": [lambda: world().first_hits(BOXES[:, :3], [1, 0, 0], masked(np.ones(4)))],
    "points": [lambda: world().nearest(masked(BOXES[:, :3]))],
    "triangles of mesh 0": [lambda: allpairs.MeshCandidates(masked([[0, 1, 2], [1, 2, 3]]), 4)],
    "start": [lambda: allpairs.MeshCandidates(**MESH).set_positions(masked(BOXES[:3, :3]))],
}


@pytest.mark.parametrize("name, call", [(name, call) for name, calls in CALLS.items() for call in calls])
def test_masked_entries_are_refused_by_name(name, call):
    with pytest.raises(allpairs.InvalidArgument, match=f"^{name} has masked entries"):
        call()


NESTED = np.dtype([("min", np.float32, 3), ("max", [("x", "f4"), ("y", "f4"), ("z", "f4")])])


@pytest.mark.parametrize("dtype", ["f4,f4", NESTED])
@pytest.mark.parametrize("count", [0, 3])
def test_masked_records_are_told_how_to_become_rows_or_that_they_hide_something(dtype, count):
    records = np.ma.zeros(count, dtype)
    name = records.dtype.names[-1]
    for search in (allpairs.overlaps, allpairs.World().add):
        for clear in (records, np.ma.array(records, mask=False)):
            with pytest.raises(allpairs.InvalidArgument, match=f"^lower has fields, .*{name}; .*structured_to_unstructured"):
                search(clear)
    if count:
        records[name][1] = np.ma.masked
        for hidden in (records, list(records), records[1]):
            with pytest.raises(allpairs.InvalidArgument, match="^lower has masked entries"):
                allpairs.overlaps(hidden)


ENTRY = np.ma.masked  # which NumPy says that it makes NaN of


@pytest.mark.filterwarnings("ignore:Warning. converting a masked element to nan")
@pytest.mark.parametrize(
    "name, call",
    [
        ("margin", lambda: allpairs.overlaps(BOXES, margin=[1.0, ENTRY, 1.0, 1.0])),
        ("margin", lambda: allpairs.overlaps(BOXES, margin=(1, 1, HIDDEN, 1))),
        ("margin", lambda: allpairs.overlaps(BOXES, margin=[10**20, 1, 1, ENTRY])),
        ("margin", lambda: allpairs.overlaps_in_worlds([BOXES, BOXES], margin=[1.0, ENTRY, 1.0, 1.0])),
        ("group", lambda: allpairs.overlaps(BOXES, group=[0, ENTRY, 1, 1])),
        ("group", lambda: allpairs.overlaps(BOXES, group=[0, HIDDEN, 1, 1])),
        ("static", lambda: allpairs.World().add(BOXES, static=[True, False, np.ma.array(True, mask=True), False])),
        ("lower", lambda: allpairs.overlaps([[0, 0, 0, 1, 1, 1], [0.0, 0, 0, 1, 1, ENTRY]])),
        ("lower", lambda: allpairs.overlaps([[0, 0, 0, 1, 1, 1], (0, 0, 0, 1, 1, HIDDEN)])),
        ("ignore", lambda: allpairs.overlaps(BOXES, ignore=[[0, 1], [1, ENTRY]])),
        ("region", lambda: allpairs.overlaps(BOXES, region=[0, 0, 0, 1, 1, ENTRY])),
        ("length", lambda: world().first_hits(BOXES[:2, :3], [1, 0, 0], [1.0, ENTRY])),
        ("ids", lambda: world().remove([1, ENTRY])),
    ],
)
def test_masked_entries_among_numbers_are_refused_by_name(name, call):
    with pytest.raises(allpairs.InvalidArgument, match=f"^{name} has masked entries"):
        call()


def test_entries_that_a_mask_leaves_are_numbers_among_numbers():
    margin = [1.0, np.ma.array(2.0), np.ma.array(3, mask=False), np.nan]
    with pytest.raises(allpairs.InvalidBox, match="^box 3: its margin is NaN"):
        allpairs.overlaps(BOXES, margin=margin)
    assert len(allpairs.overlaps(BOXES, margin=[*margin[:3], 4])) == 6


def test_a_masked_array_that_hides_nothing_is_an_array():
    np.testing.assert_array_equal(allpairs.overlaps(np.ma.array(BOXES)), allpairs.overlaps(BOXES))
    np.testing.assert_array_equal(allpairs.overlaps(np.ma.array(BOXES, mask=False)), allpairs.overlaps(BOXES))
