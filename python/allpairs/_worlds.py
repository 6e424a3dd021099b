# SPDX-License-Identifier: MIT
"""Pairs of many worlds in one call."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _arguments, _core, _settings
from ._arguments import BoxesLike, Order, Strategy
from ._errors import InvalidArgument, InvalidBox
from ._search import Pairs

#: Where each world's pairs, or boxes, begin: one more than there are worlds.
Offsets = npt.NDArray[np.int64]


class _Division(NamedTuple):
    """How boxes are divided among worlds."""

    begin: npt.NDArray[np.uint64]
    """Where each world begins, and the last one ends."""
    size: int | None
    """The number of boxes of each world, where they all have as many."""


def _equal_offsets(shape: tuple[int, ...]) -> npt.NDArray[np.uint64]:
    worlds, size = shape[0], shape[1]
    return np.arange(worlds + 1, dtype=np.uint64) * np.uint64(size)


def _given_offsets(value: npt.ArrayLike) -> npt.NDArray[np.uint64]:
    array = _arguments.array_of("offsets", value)
    if array.ndim != 1:
        raise InvalidArgument(f"offsets has shape {array.shape}; it takes (worlds + 1,)")
    return _arguments.uint64("offsets", array)


def _divided(
    lower: npt.ArrayLike, upper: npt.ArrayLike | None, offsets: npt.ArrayLike | None
) -> tuple[npt.NDArray[Any], npt.NDArray[Any] | None, _Division]:
    """Boxes as tables, and how they are divided among worlds."""
    low = _arguments.array_of("lower", lower)
    high = None if upper is None else _arguments.array_of("upper", upper)
    if offsets is not None:
        begin = _given_offsets(offsets)
        return low, high, _Division(begin, _equal_size(begin))
    columns = (6, 4) if high is None else (3, 2)
    for name, array in (("lower", low), ("upper", high)):
        if array is not None and (array.ndim != 3 or array.shape[2] not in columns):
            takes = " or ".join(f"(worlds, n, {count})" for count in columns)
            raise InvalidArgument(f"{name} has shape {array.shape}; without offsets it takes {takes}")
    if high is not None and low.shape != high.shape:
        raise InvalidArgument(f"lower has shape {low.shape} and upper {high.shape}")
    width = low.shape[2]
    tables = low.reshape(-1, width), None if high is None else high.reshape(-1, width)
    return *tables, _Division(_equal_offsets(low.shape), low.shape[1])


def _shared(value: BoxesLike, depth: Callable[[], float]) -> _arguments.BoxSet:
    """Boxes that are in every world."""
    corners = _arguments.two_corners(value, "shared: ")
    return _arguments.box_set(*corners, None, depth, "shared: ", single=True)


def _flat(name: str, array: npt.NDArray[Any], begin: npt.NDArray[np.uint64]) -> npt.NDArray[Any]:
    """Values of boxes one after the other, from such or, of worlds of equal size, from a row for each world."""
    if array.ndim == 2 and len(array) == len(begin) - 1 and (np.diff(begin) == array.shape[1]).all():
        return array.ravel()
    if array.ndim != 1:
        raise InvalidArgument(f"{name} has shape {array.shape}; it takes (boxes,), or (worlds, n) of worlds of n boxes each")
    return array


def _equal_size(begin: npt.NDArray[np.uint64]) -> int | None:
    """The number of boxes of each world, where they all have as many."""
    sizes = np.diff(begin)
    return int(sizes[0]) if len(sizes) and (sizes == sizes[0]).all() else None


def _labels(name: str, value: npt.ArrayLike, boxes: int, worlds: _Division) -> npt.NDArray[np.uint32]:
    """A filter's array: for each box of all worlds, or, if they are of equal size, of one."""
    if _arguments.is_one(value):
        return _arguments.labels(name, value, boxes)
    array = _flat(name, _arguments.array_of(name, value), worlds.begin)
    one = worlds.size
    return _arguments.labels(name, array, one if array.size == one else boxes)[:boxes]  # none, if there is no world


def _margins(value: npt.ArrayLike | None, boxes: int, worlds: _Division) -> npt.ArrayLike | None:
    """A margin for all boxes, or for each box of all worlds; those of one world, if they are of equal size, are repeated."""
    if value is None or _arguments.is_one(value):
        return value
    array = _arguments.floats("margin", _flat("margin", _arguments.array_of("margin", value), worlds.begin))
    count = len(worlds.begin) - 1
    if count == 0 and array.size == worlds.size:  # none of them are left
        corners = np.zeros((array.size, 3))
        _arguments.with_margins(_core.Boxes(corners, corners, ""), array)
    return np.tile(array, count) if array.size == worlds.size and array.size * count == boxes else array


def _in_world(problem: InvalidBox, size: int | None) -> InvalidBox:
    """The problem of a box where it stands in worlds of equal size: its index counts the boxes of all."""
    if not size:
        return problem
    box = f"box {problem.index}"
    world = f"{box} (box {problem.index % size} of world {problem.index // size})"
    return InvalidBox(str(problem).replace(box, world, 1), problem.index)


def _prepared(values: dict[str, Any]) -> tuple[_core.Worlds, _core.Boxes | None, _core.Options]:
    """The worlds, the boxes that they share, if any, and the settings of a search, from the arguments of a function."""
    low, high, worlds = _divided(values["lower"], values["upper"], values["offsets"])
    try:
        margin = _margins(values["margin"], low.shape[0] if low.ndim else 0, worlds)
        depth = lambda: _arguments.depth_of(values["distance"], [margin])
        boxes = _arguments.box_set(low, high, margin, depth, single=True)
    except InvalidBox as problem:
        raise (_in_world(problem, worlds.size) if values["offsets"] is None else problem) from None
    others = None if values["shared"] is None else _shared(values["shared"], depth)
    names = ("the boxes of the worlds", "the shared ones")
    options = _settings.options_of(values, boxes.axes if others is None else _settings.common_axes(boxes, others, names))
    size = len(boxes.boxes)
    _settings.set_filter(options, _core.Side.FIRST, values, lambda name, value: _labels(name, value, size, worlds))
    ignore = values["ignore"]
    if ignore is not None and len(worlds.begin) == 1 and worlds.size:  # of a world, but there is none
        ignore = _arguments.pairs_of_boxes("ignore", ignore, worlds.size, worlds.size if others is None else len(others.boxes))[:0]
    ignored = np.empty((0, 2), dtype=np.uint32)
    if others is not None:
        _settings.set_ignored(options, ignore, int(np.diff(worlds.begin).max(initial=0)), len(others.boxes))
    elif ignore is not None:
        ignored = _arguments.index_rows("ignore", ignore, 2)
    return _core.Worlds(boxes.boxes, worlds.begin, ignored), None if others is None else others.boxes, options


def overlaps_in_worlds(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None = None,
    offsets: npt.ArrayLike | None = None,
    *,
    shared: BoxesLike | None = None,
    distance: float = 0.0,
    margin: npt.ArrayLike | None = None,
    region: npt.ArrayLike | None = None,
    group: npt.ArrayLike | None = None,
    category: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | None = None,
    ignore: npt.ArrayLike | None = None,
    order: Order = "first",
    strategy: Strategy = "auto",
    threads: int = 1,
    max_pairs: int | None = None,
) -> tuple[Pairs, Offsets]:
    """The overlapping pairs of each of many worlds, such as the copies of a simulation, in one call.

    The rows of world k are what `overlaps` returns for its boxes alone, in the same order, with boxes numbered within
    the world.

    Parameters
    ----------
    lower, upper : array_like, shape (worlds, n, 3), or (boxes, 3) with offsets
        The corners of the boxes. Or ``lower`` alone, of shape (worlds, n, 6) or (boxes, 6). As in `overlaps`; in the plane
        with 2 and 4 instead of 3 and 6.
    offsets : array_like, shape (worlds + 1,), integers
        World k has the boxes ``offsets[k]`` to ``offsets[k + 1] - 1``. Not needed where worlds are of equal size.
    shared : array_like, shape (m, 6), or tuple of two array_like of shape (m, 3)
        Boxes that are in every world, such as the ground. The pairs are then those of a box of the world and one of
        these, as `overlaps_between` returns them.
    margin : float or array_like
    group, category, mask : int or array_like of integers 0 to 2**32 - 1
        As in `overlaps`: one for each box of all worlds, or, if worlds are of equal size, of one world for all. Shared
        boxes have no margin and no group, and every category and mask.
    ignore : array_like, shape (k, 2), integers
        Pairs to exclude in every world, numbered within a world; with ``shared``, pairs of a box, of the largest
        world, and a shared one.

    The other parameters, and what is raised, are those of `overlaps`; ``max_pairs`` is for all worlds together.

    Returns
    -------
    pairs : ndarray, shape (m, 2), uint32
    offsets : ndarray, shape (worlds + 1,), int64
        World k has the rows ``pairs[offsets[k]:offsets[k + 1]]``.

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> row = np.array([[0, 0, 0, 2, 2, 2], [1, 1, 1, 3, 3, 3], [9, 9, 9, 9, 9, 9]], dtype=np.float32)
    >>> pairs, offsets = allpairs.overlaps_in_worlds(np.stack([row, row * 0, row]))
    >>> pairs.tolist()
    [[0, 1], [0, 1], [0, 2], [1, 2], [0, 1]]
    >>> offsets
    array([0, 1, 4, 5])
    >>> pairs, offsets = allpairs.overlaps_in_worlds(row, offsets=[0, 1, 3], shared=[[0, 0, 0, 9, 9, 1]])
    >>> pairs.tolist(), offsets.tolist()
    ([[0, 0], [0, 0]], [0, 1, 2])
    """
    worlds, others, options = _prepared(locals())
    pairs, places = _core.overlaps_in_worlds(worlds, others, options)
    return np.asarray(pairs), np.asarray(places).view(np.int64)


def count_in_worlds(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None = None,
    offsets: npt.ArrayLike | None = None,
    *,
    shared: BoxesLike | None = None,
    distance: float = 0.0,
    margin: npt.ArrayLike | None = None,
    region: npt.ArrayLike | None = None,
    group: npt.ArrayLike | None = None,
    category: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | None = None,
    ignore: npt.ArrayLike | None = None,
    strategy: Strategy = "auto",
    threads: int = 1,
    max_pairs: int | None = None,
) -> npt.NDArray[np.int64]:
    """The number of pairs of each world; uses memory independent of the pairs.

    The parameters, and what is raised, are those of `overlaps_in_worlds`, without ``order``.

    Returns
    -------
    ndarray, shape (worlds,), int64

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> row = np.array([[0, 0, 0, 2, 2, 2], [1, 1, 1, 3, 3, 3], [9, 9, 9, 9, 9, 9]], dtype=np.float32)
    >>> allpairs.count_in_worlds(np.stack([row, row * 0, row]))
    array([1, 3, 1])
    """
    places = _core.count_in_worlds(*_prepared(locals()))
    return np.diff(np.asarray(places).view(np.int64))
