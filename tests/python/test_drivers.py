# SPDX-License-Identifier: MIT
"""The same boxes through every driver of a join: one file of pairs, byte for byte."""

import hashlib
import os
import shutil
import subprocess

import numpy as np
import pytest

import allpairs
from conftest import corners, every_kept_pair, every_kept_pair_between, every_pair_between, what_boxes_may_have

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
def test_a_result_that_is_read_only_is_replaced_by_any_number_of_ranks(tmp_path):
    np.save(tmp_path / "boxes.npy", boxes_of("two"))
    pairs = tmp_path / "pairs.npy"
    as_a_user = []
    if os.geteuid() == 0:
        as_a_user = [shutil.which("setpriv") or pytest.skip("root may write it"), "--bounding-set", "-dac_override"]
    for ranks in (1, 2):
        pairs.unlink(missing_ok=True)
        pairs.write_bytes(b"before")
        pairs.chmod(0o440)
        run(*as_a_user, MPIRUN, "-n", ranks, MPI_PROGRAM, "join", tmp_path / "boxes.npy", "-o", pairs)
        assert np.load(pairs).shape[1] == 2
        assert pairs.stat().st_mode & 0o777 == 0o440
        assert len(list(tmp_path.iterdir())) == 2


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


def odd_boxes(scene, step):
    """Some boxes of a scene, of which some are empty or without end."""
    boxes = boxes_of(scene)[1::step][:700]
    boxes[3::71, 4] = boxes[3::71, 1] - 1
    boxes[5::197, 3:] = np.inf
    return boxes


def saved_values(folder, prefix, own):
    """The options of a command for what boxes have, each in two files of different types."""
    options = []
    for name, plural in (("margin", "margins"), ("group", "groups"), ("category", "categories"), ("mask", "masks")):
        values = own[name]
        np.save(folder / f"{prefix}{name}0.npy", values[:60].astype(">f8" if name == "margin" else np.uint8))
        np.save(folder / f"{prefix}{name}1.npy", values[60:].astype(np.float64 if name == "margin" else ">i8"))
        options += [f"--{prefix}{plural}", folder / f"{prefix}{name}0.npy", folder / f"{prefix}{name}1.npy"]
    return options


REGIONS = {"uniform": [2, 0, -1, 19, 22, 9], "far": [1e9, 1e9, 1e9, 1e9 + 5, 1e9 + 6, 1e9 + 7], "giant": None}


@pytest.mark.parametrize("scene", REGIONS)
def test_what_boxes_may_have_decides_as_in_one_search(tmp_path, scene):
    boxes = odd_boxes(scene, 6)
    own = what_boxes_may_have(len(boxes), 7)
    np.save(tmp_path / "a.npy", boxes[:333])
    np.save(tmp_path / "b.npy", boxes[333:])
    region, distance = REGIONS[scene], 0.125
    expected = every_kept_pair(boxes, distance=distance, region=region, **own)
    assert allpairs.overlaps(boxes, distance=distance, region=region, **own).tobytes() == expected.tobytes()
    assert len(expected) > 20
    arguments = ["join", tmp_path / "a.npy", tmp_path / "b.npy", "--distance", distance, *saved_values(tmp_path, "", own)]
    if region:
        arguments += ["--box", ",".join(map(repr, region))]
    run(PROGRAM, *arguments, "-o", tmp_path / "join.npy", "--memory", "64M")
    assert np.load(tmp_path / "join.npy").tobytes() == expected.tobytes()
    assert run(PROGRAM, *arguments, "--count").stdout.startswith(f"{len(expected):,} pairs among {len(boxes)} boxes\n")
    for ranks in (1, 3) if MPI_PROGRAM else ():
        mpirun(ranks, *arguments, "-o", tmp_path / "mpi.npy")
        assert digest(tmp_path / "mpi.npy") == digest(tmp_path / "join.npy"), ranks
    if not MPI_PROGRAM:
        return
    assert mpirun(3, *arguments, "--count").stdout.startswith(f"{len(expected):,} pairs among {len(boxes)} boxes")


@pytest.mark.parametrize("scenes", [("uniform", "giant"), ("far", "far")])
def test_what_boxes_of_two_sets_may_have_decides_as_in_one_search(tmp_path, scenes):
    first, second = odd_boxes(scenes[0], 6), odd_boxes(scenes[1], 9)[:500]
    owns = [what_boxes_may_have(len(first), 8), what_boxes_may_have(len(second), 9)]
    np.save(tmp_path / "a.npy", first)
    np.save(tmp_path / "b.npy", second)
    region = REGIONS[scenes[0]]
    own = {name: (owns[0][name], owns[1][name]) for name in owns[0]}
    expected = every_kept_pair_between(first, second, region=region, **own)
    assert allpairs.overlaps_between(first, second, region=region, **own).tobytes() == expected.tobytes()
    assert len(expected) > 20
    values = [*saved_values(tmp_path, "", owns[0]), *saved_values(tmp_path, "with-", owns[1])]
    arguments = ["join", tmp_path / "a.npy", "--with", tmp_path / "b.npy", *values, "--box", ",".join(map(repr, region))]
    run(PROGRAM, *arguments, "-o", tmp_path / "join.npy")
    assert np.load(tmp_path / "join.npy").tobytes() == expected.tobytes()
    for ranks in (1, 4) if MPI_PROGRAM else ():
        mpirun(ranks, *arguments, "-o", tmp_path / "mpi.npy")
        assert digest(tmp_path / "mpi.npy") == digest(tmp_path / "join.npy"), ranks


def test_boxes_that_are_empty_by_mistake_are_named(tmp_path):
    first, second = np.tile([0.0, 0, 0, 1, 1, 1], (900, 1)), np.tile([0.0, 0, 0, 1, 1, 1], (800, 1))
    first[500, :3] = np.inf  # as it was meant
    second[[777, 411, 9], [4, 5, 3]] = -5
    np.save(tmp_path / "a.npy", first)
    np.save(tmp_path / "b.npy", second)
    arguments = ["join", tmp_path / "a.npy", "--with", tmp_path / "b.npy", tmp_path / "a.npy", "--count"]
    reason = "min above max on x (and 2 other boxes): empty, in no pair"
    expected = f"warning: {tmp_path / 'b.npy'} and 1 more: box 9 of all of them, in set 2: {reason}"
    assert run(PROGRAM, *arguments).stderr == f"allpairs: {expected}\n"
    for ranks in (1, 3) if MPI_PROGRAM else ():
        lines = mpirun(ranks, *arguments).stderr.splitlines()
        assert [line for line in lines if line.startswith("allpairs-mpi: ")] == [f"allpairs-mpi: {expected}"], ranks
    assert allpairs.join(tmp_path / "b.npy").empty_boxes == 3
    assert allpairs.join(tmp_path / "a.npy", second=tmp_path / "b.npy").empty_boxes == 3
    assert allpairs.join(tmp_path / "a.npy").empty_boxes == 0


@needs_mpi
def test_values_that_are_wrong_are_named(tmp_path):
    ranks = 2
    margins = np.zeros(300)
    margins[298] = np.nan
    for name, values in {
        "a": boxes_of("uniform")[:300],
        "nan": margins,
        "short": margins[:299],
        "flat": np.zeros((300, 1)),
        "far": np.full(300, -1),
    }.items():
        np.save(tmp_path / f"{name}.npy", values)

    def refused(said, *arguments, status=3):
        lines = mpirun(ranks, "join", tmp_path / "a.npy", "--count", *arguments, status=status).stderr.splitlines()
        ours = [line for line in lines if line.startswith("allpairs-mpi: ")]
        assert len(ours) == 1 and said in ours[0], lines

    refused("nan.npy: margin 298 is a NaN", "--margins", tmp_path / "nan.npy")
    refused("short.npy: has 299 margins for 300 boxes", "--margins", tmp_path / "short.npy")
    refused("flat.npy: has shape (300, 1); margins are (n,)", "--margins", tmp_path / "flat.npy")
    refused("nan.npy: holds numbers of type '<f8'; masks are integers", "--masks", tmp_path / "nan.npy")
    refused("far.npy: number 0 is -1; 0 to 4294967295 are taken", "--groups", tmp_path / "far.npy")
    other = ("--with", tmp_path / "a.npy")
    refused("far.npy: number 0 is -1", *other, "--with-categories", tmp_path / "far.npy")
    refused("gone.npy", *other, "--with-margins", tmp_path / "gone.npy")
    refused("--with-margins requires --with", "--with-margins", tmp_path / "nan.npy", status=2)
    refused("--box: '1,2,3'", "--box", "1,2,3", status=2)
    refused("-o, --output: the value is empty", "-o", "", status=2)
    refused("--distance: D is missing", "--distance", status=2)
    refused("unknown option '--masc' - did you mean --masks?", "--masc", status=2)
    masks = ("--masks", tmp_path / "far.npy", tmp_path / "a.npy", tmp_path / "a.npy")
    assert "BOXES come before --masks, which" in mpirun(ranks, "join", "--count", *masks, status=2).stderr


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
    assert said.endswith("bad.npy: box 299: max y is not a number (NaN)")
    assert "absent.npy" in complaint(tmp_path / "absent.npy", "--count", status=3)
    assert "absent.npy" in complaint(tmp_path / "good.npy", "--count", "--with", tmp_path / "absent.npy", status=3)
    said = complaint(tmp_path / "good.npy", "--count", "--with", tmp_path / "good.npy", tmp_path / "bad.npy", status=3)
    assert said.endswith("bad.npy: box 299: max y is not a number (NaN)")
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
    assert "allpairs-mpi: pairs.npy: cannot be written: File too large\n" in done.stderr
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
    (tmp_path / "to-nothing.npy").symlink_to("new.npy")
    mpirun(2, "join", tmp_path / "boxes.npy", "-o", tmp_path / "to-nothing.npy")
    assert (tmp_path / "to-nothing.npy").is_symlink()
    assert digest(tmp_path / "new.npy") == digest(long)
    for name in ("PAIRS.NPY", "pairs"):
        mpirun(2, "join", tmp_path / "boxes.npy", "-o", tmp_path / name)
        assert digest(tmp_path / name) == digest(long)
    for name in (tmp_path / "pairs.csv", "-"):
        assert "allpairs-mpi: " in mpirun(2, "join", tmp_path / "boxes.npy", "-o", name, status=2).stderr
        assert not os.path.exists(name)


@needs_mpi
def test_ranks_with_other_arguments_all_end(tmp_path):
    np.save(tmp_path / "a.npy", boxes_of("uniform")[:500])
    np.save(tmp_path / "b.npy", boxes_of("uniform")[:300])

    def both(first, second, status):
        calls = [[MPI_PROGRAM, "join", tmp_path / "a.npy", *each] for each in (first, second)]
        return run(MPIRUN, "-n", 1, *calls[0], ":", "-n", 1, *calls[1], status=status)

    for other in (["--count", "--distance", "1"], ["--count", "--nothing"], ["--help"], ["-o", tmp_path / "p.npy"]):
        assert "allpairs-mpi: rank 1 has other arguments than rank 0" in both(["--count"], other, 2).stderr
    one = mpirun(1, "join", tmp_path / "a.npy", "--count").stdout.split(" on ")[0]
    assert both(["--count", "--threads", "1"], ["--count", "--threads=2"], 0).stdout.startswith(one)
    said = both(["--count", "--threads", "1"], ["--count", "--threads", "99999"], 2).stderr
    assert "allpairs-mpi: rank 1: --threads" in said, said
    twice = ["--count", "--threads", "1", "--threads", "1"]
    assert "rank 1 has other arguments" in both(["--count", "--threads", "1"], twice, 2).stderr


@needs_mpi
def test_help_that_cannot_be_said_is_an_error():
    for arguments in (["--help"], ["join", "--help"], ["--version"]):
        with open("/dev/full", "w") as full:
            assert subprocess.run([MPI_PROGRAM, *arguments], stdout=full, timeout=100).returncode == 3


@needs_mpi
def test_a_count_that_cannot_be_said_is_an_error(tmp_path):
    np.save(tmp_path / "boxes.npy", boxes_of("uniform")[:500])
    with open("/dev/full", "w") as full:
        done = subprocess.run([MPI_PROGRAM, "join", tmp_path / "boxes.npy", "--count"], stdout=full, timeout=100)
    assert done.returncode == 3
