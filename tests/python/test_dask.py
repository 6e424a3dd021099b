# SPDX-License-Identifier: MIT
"""Pairs that Dask's workers find are those of one search, in the same bytes."""

import os
import signal

import numpy as np
import pytest

import allpairs
from conftest import corners, every_pair_between

dask = pytest.importorskip("dask")
import dask.array  # noqa: E402

import allpairs.dask  # noqa: E402


def boxes_of(scene, dtype):
    rng = np.random.default_rng(5)
    lower = rng.random((3000, 3)).astype(dtype) * 12
    boxes = np.hstack([lower, lower + rng.random((3000, 3)).astype(dtype)])
    if scene == "clusters":
        boxes[1000:1100] = boxes[1000]
    if scene == "needles":
        boxes[::7, 3] += 12
    if scene == "giant":
        boxes[77] = [-9, -9, -9, 99, 99, 99]
    if scene == "lattice":
        lower = np.indices((14, 14, 14)).reshape(3, -1).T.astype(dtype)
        boxes = np.hstack([lower, lower + 1])
    if scene == "far":
        boxes = boxes / 3 + 1e9
    return boxes


@pytest.mark.parametrize("scene", ["uniform", "clusters", "needles", "giant", "lattice", "far"])
def test_the_pairs_are_those_of_one_search(scene):
    boxes = boxes_of(scene, np.float64 if scene == "far" else np.float32)
    found = allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(700, 3)))
    pairs = found.compute(scheduler="threads")
    assert pairs.dtype == np.uint32
    assert pairs.tobytes() == allpairs.overlaps(boxes).tobytes()


@pytest.mark.parametrize("distance", [0.5, -0.25])
def test_a_distance_is_that_of_one_search(distance):
    boxes = boxes_of("uniform", np.float32)
    found = allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(1000, 6)), distance=distance, cells=20)
    assert found.compute().tobytes() == allpairs.overlaps(boxes, distance=distance).tobytes()


@pytest.mark.parametrize("distance", [0.0, 0.25])
@pytest.mark.parametrize(
    "scenes", [("uniform", "clusters"), ("giant", "needles"), ("uniform", "giant"), ("far", "far"), ("lattice", "lattice")]
)
def test_two_sets_are_those_of_one_search(scenes, distance):
    dtype = np.float64 if "far" in scenes else np.float32
    first, second = boxes_of(scenes[0], dtype)[1::2], boxes_of(scenes[1], np.float64)[2::3]
    found = allpairs.dask.overlaps(
        dask.array.from_array(first, chunks=(400, 6)),
        second=dask.array.from_array(second, chunks=(300, 3)),
        distance=distance,
    )
    pairs = found.compute(scheduler="threads")
    assert pairs.dtype == np.uint32
    assert pairs.tolist() == every_pair_between(corners(first), corners(second), distance).tolist()
    assert pairs.tobytes() == allpairs.overlaps_between(first, second, distance=distance).tobytes()


def test_two_sets_of_files_and_sets_without_boxes(tmp_path):
    boxes = boxes_of("uniform", np.float32)
    sets = {"a.npy": boxes[:500], "b.npy": boxes[400:700], "c.npy": boxes[700:1000], "none.npy": boxes[:0]}
    for name, part in sets.items():
        np.save(tmp_path / name, part)
    count = allpairs.dask.overlaps(
        [tmp_path / "a.npy", tmp_path / "none.npy"], tmp_path / "pairs", second=[tmp_path / "b.npy", tmp_path / "c.npy"]
    )
    found = np.concatenate([np.load(part) for part in sorted((tmp_path / "pairs").iterdir())])
    assert count == len(found) and len(list((tmp_path / "pairs").iterdir())) == 2
    assert found.tolist() == every_pair_between(corners(boxes[:500]), corners(boxes[400:1000])).tolist()
    for first, second in (("a.npy", "none.npy"), ("none.npy", "a.npy"), ("none.npy", "none.npy")):
        assert len(allpairs.dask.overlaps(tmp_path / first, second=tmp_path / second).compute()) == 0


def test_no_boxes_and_few():
    for count in (0, 1, 2):
        boxes = boxes_of("uniform", np.float32)[:count]
        found = allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(5, 6)))
        assert found.compute().tolist() == allpairs.overlaps(boxes).tolist()


def test_files_in_and_files_out(tmp_path):
    boxes = boxes_of("uniform", np.float32)
    for name, part in (("a.npy", boxes[:10]), ("b.npy", boxes[10:10]), ("c.npy", boxes[10:])):
        np.save(tmp_path / name, part)
    count = allpairs.dask.overlaps([tmp_path / "a.npy", tmp_path / "b.npy", tmp_path / "c.npy"], tmp_path / "pairs")
    expected = allpairs.overlaps(boxes)
    assert count == len(expected)
    parts = sorted((tmp_path / "pairs").iterdir())
    assert [part.name for part in parts] == ["part-00000.npy", "part-00001.npy", "part-00002.npy"]
    assert np.concatenate([np.load(part) for part in parts]).tobytes() == expected.tobytes()


def test_what_is_wrong_is_named(tmp_path):
    boxes = boxes_of("uniform", np.float32)
    boxes[1234, 1] = np.nan
    with pytest.raises(allpairs.InvalidArgument, match="box 1234 of all"):
        allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(1000, 6)), cells=2).compute()
    with pytest.raises(allpairs.InvalidArgument, match=r"shape \(3000, 5\)"):
        allpairs.dask.overlaps(dask.array.from_array(boxes[:, :5]))
    with pytest.raises(allpairs.InvalidArgument, match="no file"):
        allpairs.dask.overlaps([])
    good = dask.array.from_array(boxes[:1000], chunks=(1000, 6))
    with pytest.raises(allpairs.InvalidArgument, match="box 1234 of the second set"):
        allpairs.dask.overlaps(good, second=dask.array.from_array(boxes, chunks=(1000, 6))).compute()
    with pytest.raises(allpairs.InvalidArgument, match=r"second has shape \(3000, 5\)"):
        allpairs.dask.overlaps(good, second=dask.array.from_array(boxes[:, :5]))
    with pytest.raises(allpairs.InvalidArgument, match="second names no file"):
        allpairs.dask.overlaps(good, second=[])
    np.save(tmp_path / "flat.npy", boxes.ravel())
    with pytest.raises(allpairs.InvalidArgument, match="flat.npy has shape"):
        allpairs.dask.overlaps(tmp_path / "flat.npy")


@pytest.fixture(scope="module")
def cluster():
    distributed = pytest.importorskip("distributed")
    with dask.config.set({"distributed.worker.daemon": True}):
        with distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
        ) as local:
            with distributed.Client(local) as client:
                yield client


def test_workers_in_processes_give_the_same_bytes(cluster):
    boxes = boxes_of("uniform", np.float32)
    found = allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(500, 6)))
    assert found.compute().tobytes() == allpairs.overlaps(boxes).tobytes()


def test_a_worker_that_is_killed_changes_nothing(cluster, tmp_path):
    boxes = boxes_of("uniform", np.float32)
    marker = str(tmp_path / "killed")

    def kill_once(block):
        try:
            os.close(os.open(marker, os.O_CREAT | os.O_EXCL))
        except FileExistsError:
            return block
        os.kill(os.getpid(), signal.SIGKILL)

    array = dask.array.from_array(boxes, chunks=(500, 6)).map_blocks(kill_once, dtype=boxes.dtype, meta=boxes[:0])
    found = allpairs.dask.overlaps(array)
    assert found.compute().tobytes() == allpairs.overlaps(boxes).tobytes()
    assert os.path.exists(marker)
