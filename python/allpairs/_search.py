# SPDX-License-Identifier: MIT
"""Searches over arrays of boxes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from . import _arguments, _core
from ._arguments import BoxesLike, Order, Strategy
from ._settings import Both, one_set, two_sets

#: Pairs by index: shape (m, 2).
Pairs = npt.NDArray[np.uint32]


def overlaps(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None = None,
    *,
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
) -> Pairs:
    """All pairs of boxes that overlap, each once.

    Boxes are closed: sharing a face, an edge or a corner is an overlap. The answer is exactly that of testing all
    pairs one by one, whatever the strategy and the number of threads. A box with ``lower > upper`` on some axis is
    empty and overlaps nothing; infinite bounds are allowed.

    Parameters
    ----------
    lower, upper : array_like, shape (n, 3), float32 or float64
        The corners of n boxes. Or ``lower`` alone, of shape (n, 6): a row is minx miny minz maxx maxy maxz. Any
        strides are allowed. Arrays are copied only if one is float32 and the other float64, or for other types. Anything
        with ``__array__``, ``__dlpack__`` or the buffer protocol in the processor's memory counts as an array.
        Integers are converted to float64; those beyond 2**53 are refused. Boxes in the plane have shape (n, 2), or alone (n, 4).
    distance : float
        Boxes that are at most this far apart on every axis are a pair. A negative distance requires that much overlap.
    margin : float or array_like, shape (n,)
        How far each box extends beyond its bounds: a pair's margins are added to the distance.
    region : array_like, shape (2, 3) or (6,); (2, 2) or (4,) in the plane
        Boxes farther from this box than distance plus margin are excluded.
    group : int or array_like, shape (n,), integers 0 to 2**32 - 1
        Boxes of the same group are never paired, unless it is 0.
    category, mask : int or array_like, shape (n,), integers 0 to 2**32 - 1
        Bits: a pair is kept if each box's mask shares a bit with the other's category. By default all bits are set.
    ignore : array_like, shape (k, 2), integers
        Pairs to exclude, in either orientation. A pair that names a box that is not there raises InvalidArgument.
    order : {"first", "second", "unordered"}
        Ascending by (first, second); by (second, first); or in the order of discovery, which is faster and also
        deterministic.
    strategy : {"auto", "exhaustive", "bvh"}
        How pairs are found. It never changes the result.
    threads : int
        The maximum number of threads; 0 means one per hardware thread. It never changes the result.
    max_pairs : int, optional
        More pairs than this raise LimitExceeded.

    Returns
    -------
    ndarray, shape (m, 2), uint32
        The indices of each pair, ``first < second``.

    Raises
    ------
    InvalidBox
        A NaN, or a number that does not fit; ``error.index`` is the index of the box.
    InvalidArgument
        An array of a wrong shape or type, or an invalid setting. Both are ValueErrors.

    Notes
    -----
    The search releases the GIL; other threads must not change the arrays during it.

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> lower = np.array([[0, 0, 0], [1, 1, 1], [3, 3, 3], [9, 9, 9]], dtype=np.float32)
    >>> upper = lower + 2
    >>> allpairs.overlaps(lower, upper)
    array([[0, 1],
           [1, 2]], dtype=uint32)
    >>> allpairs.overlaps(np.hstack([lower, upper]), distance=4)
    array([[0, 1],
           [0, 2],
           [1, 2],
           [2, 3]], dtype=uint32)
    >>> allpairs.overlaps(lower, upper, ignore=[[1, 0]])
    array([[1, 2]], dtype=uint32)
    """
    boxes, options = one_set(locals())
    return np.asarray(_core.overlaps(boxes, options))


def overlaps_between(
    first: BoxesLike,
    second: BoxesLike,
    *,
    distance: float = 0.0,
    margin: Both = None,
    region: npt.ArrayLike | None = None,
    group: Both = None,
    category: Both = None,
    mask: Both = None,
    ignore: npt.ArrayLike | None = None,
    order: Order = "first",
    strategy: Strategy = "auto",
    threads: int = 1,
    max_pairs: int | None = None,
) -> Pairs:
    """All pairs of a box of one set and a box of another that overlap.

    Parameters
    ----------
    first, second : array_like, shape (n, 6), or tuple of two array_like of shape (n, 3)
        Each set as one array, or as ``(lower, upper)``; float32 or float64, also one of each. In the plane 4 and 2 columns.
    margin, group, category, mask : number or tuple of two, optional
        As in `overlaps`, for the first set and for the second; None means the default. A number is for all boxes of both.
    ignore : array_like, shape (k, 2), integers
        Pairs (first, second) to exclude.

    The other parameters, and what is raised, are those of `overlaps`.

    Returns
    -------
    ndarray, shape (m, 2), uint32
        In each row an index into the first set and one into the second.

    Examples
    --------
    >>> import allpairs
    >>> parts = [[0, 0, 0, 1, 1, 1], [5, 0, 0, 6, 1, 1]]
    >>> shelves = ([[-1, -1, -1]], [[5, 5, 0]])
    >>> allpairs.overlaps_between(parts, shelves)
    array([[0, 0],
           [1, 0]], dtype=uint32)
    >>> allpairs.overlaps_between(parts, shelves, group=([7, 0], [7]))
    array([[1, 0]], dtype=uint32)
    """
    a, b, options = two_sets(locals())
    return np.asarray(_core.overlaps_between(a, b, options))


def count(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None = None,
    *,
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
) -> int:
    """The number of pairs of `overlaps`; uses memory independent of that number.

    The parameters are those of `overlaps`, without ``order``. More pairs than ``max_pairs`` raise LimitExceeded as soon as
    they are found.

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> corners = np.arange(12.0).reshape(4, 3)
    >>> allpairs.count(corners, corners + 3)
    3
    """
    boxes, options = one_set(locals())
    return _core.count(boxes, options)


def count_between(
    first: BoxesLike,
    second: BoxesLike,
    *,
    distance: float = 0.0,
    margin: Both = None,
    region: npt.ArrayLike | None = None,
    group: Both = None,
    category: Both = None,
    mask: Both = None,
    ignore: npt.ArrayLike | None = None,
    strategy: Strategy = "auto",
    threads: int = 1,
    max_pairs: int | None = None,
) -> int:
    """The number of pairs of `overlaps_between`; uses memory independent of that number.

    The parameters are those of `overlaps_between`, without ``order``. More pairs than ``max_pairs`` raise LimitExceeded as
    soon as they are found.

    Examples
    --------
    >>> import allpairs
    >>> allpairs.count_between([[0, 0, 0, 1, 1, 1]], [[1, 1, 1, 2, 2, 2], [3, 3, 3, 4, 4, 4]])
    1
    """
    a, b, options = two_sets(locals())
    return _core.count_between(a, b, options)


def _iterate(stream: _core.Batches) -> Iterator[Pairs]:
    try:
        while (batch := stream.next()) is not None:
            yield np.asarray(batch)
    finally:
        stream.close()


def batches(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None = None,
    *,
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
    batch_size: int = 65536,
) -> Iterator[Pairs]:
    """The pairs of `overlaps` in batches; uses memory independent of their number.

    The search runs in its own thread, at most two batches ahead of its reader. Leaving the loop early ends it. Nobody,
    the body of the loop included, may change the arrays meanwhile: pairs can be lost.

    Parameters
    ----------
    batch_size : int
        The maximum number of pairs in a batch.
    max_pairs : int, optional
        More pairs than this raise LimitExceeded; the batches until then have no more.

    The other parameters, and what is raised, are those of `overlaps`.

    Yields
    ------
    ndarray, shape (m, 2), uint32
        Concatenated, the batches are the rows that `overlaps` returns.

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> boxes = np.zeros((1000, 6))  # all in one place: 499,500 pairs
    >>> sum(len(batch) for batch in allpairs.batches(boxes))
    499500
    """
    size = _arguments.whole("batch_size", batch_size, least=1)
    boxes, options = one_set(locals())
    return _iterate(_core.Batches(boxes, None, options, size))


def batches_between(
    first: BoxesLike,
    second: BoxesLike,
    *,
    distance: float = 0.0,
    margin: Both = None,
    region: npt.ArrayLike | None = None,
    group: Both = None,
    category: Both = None,
    mask: Both = None,
    ignore: npt.ArrayLike | None = None,
    order: Order = "first",
    strategy: Strategy = "auto",
    threads: int = 1,
    max_pairs: int | None = None,
    batch_size: int = 65536,
) -> Iterator[Pairs]:
    """The pairs of `overlaps_between` in batches, like `batches` for one set.

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> [batch.shape for batch in allpairs.batches_between(np.zeros((3, 6)), np.zeros((2, 6)), batch_size=4)]
    [(4, 2), (2, 2)]
    """
    size = _arguments.whole("batch_size", batch_size, least=1)
    a, b, options = two_sets(locals())
    return _iterate(_core.Batches(a, b, options, size))


def instruction_sets() -> tuple[str, ...]:
    """The instruction sets that both this processor and the module support; the first is in use."""
    return _core.instruction_sets()
