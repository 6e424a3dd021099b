# SPDX-License-Identifier: MIT
"""Boxes, and what belongs to each of them, as parts that Dask's tasks read: of Dask arrays, arrays and .npy files."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from threading import Lock
from typing import Any, NamedTuple, Optional

import numpy as np
import numpy.typing as npt
from dask.array.core import Array as DaskArray
from dask.delayed import delayed

from . import _arguments
from ._errors import Error, FileError, InvalidArgument, InvalidBox, file_error, shown_path

Array = npt.NDArray[Any]

#: What each box may have: an array of one dimension, or a number for all.
Values = dict[str, Any]


class Place(NamedTuple):
    """What errors call what a part is of: a file, or an array in which the part has its first box at ``begin``."""

    called: str
    begin: int = 0
    is_file: bool = False


def reason(problem: Exception) -> str:
    """Why the system refuses something, without the name of the file."""
    return getattr(problem, "strerror", None) or " ".join(str(problem).split())


@contextmanager
def at(place: Place) -> Iterator[None]:
    """Errors of what is done to a part say of which file or box."""
    try:
        yield
    except Error as problem:
        if isinstance(problem, FileError):
            raise
        if place.is_file:
            raise file_error(place.called, problem) from None
        if isinstance(problem, InvalidBox):
            index = place.begin + problem.index
            what = str(problem).removeprefix(f"box {problem.index}: ")
            raise InvalidBox(f"box {index} of {place.called}: {what}", index) from None
        raise


def _begins_of(sizes: Sequence[int]) -> list[int]:
    """The number of the first box of each part, and that of all boxes."""
    return [0, *np.cumsum(sizes).tolist()]


class BoxParts(NamedTuple):
    """A set of boxes as parts that tasks read."""

    parts: list[Any]
    sizes: list[int]
    values: list[Values]
    """Of each part, what was given."""
    places: list[Place]
    files: list[str]
    """Those that were named, of boxes and of values."""

    @property
    def begins(self) -> list[int]:
        """The number of the first box of each part, and that of all boxes."""
        return _begins_of(self.sizes)


#: One thread at a time reads the head of a file: NumPy parses it with `ast`, which raises SystemError now and then in threads
#: of Python 3.11 (https://github.com/python/cpython/issues/106905).
_READING = Lock()


def _unlock() -> None:
    """In a process that was forked while another thread was reading, nobody would unlock it."""
    global _READING
    _READING = Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_unlock)


def _read(path: str) -> Array:
    """An array in a file, which is mapped."""
    if os.path.exists(path) and not os.path.isfile(path):
        raise file_error(path, "is no file")
    try:
        with _READING:
            array = np.load(path, mmap_mode="r", allow_pickle=False)
    except (OSError, ValueError, EOFError) as problem:
        raise file_error(path, f"cannot be read as .npy: {reason(problem)}", problem) from None
    if not isinstance(array, np.ndarray):
        raise file_error(path, "cannot be read as .npy: it holds several arrays")
    end = getattr(array, "offset", 0) + array.nbytes
    if isinstance(array, np.memmap) and array.size and end != os.path.getsize(path):
        raise file_error(path, f"is {os.path.getsize(path)} bytes long; its array ends at {end}")
    return array


def _read_planned(path: str, shape: tuple[int, ...]) -> Array:
    """Boxes in a file that had that shape when the work was planned."""
    array = _read(path)
    if array.shape != shape:
        raise file_error(path, f"has shape {array.shape}; it had {shape} when the work was planned")
    return array


def full_path(name: str, value: Any) -> str:
    """The path that an argument names, for processes in other folders."""
    path = _arguments.path_of(name, value)
    if not path:  # the working folder, if it were made absolute
        raise InvalidArgument(f"{name} is {_arguments.shown(value)}, which no file can be called")
    return os.path.abspath(path)


def _files_of(name: str, value: Any) -> Optional[list[str]]:
    """The paths that an argument names; None if it is something else."""
    if isinstance(value, (str, bytes, os.PathLike)):
        value = [value]
    elif isinstance(value, (np.ndarray, DaskArray)) or not np.iterable(value):
        return None
    paths = value if isinstance(value, (list, tuple)) else list(value)
    if not all(isinstance(path, (str, bytes, os.PathLike)) for path in paths):
        return None
    return [full_path(name, path) for path in paths]


def _check_chunks(argument: str, array: Any) -> None:
    if np.isnan(array.shape[0]):
        raise InvalidArgument(f"{argument} has chunks of unknown sizes; call compute_chunk_sizes() before")


def _check_boxes(argument: str, shape: tuple[int, ...], dtype: np.dtype[Any]) -> None:
    if len(shape) != 2 or shape[1] != 6:
        raise InvalidArgument(f"{argument} has shape {shape}; it takes (n, 6)")
    _arguments.floats(argument, np.zeros(1, dtype))


def _boxes_of(argument: str, boxes: Any) -> tuple[list[Any], list[int], list[str]]:
    """The boxes as parts that tasks read, the number of boxes in each, and the files, if they are of files."""
    if isinstance(boxes, DaskArray):
        _check_boxes(argument, boxes.shape, boxes.dtype)
        _check_chunks(argument, boxes)
        rows = boxes.rechunk({1: 6})
        return list(rows.to_delayed().ravel()), [int(size) for size in rows.chunks[0]], []
    names = _files_of(argument, boxes)
    if names is None:
        raise TypeError(f"{argument} is {type(boxes).__name__}; it takes a dask array, or .npy files")
    if not names:
        raise InvalidArgument(f"{argument} names no file")
    shapes = []
    for name in names:
        array = _read(name)
        with at(Place(name, is_file=True)):
            _check_boxes(argument, array.shape, array.dtype)
        shapes.append(array.shape)
    read = delayed(_read_planned)
    return [read(name, shape) for name, shape in zip(names, shapes)], [shape[0] for shape in shapes], names


def _checked(name: str, values: Array, called: str, begin: int) -> Array:
    """Values that a search takes; an error says which it does not."""
    if name != "margin":
        try:
            return _arguments.labels(called, values, len(values))
        except InvalidBox as problem:
            at = problem.index
            raise InvalidArgument(f"{called}[{begin + at}] is {values[at]}; it takes 0 to 4294967295") from None
    margins = _arguments.floats(called, values).astype(np.float64, copy=False)
    wrong = np.flatnonzero(~(margins > -np.inf))
    if len(wrong):
        raise InvalidArgument(f"{called}[{begin + wrong[0]}] is {margins[wrong[0]]}; it takes numbers")
    return margins


def _joined(name: str, blocks: list[Array], called: str, begin: int) -> Array:
    return _checked(name, np.concatenate([_arguments.array_of(called, block) for block in blocks]), called, begin)


def _read_range(name: str, pieces: list[tuple[str, int, int]]) -> Array:
    """What lies in parts of files, one after the other."""
    rows = []
    for path, begin, end in pieces:
        values = _read(path)[begin:end]
        if len(values) != end - begin:
            raise file_error(path, f"has fewer than {end} numbers, which it had when the work was planned")
        with at(Place(path, is_file=True)):
            rows.append(_checked(name, values, name, begin))
    return np.concatenate(rows)


def _pieces(names: Sequence[str], sizes: Sequence[int], begin: int, end: int) -> list[tuple[str, int, int]]:
    """Which rows of which files are [begin, end) of all of them; of one file at least, so that there is a type."""
    ends = np.cumsum(sizes).tolist()
    rows = [
        (name, max(begin - (last - size), 0), min(end - (last - size), size)) for name, size, last in zip(names, sizes, ends)
    ]
    return [(name, low, high) for name, low, high in rows if low < high] or [(names[0], 0, 0)]


def _check_type(name: str, called: str, shape: tuple[int, ...], dtype: np.dtype[Any]) -> None:
    if len(shape) != 1:
        raise InvalidArgument(f"{called} has shape {shape}; it takes one number for each box")
    if dtype.kind not in ("iub" if name != "margin" else "iubf"):
        raise InvalidArgument(f"{called} has dtype {dtype}; it takes {'integers' if name != 'margin' else 'numbers'}")


def _of_files(name: str, names: list[str], begins: Sequence[int]) -> list[Any]:
    if not names:
        raise InvalidArgument(f"{name} names no file")
    arrays = [_read(path) for path in names]
    for path, array in zip(names, arrays):
        with at(Place(path, is_file=True)):
            _check_type(name, name, array.shape, array.dtype)
    sizes = [len(array) for array in arrays]
    if sum(sizes) != begins[-1]:
        problem = f"{', '.join(map(shown_path, names))}: {sum(sizes)} numbers, a {name} for each of {begins[-1]} boxes"
        raise FileError(problem, names[0], 0, 0)
    read = delayed(_read_range)
    return [read(name, _pieces(names, sizes, begin, end)) for begin, end in zip(begins, begins[1:])]


def _of_each_part(name: str, value: Any, begins: Sequence[int], prefix: str, files: list[str]) -> list[Any]:
    """The value for the boxes of each part: what a task reads, or the number that all have. Adds files that it names."""
    called = prefix + name
    names = _files_of(called, value)
    if names is not None:
        files.extend(names)
        return _of_files(name, names, begins)
    if _arguments.is_one(value):
        single = (_arguments.floats if name == "margin" else _arguments.array_of)(called, value).reshape(1)
        _check_type(name, called, single.shape, single.dtype)
        return [_checked(name, single, called, 0)[0].item()] * (len(begins) - 1)
    array: Any = value if isinstance(value, DaskArray) else _arguments.array_of(called, value)
    _check_type(name, called, array.shape, array.dtype)
    if isinstance(array, DaskArray):
        _check_chunks(called, array)
    if array.shape[0] != begins[-1]:
        raise InvalidArgument(f"{called} has shape {array.shape}; for {begins[-1]} boxes it takes ({begins[-1]},)")
    rows = [array[begin:end] for begin, end in zip(begins, begins[1:])]
    blocks = [list(part.to_delayed().ravel()) if isinstance(part, DaskArray) else [part] for part in rows]
    return [delayed(_joined)(name, parts, called, begin) for parts, begin in zip(blocks, begins)]


def _of_each_set(name: str, value: Any, sets: int) -> list[Any]:
    if sets == 1:
        return [value]
    return list(_arguments.both(name, [value] if isinstance(value, (str, bytes)) else value))


def box_parts(values: Values) -> list[BoxParts]:
    """One set, or two: what `boxes` and `second` are, with margins and labels of each."""
    names = {"boxes": "all"} if values["second"] is None else {"boxes": "the first set", "second": "the second set"}
    prefixes = ("",) if len(names) == 1 else ("first set: ", "second set: ")
    own = {name: _of_each_set(name, values[name], len(names)) for name in _arguments.OF_EACH_BOX}
    sets = []
    for i, (argument, called) in enumerate(names.items()):
        parts, sizes, files = _boxes_of(argument, values[argument])
        begins = _begins_of(sizes)
        places = [Place(file, is_file=True) for file in files] or [Place(called, begin) for begin in begins[:-1]]
        given = {name: pair[i] for name, pair in own.items() if pair[i] is not None}
        columns = {name: _of_each_part(name, value, begins, prefixes[i], files) for name, value in given.items()}
        rows = [{name: column[number] for name, column in columns.items()} for number in range(len(parts))]
        sets.append(BoxParts(parts, sizes, rows, places, files))
    return sets
