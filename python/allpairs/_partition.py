# SPDX-License-Identifier: MIT
"""Boxes beyond memory: joins of files, and cells for drivers of your own."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from . import _arguments, _core
from ._errors import InvalidArgument, InvalidBox
from ._settings import IN_SPACE, Both, one_set, two_sets

if TYPE_CHECKING:  # not every build has it
    from . import _files

Path = Union[str, "os.PathLike[str]"]

#: Pairs by 64-bit ids: shape (m, 2).
IdPairs = npt.NDArray[np.uint64]

#: What a search of a cell has in place of arguments: boxes have three axes, and one may be a row of numbers.
_IN_CELL: dict[str, Any] = {**IN_SPACE, "single": True}


class JoinSummary(NamedTuple):
    """What a join of files did."""

    pairs: int
    boxes: int
    """Of both sets, where there are two."""
    cells: int
    """The parts of space that were searched one by one."""
    copies: int
    """Boxes that went to more than one cell, counted once for each cell but one."""
    wide_boxes: int
    """Boxes in so many cells that they were kept apart."""
    box_bytes: int
    """Written to the work folder, and read again."""
    pair_bytes: int
    resumed_cells: int
    """Cells whose pairs were found before, by a join that was resumed."""
    second_boxes: int
    """How many of the boxes are those of the second set."""
    empty_boxes: int
    """Boxes with a minimum above its maximum, both finite, as after a mistake: they are in no pair."""


def _names_of(argument: str, paths: Path | Iterable[Path]) -> list[str]:
    names = _arguments.paths_of(argument, paths)
    if not names:
        raise InvalidArgument(f"{argument} names no file")
    return names


def _value_files(values: dict[str, Any], sets: int) -> list[_files.BoxValueFiles]:
    """The files that arguments name of each set; with two sets an argument is a tuple of two."""
    from . import _reading

    files = [_reading.BoxValueFiles() for _ in range(sets)]
    for name in _arguments.OF_EACH_BOX:
        given = values[name]
        if given is None:
            continue
        each = [given] if sets == 1 else _arguments.two_of(name, given, "a tuple of two here: files of each set, or None")
        for own, paths in zip(files, each):
            setattr(own, name, [] if paths is None else _names_of(name, paths))
    return files


def _output_of(output: Path | None) -> str | None:
    """The file that a join writes, if it is to write one."""
    if output is None:
        return None
    target = _arguments.path_of("output", output)
    if os.path.splitext(target)[1].lower() not in ("", ".npy"):
        raise InvalidArgument(f"output is {target!r}; a join writes .npy files")
    return target


def _join_options(values: dict[str, Any]) -> _files.JoinOptions:
    """The settings of a join, from the arguments of `join` by their names."""
    from . import _reading

    options = _reading.JoinOptions()
    options.distance = _arguments.number("distance", values["distance"])
    options.memory = _arguments.whole("memory", values["memory"])
    options.resume = _arguments.flag("resume", values["resume"])
    second = values["second"]
    options.second = [] if second is None else _names_of("second", second)
    options.values, *others = _value_files(values, 1 if second is None else 2)
    if others:
        options.second_values = others[0]
    if values["region"] is not None:
        options.set_region(_arguments.region_of(values["region"]))
    return options


def join(
    inputs: Path | Iterable[Path],
    output: Path | None = None,
    *,
    second: Path | Iterable[Path] | None = None,
    distance: float = 0.0,
    margin: Any = None,
    region: npt.ArrayLike | None = None,
    group: Any = None,
    category: Any = None,
    mask: Any = None,
    memory: int = 0,
    work: Path | None = None,
    threads: int = 1,
    resume: bool = False,
) -> JoinSummary:
    """Finds the overlapping pairs of boxes in files that need not fit in memory, by way of files on disk.

    Parameters
    ----------
    inputs : path, or iterable of paths
        .npy files of shape (n, 6), float32 or float64, as one set: numbered on from file to file.
    output : path
        A .npy file of shape (m, 2), uint32, or uint64 of more than 2**32 boxes in a set, ordered by (first, second):
        what `overlaps` returns where that fits in memory. A name that ends in something other than .npy is refused.
        Without it the pairs are only counted.
    second : path, or iterable of paths
        Files of a second set. The pairs are those of a box of the inputs and a box of these, what `overlaps_between`
        returns where that fits in memory; both sets are numbered by themselves.
    distance, region
        As in `overlaps`.
    margin, group, category, mask : path, or iterable of paths
        .npy files of shape (n,): a number for each box, as in `overlaps`; several are one array. With ``second`` a tuple of
        two: files of each set, or None.
    memory : int
        The bytes that the process may have, at least 64 MiB; 0 means half of the machine's. 24 MiB of them are for the
        interpreter and what else the process has loaded, and what that is more comes on top: NumPy and this package are
        40 MiB, so that with 64 MiB the process has up to 80.
    work : path
        The folder of the join's own files; by default the name of the output, or of the first input, and ".work". It
        takes 32 bytes for each box and copy (56 in float64) and 8 for each pair, 8 more for each box with margins and 8
        for each two of groups, categories and masks. It stays after a failure, and after a kill the part of the output
        that was written beside it too; the join that is resumed removes that.
    resume : bool
        Go on with what is complete in that folder.

    Raises
    ------
    FileError
        If an input is none, or has a NaN, or a disk is full: with the file. It is a ValueError and an OSError.
    ImportError
        Of a build without readers of files.

    Examples
    --------
    >>> import tempfile
    >>> import numpy as np
    >>> import allpairs
    >>> folder = tempfile.mkdtemp()
    >>> np.save(folder + "/boxes.npy", np.array([[0, 0, 0, 2, 2, 2], [1, 1, 1, 3, 3, 3], [9, 9, 9, 9, 9, 9]], np.float32))
    >>> allpairs.join(folder + "/boxes.npy", folder + "/pairs.npy").pairs
    1
    >>> np.load(folder + "/pairs.npy")
    array([[0, 1]], dtype=uint32)
    >>> np.save(folder + "/margins.npy", np.array([0.0, 6.0, 0.0]))
    >>> allpairs.join(folder + "/boxes.npy", margin=folder + "/margins.npy").pairs
    2
    """
    values = locals()
    from . import _reading

    names = _names_of("inputs", inputs)
    target = _output_of(output)
    options = _join_options(values)
    folder = _arguments.path_of("work", work) if work is not None else (target or names[0]) + ".work"
    if not folder:
        raise InvalidArgument("work is empty; it takes the path of a folder")
    options.work = folder
    return JoinSummary(*_reading.join_files(names, target, options, _arguments.threads_of(threads)))


def _exact(ids: npt.ArrayLike) -> npt.ArrayLike:
    """Ids of which NumPy makes no floats, as it does of large integers in a list."""
    if not isinstance(ids, (list, tuple)):
        return ids
    return np.array([_arguments.whole("ids", number) for number in ids], dtype=np.uint64)


def _ids_of(value: npt.ArrayLike, length: int, prefix: str = "") -> npt.NDArray[np.uint64]:
    array = _arguments.array_of("ids", _exact(value))
    if array.shape != (length,):
        raise InvalidArgument(f"{prefix}ids has shape {array.shape}; for {length} boxes it takes ({length},)")
    return _arguments.uint64(f"{prefix}ids", array)


def _by_id(values: dict[str, Any]) -> dict[str, Any]:
    """The boxes in the order of their ids, in which the margins of two are added up; all as it is where that is the same."""
    if values["margin"] is None or _arguments.is_one(values["margin"]):
        return values
    ids = _arguments.array_of("ids", _exact(values["ids"]))
    if ids.ndim != 1 or ids.dtype.kind not in "iu" or (ids[1:] >= ids[:-1]).all() or (ids < 0).any():
        return values
    order = np.argsort(ids, kind="stable")
    given = {name: values[name] for name in ("lower", "upper", *_arguments.OF_EACH_BOX)} | {"ids": ids}
    arrays = {
        name: _arguments.array_of(name, value)
        for name, value in given.items()
        if value is not None and not _arguments.is_one(value)
    }
    if any(array.ndim == 0 or len(array) != len(order) for array in arrays.values()):
        return values  # which is an error, and said as one
    return {**values, **{name: array[order] for name, array in arrays.items()}}


def overlaps_in_cell(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None,
    ids: npt.ArrayLike,
    cell: npt.ArrayLike,
    *,
    distance: float = 0.0,
    margin: npt.ArrayLike | None = None,
    region: npt.ArrayLike | None = None,
    group: npt.ArrayLike | None = None,
    category: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | None = None,
    threads: int = 1,
) -> IdPairs:
    """The overlapping pairs of boxes that belong to one cell of space, by the boxes' 64-bit ids.

    A pair belongs to the cell that holds the greater of its two minima, axis by axis. Cells that tile space, each
    searched with the boxes that `Partition.cells_of` says, have every pair exactly once: on one machine or many.

    Parameters
    ----------
    lower, upper : array_like, shape (n, 3)
        As in `overlaps`; or ``lower`` of shape (n, 6) and ``upper`` None.
    ids : array_like, shape (n,), integers 0 to 2**64 - 1
    cell : array_like, shape (2, 3) or (6,)
        Its least corner, which is in it, and its greatest, which is not, unless it is infinity: one of
        `Partition.cells`.
    distance, margin, region, group, category, mask
        As in `overlaps`; those of the boxes that are given.

    Returns
    -------
    ndarray, shape (m, 2), uint64
        first < second, ordered by (first, second).

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> boxes = np.array([[0, 0, 0, 2, 2, 2], [1, 1, 1, 3, 3, 3], [2, 2, 2, 4, 4, 4]], dtype=np.float32)
    >>> space = np.array([[-np.inf] * 3, [np.inf] * 3])
    >>> allpairs.overlaps_in_cell(boxes, None, [70, 50, 60], space)
    array([[50, 60],
           [50, 70],
           [60, 70]], dtype=uint64)
    >>> allpairs.overlaps_in_cell(boxes, None, [70, 50, 60], space, group=[7, 7, 0])
    array([[50, 60],
           [60, 70]], dtype=uint64)
    """
    given = {**_IN_CELL, **locals()}
    values = _by_id(given)
    try:
        boxes, options = one_set(values)
    except InvalidBox:
        one_set(given)  # raises it with the index that the box was given at
        raise
    return np.asarray(_core.overlaps_in_cell(boxes, _ids_of(values["ids"], len(boxes)), _arguments.cell_of(cell), options))


def overlaps_between_in_cell(
    first: Any,
    second: Any,
    ids: tuple[npt.ArrayLike, npt.ArrayLike],
    cell: npt.ArrayLike,
    *,
    distance: float = 0.0,
    margin: Both = None,
    region: npt.ArrayLike | None = None,
    group: Both = None,
    category: Both = None,
    mask: Both = None,
    threads: int = 1,
) -> IdPairs:
    """The pairs of a box of the first set and a box of the second that belong to one cell of space, by their ids.

    Parameters
    ----------
    first, second
        As in `overlaps_between`.
    ids : tuple of two array_like
        Those of the boxes of the first set, and those of the second: each as in `overlaps_in_cell`.
    cell
        As in `overlaps_in_cell`.
    distance, margin, region, group, category, mask
        As in `overlaps_between`; those of the boxes that are given.

    Returns
    -------
    ndarray, shape (m, 2), uint64
        Ordered by (first, second).

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> first = np.array([[0, 0, 0, 2, 2, 2], [8, 8, 8, 9, 9, 9]], dtype=np.float32)
    >>> second = np.array([[1, 1, 1, 3, 3, 3]], dtype=np.float32)
    >>> space = np.array([[-np.inf] * 3, [np.inf] * 3])
    >>> allpairs.overlaps_between_in_cell(first, second, ([70, 50], [60]), space)
    array([[70, 60]], dtype=uint64)
    """
    of_first, of_second = _arguments.two_of("ids", ids, "a tuple of two here: those of each set")
    a, b, options = two_sets({**_IN_CELL, **locals()})
    first_ids, second_ids = _ids_of(of_first, len(a), "first set: "), _ids_of(of_second, len(b), "second set: ")
    return np.asarray(_core.overlaps_between_in_cell((a, first_ids), (b, second_ids), _arguments.cell_of(cell), options))


def count_in_cell(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None,
    cell: npt.ArrayLike,
    *,
    distance: float = 0.0,
    margin: npt.ArrayLike | None = None,
    region: npt.ArrayLike | None = None,
    group: npt.ArrayLike | None = None,
    category: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | None = None,
    threads: int = 1,
) -> int:
    """The number of pairs of `overlaps_in_cell`; uses memory independent of that number.

    The parameters are those of `overlaps_in_cell`, without ``ids``. Boxes whose margins differ are in the order of their ids.

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> boxes = np.array([[0, 0, 0, 2, 2, 2], [1, 1, 1, 3, 3, 3], [2, 2, 2, 4, 4, 4]], dtype=np.float32)
    >>> allpairs.count_in_cell(boxes, None, [[1.5] * 3, [np.inf] * 3])
    2
    """
    boxes, options = one_set({**_IN_CELL, **locals()})
    return _core.count_in_cell(boxes, _arguments.cell_of(cell), options)


def count_between_in_cell(
    first: Any,
    second: Any,
    cell: npt.ArrayLike,
    *,
    distance: float = 0.0,
    margin: Both = None,
    region: npt.ArrayLike | None = None,
    group: Both = None,
    category: Both = None,
    mask: Both = None,
    threads: int = 1,
) -> int:
    """The number of pairs of `overlaps_between_in_cell`; uses memory independent of that number.

    The parameters are those of `overlaps_between_in_cell`, without ``ids``.

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> allpairs.count_between_in_cell(np.zeros((3, 6)), np.zeros((2, 6)), [[-np.inf] * 3, [np.inf] * 3])
    6
    """
    a, b, options = two_sets({**_IN_CELL, **locals()})
    return _core.count_between_in_cell(a, b, _arguments.cell_of(cell), options)


class Partition:
    """Cells that tile space, about equally full, made from a sample of the boxes.

    Parameters
    ----------
    lower, upper : array_like
        A sample of the boxes, as in `overlaps`: some hundred for each cell suffice.
    cells : int
        About how many cells. What no cut divides stays one cell.
    distance, margin
        As in `overlaps`.

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> lower = np.random.default_rng(1).random((1000, 3), dtype=np.float32)
    >>> upper = lower + np.float32(0.1)
    >>> partition = allpairs.Partition(lower, upper, cells=4)
    >>> len(partition)
    4
    >>> found = []
    >>> for number, cell in enumerate(partition.cells):
    ...     here = [box for box, where in partition.cells_of(lower, upper) if where == number]
    ...     found.append(allpairs.overlaps_in_cell(lower[here], upper[here], here, cell))
    >>> sum(map(len, found)) == allpairs.count(lower, upper)
    True
    """

    def __init__(
        self,
        lower: npt.ArrayLike,
        upper: npt.ArrayLike | None = None,
        *,
        cells: int,
        distance: float = 0.0,
        margin: npt.ArrayLike | None = None,
    ) -> None:
        sample = _arguments.with_margins(_arguments.boxes_of(lower, upper), margin)
        count = _arguments.whole("cells", cells, least=1)
        self._cells = _core.Partition(sample, count, _arguments.number("distance", distance))

    def __len__(self) -> int:
        return len(self._cells)

    @property
    def cells(self) -> npt.NDArray[np.float64]:
        """The least and the greatest corner of each cell: shape (cells, 2, 3)."""
        return np.asarray(self._cells.cells()).reshape(-1, 2, 3)

    def cells_of(
        self,
        lower: npt.ArrayLike,
        upper: npt.ArrayLike | None = None,
        *,
        distance: float = 0.0,
        margin: npt.ArrayLike | None = None,
        max_margin: float = 0.0,
    ) -> npt.NDArray[np.int64]:
        """Which cells each box goes to: rows of a box, by index, and a cell; shape (k, 2).

        ``max_margin`` is the greatest margin of any box elsewhere that these may be paired with; their own count by
        themselves.
        """
        boxes = _arguments.with_margins(_arguments.boxes_of(lower, upper), margin)
        apart, greatest = _arguments.number("distance", distance), _arguments.number("max_margin", max_margin)
        for name, value in (("distance", apart), ("max_margin", greatest)):
            if np.isnan(value) or (name == "distance" and value == -np.inf):
                raise InvalidArgument(f"{name} is {value}")
        rows = np.asarray(self._cells.cells_of(boxes, apart, greatest)).reshape(-1, 2)
        return rows.view(np.int64)

    def __reduce__(self) -> tuple[Any, ...]:
        return _from_cuts, (np.asarray(self._cells.cuts()).reshape(-1, 4).tolist(),)


def _from_cuts(cuts: list[list[float]]) -> Partition:
    partition = Partition.__new__(Partition)
    partition._cells = _core.Partition.from_cuts(cuts)
    return partition
