# SPDX-License-Identifier: MIT
"""Overlapping pairs of boxes in Dask arrays and in files, computed by Dask's workers.

Space is cut into cells; each task is one call in one process, and tasks that run again return the same bytes. Needs
Dask (Debian: python3-dask, and python3-distributed for several processes).
"""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Hashable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple, Optional, Union
from uuid import uuid4

import numpy as np
import numpy.typing as npt
from dask.array.core import Array as DaskArray
from dask.base import compute
from dask.delayed import Delayed, delayed
from dask.highlevelgraph import HighLevelGraph

from . import _arguments
from . import count as count_in_memory
from ._errors import file_error
from ._partition import (
    Partition,
    count_between_in_cell,
    count_in_cell,
    overlaps_between_in_cell,
    overlaps_in_cell,
)
from ._parts import Array, BoxParts, Place, Values, at, box_parts, full_path, reason

__all__ = ["count", "overlaps"]

PathLike = Union[str, "os.PathLike[str]"]

#: Boxes of a sample for each cell.
_SAMPLE_OF_A_CELL = 1000

#: Cells, where nobody says how many: each of them is a task for every part, and one for every range of pairs.
_CELLS_OF_A_PART = 4
_MOST_CELLS = 256
_BOXES_OF_A_CELL = 4_000_000


class _Piece(NamedTuple):
    """The boxes of a part, or of all, that go to one cell."""

    ids: npt.NDArray[np.uint64]
    boxes: Array
    values: Values


class _Plan(NamedTuple):
    """What it takes to say which cells a box goes to."""

    partition: Partition
    distance: float
    greatest: float
    """The greatest margin of any box."""


def _numbers(part: Array, place: Place) -> Array:
    with at(place):
        return _arguments.floats("boxes", _arguments.contiguous(part))


def _sample(part: Array, margin: Any, step: int, place: Place) -> tuple[Array, Array]:
    """Some boxes, and their margins; NaNs are for _divide."""
    rows = _numbers(part[::step], place)
    margins = np.broadcast_to(margin, len(part))[::step]
    whole = ~np.isnan(rows).any(axis=1)
    return rows[whole], margins[whole]


def _greatest(margin: Any) -> float:
    return float(np.max(margin, initial=-np.inf))


def _chosen(value: Any, rows: Array) -> Any:
    return value if _arguments.is_one(value) else value[rows]


def _divide(part: Array, own: list[Any], plan: _Plan, *, names: list[str], begin: int, place: Place) -> list[_Piece]:
    """The boxes of a part by cell, with their numbers."""
    values = dict(zip(names, own))
    boxes = _numbers(part, place)
    with at(place):
        homes = plan.partition.cells_of(
            boxes, distance=plan.distance, margin=values.get("margin"), max_margin=plan.greatest
        )
    order = np.argsort(homes[:, 1], kind="stable")
    bounds = np.searchsorted(homes[order, 1], np.arange(len(plan.partition) + 1))
    pieces = []
    for low, high in zip(bounds, bounds[1:]):
        rows = homes[order[low:high], 0]
        own = {name: _chosen(value, rows) for name, value in values.items()}
        pieces.append(_Piece((rows + begin).astype(np.uint64), boxes[rows], own))
    return pieces


def _joined(values: list[Any]) -> Any:
    return values[0] if _arguments.is_one(values[0]) else np.concatenate(values)


def _gathered(pieces: list[_Piece]) -> _Piece:
    values = {name: _joined([piece.values[name] for piece in pieces]) for name in pieces[0].values}
    return _Piece(
        np.concatenate([piece.ids for piece in pieces]), np.concatenate([piece.boxes for piece in pieces]), values
    )


def _arguments_of(sets: list[_Piece], settings: Values) -> Values:
    """What a search of a cell takes by name: what is given of one set, or a tuple for two."""
    each = {name: tuple(one.values.get(name) for one in sets) for name in _arguments.OF_EACH_BOX}
    return {**settings, **{name: own if len(own) == 2 else own[0] for name, own in each.items()}}


def _search(sets: list[list[_Piece]], *, cell: Array, settings: Values, ranges: tuple[Sequence[int], str]) -> list[Array]:
    """The pairs of a cell, of one set or of two, by the range that their first box is in."""
    gathered = [_gathered(pieces) for pieces in sets]
    given = _arguments_of(gathered, settings)
    first = gathered[0]
    if len(gathered) == 1:
        pairs = overlaps_in_cell(first.boxes, None, first.ids, cell, **given)
    else:
        second = gathered[1]
        pairs = overlaps_between_in_cell(first.boxes, second.boxes, (first.ids, second.ids), cell, **given)
    begins, dtype = ranges
    bounds = np.searchsorted(pairs[:, 0], np.asarray(begins[1:-1], dtype=np.uint64))
    return list(np.split(pairs.astype(dtype), bounds))


def _count(sets: list[list[_Piece]], *, cell: Array, settings: Values) -> int:
    gathered = [_gathered(pieces) for pieces in sets]
    given = _arguments_of(gathered, settings)
    if len(gathered) == 1:
        return count_in_cell(gathered[0].boxes, None, cell, **given)
    return count_between_in_cell(gathered[0].boxes, gathered[1].boxes, cell, **given)


def _merge(found: list[Array]) -> Array:
    """All pairs of a range, in order."""
    pairs = np.concatenate(found)
    ordered: Array = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    return ordered


def _write(pairs: Array, path: str, call: str) -> tuple[str, int]:
    """Writes a part beside its place, whoever else writes it too: the name has the call's id in it, and one of its own."""
    beside = f"{path}.{call}-{uuid4().hex}.part"
    try:
        with open(beside, "xb") as file:
            np.save(file, pairs)
    except BaseException as problem:
        with suppress(OSError):
            os.remove(beside)
        if isinstance(problem, OSError):
            raise file_error(path, f"cannot be written: {reason(problem)}", problem) from None
        raise
    return beside, len(pairs)


def _put(beside: str, path: str) -> None:
    try:
        os.replace(beside, path)
    except OSError as problem:
        raise file_error(path, f"cannot be written: {reason(problem)}", problem) from None


def _refuse_inputs(names: list[str], inputs: list[str]) -> None:
    """A result would take the place of what it was made from."""
    read = {(found.st_dev, found.st_ino) for found in map(os.stat, filter(os.path.exists, inputs))}
    for name in filter(os.path.exists, names):
        found = os.stat(name)
        if (found.st_dev, found.st_ino) in read:
            raise file_error(name, "is an input; the output needs another folder")


def _names_in(folder: Path, count: int, inputs: list[str]) -> list[str]:
    """The files of a result in a folder, which is made if it is not there."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise file_error(str(folder), f"cannot be made: {reason(problem)}", problem) from None
    names = [str(folder / f"part-{number:05d}.npy") for number in range(count)]
    for name in names:
        if os.path.isdir(name):
            raise file_error(name, "cannot be written: Is a directory", IsADirectoryError(errno.EISDIR, "Is a directory"))
    others = sorted({str(path) for path in folder.glob("part-*.npy")} - set(names))
    _refuse_inputs(names + others, inputs)
    if others:
        raise file_error(others[0], f"is of another result, with more parts than the {count} of this one: remove it")
    return names


def _picked(items: Any, index: int) -> Any:
    return items[index]


class _Tasks:
    """The tasks of one call, as one layer of a graph: to plan them one by one would copy the graph for each."""

    def __init__(self, called: str) -> None:
        self.name = f"allpairs-{called}-{uuid4().hex}"
        self._tasks: dict[Hashable, Any] = {}
        self._needs: list[Delayed] = []

    def add(self, key: tuple[Any, ...], function: Callable[..., Any], *arguments: Any) -> Hashable:
        """A task of this layer. An argument may be one too, or what `take` returns, or a list of these."""
        name = (self.name, *key)
        self._tasks[name] = (function, *arguments)
        return name

    def take(self, value: Any) -> Any:
        """What stands for a value in a task, which may be one that waits."""
        if not isinstance(value, Delayed):
            return value
        self._needs.append(value)
        return value.key

    def graph(self) -> HighLevelGraph:
        return HighLevelGraph.from_collections(self.name, self._tasks, dependencies=self._needs)

    def computed(self, results: list[Hashable]) -> list[Any]:
        """Computes some of its tasks."""
        self._tasks[self.name] = (list, results)
        return compute(Delayed(self.name, self.graph()))[0]


def _written(tasks: _Tasks, merged: list[Hashable], folder: Path, inputs: list[str]) -> int:
    """Computes the parts of a result into files of a folder, and returns the number of pairs. The files get their names
    when all are complete: a failure before leaves what was there."""
    names = _names_in(folder, len(merged), inputs)
    call = uuid4().hex
    try:
        writes = [
            tasks.add(("write", number), partial(_write, path=name, call=call), pairs)
            for number, (pairs, name) in enumerate(zip(merged, names))
        ]
        parts: list[tuple[str, int]] = tasks.computed(writes)
        for (beside, _), name in zip(parts, names):
            _put(beside, name)
    finally:
        with suppress(OSError):
            for left in list(folder.glob(f"part-*.npy.{call}-*.part")):  # by workers that were killed
                with suppress(OSError):
                    left.unlink()
    return sum(count for _, count in parts)


class _Cell(NamedTuple):
    """A cell, and the task for the boxes of each part of each set in it."""

    bounds: Array
    sets: list[list[Hashable]]


def _settings_of(values: Values) -> Values:
    """What is not about single boxes, checked."""
    settings: Values = {"distance": _arguments.number("distance", values["distance"]), "region": None}
    if values["region"] is not None:
        settings["region"] = _arguments.region_of(values["region"])
    count_in_memory(np.zeros((1, 6)), **settings)
    return settings


def _margins_of(sets: list[BoxParts]) -> list[list[Any]]:
    """For each set the margins of each part."""
    return [[values.get("margin", 0.0) for values in each.values] for each in sets]


def _partition_of(sets: list[BoxParts], cells: int, distance: float) -> Partition:
    """Cuts space into about so many cells, by a sample of the boxes, which is computed now."""
    step = max(1, sum(each.begins[-1] for each in sets) // (cells * _SAMPLE_OF_A_CELL))
    samples = compute(
        *[
            delayed(_sample)(part, own, step, place)
            for each, margins in zip(sets, _margins_of(sets))
            for part, own, place in zip(each.parts, margins, each.places)
        ]
    )
    rows, apart = (np.concatenate(column) for column in zip(*samples))
    return Partition(rows, cells=cells, distance=distance, margin=apart)


def _cells_wanted(sets: list[BoxParts], cells: Optional[int]) -> int:
    if cells is not None:
        return _arguments.whole("cells", cells, least=1)
    boxes = sum(each.begins[-1] for each in sets)
    most = max(_MOST_CELLS, boxes // _BOXES_OF_A_CELL)
    return min(_CELLS_OF_A_PART * sum(len(each.parts) for each in sets), most)


def _divided(tasks: _Tasks, each: BoxParts, number: int, plan: Hashable) -> list[Hashable]:
    """For each part of a set the task that divides its boxes among the cells."""
    return [
        tasks.add(
            ("divide", number, i),
            partial(_divide, names=list(values), begin=begin, place=place),
            tasks.take(part),
            [tasks.take(value) for value in values.values()],
            plan,
        )
        for i, (part, values, begin, place) in enumerate(zip(each.parts, each.values, each.begins, each.places))
    ]


def _cells_of(tasks: _Tasks, sets: list[BoxParts], distance: float, cells: Optional[int]) -> list[_Cell]:
    """The cells of space, by a sample that is computed now, and tasks for the boxes in each, which wait."""
    partition = _partition_of(sets, _cells_wanted(sets, cells), distance)
    margins = [own for margins in _margins_of(sets) for own in margins]
    greatest = [tasks.add(("greatest", number), _greatest, tasks.take(own)) for number, own in enumerate(margins)]
    plan = tasks.add(("plan",), partial(_Plan, partition, distance), tasks.add(("greatest",), max, greatest))
    divided = [_divided(tasks, each, number, plan) for number, each in enumerate(sets)]
    return [
        _Cell(
            bounds,
            [
                [tasks.add(("pick", number, i, cell), _picked, part, cell) for i, part in enumerate(parts)]
                for number, parts in enumerate(divided)
            ],
        )
        for cell, bounds in enumerate(partition.cells)
    ]


def _planned(tasks: _Tasks, values: Values) -> tuple[Values, list[BoxParts], list[_Cell]]:
    """The settings, the sets of boxes and the cells of a search, from the arguments of a function."""
    settings = _settings_of(values)
    sets = box_parts(values)
    return settings, sets, _cells_of(tasks, sets, settings["distance"], values["cells"])


def _merged(tasks: _Tasks, cells: list[_Cell], settings: Values, ranges: tuple[Sequence[int], str]) -> list[Hashable]:
    """For each range that the first boxes of pairs are in, the task for its pairs, of all cells."""
    found = [
        tasks.add(("search", number), partial(_search, cell=cell.bounds, settings=settings, ranges=ranges), cell.sets)
        for number, cell in enumerate(cells)
    ]
    return [
        tasks.add(
            (number, 0),  # as chunks of an array are named
            _merge,
            [tasks.add(("pairs", cell, number), _picked, pairs, number) for cell, pairs in enumerate(found)],
        )
        for number in range(len(ranges[0]) - 1)
    ]


def overlaps(
    boxes: Any,
    output: Optional[PathLike] = None,
    *,
    second: Any = None,
    distance: float = 0.0,
    margin: Any = None,
    region: Optional[npt.ArrayLike] = None,
    group: Any = None,
    category: Any = None,
    mask: Any = None,
    cells: Optional[int] = None,
) -> Any:
    """All pairs of boxes that overlap, each once, ordered by (first, second).

    The boxes are sampled at once; all else waits for ``compute()``, unless ``output`` is given.

    Parameters
    ----------
    boxes : dask array, shape (n, 6), or path, or iterable of paths
        A row is minx miny minz maxx maxy maxz. Or .npy files of such arrays, numbered on from file to file, that every
        worker can read.
    second : like boxes
        A second set: the pairs are those of a box of the first and a box of this, as in `allpairs.overlaps_between`. Both
        sets are numbered by themselves.
    output : path of a folder
        Write the pairs there, as part-00000.npy and so on, and return their number. Parts of a result with more parts
        must not be there, nor inputs of such names. The parts get their names when all are written: a failure before
        leaves those of an earlier result, beside which they take room until then. What workers that were killed had begun
        to write is removed at the end; where others still write after a failure, or this process itself is killed, files
        that end in .part may stay, which nothing reads.
    distance, region
        As in `allpairs.overlaps`.
    margin, group, category, mask : number, dask array or array_like of shape (n,), path, or list of paths
        Of each box, as in `allpairs.overlaps`. Files are .npy, of shape (n,), and several are one array; they need not
        be cut where those of the boxes are. With ``second`` a tuple of two, one for each set, or a number for all boxes.
    cells : int
        About how many tasks search; by default four for each chunk or file of all sets, but no more than 256, or than
        one for each four million boxes. Each takes a task more for each chunk of the boxes, and of the result.

    Returns
    -------
    dask array, shape (m, 2), uint32, or uint64 of more than 2**32 boxes in a set
        A chunk for each chunk of the boxes, of unknown size until it is computed. With ``output``: int.

    Examples
    --------
    >>> import dask.array
    >>> import allpairs.dask
    >>> boxes = dask.array.from_array([[0, 0, 0, 2, 2, 2], [1, 1, 1, 3, 3, 3], [9, 9, 9, 9, 9, 9.0]], chunks=(2, 6))
    >>> allpairs.dask.overlaps(boxes).compute()
    array([[0, 1]], dtype=uint32)
    >>> allpairs.dask.overlaps(boxes, margin=[0, 2, 4]).compute()
    array([[0, 1],
           [1, 2]], dtype=uint32)
    """
    values = locals()
    folder = None if output is None else Path(full_path("output", output))
    tasks = _Tasks("overlaps")
    settings, sets, planned = _planned(tasks, values)
    dtype = "uint32" if max(sum(each.sizes) for each in sets) <= 2**32 else "uint64"
    merged = _merged(tasks, planned, settings, (sets[0].begins, dtype))
    if folder is not None:
        return _written(tasks, merged, folder, [file for each in sets for file in each.files])
    return DaskArray(tasks.graph(), tasks.name, ((np.nan,) * len(merged), (2,)), dtype=dtype)


def count(
    boxes: Any,
    *,
    second: Any = None,
    distance: float = 0.0,
    margin: Any = None,
    region: Optional[npt.ArrayLike] = None,
    group: Any = None,
    category: Any = None,
    mask: Any = None,
    cells: Optional[int] = None,
) -> int:
    """The number of pairs of `overlaps`, computed at once; no task holds pairs.

    The parameters are those of `overlaps`, without ``output``.

    Examples
    --------
    >>> import dask.array
    >>> import allpairs.dask
    >>> allpairs.dask.count(dask.array.zeros((1000, 6), chunks=(300, 6)))  # all in one place
    499500
    """
    values = locals()
    tasks = _Tasks("count")
    settings, _, planned = _planned(tasks, values)
    counts: list[int] = tasks.computed(
        [
            tasks.add(("count", number), partial(_count, cell=cell.bounds, settings=settings), cell.sets)
            for number, cell in enumerate(planned)
        ]
    )
    return sum(counts)
