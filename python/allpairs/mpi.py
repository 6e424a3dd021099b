# SPDX-License-Identifier: MIT
"""Overlapping pairs of boxes that lie on the ranks of an MPI communicator.

Every function is collective: all ranks of the communicator call it, each with boxes of its own. The boxes of a rank are
numbered after those of the ranks before it. What one rank raises is raised on all. Ctrl-C waits for the end of the
search: MPI has no way out of it for one rank. A call that Python itself refuses, such as one with an unknown argument,
raises on its rank only, and the others wait; `mpirun -n 4 python3 -m mpi4py script.py` ends them all. Needs mpi4py
(Debian: python3-mpi4py), and a build of this package for the same MPI.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable
from typing import Any, Optional, TypeVar

import numpy as np
import numpy.typing as npt
from mpi4py import MPI

from . import _core
from ._errors import Error, InvalidArgument
from ._settings import IN_SPACE, Both, one_set, two_sets

try:
    from . import _mpi
except ImportError as problem:
    raise ImportError("this build of allpairs has no MPI: it was not there when it was built") from problem

__all__ = ["count", "count_between", "overlaps", "overlaps_between"]

#: Pairs by numbers of 64 bits: shape (m, 2).
IdPairs = npt.NDArray[np.uint64]

_Made = TypeVar("_Made")


def _portable(problem: Optional[BaseException]) -> Optional[BaseException]:
    """An exception that arrives at other ranks as it left; of one that would not, its text."""
    try:
        if type(pickle.loads(pickle.dumps(problem))) is type(problem):
            return problem
    except Exception:
        pass
    return Error(f"{type(problem).__name__}: {problem}")


def _on_all_ranks(comm: MPI.Comm, make: Callable[[], _Made]) -> _Made:
    """Makes something on each rank, and raises on all ranks what one raises."""
    problem: Optional[BaseException] = None
    made = None
    try:
        made = make()
    except BaseException as raised:  # the others wait, whatever it is
        problem = raised
    problems: list[Optional[BaseException]] = comm.allgather(_portable(problem))
    for rank, found in enumerate(problems):
        if found is not None and comm.size > 1:
            if rank == comm.rank and problem is not None and not isinstance(problem, Error):
                raise problem
            if isinstance(found, Error):
                found.args = (f"rank {rank}: {found}",) + found.args[1:]
            raise found
    if problem is not None:
        raise problem
    assert made is not None
    return made


def _prepared(
    make: Callable[[dict[str, Any]], tuple[Any, ...]], values: dict[str, Any]
) -> tuple[_mpi.DistributedSearch, list[_core.Boxes]]:
    """A search on the ranks, and the sets that it is for: one or two, as make() makes them of a function's arguments."""
    comm = values["comm"]
    *sets, options = _on_all_ranks(comm, lambda: make({**IN_SPACE, **values}))
    if MPI.Get_library_version().strip("\0 \n") != _mpi.mpi_version().strip():
        raise InvalidArgument("mpi4py and allpairs were built for different MPIs")
    return _mpi.DistributedSearch(comm.py2f(), options), sets


def overlaps(
    comm: MPI.Comm,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None = None,
    *,
    distance: float = 0.0,
    margin: npt.ArrayLike | None = None,
    region: npt.ArrayLike | None = None,
    group: npt.ArrayLike | None = None,
    category: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | None = None,
    threads: int = 1,
    max_pairs: int | None = None,
) -> IdPairs:
    """The pairs of all ranks' boxes whose first box is this rank's.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
        The ranks that search together.
    lower, upper, margin, group, category, mask
        Of this rank's boxes, as in `allpairs.overlaps`. A rank may have none.
    distance, region, max_pairs
        As in `allpairs.overlaps`, and the same on all ranks; max_pairs limits the pairs of all of them together.
    threads : int
        Of this rank.

    Returns
    -------
    ndarray, shape (m, 2), uint64
        Ordered by (first, second). The ranks' arrays one after the other are the pairs of one process.

    Examples
    --------
    >>> import numpy as np
    >>> import allpairs.mpi
    >>> from mpi4py import MPI
    >>> allpairs.mpi.overlaps(MPI.COMM_SELF, np.array([[0, 0, 0, 2, 2, 2], [1, 1, 1, 3, 3, 3], [9, 9, 9, 9, 9, 9]]))
    array([[0, 1]], dtype=uint64)
    """
    search, sets = _prepared(one_set, locals())
    return np.asarray(search.find(*sets))


def count(
    comm: MPI.Comm,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None = None,
    *,
    distance: float = 0.0,
    margin: npt.ArrayLike | None = None,
    region: npt.ArrayLike | None = None,
    group: npt.ArrayLike | None = None,
    category: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | None = None,
    threads: int = 1,
    max_pairs: int | None = None,
) -> int:
    """The number of pairs of all ranks, on each of them. Parameters as in `overlaps`."""
    search, sets = _prepared(one_set, locals())
    return search.count(*sets)


def overlaps_between(
    comm: MPI.Comm,
    first: Any,
    second: Any,
    *,
    distance: float = 0.0,
    margin: Both = None,
    region: npt.ArrayLike | None = None,
    group: Both = None,
    category: Both = None,
    mask: Both = None,
    threads: int = 1,
    max_pairs: int | None = None,
) -> IdPairs:
    """The pairs of a box of the first set and a box of the second whose first box is this rank's.

    The sets are as in `allpairs.overlaps_between` and numbered by themselves; the other parameters are as in `overlaps`, a
    tuple of two where they are of boxes.
    """
    search, sets = _prepared(two_sets, locals())
    return np.asarray(search.find(*sets))


def count_between(
    comm: MPI.Comm,
    first: Any,
    second: Any,
    *,
    distance: float = 0.0,
    margin: Both = None,
    region: npt.ArrayLike | None = None,
    group: Both = None,
    category: Both = None,
    mask: Both = None,
    threads: int = 1,
    max_pairs: int | None = None,
) -> int:
    """The number of pairs of two sets on all ranks, on each of them. Parameters as in `overlaps_between`."""
    search, sets = _prepared(two_sets, locals())
    return search.count(*sets)
