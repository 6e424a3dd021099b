# SPDX-License-Identifier: MIT
"""What each rank does in test_mpi.py: `mpirun -n N python3 mpi_ranks.py`."""

import sys

import numpy as np
from mpi4py import MPI

import allpairs
import allpairs.mpi

comm = MPI.COMM_WORLD
rank, ranks = comm.rank, comm.size
rng = np.random.default_rng(3)
lower = rng.random((3000, 3), dtype=np.float32) * np.float32(12)
boxes = np.hstack([lower, lower + rng.random((3000, 3), dtype=np.float32)])
margin = rng.random(3000) * 0.1
group = rng.integers(0, 3, 3000)
mine = slice(3000 * rank // ranks, 3000 * (rank + 1) // ranks)


def same(found, expected):
    """Whether the ranks' pairs one after the other are those of one process, and all ranks agree on their number."""
    everything = np.concatenate(comm.allgather(found))
    assert found.dtype == np.uint64
    assert everything.tolist() == expected.tolist()


same(allpairs.mpi.overlaps(comm, boxes[mine]), allpairs.overlaps(boxes))
same(
    allpairs.mpi.overlaps(comm, boxes[mine, :3], boxes[mine, 3:], distance=0.1, margin=margin[mine], group=group[mine]),
    allpairs.overlaps(boxes, distance=0.1, margin=margin, group=group),
)
assert allpairs.mpi.count(comm, boxes[mine], region=[[1, 1, 1], [5, 6, 7]]) == allpairs.count(
    boxes, region=[[1, 1, 1], [5, 6, 7]]
)
same(
    allpairs.mpi.overlaps_between(comm, boxes[mine], boxes[mine] + np.float32(0.5), group=(group[mine], None), threads=2),
    allpairs.overlaps_between(boxes, boxes + np.float32(0.5), group=(group, None)),
)
assert allpairs.mpi.count_between(comm, boxes[mine], boxes[:0]) == 0
# The last rank alone has boxes.
same(allpairs.mpi.overlaps(comm, boxes if rank == ranks - 1 else boxes[:0]), allpairs.overlaps(boxes))

# What one rank raises all do, and the communicator can be used on.
bad = boxes[mine].copy()
if rank == ranks - 1:
    bad[5, 2] = np.nan
for wrong, kind in (
    (bad, allpairs.InvalidBox),
    (boxes[mine] if rank else boxes[mine, :5], allpairs.InvalidArgument),
    (boxes[mine] if rank else boxes[mine, :4], allpairs.InvalidArgument),  # in the plane
):
    try:
        allpairs.mpi.overlaps(comm, wrong)
    except kind as problem:
        assert ranks == 1 or str(problem).startswith("rank "), problem
    else:
        raise AssertionError("nothing was raised")
try:
    allpairs.mpi.count(comm, boxes[mine], max_pairs=10)
except allpairs.LimitExceeded as problem:
    assert problem.count > 10
else:
    raise AssertionError("nothing was raised")
same(allpairs.mpi.overlaps(comm, boxes[mine]), allpairs.overlaps(boxes))


class Unpicklable:
    def __array__(self, *_):
        raise MemoryError("no memory for it", lambda: None)


try:
    allpairs.mpi.overlaps(comm, boxes[mine] if rank else Unpicklable())
except (MemoryError, allpairs.Error) as problem:
    assert "no memory for it" in str(problem)
    assert isinstance(problem, MemoryError) == (rank == 0)
else:
    raise AssertionError("nothing was raised")
if rank == 0:
    print("all of it")
sys.exit(0)
