# SPDX-License-Identifier: MIT
"""The partners of each box, as rows of a sparse matrix."""

from __future__ import annotations

from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _arguments, _core
from ._arguments import BoxesLike, Strategy
from ._settings import Both, one_set, two_sets

#: Where each row begins, and one more; and what is in the rows.
Rows = tuple[npt.NDArray[np.int64], npt.NDArray[np.uint32]]

Form = Literal["full", "half"]

_FORMS = {"full": _core.NeighborRows.full, "half": _core.NeighborRows.half}


def _arrays(found: tuple[_core.OffsetArray, _core.IdArray]) -> Rows:
    offsets, indices = found
    return np.asarray(offsets).view(np.int64), np.asarray(indices)


def neighbors(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None = None,
    *,
    form: Form = "full",
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
) -> Rows:
    """The boxes that overlap each box, in compressed sparse rows (CSR).

    Row i is ``indices[indptr[i]:indptr[i + 1]]``, ascending. It is the form of SciPy:
    ``scipy.sparse.csr_array((numpy.ones(len(indices)), indices, indptr), shape=(n, n))`` is the adjacency matrix.

    Parameters
    ----------
    lower, upper : array_like
        As in `overlaps`.
    form : {"full", "half"}
        Whether a pair is in the rows of both its boxes, or only in that of the lower index: those rows, read one after the
        other, are the pairs of `overlaps`.
    max_pairs : int, optional
        More pairs than this, each counted once, raise LimitExceeded.

    The other parameters, and what is raised, are those of `overlaps`; there is no ``order``.

    Returns
    -------
    indptr : ndarray, shape (n + 1,), int64
    indices : ndarray, uint32

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs
    >>> lower = np.array([[0.0, 0, 0], [1, 1, 1], [3, 3, 3]])
    >>> indptr, indices = allpairs.neighbors(lower, lower + 2)
    >>> indptr, indices
    (array([0, 1, 3, 4]), array([1, 0, 2, 1], dtype=uint32))
    >>> indices[indptr[1]:indptr[2]]
    array([0, 2], dtype=uint32)
    >>> allpairs.neighbors(lower, lower + 2, form="half")
    (array([0, 1, 2, 2]), array([1, 2], dtype=uint32))
    """
    kind = _arguments.choice("form", form, _FORMS)
    boxes, options = one_set(locals())
    return _arrays(_core.neighbors(boxes, kind, options))


def neighbors_between(
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
) -> Rows:
    """The boxes of `second` that overlap each box of `first`, as rows like those of `neighbors`.

    The parameters, and what is raised, are those of `overlaps_between`, without ``order``.

    Returns
    -------
    indptr : ndarray, shape (n + 1,), int64
        One more than `first` has boxes.
    indices : ndarray, uint32
        Of boxes of `second`.

    Examples
    --------
    >>> import allpairs
    >>> parts = [[0, 0, 0, 1, 1, 1], [5, 0, 0, 6, 1, 1], [9, 0, 0, 9, 1, 1]]
    >>> shelves = ([[-1, -1, -1], [6, 0, 0]], [[5, 5, 0], [7, 1, 1]])
    >>> allpairs.neighbors_between(parts, shelves)
    (array([0, 1, 3, 3]), array([0, 0, 1], dtype=uint32))
    """
    a, b, options = two_sets(locals())
    return _arrays(_core.neighbors_between(a, b, options))
