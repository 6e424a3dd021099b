# SPDX-License-Identifier: MIT
"""The same boxes through every driver of a join: one file of pairs, byte for byte."""

import hashlib
import os
import shutil
import subprocess

import numpy as np
import pytest

import allpairs
from conftest import corners, every_pair_between

PROGRAM = os.environ.get("ALLPAIRS_PROGRAM", "")
MPI_PROGRAM = os.environ.get("ALLPAIRS_MPI_PROGRAM", "")
MPIRUN = os.environ.get("ALLPAIRS_MPIRUN", "")

pytestmark = pytest.mark.skipif(not PROGRAM, reason="needs the program")
needs_mpi = pytest.mark.skipif(not MPI_PROGRAM, reason="needs MPI")

SCENES = [
    "uniform",
    "clusters",
    "power-law",
    "needles",
    "one place",
    "giant",
    "lattice",
    "far",
    "none",
    "two",
]


def boxes_of(scene):
    rng = np.random.default_rng(11)
    count = 20_000
    lower = rng.random((count, 3), dtype=np.float32) * np.float32(25)
    size = rng.random((count, 3), dtype=np.float32)
    if scene == "clusters":
        lower = np.float32(0.3) * lower + np.float32(20) * rng.integers(0, 9, (count, 1)).astype(np.float32)
    if scene == "power-law":
        size = np.minimum((1 - rng.random((count, 1), dtype=np.float32)) ** np.float32(-0.5) * np.float32(0.3), 6)
    if scene == "needles":
        size[np.arange(count), rng.integers(0, 3, count)] *= 20
        size *= np.float32(0.4)
    if scene == "one place":
        lower = lower[:1500] * np.float32(1e-3)
        size = size[:1500]
    if scene == "lattice":
        lower = np.indices((26, 26, 26)).reshape(3, -1).T.astype(np.float32)
        size = np.float32(1)
    boxes = np.hstack([lower, lower + size])
    if scene == "giant":
        boxes[4321] = [-99, -99, -99, 999, 999, 999]
    if scene == "far":
        boxes = boxes.astype(np.float64) / 3 + 1e9
    if scene in ("none", "two"):
        boxes = boxes[: 2 * (scene == "two")]
    return boxes


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def run(*arguments, status=0):
    done = subprocess.run(list(map(str, arguments)), capture_output=True, text=True, timeout=300)
    assert done.returncode == status, done.stdout + done.stderr
    return done


def mpirun(ranks, *arguments, status=0):
    return run(MPIRUN, "-n", ranks, MPI_PROGRAM, *arguments, status=status)


@pytest.mark.parametrize("scene", SCENES)
def test_one_digest_of_all_drivers(tmp_path, scene):
    np.save(tmp_path / "boxes.npy", boxes_of(scene))
    boxes = tmp_path / "boxes.npy"
    run(PROGRAM, "detect", boxes, "-o", tmp_path / "detect.npy")
    expected = digest(tmp_path / "detect.npy")
    for memory in ("4G", "64M"):
        run(PROGRAM, "join", boxes, "-o", tmp_path / "join.npy", "--memory", memory)
        assert digest(tmp_path / "join.npy") == expected
    for ranks in (1, 2, 3, 4, 7) if MPI_PROGRAM else ():
        mpirun(ranks, "join", boxes, "-o", tmp_path / "mpi.npy")
        assert digest(tmp_path / "mpi.npy") == expected, ranks
        (tmp_path / "mpi.npy").unlink()


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("workers", [1, 2])
def test_dask_has_the_same_pairs(scene, workers):
    dask = pytest.importorskip("dask")
    import dask.array

    import allpairs.dask

    boxes = boxes_of(scene)
    array = dask.array.from_array(boxes, chunks=(7000, 6))
    pairs = allpairs.dask.overlaps(array).compute(scheduler="threads", num_workers=workers)
    assert pairs.tobytes() == allpairs.overlaps(boxes).tobytes()


@needs_mpi
def test_distance_count_and_several_files(tmp_path):
    boxes = boxes_of("clusters")[:5000]
    np.save(tmp_path / "all.npy", boxes)
    np.save(tmp_path / "a.npy", boxes[:17])
    np.save(tmp_path / "b.npy", boxes[:0].astype(np.float64))
    np.save(tmp_path / "c.npy", np.asfortranarray(boxes[17:]))
    run(PROGRAM, "detect", tmp_path / "all.npy", "--distance", "0.4", "-o", tmp_path / "detect.npy")
    parts = [tmp_path / name for name in ("a.npy", "b.npy", "c.npy")]
    done = mpirun(3, "join", *parts, "--distance", "0.4", "-o", tmp_path / "mpi.npy")
    count = len(np.load(tmp_path / "mpi.npy"))
    assert f"{count:,} pairs among 5,000 boxes on 3 ranks -> " in done.stdout
    assert digest(tmp_path / "mpi.npy") == digest(tmp_path / "detect.npy")
    assert f"{count:,} pairs" in mpirun(2, "join", *parts, "--distance=0.4", "--count").stdout


SETS = [
    ("uniform", "clusters"),
    ("needles", "uniform"),
    ("giant", "two"),
    ("two", "giant"),
    ("one place", "one place"),
    ("far", "far"),
    ("none", "uniform"),
    ("uniform", "none"),
    ("none", "none"),
]


@pytest.mark.parametrize("first, second", SETS)
def test_two_sets_have_one_list_in_all_drivers(tmp_path, first, second):
    a, b = boxes_of(first)[1::2], boxes_of(second)[1::3]
    np.save(tmp_path / "a.npy", a)
    np.save(tmp_path / "b.npy", b[:100].astype(np.float64))
    np.save(tmp_path / "c.npy", b[100:])
    expected = allpairs.overlaps_between(a, b, distance=0.25)
    assert expected.tolist() == every_pair_between(corners(a), corners(b), 0.25).tolist()
    arguments = ["join", tmp_path / "a.npy", "--with", tmp_path / "b.npy", tmp_path / "c.npy", "--distance", "0.25"]
    for memory in ("4G", "64M"):
        run(PROGRAM, *arguments, "-o", tmp_path / "join.npy", "--memory", memory)
        assert np.load(tmp_path / "join.npy").tobytes() == expected.tobytes()
    for ranks in (1, 3) if MPI_PROGRAM else ():
        done = mpirun(ranks, *arguments, "-o", tmp_path / "mpi.npy")
        assert digest(tmp_path / "mpi.npy") == digest(tmp_path / "join.npy"), ranks
        assert f" among {len(a):,} and {len(b):,} box" in done.stdout
        assert mpirun(ranks, *arguments, "--count").stdout.startswith(f"{len(expected):,} pair")


@needs_mpi
@pytest.mark.parametrize("ranks", [1, 3])
def test_what_is_wrong_ends_all_ranks_with_one_line(tmp_path, ranks):
    boxes = boxes_of("uniform")[:300]
    boxes[299, 4] = np.nan
    np.save(tmp_path / "good.npy", boxes[:10])
    np.save(tmp_path / "bad.npy", boxes)
    out = tmp_path / "pairs.npy"
    out.write_text("of before")

    def complaint(*arguments, status):
        lines = mpirun(ranks, "join", *arguments, status=status).stderr.splitlines()
        ours = [line for line in lines if line.startswith("allpairs-mpi: ")]
        assert len(ours) == 1, lines
        return ours[0]

    said = complaint(tmp_path / "good.npy", tmp_path / "bad.npy", "-o", out, status=3)
    assert said.endswith("bad.npy: box 299 has a NaN")
    assert "absent.npy" in complaint(tmp_path / "absent.npy", "--count", status=3)
    assert "absent.npy" in complaint(tmp_path / "good.npy", "--count", "--with", tmp_path / "absent.npy", status=3)
    said = complaint(tmp_path / "good.npy", "--count", "--with", tmp_path / "good.npy", tmp_path / "bad.npy", status=3)
    assert said.endswith("bad.npy: box 299 has a NaN")
    nowhere = tmp_path / "nowhere" / "pairs.npy"
    assert "nowhere/pairs.npy: cannot be created" in complaint(tmp_path / "good.npy", "-o", nowhere, status=3)
    assert "takes -o FILE" in complaint(tmp_path / "good.npy", status=2)
    assert "--distance" in complaint(tmp_path / "good.npy", "--count", "--distance", "far", status=2)
    assert out.read_text() == "of before"
    (tmp_path / "folder.npy").mkdir()
    assert "folder.npy: is a folder" in complaint(tmp_path / "good.npy", "-o", tmp_path / "folder.npy", status=3)
    (tmp_path / "folder.npy").rmdir()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad.npy", "good.npy", "pairs.npy"]


@needs_mpi
@pytest.mark.skipif(not shutil.which("bash"), reason="needs bash to limit what a process may write")
def test_a_full_disk_is_an_error_and_what_was_there_stays(tmp_path):
    np.save(tmp_path / "boxes.npy", np.tile(boxes_of("one place"), (2, 1)))
    (tmp_path / "pairs.npy").write_text("of before")
    limited = f"ulimit -f 16384; exec {MPIRUN} -n 2 {MPI_PROGRAM} join boxes.npy -o pairs.npy"  # 36 MB
    done = subprocess.run(["bash", "-c", limited], cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 3, done.stderr
    assert "pairs.npy: cannot be written" in done.stderr
    assert (tmp_path / "pairs.npy").read_text() == "of before"
    assert len(list(tmp_path.iterdir())) == 2


@needs_mpi
def test_any_name_of_a_file_and_a_link(tmp_path):
    np.save(tmp_path / "boxes.npy", boxes_of("uniform")[:500])
    run(PROGRAM, "detect", tmp_path / "boxes.npy", "-o", tmp_path / "detect.npy")
    deep = tmp_path / ("d" * 200) / ("e" * 200)
    deep.mkdir(parents=True)
    long = deep / ("f" * 240 + ".npy")
    long.write_text("longer than what takes its place " * 1000)
    (tmp_path / "link.npy").symlink_to(long)
    mpirun(2, "join", tmp_path / "boxes.npy", "-o", tmp_path / "link.npy")
    assert (tmp_path / "link.npy").is_symlink()
    assert digest(long) == digest(tmp_path / "detect.npy")
    assert [path.name for path in deep.iterdir()] == [long.name]


@needs_mpi
def test_a_count_that_cannot_be_said_is_an_error(tmp_path):
    np.save(tmp_path / "boxes.npy", boxes_of("uniform")[:500])
    with open("/dev/full", "w") as full:
        done = subprocess.run([MPI_PROGRAM, "join", tmp_path / "boxes.npy", "--count"], stdout=full, timeout=100)
    assert done.returncode == 3
