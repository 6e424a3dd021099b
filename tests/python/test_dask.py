# SPDX-License-Identifier: MIT
"""Pairs that Dask's workers find are those of one search, in the same bytes."""

import errno
import os
import signal
import time
from fractions import Fraction

import numpy as np
import pytest

import allpairs
from conftest import corners, every_kept_pair, every_kept_pair_between, every_pair_between, what_boxes_may_have

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


def test_the_work_is_planned_as_one_layer_whose_tasks_grow_with_the_chunks():
    boxes = boxes_of("uniform", np.float32)
    margin = dask.array.zeros(len(boxes), chunks=100)
    tasks = []
    for chunk in (40, 20):
        found = allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(chunk, 6)), margin=margin)
        assert found.numblocks == (len(boxes) // chunk, 1)
        layers = found.dask.layers
        assert max(len(layer) for layer in layers.values()) > 0.9 * len(found.dask)
        tasks.append(len(found.dask))
    assert tasks[1] < 2.2 * tasks[0]


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


REGION = [[1, 1, 0], [8, 12, 9]]


def odd_boxes(n, seed, dtype):
    """Boxes of many sizes, some of them empty or without end, and in float64 far from the origin."""
    rng = np.random.default_rng(seed)
    lower = rng.random((n, 3)).astype(dtype) * 12
    boxes = np.hstack([lower, lower + rng.random((n, 3)).astype(dtype) ** 4 * 3])
    boxes[::17, 4] = boxes[::17, 1] - 1
    boxes[5::97, 3:] = np.inf
    boxes[7::97, :3] = -np.inf
    return boxes if dtype == np.float32 else boxes / 3 + 1e9


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("seed", range(6))
def test_all_that_boxes_may_have_is_as_in_one_search(tmp_path, seed, dtype):
    rng = np.random.default_rng(seed)
    n, chunk, cells = rng.integers(200, 900), rng.integers(50, 400), rng.integers(1, 40)
    boxes, own = odd_boxes(n, seed, dtype), what_boxes_may_have(n, seed)
    region = None if seed % 2 else REGION if dtype == np.float32 else np.array(REGION) / 3 + 1e9
    options = {"distance": [0.0, 0.25, -0.125][seed % 3], "region": region}
    expected = every_kept_pair(boxes, **options, **own)
    assert allpairs.overlaps(boxes, **options, **own).tobytes() == expected.tobytes() and len(expected) > 50
    for name, values in own.items():  # cut elsewhere than the boxes
        np.save(tmp_path / f"{name}0.npy", values[: n // 3])
        np.save(tmp_path / f"{name}1.npy", values[n // 3 :])
    as_files = {name: [tmp_path / f"{name}0.npy", tmp_path / f"{name}1.npy"] for name in own}
    as_dask = {name: dask.array.from_array(values, chunks=77) for name, values in own.items()}
    array = dask.array.from_array(boxes, chunks=(chunk, 6))
    for given in (own, as_files, as_dask):
        found = allpairs.dask.overlaps(array, cells=cells, **options, **given)
        assert found.compute(scheduler="threads").tobytes() == expected.tobytes()
    assert allpairs.dask.count(array, cells=cells, **options, **as_files) == len(expected)


@pytest.mark.parametrize("seed", range(6))
def test_all_that_boxes_of_two_sets_may_have_is_as_in_one_search(tmp_path, seed):
    rng = np.random.default_rng(seed)
    sizes = rng.integers(100, 500, 2)
    dtype = np.float64 if seed % 2 else np.float32
    first, second = (odd_boxes(n, seed + 50 * i, dtype) for i, n in enumerate(sizes))
    owns = [what_boxes_may_have(n, seed + 50 * i) for i, n in enumerate(sizes)]
    own = {name: (owns[0][name], owns[1][name]) for name in owns[0]}
    options = {"distance": 0.125, "region": None if seed % 2 else REGION}
    expected = every_kept_pair_between(first, second, **options, **own)
    assert allpairs.overlaps_between(first, second, **options, **own).tobytes() == expected.tobytes()
    np.save(tmp_path / "margins.npy", own["margin"][1])
    given = {**own, "margin": (dask.array.from_array(own["margin"][0], chunks=90), tmp_path / "margins.npy")}
    sets = [dask.array.from_array(boxes, chunks=(120, 6)) for boxes in (first, second)]
    found = allpairs.dask.overlaps(sets[0], second=sets[1], **options, **given)
    assert found.compute(scheduler="threads").tobytes() == expected.tobytes()
    assert allpairs.dask.count(sets[0], second=sets[1], **options, **given) == len(expected)


def test_a_number_is_for_all_boxes_and_one_set_may_have_what_the_other_has_not():
    first, second = odd_boxes(300, 1, np.float32), odd_boxes(200, 2, np.float32)
    margin = np.linspace(0, 2, 200)
    sets = [dask.array.from_array(boxes, chunks=(90, 6)) for boxes in (first, second)]
    for own in ({"margin": 0.5}, {"mask": 0}, {"group": 3}, {"margin": (None, margin)}, {"group": (3, None)}):
        expected = allpairs.overlaps_between(first, second, **own)
        found = allpairs.dask.overlaps(sets[0], second=sets[1], **own).compute()
        assert found.tobytes() == expected.tobytes(), own
    for own in ({"margin": 0.5}, {"margin": -0.5}, {"mask": 0}, {"group": 3}, {"category": 1}):
        found = allpairs.dask.overlaps(sets[0], **own).compute()
        assert found.tobytes() == allpairs.overlaps(first, **own).tobytes(), own
        assert allpairs.dask.count(sets[0], **own) == allpairs.count(first, **own)


@pytest.mark.parametrize("number", [10**20, Fraction(1, 2), np.longdouble(0.5)])
def test_a_margin_for_all_boxes_is_any_number_that_a_distance_is(number):
    boxes = boxes_of("uniform", np.float32)[:300]
    parts = dask.array.from_array(boxes, chunks=(100, 6))
    expected = allpairs.overlaps(boxes, distance=2 * float(number))
    assert allpairs.dask.overlaps(parts, margin=number).compute().tobytes() == expected.tobytes()


def test_a_margin_without_end_pairs_its_box_with_all():
    boxes = odd_boxes(300, 3, np.float32)
    margin = np.zeros(300)
    margin[[20, 250]] = np.inf
    found = allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(60, 6)), margin=margin, cells=20)
    assert found.compute().tolist() == every_kept_pair(boxes, margin=margin).tolist()


def test_a_count_is_of_boxes_in_files_and_of_none(tmp_path):
    boxes = boxes_of("uniform", np.float32)
    np.save(tmp_path / "a.npy", boxes)
    np.save(tmp_path / "none.npy", boxes[:0])
    np.save(tmp_path / "no margins.npy", np.zeros(0))
    assert allpairs.dask.count(tmp_path / "a.npy") == allpairs.count(boxes)
    assert allpairs.dask.count([tmp_path / "none.npy"], margin=tmp_path / "no margins.npy") == 0
    assert allpairs.dask.count(tmp_path / "a.npy", second=tmp_path / "none.npy", margin=1.0) == 0


def test_no_boxes_and_few():
    for count in (0, 1, 2):
        boxes = boxes_of("uniform", np.float32)[:count]
        found = allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(5, 6)))
        assert found.compute().tolist() == allpairs.overlaps(boxes).tolist()


def test_a_path_may_be_bytes(tmp_path):
    boxes, margins = boxes_of("uniform", np.float32)[:500], np.linspace(0, 1, 500)
    np.save(tmp_path / "boxes.npy", boxes)
    np.save(tmp_path / "margins.npy", margins)
    path, margin = os.fsencode(tmp_path / "boxes.npy"), os.fsencode(tmp_path / "margins.npy")
    assert allpairs.dask.count(path, margin=margin) == allpairs.count(boxes, margin=margins)
    with pytest.raises(allpairs.InvalidArgument, match="margin takes a number or a tuple of two"):
        allpairs.dask.count(path, second=path, margin=margin)


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
    with pytest.raises(allpairs.InvalidBox, match="^box 1234 of all: min y is not a number") as error:
        allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(1000, 6)), cells=2).compute()
    assert error.value.index == 1234
    with pytest.raises(allpairs.InvalidArgument, match=r"shape \(3000, 5\)"):
        allpairs.dask.overlaps(dask.array.from_array(boxes[:, :5]))
    with pytest.raises(allpairs.InvalidArgument, match="no file"):
        allpairs.dask.overlaps([])
    good = dask.array.from_array(boxes[:1000], chunks=(1000, 6))
    with pytest.raises(allpairs.InvalidBox, match="^box 1234 of the second set: min y is not a number"):
        allpairs.dask.overlaps(good, second=dask.array.from_array(boxes, chunks=(1000, 6))).compute()
    with pytest.raises(allpairs.InvalidArgument, match=r"second has shape \(3000, 5\)"):
        allpairs.dask.overlaps(good, second=dask.array.from_array(boxes[:, :5]))
    with pytest.raises(allpairs.InvalidArgument, match="second names no file"):
        allpairs.dask.overlaps(good, second=[])
    with pytest.raises(allpairs.InvalidArgument, match="^boxes has dtype complex64"):
        allpairs.dask.overlaps(good.astype(np.complex64))
    with pytest.raises(allpairs.InvalidArgument, match=r"^boxes has integers beyond 2\*\*53"):
        allpairs.dask.overlaps(dask.array.full((4, 6), 2**60, chunks=(2, 6)))
    for function in (allpairs.dask.overlaps, allpairs.dask.count):
        with pytest.raises(TypeError, match="^boxes is NoneType"):
            function(None, second=good)
        with pytest.raises(TypeError, match="^boxes is NoneType"):
            function(None)
    np.save(tmp_path / "flat.npy", boxes.ravel())
    with pytest.raises(allpairs.FileError, match="flat.npy: boxes has shape"):
        allpairs.dask.overlaps(tmp_path / "flat.npy")


def test_what_is_wrong_with_values_is_named(tmp_path):
    boxes = dask.array.from_array(boxes_of("uniform", np.float32), chunks=(700, 6))

    def refused(match, error=allpairs.InvalidArgument, **options):
        with pytest.raises(error, match=match) as problem:
            result = allpairs.dask.overlaps(boxes, **options)
            result.compute()
        assert "\n" not in str(problem.value)

    def saved(name, values):
        np.save(tmp_path / name, values)
        return tmp_path / name

    margins = np.zeros(3000)
    margins[1234] = np.nan
    for given in (margins, dask.array.from_array(margins, chunks=500)):
        refused(r"^margin\[1234\] is nan; it takes numbers$", margin=given)
    file_error = allpairs.FileError
    refused(r"/nan.npy: margin\[1234\] is nan", file_error, margin=saved("nan.npy", margins))
    halves = [saved("one.npy", margins[:1000]), saved("two.npy", margins[1000:])]
    refused(r"/two.npy: margin\[234\] is nan", file_error, margin=halves)
    refused(r"^margin\[0\] is -inf", margin=-np.inf)
    refused(r"^second set: margin\[1234\] is nan", second=boxes, margin=(None, margins))
    refused(r"^group\[7\] is -1; it takes 0 to 4294967295$", group=np.where(np.arange(3000) == 7, -1, 0))
    refused(r"/labels.npy: mask\[2999\] is 4294967296", file_error, mask=saved("labels.npy", np.arange(3000) // 2999 * 2**32))
    refused(r"^category has dtype float64; it takes integers$", category=margins)
    refused(r"/nan.npy: group has dtype float64; it takes integers$", file_error, group=tmp_path / "nan.npy")
    refused(r"^margin has shape \(2999,\); for 3000 boxes it takes \(3000,\)$", margin=margins[1:])
    refused(r"/short.npy: 5 numbers, a margin for each of 3000 boxes$", file_error, margin=saved("short.npy", np.zeros(5)))
    refused(r"/flat.npy: margin has shape \(3, 6\)", file_error, margin=saved("flat.npy", np.zeros((3, 6))))
    refused("^margin has shape", margin=np.zeros((3000, 1)))
    refused("margin takes a number or a tuple of two", second=boxes, margin=str(tmp_path / "nan.npy"))
    refused("^group names no file", group=[])
    refused("region", region=[[1, 1, 1], [0, 2, 2]])
    refused("region has shape", region=[1, 2, 3])
    with pytest.raises(TypeError, match="it takes a dask array, or .npy files"):
        allpairs.dask.overlaps(np.zeros((3, 6)))


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
    own = what_boxes_may_have(3000, 9)
    found = allpairs.dask.overlaps(array, **own)
    assert found.compute().tobytes() == allpairs.overlaps(boxes, **own).tobytes()
    assert os.path.exists(marker)


def test_a_worker_that_is_killed_while_it_writes_leaves_nothing(cluster, tmp_path):
    boxes = boxes_of("uniform", np.float32)
    marker, folder = str(tmp_path / "killed"), tmp_path / "pairs"
    folder.mkdir()
    (folder / "part-00001.npy.part").write_text("somebody else's")

    def be_killed_once():
        save = np.save

        def half(file, array):
            try:
                os.close(os.open(marker, os.O_CREAT | os.O_EXCL))
            except FileExistsError:
                return save(file, array)
            file.write(b"half of it")
            file.flush()
            os.kill(os.getpid(), signal.SIGKILL)

        half.saves = save
        np.save = half

    def be_as_before():
        np.save = getattr(np.save, "saves", np.save)

    cluster.run(be_killed_once)
    try:
        count = allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(1000, 6)), folder)
    finally:
        cluster.run(be_as_before)
    names = sorted(path.name for path in folder.iterdir())
    assert names == ["part-00000.npy", "part-00001.npy", "part-00001.npy.part", "part-00002.npy"]
    assert count == allpairs.count(boxes)
    found = np.concatenate([np.load(path) for path in sorted(folder.glob("*.npy"))])
    assert found.tobytes() == allpairs.overlaps(boxes).tobytes()
    assert os.path.exists(marker)


def test_files_that_are_no_arrays_are_named(tmp_path):
    good = tmp_path / "good.npy"
    boxes = boxes_of("uniform", np.float32)[:100]
    np.save(good, boxes)
    written = good.read_bytes()
    files = {"empty": b"", "text": b"0,0,0,1,1,1\n", "cut": written[:-40], "longer": written + b"\0" * 24}
    for name, content in files.items():
        (tmp_path / f"{name}.npy").write_bytes(content)
    np.savez(tmp_path / "several.npz", boxes, boxes)
    os.mkfifo(tmp_path / "pipe.npy")
    np.save(tmp_path / "complex.npy", boxes.astype(complex))
    (tmp_path / "folder").mkdir()
    for name in ("empty.npy", "text.npy", "cut.npy", "longer.npy", "several.npz", "pipe.npy", "complex.npy", "missing", "folder"):
        with pytest.raises(allpairs.FileError, match=f"^/.*/{name}: ") as problem:
            allpairs.dask.count([good, tmp_path / name])
        assert "\n" not in str(problem.value) and str(problem.value).count(name) == 1
        assert problem.value.path == str(tmp_path / name)
        with pytest.raises(allpairs.FileError, match=f"^/.*/{name}: "):
            allpairs.dask.count([good], margin=tmp_path / name)
    boxes[7, 2] = np.nan
    np.save(tmp_path / "nan.npy", boxes)
    with pytest.raises(allpairs.FileError, match="^/.*/nan.npy: box 7: min z is not a number"):
        allpairs.dask.count([good, tmp_path / "nan.npy"])
    np.save(tmp_path / "large.npy", np.full((4, 6), 2**60))
    with pytest.raises(allpairs.FileError, match=r"^/.*/large.npy: boxes has integers beyond 2\*\*53"):
        allpairs.dask.count([good, tmp_path / "large.npy"])


def test_a_folder_holds_the_parts_of_one_result(tmp_path):
    boxes = boxes_of("uniform", np.float32)
    folder = tmp_path / "pairs"
    first = allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(1000, 6)), folder)
    assert sorted(path.name for path in folder.iterdir()) == [f"part-0000{i}.npy" for i in range(3)]
    (tmp_path / "plain").write_text("")
    assert (folder / "part-00000.npy").stat().st_mode == (tmp_path / "plain").stat().st_mode
    before = [path.read_bytes() for path in sorted(folder.iterdir())]
    fewer = dask.array.from_array(boxes, chunks=(2000, 6))
    with pytest.raises(allpairs.FileError, match="^/.*/pairs/part-00002.npy: is of another result"):
        allpairs.dask.overlaps(fewer, folder)
    assert [path.read_bytes() for path in sorted(folder.iterdir())] == before
    (folder / "part-00002.npy").unlink()
    assert allpairs.dask.overlaps(fewer, folder) == first
    found = np.concatenate([np.load(path) for path in sorted(folder.iterdir())])
    assert found.tobytes() == allpairs.overlaps(boxes).tobytes()


def test_a_failure_leaves_the_whole_result_of_before(tmp_path, monkeypatch):
    boxes = boxes_of("uniform", np.float32)
    folder = tmp_path / "pairs"
    allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(1000, 6)), folder)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    save = np.save

    def fail_for_the_last(file, array):
        if "part-00002" in file.name:
            raise OSError(errno.ENOSPC, "No space left on device")
        save(file, array)

    monkeypatch.setattr(np, "save", fail_for_the_last)
    with dask.config.set(scheduler="synchronous"):  # of this process
        with pytest.raises(allpairs.FileError, match="part-00002.npy: cannot be written: No space left"):
            allpairs.dask.overlaps(dask.array.from_array(boxes, chunks=(1000, 6)), folder, distance=9.0)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_one_thread_at_a_time_reads_the_head_of_a_file(tmp_path, monkeypatch):
    names = [tmp_path / f"boxes{number}.npy" for number in range(8)]
    for name in names:
        np.save(name, boxes_of("uniform", np.float32)[:50])
    load, reading, most = np.load, [], []

    def slowly(path, **given):
        reading.append(path)
        most.append(len(reading))
        time.sleep(0.02)
        array = load(path, **given)
        reading.remove(path)
        return array

    monkeypatch.setattr(np, "load", slowly)
    assert allpairs.dask.overlaps(names).compute(scheduler="threads", num_workers=4).shape[1] == 2
    assert len(most) > len(names) and max(most) == 1


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_process_that_is_forked_while_files_are_read_reads_files(tmp_path):
    from allpairs import _parts

    np.save(tmp_path / "boxes.npy", boxes_of("uniform", np.float32)[:50])
    with _parts._READING:  # as by another thread
        child = os.fork()
        if child == 0:
            signal.alarm(20)
            with dask.config.set(scheduler="synchronous"):  # Dask's threads are not in this process
                os._exit(allpairs.dask.count(tmp_path / "boxes.npy") > 10**6)
    assert os.waitpid(child, 0)[1] == 0


def test_files_that_change_before_the_work_are_noticed(tmp_path):
    boxes, margins = tmp_path / "boxes.npy", tmp_path / "margins.npy"
    np.save(boxes, np.tile(np.arange(6.0), (20, 1)))
    np.save(margins, np.zeros(20))
    waiting = allpairs.dask.overlaps(boxes, margin=margins)
    # In this process: distributed may give the failure of the first compute() for the same task again.
    np.save(margins, np.zeros(19))
    with pytest.raises(allpairs.FileError, match=r"margins\.npy: has fewer than 20 numbers, which it had"):
        waiting.compute(scheduler="threads")
    np.save(margins, np.zeros(20))
    np.save(boxes, np.tile(np.arange(6.0), (30, 1)))
    with pytest.raises(allpairs.FileError, match=r"boxes\.npy: has shape \(30, 6\); it had \(20, 6\) when"):
        waiting.compute(scheduler="threads")
