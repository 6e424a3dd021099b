# SPDX-License-Identifier: MIT
"""Overlapping pairs of boxes in Dask arrays and in files, computed by Dask's workers.

Space is cut into cells; each task is one call in one process, and tasks that run again return the same bytes. Needs
Dask (Debian: python3-dask, and python3-distributed for several processes).
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt
from dask.array.core import Array as DaskArray
from dask.array.core import concatenate, from_delayed
from dask.base import compute
from dask.delayed import delayed

from . import _arguments
from ._errors import InvalidArgument, InvalidBox
from ._partition import Partition, overlaps_between_in_cell, overlaps_in_cell

__all__ = ["overlaps"]

PathLike = Union[str, "os.PathLike[str]"]
Array = npt.NDArray[Any]

#: Boxes of a sample for each cell.
_SAMPLE_OF_A_CELL = 1000


def _read(path: str) -> Array:
    boxes: Array = np.load(path, mmap_mode="r", allow_pickle=False)
    return boxes


def _parts_of(argument: str, boxes: Any) -> tuple[list[Any], list[int]]:
    """The boxes as parts that tasks read, and the number of boxes in each."""
    if isinstance(boxes, DaskArray):
        if boxes.ndim != 2 or boxes.shape[1] != 6:
            raise InvalidArgument(f"{argument} has shape {boxes.shape}; it takes (n, 6)")
        if np.isnan(boxes.shape[0]):
            raise InvalidArgument(f"{argument} has chunks of unknown sizes; call compute_chunk_sizes() before")
        rows = boxes.rechunk({1: 6})
        return list(rows.to_delayed().ravel()), [int(size) for size in rows.chunks[0]]
    paths = [boxes] if isinstance(boxes, (str, os.PathLike)) else list(boxes)
    names = [os.path.abspath(os.fsdecode(path)) for path in paths]
    if not names:
        raise InvalidArgument(f"{argument} names no file")
    shapes = [_read(name).shape for name in names]
    for name, shape in zip(names, shapes):
        if len(shape) != 2 or shape[1] != 6:
            raise InvalidArgument(f"{name} has shape {shape}; boxes are (n, 6)")
    return [delayed(_read)(name) for name in names], [shape[0] for shape in shapes]


def _sample(part: Array, step: int) -> Array:
    return np.asarray(part[::step])


def _divide(
    part: Array, begin: int, partition: Partition, distance: float, whose: str
) -> list[tuple[npt.NDArray[np.uint64], Array]]:
    """The boxes of a part by cell, with their numbers."""
    boxes = _arguments.floats("boxes", _arguments.contiguous(part))
    try:
        homes = partition.cells_of(boxes, distance=distance)
    except InvalidBox as problem:
        raise InvalidArgument(f"box {begin + problem.index} of {whose}: {problem}") from None
    order = np.argsort(homes[:, 1], kind="stable")
    bounds = np.searchsorted(homes[order, 1], np.arange(len(partition) + 1))
    rows = homes[order, 0]
    return [
        ((rows[low:high] + begin).astype(np.uint64), boxes[rows[low:high]]) for low, high in zip(bounds, bounds[1:])
    ]


def _gathered(divided: list[tuple[Array, Array]]) -> tuple[Array, Array]:
    return np.concatenate([ids for ids, _ in divided]), np.concatenate([boxes for _, boxes in divided])


def _search(
    sets: list[list[tuple[Array, Array]]], cell: Array, distance: float, begins: Sequence[int], dtype: str
) -> list[Array]:
    """The pairs of a cell, of one set or of two, by the range that their first box is in."""
    ids, boxes = _gathered(sets[0])
    if len(sets) == 1:
        pairs = overlaps_in_cell(boxes, None, ids, cell, distance=distance)
    else:
        other_ids, others = _gathered(sets[1])
        pairs = overlaps_between_in_cell(boxes, others, (ids, other_ids), cell, distance=distance)
    bounds = np.searchsorted(pairs[:, 0], np.asarray(begins[1:-1], dtype=np.uint64))
    return list(np.split(pairs.astype(dtype), bounds))


def _merge(found: list[Array]) -> Array:
    """All pairs of a range, in order."""
    pairs = np.concatenate(found)
    ordered: Array = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    return ordered


def _write(pairs: Array, path: str) -> int:
    """The file appears when it is complete, whoever else writes it too."""
    with tempfile.NamedTemporaryFile(dir=os.path.dirname(path), suffix=".part", delete=False) as file:
        np.save(file, pairs)
    os.replace(file.name, path)
    return len(pairs)


def _picked(items: Any, index: int) -> Any:
    return items[index]


class _Set(NamedTuple):
    """A set of boxes as parts that tasks read."""

    parts: list[Any]
    sizes: list[int]
    whose: str
    """What errors call it."""

    @property
    def begins(self) -> list[int]:
        """The number of the first box of each part, and that of all boxes."""
        return [0, *np.cumsum(self.sizes).tolist()]


def _pairs_by_range(sets: list[_Set], distance: float, cells: int, dtype: str) -> list[Any]:
    """A task for the pairs of each range of first boxes: those of one part."""
    step = max(1, sum(boxes.begins[-1] for boxes in sets) // (cells * _SAMPLE_OF_A_CELL))
    samples = compute(*[delayed(_sample)(part, step) for boxes in sets for part in boxes.parts])
    sample = np.concatenate(samples)
    partition = Partition(sample[~np.isnan(sample).any(axis=1)], cells=cells, distance=distance)  # NaNs are for _divide
    pick = delayed(_picked)
    shared = delayed(partition)
    divided = [
        [
            delayed(_divide)(part, begin, shared, distance, boxes.whose)
            for part, begin in zip(boxes.parts, boxes.begins)
        ]
        for boxes in sets
    ]
    begins = sets[0].begins
    found = [
        delayed(_search)([[pick(part, number) for part in parts] for parts in divided], cell, distance, begins, dtype)
        for number, cell in enumerate(partition.cells)
    ]
    return [delayed(_merge)([pick(pairs, number) for pairs in found]) for number in range(len(sets[0].parts))]


def overlaps(
    boxes: Any,
    output: Optional[PathLike] = None,
    *,
    second: Any = None,
    distance: float = 0.0,
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
        Write the pairs there, as part-00000.npy and so on, and return their number.
    distance : float
        As in `allpairs.overlaps`.
    cells : int
        About how many tasks search; by default four for each chunk or file of all sets.

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
    """
    apart = _arguments.number("distance", distance)
    sets = [_Set(*_parts_of("boxes", boxes), "all" if second is None else "the first set")]
    if second is not None:
        sets.append(_Set(*_parts_of("second", second), "the second set"))
    parts = sum(len(each.parts) for each in sets)
    count = _arguments.whole("cells", 4 * parts if cells is None else cells, least=1)
    dtype = "uint32" if max(sum(each.sizes) for each in sets) <= 2**32 else "uint64"
    merged = _pairs_by_range(sets, apart, count, dtype)
    if output is not None:
        folder = Path(os.path.abspath(os.fsdecode(output)))
        folder.mkdir(parents=True, exist_ok=True)
        names = [str(folder / f"part-{number:05d}.npy") for number in range(len(merged))]
        counts: Iterable[int] = compute(*[delayed(_write)(pairs, name) for pairs, name in zip(merged, names)])
        return sum(counts)
    chunks = [from_delayed(pairs, (np.nan, 2), dtype=dtype) for pairs in merged]
    return concatenate(chunks, allow_unknown_chunksizes=True)
