# SPDX-License-Identifier: MIT
"""What allpairs.dask refuses, and what it says of it, that depends on no boxes."""

import errno
import os

import numpy as np
import pytest

import allpairs

dask = pytest.importorskip("dask")
import dask.array  # noqa: E402

import allpairs.dask  # noqa: E402


@pytest.mark.parametrize("name", ["margin", "group", "category", "mask"])
def test_masked_entries_in_chunks_are_refused(name):
    boxes = dask.array.from_array(np.tile([0.0, 0, 0, 1, 1, 1], (4, 1)), chunks=(2, 6))
    values = dask.array.from_array(np.ma.array([1, 1, 1, 1], mask=[0, 0, 0, 1]), chunks=2, asarray=False)
    with pytest.raises(allpairs.InvalidArgument, match=f"^{name} has masked entries"):
        allpairs.dask.overlaps(boxes, **{name: values}).compute()


@pytest.mark.parametrize("name", ["margin", "group", "category", "mask"])
@pytest.mark.parametrize("hidden", [np.ma.masked, np.ma.array(5, mask=True)])
def test_a_masked_number_for_all_boxes_is_refused(name, hidden):
    boxes = dask.array.from_array(np.array([[0, 0, 0, 2, 2, 2], [1, 1, 1, 3, 3, 3.0]]), chunks=(1, 6))
    for function in (allpairs.dask.overlaps, allpairs.dask.count):
        with pytest.raises(allpairs.InvalidArgument, match=f"^{name} has masked entries"):
            function(boxes, **{name: hidden})
    assert allpairs.dask.count(boxes, **{name: np.ma.array(5)}) == allpairs.count(boxes.compute(), **{name: 5})


@pytest.mark.parametrize("time", [np.timedelta64(5, "ns"), np.datetime64(5, "ns"), np.timedelta64(5, "s")])
def test_a_date_or_a_duration_for_all_boxes_is_refused(time):
    boxes = dask.array.zeros((4, 6), chunks=(2, 6))
    for name, takes in {"margin": "numbers", "group": "integers"}.items():
        with pytest.raises(allpairs.InvalidArgument, match=rf"^{name} has dtype .*\[n?s\]; it takes {takes}"):
            allpairs.dask.count(boxes, **{name: time})
    with pytest.raises(TypeError, match="^distance is .*; it takes a number$"):
        allpairs.dask.count(boxes, distance=time)


def test_errors_of_files_are_one_line_whatever_their_names(tmp_path):
    boxes = dask.array.zeros((4, 6), chunks=(2, 6))
    path = bytes(tmp_path) + "/a\n\x1b\u2028\u2029\x85".encode() + b"\xe9.npy"
    with open(path, "wb") as file:
        np.save(file, np.zeros(5))
    shown = f"{tmp_path}/a\\x0a\\x1b\\xe2\\x80\\xa8\\xe2\\x80\\xa9\\xc2\\x85\\xe9.npy"
    for call, message in (
        (lambda: allpairs.dask.count(path), "boxes has shape (5,); it takes (n, 6)"),
        (lambda: allpairs.dask.count(boxes, margin=path), "5 numbers, a margin for each of 4 boxes"),
        (lambda: allpairs.dask.overlaps(boxes, path), "cannot be made: File exists"),
    ):
        with pytest.raises(allpairs.FileError) as caught:
            call()
        assert str(caught.value) == f"{shown}: {message}"
        assert caught.value.path == os.fsdecode(path)
    header = np.lib.format.magic(2, 0) + (2**20).to_bytes(4, "little") + b" " * 2**20  # of which NumPy says two lines
    (tmp_path / "long.npy").write_bytes(header)
    with pytest.raises(allpairs.FileError, match="^/.*/long.npy: cannot be read as .npy: ") as caught:
        allpairs.dask.count(tmp_path / "long.npy")
    assert "\n" not in str(caught.value)


def test_a_folder_that_cannot_be_written_is_named(tmp_path):
    boxes = dask.array.zeros((4, 6), chunks=(2, 6))
    (tmp_path / "file").write_text("")
    with pytest.raises(allpairs.FileError, match="^/.*/file: cannot be made: File exists$") as caught:
        allpairs.dask.overlaps(boxes, tmp_path / "file")
    assert (caught.value.errno, caught.value.filename) == (errno.EEXIST, str(tmp_path / "file"))
    (tmp_path / "pairs" / "part-00001.npy").mkdir(parents=True)
    with pytest.raises(allpairs.FileError, match="^/.*/part-00001.npy: cannot be written: Is a directory$"):
        allpairs.dask.overlaps(boxes, tmp_path / "pairs")


@pytest.mark.parametrize("name", ["", b"", "a\0b", "\ud800"])
def test_a_name_that_no_file_can_have_is_refused(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    boxes = dask.array.zeros((4, 6), chunks=(2, 6))
    for argument, call in {
        "output": lambda: allpairs.dask.overlaps(boxes, name),
        "boxes": lambda: allpairs.dask.count(name),
        "second": lambda: allpairs.dask.count(boxes, second=[name]),
        "margin": lambda: allpairs.dask.count(boxes, margin=name),
        "second set: group": lambda: allpairs.dask.count(boxes, second=boxes, group=(None, [name])),
    }.items():
        with pytest.raises(allpairs.InvalidArgument, match=rf"^{argument} is b?'.*', which no file can be called$"):
            call()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("argument", ["boxes", "second", "margin"])
def test_a_result_takes_the_place_of_no_input(tmp_path, argument):
    rows = np.repeat(np.arange(6.0), 6).reshape(6, 6) + np.repeat([0.0, 2.0], 3)
    folder = tmp_path / "pairs"
    folder.mkdir()
    names = [folder / f"part-0000{number}.npy" for number in range(3)]
    for name, part in zip(names, np.split(np.arange(6.0) if argument == "margin" else rows, 3)):
        np.save(name, part)
    before = [name.read_bytes() for name in names]
    given = {"boxes": dask.array.from_array(rows, chunks=(2, 6)), argument: names}
    (tmp_path / "link").symlink_to(folder)
    for output in (folder, tmp_path / "link"):
        message = "^/.*/part-00000.npy: is an input; the output needs another folder$"
        with pytest.raises(allpairs.FileError, match=message):
            allpairs.dask.overlaps(output=output, **given)
    few = {**given, "boxes": dask.array.from_array(rows, chunks=(6, 6))}
    with pytest.raises(allpairs.FileError, match="^/.*/part-0000[0-2].npy: is an input; the output needs another folder$"):
        allpairs.dask.overlaps(output=folder, **(given if argument == "boxes" else few))  # which is no older result
    assert [name.read_bytes() for name in names] == before and sorted(folder.iterdir()) == names
    assert allpairs.dask.overlaps(output=tmp_path / "others", **given) == allpairs.dask.count(**given)
