# SPDX-License-Identifier: MIT
"""Candidates of deforming triangle meshes: which vertices, edges and faces may touch during a step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, Union, cast

import numpy as np
import numpy.typing as npt

from . import _arguments, _core
from ._errors import InvalidArgument, InvalidBox
from ._search import Pairs

#: Which elements are candidates.
Kind = Literal["vertex-face", "edge-edge", "face-face"]

_KINDS = {
    "vertex-face": _core.CandidateKind.vertex_face,
    "edge-edge": _core.CandidateKind.edge_edge,
    "face-face": _core.CandidateKind.face_face,
}


def _each(name: str, value: Any) -> list[Any]:
    """One thing for each mesh."""
    try:
        return list(value)
    except TypeError:
        raise TypeError(f"{name} is of type {type(value).__name__}; it takes one for each mesh") from None


def _triangles(name: str, value: npt.ArrayLike) -> npt.NDArray[np.uint32]:
    try:
        return _arguments.index_rows(name, value, 3)
    except InvalidBox as problem:  # a vertex, no box
        raise InvalidArgument(str(problem)) from None


class MeshCandidates:
    """Finds the pairs of elements of triangle meshes that may touch while their vertices move, for continuous collision
    detection; elements that share a vertex are never candidates.

    Elements are numbered consecutively: those of the first mesh, then those of the second, and so on.

    Parameters
    ----------
    triangles : array_like, shape (k, 3), integers, or list of such arrays
        The vertices of each triangle, of one mesh or of several.
    vertex_count : int, or list of int
        The number of vertices of each mesh.
    distance : float
        Elements whose boxes are at most this far apart on every axis are candidates.
    within, between : bool
        Whether two elements of one mesh, and two of different meshes, are candidates.
    order, threads
        As in `allpairs.overlaps`.

    Attributes
    ----------
    edges : ndarray, shape (e, 2), uint32
        The vertices of each edge: unique, ascending.
    triangles : ndarray, shape (t, 3), uint32
        The vertices of each triangle, in the order given.

    Examples
    --------
    Two triangles, one of which falls through the other:

    >>> import numpy as np
    >>> import allpairs
    >>> meshes = allpairs.MeshCandidates([[[0, 1, 2]], [[0, 1, 2]]], [3, 3])
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    >>> meshes.set_positions(corners, mesh=0)
    >>> meshes.set_positions(corners + [0, 0, 1], corners - [0, 0, 1], mesh=1)
    >>> meshes.find("face-face")
    array([[0, 1]], dtype=uint32)
    >>> meshes.count("vertex-face"), meshes.count("edge-edge")
    (6, 9)
    """

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("cannot pickle 'allpairs.MeshCandidates' object")

    def __init__(
        self,
        triangles: Union[npt.ArrayLike, Sequence[npt.ArrayLike]],
        vertex_count: Union[int, Sequence[int]],
        *,
        distance: float = 0.0,
        within: bool = True,
        between: bool = True,
        order: _arguments.Order = "first",
        threads: int = 1,
    ) -> None:
        settings = _core.CandidateSettings()
        settings.distance = _arguments.number("distance", distance)
        settings.within = _arguments.flag("within", within)
        settings.between = _arguments.flag("between", between)
        settings.order = _arguments.order_of(order)
        settings.threads = _arguments.threads_of(threads)
        single = isinstance(vertex_count, (int, float, np.number)) or getattr(vertex_count, "ndim", 1) == 0
        meshes: list[Any] = [triangles] if single else _each("triangles", triangles)
        counts: list[Any] = [vertex_count] if single else _each("vertex_count", vertex_count)
        if len(meshes) != len(counts):
            raise InvalidArgument(f"triangles of {len(meshes)} meshes and vertex_count of {len(counts)}")
        arrays = [_triangles(f"triangles of mesh {i}", mesh) for i, mesh in enumerate(meshes)]
        numbers = [_arguments.whole("vertex_count", count, most=_core.NO_BOX) for count in counts]
        self._core = _core.MeshCandidates(arrays, numbers, settings)
        self._without = [mesh for mesh, count in enumerate(numbers) if count != 0]  # positions
        self.edges: npt.NDArray[np.uint32] = np.asarray(self._core.edges())
        self.triangles: npt.NDArray[np.uint32] = np.asarray(self._core.triangles())

    def set_positions(self, start: npt.ArrayLike, end: npt.ArrayLike | None = None, *, mesh: int = 0) -> None:
        """Sets the positions of the vertices of a mesh at the start and at the end of the step.

        Parameters
        ----------
        start, end : array_like, shape (n, 3), float32 or float64
            Without ``end``, the vertices rest.
        mesh : int
        """
        begin, finish = _arguments.corner_pair("start", start, "end", start if end is None else end)
        number = _arguments.whole("mesh", mesh)
        self._core.set_positions(number, _arguments.contiguous(begin), _arguments.contiguous(finish))
        self._without = [mesh for mesh in self._without if mesh != number]

    def _chosen(self, kind: Kind) -> Any:
        """The kind, of meshes that all have positions."""
        chosen = _arguments.choice("kind", kind, _KINDS)
        if self._without:
            raise InvalidArgument(f"mesh {self._without[0]} has no positions: set_positions() is to come first")
        return chosen

    def shrink(self) -> None:
        """Releases the memory that is kept for the next search; positions, and arrays that were returned, stay."""
        self._core.shrink()

    def __repr__(self) -> str:
        return f"MeshCandidates({len(self.triangles)} triangles, {len(self.edges)} edges)"

    def find(self, kind: Kind) -> Pairs:
        """All candidates of a kind, each once.

        Parameters
        ----------
        kind : {"vertex-face", "edge-edge", "face-face"}

        Returns
        -------
        ndarray, shape (m, 2), uint32
            Vertex and triangle, or two edges or triangles with ``first < second``.
        """
        return np.asarray(self._core.find(self._chosen(kind)))

    def count(self, kind: Kind) -> int:
        """The number of candidates of `find`; uses memory independent of that number."""
        return self._core.count(self._chosen(kind))
