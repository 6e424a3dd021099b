# SPDX-License-Identifier: MIT
"""Finds all pairs of overlapping boxes in NumPy arrays: exactly, and in order.

>>> import numpy as np
>>> import allpairs
>>> lower = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]])
>>> upper = np.array([[2.0, 2.0, 2.0], [3.0, 3.0, 3.0], [4.0, 4.0, 4.0]])
>>> allpairs.overlaps(lower, upper)
array([[0, 1],
       [1, 2]], dtype=uint32)
"""

from . import _interpreter

_interpreter.require_main()

from ._core import version as __version__
from ._elements import MeshCandidates
from ._errors import Error, FileError, InvalidArgument, InvalidBox, LimitExceeded
from ._neighbors import neighbors, neighbors_between
from ._partition import (
    JoinSummary,
    Partition,
    count_between_in_cell,
    count_in_cell,
    join,
    overlaps_between_in_cell,
    overlaps_in_cell,
)
from ._queries import NO_BOX
from ._scene import Detection, Model, Remark, Scene, detect, load
from ._search import batches, batches_between, count, count_between, instruction_sets, overlaps, overlaps_between
from ._world import EVERY_WORLD, Step, World, WorldStatistics
from ._worlds import count_in_worlds, overlaps_in_worlds

__all__ = [
    "Detection",
    "EVERY_WORLD",
    "Error",
    "FileError",
    "InvalidArgument",
    "InvalidBox",
    "JoinSummary",
    "LimitExceeded",
    "MeshCandidates",
    "Model",
    "NO_BOX",
    "Partition",
    "Remark",
    "Scene",
    "Step",
    "World",
    "WorldStatistics",
    "__version__",
    "batches",
    "batches_between",
    "count",
    "count_between",
    "count_between_in_cell",
    "count_in_cell",
    "count_in_worlds",
    "detect",
    "instruction_sets",
    "join",
    "load",
    "neighbors",
    "neighbors_between",
    "overlaps",
    "overlaps_between",
    "overlaps_between_in_cell",
    "overlaps_in_cell",
    "overlaps_in_worlds",
]
